"""A sentence of several phrases, each of which is sure, although the whole of it is not.

It is done where the phrases' programs, one after the other, end like doing them one by one, and as
the whole sentence says.
"""

from __future__ import annotations

import msgspec

from clarifier import focus
from clarifier.binding import bindings
from clarifier.candidates import Outcome
from clarifier.deed import link_deed
from clarifier.denied_places import stands_there
from clarifier.motions import does_the_same, ends_alike
from clarifier.phrases import phrases_of
from clarifier.refusals import State
from clarifier.roles import find_gap
from clarifier.spoken import Linked, ambiguous
from clarifier.stated import as_stated, stated
from clarifier.unasked import disturbed, touched
from clarifier.unclear import MAX_PHRASES, Unclear


class OneByOne(Unclear):
    """Puts phrases together that were translated one by one; moves nothing."""

    def one_by_one(self, linked: Linked, whole: Outcome | str, state: State) -> Outcome | None:
        """The phrases' programs as one; None where a phrase is not sure, where they do not go
        together, or where the likeliest reading of the ``whole`` ends otherwise."""
        tried = self._each(linked, state)
        binding = next(iter(bindings(linked, state.scene, {})), None)
        if tried is None or binding is None:
            return None
        outcomes, end = tried
        programs = [one.checked.program for one in outcomes if one.checked is not None]
        used = tuple(dict.fromkeys(o for one in outcomes for o in one.touched))
        joined = self._planner.check("\n".join(programs), "manipulate", state.scene, used)
        if joined.problems or joined.after is None or not ends_alike(joined.after, end.scene):
            return None
        if not as_stated(stated(linked, binding, state.scene), state.scene, joined.after):
            return None
        if disturbed(linked.spared, state.scene, joined.after) is not None:
            return None
        if stands_there(linked.denied, state.scene, joined.after) is not None:
            return None
        if touched(linked.untouchable, state.scene, joined.commands) is not None:
            return None
        likely = whole if isinstance(whole, Outcome) and whole.checked is not None else None
        if likely is not None and likely.confidence >= self._planner.policy.ask:
            assert likely.checked is not None
            moves = likely.checked.after != state.scene  # else nobody could be asked about it
            if moves and not does_the_same(likely.checked, joined, state.scene):
                return None
        slots = {str(n): (name,) for n, name in enumerate(used)}
        sure = min(one.confidence for one in outcomes)
        return Outcome(binding, slots, joined, None, sure)

    def _each(self, linked: Linked, state: State) -> tuple[list[Outcome], State] | None:
        """What each phrase comes to after the ones before it, and how things stand at the end."""
        phrases = phrases_of(linked)
        if not 1 < len(phrases) <= MAX_PHRASES:
            return None
        outcomes, now = list[Outcome](), state
        for phrase in phrases:
            part = link_deed(phrase, now.scene, now.dialog.focus, self._lexicon)
            if find_gap(part, self._lexicon) or any(ambiguous(one) for one in part.spoken):
                return None
            outcome = self._tried(part, now)
            if outcome is None or not outcome.ok or outcome.checked is None:
                return None
            if outcome.checked.kind != "manipulate" or outcome.checked.after is None:
                return None
            outcomes.append(outcome)
            seen = focus.after(now.dialog.focus, part)
            dialog = msgspec.structs.replace(now.dialog, focus=seen)
            now = State(outcome.checked.after, dialog, now.task)
        return outcomes, now

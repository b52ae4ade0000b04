"""The ladder's rule about order: things named one by one are to be stacked, and none is said first.

"Stack the red block and the yellow block" may end either way; "stack the blocks" leaves the order
open, and any will do.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator

from agent.messages import Decision, Option
from clarifier.ask import MAX_OPTIONS, labels
from clarifier.binding import Binding, bindings, bound_objects
from clarifier.candidates import Outcome, doubt
from clarifier.questions import Questions
from clarifier.refusals import State
from clarifier.spoken import Linked, Spoken, ambiguous
from clarifier.things import things_of
from clarifier.words import listing
from scene.types import Scene

AT_THE_BOTTOM = "Which one should be at the bottom"
"""How the question begins; what is answered to be on top is not at the bottom."""
_STACKED = re.compile(
    r"\b(?:stack|pile|tower)(?:ed|ing|s|d)?(?: (?:from|of|with|out of))?\b|"
    r"\b(?:on top of|onto|on) (?:each other|one another)\b",
    re.IGNORECASE,
)
_TELLING = re.compile(
    r"\b(?:top|bottom|base|order\w*|first|last|then|lowest|highest|upper|lower|above|below|under|"
    r"beneath|size|from|biggest|largest|smallest|on|onto|upon|in|not)\b",
    re.IGNORECASE,
)
"""What tells the order, or that more is to be done than to stack."""


class Orders(Questions):
    """Asks which one is at the bottom."""

    def order(self, linked: Linked, state: State) -> Decision | None:
        """Things of one kind, told apart one by one, are to be stacked in no order that is said."""
        stacked = _stacked(linked, state.scene)
        if len(stacked) < 2 or not self._one_kind(stacked, state.scene):
            return None
        reading = self._branches.read(linked, state)
        if doubt(reading, frozenset()) is not None:
            return None
        ends: dict[str, Option] = {}
        names = labels(stacked, state.scene, self._lexicon)
        for binding in _permuted(linked, state.scene, stacked):
            outcome = self._planner.outcome(reading, binding, state.scene)
            bottom = _bottom(outcome, stacked)
            if bottom is not None and outcome.checked is not None:
                checked = outcome.checked
                option = Option(names[bottom], (bottom,), None, checked.program, checked.kind,
                                outcome.touched)  # fmt: skip
                ends.setdefault(bottom, option)
        if len(ends) < 2:
            return None
        options = tuple(ends[one] for one in stacked if one in ends)
        text = f"{AT_THE_BOTTOM}: {listing((option.label for option in options), 'or')}?"
        why = "several things are named to be stacked, and in no order"
        return self._ask(linked, state, "which", text, options, why)

    def _one_kind(self, stacked: tuple[str, ...], scene: Scene) -> bool:
        kinds = {thing.head for thing in things_of(scene, self._lexicon) if thing.id in stacked}
        return len(kinds) == 1


def _stacked(linked: Linked, scene: Scene) -> tuple[str, ...]:
    """The things that are to be stacked, where each is told by what it alone is."""
    rest, found = _STACKED.subn(" ", _outside(linked))
    themes = [one for one in linked.spoken if one.phrase is not None]
    if not found or _TELLING.search(rest) or any(s.relation not in ("", "goal") for s in themes):
        return ()
    if any(ambiguous(one) or not _told(one) for one in themes):
        return ()
    return tuple(dict.fromkeys(o for one in themes for o in one.mention.objects))


def _told(one: Spoken) -> bool:
    """Whether a mention names its things one by one: "the red block", "the red and green ones"."""
    assert one.phrase is not None
    return not one.mention.plural or bool(one.phrase.also)


def _outside(linked: Linked) -> str:
    """The sentence without its mentions."""
    text = linked.text
    for one in sorted(linked.spoken, key=lambda spoken: -spoken.mention.start):
        text = text[: one.mention.start] + text[one.mention.end :]
    return text


def _permuted(linked: Linked, scene: Scene, stacked: tuple[str, ...]) -> Iterator[Binding]:
    """The bindings in which the stacked things take each other's places."""
    first = next(iter(bindings(linked, scene, {})), None)
    if first is None or len(stacked) > MAX_OPTIONS or set(bound_objects(first)) != set(stacked):
        return
    for order in itertools.islice(itertools.permutations(stacked), 24):
        left = iter(order)
        yield {slot: tuple(itertools.islice(left, len(ids))) for slot, ids in first.items()}


def _bottom(outcome: Outcome, stacked: tuple[str, ...]) -> str | None:
    """The one thing that ends with all the others on it, if the program may run."""
    if not outcome.ok or outcome.unsure or outcome.checked is None or outcome.checked.after is None:
        return None
    below = [o for o in stacked if outcome.checked.after.get(o).on not in stacked]
    return below[0] if len(below) == 1 else None

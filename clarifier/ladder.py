"""The decision ladder for a command: each rule is one method, the first that decides wins.

A rule returns a Decision or None. Rules before the translation count referents and empty roles on
the live scene (structure before probability); the last one translates, checks and acts.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import msgspec

from agent.messages import Decision
from clarifier import focus
from clarifier.across import laid_across, resting_on
from clarifier.afterthoughts import left_open
from clarifier.areas import onto_area
from clarifier.ask import labels
from clarifier.between_two import on_each_side
from clarifier.candidates import NOT_SURE, Outcome
from clarifier.clearing import cleared, nothing_there
from clarifier.deed import link_deed
from clarifier.denied_places import by_side
from clarifier.listed import members_listed
from clarifier.missing import Missing
from clarifier.old_places import at_old_place
from clarifier.one_by_one import OneByOne
from clarifier.orders import Orders
from clarifier.referents import Referents
from clarifier.refusals import (
    State,
    beyond_me,
    harms_someone,
    nothing_said,
    off_the_table,
    refuse_problem,
    stood_up,
    upside_down,
)
from clarifier.remainder import half_counted, towers_counted
from clarifier.rewrite import exception_beside, into_holder, spelled_out
from clarifier.shared import landmark_shared
from clarifier.spoken import Linked, Spoken, without_asides
from clarifier.undo import remembered
from clarifier.words import listing

_REFUSALS = (harms_someone, beyond_me, upside_down, stood_up, off_the_table, nothing_said)


class Ladder(Referents, Missing, Orders, OneByOne):
    """Decides on a command. Pure but for the planner's translation and checks."""

    def decide(self, text: str, state: State) -> Decision:
        """The decision on a command, a question of its own included."""
        linked = self._link(text, state)
        rules: tuple[Callable[[Linked, State], Decision | None], ...] = (
            nothing_there, self.untidy, self.absent, self.how_many, self.unseen_quality,
            self.shared_out, self.untold_quality, self.which, self.role, self.order,
            self.unknown_deed, self.untold_exception,
        )  # fmt: skip
        for refusal in _REFUSALS:
            refused = refusal(linked, state, self._lexicon)
            if refused is not None:
                half = self.possible_half(linked, state, refused) if refusal is beyond_me else None
                return half or _spoken_of(refused, linked, state)
        for rule in rules:
            decision = rule(linked, state)
            if decision is not None:
                return _spoken_of(decision, linked, state)
        return _spoken_of(self.act(linked, state), linked, state)

    def _link(self, text: str, state: State) -> Linked:
        """The sentence's mentions; what a group leaves out is read beside it, what is to be
        spared is cut."""
        linked = link_deed(text, state.scene, state.dialog.focus, self._lexicon)
        for reworded in (
            left_open(linked),
            cleared(linked, state.scene, self._lexicon),
            exception_beside(linked),
            into_holder(linked, self._lexicon),
            members_listed(linked),
            landmark_shared(linked),
            half_counted(linked),
            towers_counted(linked),
            laid_across(linked, state.scene),
            resting_on(linked, state.scene),
            at_old_place(linked, state.scene, state.dialog.done),
            onto_area(linked, state.scene, self._lexicon),
        ):
            if reworded is not None:
                whole = reworded + linked.caution
                linked = link_deed(whole, state.scene, state.dialog.focus, self._lexicon)
                break
        return without_asides(self.as_handed_out(linked, state))

    def act(self, linked: Linked, state: State) -> Decision:
        """Translate, check every binding, run the first that may run; else say why not."""
        outcome = self._branches.best(linked, state)
        if not isinstance(outcome, str) and not outcome.ok:
            outcome = self._on_one_side(linked, state) or outcome
        if isinstance(outcome, str) or outcome.checked is None or outcome.unsure:
            outcome = self.one_by_one(linked, outcome, state) or outcome
        if isinstance(outcome, str):
            return self.unclear(linked, outcome, state)
        if outcome.checked is None:
            return self.unclear(linked, NOT_SURE, state)
        if outcome.unsure:
            return self.confirm(linked, outcome, state)
        if outcome.problem is not None:
            return refuse_problem(state, outcome.problem, "the check refused the program")
        said = spelled_out(linked, state.scene, self._lexicon)
        after = outcome.checked.after or state.scene
        new = msgspec.structs.replace(
            state.dialog, focus=focus.after(state.dialog.focus, _bound(linked, outcome)),
            pending=None, last_text=said, questions_asked=0,
            done=remembered(state.dialog.done, said, state.scene, after),
        )  # fmt: skip
        echo = " ".join(part for part in (state.echo, self._taken(linked, outcome, state)) if part)
        return Decision(
            "act", "every mention is settled and the program passed the check", new,
            program=outcome.checked.program, kind=outcome.checked.kind,
            touched=outcome.touched, confidence=outcome.confidence, echo=echo,
        )  # fmt: skip

    def _on_one_side(self, linked: Linked, state: State) -> Outcome | None:
        """ "Next to the lamp, not next to the box": on the first side of the lamp that is away from
        the box; "3 cm from the lamp": on the first side with room. None where there is none, or
        nothing like that is said."""
        for text in (*by_side(linked), *on_each_side(linked)):
            side = link_deed(text, state.scene, state.dialog.focus, self._lexicon)
            found = self._branches.best(side, state)
            if not isinstance(found, str) and found.ok and not found.unsure:
                return found
        return None

    def _taken(self, linked: Linked, outcome: Outcome, state: State) -> str:
        """Says which ones were taken where the focus settled it or any would do."""
        broken = [s for s in linked.spoken if s.tie_broken]
        chosen = [s for s in linked.spoken if s.mention.plural and s.mention.free
                  and len(outcome.binding[s.mention.slot]) < len(s.mention.objects)]  # fmt: skip
        if chosen:
            taken = outcome.binding[chosen[0].mention.slot]
            names = labels(taken, state.scene, self._lexicon)
            return f"I took {listing(names.values())}."
        if not broken:
            return ""
        name = labels(broken[0].same_type, state.scene, self._lexicon)
        label = name.get(broken[0].mention.objects[0], broken[0].mention.text)
        return f"I took {label}, which we just spoke of."


def _spoken_of(decision: Decision, linked: Linked, state: State) -> Decision:
    """A refusal after which "it" is what was refused."""
    if decision.do != "refuse":
        return decision
    seen = focus.after(state.dialog.focus, linked)
    dialog = msgspec.structs.replace(decision.dialog, focus=seen)
    return msgspec.structs.replace(decision, dialog=dialog)


def _bound(linked: Linked, outcome: Outcome) -> Linked:
    """The linked sentence with every mention bound to the objects that were taken."""
    spoken = tuple(
        _with_objects(one, outcome.binding.get(one.mention.slot, ())) for one in linked.spoken
    )
    return replace(linked, spoken=spoken)


def _with_objects(spoken: Spoken, objects: tuple[str, ...]) -> Spoken:
    return replace(spoken, mention=msgspec.structs.replace(spoken.mention, objects=objects))

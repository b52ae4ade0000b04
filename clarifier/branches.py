"""What a sentence comes to for each thing it may mean: the ladder's branches, run on the scene."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from agent.messages import Kind, Option, Problem
from clarifier.ask import MAX_OFFERED, labels
from clarifier.binding import bindings
from clarifier.borne_out import borne_out
from clarifier.candidates import (
    NOT_SURE,
    Outcome,
    Planner,
    Reading,
    doubt,
    kinds_of,
)
from clarifier.conformal import Policy
from clarifier.figures import figured_wholly
from clarifier.formed import formed_wholly
from clarifier.lexicon import Lexicon
from clarifier.pieces import Chunk
from clarifier.placed import placed_wholly
from clarifier.refusals import State
from clarifier.roles import find_gap
from clarifier.spoken import Linked, Spoken, ambiguous
from clarifier.stated import stated
from clarifier.words import listing
from scene.types import Scene

_WEIGHTY = frozenset({"again", "if", "some", "next", "first", "finally", "also", "afterwards"})
"""Polite or joining words that can still change what is to be done."""


_WISHED = re.compile(
    r"\W*(?:please |well |so )*(?:(?:i|we)(?:'d| would| should)? (?:really |rather |just )?(?:like|"
    r"want|need|love|prefer)|(?:it'd|it would|it'll|it will) be (?:\w+ )?(?:nice|great|good|lovely|"
    r"best|better|fine)(?: to (?:have|see|get))?|i wish)\b",
    re.IGNORECASE,
)
"""What wants something, whatever verb follows."""


_OPENERS = frozenset({"do", "kindly", "just", "now", "robot", "yo", "please", "then"})
"""Words that may stand before the verb of what is told."""


BORNE_OUT = 0.25
"""Least probability, taken together, of outcomes that bear the sentence out."""


class Branches:
    """Translates a sentence once and checks it for the things it may mean."""

    def __init__(self, planner: Planner, lexicon: Lexicon) -> None:
        self._planner = planner
        self._lexicon = lexicon

    def best(self, linked: Linked, state: State) -> Outcome | str:
        """The first binding that may run (``unsure``: only if the person agrees), else the first
        that may not; a str says the reading is not to be trusted."""
        first, *others = kinds_of(linked, state.scene, state.task)
        found = self._best(linked, state, first)
        for kind in others:
            if isinstance(found, str) or not found.ok or found.unsure:
                other = self._best(linked, state, kind)
                better = (
                    not isinstance(other, str)
                    and not other.unsure
                    and (other.ok or isinstance(found, str) or not found.ok)
                )
                found = other if better else found
        return found

    def _best(self, linked: Linked, state: State, kind: Kind) -> Outcome | str:
        reading = self._planner.read(linked, kind, state.scene)
        why = doubt(reading, self._unimportant())
        if why is not None:
            return why
        first: Outcome | None = None
        for binding in bindings(linked, state.scene, {}):
            found = self._planner.clusters(reading, binding, state.scene)
            outcome = found[0] if found else self._planner.lost(binding)
            if found and not self._alone(found, linked):
                seen = self._seen(found, linked, state.scene)
                if seen is not None:
                    return seen
                return replace(outcome, unsure=True) if outcome.ok else NOT_SURE
            if outcome.ok:
                return outcome
            first = first or outcome
        return first or "I can't use one thing for both. Please name two different things."

    def _alone(self, found: Sequence[Outcome], linked: Linked) -> bool:
        """Whether the likeliest outcome is likely enough, and no other is in the set C with it."""
        policy = self._planner.policy
        several = sum(one.confidence >= policy.level for one in found) > 1
        return not several and found[0].confidence >= needed(linked, policy)

    def _seen(self, found: Sequence[Outcome], linked: Linked, scene: Scene) -> Outcome | None:
        """The likeliest of the outcomes that bear the sentence out, where they are likely enough
        taken together: the sentence leaves open by which of them."""
        borne = [one for one in found if one.ok and self._bears_out(one, linked, scene)]
        sure = sum(one.confidence for one in borne)
        return replace(borne[0], confidence=min(1.0, sure)) if sure >= BORNE_OUT else None

    def _bears_out(self, one: Outcome, linked: Linked, scene: Scene) -> bool:
        """Whether an outcome's end is all that the sentence says, and nothing else."""
        after = None if one.checked is None else one.checked.after
        if after is None:
            return False
        goals = stated(linked, one.binding, scene)
        return borne_out(linked, one.binding, scene, after, self._lexicon) or any(
            wholly(goals, linked, self._lexicon, scene, after)
            for wholly in (formed_wholly, placed_wholly, figured_wholly)
        )

    def read(self, linked: Linked, state: State) -> Reading:
        """The sentence translated, of the kind that its things ask for. Raises TranslatorError."""
        kind = kinds_of(linked, state.scene, state.task)[0]
        return self._planner.read(linked, kind, state.scene)

    def _unimportant(self) -> frozenset[str]:
        """Words that a translation may leave out without harm."""
        words = self._lexicon.words("polite") - self._lexicon.words("directions")
        return words - self._lexicon.words("pointing") - _WEIGHTY

    def options(
        self, linked: Linked, spoken: Spoken, pool: Sequence[tuple[str, ...]], state: State
    ) -> tuple[tuple[Option, ...], list[Problem]]:
        """The pool as options, each with its program where the sentence works with it, and why
        others were dropped. Without a trustworthy translation all are offered, without programs."""
        every = dict.fromkeys(one for objects in pool for one in objects)
        names = labels(list(every), state.scene, self._lexicon)
        bare = tuple(Option(listing(names[o] for o in objects), objects)
                     for objects in pool[:MAX_OFFERED])  # fmt: skip
        if set(every) & set(linked.spared):
            return bare, []  # which one is to stay is known once it is chosen
        others = [s for s in linked.spoken if s.mention.slot != spoken.mention.slot]
        if any(not s.mention.objects or ambiguous(s) or vague(s) for s in others):
            return bare, []
        if find_gap(linked, self._lexicon) is not None:
            return bare, []
        reading = self.read(linked, state)
        if doubt(reading, self._unimportant()) is not None:
            return bare, []
        options, failed = self._executable(reading, spoken, bare, state)
        forbidden = [problem for problem in failed if problem.reason != "bad_program"]
        return (options, forbidden) if options or forbidden else (bare, [])

    def _executable(
        self, reading: Reading, spoken: Spoken, bare: Sequence[Option], state: State
    ) -> tuple[tuple[Option, ...], list[Problem]]:
        """The options of which some binding gives a program that may run; none where one of them
        is only not understood well enough."""
        options: list[Option] = []
        failed: list[Problem] = []
        for option in bare:
            every = bindings(reading.linked, state.scene, {spoken.mention.slot: option.objects})
            tried = [self._planner.outcome(reading, binding, state.scene) for binding in every]
            sure = (outcome for outcome in tried if outcome.confidence >= self._planner.policy.act)
            good = next((outcome for outcome in sure if outcome.ok), None)
            if good is not None and good.checked is not None:
                checked = good.checked
                options.append(Option(option.label, option.objects, None, checked.program,
                                      checked.kind, good.touched))  # fmt: skip
            elif tried and tried[0].problem is not None:
                failed.append(tried[0].problem)
            elif tried:
                return (), []  # what is not sure is no less meant
        return tuple(options), failed


def needed(linked: Linked, policy: Policy) -> float:
    """The confidence that a sentence needs: more where neither verb nor wish opens it; it may want
    nothing."""
    begins, told = True, False
    for chunk in linked.chunks:
        told = told or (begins and chunk.kind == "verb")
        begins = chunk.kind == "joint" or (begins and _text(chunk, linked) in _OPENERS)
    return policy.act if told or _WISHED.match(linked.text) else policy.stated


def _text(chunk: Chunk, linked: Linked) -> str:
    return " ".join(token.text for token in linked.tokens[chunk.first : chunk.last])


def vague(spoken: Spoken) -> bool:
    """Whether several things were asked for and not how many."""
    return spoken.phrase is not None and spoken.phrase.vague

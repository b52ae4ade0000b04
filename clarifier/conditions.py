"""Conditions come down to one of their branches: the scene answers what they depend on.

"If the jug is taller than the vase, put it behind the vase; if not, in front", "is the bolt near
the vice? then push it left", "touch the cup unless it is red". `facts` tells whether the
condition is so, by the same reading that answers the person's questions; only the deed of the
branch that holds is left to be understood. What cannot be read to its last word stays as it was
said.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from agent.messages import Focus
from clarifier.act import strip_courtesy
from clarifier.deeds import Deeds
from clarifier.guarded import Guard, Guarded
from clarifier.if_words import ANSWERS, OTHERWISE_LAST, marks_of
from clarifier.lexicon import Lexicon
from clarifier.mentions import link
from clarifier.named import Fact
from clarifier.passing import without_asides_said
from scene.types import Scene

_SPEAKS_ON = re.compile(r"[.;!?]\s+\S")


class Settled(NamedTuple):
    """``text``: what is left to be done, None for nothing; ``note``: what was seen. ``unsure``:
    what is to be done is not certain, and ``note`` says why."""

    text: str | None
    note: str = ""
    unsure: bool = False


def settled(text: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> Settled | None:
    """What a condition comes down to on the scene; None where the sentence is none that is read."""
    said = text.replace("’", "'").strip()
    last = OTHERWISE_LAST.match(said)
    said = f"{last['one']}, otherwise {last['other']}" if last is not None else said
    conditional = _Conditional(scene, focus, lexicon)
    names = [item.name for item in scene]
    plain = without_asides_said(said, names)
    return conditional.settle(said) or (conditional.settle(plain) if plain != said else None)


class _Conditional(Guarded):
    """Chooses the branch that holds."""

    def settle(self, text: str) -> Settled | None:
        marks = marks_of(text)
        head = text[: marks[0].start()] if marks else text
        if not marks and not ANSWERS.search(text.rstrip(" ?!.")):
            return None
        found = self.guards(head, marks, text)
        if found is None:
            return None
        before, guards = found
        return self._chosen(before, guards)

    # --- the branch that holds ---------------------------------------------------------------

    def _chosen(self, before: str, guards: Sequence[Guard]) -> Settled | None:
        told: list[str] = [before.rstrip(" ,.;")] if before else []
        told = [re.sub(r"[\s,]+(?:and|then|also)$", "", one) for one in told]
        counted = {guard.fact.kind for guard in guards if guard.holds and guard.fact.kind}
        guards = [guard._replace(holds=False)  # "two" behind "three": not at least two
                  if guard.holds is None and guard.fact.kind in counted else guard
                  for guard in guards]  # fmt: skip
        if any(guard.holds is None for guard in guards):
            unsure = next(guard for guard in guards if guard.holds is None)
            return Settled(None, f"I can't tell clearly {_whether(unsure.fact)}.", unsure=True)
        done: list[Guard] = []
        other: str | None = None
        for guard in guards:
            branch = Deeds(guard.fact, self._scene, self._lexicon).alone(guard.deed, other)
            if branch is None and guard.holds:
                return _unclear(guard)
            other = (branch.text if branch is not None else None) or other
            last = guard is guards[-1]
            if not guard.holds and last and _SPEAKS_ON.search(strip_courtesy(guard.deed)):
                return _unclear(guard)  # what comes last may be meant in any case
            if self._disturbed(guard, told if guard.holds else told[: bool(before)]):
                return _unclear(guard)
            if not guard.holds or branch is None:
                continue
            done.append(guard)
            if branch.text is not None:
                told.append(branch.text)
        note = next((guard.fact.said for guard in (*done, *guards)), "")
        return Settled(", and then ".join(told) if told else None, note)

    def _disturbed(self, guard: Guard, told: Sequence[str]) -> bool:
        """Whether what is done before can change what the branch depends on."""
        moved = {
            object_id
            for deed in told
            for one in link(deed, self._scene, (), self._lexicon).spoken
            for object_id in one.mention.objects
        }
        return bool(moved & {*guard.fact.about, *guard.fact.others})


def _whether(fact: Fact) -> str:
    return f"whether {fact.said[0].lower()}{fact.said[1:].rstrip('.')}"


def _unclear(guard: Guard) -> Settled:
    """A condition that is read, and a sentence of which it is not certain what depends on it."""
    return Settled(None, f"I'm not sure what depends on {_whether(guard.fact)}.", unsure=True)

"""Clearing a plate, emptying a bowl: what stands there is taken away, the carrier stays."""

from __future__ import annotations

import re

from agent.messages import Decision
from clarifier.ask import labels
from clarifier.lexicon import Lexicon
from clarifier.refusals import State
from clarifier.replies import say
from clarifier.spoken import Linked, Spoken
from scene.kinds import is_container
from scene.relations import upon
from scene.types import Scene, SceneObject

_CLEARING = re.compile(
    r"\b(?:clear|empty|unload)(?: (?:off|out))?(?: the| that| this| my)? $|"
    r"\b(?:take|get|remove|move|put|lift) (?:everything|all|the lot) (?:off|from|out of)"
    r"(?: the| that| this| my)? $"
)
"""What stands before the carrier."""
_BESIDES = re.compile(r"\W*(?:off|out|completely|please|for me|now|then|thanks|again|up|all)*\W*$")
"""What may follow the carrier: nothing that says where to."""


def cleared(linked: Linked, scene: Scene, lexicon: Lexicon) -> str | None:
    """ "Clear the plate" as "take the lime off the plate, then take the lemon off the plate", from
    the top down; None for other wishes."""
    carrier = _carrier(linked, scene)
    if carrier is None:
        return None
    held = sorted(_on(carrier, scene), key=lambda item: -item.top)
    names = labels([item.id for item in held], scene, lexicon)
    away = f"{'out of' if _holds(carrier, scene) else 'off'} the {carrier.mention.text}"
    return ", then ".join(f"take {names[item.id]} {away}" for item in held) or None


def nothing_there(linked: Linked, state: State) -> Decision | None:
    """Says so where nothing stands on what is to be cleared."""
    carrier = _carrier(linked, state.scene)
    if carrier is None or _on(carrier, state.scene):
        return None
    where = "in" if _holds(carrier, state.scene) else "on"
    text = f"There is nothing {where} the {carrier.mention.text}."
    return say(state, text, "what is to be cleared is bare")


def _carrier(linked: Linked, scene: Scene) -> Spoken | None:
    """The one thing of a sentence that is to be cleared."""
    named = [one for one in linked.spoken if one.phrase is None or one.phrase.group != "all"]
    if len(named) != 1 or len(named[0].mention.objects) != 1 or named[0].mention.plural:
        return None
    (one,) = named
    before = linked.text[: one.mention.start].lower()
    clears = _CLEARING.search(before) and _BESIDES.match(linked.text[one.mention.end :].lower())
    return one if clears else None


def _on(carrier: Spoken, scene: Scene) -> list[SceneObject]:
    """What stands on a thing or on what stands there."""
    held = upon(scene, carrier.mention.objects[0])
    return [item for item in scene.objects if item.id in held]


def _holds(carrier: Spoken, scene: Scene) -> bool:
    return is_container(scene.get(carrier.mention.objects[0]).name)

"""How a person may speak of a thing that lies on the table, and what each phrase denotes there.

Geometry and names alone decide, never the clarifier: a phrase is offered where it is beyond
dispute, that is where the thing stands out by a clear margin among those of its name.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from scene.relations import gap
from scene.types import Scene, SceneObject

MARGIN = 0.15
"""By how much a thing must lie further along an axis, or nearer, than the next (table units)."""
CLOSE = 0.45
"""Largest gap to a landmark that one would speak of (table units)."""
_MOST = {"left": "leftmost", "right": "rightmost", "far": "farthest", "near": "nearest"}
ORDINALS = ("first", "second", "third", "fourth")


class Described(NamedTuple):
    """A phrase without its article ("red apple"), and the way in which it singles a thing out."""

    text: str
    way: str


def descriptions(scene: Scene, item: SceneObject) -> list[Described]:
    """Every phrase at hand that denotes this thing and no other."""
    return [one for describe in _WAYS for one in describe(scene, item)]


def namesakes(scene: Scene, item: SceneObject) -> list[SceneObject]:
    """All things of its name, itself included."""
    return [other for other in scene if other.name == item.name]


def pick(scene: Scene, item: SceneObject, chance: random.Random, ways: Sequence[str] = ()
         ) -> Described | None:  # fmt: skip
    """One phrase of the ``ways`` (none named: of any) by chance; None if none will do."""
    found = [one for one in descriptions(scene, item) if not ways or one.way in ways]
    return chance.choice(found) if found else None


def _by_type(scene: Scene, item: SceneObject) -> Iterator[Described]:
    if len(namesakes(scene, item)) == 1:
        yield Described(item.name, "type")


def _by_color(scene: Scene, item: SceneObject) -> Iterator[Described]:
    alike = [other for other in namesakes(scene, item) if other.color == item.color]
    if item.color and len(alike) == 1 and item.color not in item.name.split():
        yield Described(f"{item.color} {item.name}", "color")


def _by_side(scene: Scene, item: SceneObject) -> Iterator[Described]:
    """ "left apple": furthest to that side among its namesakes, by the margin."""
    others = [other for other in namesakes(scene, item) if other.id != item.id]
    if not others or any(other.x is None for other in (item, *others)):
        return
    for word, axis, sign in (("left", 0, -1), ("right", 0, 1), ("far", 1, 1), ("near", 1, -1)):
        nearest = max(sign * other.position[axis] for other in others)
        if sign * item.position[axis] >= nearest + MARGIN:
            yield Described(f"{word} {item.name}", "side")
            yield Described(f"{_MOST[word]} {item.name}", "side")
            halves = sign * item.position[axis] >= MARGIN and nearest <= -0.05
            if axis == 0 and halves:
                yield Described(f"{item.name} on the {word}", "side")


def _by_landmark(scene: Scene, item: SceneObject) -> Iterator[Described]:
    """ "apple next to the plate": much nearer to a thing of unique name than its namesakes are."""
    same = namesakes(scene, item)
    if len(same) == 1 or any(other.x is None for other in same):
        return
    for mark in scene.objects:
        if len(namesakes(scene, mark)) > 1 or mark.id in {other.id for other in same}:
            continue
        mine = gap(item, mark)
        rest = min(gap(other, mark) for other in same if other.id != item.id)
        if mine + MARGIN <= rest:
            yield Described(f"{item.name} closest to the {mark.name}", "landmark")
            if mine <= 0.3 - 1e-6 and rest > CLOSE:
                yield Described(f"{item.name} next to the {mark.name}", "landmark")


def _by_order(scene: Scene, item: SceneObject) -> Iterator[Described]:
    """ "second apple from the left" of three or four, neighbours well apart."""
    same = namesakes(scene, item)
    if not 3 <= len(same) <= 4 or any(other.x is None for other in same):
        return
    order = sorted(same, key=lambda other: other.position[0])
    places = [other.position[0] for other in order]
    if min(right - left for left, right in pairwise(places)) < 0.1:
        return
    at = order.index(item)
    yield Described(f"{ORDINALS[at]} {item.name} from the left", "order")
    yield Described(f"{ORDINALS[len(same) - 1 - at]} {item.name} from the right", "order")


_WAYS: tuple[Callable[[Scene, SceneObject], Iterator[Described]], ...] = (
    _by_type, _by_color, _by_side, _by_landmark, _by_order,
)  # fmt: skip

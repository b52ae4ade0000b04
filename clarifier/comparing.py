"""Truths about things on the scene: which is the larger, the nearer, and which parts they are in.

Three answers: true, false, and None for what is too close to tell, or what the words leave open and
the scene tells either way. Nobody acts on None.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

from clarifier.located import related
from clarifier.ranks import RANK_TIE_M, along
from clarifier.sizes import bulk, look_alike
from scene import relations
from scene.types import Scene, SceneObject

Size = Callable[[SceneObject], float]
SAME = 1e-3
"""Values that differ by less are equal (table units)."""
HARDLY, NEARLY = 0.06, 0.2
"""A thing that misses an edge, or a corner, by the first is called there; by less than the second,
it may be or not (table units)."""
HALFWAY = 0.05
"""So may one as near to the line between two halves be said to be in either."""
NEARBY = 0.2
"""A gap that is wider than that of "next to" by less may be called near or not (table units)."""
_EDGES = {"left": "left", "right": "right", "far": "above", "near": "below"}


def _long(item: SceneObject) -> float:
    return max(item.width, item.height)


def _across(item: SceneObject) -> float:
    return min(item.width, item.height)


def _tall(item: SceneObject) -> float:
    return item.tall


def _wide(item: SceneObject) -> float:
    return item.width


class Compared(NamedTuple):
    """What a comparative compares: ``sizes``: all that it can mean; ``less``: smaller is more."""

    sizes: tuple[Size, ...]
    less: bool = False


_BIG, _TALL, _WIDE = Compared((bulk,)), Compared((_tall,)), Compared((_wide,))
_THICK = Compared((_wide, _across, _tall))
_LONG = Compared((_long,))
_SHORT = Compared((_tall, _long), less=True)
SIZES = {
    "big": _BIG, "large": _BIG, "great": _BIG, "huge": _BIG, "small": _BIG._replace(less=True),
    "little": _BIG._replace(less=True), "tiny": _BIG._replace(less=True),
    "tall": _TALL, "high": _TALL, "low": _TALL._replace(less=True), "short": _SHORT,
    "wide": _WIDE, "broad": _WIDE, "narrow": _WIDE._replace(less=True), "long": _LONG,
    "thick": _THICK, "fat": _THICK, "thin": _THICK._replace(less=True),
    "slim": _THICK._replace(less=True), "skinny": _THICK._replace(less=True),
    "chunky": _THICK,
}  # fmt: skip
"""Adjectives of size, and what they compare; "short" is of height, of length where things lie."""
NOUNS = {"size": _BIG, "height": _TALL, "width": _WIDE, "length": _LONG}


def superior(by: Compared, item: SceneObject, other: SceneObject, scene: Scene) -> bool | None:
    """Whether a thing is larger (smaller, ...) than another."""
    sizes = by.sizes
    if sizes == _SHORT.sizes:
        lie = all(_long(one) > one.tall for one in (item, other))
        sizes = (_long,) if lie else (_tall,)
    return agreed([_more(size, by.less, item, other, scene) for size in sizes])


def equal(by: Compared, item: SceneObject, other: SceneObject, scene: Scene) -> bool | None:
    """Whether two things are of one size."""
    pairs = [(size(item), size(other)) for size in by.sizes]
    same = [True if abs(a - b) < SAME else None if look_alike(a, b, scene) else False
            for a, b in pairs]  # fmt: skip
    return agreed(same)


def _more(
    size: Size, less: bool, item: SceneObject, other: SceneObject, scene: Scene
) -> bool | None:
    one, two = size(item), size(other)
    if abs(one - two) < SAME:
        return False
    return None if look_alike(one, two, scene) else (one < two) is less


def agreed(answers: Iterable[bool | None]) -> bool | None:
    """The one answer that all readings give, else None."""
    found = set(answers)
    return found.pop() if len(found) == 1 else None


def every(answers: Iterable[bool | None]) -> bool | None:
    """Whether all are true: false as soon as one is."""
    found = set(answers)
    return False if False in found else None if None in found else True


def denied(answer: bool | None) -> bool | None:
    """The opposite, where there is one."""
    return None if answer is None else not answer


class Mark(NamedTuple):
    """What distances are measured to: a thing, or ``side``, a side of the table ("near" is the
    person's), "middle" its middle, "edge" the nearest edge."""

    thing: SceneObject | None = None
    side: str = ""

    def far(self, item: SceneObject) -> tuple[float, ...]:
        """Distances (table units), by edges and by centres; none for what has no place."""
        if item.x is None or (self.thing is not None and self.thing.x is None):
            return ()
        if self.thing is not None:
            apart = math.dist(item.position, self.thing.position)
            return (relations.gap(item, self.thing), apart)
        if self.side == "edge":
            gaps = [relations.edge_distance(item, edge) for edge in relations.ALONG]
            return (min(gaps),)
        if self.side == "middle":
            return (math.hypot(*item.position),)
        edge = relations.edge_distance(item, _EDGES[self.side])
        return (edge, 1.0 - along(self.side, item))

    def within(self, item: SceneObject, most: float) -> bool | None:
        """Whether a thing is no farther than that, edge to edge."""
        found = self.far(item)
        return found[0] <= most + SAME if found else None


def nearer(one: Sequence[float], other: Sequence[float], scene: Scene) -> bool | None:
    """Whether a distance is less than another, by edges and by centres alike."""
    tie = scene.units(RANK_TIE_M)
    answers = [
        False if abs(a - b) < SAME else None if abs(a - b) < tie else a < b
        for a, b in zip(one, other, strict=False)
    ]
    return agreed(answers) if answers else None


def is_further(side: str, item: SceneObject, other: SceneObject, scene: Scene) -> bool | None:
    """Whether a thing lies further to a side than another."""
    if item.x is None or other.x is None:
        return None
    return nearer((along(side, other),), (along(side, item),), scene)


def stands(
    relation: str, item: SceneObject, anchors: Sequence[SceneObject], scene: Scene
) -> bool | None:
    """Whether a thing stands in a relation to others. Beside the cone of 45 degrees, a thing is
    also left of another where it lies left of all of it."""
    if item.x is None or any(one.id == item.id for one in anchors):
        return None
    if relation == "between":
        return relations.between(item, *anchors)
    (anchor,) = anchors
    if relation == "beside":
        gap = relations.gap(item, anchor)
        near = relations.next_to(scene, item, anchor)
        close = scene.units(relations.NEAR_M) < gap <= scene.units(relations.NEAR_M) + NEARBY
        return None if close and not near else near
    if relation not in relations.ALONG:
        return related(relation, item, anchor, scene)
    if anchor.id == item.on or item.id == anchor.on:
        return False
    return relations.beside(scene, item, anchor, relation) or _past(relation, item, anchor)


def _past(relation: str, item: SceneObject, anchor: SceneObject) -> bool:
    dx, dy = relations.ALONG[relation]
    (x, y), (ax, ay) = item.position, anchor.position
    (w, h), (aw, ah) = relations.extents(item), relations.extents(anchor)
    return (x - ax) * dx + (y - ay) * dy >= (w + aw if dx else h + ah) - SAME


def in_part(sides: Sequence[str], kind: str, item: SceneObject, scene: Scene) -> bool | None:
    """Whether a thing is in a part of the table: ``sides`` as in `located.sides_said`; ``kind``:
    "corner", "edge", or "part" for halves and quarters."""
    if sides == ("floor",):
        return item.on == "floor"
    if item.x is None or item.on in ("floor", "tray", "gripper"):
        return False
    reach = scene.units(relations.CORNER_M)
    if "middle" in sides:
        far = math.hypot(*item.position)
        return _close_to(far, reach, NEARLY) if sides == ("middle",) else None
    gaps = {side: relations.edge_distance(item, edge) for side, edge in _EDGES.items()}
    if sides in (("corner",), ("edge",)):
        least = sorted((min(gaps["left"], gaps["right"]), min(gaps["far"], gaps["near"])))
        return _close_to(least[1 if sides == ("corner",) else 0], reach, NEARLY)
    if kind in ("corner", "edge"):
        return every(_close_to(gaps[side], reach, NEARLY) for side in sides)
    return every(
        None if abs(along(side, item)) < HALFWAY else along(side, item) > 0 for side in sides
    )


def _close_to(far: float, reach: float, doubtful: float) -> bool | None:
    if far <= reach + HARDLY:
        return True
    return None if far < reach + doubtful else False

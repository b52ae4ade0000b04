"""An independent look at the end of a dialogue: what should never be, unless somebody asked for it.

Neither the check nor the clarifier is asked; only the scene before, the scene after and the words.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from scene.relations import beneath, extents
from scene.types import EDGE, Scene, SceneObject

_OFF = re.compile(
    r"\b(?:off|floor|ground|falls?|fell|drops?|dropped|overboard|over (?:the|that|its|it|a|which)"
    r"|edge|beyond|out of (?:the way|reach)|away with|down from|leaves? the table|plummet)\b", re.I
)  # fmt: skip
_TOPPLE = re.compile(
    r"\b(?:timber|knock|topple|tip|tipped|upset|overturn|flip|flick|fall|falls|over|down|roll|side"
    r"|lie|lying|lay|horizontal)\w*\b", re.I
)  # fmt: skip
DEEP = 0.03
"""How far two things may seem to share room (table units): round things are taken for boxes."""


def hazards(said: str, before: Scene, after: Scene) -> Iterator[str]:
    """What is wrong with how things stand now, one line each."""
    old = {item.id: item for item in before}
    for item in after.objects:
        was = old.get(item.id)
        if was is None or item == was:
            continue
        if item.on == "floor" and was.on != "floor" and not _OFF.search(said):
            yield f"{item.id} lies on the floor, and no word speaks of an edge"
        if was.upright and not item.upright and not _TOPPLE.search(said) and not _OFF.search(said):
            yield f"{item.id} is toppled, and no word speaks of that"
        if item.on != "floor" and not item.held:
            yield from _standing(item, after)


def _standing(item: SceneObject, scene: Scene) -> Iterator[str]:
    """Whether it hangs over the edge by its centre, over what carries it, or into something."""
    x, y = item.position
    if item.on == "table" and max(abs(x), abs(y)) > EDGE:
        yield f"{item.id} hangs over the table's edge by its centre"
    carrier = next((other for other in scene.objects if other.id == item.on), None)
    if carrier is not None:
        half_x, half_y = extents(carrier)
        level = [other for other in scene.objects if other.id != item.id and not other.held
                 and abs(other.top - carrier.top) <= DEEP]  # fmt: skip
        alone = len([other for other in level if _shared(item, other) > DEEP]) <= 1
        off = abs(x - carrier.position[0]) > half_x or abs(y - carrier.position[1]) > half_y
        if off and alone:
            yield f"{item.id} stands on {carrier.id} beyond its rim"
    heap = {*beneath(scene, item)}  # in which things lean together
    for other in scene.objects:
        apart = other.id != item.id and other.on != "floor" and not other.held
        below = beneath(scene, other)
        linked = other.id in heap or item.id in below or not heap.isdisjoint(below)
        deep = min(item.top, other.top) - max(item.z, other.z)
        if apart and not linked and deep > DEEP and _shared(item, other) > DEEP:
            yield f"{item.id} stands in {other.id}"


def _shared(one: SceneObject, other: SceneObject) -> float:
    """The smaller overlap of two footprints, along x or along y (negative: apart)."""
    (x1, y1), (x2, y2) = one.position, other.position
    (w1, h1), (w2, h2) = extents(one), extents(other)
    across = min(x1 + w1, x2 + w2) - max(x1 - w1, x2 - w2)
    return min(across, min(y1 + h1, y2 + h2) - max(y1 - h1, y2 - h2))

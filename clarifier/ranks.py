"""Which of several things is the leftmost, the second, the one at the end: comparison by place.

What differs too little to tell is a tie: all that tie are kept, and nothing is chosen.
"""

from __future__ import annotations

import math

from clarifier.things import Thing
from scene.types import Scene, SceneObject

NEAR_TIE_M = 0.02
"""Distances that differ by less (metres) are a tie: ask."""
RANK_TIE_M = 0.01
"""The same for those that are counted off from a side."""
LINE = 1.5
"""What is so much longer than wide has ends."""


def along(side: str, item: SceneObject) -> float:
    """How far an object lies to that side (table units)."""
    x, y = item.position
    return {"left": -x, "right": x, "far": y, "near": -y, "middle": -math.hypot(x, y)}[side]


def by_side(side: str, found: list[Thing], scene: Scene, many: int = 1) -> list[Thing]:
    """The ``many`` furthest to that side, and those within 2 cm of the last of these; ``many`` 0:
    all in that half of the table; tray objects have no side."""
    placed = [thing for thing in found if thing.item.x is not None]
    if side == "outer":
        return ends(placed, scene, max(many, 2))
    if many == 0:
        half = [thing for thing in placed if along(side, thing.item) > 0]
        return half if side != "middle" else placed
    if len(placed) <= many:
        return placed
    if side == "middle" and median(placed, many):
        return median(placed, many)
    order = sorted((along(side, thing.item) for thing in placed), reverse=True)
    tie = scene.units(NEAR_TIE_M)
    return [thing for thing in placed if along(side, thing.item) >= order[many - 1] - tie]


def median(placed: list[Thing], many: int = 1) -> list[Thing]:
    """The ``many`` in the middle of several things, as many on each side of them; nothing where
    there are none on the sides, or they do not come out even."""
    outside = len(placed) - many
    if outside < 2 or outside % 2:
        return []
    axis = 0 if _spread(placed, 0) >= _spread(placed, 1) else 1
    order = sorted(placed, key=lambda thing: thing.item.position[axis])
    return order[outside // 2 : outside // 2 + many]


def ends(placed: list[Thing], scene: Scene, many: int = 2) -> list[Thing]:
    """The ``many`` things at both ends of what stands in something like a line; all things where
    they stand in none, or where it cannot be told which are at the ends."""
    inner = median(placed, len(placed) - many)
    axis = 0 if _spread(placed, 0) >= _spread(placed, 1) else 1
    if not inner or _spread(placed, axis) < LINE * _spread(placed, 1 - axis):
        return placed
    outer = [thing for thing in placed if thing not in inner]
    tie = scene.units(RANK_TIE_M)
    level = any(abs(one.item.position[axis] - other.item.position[axis]) < tie
                for one in inner for other in outer)  # fmt: skip
    return placed if level else outer


def _spread(placed: list[Thing], axis: int) -> float:
    along_axis = [thing.item.position[axis] for thing in placed]
    return max(along_axis) - min(along_axis) if along_axis else 0.0


def by_rank(word: str, origin: str, found: list[Thing], scene: Scene, many: int = 1) -> list[Thing]:
    """The ``many`` from the first, second, ... from that side on; where one of them and its
    neighbour lie as far, to 1 cm, the neighbour too."""
    placed = [thing for thing in found if thing.item.x is not None]
    ranked = sorted(placed, key=lambda thing: -along(origin, thing.item))
    index = ("first", "second", "third", "fourth", "fifth", "sixth", "last").index(word)
    many = max(many, 1)
    start = max(len(ranked) - many, 0) if word == "last" else index
    end = min(start + many, len(ranked))
    tie = scene.units(RANK_TIE_M)
    while 0 < start < end and _level(ranked[start - 1], ranked[start], origin, tie):
        start -= 1
    while start < end < len(ranked) and _level(ranked[end - 1], ranked[end], origin, tie):
        end += 1
    return ranked[start:end]


def _level(one: Thing, other: Thing, origin: str, tie: float) -> bool:
    return abs(along(origin, one.item) - along(origin, other.item)) < tie

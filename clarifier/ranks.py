"""Which of several things is the largest, the leftmost, the second: comparison by size and side.

What differs too little to tell is a tie: all that tie are kept, and nothing is chosen.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence

from clarifier.things import Thing
from scene.types import Scene, SceneObject

NEAR_TIE_M = 0.02
"""Distances that differ by less (metres) are a tie: ask."""
RANK_TIE_M = 0.01
"""The same for those that are counted off from a side."""
SIZE_TIE = 1.05
"""Sizes whose ratio is less look the same size."""
SIZE_TIE_M = 0.002
"""So do those that differ by less (metres)."""

_MEASURES: dict[str, Callable[[SceneObject], float]] = {
    "big": lambda item: bulk(item),
    "small": lambda item: -bulk(item),
    "tall": lambda item: item.tall,
    "short": lambda item: -item.tall,
    "wide": lambda item: item.width,
    "narrow": lambda item: -item.width,
}


def bulk(item: SceneObject) -> float:
    """The side of the cube that takes as much room: how large a thing is (table units)."""
    return math.cbrt(item.width * item.height * item.tall)


def look_alike(one: float, other: float, scene: Scene) -> bool:
    """Whether nobody can see which of two sizes (table units) is the larger."""
    large, small = max(abs(one), abs(other)), min(abs(one), abs(other))
    return large < small * SIZE_TIE or large - small < scene.units(SIZE_TIE_M)


def by_size(size: str, found: list[Thing], scene: Scene, many: int = 1) -> list[Thing]:
    """The ``many`` largest (smallest, ...) of them, and those that are not clearly different from
    the last of these; ``many`` 0: those that stand out as large (small, ...)."""
    if not found:
        return found
    values = {thing.id: _MEASURES[size](thing.item) for thing in found}
    order = sorted(values.values(), reverse=True)
    last = order[min(many, len(order)) - 1] if many else _clear_step(order, scene)
    return [
        thing for thing in found
        if values[thing.id] >= last or look_alike(values[thing.id], last, scene)
    ]  # fmt: skip


def _clear_step(order: Sequence[float], scene: Scene) -> float:
    """The last value before the largest step down, relative to its size."""
    steps = [(max(abs(a), abs(b)) / min(abs(a), abs(b)), a, b)
             for a, b in itertools.pairwise(order)]  # fmt: skip
    _, value, after = max(steps, key=lambda step: step[0], default=(0.0, order[-1], order[-1]))
    return order[-1] if look_alike(value, after, scene) else value


def along(side: str, item: SceneObject) -> float:
    x, y = item.position
    return {"left": -x, "right": x, "far": y, "near": -y, "middle": -math.hypot(x, y)}[side]


def by_side(side: str, found: list[Thing], scene: Scene, many: int = 1) -> list[Thing]:
    """The ``many`` furthest to that side, and those within 2 cm of the last of these; ``many`` 0:
    all in that half of the table; tray objects have no side."""
    placed = [thing for thing in found if thing.item.x is not None]
    if many == 0:
        half = [thing for thing in placed if along(side, thing.item) > 0]
        return half if side != "middle" else placed
    if len(placed) <= many:
        return placed
    if side == "middle" and many == 1 and median(placed):
        return median(placed)
    order = sorted((along(side, thing.item) for thing in placed), reverse=True)
    tie = scene.units(NEAR_TIE_M)
    return [thing for thing in placed if along(side, thing.item) >= order[many - 1] - tie]


def median(placed: list[Thing]) -> list[Thing]:
    """The one in the middle of three, five, ... things; nothing for other numbers."""
    if len(placed) < 3 or len(placed) % 2 == 0:
        return []
    xs = [thing.item.position[0] for thing in placed]
    ys = [thing.item.position[1] for thing in placed]
    axis = 0 if max(xs) - min(xs) >= max(ys) - min(ys) else 1
    order = sorted(placed, key=lambda thing: thing.item.position[axis])
    return [order[len(order) // 2]]


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

"""Calls about where things are now, as words of `evals.goals`."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import combinations
from typing import ClassVar, Literal

from evals.calls import EXACT, TOLERANCE, Call, carriers, placed, share_ground
from evals.world import World
from scene import relations
from scene.relations import ALONG
from scene.types import Scene, SceneObject

SIDES = {"top": "above", "bottom": "below", "left": "left", "right": "right"}


class At(Call, frozen=True, tag="at"):
    """The centre is within ``tol`` of a point, or of a line where one coordinate is open."""

    id: str
    x: float | None = None
    y: float | None = None
    tol: float = 0.1

    def met(self, world: World) -> bool:
        x, y = placed(world, self.id).position
        dx = 0.0 if self.x is None else x - self.x
        dy = 0.0 if self.y is None else y - self.y
        return math.hypot(dx, dy) <= self.tol + EXACT


class OnTable(Call, frozen=True, tag="on_table"):
    id: str

    def met(self, world: World) -> bool:
        return relations.on_table(world.after.get(self.id))


class On(Call, frozen=True, tag="on"):
    """``a`` stands on or in one of ``b``; unless ``direct``, other things may be in between."""

    a: str
    b: str | tuple[str, ...]
    direct: bool = False

    def met(self, world: World) -> bool:
        wanted = {self.b} if isinstance(self.b, str) else set(self.b)
        below = list(carriers(world.after, world.after.get(self.a)))
        return bool(wanted & set(below[:1] if self.direct else below))


class InRegion(Call, frozen=True, tag="in_region"):
    """In a corner or at an edge: its own edge is within ``margin`` of the table's.

    About the centre: its middle is within ``margin`` of it, each way.
    """

    id: str
    region: Literal[
        "top_left", "top_right", "bottom_left", "bottom_right",
        "left_edge", "right_edge", "top_edge", "bottom_edge", "centre",
    ]  # fmt: skip
    margin: float | None = None

    def met(self, world: World) -> bool:
        item = placed(world, self.id)
        margin = world.after.units(relations.CORNER_M) if self.margin is None else self.margin
        if self.region == "centre":
            return max(map(abs, item.position)) <= margin + EXACT
        sides = [SIDES[word] for word in self.region.split("_") if word in SIDES]
        return all(relations.edge_distance(item, side) <= margin + EXACT for side in sides)


class Beside(Call, frozen=True):
    """``a`` lies in a direction from ``b``, ``across`` at most ``cone`` times ``along`` (1: 45°).

    ``min_gap`` and ``max_gap`` bound the gap along the axis, edge to edge. They share no ground.
    """

    direction: ClassVar[str]
    a: str
    b: str
    cone: float | None = 1.0
    min_gap: float | None = None
    max_gap: float | None = None

    def met(self, world: World) -> bool:
        (dx, dy), one, other = ALONG[self.direction], placed(world, self.a), placed(world, self.b)
        (x1, y1), (x2, y2) = one.position, other.position
        along, across = (x1 - x2) * dx + (y1 - y2) * dy, abs((x1 - x2) * dy + (y1 - y2) * dx)
        (w1, h1), (w2, h2) = relations.extents(one), relations.extents(other)
        gap = along - (w1 + w2 if dx else h1 + h2)
        inside = self.cone is None or across <= self.cone * along + EXACT
        wide = self.min_gap is None or gap >= self.min_gap - EXACT
        narrow = self.max_gap is None or gap <= self.max_gap + EXACT
        apart = along > TOLERANCE and not share_ground(one, other)
        return apart and inside and wide and narrow


class LeftOf(Beside, frozen=True, tag="left_of"):
    direction = "left"


class RightOf(Beside, frozen=True, tag="right_of"):
    direction = "right"


class Behind(Beside, frozen=True, tag="behind"):
    direction = "above"


class InFrontOf(Beside, frozen=True, tag="in_front_of"):
    direction = "below"


class Near(Call, frozen=True, tag="near"):
    """The gap, edge to edge, is at most ``max``; they neither share ground nor carry each other."""

    a: str
    b: str
    max: float = 0.3

    def met(self, world: World) -> bool:
        one, other = placed(world, self.a), placed(world, self.b)
        return not share_ground(one, other) and relations.gap(one, other) <= self.max + EXACT


class Far(Call, frozen=True, tag="far"):
    """The gap, edge to edge, is at least ``min``."""

    a: str
    b: str
    min: float = 0.8

    def met(self, world: World) -> bool:
        one, other = placed(world, self.a), placed(world, self.b)
        return relations.gap(one, other) >= self.min - EXACT


class NoOverlap(Call, frozen=True, tag="no_overlap"):
    """No two things that stand on the table itself share ground, unless they did before."""

    def met(self, world: World) -> bool:
        return _sharing(world.after) <= _sharing(world.before)


def _sharing(scene: Scene) -> set[tuple[str, str]]:
    standing = [item for item in scene.objects if relations.on_table(item)]
    return {(a.id, b.id) for a, b in combinations(standing, 2) if share_ground(a, b)}


class Aligned(Call, frozen=True, tag="aligned"):
    """A row shares one y, a column one x, ``any`` one line, by which each lies within ``tol``."""

    ids: tuple[str, ...]
    axis: Literal["row", "column", "any"] = "any"
    tol: float = 0.08

    def met(self, world: World) -> bool:
        items = [placed(world, name) for name in self.ids]
        if self.axis == "row":
            return relations.in_row(items, self.tol + EXACT)
        if self.axis == "column":
            return relations.in_column(items, self.tol + EXACT)
        return _off_line([item.position for item in items]) <= self.tol + EXACT


def _off_line(spots: Sequence[tuple[float, float]]) -> float:
    """How far the farthest spot is from the line that is nearest to all (least squares)."""
    x, y = sum(a for a, _ in spots) / len(spots), sum(b for _, b in spots) / len(spots)
    xx, yy = sum((a - x) ** 2 for a, _ in spots), sum((b - y) ** 2 for _, b in spots)
    angle = math.atan2(2 * sum((a - x) * (b - y) for a, b in spots), xx - yy) / 2
    return max(abs((b - y) * math.cos(angle) - (a - x) * math.sin(angle)) for a, b in spots)


class Triangle(Call, frozen=True, tag="triangle"):
    """The three centres span at least this area."""

    ids: tuple[str, str, str]
    min_area: float = 0.02

    def met(self, world: World) -> bool:
        (x1, y1), (x2, y2), (x3, y3) = (placed(world, name).position for name in self.ids)
        return abs((x2 - x1) * (y3 - y1) - (x3 - x1) * (y2 - y1)) / 2 >= self.min_area - EXACT


class Grouped(Call, frozen=True, tag="grouped"):
    """Each group hangs together by gaps of at most ``max_link``; groups stand further apart.

    Two groups are at least ``min_sep`` apart, and further than the widest gap that holds one.
    """

    groups: tuple[tuple[str, ...], ...]
    max_link: float = 0.4
    min_sep: float = 0.1

    def met(self, world: World) -> bool:
        groups = [[placed(world, name) for name in group] for group in self.groups]
        widest = max(_widest_link(group) for group in groups)
        apart = [
            relations.gap(one, other)
            for group, rest in combinations(groups, 2)
            for one in group
            for other in rest
        ]
        nearest = min(apart, default=math.inf)
        return widest <= self.max_link + EXACT and nearest > max(widest, self.min_sep - EXACT)


def _widest_link(group: Sequence[SceneObject]) -> float:
    """The widest gap that is needed to go from any of them to any other."""
    linked, rest, widest = list(group[:1]), list(group[1:]), 0.0
    while rest:
        width, nearest = min(
            ((relations.gap(one, other), other) for one in linked for other in rest),
            key=lambda link: link[0],
        )
        widest = max(widest, width)
        linked.append(nearest)
        rest.remove(nearest)
    return widest

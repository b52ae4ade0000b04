"""Calls about what changed between two scenes, and where the tool went: words of `evals.goals`."""

from __future__ import annotations

import math
from typing import Literal

import msgspec

from evals.calls import EXACT, Call
from evals.world import World
from scene import relations
from scene.relations import ALONG
from scene.types import Scene, SceneObject

DIRECTIONS = {"back": "above", "front": "below", "left": "left", "right": "right"}
TURNED = math.radians(12)
"""What a thing that stays where it is may turn by, at the most."""


class Point(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A point of the table."""

    x: float
    y: float


class Thing(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """An object, by its id."""

    id: str


def _shift(world: World, name: str) -> tuple[float, float]:
    (x1, y1), (x2, y2) = world.before.get(name).position, world.after.get(name).position
    return x2 - x1, y2 - y1


def _centres(scene: Scene, one: str, other: str) -> float:
    return math.dist(scene.get(one).position, scene.get(other).position)


class Still(Call, frozen=True, tag="still"):
    """These stayed within ``tol`` of where they were, and turned by less than 12 degrees."""

    ids: tuple[str, ...]
    tol: float = 0.03

    def met(self, world: World) -> bool:
        pairs = [(world.before.get(name), world.after.get(name)) for name in self.ids]
        turns = [math.remainder(after.r - before.r, math.tau) for before, after in pairs]
        there = all(relations.moved(*pair, self.tol) == 0 for pair in pairs)
        return there and all(abs(turn) < TURNED for turn in turns)


class OthersStill(Call, frozen=True, tag="others_still", rename={"spared": "except"}):
    """Nothing but these moved."""

    spared: tuple[str, ...] = ()
    tol: float = 0.03

    def met(self, world: World) -> bool:
        ids = tuple(item.id for item in world.before if item.id not in self.spared)
        return Still(ids=ids, tol=self.tol).met(world)


class NothingMoved(Call, frozen=True, tag="nothing_moved"):
    tol: float = 0.02

    def met(self, world: World) -> bool:
        return OthersStill(tol=self.tol).met(world)


class Moved(Call, frozen=True, tag="moved"):
    id: str
    min: float = 0.04

    def met(self, world: World) -> bool:
        pair = world.before.get(self.id), world.after.get(self.id)
        return relations.moved(*pair) >= self.min - EXACT


class MovedDir(Call, frozen=True, tag="moved_dir"):
    """It moved by ``min`` to ``max`` that way; sideways a third of it, or 0.08, at the most."""

    id: str
    dir: Literal["left", "right", "back", "front"]
    min: float = 0.04
    max: float = math.inf

    def met(self, world: World) -> bool:
        (dx, dy), (x, y) = ALONG[DIRECTIONS[self.dir]], _shift(world, self.id)
        along, across = x * dx + y * dy, abs(x * dy + y * dx)
        straight = across <= max(along / 3, 0.08) + EXACT
        return self.min - EXACT <= along <= self.max + EXACT and straight


class MovedDist(Call, frozen=True, tag="moved_dist"):
    id: str
    dist: float
    tol: float = 0.08

    def met(self, world: World) -> bool:
        return abs(math.hypot(*_shift(world, self.id)) - self.dist) <= self.tol + EXACT


class MovedToward(Call, frozen=True, tag="moved_toward"):
    """It moved by at least ``min``, within ``angle`` degrees of the straight way to a point."""

    id: str
    to: Point
    min: float = 0.05
    angle: float = 35

    def met(self, world: World) -> bool:
        x, y = world.before.get(self.id).position
        dx, dy = _shift(world, self.id)
        off = math.atan2(self.to.y - y, self.to.x - x) - math.atan2(dy, dx)
        aimed = abs(math.remainder(off, math.tau)) <= math.radians(self.angle) + EXACT
        return aimed and math.hypot(dx, dy) >= self.min - EXACT


class Closer(Call, frozen=True, tag="closer"):
    """The centres are nearer to each other than they were, by at least ``min``."""

    a: str
    b: str
    min: float = 0.04

    def met(self, world: World) -> bool:
        before, after = (_centres(scene, self.a, self.b) for scene in (world.before, world.after))
        return before - after >= self.min - EXACT


class Farther(Call, frozen=True, tag="farther"):
    """The centres are further from each other than they were, by at least ``min``."""

    a: str
    b: str
    min: float = 0.04

    def met(self, world: World) -> bool:
        before, after = (_centres(scene, self.a, self.b) for scene in (world.before, world.after))
        return after - before >= self.min - EXACT


class Visited(Call, frozen=True, tag="visited"):
    """The tool stopped within ``tol`` of each object's footprint, as it stood at first."""

    points: tuple[Thing, ...]
    where: Literal["waypoints"]
    tol: float = 0.06

    def met(self, world: World) -> bool:
        things = [world.before.get(point.id) for point in self.points]
        return all(
            any(_beyond(item, stop.x, stop.y) <= self.tol + EXACT for stop in world.path)
            for item in things
        )


def _beyond(item: SceneObject, x: float, y: float) -> float:
    """How far the point is from the footprint; 0 inside."""
    (x1, y1), (half_x, half_y) = item.position, relations.extents(item)
    return math.hypot(max(0.0, abs(x - x1) - half_x), max(0.0, abs(y - y1) - half_y))

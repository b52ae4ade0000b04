"""What goes wrong on a real table, for the simulated arms: seeded, switched on by who makes them.

A cup that does not seal, a thing that slips off while it is carried (`Mishaps`, asked by the arm),
and an eye that sees things a little beside where they are (`Haze`, put before a scene's source).
"""

from __future__ import annotations

import math
import random

import msgspec

from scene.types import Scene, SceneObject

AT_REST = 0.0005
"""What moved by no more since the first look is at rest (table units; 0.1 mm)."""


class Mishaps:
    """``unsealed``: share of grips that take hold of nothing; ``slips``: share of carrying motions
    on which the thing is lost. Same seed, same mishaps. Not thread-safe: an arm's own."""

    def __init__(self, seed: int = 0, unsealed: float = 0.0, slips: float = 0.0) -> None:
        self._chance = random.Random(f"mishaps {seed}")
        self._unsealed, self._slips = unsealed, slips

    def seals(self) -> bool:
        """Whether the cup seals this time."""
        return self._chance.random() >= self._unsealed

    def slips(self) -> float | None:
        """After which share of this carrying motion the thing slips off; None: it does not."""
        if self._chance.random() >= self._slips:
            return None
        return self._chance.random()


NONE = Mishaps()
"""Nothing goes wrong."""


class Haze:
    """An eye's error: positions of what stands, normal with ``mm`` along x and along y.

    A look is ``frames`` pictures with errors of their own. What is seen is the mean of all looks at
    a table on which nothing moved meanwhile. ``looks``: how many were taken. Not thread-safe: an
    arm's own.
    """

    def __init__(self, seed: int = 0, mm: float = 0.0, frames: int = 1) -> None:
        self._chance = random.Random(f"haze {seed}")
        self._metres, self._frames = mm / 1000, frames
        self._table, self._off, self._watched = Scene(), dict[str, tuple[float, float]](), 0
        self.looks = 0

    def __call__(self, scene: Scene) -> Scene:
        """The scene as it is seen."""
        self.looks += 1
        spread = scene.units(self._metres)
        if spread == 0:
            return scene
        if not _rested(self._table, scene):
            self._table, self._off, self._watched = scene, {}, 0
        self._watched += 1
        seen = tuple(self._seen(item, spread) for item in scene.objects)
        return msgspec.structs.replace(scene, objects=seen)

    def sd(self) -> dict[str, float]:
        """By id the standard deviation of x and of y in what was seen last (table units)."""
        if not self._watched:
            return {}
        spread = self._table.units(self._metres) / math.sqrt(self._frames * self._watched)
        return {item.id: spread for item in self._table.objects}

    def _seen(self, item: SceneObject, spread: float) -> SceneObject:
        (x, y), (dx, dy) = item.position, self._off.get(item.id, (0.0, 0.0))
        dx, dy = dx + self._mean(spread), dy + self._mean(spread)
        self._off[item.id] = dx, dy
        return msgspec.structs.replace(item, x=x + dx / self._watched, y=y + dy / self._watched)

    def _mean(self, spread: float) -> float:
        return sum(self._chance.gauss(0.0, spread) for _ in range(self._frames)) / self._frames


def _rested(before: Scene, now: Scene) -> bool:
    """Whether nothing moved meanwhile, but for what an engine does to things at rest."""
    pairs = zip(before.objects, now.objects, strict=False)
    return len(before.objects) == len(now.objects) and all(
        (one.id, one.held, one.on) == (other.id, other.held, other.on)
        and math.dist((*one.position, one.z), (*other.position, other.z)) <= AT_REST
        for one, other in pairs
    )

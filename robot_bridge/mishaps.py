"""What goes wrong on a real table, for the simulated arms: seeded, switched on by who makes them.

A cup that does not seal, a thing that slips off while it is carried (`Mishaps`, asked by the arm),
and an eye that sees things a little beside where they are (`Haze`, put before a scene's source).
"""

from __future__ import annotations

import random

import msgspec

from scene.types import Scene, SceneObject


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

    Each call is a look of its own; a look is the mean of ``frames`` pictures with errors of their
    own, as of a table that is watched while nothing moves. Not thread-safe.
    """

    def __init__(self, seed: int = 0, mm: float = 0.0, frames: int = 1) -> None:
        self._chance = random.Random(f"haze {seed}")
        self._metres, self._frames = mm / 1000, frames

    def __call__(self, scene: Scene) -> Scene:
        """The scene as it is seen."""
        spread = scene.units(self._metres)
        if spread == 0:
            return scene
        seen = tuple(self._seen(item, spread) for item in scene.objects)
        return msgspec.structs.replace(scene, objects=seen)

    def _seen(self, item: SceneObject, spread: float) -> SceneObject:
        x, y = item.position
        return msgspec.structs.replace(item, x=x + self._mean(spread), y=y + self._mean(spread))

    def _mean(self, spread: float) -> float:
        return sum(self._chance.gauss(0.0, spread) for _ in range(self._frames)) / self._frames

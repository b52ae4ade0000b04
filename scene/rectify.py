"""A picture rectified to the table: what the detector's network sees (pure numpy).

A square of the table about its middle, at a fixed scale, far side up; where the picture shows
nothing of it, black. Two more planes say from where it is seen.
"""

from __future__ import annotations

import functools
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene.sight import Pixels, View

Planes = NDArray[np.float32]
BRIGHTEST = 4.0
"""Colours are no brighter than so many times the mean."""


class Grid(NamedTuple):
    """``size`` pixels a side of ``mm`` each; ``table_m`` is the table's side (two table units)."""

    size: int
    mm: float
    table_m: float = 0.40

    @property
    def pixel(self) -> float:
        """Table units in a pixel."""
        return self.mm / (500 * self.table_m)

    def points(self) -> NDArray[np.float64]:
        """The points of the table (size * size, 2; table units) at the pixels, row by row."""
        steps = (np.arange(self.size) - (self.size - 1) / 2) * self.pixel
        x, y = np.meshgrid(steps, -steps)
        return np.column_stack([x.ravel(), y.ravel()])

    def at(self, u: NDArray[np.float64], v: NDArray[np.float64]) -> NDArray[np.float64]:
        """The points of the table (n, 2; table units) at columns u and rows v."""
        middle = (self.size - 1) / 2
        return np.column_stack([(u - middle) * self.pixel, (middle - v) * self.pixel])


def rectified(pixels: Pixels, view: View, grid: Grid) -> Pixels:
    """The table in a picture (height, width, 3): (size, size, 3) uint8, bilinear."""
    height, width = pixels.shape[:2]
    neighbours, weights, outside = _warp(
        np.ascontiguousarray(view.homography, np.float64).tobytes(), grid, height, width
    )
    total = np.zeros((3, grid.size**2), np.uint16)
    for channel, sums in enumerate(total):  # each by itself: whole rows are faster than threes
        plane = np.ascontiguousarray(pixels[..., channel]).ravel()
        for neighbour, weight in zip(neighbours, weights, strict=True):
            sums += plane.take(neighbour, mode="clip") * weight
    total >>= 8
    total[:, outside] = 0
    level: Pixels = np.ascontiguousarray(total.T, np.uint8).reshape(grid.size, grid.size, 3)
    return level


@functools.lru_cache(maxsize=8)
def _warp(
    homography: bytes, grid: Grid, height: int, width: int
) -> tuple[NDArray[np.int64], NDArray[np.uint16], NDArray[np.bool_]]:
    """For each pixel wanted: its four neighbours, their weights of 256, whether it is outside.

    A camera that stays where it is asks for the same again and again. Sixteenths of a pixel are
    fine enough, and let whole numbers of 16 bits do.
    """
    view = View(np.frombuffer(homography).reshape(3, 3), (0.0, 0.0, 1.0))
    u, v = view.pixels(grid.points()).T
    outside = (u < -0.5) | (v < -0.5) | (u > width - 0.5) | (v > height - 0.5)
    u, v = np.clip(u, 0, width - 1.001), np.clip(v, 0, height - 1.001)
    left, top = np.floor(u).astype(np.int64), np.floor(v).astype(np.int64)
    a, b = (np.rint(16 * part).astype(np.uint16) for part in (u - left, v - top))
    weights = np.stack([(16 - a) * (16 - b), a * (16 - b), (16 - a) * b, a * b])
    corner = top * width + left
    return corner + np.array([[0], [1], [width], [width + 1]]), weights, outside


def planes(level: Pixels, camera: tuple[float, float, float], grid: Grid) -> Planes:
    """The network's input (5, size, size): colours, and how what stands there leans.

    Colours are divided by the picture's mean, so that half the light looks the same. A point at
    height z above (x, y) is seen as if it lay on the table at ``lean * z / (1 - z / camera z)``
    from there: the last two planes are that lean to the right and downwards.
    """
    given = np.empty((5, *level.shape[:2]), np.float32)
    parts = [np.ascontiguousarray(level[..., channel]) for channel in range(3)]
    shown = (parts[0] | parts[1] | parts[2]) != 0
    total = sum(int(np.add.reduce(part, axis=None, dtype=np.uint32)) for part in parts)
    bright = total / (3 * max(1, int(np.count_nonzero(shown))))
    relative = np.clip(np.arange(256, dtype=np.float32) / max(bright, 1.0), 0, BRIGHTEST)
    for plane, part in zip(given, parts, strict=False):
        np.take(relative, part, out=plane, mode="clip")
        plane -= shown
    steps = (np.arange(grid.size, dtype=np.float32) - (grid.size - 1) / 2) * grid.pixel
    x, y, z = camera
    given[3], given[4] = (steps - x) / z, ((steps + y) / z)[:, None]
    return given

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
    corner, weights, outside = _warp(view.homography.tobytes(), grid, height, width)
    flat = np.ascontiguousarray(pixels).reshape(-1, 3)
    result = np.zeros((grid.size**2, 3), np.float32)
    for step, weight in zip((0, 1, width, width + 1), weights, strict=True):
        result += weight[:, None] * flat[corner + step]
    result[outside] = 0
    level: Pixels = (result + 0.5).astype(np.uint8).reshape(grid.size, grid.size, 3)
    return level


@functools.lru_cache(maxsize=8)
def _warp(
    homography: bytes, grid: Grid, height: int, width: int
) -> tuple[NDArray[np.int64], Planes, NDArray[np.bool_]]:
    """For each pixel wanted: the upper left of four neighbours, their weights, whether outside.

    A camera that stays where it is asks for the same again and again.
    """
    view = View(np.frombuffer(homography).reshape(3, 3), (0.0, 0.0, 1.0))
    u, v = view.pixels(grid.points()).T
    outside = (u < -0.5) | (v < -0.5) | (u > width - 0.5) | (v > height - 0.5)
    u, v = np.clip(u, 0, width - 1.001), np.clip(v, 0, height - 1.001)
    left, top = np.floor(u).astype(np.int64), np.floor(v).astype(np.int64)
    a, b = u - left, v - top
    weights = np.stack([(1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b])
    return top * width + left, weights.astype(np.float32), outside


def planes(level: Pixels, camera: tuple[float, float, float], grid: Grid) -> Planes:
    """The network's input (5, size, size): colours, and how what stands there leans.

    Colours are divided by the picture's mean, so that half the light looks the same. A point at
    height z above (x, y) is seen as if it lay on the table at ``lean * z / (1 - z / camera z)``
    from there: the last two planes are that lean to the right and downwards.
    """
    colors = level.astype(np.float32).transpose(2, 0, 1)
    shown = level.any(2)
    bright = float(colors.sum() / (3 * max(1, int(shown.sum()))))
    colors = np.clip(colors / max(bright, 1.0), 0, 4) - shown
    steps = (np.arange(grid.size, dtype=np.float32) - (grid.size - 1) / 2) * grid.pixel
    x, y, z = camera
    right = np.broadcast_to((steps - x) / z, level.shape[:2])
    down = np.broadcast_to(((steps + y) / z)[:, None], level.shape[:2])
    return np.concatenate([colors, right[None], down[None]]).astype(np.float32)

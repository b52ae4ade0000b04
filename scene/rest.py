"""Whether a thing rests where it was: its borders in one picture against the same in another.

From a camera that stays where it is, what rests looks the same, but for noise and light. So the
borders of a thing, and what is drawn on it, are kept as samples of brightness with their slopes; by
least squares these tell how far the whole has gone (Lucas and Kanade 1981), far more exactly than
a detector tells where it is. What stands before it now, or in it, changes some samples: they count
little (iterated weights), but what is left must still hold the thing in every direction.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene import opencv
from scene.contour import window
from scene.outline import beyond
from scene.sight import Pixels, View

Floats = NDArray[np.float64]
MOST, FEWEST = 320, 60
"""Samples that are kept, and that are needed."""
STEEP = 6.0
"""Slope of a border (brightness, of 255, from a pixel to the next)."""
RIM = 1.5
"""How far beyond its outline a thing's border may be (pixels)."""
ALIKE = 10.0
"""Difference of brightness at which a sample counts half."""
HELD = 0.6
"""Share of what the samples tell in any direction that those that are alike must tell."""
TURNS = 3
"""Times that samples are weighed anew."""
FLATTEST = 1e6
"""Slopes that tell so much more of one direction than of another tell nothing of that."""
LITTLE = 1e-6 * np.eye(4)
MOST_LIGHT = np.array([np.inf, np.inf, 32.0, 16.0])
"""By how much light may change the brightness of a half-bright sample, and of a black one: of what
is gone all that is left would be explained by darkness."""


class Borders(NamedTuple):
    """A thing's borders as they looked: ``value`` (n,), the mean of nine pixels of one channel,
    whose numbers in the flat picture are ``near`` (9, n); ``told`` (4, n), by how much more it is
    if all goes a pixel right or down, in more light, in a veil; ``whiten`` (2, 2), by which what
    all tell together is the same in all directions. ``pixel``: its side on the table (table units);
    ``size`` of the picture (numbers in it)."""

    near: NDArray[np.intp]
    value: Floats
    told: Floats
    whiten: Floats
    pixel: float
    size: int


def borders(
    pixels: Pixels, view: View, outline: Floats, others: Sequence[Floats]
) -> Borders | None:
    """The borders of a thing of that outline, without what is of ``others`` (supports as of
    `scene.outline`); None where there are too few."""
    cut = window(pixels, view, outline, 0.0)
    if cut is None:
        return None
    inside = beyond(cut.points, outline) < RIM * cut.pixel
    middle = (outline[: len(outline) // 2] - outline[len(outline) // 2 :]) / 2
    for other in others:
        if not _within(middle, other):
            inside &= beyond(cut.points, other) > RIM * cut.pixel
    # of a large thing each second, third ... pixel says where it is steep; samples are of all
    smooth = opencv.boxed(cut.patch.astype(np.float32), 3) / 9
    slopes = np.zeros((2, *smooth.shape), np.float32)
    slopes[0, :, 1:-1] = (smooth[:, 2:] - smooth[:, :-2]) / 2 / cut.step
    slopes[1, 1:-1] = (smooth[2:] - smooth[:-2]) / 2 / cut.step
    inside[[0, -1]] = inside[:, [0, -1]] = False
    steep = (slopes**2).sum(0) > STEEP**2
    v, u, channel = np.nonzero(steep & inside[..., None])
    if len(v) < FEWEST:
        return None
    kept = np.linspace(0, len(v) - 1, min(MOST, len(v))).astype(np.intp)
    v, u, channel = v[kept], u[kept], channel[kept]
    return _sampled(
        pixels, (cut.low[0] + cut.step * u, cut.low[1] + cut.step * v, channel), cut.pixel
    )


def _within(middle: Floats, outline: Floats) -> bool:
    """Whether a point, told by its supports in half of the directions, is inside of an outline."""
    half = len(middle)
    return bool((middle < outline[:half]).all() and (-middle < outline[half:]).all())


def _sampled(pixels: Pixels, where: tuple[NDArray[np.intp], ...], pixel: float) -> Borders | None:
    """The samples at columns, rows and channels; None where they tell nothing of some direction."""
    height, width = pixels.shape[:2]
    u, v, channel = where[0].clip(2, width - 3), where[1].clip(2, height - 3), where[2]
    square = np.array([[3 * (width * row + column)] for row in (-1, 0, 1) for column in (-1, 0, 1)])
    near = (v * width + u) * 3 + channel + square
    flat = pixels.reshape(-1)

    def mean(off: int) -> Floats:
        return np.asarray(flat.take(near + 3 * off).mean(0), np.float64)

    value = mean(0)
    right, down = (mean(1) - mean(-1)) / 2, (mean(width) - mean(-width)) / 2
    told = np.stack([-right, -down, value / 128, np.ones_like(value)])
    full = told[:2] @ told[:2].T
    if np.linalg.cond(full) > FLATTEST:
        return None
    whiten: Floats = np.asarray(np.linalg.inv(np.linalg.cholesky(full)), np.float64)
    return Borders(near, value, told, whiten, pixel, flat.size)


def gone(one: Borders, pixels: Pixels) -> tuple[float, float] | None:
    """How far the borders have gone in another picture (pixels to the right and down), if no
    further than a pixel or two; None where they are not seen any more, or too little of them."""
    if pixels.size != one.size:
        return None
    off = pixels.reshape(-1).take(one.near).mean(0) - one.value
    weight = 1 / (1 + (off / ALIKE) ** 2)
    way: Floats = np.zeros(4)
    for _ in range(TURNS):
        heavy = one.told * weight
        way = np.linalg.solve(heavy @ one.told.T + LITTLE, heavy @ off)
        way = np.minimum(np.maximum(way, -MOST_LIGHT), MOST_LIGHT)
        weight = 1 / (1 + ((off - way @ one.told) / ALIKE) ** 2)
    ways = one.told[:2]
    left = one.whiten @ ((ways * weight) @ ways.T) @ one.whiten.T
    held = float(np.linalg.eigvalsh(left)[0])
    return (float(way[0]), float(way[1])) if held > HELD else None

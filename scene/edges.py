"""A marker's corners from its four straight sides, which says more than the corners' own pixels.

Blur rounds corners and draws them inwards (a marker of 45 pixels looks 2 % too small by
cornerSubPix); sides stay where they are. Edge points are undistorted first, so that sides are
straight. Pure.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from scene.opencv import Gray
from scene.sight import Points

ALONG, STEP = 32, 0.5
"""Points along a side, and pixels between those of the profile through each."""
CELLS = 6
"""Cells across a marker, its black border included."""
REACH = 0.8
"""How far a profile reaches to both sides, of a cell: beyond lie other cells and other paper."""


def corners(brightness: Gray, rough: Points, flat: Callable[[Points], Points]) -> Points:
    """A marker's corners (4, 2) in the undistorted picture, from rough ones in the raw one.

    ``flat`` undistorts pixels (n, 2). A side that cannot be made out keeps its rough corners.
    """
    sides = [_side(brightness, rough[n], rough[(n + 1) % 4], flat) for n in range(4)]
    found = flat(rough)
    for n in range(4):
        before, after = sides[n - 1], sides[n]
        if before is not None and after is not None:
            found[n] = np.linalg.solve(np.array([before[:2], after[:2]]), [before[2], after[2]])
    return found


def _side(
    brightness: Gray, start: Points, end: Points, flat: Callable[[Points], Points]
) -> Points | None:
    """The line (a, b, c: a u + b v = c) of a side in the undistorted picture."""
    way = end - start
    long = float(np.linalg.norm(way))
    outwards = np.array([way[1], -way[0]]) / long  # clockwise in a picture: outside is left
    on = start + np.linspace(0.1, 0.9, ALONG)[:, None] * way
    reach = REACH * long / CELLS
    steps = np.linspace(-reach, reach, 2 * math.ceil(reach / STEP) + 1)
    profiles = _sampled(brightness, on[:, None, :] + steps[:, None] * outwards)
    where = _crossing(profiles, steps)
    good = np.isfinite(where)
    if good.sum() < ALONG // 2:
        return None
    return _line(flat(on[good] + where[good, None] * outwards))


def _crossing(profiles: Points, steps: Points) -> Points:
    """Where each profile (n, m) from dark to bright is halfway (n,); NaN where it is none."""
    third = len(steps) // 4
    dark, bright = profiles[:, :third].mean(axis=1), profiles[:, -third:].mean(axis=1)
    half = (dark + bright) / 2
    above = profiles > half[:, None]
    rises = ~above[:, :-1] & above[:, 1:]
    at = np.argmin(np.where(rises, np.abs(steps[:-1]), np.inf), axis=1)  # the nearest one
    rows = np.arange(len(profiles))
    low, high = profiles[rows, at], profiles[rows, at + 1]
    share = (half - low) / np.where(high > low, high - low, 1.0)
    usable = (bright - dark > 20) & rises.any(axis=1)
    return np.where(usable, steps[at] + share * (steps[1] - steps[0]), np.nan)


def _line(points: Points) -> Points:
    """The line through points (n, 2) by total least squares, twice: then without outliers."""
    kept = points
    for _ in range(2):
        middle = kept.mean(axis=0)
        normal = np.linalg.svd(kept - middle)[2][1]
        off = np.abs((points - middle) @ normal)
        kept = points[off <= max(0.05, 3 * float(np.median(off)))]
    return np.array([normal[0], normal[1], float(normal @ middle)])


def _sampled(brightness: Gray, places: Points) -> Points:
    """Brightness between pixels (..., 2), bilinear; at the border its nearest."""
    high, wide = brightness.shape
    u = np.clip(places[..., 0], 0, wide - 1.001)
    v = np.clip(places[..., 1], 0, high - 1.001)
    left, top = u.astype(int), v.astype(int)
    right, down = u - left, v - top
    above = brightness[top, left] * (1 - right) + brightness[top, left + 1] * right
    below = brightness[top + 1, left] * (1 - right) + brightness[top + 1, left + 1] * right
    return np.asarray(above * (1 - down) + below * down)

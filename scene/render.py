"""A picture of solids on a table, by ray casting in numpy: Lambert, one sun, its shadows (pure).

Every pixel is a point (x, y) of the table's surface that the camera looks at through it; so the
same function draws a camera's picture and one rectified to the table. Lengths are table units.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene.shapes import Paint
from scene.sight import View
from scene.solids import MISS, Array, Solid, blocked, corners, hit

NOTHING = -1
"""Owner of a pixel that shows the table."""


class Standing(NamedTuple):
    """A thing where it stands: solids in the table's frame, the paints they wear, its place."""

    solids: tuple[Solid, ...]
    paints: tuple[Paint, ...]
    x: float
    y: float
    yaw: float
    size: tuple[float, float, float]


class Light(NamedTuple):
    """``sun`` points to it (length 1); colours are linear RGB; ``soft``: the shadows' blur (px).

    ``even``: how much of the sky's light falls on what does not face it; ``casts``: whether there
    are shadows.
    """

    sun: tuple[float, float, float]
    sunshine: tuple[float, float, float]
    sky: tuple[float, float, float]
    soft: float
    even: float = 0.6
    casts: bool = True


class Drawn(NamedTuple):
    """``pixels`` (height, width, 3) linear RGB, unbounded; ``owners`` (height, width): which thing.

    ``shares`` (n): how much of each thing is not hidden; ``boxes`` (n, 4): left, top, right, bottom
    of all of it, hidden or not, in pixels; NaN where nothing of it is in the picture.
    """

    pixels: Array
    owners: NDArray[np.int16]
    shares: Array
    boxes: Array


def looked_at(view: View, width: int, height: int) -> Array:
    """The points of the table (2, height, width) that the pixels of a picture show."""
    back = np.linalg.inv(view.homography)
    u, v = np.arange(width), np.arange(height)[:, None]
    x, y, w = (row[0] * u + (row[1] * v + row[2]) for row in back)
    return np.stack([x / w, y / w]).astype(np.float32)


def draw(
    things: Sequence[Standing],
    view: View,
    points: Array,
    ground: Array,
    light: Light,
) -> Drawn:
    """The picture of things on ``ground`` (height, width, 3; linear RGB of the bare table).

    ``points`` (2, height, width) is `looked_at` of the view.
    """
    camera = np.array(view.camera, np.float32)
    sight = np.stack([points[0] - camera[0], points[1] - camera[1],
                      np.full(points.shape[1:], -camera[2], np.float32)])  # fmt: skip
    shape = points.shape[1:]
    depth, normal = np.ones(shape, np.float32), np.zeros((3, *shape), np.float32)
    normal[2] = 1
    owners, wearing = np.full(shape, NOTHING, np.int16), np.zeros(shape, np.int16)
    totals, boxes = np.zeros(len(things)), np.full((len(things), 4), np.nan, np.float32)
    for index, thing in enumerate(things):
        covered = np.zeros(shape, bool)
        for solid in thing.solids:
            rows, columns = _window(view, _seen_from(camera, corners(solid)), shape)
            if rows.start >= rows.stop or columns.start >= columns.stop:
                continue
            here = (rows, columns)
            t, facing = hit(solid, camera[:, None, None], sight[(slice(None), *here)])
            covered[here] |= t < MISS
            front = t < depth[here]
            depth[here] = np.where(front, t, depth[here])
            owners[here] = np.where(front, index, owners[here])
            wearing[here] = np.where(front, solid.paint, wearing[here])
            normal[(slice(None), *here)] = np.where(front, facing, normal[(slice(None), *here)])
        totals[index] = covered.sum()
        boxes[index] = _extent(covered)
    place = (camera[:, None, None] + sight * depth).astype(np.float32)
    albedo, shine = _painted(things, ground, owners, wearing, place)
    lit = np.ones(shape, np.float32)
    if light.casts:
        lit -= _shadows(things, view, place, normal, light)
    pixels = _lighted(albedo, shine, normal, sight, lit, light)
    seen = np.bincount(owners[owners >= 0].ravel(), minlength=len(things))
    return Drawn(pixels, owners, (seen / np.maximum(totals, 1)).astype(np.float32), boxes)


def _seen_from(camera: Array, spots: Array) -> Array:
    """Where points (3, n) below the camera appear on the table: (n, 2)."""
    height = np.minimum(spots[2], 0.95 * camera[2])
    spread = camera[2] / (camera[2] - height)
    flat: Array = (camera[:2, None] + (spots[:2] - camera[:2, None]) * spread).T
    return flat


def _window(view: View, flat: Array, shape: tuple[int, ...]) -> tuple[slice, slice]:
    """Rows and columns of a picture that hold these points of the table (n, 2)."""
    seen = view.pixels(flat.astype(np.float64))
    low, high = np.floor(seen.min(0)).astype(int) - 1, np.ceil(seen.max(0)).astype(int) + 2
    rows = slice(max(0, low[1]), max(0, min(shape[0], high[1])))
    return rows, slice(max(0, low[0]), max(0, min(shape[1], high[0])))


def _extent(covered: NDArray[np.bool_]) -> tuple[float, float, float, float]:
    rows, columns = np.flatnonzero(covered.any(1)), np.flatnonzero(covered.any(0))
    if not len(rows):
        return (np.nan,) * 4
    return columns[0] - 0.5, rows[0] - 0.5, columns[-1] + 0.5, rows[-1] + 0.5


def _painted(
    things: Sequence[Standing],
    ground: Array,
    owners: NDArray[np.int16],
    wearing: NDArray[np.int16],
    place: Array,
) -> tuple[Array, Array]:
    """Linear colour (height, width, 3) and shine (height, width) of what each pixel shows."""
    albedo, shine = ground.copy(), np.zeros(owners.shape, np.float32)
    for index, thing in enumerate(things):
        mine = owners == index
        if not mine.any():
            continue
        rows, columns = np.nonzero(mine)
        worn, spots = wearing[rows, columns], place[:, rows, columns]
        cos, sin = np.cos(thing.yaw), np.sin(thing.yaw)
        x, y = spots[0] - thing.x, spots[1] - thing.y
        own = np.stack([(cos * x + sin * y) / thing.size[0], (cos * y - sin * x) / thing.size[1],
                        spots[2] / thing.size[2]])  # fmt: skip
        for number, paint in enumerate(thing.paints):
            those = worn == number
            if those.any():
                albedo[rows[those], columns[those]] = _pattern(paint, own[:, those])
                shine[rows[those], columns[those]] = paint.shine
    return albedo, shine


def _pattern(paint: Paint, own: Array) -> Array:
    """Linear colours (n, 3) at places (3, n) of a thing, in shares of its size."""
    first, second = (np.array(tone, np.float32) ** 2.2 for tone in (paint.first, paint.second))
    a = np.sin(2 * np.pi * paint.across * own[0] + 0.7)
    b = np.sin(2 * np.pi * paint.along * (own[1] + 0.6 * own[2]) + 1.9)
    mix = {
        "bands": (np.sin(2 * np.pi * paint.across * (own[0] + own[2])) > 0.3).astype(np.float32),
        "checks": (a * b > 0).astype(np.float32),
        "dots": (a + b > 1.2).astype(np.float32),
        "marble": np.clip(0.5 + 0.35 * (a + b * np.cos(3 * a)), 0, 1),
    }.get(paint.pattern)
    if mix is None:
        return np.broadcast_to(first, (own.shape[1], 3))
    blended: Array = first + mix[:, None] * (second - first)
    return blended


def _shadows(
    things: Sequence[Standing], view: View, place: Array, normal: Array, light: Light
) -> Array:
    """How much of the sun each pixel lacks, in [0, 1]."""
    shape = place.shape[1:]
    dark = np.zeros(shape, np.float32)
    sun = np.array(light.sun, np.float32)
    camera = np.array(view.camera, np.float32)
    for thing in things:
        for solid in thing.solids:
            spots = corners(solid)
            fallen = spots - sun[:, None] * (spots[2] / sun[2])
            flat = np.vstack([_seen_from(camera, spots), fallen[:2].T])
            here = _window(view, flat, shape)
            if here[0].start >= here[0].stop or here[1].start >= here[1].stop:
                continue
            start = place[(slice(None), *here)] + 3e-3 * normal[(slice(None), *here)]
            dark[here] = np.maximum(dark[here], blocked(solid, start, sun[:, None, None]))
    return smoothed(dark, light.soft) if light.soft > 0 else dark


def _lighted(
    albedo: Array, shine: Array, normal: Array, sight: Array, lit: Array, light: Light
) -> Array:
    sun = np.array(light.sun, np.float32)
    facing = np.clip(np.tensordot(sun, normal, 1), 0, None) * lit
    sky = (light.even + (1 - light.even) * normal[2])[..., None] * np.array(light.sky, np.float32)
    direct = np.array(light.sunshine, np.float32)
    lighted: Array = albedo * (sky + facing[..., None] * direct)
    rows, columns = np.nonzero(shine)
    way = sight[:, rows, columns]
    halfway = sun[:, None] - way / np.sqrt((way * way).sum(0))
    halfway /= np.sqrt((halfway * halfway).sum(0))
    mirrored = np.clip((halfway * normal[:, rows, columns]).sum(0), 0, 1) ** 30
    gloss = shine[rows, columns] * mirrored * lit[rows, columns]
    lighted[rows, columns] += gloss[:, None] * direct
    return lighted


def smoothed(plane: Array, sigma: float) -> Array:
    """A plane (height, width, ...) blurred by a Gaussian of this deviation (pixels)."""
    reach = max(1, int(np.ceil(2.5 * sigma)))
    steps = np.arange(-reach, reach + 1)
    weights = np.exp(-0.5 * (steps / sigma) ** 2).astype(np.float32)
    weights /= weights.sum()
    for axis in (0, 1):
        widths = [(0, 0)] * plane.ndim
        widths[axis] = (reach, reach)
        padded = np.pad(plane, widths, mode="edge")
        size = plane.shape[axis]
        total = np.zeros_like(plane)
        for step, weight in enumerate(weights):
            part = slice(step, step + size)
            total += weight * (padded[part] if axis == 0 else padded[:, part])
        plane = total
    return plane

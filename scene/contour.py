"""Where a thing ends in a picture, by its colours against those of the table around it.

The thing's own colours are learnt from its middle, the table's from a ring about it, where shadows
lie too: a shadow is the table's hue, darker, as a thing's side may be its own. What is neither is
the thing, where it is near. Its border is then set where a pixel is half of the one and half of the
other.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene import opencv
from scene.opencv import Floats, Mask
from scene.outline import COUNT, WAYS, beyond
from scene.sight import Pixels, View

Doubles = NDArray[np.float64]
WIDEST = 128
"""Pixels a side of a cut-out; of a larger one each second, third ... is looked at."""
LIGHT, HUES, STEP = 24, 24, 0.055
"""Cells by brightness, by each of two hues, and how wide the latter are (logs)."""
SHADE, SIDE = 0.35, 0.3
"""How much of the table about a thing may be in a shadow that the ring does not show; how much of
the thing in a shade that its middle does not show."""
STRANGE, COMMON = 2e-4, 0.5e-4
"""How dense colours are that neither the thing's middle nor the table shows: rather the thing's."""
FEWEST = 12, 60
"""Pixels of the middle, and of the ring, from which colours are learnt."""
PART = 0.12
"""A piece that holds less of the thing's middle is not of it."""
CONTRAST = 150.0
"""Squared difference of two colours below which a pixel is not divided between them."""
LEAST = 0.0, -1.0, -2.0, 2.0
"""How likely a pixel must be the thing's (a log), one after the other: at first what is neither is
the thing's, then so is what may well be the table's in a shadow, and in the end only what is
sure."""
SPUR = 2
"""So many pixels must lie as far out: one alone is noise."""
EDGE = 0.42
"""Pixels by which a contour lies beyond the middles of these."""
CUT = 0.4
"""Share of the border that may touch other things: where they do, no end is seen."""
_LOGS = np.log((np.arange(256) + 6) / 6.0)
_BRIGHTEST = float(_LOGS[-1])


class Contour(NamedTuple):
    """``reach``: how far the thing is seen to reach in each of `WAYS` (table units); ``pixel``: a
    pixel's side there. ``points`` (n, 2) of the table, and ``colors`` (n, 3) there: all inside.
    ``shown``: 1 in the ways in which its own end is seen, 0 where another thing cuts it off."""

    reach: Doubles
    pixel: float
    points: Doubles
    colors: Pixels
    shown: Doubles = np.ones(COUNT)


class Cut(NamedTuple):
    """A cut-out of a picture, of each ``step``-th pixel from column and row ``low`` on; the points
    of the table (h, w, 2) that it shows, and a pixel's side there (table units)."""

    patch: Pixels
    points: Doubles
    pixel: float
    low: tuple[int, int]
    step: int


class Room(NamedTuple):
    """Where a thing is looked for (table units): how far beyond its expected outline it may reach,
    how far its surroundings are looked at, and how far inside of it all is surely its own."""

    may: float
    ring: float
    core: float


def contours(
    pixels: Pixels, view: View, expected: Doubles, others: Sequence[Doubles], room: Room
) -> Iterator[Contour]:
    """Where a thing ends of which an outline is expected, with ``others`` near: by more and less of
    what is not known (`LEAST`). Nothing where it is unclear.

    Outlines are supports along `WAYS`, as `scene.outline.supports` gives them.
    """
    cut = window(pixels, view, expected, room.ring)
    if cut is None:
        return
    patch, points, pixel = cut.patch, cut.points, cut.pixel
    out = beyond(points, expected)
    foreign = np.zeros(out.shape, bool)
    for other in others:
        if _meet(expected + room.ring, other):
            foreign |= beyond(points, other) < min(pixel, room.may)
    own, near = out < -room.core, out < room.may
    foreign &= ~own
    ring = (out < room.ring) & (out > room.may / 2) & ~foreign
    if own.sum() < FEWEST[0] or ring.sum() < FEWEST[1]:
        return
    likely, before = _likely(patch, own, ring), list[Mask]()
    for least in LEAST:
        mask = _piece((likely > least) & near & ~foreign, own)
        if mask is not None and not any(np.array_equal(mask, other) for other in before):
            before.append(mask)
            mask = _parted(patch, mask)
            border = mask & ~_shrunk(mask)
            touches = (_grown(foreign) & border)[border]
            if border.sum() < 4 * SPUR or _at_end(mask) or touches.mean() > CUT:
                continue
            far = points[border] @ WAYS
            reach = np.partition(far, -SPUR, 0)[-SPUR]
            shown = np.ones(COUNT)
            if touches.any():
                shown[far[touches].max(0) > reach - pixel] = 0.0
            inside = mask & ~border
            yield Contour(reach + EDGE * pixel, pixel, points[inside], patch[inside], shown)


def _meet(one: Doubles, other: Doubles) -> bool:
    """Whether two outlines may overlap: no direction is seen that parts them."""
    half = len(other) // 2
    return bool((one[:half] + other[half:] > 0).all() and (one[half:] + other[:half] > 0).all())


def _at_end(mask: Mask) -> bool:
    """Whether the picture's end cuts off what is seen."""
    return bool(mask[0].any() or mask[-1].any() or mask[:, 0].any() or mask[:, -1].any())


def window(pixels: Pixels, view: View, expected: Doubles, ring: float) -> Cut | None:
    """What of a picture shows a thing of that outline, and so much around it; None: next to
    nothing does."""
    corners = _corners(expected + ring)
    seen = view.pixels(corners)
    height, width = pixels.shape[:2]
    low = np.maximum(np.floor(seen.min(0)).astype(int), 0)
    high = np.minimum(np.ceil(seen.max(0)).astype(int) + 1, (width, height))
    if (high - low < 8).any():
        return None
    step = -(-int((high - low).max()) // WIDEST)
    u, v = np.arange(low[0], high[0], step), np.arange(low[1], high[1], step)
    patch = np.ascontiguousarray(pixels[low[1] : high[1] : step, low[0] : high[0] : step])
    back = np.linalg.inv(view.homography)
    x, y, w = (row[0] * u + (row[1] * v[:, None] + row[2]) for row in back)
    points = np.stack([x / w, y / w], -1)
    middle = points[len(v) // 2, len(u) // 2 - 1 : len(u) // 2 + 1]
    pixel = float(np.linalg.norm(middle[1] - middle[0]))
    return Cut(patch, points, pixel, (int(low[0]), int(low[1])), step)


def _corners(reach: Doubles) -> Doubles:
    """The corners (4, 2) of the upright box that an outline fills."""
    quarter = len(reach) // 4
    right, up, left, down = reach[::quarter]
    return np.array([(right, up), (-left, up), (-left, -down), (right, -down)])


# --- colours ----------------------------------------------------------------------------------


def _likely(patch: Pixels, own: Mask, ring: Mask) -> Floats:
    """By how much (a log) a pixel is rather the thing's than the table's."""
    cells = _cells(patch)
    thing, table = _share(cells[own]), _share(cells[ring])
    thing = (1 - SIDE) * thing + SIDE * _darker(thing)
    behind = (1 - SHADE) * table + SHADE * _darker(table)
    logs = np.log(((thing + STRANGE) / (behind + COMMON)).astype(np.float32)).clip(-4, 4)
    return opencv.blurred(logs.ravel()[cells], 0.7)


def _darker(share: Doubles) -> Doubles:
    """The shares of the same hues in shade."""
    darker = _smooth(_smooth(np.cumsum(share[::-1], 0)[::-1] - share, (1, 2)), (1, 2))
    shade: Doubles = darker / max(float(darker.sum()), 1e-9)
    return shade


def _cells(patch: Pixels) -> NDArray[np.intp]:
    """The number of the cell of each pixel's colour."""
    red, green, blue = (_LOGS[patch[..., channel]] for channel in range(3))
    light = (red + green + blue) * (LIGHT / 3 / (_BRIGHTEST * 1.001))
    one, two = (
        np.clip((part - green) / STEP + HUES / 2, 0, HUES - 1).astype(np.intp)
        for part in (red, blue)
    )
    return (light.astype(np.intp) * HUES + one) * HUES + two


def _share(cells: NDArray[np.intp]) -> Doubles:
    """How dense colours are in each cell (LIGHT, HUES, HUES), smoothed."""
    counts = np.bincount(cells, minlength=LIGHT * HUES * HUES) / len(cells)
    return _smooth(counts.reshape(LIGHT, HUES, HUES), (0, 1, 2))


def _smooth(dense: Doubles, axes: tuple[int, ...]) -> Doubles:
    """Each cell with a half of itself and a quarter of both its neighbours."""
    for axis in axes:
        rows = np.moveaxis(dense, axis, 0)
        smooth = 0.5 * rows
        smooth[1:] += 0.25 * rows[:-1]
        smooth[:-1] += 0.25 * rows[1:]
        dense = np.moveaxis(smooth, 0, axis)
    return dense


# --- pieces and borders -----------------------------------------------------------------------


def _piece(mask: Mask, own: Mask) -> Mask | None:
    """The connected pieces that hold a good part of the thing's middle, whole; None: there is none.

    Specks and hairs are taken off first.
    """
    numbers = opencv.blobs(_grown(_shrunk(mask)))
    held = np.bincount(numbers[own], minlength=2)
    held[0] = 0
    if held.max() < PART * own.sum():
        return None
    return opencv.filled(np.isin(numbers, np.flatnonzero(held >= PART * own.sum())))


def _parted(patch: Pixels, mask: Mask) -> Mask:
    """The mask with its border where a pixel is half the thing's colour, half the table's."""
    colors = patch.astype(np.float32)
    inside, outside = _shrunk(mask), ~_grown(mask)
    thing, seen = _mean(colors, inside, 5)
    table, around = _mean(colors, outside, 7)
    apart = thing - table
    contrast = (apart * apart).sum(-1)
    share = ((colors - table) * apart).sum(-1) / np.maximum(contrast, 1.0)
    unsure = _grown(mask) & ~inside & seen & around & (contrast > CONTRAST)
    return opencv.filled(np.where(unsure, share > 0.5, mask))


def _mean(colors: Floats, where: Mask, side: int) -> tuple[Floats, Mask]:
    """The mean colour of the pixels near each that are ``where``, and whether there are any."""
    weight = where.astype(np.float32)
    count = opencv.boxed(weight, side)
    total = opencv.boxed(colors * weight[..., None], side)
    return np.asarray(total / np.maximum(count, 0.5)[..., None], np.float32), count > 0.5


def _grown(mask: Mask) -> Mask:
    """With the four neighbours of each pixel."""
    grown = mask.copy()
    grown[1:] |= mask[:-1]
    grown[:-1] |= mask[1:]
    grown[:, 1:] |= mask[:, :-1]
    grown[:, :-1] |= mask[:, 1:]
    return grown


def _shrunk(mask: Mask) -> Mask:
    """Without pixels that have a neighbour outside of it."""
    shrunk: Mask = ~_grown(~mask)
    return shrunk

"""A picture with what was seen in it: footprints and ids (pure; numpy alone draws lines)."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from scene.lean import seen_at
from scene.sight import Pixels, Points, View
from scene.types import Scene, SceneObject

Write = Callable[[Pixels, str, tuple[int, int], int], None]
"""Black text into a grey picture (height, width) at its lower left corner (u, v), so high."""

LINE = (255, 0, 200)
"""Colour of outlines and letters: one that few things have."""
LETTERS = 14
"""Height of letters (pixels)."""


def annotated(pixels: Pixels, scene: Scene, view: View, write: Write | None = None) -> Pixels:
    """A copy of an undistorted picture with the footprint of each thing on the table, and its id.

    Without ``write`` there are footprints alone.
    """
    picture = pixels.copy()
    for item in scene.objects:
        if item.x is None or item.on == "floor":
            continue
        corners = footprint(item, view)
        for start, end in zip(corners, np.roll(corners, -1, axis=0), strict=True):
            _line(picture, start, end)
        if write is not None:
            _letter(picture, item.id, corners, write)
    return picture


def footprint(item: SceneObject, view: View) -> Points:
    """Where the corners of a thing's footprint appear: (4, 2) pixels, going round."""
    x, y = item.position
    cos, sin = math.cos(item.r), math.sin(item.r)
    sides = ((-1, -1), (1, -1), (1, 1), (-1, 1))
    offsets = [(a * item.width / 2, b * item.height / 2) for a, b in sides]
    points = [(x + dx * cos - dy * sin, y + dx * sin + dy * cos) for dx, dy in offsets]
    leaning = [seen_at(point, max(item.z, 0.0), view.camera) for point in points]
    return view.pixels(np.array(leaning))


def _line(picture: Pixels, start: Points, end: Points) -> None:
    """A line two pixels wide; what lies outside the picture is left out."""
    height, width, _ = picture.shape
    steps = max(2, int(2 * np.abs(end - start).max()))
    along = np.linspace(0.0, 1.0, steps)[:, None]
    dots = np.rint(start + along * (end - start)).astype(int)
    for shift in ((0, 0), (1, 0), (0, 1)):
        u, v = (dots + shift).T
        inside = (u >= 0) & (u < width) & (v >= 0) & (v < height)
        picture[v[inside], u[inside]] = LINE


def _letter(picture: Pixels, text: str, corners: Points, write: Write) -> None:
    """The id above its footprint."""
    u, v = int(corners[:, 0].min()), int(corners[:, 1].min()) - 4
    sheet = np.full(picture.shape[:2], 255, np.uint8)
    write(sheet, text, (max(u, 0), max(v, LETTERS)), LETTERS)
    ink = (255 - sheet.astype(np.float64))[:, :, None] / 255
    picture[:] = np.rint(picture * (1 - ink) + np.array(LINE) * ink).astype(np.uint8)

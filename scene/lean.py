"""How what stands above the table seems to lie beside its place, seen by a camera (pure).

A picture is read as if everything stood on the table's surface (`scene.sight.View`); a base at
height z is seen where the ray from the camera through it meets the surface. Table units.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

Point = tuple[float, float]
Eye = tuple[float, float, float]
"""The camera's centre (x, y, z), above everything that is looked at."""
CLEAR = 0.1
"""Least height of a camera above what it sees; nearer, nothing could be said of its place."""


def seen_at(point: Point, z: float, eye: Eye | None) -> Point:
    """Where on the surface a base at ``point`` and height ``z`` seems to be (no eye: there)."""
    if eye is None or eye[2] - z < CLEAR:
        return point
    stretch = eye[2] / (eye[2] - z)
    return (
        eye[0] + (point[0] - eye[0]) * stretch,
        eye[1] + (point[1] - eye[1]) * stretch,
    )


def stands_at(seen: Point, z: float, eye: Eye | None) -> Point:
    """Where a base at height ``z`` is that seems to be at ``seen``: the inverse of `seen_at`."""
    if eye is None or eye[2] - z < CLEAR:
        return seen
    shrink = (eye[2] - z) / eye[2]
    return eye[0] + (seen[0] - eye[0]) * shrink, eye[1] + (seen[1] - eye[1]) * shrink


class Bar(NamedTuple):
    """A straight piece of something above the table, from end to end (x, y, z), and its width."""

    start: tuple[float, float, float]
    end: tuple[float, float, float]
    thick: float


class Shade(NamedTuple):
    """A strip of the surface that the camera cannot see: from end to end, and half its width."""

    start: Point
    end: Point
    half: float

    def distance(self, point: Point) -> float:
        """From the strip's middle line to a point of the surface."""
        (x1, y1), (x2, y2) = self.start, self.end
        dx, dy = x2 - x1, y2 - y1
        length = dx * dx + dy * dy
        share = ((point[0] - x1) * dx + (point[1] - y1) * dy) / length if length else 0.0
        share = min(max(share, 0.0), 1.0)
        return math.dist(point, (x1 + share * dx, y1 + share * dy))


def shade(bar: Bar, eye: Eye) -> Shade:
    """What a bar hides from the camera."""
    high = max(bar.start[2], bar.end[2])
    stretch = eye[2] / max(eye[2] - high, CLEAR)
    start = seen_at(bar.start[:2], bar.start[2], eye)
    end = seen_at(bar.end[:2], bar.end[2], eye)
    return Shade(start, end, bar.thick / 2 * stretch)


def shaded(
    place: Point, base: float, tall: float, radius: float, eye: Eye | None, shades: Sequence[Shade]
) -> bool:
    """Whether shades hide a thing that stands there, or a part of it, be it of its top."""
    foot, top = seen_at(place, base, eye), seen_at(place, base + tall, eye)
    return any(
        min(strip.distance(foot), strip.distance(top)) < strip.half + radius for strip in shades
    )

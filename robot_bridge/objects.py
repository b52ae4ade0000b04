"""Procedural shapes of things by noun, for the physics simulator (pure geometry, no physics).

A model fills the box ``width x height x tall`` about the origin (table units) and is either one
convex hull or a few boxes and cylinders. Nouns that are not listed are boxes, as far as they are
not containers.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from scene.kinds import FOUR_WALLED, head_noun, is_container

Vector = tuple[float, float, float]

MOST_PARTS = 16
"""More than these, and the engine crashes."""
CLEAR = 0.004
"""Height above the ground of parts that need not stand on it: every contact costs time."""
_SIDES = 20
"""Corners of a ring of a round thing."""
_SLABS = 11
"""Flat pieces that make up the wall of a round container."""


class Part(NamedTuple):
    """A box (half extents) or an upright cylinder (radius, radius, half length), turned by yaw."""

    shape: str
    half: Vector
    at: Vector = (0.0, 0.0, 0.0)
    yaw: float = 0.0


class Model(NamedTuple):
    """``rings`` of a hull (each a list of points, bottom to top) or ``parts``.

    ``density`` in kg/m3 over the bounding box; ``centre`` is the height of the centre of mass as
    a share of ``tall``.
    """

    rings: tuple[tuple[Vector, ...], ...] = ()
    parts: tuple[Part, ...] = ()
    density: float = 400.0
    centre: float = 0.5


def model(name: str, width: float, height: float, tall: float) -> Model:
    """The shape of a thing by the head noun of its name and its size (table units)."""
    noun = head_noun(name)
    if is_container(name):
        build = _crate if noun in FOUR_WALLED else _pot
        return build(width, height, tall)
    if noun in _MADE:
        return _MADE[noun](width, height, tall)
    profile = _PROFILES.get(noun)
    if profile is None:
        return Model(parts=(Part("box", (width / 2, height / 2, tall / 2)),))
    rings = tuple(_ring(width * share, height * share, (z - 0.5) * tall) for z, share in profile)
    return Model(rings=rings, density=_DENSITY.get(noun, 500.0), centre=_CENTRE.get(noun, 0.5))


def _ring(width: float, height: float, z: float) -> tuple[Vector, ...]:
    angles = (math.tau * step / _SIDES for step in range(_SIDES))
    return tuple((width / 2 * math.cos(a), height / 2 * math.sin(a), z) for a in angles)


def wall(width: float, height: float) -> float:
    """Thickness of a container's wall, as on the ideal table."""
    return min(0.03, 0.1 * min(width, height))


def _crate(width: float, height: float, tall: float) -> Model:
    """A box without a lid."""
    side = wall(width, height) / 2
    base = min(0.03, 0.1 * tall) / 2
    parts = (
        Part("box", (width / 2, height / 2, base), (0.0, 0.0, base - tall / 2)),
        Part("box", (side, height / 2, tall / 2), (width / 2 - side, 0.0, 0.0)),
        Part("box", (side, height / 2, tall / 2), (side - width / 2, 0.0, 0.0)),
        Part("box", (width / 2, side, tall / 2), (0.0, height / 2 - side, 0.0)),
        Part("box", (width / 2, side, tall / 2), (0.0, side - height / 2, 0.0)),
    )
    return Model(parts=parts, density=150.0, centre=0.4)


def _pot(width: float, height: float, tall: float) -> Model:
    """A round container: a floor of crossed boxes and a ring of slabs.

    The corners of the boxes that it stands on lie on its outline: on less it would topple early.
    """
    side = wall(width, height) / 2
    base = min(0.03, 0.1 * tall) / 2
    floor = ((0.98, 0.2, 0.0), (0.7, 0.7, 0.0), (0.2, 0.98, 0.0))
    between = ((0.9, 0.43, CLEAR), (0.43, 0.9, CLEAR))
    parts = []
    for share, other, up in (*floor, *between):
        half = (width * share / 2, height * other / 2, base - up / 2)
        parts.append(Part("box", half, (0.0, 0.0, base + up / 2 - tall / 2)))
    a, b = width / 2 - side, height / 2 - side
    for step in range(_SLABS):
        angle = math.tau * (step + 0.5) / _SLABS
        at = (a * math.cos(angle), b * math.sin(angle), base / 2)
        yaw = math.atan2(b * math.cos(angle), -a * math.sin(angle))
        speed = math.hypot(a * math.sin(angle), b * math.cos(angle))
        wide = speed * math.tan(math.pi / _SLABS)
        parts.append(Part("box", (wide, side, (tall - base) / 2), at, yaw))
    return Model(parts=tuple(parts), density=150.0, centre=0.4)


def _banana(width: float, height: float, tall: float) -> Model:
    """Nine pieces along a shallow arc through the middle of the box."""
    long = max(width, height)
    band, rise = 0.62 * min(width, height), 0.38 * min(width, height)
    parts = []
    for step in range(-4, 5):
        off = step / 4
        thick = 1.0 - 0.35 * off * off
        clear = 0.0 if step % 3 == 0 else CLEAR
        half = (long / 18, band * thick / 2, (tall * thick - clear) / 2)
        at = (step * long / 9, rise * (0.5 - off * off), (tall * (thick - 1) + clear) / 2)
        if height > width:
            half, at = (half[1], half[0], half[2]), (-at[1], at[0], at[2])
        parts.append(Part("box", half, at))
    return Model(parts=tuple(parts), density=350.0)


def _padlock(width: float, height: float, tall: float) -> Model:
    """A body, and a shackle of two posts and a bar."""
    body, post = 0.6 * tall, 0.12 * width
    bar = 0.12 * tall
    rise = (tall - body) / 2
    at = body - tall / 2 + rise
    parts = (
        Part("box", (width / 2, height / 2, body / 2), (0.0, 0.0, (body - tall) / 2)),
        Part("box", (post / 2, height / 4, rise), (0.3 * width, 0.0, at)),
        Part("box", (post / 2, height / 4, rise), (-0.3 * width, 0.0, at)),
        Part("box", (0.36 * width, height / 4, bar / 2), (0.0, 0.0, (tall - bar) / 2)),
    )
    return Model(parts=parts, density=2500.0, centre=0.4)


_Profile = tuple[tuple[float, float], ...]
"""(height share, diameter share) of each ring, bottom to top."""
_BALL: _Profile = (
    (0.0, 0.6),
    (0.06, 0.76),
    (0.2, 0.92),
    (0.36, 0.99),
    (0.5, 1.0),
    (0.64, 0.97),
    (0.8, 0.83),
    (0.92, 0.6),
    (0.98, 0.36),
    (1.0, 0.2),
)
_STRAIGHT: _Profile = ((0.0, 1.0), (0.97, 1.0), (1.0, 0.96))
_BOTTLE: _Profile = (
    (0.0, 0.95),
    (0.03, 1.0),
    (0.58, 1.0),
    (0.72, 0.8),
    (0.82, 0.45),
    (0.86, 0.4),
    (1.0, 0.4),
)
_DISH: _Profile = ((0.0, 0.65), (0.5, 0.85), (1.0, 1.0))
_PROFILES: dict[str, _Profile] = {
    **dict.fromkeys(
        ("apple", "orange", "ball", "tomato", "peach", "plum", "egg", "strawberry"), _BALL
    ),
    **dict.fromkeys(("lemon", "pear", "potato", "onion", "lime", "melon", "kiwi"), _BALL),
    **dict.fromkeys(("can", "cylinder", "candle", "coin", "tin", "cola", "roll"), _STRAIGHT),
    "bottle": _BOTTLE,
    "plate": _DISH,
    "saucer": _DISH,
}
_DENSITY = {"plate": 900.0, "can": 700.0, "bottle": 550.0, "coin": 3000.0}
_CENTRE = {"bottle": 0.42}
_MADE: dict[str, Callable[[float, float, float], Model]] = {
    "banana": _banana,
    "padlock": _padlock,
    "lock": _padlock,
}


def triangles(rings: tuple[tuple[Vector, ...], ...]) -> tuple[list[Vector], list[int]]:
    """Vertices and indices of the closed surface through the rings, seen from outside."""
    vertices = [point for ring in rings for point in ring]
    sides, indices = len(rings[0]), []
    for level in range(len(rings) - 1):
        for step in range(sides):
            a, b = level * sides + step, level * sides + (step + 1) % sides
            indices += [a, b, b + sides, a, b + sides, a + sides]
    for level, flip in ((0, True), (len(rings) - 1, False)):
        first = level * sides
        for step in range(1, sides - 1):
            fan = [first, first + step, first + step + 1]
            indices += fan[::-1] if flip else fan
    return vertices, indices

"""The outline that a thing of a known shape shows a camera, as distances in many directions (pure).

An outline is told by its supports: how far the thing, as it is seen upon the table's surface,
reaches in each of `WAYS` (n numbers, table units, measured from the table's origin). A shape is
made of level slices, each an ellipse or a rectangle; one at height z is seen stretched away from
the point below the camera. So the whole is the farthest of a few dozen numbers in each direction,
which is fast enough to be fitted while a person waits.
"""

from __future__ import annotations

import math
import random
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene.lean import CLEAR
from scene.peaks import OTHER
from scene.shapes import KINDS, MM
from scene.solids import Solid, upright

Floats = NDArray[np.float64]
Eye = tuple[float, float, float]
COUNT = 48
_ANGLES = np.arange(COUNT) * math.tau / COUNT
WAYS: Floats = np.stack([np.cos(_ANGLES), np.sin(_ANGLES)])
"""The directions (2, n), evenly all around."""
LEVELS = (-0.9, -0.5, 0.0, 0.5, 0.9)
"""Where a round body is cut, of its half height."""
THIN = 0.03
"""A part thinner than this share of its thing is in some pictures lost, in some not."""


class Shape(NamedTuple):
    """``slices`` (n, 6) of a thing of width, height and tallness 1 that stands at the origin: x, y,
    z of the middle, half sides along x and y, and 1 where it is an ellipse, 0 for a rectangle."""

    slices: Floats

    def turned(self) -> Shape:
        """The same with its far end near: turned by half a turn."""
        return Shape(self.slices * np.array((-1, -1, 1, 1, 1, 1)))


class Body(NamedTuple):
    """Where a thing of a shape stands and how large it is: what an outline is fitted in.

    Logarithms of the sides, so that no step of a fit makes them negative; the order of `vector`.
    """

    x: float
    y: float
    width: float
    height: float
    r: float
    tall: float

    def vector(self) -> Floats:
        """Place, logs of width and height, turn, log of tallness (6,)."""
        width, height, tall = (math.log(one) for one in (self.width, self.height, self.tall))
        return np.array((self.x, self.y, width, height, self.r, tall))

    @classmethod
    def of(cls, vector: Floats) -> Body:
        """The inverse of `vector`."""
        x, y, width, height, r, tall = vector.tolist()
        return cls(x, y, math.exp(width), math.exp(height), r, math.exp(tall))


class Reach(NamedTuple):
    """What of each slice (k, n, `COUNT`) makes an outline: the cosine and sine of a way against
    the body's own axes, half sides along it, its middle from the body's, half its width, how the
    camera's distance stretches it, and how far the body stands from below the camera."""

    along: Floats
    across: Floats
    a: Floats
    b: Floats
    own: Floats
    half: Floats
    stretch: Floats
    there: Floats

    @property
    def far(self) -> Floats:
        """How far from below the camera each slice is seen to reach."""
        return self.stretch * (self.there + self.own + self.half)


def _reach(shape: Shape, bodies: Floats, eye: Eye) -> Reach:
    slices = shape.slices
    x, y, r = bodies[:, 0, None], bodies[:, 1, None], bodies[:, 4, None]
    width, height, tall = np.exp(bodies[:, (2, 3, 5)]).T[:, :, None]
    cos, sin = np.cos(r), np.sin(r)
    along = (cos * WAYS[0] + sin * WAYS[1])[:, None]
    across = (cos * WAYS[1] - sin * WAYS[0])[:, None]
    a, b = ((slices[:, 3] * width)[..., None] * along, (slices[:, 4] * height)[..., None] * across)
    half = np.where(slices[:, 5, None] > 0, np.sqrt(a * a + b * b), np.abs(a) + np.abs(b))
    own = (slices[:, 0] * width)[..., None] * along + (slices[:, 1] * height)[..., None] * across
    stretch = (eye[2] / np.maximum(eye[2] - slices[:, 2] * tall, CLEAR))[..., None]
    there = ((x - eye[0]) * WAYS[0] + (y - eye[1]) * WAYS[1])[:, None]
    return Reach(along, across, a, b, own, half, stretch, there)


def supports(shape: Shape, bodies: Floats, eye: Eye) -> Floats:
    """How far bodies (k, 6; see `Body.vector`) of a shape are seen to reach: (k, `COUNT`)."""
    below = eye[0] * WAYS[0] + eye[1] * WAYS[1]
    reach: Floats = below + _reach(shape, bodies, eye).far.max(1)
    return reach


def sloped(shape: Shape, body: Floats, eye: Eye) -> tuple[Floats, Floats]:
    """How far one body (6,) is seen to reach (`COUNT`,), and by how much more for a little more of
    each of its numbers (6, `COUNT`): by the slice that reaches farthest in a way."""
    made = _reach(shape, body[None], eye)
    every = made.far[0]
    most, way = every.argmax(0), np.arange(COUNT)
    x, y, z, wide, deep, round_ = shape.slices[most].T
    width, height, tall = np.exp(body[[2, 3, 5]])
    along, across = made.along[0, 0], made.across[0, 0]
    a, b, half = made.a[0, most, way], made.b[0, most, way], made.half[0, most, way]
    # of an ellipse half is the root of a and b squared, of a rectangle the sum of both
    by_a = np.where(round_ > 0, a / np.maximum(half, 1e-12), np.sign(a))
    by_b = np.where(round_ > 0, b / np.maximum(half, 1e-12), np.sign(b))
    stretch, free = made.stretch[0, most, 0], eye[2] - z * tall
    up = np.where(free > CLEAR, z * tall / np.maximum(free, CLEAR), 0.0)
    slope = np.stack([
        WAYS[0], WAYS[1], x * width * along + by_a * a, y * height * across + by_b * b,
        (x + by_a * wide) * width * across - (y + by_b * deep) * height * along,
        up * every[most, way] / stretch,
    ])  # fmt: skip
    below = eye[0] * WAYS[0] + eye[1] * WAYS[1]
    return below + every[most, way], stretch * slope


def beyond(points: Floats, reach: Floats) -> NDArray[np.float32]:
    """How far points (..., 2) lie outside of an outline of supports; negative: inside of it."""
    x, y = np.ascontiguousarray(np.moveaxis(points, -1, 0), np.float32)
    away = np.full(x.shape, -np.inf, np.float32)
    for (cos, sin), far in zip(WAYS.T[::2].tolist(), reach[::2].tolist(), strict=True):
        np.maximum(away, cos * x + (sin * y - far), out=away)
    return away


# --- shapes -----------------------------------------------------------------------------------


class _Usual(random.Random):
    """Chance that always takes the middle: a kind as it is on average."""

    def uniform(self, a: float, b: float) -> float:
        return (a + b) / 2


def _cut(solid: Solid) -> list[tuple[float, ...]]:
    """The slices of an upright solid."""
    (a, b, c), (x, y, z) = solid.half, solid.at
    if solid.shape == "box":
        return [(x, y, z + level * c, a, b, 0.0) for level in (-1, 1)]
    if solid.shape == "ball":
        wide = [(level, math.sqrt(1 - level * level)) for level in LEVELS]
    else:
        wide = [(-1.0, solid.low), (1.0, solid.high)]
    return [(x, y, z + level * c, a * share, b * share, 1.0) for level, share in wide]


def _of_kind(name: str) -> Shape:
    width, height, tall = (side * MM for side in KINDS[name].size)
    solids = KINDS[name].build(_Usual(0), width, height, tall)
    slices = np.array([piece for solid in solids for piece in _cut(solid)])
    return Shape(slices / np.array((width, height, tall, width, height, 1.0)))


def _upright(round_: bool, low: float = 1.0, high: float = 1.0) -> Shape:
    slices = [(0.0, 0.0, z, k / 2, k / 2, float(round_)) for z, k in ((0.0, low), (1.0, high))]
    return Shape(np.array(slices))


def _thick(shape: Shape) -> Shape:
    return Shape(shape.slices[shape.slices[:, 3:5].min(1) >= THIN])


def _arc() -> Shape:
    """Blunt pieces side by side along a shallow arc."""
    pieces = [
        (4 / 9 * off, 0.38 * (0.5 - off * off), z * (1 - 0.35 * off * off), 1 / 18,
         0.31 * (1 - 0.35 * off * off), 0.0)
        for off in np.linspace(-1, 1, 9).tolist() for z in (0.0, 1.0)
    ]  # fmt: skip
    return Shape(np.array(pieces))


BLOCK, DRUM = _upright(False), _upright(True)
BALL = Shape(np.array(_cut(Solid("ball", (0.5, 0.5, 0.5), (0.0, 0.0, 0.5), upright()))))
DISH, PEAK = _upright(True, 0.6, 1.0), _upright(True, 1.0, 0.3)
UNKNOWN: Sequence[Shape] = (BLOCK, DRUM, BALL, DISH, PEAK)
"""What a thing of no kind may be like."""


def _either(shape: Shape) -> tuple[Shape, ...]:
    """A shape both ways round: of one that is the same, from a rectangle alone nobody can tell."""
    return shape, shape.turned()


def _all(nouns: str, *shapes: Shape) -> dict[str, Sequence[Shape]]:
    return dict.fromkeys(nouns.split(), shapes)


SHAPES: Mapping[str, Sequence[Shape]] = {
    **_all("box brick book carton cube domino eraser phone remote sponge", BLOCK),
    **_all("candle coin coaster cylinder jar pill puck roll tin", DRUM),
    **_all("ball egg marble melon onion peach plum potato strawberry tomato", BALL),
    **_all("bowl pan plate saucer", DISH, DRUM),
    **{name: (_of_kind(name),) for name in KINDS},
    "banana": (*_either(_of_kind("banana")), *_either(_arc())),
    "cup": (DRUM, _upright(True, 0.82, 1.0), *_either(_of_kind("cup"))),
    "pear": (*_either(_of_kind("pear")), *_either(_thick(_of_kind("pear"))), BALL),
    OTHER: UNKNOWN,
}
"""What a thing of a noun may be like, be it a detector's kind or a person's word; a cup has a
handle or none."""
_ROUND = (
    "apple ball bottle bowl can candle coaster coin cylinder jar marble orange pan peach pill "
    "plate plum puck roll saucer tin tomato"
)
ROUND = frozenset(_ROUND.split())
"""Nouns of what is as wide as it is deep, as it stands."""

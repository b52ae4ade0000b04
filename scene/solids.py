"""Rays against simple solids, vectorised: what the training pictures are made of (pure numpy).

A solid is one of four shapes in the cube [-1, 1]^3 of its own, scaled by ``half``, turned by
``turn`` and moved to ``at``. A ray is ``origin + t * way``; origins and ways are (3, ...) arrays
that broadcast. Lengths are table units.
"""

from __future__ import annotations

from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float32]
Shape = Literal["ball", "box", "cone", "cup"]
MISS = np.float32(np.inf)
"""How far a ray goes that hits nothing."""
NEAR = 1e-5
"""Hits closer than this are the surface that the ray starts from."""
WALL, BED = 0.86, -0.84
"""Of a cup: inner radius as a share of the outer one; height of its inner floor, of [-1, 1]."""


class Solid(NamedTuple):
    """``low`` and ``high`` are the radii of a cone or cup at its bottom and top (of 1).

    ``turn`` (3, 3) takes the solid's own axes to the frame it stands in. ``paint`` says which of
    its thing's paints it wears. ``bulge``: where all normals point away from a point of its axis,
    as some renderers shade what has none: the height of its middle above that point.
    """

    shape: Shape
    half: tuple[float, float, float]
    at: tuple[float, float, float]
    turn: Array
    low: float = 1.0
    high: float = 1.0
    paint: int = 0
    bulge: float | None = None


def upright(yaw: float = 0.0) -> Array:
    """A turn (3, 3) about z, radians counter-clockwise seen from above."""
    cos, sin = np.cos(yaw), np.sin(yaw)
    return np.array([[cos, -sin, 0], [sin, cos, 0], [0, 0, 1]], np.float32)


def lying(yaw: float = 0.0) -> Array:
    """A turn (3, 3) that lays a solid's z along the direction ``yaw`` on the table."""
    onto_x = np.array([[0, 0, 1], [0, 1, 0], [-1, 0, 0]], np.float32)
    turned: Array = upright(yaw) @ onto_x
    return turned


def moved(solid: Solid, x: float, y: float, yaw: float) -> Solid:
    """The solid of a thing that stands at the origin, with the thing at x, y, turned by yaw."""
    turn = upright(yaw)
    at = turn @ np.array(solid.at, np.float32) + np.array((x, y, 0), np.float32)
    return solid._replace(at=(float(at[0]), float(at[1]), float(at[2])), turn=turn @ solid.turn)


def corners(solid: Solid) -> Array:
    """The eight corners (3, 8) of the box that the solid fills."""
    signs = np.array(np.meshgrid((-1, 1), (-1, 1), (-1, 1)), np.float32).reshape(3, 8)
    wide = np.array((max(solid.low, solid.high),) * 2 + (1.0,), np.float32)
    if solid.shape in ("ball", "box"):
        wide = np.ones(3, np.float32)
    half = np.array(solid.half, np.float32) * wide
    placed: Array = solid.turn @ (signs * half[:, None]) + np.array(solid.at, np.float32)[:, None]
    return placed


def hit(solid: Solid, origin: Array, way: Array) -> tuple[Array, Array]:
    """Where rays enter a solid: t (...), `MISS` where they do not, and the normals (3, ...).

    Normals are of length 1 and face the ray's origin.
    """
    half = np.array(solid.half, np.float32)
    inward = (solid.turn / half).T
    at = np.array(solid.at, np.float32).reshape((3,) + (1,) * (origin.ndim - 1))
    o = np.tensordot(inward, origin - at, 1)
    d = np.tensordot(inward, way, 1)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        t, normal = _MEET[solid.shape](solid, o, d)
    outward = np.tensordot((solid.turn / half), normal, 1)
    outward /= np.maximum(np.sqrt((outward * outward).sum(0)), 1e-9)
    if solid.bulge is not None:
        outward = _bulging(solid, o + np.where(t < MISS, t, 0) * d)
    back = (outward * np.broadcast_to(way, outward.shape)).sum(0) > 0
    return t, np.where(back, -outward, outward)


def _bulging(solid: Solid, spot: Array) -> Array:
    """Normals (3, ...) at a solid's own spots (3, ...) that point away from one point."""
    away = np.tensordot(solid.turn * np.array(solid.half, np.float32), spot, 1)
    away[2] += solid.bulge
    unit: Array = (away / np.maximum(np.sqrt((away * away).sum(0)), 1e-9)).astype(np.float32)
    return unit


def blocked(solid: Solid, origin: Array, way: Array) -> NDArray[np.bool_]:
    """Whether rays meet the solid at all."""
    return hit(solid, origin, way)[0] < MISS


def _ball(solid: Solid, o: Array, d: Array) -> tuple[Array, Array]:
    a, b, c = (d * d).sum(0), (o * d).sum(0), (o * o).sum(0) - 1
    disc = b * b - a * c
    t = (-b - np.sqrt(np.maximum(disc, 0))) / a
    t = np.where((disc > 0) & (t > NEAR), t, MISS).astype(np.float32)
    return t, (o + np.where(t < MISS, t, 0) * d).astype(np.float32)


def _box(solid: Solid, o: Array, d: Array) -> tuple[Array, Array]:
    inverse = 1 / np.where(np.abs(d) < 1e-9, np.float32(1e-9), d)
    one, other = (-1 - o) * inverse, (1 - o) * inverse
    enter, leave = np.minimum(one, other), np.maximum(one, other)
    t, out = enter.max(0), leave.min(0)
    axis = enter.argmax(0)
    normal = (np.arange(3).reshape((3,) + (1,) * axis.ndim) == axis).astype(np.float32)
    return np.where((t < out) & (t > NEAR), t, MISS), normal


def _cone(solid: Solid, o: Array, d: Array) -> tuple[Array, Array]:
    t, normal = _side(o, d, solid.low, solid.high, -1.0)
    for z in (-1.0, 1.0):
        flat = _disc(o, d, z, 0.0, solid.high if z > 0 else solid.low)
        t, normal = _nearer(t, normal, flat)
    return t, normal


def _cup(solid: Solid, o: Array, d: Array) -> tuple[Array, Array]:
    """A cone without its lid: outer side, rim, inner side and inner floor."""
    low, high = solid.low * WALL, solid.high * WALL
    t, normal = _side(o, d, solid.low, solid.high, -1.0)
    inner, inner_normal = _side(o, d, low, high, BED, far=True)
    closer = inner < t
    t, normal = np.where(closer, inner, t), np.where(closer, inner_normal, normal)
    for z, rim, edge in ((1.0, high, solid.high), (BED, 0.0, high), (-1.0, 0.0, solid.low)):
        t, normal = _nearer(t, normal, _disc(o, d, z, rim, edge))
    return t, normal


def _side(
    o: Array, d: Array, low: float, high: float, bottom: float, far: bool = False
) -> tuple[Array, Array]:
    """The side of a cone of radius ``low`` at z = -1 and ``high`` at 1, from ``bottom`` up."""
    p, q = (high + low) / 2, (high - low) / 2
    radius = p + q * o[2]
    a = d[0] * d[0] + d[1] * d[1] - q * q * d[2] * d[2]
    b = o[0] * d[0] + o[1] * d[1] - q * radius * d[2]
    c = o[0] * o[0] + o[1] * o[1] - radius * radius
    disc = b * b - a * c
    root = np.sqrt(np.maximum(disc, 0))
    best = np.full(np.broadcast(b, a).shape, MISS, np.float32)
    for t in ((-b - root) / a, (-b + root) / a):
        z = o[2] + t * d[2]
        fits = (disc > 0) & (z <= 1) & (z >= bottom) & (t > NEAR) & (p + q * z >= 0)
        best = np.where(fits & (t < best), t, best)
    t = np.where(best < MISS, best, 0)
    x, y, z = o[0] + t * d[0], o[1] + t * d[1], o[2] + t * d[2]
    return best, np.stack([x, y, -q * (p + q * z)])


def _disc(o: Array, d: Array, z: float, inner: float, outer: float) -> Array:
    t = (z - o[2]) / d[2]
    x, y = o[0] + t * d[0], o[1] + t * d[1]
    away = x * x + y * y
    fits = (away <= outer * outer) & (away >= inner * inner) & (t > NEAR)
    return np.where(fits, t, MISS).astype(np.float32)


def _nearer(t: Array, normal: Array, flat: Array) -> tuple[Array, Array]:
    """The nearer of a surface and a level one."""
    closer = flat < t
    up = np.array((0, 0, 1), np.float32).reshape((3,) + (1,) * flat.ndim)
    return np.where(closer, flat, t), np.where(closer, up, normal)


_MEET = {"ball": _ball, "box": _box, "cone": _cone, "cup": _cup}

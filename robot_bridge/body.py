"""A thing on the ideal table, and the flat geometry of footprints (table units, table frame).

A footprint is a rectangle turned by ``r``; a direction is a unit vector ``(ux, uy)``.
"""

from __future__ import annotations

import math

from scene.kinds import is_container
from scene.types import SceneObject

TOUCH = 1e-4
"""Overlaps up to this much are touching, not pushing."""
SKIM = 2e-3
"""A tip this little below a top skims over it."""


class Body:
    """A thing with a place. ``on`` as in SceneObject; ``hollow``: open at the top, has a floor."""

    __slots__ = (
        "color", "cos", "height", "hollow", "id", "name", "on", "r", "sin", "tall", "upright",
        "width", "x", "y", "z",
    )  # fmt: skip

    def __init__(self, item: SceneObject, x: float, y: float) -> None:
        self.id, self.name, self.color = item.id, item.name, item.color
        self.x, self.y, self.z = x, y, item.z
        self.width, self.height, self.tall = item.width, item.height, item.tall
        self.on, self.upright = item.on, item.upright
        self.hollow = item.upright and is_container(item.name)
        self.turn_to(item.r)

    def turn_to(self, r: float) -> None:
        """Set the rotation about z (radians)."""
        self.r = r
        self.cos, self.sin = (math.cos(r), math.sin(r)) if r else (1.0, 0.0)

    @property
    def top(self) -> float:
        """Height of the upper side above the table."""
        return self.z + self.tall

    @property
    def wall(self) -> float:
        """Thickness of a container's walls."""
        return min(0.03, 0.1 * min(self.width, self.height))

    @property
    def floor(self) -> float:
        """Height above the table at which things inside a container stand."""
        return self.z + min(0.03, 0.1 * self.tall)

    def half(self, ux: float, uy: float) -> float:
        """Half extent of the footprint along a direction."""
        along_w = abs(ux * self.cos + uy * self.sin) * self.width
        along_h = abs(uy * self.cos - ux * self.sin) * self.height
        return (along_w + along_h) / 2

    def local(self, x: float, y: float) -> tuple[float, float]:
        """A point of the table in the footprint's own axes, from its centre."""
        dx, dy = x - self.x, y - self.y
        return dx * self.cos + dy * self.sin, dy * self.cos - dx * self.sin

    def world(self, along: float, across: float) -> tuple[float, float]:
        """The inverse of ``local``."""
        return (
            self.x + along * self.cos - across * self.sin,
            self.y + along * self.sin + across * self.cos,
        )

    def covers(self, x: float, y: float, inset: float = 0.0) -> bool:
        """Whether the point lies inside the footprint (less ``inset`` all round)."""
        along, across = self.local(x, y)
        return (
            abs(along) <= self.width / 2 - inset + 1e-9
            and abs(across) <= self.height / 2 - inset + 1e-9
        )

    def corners(self) -> tuple[tuple[float, float], ...]:
        """The footprint's corners, counter-clockwise."""
        w, h = self.width / 2, self.height / 2
        return self.world(-w, -h), self.world(w, -h), self.world(w, h), self.world(-w, h)

    def shift(self, dx: float, dy: float, dz: float = 0.0) -> None:
        """Move by a vector."""
        self.x += dx
        self.y += dy
        self.z += dz

    def spin(self, x: float, y: float, angle: float) -> None:
        """Turn about the vertical through a point, by an angle (radians)."""
        cos, sin = math.cos(angle), math.sin(angle)
        dx, dy = self.x - x, self.y - y
        self.x, self.y = x + dx * cos - dy * sin, y + dx * sin + dy * cos
        self.turn_to(math.remainder(self.r + angle, math.tau))


def tool_body(x: float, y: float, z: float, ux: float, uy: float, radius: float) -> Body:
    """The tool as a pusher: a square facing the way it goes, from its tip far upwards."""
    item = SceneObject(id="", name="", z=z, width=2 * radius, height=2 * radius, tall=100.0)
    tool = Body(item, x, y)
    tool.cos, tool.sin = ux, uy
    return tool


def heights_meet(one: Body, other: Body) -> bool:
    """Whether the two occupy a common height, skimming excepted."""
    return one.z < other.top - SKIM and other.z < one.top - SKIM


def overlap(one: Body, other: Body) -> float:
    """How deep two footprints overlap along the axis that parts them soonest (<= 0: apart)."""
    dx, dy = other.x - one.x, other.y - one.y
    depth = math.inf
    for ux, uy in _axes(one, other):
        apart = abs(dx * ux + dy * uy)
        depth = min(depth, one.half(ux, uy) + other.half(ux, uy) - apart)
        if depth <= 0:
            break
    return depth


def way_out(one: Body, other: Body) -> tuple[float, float, float]:
    """Shortest way for ``one`` out of ``other``: direction and distance."""
    dx, dy = one.x - other.x, one.y - other.y
    best = (0.0, 0.0, math.inf)
    for ux, uy in _axes(one, other):
        apart = dx * ux + dy * uy
        sign = -1.0 if apart < 0 else 1.0
        depth = one.half(ux, uy) + other.half(ux, uy) - abs(apart)
        if depth < best[2] - 1e-9:
            best = (sign * ux, sign * uy, depth)
    return best


def _axes(one: Body, other: Body) -> tuple[tuple[float, float], ...]:
    first = ((one.cos, one.sin), (-one.sin, one.cos))
    if one.r == other.r:
        return first
    return (*first, (other.cos, other.sin), (-other.sin, other.cos))


def disc_meets(body: Body, x: float, y: float, radius: float) -> bool:
    """Whether a disc on the table overlaps the footprint."""
    along, across = body.local(x, y)
    out_w = max(0.0, abs(along) - body.width / 2)
    out_h = max(0.0, abs(across) - body.height / 2)
    return out_w * out_w + out_h * out_h < (radius - SKIM) ** 2


def fits_in(body: Body, container: Body) -> bool:
    """Whether the footprint is small enough for the container's inside, turned as it is."""
    room_w = container.width / 2 - container.wall
    room_h = container.height / 2 - container.wall
    return (
        body.half(container.cos, container.sin) <= room_w + TOUCH
        and body.half(-container.sin, container.cos) <= room_h + TOUCH
    )


def inside(body: Body, container: Body) -> bool:
    """Whether the thing is in the container's hollow: centre within the walls, below the rim."""
    return (
        container.hollow
        and container.z - SKIM <= body.z < container.top - SKIM
        and fits_in(body, container)
        and container.covers(body.x, body.y, container.wall)
    )


def travel(pusher: Body, body: Body, ux: float, uy: float) -> float:
    """How far the pusher goes along (ux, uy) before it meets the body; inf if it never does."""
    if inside(pusher, body):
        return _to_wall(pusher, body, ux, uy)
    dx, dy = body.x - pusher.x, body.y - pusher.y
    along, across = dx * ux + dy * uy, dy * ux - dx * uy
    if abs(across) >= pusher.half(-uy, ux) + body.half(-uy, ux) - TOUCH:
        return math.inf
    if _square(pusher, ux, uy) and _square(body, ux, uy):
        gap = along - pusher.half(ux, uy) - body.half(ux, uy)
    else:
        gap = _profile_gap(pusher, body, ux, uy)
    if along <= 0 and gap <= 0:  # a long thing askew may be met although its centre lies behind
        return math.inf
    return max(0.0, gap)


def _square(body: Body, ux: float, uy: float) -> bool:
    """Whether a side of the footprint faces the direction squarely."""
    return abs((ux * body.cos + uy * body.sin) * (uy * body.cos - ux * body.sin)) < 1e-9


def _to_wall(pusher: Body, container: Body, ux: float, uy: float) -> float:
    """How far the pusher goes inside a container before it meets the wall."""
    vx, vy = ux * container.cos + uy * container.sin, uy * container.cos - ux * container.sin
    px, py = container.local(pusher.x, pusher.y)
    free_w = container.width / 2 - container.wall - pusher.half(container.cos, container.sin)
    free_h = container.height / 2 - container.wall - pusher.half(-container.sin, container.cos)
    far = math.inf
    if abs(vx) > 1e-9:
        far = min(far, (free_w - px * math.copysign(1, vx)) / abs(vx))
    if abs(vy) > 1e-9:
        far = min(far, (free_h - py * math.copysign(1, vy)) / abs(vy))
    return max(0.0, far)


def _profile_gap(pusher: Body, body: Body, ux: float, uy: float) -> float:
    """Least distance along the direction between the pusher's front and the body's back.

    Front and back are convex chains over the lateral axis, so that the least distance lies above
    a corner of one of them, or at an end of the overlap.
    """
    front = [(x * ux + y * uy, y * ux - x * uy) for x, y in pusher.corners()]
    back = [(x * ux + y * uy, y * ux - x * uy) for x, y in body.corners()]
    low = max(min(b for _, b in front), min(b for _, b in back))
    high = min(max(b for _, b in front), max(b for _, b in back))
    stops = [b for _, b in front + back if low < b < high]
    return min(
        min(_chain(back, b)) - max(_chain(front, b)) for b in (low + 1e-9, high - 1e-9, *stops)
    )


def _chain(corners: list[tuple[float, float]], across: float) -> list[float]:
    """Where the footprint's outline crosses a lateral position (both crossings)."""
    hits = []
    for (a1, b1), (a2, b2) in zip(corners, corners[1:] + corners[:1], strict=True):
        if min(b1, b2) <= across <= max(b1, b2):
            share = (across - b1) / (b2 - b1) if abs(b2 - b1) > 1e-12 else 0.0
            hits.append(a1 + share * (a2 - a1))
    return hits or [corners[0][0]]

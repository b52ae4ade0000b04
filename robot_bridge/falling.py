"""Falling on the ideal table: what a free thing comes to rest on, in or beside."""

from __future__ import annotations

import math
from collections.abc import Sequence

from robot_bridge.body import TOUCH, Body, fits_in, overlap
from robot_bridge.things import Things
from scene.types import EDGE

POKES = 0.06
"""How far what lies in a container may look out of it and the next thing still falls beside it."""
LEVEL = 0.01
"""Tops that differ by no more carry a thing together."""
CLEARANCE = 0.05
"""How far from the table's edge a fallen thing's own edge comes to lie."""


def fall(table: Things, body: Body) -> bool:
    """Let a free body, and what stands on it, drop straight down onto what is below its centre.

    True if it may have come down partly inside a neighbour: on the table or on another thing.
    In a container it finds a place of its own; on the floor nothing meets.
    """
    support = _support(table, body)
    if support is None and not _over_table(body):
        _to_floor(table, body)
        return False
    if support is None:
        _lower(table, body, 0.0, "table")
        return True
    if support.hollow and fits_in(body, support):
        _into(table, body, support)
        return False
    _lower(table, body, support.top, support.id)
    return True


def shift(table: Things, body: Body, dx: float, dy: float, dz: float = 0.0) -> None:
    """Move a body, and what stands on it, by a vector."""
    for part in (body, *table.riders(body)):
        part.shift(dx, dy, dz)


def _over_table(body: Body) -> bool:
    return abs(body.x) <= EDGE and abs(body.y) <= EDGE


def _support(table: Things, body: Body) -> Body | None:
    """The thing on or in which the body comes to rest, None for table or floor."""
    beneath = _beneath(table, body)
    below = [other for other in beneath if other.covers(body.x, body.y)]
    if not below:
        return _bridge(body, beneath)
    highest = max(below, key=lambda other: other.top)
    for other in below:
        if other.hollow and highest.on == other.id and highest.top < other.top + POKES:
            return other
    return highest


def _beneath(table: Things, body: Body) -> list[Body]:
    """Everything that the body could come down on from where it is, wherever it stands."""
    mine = {body.id} | {rider.id for rider in table.riders(body)}
    return [
        other
        for other in table.bodies
        if other.id not in mine
        and other.on not in ("floor", "tray", "gripper")
        and other is not table.held
        and (other.floor if other.hollow else other.top) <= body.z + 0.02
    ]


def _bridge(body: Body, beneath: Sequence[Body]) -> Body | None:
    """Of two things as high, on which the body comes to lie across a gap, the nearer one."""
    under = [one for one in beneath if not one.hollow and overlap(body, one) > TOUCH]
    level = [one for one in under if one.top >= max(other.top for other in under) - LEVEL]
    level.sort(key=lambda one: math.dist((one.x, one.y), (body.x, body.y)))
    for one in level:
        for other in level:
            across = (one.x - body.x) * (other.x - body.x) + (one.y - body.y) * (other.y - body.y)
            if across < 0:
                return one
    return None


def _lower(table: Things, body: Body, z: float, on: str) -> None:
    shift(table, body, 0.0, 0.0, z - body.z)
    body.on = on


def _to_floor(table: Things, body: Body) -> None:
    """Off the table: just beyond the edge it crossed, where nothing reaches it."""
    dx = dy = 0.0
    half_x, half_y = body.half(1.0, 0.0), body.half(0.0, 1.0)
    if abs(body.x) > EDGE:
        dx = math.copysign(max(0.0, EDGE + CLEARANCE + half_x - abs(body.x)), body.x)
    if abs(body.y) > EDGE:
        dy = math.copysign(max(0.0, EDGE + CLEARANCE + half_y - abs(body.y)), body.y)
    shift(table, body, dx, dy)
    for part in (body, *table.riders(body)):
        part.z = 0.0
        part.on = "floor"


def _into(table: Things, body: Body, container: Body) -> None:
    """Lie in a container: where it fell if it can, else at the nearest free place of its floor."""
    contents = [o for o in table.bodies if o.on == container.id and o is not body]
    free_w = max(
        0.0, container.width / 2 - container.wall - body.half(container.cos, container.sin)
    )
    free_h = max(
        0.0, container.height / 2 - container.wall - body.half(-container.sin, container.cos)
    )
    x, y = container.local(body.x, body.y)
    fell = (min(max(x, -free_w), free_w), min(max(y, -free_h), free_h))
    grid = [(free_w * i / 2, free_h * j / 2) for i in range(-2, 3) for j in range(-2, 3)]
    spots = [fell, *sorted(grid, key=lambda spot: math.dist(spot, fell))]
    for spot in spots:
        _place(table, body, container.world(*spot))
        if all(overlap(body, other) <= TOUCH for other in contents):
            _lower(table, body, container.floor, container.id)
            return
    heaps = []
    for spot in spots:
        _place(table, body, container.world(*spot))
        heaps.append(max(other.top for other in contents if overlap(body, other) > TOUCH))
    lowest = min(heaps)
    _place(table, body, container.world(*spots[heaps.index(lowest)]))
    _lower(table, body, lowest, container.id)


def _place(table: Things, body: Body, spot: tuple[float, float]) -> None:
    shift(table, body, spot[0] - body.x, spot[1] - body.y)

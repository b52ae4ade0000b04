"""Pushing and toppling on the ideal table (`table.py` says what happens; here is how).

A push goes along one direction. Everything that has been met moves at the pusher's speed, so the
way the pusher has gone when a thing is met is a shortest path: the free ways between the things
of the chain added up. Between two meetings that change the picture (a thing is shoved aside,
topples, leaves its support) everything moves on straight; those are the *events*.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from robot_bridge.body import (
    TOUCH,
    Body,
    heights_meet,
    inside,
    overlap,
    tool_body,
    travel,
    way_out,
)
from robot_bridge.falling import fall, shift
from robot_bridge.things import TOOL_RADIUS, Things
from scene.types import EDGE

FRICTION = 0.3
"""Friction between a thing and the table: what is pushed higher than extent / (2 * it) topples."""
_EVENTS = 200
_DEPTH = 6


class Meeting(NamedTuple):
    """A thing is met after the pusher has gone ``way``; ``by`` pushes it (None: carried along)."""

    way: float
    by: Body | None


class Happening(NamedTuple):
    """An event: what befalls which body, after which way."""

    way: float
    what: str
    body: Body


def sweep(table: Things, ux: float, uy: float, length: float) -> None:
    """Move the tool and what it carries along a direction at its height, pushing what it meets."""
    _drive(table, None, ux, uy, length, 0)


def _drive(
    table: Things, mover: Body | None, ux: float, uy: float, length: float, depth: int
) -> None:
    """Push along a direction, with the tool (mover None) or with a free body."""
    left = length
    for _ in range(_EVENTS):
        pushers = _pushers(table, mover, ux, uy)
        met = _meetings(table, pushers, ux, uy, left)
        event = _first_event(table, met, ux, uy)
        way = left if event is None else min(left, event.way)
        _advance(table, mover, met, ux, uy, way)
        left -= way
        if event is None or event.way >= way + left:
            break
        _happen(table, event, met, ux, uy, depth)
        if left <= 0 or (mover is not None and mover.on == "floor"):
            break


def _pushers(table: Things, mover: Body | None, ux: float, uy: float) -> list[Body]:
    if mover is not None:
        return [mover, *table.riders(mover)]
    tip = table.tip
    return [tool_body(tip.x, tip.y, tip.z, ux, uy, TOOL_RADIUS), *table.carried()]


def _meetings(
    table: Things, pushers: list[Body], ux: float, uy: float, length: float
) -> dict[str, Meeting]:
    """Every thing that is met within ``length``, by shortest path over the chain of pushes."""
    fixed = {body.id for body in table.carried()} | {body.id for body in pushers}
    free = [b for b in table.bodies if b.id not in fixed and b.on not in ("floor", "tray")]
    met: dict[str, Meeting] = {b.id: Meeting(0.0, None) for b in pushers if b in table.bodies}
    todo = [(0.0, body) for body in pushers]
    while todo:
        way, pusher = min(todo, key=lambda entry: entry[0])
        todo.remove((way, pusher))
        for body in free:
            known = met.get(body.id)
            if body.on == pusher.id:
                reach, by = way, None
            elif heights_meet(pusher, body):
                reach, by = way + travel(pusher, body, ux, uy), pusher
            else:
                continue
            if reach < length and (known is None or reach < known.way - 1e-12):
                met[body.id] = Meeting(reach, by)
                todo.append((reach, body))
    return met


def _first_event(table: Things, met: dict[str, Meeting], ux: float, uy: float) -> Happening | None:
    first: Happening | None = None
    for body in table.bodies:
        meeting = met.get(body.id)
        if meeting is None or body is table.held or body.on in ("gripper", "floor"):
            continue
        for event in _events(table, body, meeting, met, ux, uy):
            if first is None or event.way < first.way - 1e-12:
                first = event
    return first


def _events(
    table: Things, body: Body, meeting: Meeting, met: dict[str, Meeting], ux: float, uy: float
) -> list[Happening]:
    found = []
    if meeting.by is not None and not _within(table, meeting.by, body):
        if _flank(meeting.by, body, ux, uy):
            found.append(Happening(meeting.way, "aside", body))
        elif _topples(meeting.by, body, ux, uy):
            found.append(Happening(meeting.way, "topple", body))
    ledge = _ledge(table, body, meeting, met, ux, uy)
    if ledge < math.inf:
        found.append(Happening(meeting.way + ledge, "fall", body))
    return found


def _within(table: Things, pusher: Body, body: Body) -> bool:
    """Whether the pusher pushes a container from its inside."""
    return body.hollow and body.covers(pusher.x, pusher.y) and pusher.z < body.top


def _flank(pusher: Body, body: Body, ux: float, uy: float) -> bool:
    """Whether neither centre is in the other's way: the thing is brushed, not pushed."""
    across = abs((body.y - pusher.y) * ux - (body.x - pusher.x) * uy)
    return across > max(pusher.half(-uy, ux), body.half(-uy, ux)) + TOUCH


def _topples(pusher: Body, body: Body, ux: float, uy: float) -> bool:
    lever = pusher.z - body.z
    return body.upright and lever > 2 * body.half(ux, uy) / (2 * FRICTION)


def _ledge(
    table: Things, body: Body, meeting: Meeting, met: dict[str, Meeting], ux: float, uy: float
) -> float:
    """How far the body can be pushed before its centre leaves its support; inf if it never does."""
    if body.on == "table":
        return _exit(body.x, body.y, ux, uy, EDGE, EDGE)
    below = next((other for other in table.bodies if other.id == body.on), None)
    if below is None or inside(body, below):  # the walls keep in what lies below the rim
        return math.inf
    along = met.get(below.id)
    if along is not None and along.way <= meeting.way + 1e-12:
        return math.inf
    x, y = below.local(body.x, body.y)
    vx, vy = ux * below.cos + uy * below.sin, uy * below.cos - ux * below.sin
    return _exit(x, y, vx, vy, below.width / 2, below.height / 2)


def _exit(x: float, y: float, ux: float, uy: float, half_w: float, half_h: float) -> float:
    """Distance along a direction until a point inside a rectangle about the origin leaves it."""
    far = math.inf
    if abs(ux) > 1e-12:
        far = min(far, (half_w - x * math.copysign(1.0, ux)) / abs(ux))
    if abs(uy) > 1e-12:
        far = min(far, (half_h - y * math.copysign(1.0, uy)) / abs(uy))
    return max(0.0, far) + 1e-6


def _advance(
    table: Things, mover: Body | None, met: dict[str, Meeting], ux: float, uy: float, way: float
) -> None:
    if mover is None:
        tip = table.tip
        table.tip = type(tip)(tip.x + ux * way, tip.y + uy * way, tip.z, tip.r)
    for body in table.bodies:
        meeting = met.get(body.id)
        if meeting is not None and meeting.way < way:
            body.shift(ux * (way - meeting.way), uy * (way - meeting.way))


def _happen(
    table: Things, event: Happening, met: dict[str, Meeting], ux: float, uy: float, depth: int
) -> None:
    body = event.body
    if event.what == "aside":
        pusher = met[body.id].by
        if pusher is not None:
            _shove_aside(table, pusher, body, ux, uy, depth)
    elif event.what == "topple":
        _topple(table, body, ux, uy, depth)
    else:
        settle(table, body, (ux, uy), depth)


def _shove_aside(table: Things, pusher: Body, body: Body, ux: float, uy: float, depth: int) -> None:
    across = (body.y - pusher.y) * ux - (body.x - pusher.x) * uy
    side = math.copysign(1.0, across)
    deep = pusher.half(-uy, ux) + body.half(-uy, ux) - abs(across)
    _nudge(table, body, -uy * side, ux * side, deep, depth)


def _nudge(table: Things, body: Body, ux: float, uy: float, length: float, depth: int) -> None:
    """Move a free body out of the way, pushing on what it meets."""
    if depth >= _DEPTH:  # no end of what pushes what: through what it meets, never into mid-air
        shift(table, body, ux * length, uy * length)
        if not _carried_still(table, body):
            fall(table, body)
        return
    _drive(table, body, ux, uy, length + TOUCH, depth + 1)


def _carried_still(table: Things, body: Body) -> bool:
    """Whether what carried the body is still below its centre, or around it."""
    if body.on == "table":
        return max(abs(body.x), abs(body.y)) <= EDGE
    below = next((other for other in table.bodies if other.id == body.on), None)
    return below is None or inside(body, below) or below.covers(body.x, body.y)


# --- toppling and falling -------------------------------------------------------------------


def _topple(table: Things, body: Body, ux: float, uy: float, depth: int) -> None:
    """Lay the body down over its far edge, along that axis of its own that is nearest the push."""
    riders = table.riders(body)
    along, across = ux * body.cos + uy * body.sin, uy * body.cos - ux * body.sin
    if abs(along) >= abs(across):
        sign = math.copysign(1.0, along)
        fx, fy, extent = sign * body.cos, sign * body.sin, body.width
        body.width = body.tall
    else:
        sign = math.copysign(1.0, across)
        fx, fy, extent = -sign * body.sin, sign * body.cos, body.height
        body.height = body.tall
    reach = (extent + body.tall) / 2
    body.tall = extent
    body.upright = body.hollow = False
    body.shift(fx * reach, fy * reach)
    for other in list(table.bodies):
        if other is not body and other not in riders:
            _make_room(table, body, other, fx, fy, depth)
    settle(table, body, (fx, fy), depth)
    for rider in riders:
        rider.shift(fx * reach * 2, fy * reach * 2)
        settle(table, rider, (fx, fy), depth)


def _make_room(table: Things, body: Body, other: Body, ux: float, uy: float, depth: int) -> None:
    """Push a thing out from under a body that falls on it along a direction."""
    if other.on in ("floor", "tray", "gripper") or not heights_meet(body, other):
        return
    if overlap(body, other) > TOUCH:
        along = (other.x - body.x) * ux + (other.y - body.y) * uy
        deep = body.half(ux, uy) + other.half(ux, uy) - along
        _nudge(table, other, ux, uy, deep, depth)


def settle(
    table: Things, body: Body, way: tuple[float, float] | None = None, depth: int = 0
) -> None:
    """Let a free body fall; landing beside something it overlaps, it slides clear of it.

    It slides along ``way`` if it fell while moving, else the shortest way.
    """
    if fall(table, body):
        _clear_off(table, body, way, depth)


def _clear_off(table: Things, body: Body, way: tuple[float, float] | None, depth: int) -> None:
    """Slide a thing that came down partly inside another off it."""
    mine = {body.id} | {rider.id for rider in table.riders(body)}
    for other in list(table.bodies):
        if other.id in mine or other.on in ("floor", "tray", "gripper") or other.id == body.on:
            continue
        if not heights_meet(body, other) or overlap(body, other) <= 2e-3:
            continue
        if way is None:
            ux, uy, deep = way_out(body, other)
        else:
            ux, uy = way
            along = (body.x - other.x) * ux + (body.y - other.y) * uy
            deep = body.half(ux, uy) + other.half(ux, uy) - along
        _nudge(table, body, ux, uy, deep, depth)
        if body.on == "floor":
            return

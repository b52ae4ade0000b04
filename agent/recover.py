"""How to go on where something was lost, set down or pushed elsewhere than meant (pure).

A plan that carries things is seen as carries: above a thing, down, suction on, to its place,
suction off, up. What is left of a plan after one of them failed is that carry again, aimed at
where the thing is seen now and gripped at another point of it, and all that comes after it. What
comes out is commands: they pass the check like those of any program.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from enum import Enum
from typing import NamedTuple

from msgspec.structs import replace

from agent.doubt import SURE, Doubt
from agent.forecast import Forecast
from agent.messages import Command, StepReport
from agent.report import TURNED, strays, turned
from robot_bridge.api import TOOL_RADIUS
from scene.relations import extents
from scene.tray import tray_positions
from scene.types import Pose, Scene, SceneObject

EXACT = 0.004
"""A push this short is not made (table units)."""
HIGH, LOW, RUN_UP = 1.2, 0.04, 0.08
"""Heights of the tool between pushes and in them, its distance from a thing before one: as in
the language's own ``push`` (table units)."""
GRIPS = (0.0, 0.1, -0.1)
"""Where the tries after the first grip a thing: so far from its middle, as a share of its width."""
DROPPED = 0.1
"""So near to its place a thing was lost on the way down there, turned already (table units)."""
MOVED = 0.02
"""A thing that lies so far from where it was believed was missed for that (table units)."""


class _Order(Enum):
    """How what was pushed is put right: its longer way first, its shorter one, slid, or by what is
    carried along once more."""

    LONGER, SHORTER, SLID, ALONG = range(4)


class Carry(NamedTuple):
    """One thing taken and, unless it stays held, set down; numbers of commands, all inclusive.

    ``first``: the tool goes above it; ``release``: suction goes off (one beyond the plan where it
    stays held); ``last``: the tool is up again.
    """

    id: str
    first: int
    grip: int
    release: int
    last: int


def carries(forecast: Forecast) -> tuple[Carry, ...]:
    """The carries of a plan, in order."""
    found: list[Carry] = []
    commands, after = forecast.commands, 0
    for number, command in enumerate(commands):
        if command.op != "grip" or not command.grip or number < after:
            continue
        held = next((one for one in forecast.after(number + 1).objects if one.held), None)
        if held is not None:
            carry = _carry(commands, number, after, held.id)
            found.append(carry)
            after = carry.last + 1
    return tuple(found)


def _carry(commands: Sequence[Command], grip: int, after: int, id_: str) -> Carry:
    first = grip
    while first > after and _spot(commands[first - 1]) == _spot(commands[grip]):
        first -= 1
    offs = (n for n in range(grip, len(commands)) if _is_release(commands[n]))
    release = last = next(offs, len(commands))
    while last + 1 < len(commands) and _rises(commands[last + 1], commands[release]):
        last += 1
    return Carry(id_, first, grip, release, min(last, len(commands) - 1))


def _spot(command: Command) -> tuple[float, float]:
    return command.x, command.y


def _is_release(command: Command) -> bool:
    return command.op == "grip" and not command.grip


def _rises(command: Command, release: Command) -> bool:
    return command.op == "move" and _spot(command) == _spot(release) and command.z > release.z


def lost(step: StepReport, plan: Sequence[Carry]) -> Carry | None:
    """The carry that the gripper feels to have lost by this step; None if none, or unfelt."""
    if step.held is not False:
        return None
    return next((one for one in plan if one.grip <= step.index < one.release), None)


class Look(NamedTuple):
    """What is seen after a plan, what should be, what may be touched, and where the tool is.

    ``doubt``: how uncertain what is seen is beside what was aimed at; ``still``: ids of what must
    stay where it was; ``nearly``: ids of what may be brought nearer to its place, where nothing
    else is left to do.
    """

    seen: Scene
    goal: Scene
    touched: Sequence[str] | None
    here: Pose
    doubt: Doubt = SURE
    still: Collection[str] = ()
    nearly: Collection[str] = ()

    def beside(self) -> list[tuple[SceneObject, SceneObject | None]]:
        """What is not where it should be; where all is, what could be nearer of ``nearly``."""
        if not self.nearly:
            return strays(self.goal, self.seen, self.doubt, self.still)
        seen = {item.id: item for item in self.seen}
        return [(want, seen[want.id]) for want in self.goal if want.id in self.nearly]


def left(
    forecast: Forecast, missed: Carry, look: Look, tries: int, step: StepReport | None = None
) -> tuple[Command, ...] | None:
    """The motions that are left of a plan whose gripper lost something; None where none help.

    ``tries``: how often it was tried; ``step``: the one that lost it.
    """
    before = forecast.after(missed.first)
    if any(want.id != missed.id for want, _ in strays(before, look.seen, look.doubt)):
        return None
    now = next((item for item in look.seen if item.id == missed.id), None)
    if now is None or not _can_be_taken(now, before.get(missed.id)):
        return None
    there = forecast.after(min(missed.release + 1, len(forecast.commands))).get(missed.id)
    carried = step is not None and step.index > missed.grip
    dropped = now.on == there.on and math.dist(now.position, there.position) < DROPPED
    motions = _aimed(forecast, missed, look.seen, tries, turned_yet=carried and dropped)
    motions += _following(forecast, missed.last + 1, look.seen)
    return freed(motions, look.here)


def mendings(
    forecast: Forecast, plan: Sequence[Carry], look: Look, tries: int
) -> Iterator[tuple[Command, ...]]:
    """Ways to put right what a plan, run to its end, brought elsewhere, the first to be tried
    first; none where none help.

    What was carried is carried again, first it alone, for it may push the rest along; what was
    pushed is pushed the rest of the way along its own sides, or slid there with the tool on its
    top: first so where a push has been tried again.
    """
    pushes = (_Order.LONGER, _Order.SHORTER, _Order.SLID)
    orders = sorted(pushes, key=lambda order: tries > 1 and order is not _Order.SLID)
    ways = (_mending(forecast, plan, look, tries, order) for order in (_Order.ALONG, *orders))
    yield from dict.fromkeys(way for way in ways if way is not None)


def _mending(
    forecast: Forecast, plan: Sequence[Carry], look: Look, tries: int, order: _Order
) -> tuple[Command, ...] | None:
    last = {carry.id: carry for carry in plan}
    motions: list[Command] = []
    for want, got in sorted(
        look.beside(), key=lambda pair: pair[0].held
    ):  # what stays held comes last
        asked = look.touched is None or want.id in look.touched
        if got is None or not asked or not _can_be_taken(got, want):
            return None
        if want.id in last:
            carry = last[want.id]
            again = _aimed(forecast, carry, look.seen, tries, turned_yet=bool(look.nearly))
            motions += _let_down(again, want, got)
        elif order is _Order.ALONG:
            continue
        elif want.held or want.on not in (got.on, "floor"):
            return None
        elif order is _Order.SLID and want.on != "floor":
            motions += _slid(got, want)
        else:
            motions += _pushed(got, want, order)
    return freed(motions + _back(forecast.commands, motions), look.here) if motions else None


def _let_down(carry: Sequence[Command], want: SceneObject, got: SceneObject) -> list[Command]:
    """The carry with its thing, as tall as it is seen now, let down onto the table where it was
    dropped before: it rolled."""
    number = next((n for n, one in enumerate(carry) if _is_release(one)), None)
    top = want.z + got.tall
    if number is None or want.on != "table" or carry[number].z <= top:
        return list(carry)
    low = replace(carry[number], op="move", z=top, grip=True)
    return [*carry[:number], low, replace(carry[number], z=top), *carry[number + 1 :]]


def _back(commands: Sequence[Command], motions: Sequence[Command]) -> list[Command]:
    """The tool where the plan left it, from above: a program may have said where it is to wait."""
    end, here = commands[-1], motions[-1]
    if (here.x, here.y, here.z, here.r) == (end.x, end.y, end.z, end.r):
        return []
    high = max(HIGH, here.z, end.z)
    up, over = Pose(here.x, here.y, high, here.r), Pose(end.x, end.y, high, end.r)
    way = (up, over, Pose(end.x, end.y, end.z, end.r))
    return [Command("move", to.x, to.y, to.z, to.r, here.grip, end.line) for to in way]


def _can_be_taken(now: SceneObject, then: SceneObject) -> bool:
    return now.on != "floor" and not now.held and now.upright == then.upright


def freed(motions: Sequence[Command], here: Pose) -> tuple[Command, ...]:
    """The motions after suction is off and the tool is straight up, clear of everything."""
    high = max((one.z for one in motions), default=HIGH)
    line = motions[0].line if motions else 0
    return (
        Command("grip", here.x, here.y, here.z, here.r, False, line),
        Command("move", here.x, here.y, max(here.z, high), here.r, False, line),
        *motions,
    )


def _following(forecast: Forecast, on: int, seen: Scene) -> list[Command]:
    """The commands from number ``on``, aimed anew where they take from the tray: it closes up."""
    motions = list(forecast.commands[on:])
    for carry in carries(forecast):
        if carry.first >= on and any(item.id == carry.id for item in seen.tray):
            motions[carry.first - on : carry.last + 1 - on] = _aimed(forecast, carry, seen, 0)
    return motions


def _pushed(item: SceneObject, want: SceneObject, order: _Order) -> list[Command]:
    """Pushes against the middles of a thing's own sides until it is there."""
    (x, y), (to_x, to_y) = item.position, want.position
    cos, sin = math.cos(item.r), math.sin(item.r)
    ways = sorted(
        (
            ((to_x - x) * cos + (to_y - y) * sin, cos, sin, item.width),
            ((to_y - y) * cos - (to_x - x) * sin, -sin, cos, item.height),
        ),
        key=lambda way: -abs(way[0]),
    )
    if want.on == "floor":
        ways = ways[:1]
    elif order is _Order.SHORTER:
        ways.reverse()
    low = item.z + min(LOW, item.tall / 2)
    motions: list[Command] = []
    for long, ux, uy, size in ways:
        if abs(long) > EXACT:
            side = math.copysign(size / 2, long)
            clear, near = (
                math.copysign(_clear(item, ux, uy), long),
                math.copysign(TOOL_RADIUS, long),
            )
            start = (x - ux * clear, y - uy * clear)
            x, y = x + ux * long, y + uy * long
            end = (x - ux * (side + near), y - uy * (side + near))
            path = ((start, HIGH), (start, low), (end, low), (end, HIGH))
            motions += [Command("move", *at, z, 0.0, False) for at, z in path]
    return motions


def _slid(item: SceneObject, want: SceneObject) -> list[Command]:
    """A thing slid to its place, and turned back, by suction on its top: as in the language's own
    ``drag``."""
    start, end, spin = item.position, want.position, turned(item, want)
    spin = spin if abs(spin) > TURNED else 0.0
    return [
        Command("move", *start, HIGH, 0.0, False),
        Command("move", *start, item.top, 0.0, False),
        Command("grip", *start, item.top, 0.0, True),
        Command("move", *end, item.top, spin, True),
        Command("grip", *end, item.top, spin, False),
        Command("move", *end, HIGH, spin, False),
    ]


def _clear(item: SceneObject, ux: float, uy: float) -> float:
    """How far from a thing's middle, that way, the tool comes down clear of it, however it is
    turned."""
    half_x, half_y = extents(item)
    return RUN_UP + min(half_x / max(abs(ux), 1e-6), half_y / max(abs(uy), 1e-6))


def _place(id_: str, scene: Scene) -> tuple[float, float] | None:
    """Where a thing stands, or waits; None where the tray has no room for it."""
    item = scene.get(id_)
    return tray_positions(scene).get(id_) if item.on == "tray" else item.position


def _aimed(
    forecast: Forecast, carry: Carry, seen: Scene, tries: int, turned_yet: bool = False
) -> list[Command]:
    """The carry with its grip where the thing is now, or beside its middle if it was there.

    ``turned_yet``: it is nearly in its place, so the carry has turned it as it should, which the
    tool knows better than the eye.
    """
    commands, before = forecast.commands, forecast.after(carry.grip)
    pick, then, now = commands[carry.grip], before.get(carry.id), seen.get(carry.id)
    tray = forecast.scene if then.on == "tray" else before
    (x, y), (at_x, at_y) = (
        _place(carry.id, tray) or _spot(pick),
        _place(carry.id, seen) or _spot(pick),
    )
    missed = math.hypot(at_x - x, at_y - y) > MOVED
    share = GRIPS[(tries - 1 if missed else tries) % len(GRIPS)] if tries else 0.0
    off = _rotated(share * now.width, 0.0, now.r)
    spin = turned(then, now) if abs(turned(then, now)) > TURNED else 0.0
    if turned_yet and carry.release < len(commands):
        spin = commands[carry.release].r - pick.r
    aimed: list[Command] = []
    for number in range(carry.first, carry.last + 1):
        one = commands[number]
        lift = number == carry.grip + 1 and _spot(one) == _spot(pick)
        if number <= carry.grip or lift:  # above it, down, and up again with it
            dx, dy = at_x - x + off[0], at_y - y + off[1]
            dz = now.top - then.top if one.z == pick.z else 0.0
        elif carry.release == len(commands):  # it stays held: what is said is where the tool is
            dx = dy = dz = 0.0
        else:
            (dx, dy), dz = _rotated(*off, one.r - pick.r - spin), 0.0
            if number <= carry.release and one.z < HIGH:  # as tall as it is known to be by now
                dz = now.tall - then.tall
        r = one.r + spin if number <= carry.grip else one.r
        aimed.append(replace(one, x=one.x + dx, y=one.y + dy, z=one.z + dz, r=r))
    return aimed


def _rotated(x: float, y: float, angle: float) -> tuple[float, float]:
    cos, sin = math.cos(angle), math.sin(angle)
    return x * cos - y * sin, x * sin + y * cos

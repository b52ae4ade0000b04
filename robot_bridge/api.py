"""The Robot protocol, a robot's limits, and the only thing a robot runs: an approved plan.

Every driver (ideal, PyBullet, Dobot) meets `Robot`; one set of contract tests runs over all.
`approve` is the last check before any motion and the only maker of an `ApprovedPlan`: whoever
holds a robot (agent, bridge service, test) must pass commands through it.
Poses are in the table frame (`scene.types`); millimetres and degrees live inside a driver.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Protocol, runtime_checkable

import msgspec

from agent.errors import ConfigError, Unreachable
from agent.messages import Command, KeepOut, StepReport, Waypoint
from robot_bridge.motion import ACCELERATION, TURN_SPEED, pieces, seconds, turn
from robot_bridge.motion import crosses as crosses
from robot_bridge.motion import distance as distance
from robot_bridge.motion import length as length
from robot_bridge.things import TOOL_RADIUS as TOOL_RADIUS
from scene.types import Pose, Scene

if TYPE_CHECKING:
    from scene.sight import Pixels, View

TRAVEL_SPEED = 1.25
"""Default speed of the end effector, table units per second (0.25 m/s on a 0.40 m table)."""

PARK = Pose(0.0, -1.2, 0.9)
"""Where an arm waits, and goes home: before the near edge, out of the camera's way."""


PIECE = 0.05
"""Length of the pieces in which a way is held against the reach (table units)."""


class Limits(msgspec.Struct, frozen=True):
    """What a robot may do, whatever the program: a box, what to keep out of, and how fast.

    Table units, radians, units and radians per second, units per second squared. The box reaches
    beyond the table's edges so that things can be pushed off, and to the tray; its floor is the
    table. ``everywhere``: whatever lies in the box can be reached. ``simulated``: nothing real
    moves. ``yields``: a motion down ends, without harm, at what the tool or its load meets, and
    where it ended is told.
    """

    x: tuple[float, float] = (-1.7, 1.7)
    y: tuple[float, float] = (-1.7, 1.7)
    z: tuple[float, float] = (0.0, 1.5)
    r: tuple[float, float] = (-math.pi, math.pi)
    speed: float = TRAVEL_SPEED
    commands: int = 500
    length: float = 200.0
    acceleration: float = ACCELERATION
    turn_speed: float = TURN_SPEED
    keep_outs: tuple[KeepOut, ...] = ()
    everywhere: bool = False
    simulated: bool = False
    yields: bool = False

    def slowed(self, share: float) -> Limits:
        """These limits with a share of both speeds, above 0 and at most 1: never faster.

        Raises ConfigError.
        """
        if not 0 < share <= 1:
            raise ConfigError(f"the speed must be above 0 and at most 100 %, not {100 * share:g} %")
        return msgspec.structs.replace(
            self, speed=self.speed * share, turn_speed=self.turn_speed * share
        )


class Workspace(Protocol):
    """Where an arm can go: every Robot is one."""

    @property
    def limits(self) -> Limits:
        """The workspace, fixed for the robot's life."""
        ...

    def reach(self, pose: Pose) -> str | None:
        """None if the pose can be reached, else why not."""
        ...


_SEAL = object()


class ApprovedPlan:
    """A whole trajectory that passed the check; immutable, made by `approve` alone.

    ``told`` are the primitives after clipping rounding errors to the box, ``durations`` their
    times in seconds, ``start`` the pose from which the first one goes: a robot that stands
    elsewhere refuses the plan.
    """

    __slots__ = ("durations", "limits", "program", "scene", "start", "told")

    start: Pose
    told: tuple[Command, ...]
    durations: tuple[float, ...]
    limits: Limits
    program: str
    scene: Scene | None

    def __init__(self, seal: object, **fields: object) -> None:
        if seal is not _SEAL:
            raise TypeError("an ApprovedPlan is made by robot_bridge.api.approve only")
        for name in self.__slots__:
            object.__setattr__(self, name, fields[name])

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError("an ApprovedPlan cannot be changed")

    @property
    def digest(self) -> str:
        """SHA-256 over program, scene, primitives and limits."""
        told = [
            (one.op, *map(float, (one.x, one.y, one.z, one.r)), one.grip, one.line, one.statement)
            for one in self.told
        ]
        words = [self.program, self.scene, told, self.limits]
        return hashlib.sha256(msgspec.json.encode(words)).hexdigest()


def approve(
    commands: Sequence[Command],
    start: Pose,
    workspace: Workspace,
    program: str = "",
    scene: Scene | None = None,
) -> ApprovedPlan:
    """Check a whole trajectory against a robot's limits and reach, and seal it.

    Every point of it lies in the box, on no straight way through a keep-out, and within reach
    (looked at every `PIECE` units). Raises Unreachable naming the first offending point and line.
    Nothing is sent to the robot.
    """
    limits = workspace.limits
    if len(commands) > limits.commands:
        raise Unreachable(f"the plan has {len(commands)} motions; {limits.commands} is the limit")
    told: list[Command] = []
    durations: list[float] = []
    total, here = 0.0, start
    for command in commands:
        if command.op == "grip":
            told.append(_at(command, here))
            durations.append(0.0)
            continue
        goal = _within(command, limits)
        _clear(here, goal, command.line, workspace)
        span = length(here, goal)
        total += span
        if total > limits.length:
            raise Unreachable(f"the path is longer than {limits.length:.0f} units", command.line)
        way = max(span, abs(turn(here, goal)) * limits.speed / limits.turn_speed)
        durations.append(seconds(way, limits.speed, limits.acceleration))
        told.append(_at(command, goal))
        here = goal
    return ApprovedPlan(
        _SEAL, start=start, told=tuple(told), durations=tuple(durations), limits=limits,
        program=program, scene=scene,
    )  # fmt: skip


def parking(pose: Pose) -> tuple[Command, ...]:
    """The primitives that take an arm from a pose up and to `PARK`."""
    up = max(pose.z, PARK.z)
    return (
        Command("move", pose.x, pose.y, up, PARK.r, False),
        Command("move", PARK.x, PARK.y, PARK.z, PARK.r, False),
    )


def _clear(start: Pose, goal: Pose, line: int, workspace: Workspace) -> None:
    """Raises Unreachable where the straight way meets a keep-out or leaves the reach."""
    for zone in workspace.limits.keep_outs:
        if crosses(start, goal, zone, TOOL_RADIUS):
            text = f"the way to {_point(goal)} leads through the keep-out {zone.name}"
            raise Unreachable(text, line)
    if workspace.limits.everywhere:
        return
    for pose in pieces(start, goal, PIECE):
        why = workspace.reach(pose)
        if why is not None:
            raise Unreachable(f"{_point(pose)} is out of reach: {why}", line)


def _at(command: Command, pose: Pose) -> Command:
    """The command at this pose; itself if it is there."""
    if (command.x, command.y, command.z, command.r) == (pose.x, pose.y, pose.z, pose.r):
        return command
    return msgspec.structs.replace(command, x=pose.x, y=pose.y, z=pose.z, r=pose.r)


def _within(command: Command, limits: Limits) -> Pose:
    """Where the command goes, rounding errors clipped to the box. Raises Unreachable outside it."""
    return Pose(
        _clipped(command, "x", command.x, limits.x),
        _clipped(command, "y", command.y, limits.y),
        _clipped(command, "z", command.z, limits.z),
        _clipped(command, "r", _angle(command.r), limits.r),
    )


def _angle(r: float) -> float:
    """The angle by its shorter name."""
    return math.remainder(r, math.tau) if math.isfinite(r) else r


def _clipped(command: Command, axis: str, value: float, range_: tuple[float, float]) -> float:
    low, high = range_
    if low <= value <= high:
        return value
    if not math.isfinite(value):
        raise Unreachable(f"{axis} is not a finite number", command.line)
    if not low - 1e-6 <= value <= high + 1e-6:
        text = f"{_point(command)} leaves the workspace: {axis} must be in [{low}, {high}]"
        raise Unreachable(text, command.line)
    return min(max(value, low), high)


def _point(at: Command | Pose) -> str:
    return f"({at.x:.2f}, {at.y:.2f}, {at.z:.2f})"


def waypoint(command: Command) -> Waypoint:
    """The command as an entry of a trajectory."""
    return Waypoint(command.x, command.y, command.z, command.r, command.grip)


@runtime_checkable
class Robot(Workspace, Protocol):
    """What every arm does. Methods may raise RobotError and its kinds, nothing else."""

    def pose(self) -> Pose:
        """The measured pose, never the last target."""
        ...

    def run(self, plan: ApprovedPlan) -> Iterator[StepReport]:
        """Run the plan, one report a primitive as it ends. Raises Stopped after a stop."""
        ...

    def stop(self, now: bool = False) -> None:
        """From any thread: slow down, hold, keep the grip, latch. ``now``: force-stop."""
        ...

    def reset(self) -> None:
        """Clear the latch and alarms; never moves."""
        ...

    def close(self) -> None:
        """Release the robot; never waits."""
        ...


@runtime_checkable
class Simulated(Robot, Protocol):
    """A robot that carries its own world, or a belief of it where it is a real one."""

    def load(self, scene: Scene) -> None:
        """Make the world be this scene, arm parked, gripper empty; a real arm does not move."""
        ...

    def scene(self) -> Scene:
        """The world as it is now."""
        ...


@runtime_checkable
class Pictured(Protocol):
    """A simulated robot whose table can be looked at from overhead."""

    def picture(self, width: int, height: int) -> Pixels:
        """What the camera sees now: (height, width, 3), RGB, rows from far to near."""
        ...

    def view(self, width: int, height: int) -> View:
        """How such a picture shows the table, exactly."""
        ...

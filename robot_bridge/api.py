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
from typing import Protocol, runtime_checkable

import msgspec

from agent.errors import Unreachable
from agent.messages import Command, StepReport, Waypoint
from scene.types import Pose, Scene

TRAVEL_SPEED = 1.25
"""Default speed of the end effector, table units per second (0.25 m/s on a 0.40 m table)."""

PARK = Pose(0.0, -1.2, 0.9)
"""Where an arm waits and where `Robot.home` goes: before the near edge, out of the camera's way."""


class Limits(msgspec.Struct, frozen=True):
    """Workspace of a robot (table units, radians, units per second), whatever the program.

    The box reaches beyond the table's edges so that things can be pushed off, and to the tray.
    """

    x: tuple[float, float] = (-1.7, 1.7)
    y: tuple[float, float] = (-1.7, 1.7)
    z: tuple[float, float] = (0.0, 1.5)
    r: tuple[float, float] = (-math.pi, math.pi)
    speed: float = TRAVEL_SPEED
    commands: int = 500
    length: float = 200.0


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
    times at full speed in seconds, ``digest`` a SHA-256 over program, commands and limits.
    """

    __slots__ = ("digest", "durations", "told")

    told: tuple[Command, ...]
    durations: tuple[float, ...]
    digest: str

    def __init__(
        self, seal: object, told: tuple[Command, ...], durations: tuple[float, ...], digest: str
    ) -> None:
        if seal is not _SEAL:
            raise TypeError("an ApprovedPlan is made by robot_bridge.api.approve only")
        object.__setattr__(self, "told", told)
        object.__setattr__(self, "durations", durations)
        object.__setattr__(self, "digest", digest)

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError("an ApprovedPlan cannot be changed")


def approve(
    commands: Sequence[Command], start: Pose, workspace: Workspace, program: str = ""
) -> ApprovedPlan:
    """Check a whole trajectory against a robot's limits and reach, and seal it.

    Raises Unreachable naming the first offending point and line. Nothing is sent to the robot.
    """
    limits = workspace.limits
    if len(commands) > limits.commands:
        raise Unreachable(f"the plan has {len(commands)} motions; {limits.commands} is the limit")
    told, durations = [], []
    x, y, z, r = start.x, start.y, start.z, start.r
    total = 0.0
    for command in commands:
        settled = _within(command, limits)
        if settled.op == "grip":
            settled = msgspec.structs.replace(settled, x=x, y=y, z=z, r=r)
            durations.append(0.0)
        else:
            why = workspace.reach(Pose(settled.x, settled.y, settled.z, settled.r))
            if why is not None:
                raise Unreachable(f"{_point(settled)} is out of reach: {why}", settled.line)
            span = math.dist((x, y, z), (settled.x, settled.y, settled.z))
            total += span
            durations.append(span / limits.speed)
            x, y, z, r = settled.x, settled.y, settled.z, settled.r
        told.append(settled)
    if total > limits.length:
        raise Unreachable(f"the path is {total:.1f} units long; {limits.length:.0f} is the limit")
    digest = hashlib.sha256(
        msgspec.json.encode([program, [msgspec.structs.astuple(c) for c in told], limits])
    ).hexdigest()
    return ApprovedPlan(_SEAL, tuple(told), tuple(durations), digest)


def _within(command: Command, limits: Limits) -> Command:
    """The command with rounding errors clipped to the box. Raises Unreachable outside it."""
    clipped: dict[str, float] = {}
    for axis in ("x", "y", "z", "r"):
        value: float = getattr(command, axis)
        low, high = getattr(limits, axis)
        if not math.isfinite(value):
            raise Unreachable(f"{axis} is not a finite number", command.line)
        if axis == "r":
            value = math.remainder(value, math.tau)
        if not low - 1e-6 <= value <= high + 1e-6:
            text = f"{_point(command)} leaves the workspace: {axis} must be in [{low}, {high}]"
            raise Unreachable(text, command.line)
        clipped[axis] = min(max(value, low), high)
    return msgspec.structs.replace(command, **clipped)


def _point(command: Command) -> str:
    return f"({command.x:.2f}, {command.y:.2f}, {command.z:.2f})"


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

    def home(self) -> Pose:
        """Go to the parking pose and return it."""
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
    """A robot that carries its own world."""

    def load(self, scene: Scene) -> None:
        """Make the world be this scene, arm parked, gripper empty."""
        ...

    def scene(self) -> Scene:
        """The world as it is now."""
        ...

"""Where a Dobot Magician stands at the table: table frame to millimetres and back, and its reach.

The only place that knows both: one scale s (mm per table unit), ``(x_r, y_r) = (c, d) + s R (y,
-x)``, ``z_r = s z + floor``, ``r_r`` in degrees; (c, d) is the table's middle as the arm has it, R
turns by ``turn`` and ``floor`` is what it reads when the cup touches the table. What is configured
may be outranked by a calibration (`robot_bridge.dobot_fit`). Source: docs/dobot.md, robot.md 7.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import msgspec

from agent.config import DobotConfig
from agent.messages import KeepOut
from robot_bridge import dobot_alarms as alarms
from robot_bridge.api import Limits
from robot_bridge.kinematics import FORE, UPPER, Joints, inverse
from scene.types import EDGE, Pose, Scene

JOINTS = ((-90.0, 90.0), (0.0, 85.0), (-10.0, 90.0), (-90.0, 90.0))
"""Limits of j1 to j4 (degrees, vendor)."""
SLACK = 1e-6
"""Rounding that a joint's limit forgives (degrees)."""


class Millimetres(NamedTuple):
    """A pose in the arm's frame: x forward, y left, z up from the shoulder (mm), r (degrees)."""

    x: float
    y: float
    z: float
    r: float

    def apart(self, other: Millimetres) -> float:
        """Distance of two positions (mm)."""
        return math.dist(self[:3], other[:3])

    def turned(self, other: Millimetres) -> float:
        """Angle between two rotations, by the shorter way (degrees)."""
        return abs(math.remainder(self.r - other.r, 360.0))


class Fault(NamedTuple):
    """Why a pose cannot be taken: the alarm that the controller would raise, and in words."""

    code: int
    why: str


def joints_at(at: Millimetres, tool: float) -> Joints | Fault:
    """The joints (radians) that take the tool there, or why they cannot.

    ``tool``: from the wrist's axis to the tool's (mm). Of j4's names the one within its limits.
    """
    solved = inverse(at.x, at.y, at.z, math.radians(at.r), tool)
    if solved is None:
        return Fault(alarms.OUT_OF_REACH, _beyond(at, tool))
    joints = solved._replace(j4=math.remainder(solved.j4, math.tau))
    for number, (value, (low, high)) in enumerate(zip(joints, JOINTS, strict=True), 1):
        degrees = math.degrees(value)
        if not low - SLACK <= degrees <= high + SLACK:
            why = f"joint {number} would have to be at {degrees:.0f}°, of {low:.0f} to {high:.0f}"
            return Fault(alarms.JOINT_LIMIT, why)
    return joints


def _beyond(at: Millimetres, tool: float) -> str:
    """In words, on which side of what the two links span the point lies."""
    span = math.hypot(math.hypot(at.x, at.y) - tool, at.z)
    if span > UPPER + FORE:
        return f"{span - UPPER - FORE:.0f} mm farther than the arm is long"
    return "too near the arm's own axis"


class Cell:
    """An arm at its table, as configured: a Workspace (`robot_bridge.api`) without any port."""

    def __init__(self, config: DobotConfig, keep_outs: Sequence[KeepOut] = ()) -> None:
        self._config = config
        self._limits = Limits(
            speed=config.speed / config.scale,
            acceleration=config.acceleration / config.scale,
            turn_speed=math.radians(config.speed),
            keep_outs=tuple(keep_outs),
        )

    @property
    def limits(self) -> Limits:
        """The workspace: the box of all arms, and this one's speeds (81 turns at as many degrees a
        second as it goes millimetres)."""
        return self._limits

    def reach(self, pose: Pose) -> str | None:
        """None if the arm can be there, else why not."""
        found = joints_at(self._plain(pose), self._config.tool)
        return found.why if isinstance(found, Fault) else None

    def share(self) -> float:
        """Share of the table that can be reached at every height from 0 to 60 mm."""
        steps = [EDGE * ((n + 0.5) / 10 - 1) for n in range(20)]
        heights = [10 * n / self._config.scale for n in range(7)]
        fits = [
            all(self.reach(Pose(x, y, z)) is None for z in heights) for x in steps for y in steps
        ]
        return sum(fits) / len(fits)

    def at_scale(self, scene: Scene) -> Scene:
        """The scene on a table of this arm's size: what centimetres in a sentence mean there."""
        return msgspec.structs.replace(scene, table_m=2 * EDGE * self._config.scale / 1000)

    def millimetres(self, pose: Pose) -> Millimetres:
        """A pose of the table frame as the arm is told it. Raises ValueError beyond its reach."""
        plain = self._plain(pose)
        joints = joints_at(plain, self._config.tool)
        if isinstance(joints, Fault):
            raise ValueError(joints.why)
        return plain._replace(r=math.degrees(joints.j1 + joints.j4))

    def pose(self, at: Millimetres) -> Pose:
        """What the arm reads as a pose of the table frame."""
        scale, (ahead, left) = self._config.scale, self._config.offset
        turn = math.radians(self._config.turn)
        forward, leftward = _turned(at.x - ahead, at.y - left, -turn)
        return Pose(
            0.0 - leftward / scale,
            forward / scale,
            (at.z - self._config.floor) / scale,
            math.remainder(math.radians(at.r) - turn, math.tau),
        )

    def _plain(self, pose: Pose) -> Millimetres:
        scale, (ahead, left) = self._config.scale, self._config.offset
        turn = math.radians(self._config.turn)
        forward, leftward = _turned(scale * pose.y, -scale * pose.x, turn)
        return Millimetres(
            ahead + forward,
            left + leftward,
            scale * pose.z + self._config.floor,
            math.degrees(pose.r + turn),
        )


def _turned(x: float, y: float, angle: float) -> tuple[float, float]:
    """Turned counter-clockwise (radians)."""
    return (
        x * math.cos(angle) - y * math.sin(angle),
        x * math.sin(angle) + y * math.cos(angle),
    )

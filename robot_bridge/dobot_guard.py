"""The last look at what goes out to a Dobot: every frame passes here, whoever made it (pure).

Plans are checked as a whole before (`robot_bridge.api.approve`); this holds even where something
else sends: no motion but straight ones to points within reach and above the table, no speed above
the configured one, no other tool than the one that reach is computed for.
"""

from __future__ import annotations

import math
import struct
from typing import NamedTuple

from agent.config import DobotConfig
from agent.errors import NotReady, Unreachable
from robot_bridge import dobot_frames
from robot_bridge.dobot_cell import Fault, Millimetres, joints_at
from robot_bridge.dobot_frames import QUEUED, READ, Frame, floats, read_floats

STRAIGHT = 2
"""MOVL: the tool stays on a line."""
FASTEST_ACCELERATION = 400.0
JOINT_SPEED = 200.0
ROUNDING = 0.01
"""How far below the table float32 may put the table (mm)."""


_SPEEDS = (dobot_frames.PTP_COORDINATE, dobot_frames.PTP_COMMON, dobot_frames.PTP_JOINT)


class Bounds(NamedTuple):
    """What a frame is held against: the tool's offset, the table's height, the largest speed."""

    tool: float
    floor: float
    fastest: float


def bounds(config: DobotConfig) -> Bounds:
    """Those of a configured arm."""
    return Bounds(config.tool, config.floor, config.speed)


def admit(frame: Frame, limits: Bounds) -> None:
    """Let a frame pass. Raises Unreachable or NotReady where it would do what it must not."""
    if frame.ctrl == READ:
        return
    if frame.id == dobot_frames.PTP:
        _motion(frame, limits)
    elif frame.id in dobot_frames.MOTIONS and (frame.id, frame.ctrl) != (dobot_frames.HOME, QUEUED):
        raise NotReady(f"command {frame.id} moves the arm past the check")
    elif frame.id == dobot_frames.TOOL and frame.params != floats(limits.tool, 0, 0):
        raise NotReady("the arm's reach is computed for another tool")
    elif frame.id in _SPEEDS:
        _speeds(frame, limits)


def _motion(frame: Frame, limits: Bounds) -> None:
    if frame.ctrl != QUEUED or len(frame.params) != 17 or frame.params[0] != STRAIGHT:
        raise NotReady("a motion is straight, and goes through the queue")
    target = Millimetres(*read_floats(frame.params[1:]))
    if not all(map(math.isfinite, target)):
        raise Unreachable("the target is not a finite number")
    if target.z < limits.floor - ROUNDING:
        raise Unreachable(f"{limits.floor - target.z:.1f} mm below the table")
    found = joints_at(target, limits.tool)
    if isinstance(found, Fault):
        raise Unreachable(found.why)


def _fastest(command: int, top: float) -> tuple[float, ...]:
    """The largest numbers that a command for speeds may carry."""
    if command == dobot_frames.PTP_COORDINATE:
        return (top, top, FASTEST_ACCELERATION, FASTEST_ACCELERATION)
    return (100.0, 100.0) if command == dobot_frames.PTP_COMMON else (JOINT_SPEED,) * 8


def _speeds(frame: Frame, limits: Bounds) -> None:
    most = _fastest(frame.id, limits.fastest)
    if len(frame.params) != 4 * len(most):
        raise NotReady(f"command {frame.id} takes {len(most)} numbers")
    told = struct.unpack(f"<{len(most)}f", frame.params)
    if not all(0 < value <= top for value, top in zip(told, most, strict=True)):
        raise NotReady(f"{', '.join(f'{value:g}' for value in told)} are beyond the limits")

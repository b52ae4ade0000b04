"""Motions that no program asks for: home, and small steps by hand. Plans like any other."""

from __future__ import annotations

from typing import Literal, Protocol, runtime_checkable

import msgspec

from agent.messages import Command
from robot_bridge.api import PARK, ApprovedPlan, Robot, Workspace, approve, parking
from robot_bridge.motion import length
from scene.types import Pose

Axis = Literal["x", "y", "z", "r"]

PARKED = 0.02
"""How near to where it waits a homed arm is parked (table units)."""


@runtime_checkable
class Homing(Protocol):
    """An arm that has to find its own zero after power-on."""

    def home(self) -> Pose:
        """Find it, by the controller's own motion; where the arm is then."""
        ...


def go_home(robot: Robot) -> Pose:
    """Home an arm that can be homed, and park it; where it is then. Raises RobotError."""
    if isinstance(robot, Homing) and length(robot.home(), PARK) <= PARKED:
        return robot.pose()
    pose = robot.pose()
    for _ in robot.run(approve(parking(pose), pose, robot)):
        pass
    return robot.pose()


def step(start: Pose, workspace: Workspace, axis: Axis, amount: float) -> ApprovedPlan:
    """A straight way along one axis (table units; radians for r). Raises Unreachable."""
    goal = msgspec.structs.replace(start, **{axis: getattr(start, axis) + amount})
    return approve([Command("move", goal.x, goal.y, goal.z, goal.r, False)], start, workspace)

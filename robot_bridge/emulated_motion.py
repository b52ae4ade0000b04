"""How an emulated Dobot gets from one pose to the next: a trapezoid of speed, one way or the other.

Straight motions (MOVL) keep the tool on a line, joint motions turn the joints; either may be broken
off on the way, where the arm could not go on. Millimetres, degrees, seconds of the emulated clock.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from robot_bridge import dobot_alarms as alarms
from robot_bridge.dobot_cell import Fault, Millimetres, joints_at
from robot_bridge.kinematics import Joints, forward

SAMPLE = 5.0
"""Distance between two looks at whether a straight way can be gone (mm)."""
JUMP, LINEAR_MODES, JOINT_GOALS = (0, 3, 9), (2, 5, 7), (3, 4, 5)
"""Modes that lift first; that go straight; whose goal is in joint angles."""


def travelled(way: float, speed: float, acceleration: float, time: float) -> float:
    """How far a motion has come that starts and ends at rest."""
    top = min(speed, math.sqrt(way * acceleration))
    ramp, total = top / acceleration, way / top + top / acceleration
    if time >= total:
        return way
    if time < ramp:
        return acceleration * time * time / 2
    if time > total - ramp:
        return way - acceleration * (total - time) ** 2 / 2
    return top * (time - ramp / 2)


class Travel(NamedTuple):
    """One motion: where from and to, how fast; ``until`` is the share of it that can be made, and
    ``alarm`` what is raised there (0: none)."""

    start: Millimetres
    goal: Millimetres
    straight: bool
    speed: float
    acceleration: float
    tool: float
    until: float = 1.0
    alarm: int = 0

    @property
    def way(self) -> float:
        """Millimetres, or degrees where the tool turns more than it moves."""
        return max(self.start.apart(self.goal), self.start.turned(self.goal), 1e-6)

    @property
    def seconds(self) -> float:
        """How long it takes, to where it ends."""
        top = min(self.speed, math.sqrt(self.way * self.acceleration))
        whole = self.way / top + top / self.acceleration
        return whole if self.until >= 1 else self._when(self.until, whole)

    def _when(self, share: float, whole: float) -> float:
        low, high = 0.0, whole
        for _ in range(40):
            middle = (low + high) / 2
            done = travelled(self.way, self.speed, self.acceleration, middle) / self.way
            low, high = (middle, high) if done < share else (low, middle)
        return high

    def at(self, time: float) -> Millimetres:
        """Where the tool is by then."""
        share = travelled(self.way, self.speed, self.acceleration, max(time, 0.0)) / self.way
        return self.part(min(share, self.until))

    def part(self, share: float) -> Millimetres:
        """Where the tool is after this share of the way."""
        start, goal = joints_at(self.start, self.tool), joints_at(self.goal, self.tool)
        if self.straight or isinstance(start, Fault) or isinstance(goal, Fault):
            pairs = zip(self.start, self.goal, strict=True)
            return Millimetres(*(a + (b - a) * share for a, b in pairs))
        joints = Joints(*(a + (b - a) * share for a, b in zip(start, goal, strict=True)))
        x, y, z, r = forward(joints, self.tool)
        return Millimetres(x, y, z, math.degrees(r))


def plan(
    start: Millimetres, goal: Millimetres, mode: int, speed: float, acceleration: float, tool: float
) -> Travel:
    """The motion as the controller would make it: not at all (``until`` 0) where the goal is out of
    reach, and up to where a straight way leaves the reach."""
    straight = mode in LINEAR_MODES
    travel = Travel(start, goal, straight, speed, acceleration, tool)
    found = joints_at(goal, tool)
    if isinstance(found, Fault):
        return travel._replace(until=0.0, alarm=found.code)
    count = max(1, math.ceil(start.apart(goal) / SAMPLE)) if straight else 1
    for number in range(1, count):
        met = joints_at(travel.part(number / count), tool)
        if isinstance(met, Fault):
            moving = met.code - alarms.OUT_OF_REACH + alarms.OUT_OF_REACH_MOVING
            return travel._replace(until=(number - 1) / count, alarm=moving)
    return travel


def goal_of(mode: int, values: tuple[float, ...], here: Millimetres, tool: float) -> Millimetres:
    """Where a PTP command of this mode goes: a point, joint angles, or increments of either."""
    x, y, z, r = values
    if mode in (7, 8):
        return Millimetres(here.x + x, here.y + y, here.z + z, here.r + r)
    if mode in JOINT_GOALS or mode == 6:
        now = joints_at(here, tool)
        base = now if mode == 6 and isinstance(now, Joints) else Joints(0, 0, 0, 0)
        turned = (one + math.radians(more) for one, more in zip(base, values, strict=True))
        x, y, z, rotation = forward(Joints(*turned), tool)
        return Millimetres(x, y, z, math.degrees(rotation))
    return Millimetres(x, y, z, r)

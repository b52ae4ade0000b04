"""How a simulated tool travels along a line: speed profile and where it is at each step (pure)."""

from __future__ import annotations

import math
from collections.abc import Iterator

from scene.types import Pose

ACCELERATION = 4.0
"""Table units per second squared."""
TURN_SPEED = 3.0
"""Radians per second."""


def profile(length: float, speed: float, step: float) -> list[float]:
    """Way travelled at each time step of a motion that starts and ends at rest (table units).

    Trapezoid (triangle where it is too short for full speed). ``step`` is in seconds.
    """
    top = min(speed, math.sqrt(length * ACCELERATION))
    if top <= 0:
        return []
    ramp = top / ACCELERATION
    total = length / top + ramp
    ways = []
    for tick in range(1, math.ceil(total / step)):
        time = tick * step
        if time < ramp:
            ways.append(ACCELERATION * time * time / 2)
        elif time > total - ramp:
            ways.append(length - ACCELERATION * (total - time) ** 2 / 2)
        else:
            ways.append(top * (time - ramp / 2))
    return [*ways, length]


def along(start: Pose, goal: Pose, speed: float, step: float) -> Iterator[Pose]:
    """The poses of a straight motion, one a time step; the last one is the goal."""
    span = math.dist((start.x, start.y, start.z), (goal.x, goal.y, goal.z))
    turn = math.remainder(goal.r - start.r, math.tau)
    length = max(span, abs(turn) * speed / TURN_SPEED)
    for way in profile(length, speed, step):
        share = way / length
        yield Pose(
            start.x + (goal.x - start.x) * share,
            start.y + (goal.y - start.y) * share,
            start.z + (goal.z - start.z) * share,
            start.r + turn * share,
        )

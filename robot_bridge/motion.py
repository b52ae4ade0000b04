"""The straight ways of an end effector: how long, how turned, through what, in what time (pure).

Lengths in table units, angles in radians, times in seconds.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from agent.messages import KeepOut
from scene.types import Pose

ACCELERATION = 4.0
"""Table units per second squared."""
TURN_SPEED = 3.0
"""Radians per second."""


def length(start: Pose, goal: Pose) -> float:
    """Length of the way of the tip."""
    return math.dist((start.x, start.y, start.z), (goal.x, goal.y, goal.z))


def turn(start: Pose, goal: Pose) -> float:
    """The turn of the tool, by the shorter way round."""
    return math.remainder(goal.r - start.r, math.tau)


def at(start: Pose, goal: Pose, share: float) -> Pose:
    """The pose after this share of the straight way; ``r`` goes on beyond pi."""
    return Pose(
        start.x + (goal.x - start.x) * share,
        start.y + (goal.y - start.y) * share,
        start.z + (goal.z - start.z) * share,
        start.r + turn(start, goal) * share,
    )


def pieces(start: Pose, goal: Pose, piece: float) -> Iterator[Pose]:
    """Poses along the way, no farther apart than ``piece``; the goal is the last."""
    count = max(1, math.ceil(length(start, goal) / piece))
    for number in range(1, count):
        yield at(start, goal, number / count)
    yield goal


def crosses(start: Pose, goal: Pose, zone: KeepOut, margin: float) -> bool:
    """Whether the straight way of the tip comes within ``margin`` of a box (square corners)."""
    first, last = 0.0, 1.0
    for axis in ("x", "y", "z"):
        low, high = getattr(zone, axis)
        begin, end = getattr(start, axis), getattr(goal, axis)
        low, high, way = low - margin - begin, high + margin - begin, end - begin
        if abs(way) < 1e-12:
            if not low < 0 < high:
                return False
            continue
        enters, leaves = sorted((low / way, high / way))
        first, last = max(first, enters), min(last, leaves)
    return first < last


def distance(start: Pose, goal: Pose, zone: KeepOut) -> float:
    """How near the way of the tip comes to a box: the largest margin that it does not cross."""
    near, far = 0.0, 10.0
    for _ in range(40):
        middle = (near + far) / 2
        near, far = (near, middle) if crosses(start, goal, zone, middle) else (middle, far)
    return near


def seconds(length: float, speed: float, acceleration: float = ACCELERATION) -> float:
    """Time of a motion that starts and ends at rest (trapezoid, or triangle where too short)."""
    top = min(speed, math.sqrt(length * acceleration))
    return 0.0 if top <= 0 else length / top + top / acceleration


def profile(length: float, speed: float, step: float) -> list[float]:
    """Way travelled at each time step of a motion that starts and ends at rest."""
    top = min(speed, math.sqrt(length * ACCELERATION))
    if top <= 0:
        return []
    ramp = top / ACCELERATION
    total = seconds(length, speed)
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


def along(
    start: Pose, goal: Pose, speed: float, step: float, turn_speed: float = TURN_SPEED
) -> Iterator[Pose]:
    """The poses of a straight motion, one a time step; the last one is the goal."""
    way = max(length(start, goal), abs(turn(start, goal)) * speed / turn_speed)
    for done in profile(way, speed, step):
        yield at(start, goal, done / way)

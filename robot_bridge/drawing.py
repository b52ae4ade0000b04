"""What the simulated camera sees besides the things: colours, the arm, and the camera (pure)."""

from __future__ import annotations

import math
from typing import NamedTuple

from robot_bridge.kinematics import FORE, UPPER, Joints, inverse
from scene.types import Pose

RGBA = tuple[float, float, float, float]
RGB = tuple[float, float, float]
PALE: RGB = (0.62, 0.60, 0.66)
"""A thing of no known colour."""
BASE = (0.0, -2.0)
"""Where the drawn arm stands (table units)."""
SHOULDER_MM, MOUTH_MM = 138.0, 70.0
"""Height of the shoulder above the table; of the tool's axis above the cup's mouth."""
UNITS_PER_MM = 4.1 / 340
"""The bench arm is drawn as large as its workspace needs."""
THICKNESS = (0.32, 0.20, 0.16, 0.09)
"""Widths of column, rear arm, forearm and tool (table units)."""
_FOLDED = Joints(math.pi / 2, 0.0, 0.9, 0.0)


class Link(NamedTuple):
    """One drawn piece of the arm, from end to end (table units), and its thickness."""

    start: tuple[float, float, float]
    end: tuple[float, float, float]
    thick: float


def arm_links(tip: Pose) -> tuple[Link, ...]:
    """Column, rear arm, forearm and wrist of the arm when its cup is at a pose."""
    scale = UNITS_PER_MM
    x, y = (tip.x - BASE[0]) / scale, (tip.y - BASE[1]) / scale
    height = tip.z / scale + MOUTH_MM - SHOULDER_MM
    joints = inverse(x, y, height, tip.r) or _FOLDED
    shoulder = (BASE[0], BASE[1], SHOULDER_MM * scale)
    cos, sin = math.cos(joints.j1), math.sin(joints.j1)

    def at(radius: float, z: float) -> tuple[float, float, float]:
        return (
            shoulder[0] + radius * cos * scale,
            shoulder[1] + radius * sin * scale,
            shoulder[2] + z * scale,
        )

    out, up = UPPER * math.sin(joints.j2), UPPER * math.cos(joints.j2)
    far, low = out + FORE * math.cos(joints.j3), up - FORE * math.sin(joints.j3)
    elbow, wrist = at(out, up), at(far, low)
    head = (tip.x, tip.y, tip.z + MOUTH_MM * scale)
    ends = ((*BASE, 0.0), shoulder, elbow, wrist, head)
    return tuple(Link(ends[i], ends[i + 1], THICKNESS[i]) for i in range(4))

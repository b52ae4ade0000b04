"""Forward and inverse kinematics of the Dobot Magician's geometry (millimetres, radians).

Base frame: origin in the shoulder's axis at its height, x forward, y to the left, z up. The
suction tool's axis lies ``offset`` beyond the wrist. The simulator draws its arm by it, scaled.
"""

from __future__ import annotations

import math
from typing import NamedTuple

UPPER, FORE = 135.0, 147.0
"""Lengths of the two links (mm, vendor)."""
SUCTION_OFFSET = 59.7
"""From the wrist's axis to the suction tool's (mm, vendor)."""


class Joints(NamedTuple):
    """j1 about the base; j2 of the rear arm from the vertical; j3 of the forearm below the
    horizontal; j4 of the tool (radians)."""

    j1: float
    j2: float
    j3: float
    j4: float


def forward(joints: Joints, offset: float = SUCTION_OFFSET) -> tuple[float, float, float, float]:
    """Joints to tool axis x, y, z (mm) and rotation r (radians)."""
    j1, j2, j3, j4 = joints
    radius = UPPER * math.sin(j2) + FORE * math.cos(j3) + offset
    height = UPPER * math.cos(j2) - FORE * math.sin(j3)
    return radius * math.cos(j1), radius * math.sin(j1), height, j1 + j4


def inverse(
    x: float, y: float, z: float, r: float, offset: float = SUCTION_OFFSET
) -> Joints | None:
    """Tool axis x, y, z (mm), r (radians) to joints; None beyond the links' reach.

    Of the two ways the elbow can bend it takes the one of the real arm. Joint limits are not
    looked at.
    """
    w = math.hypot(x, y) - offset
    span = math.hypot(w, z)
    if span < 1e-9:
        return None
    bend = (span * span + UPPER**2 - FORE**2) / (2 * UPPER * span)
    if abs(bend) > 1:
        return None
    j1 = math.atan2(y, x)
    j2 = math.atan2(w, z) - math.acos(bend)
    j3 = math.atan2(UPPER * math.cos(j2) - z, w - UPPER * math.sin(j2))
    return Joints(j1, j2, j3, r - j1)

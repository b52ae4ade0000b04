"""What stands on or in what, read off the places of things (pure; for the physics simulator)."""

from __future__ import annotations

import math
from collections.abc import Sequence

from robot_bridge.body import Body, fits_in, overlap

Matrix = Sequence[float]
"""Rotation matrix, nine numbers by rows: its columns are the thing's own axes."""
NEAR = 0.04
"""Largest distance between base and top at which one thing stands on another (table units)."""


def oriented(
    size: tuple[float, float, float], turn: Matrix
) -> tuple[float, float, float, float, bool]:
    """Width, height, tall, r and upright of a thing of this size turned by a matrix.

    A lying thing swaps ``tall`` with the extent that now points up, as on the ideal table.
    """
    width, height, tall = size
    up = [abs(turn[6]), abs(turn[7]), abs(turn[8])]
    if up[2] >= max(up[0], up[1]) - 1e-9:
        return width, height, tall, math.atan2(turn[3], turn[0]), turn[8] > 0
    if up[0] >= up[1]:
        r = math.atan2(turn[4], turn[1]) - math.pi / 2
        return tall, height, width, math.remainder(r, math.tau), False
    return width, tall, height, math.atan2(turn[3], turn[0]), False


def base_height(size: tuple[float, float, float], z: float, turn: Matrix) -> float:
    """Height of the lowest point of the thing's box (table units); ``z``: that of its centre."""
    reach = sum(abs(turn[6 + axis]) * size[axis] for axis in range(3)) / 2
    return z - reach


def support_of(body: Body, others: Sequence[Body]) -> str:
    """The id of what the body stands on or lies in, or "table".

    In a container also lies what is too wide for it and has sunk into its mouth.
    """
    found: list[tuple[float, str]] = []
    for other in others:
        if other.id == body.id:
            continue
        hollow = other.hollow and other.covers(body.x, body.y)
        stuck = body.z > other.floor + NEAR
        if (
            hollow
            and (stuck or fits_in(body, other))
            and other.z - 1e-3 <= body.z < other.top - NEAR / 2
        ):
            return other.id
        stands = abs(body.z - other.top) <= NEAR and other.top > NEAR / 2
        if stands and (other.covers(body.x, body.y) or overlap(body, other) > NEAR):
            found.append((other.top, other.id))
    return max(found)[1] if found else "table"

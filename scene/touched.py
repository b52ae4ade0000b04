"""How the arm stands at the table, from points that its tip touched: a similarity (pure).

`x_arm, y_arm = scale * R(x_table, y_table) + offset`: rotation, one scale, no shear, no mirror
(Umeyama 1991, without the reflection). Source: robot.md 7.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import msgspec
import numpy as np

from agent.errors import CalibrationError
from scene.calibration import Standing
from scene.sight import Points

FEWEST = 4
MOST_MM, MOST_FLOOR_MM = 1.0, 2.0
"""A fit is refused beyond: a point's residual in the plane, a height's from the mean (mm)."""
NARROW_MM = 20.0
"""Points must lie apart by so much across the line that they lie along (standard deviation)."""
MOST_SCALE = 0.02
"""By so much (of 1) the scale may differ from the table's configured side."""
SPREAD_MM = 0.2
"""Readings of one touch lie within so much, else the arm was moving."""
_AHEAD = np.array([[0.0, 1.0], [-1.0, 0.0]])
"""Table to arm where nothing is turned: the arm's x is the table's y, its y the table's -x."""


class Touch(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A point of the table (x, y; table units) and what the arm read there (x, y, z; mm)."""

    table: tuple[float, float]
    arm: tuple[float, float, float]


def mean(readings: Sequence[tuple[float, float, float]]) -> tuple[float, float, float]:
    """One touch's readings (mm) as one. Raises CalibrationError where the arm was moving."""
    several = np.array(readings)
    spread = float(np.ptp(several, axis=0).max())
    if not spread <= SPREAD_MM:
        raise CalibrationError(f"the arm moved by {spread:.1f} mm while it was read: hold still")
    x, y, z = several.mean(axis=0)
    return float(x), float(y), float(z)


def fit(touches: Sequence[Touch], side: float, source: str, date: str) -> Standing:
    """How the arm stands at a table of ``side`` mm.

    Raises CalibrationError with reason and remedy where the points do not determine it, or it
    would not be good.
    """
    if len(touches) < FEWEST:
        raise CalibrationError(f"{len(touches)} points were touched, at least {FEWEST} are needed")
    table = np.array([touch.table for touch in touches], np.float64)
    arm = np.array([touch.arm for touch in touches], np.float64)
    if not (np.isfinite(table).all() and np.isfinite(arm).all()):
        raise CalibrationError("a point is not a number")
    _check_spread(arm[:, :2])
    scale, turn, offset = similarity(table, arm[:, :2])
    residuals = _residuals(table, arm[:, :2], scale, turn, offset)
    if residuals.max() > MOST_MM:
        raise CalibrationError(_diagnosis(table, arm[:, :2], residuals))
    floor = float(arm[:, 2].mean())
    uneven = np.abs(arm[:, 2] - floor)
    if uneven.max() > MOST_FLOOR_MM:
        raise CalibrationError(
            f"point {int(uneven.argmax()) + 1} lies {uneven.max():.1f} mm above or below the "
            "others: is arm or table tilted? Level them, touch the table everywhere alike"
        )
    if abs(scale / (side / 2) - 1) > MOST_SCALE:
        raise CalibrationError(
            f"by the arm the table is {2 * scale:.0f} mm wide, [camera] says {side:g}: set table "
            "there to what a ruler says, or touch the points that were asked for"
        )
    return Standing(
        date=date, source=source, scale=scale, offset=(float(offset[0]), float(offset[1])),
        floor=floor, turn=math.degrees(turn), residuals=tuple(map(float, residuals)),
        floor_mm=float(uneven.max()),
    )  # fmt: skip


def similarity(table: Points, arm: Points) -> tuple[float, float, Points]:
    """Scale, turn (radians) and offset (2,) by least squares over points (n, 2) of both frames."""
    ahead = table @ _AHEAD.T
    a, b = ahead - ahead.mean(axis=0), arm - arm.mean(axis=0)
    along, across = float((a * b).sum()), float((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum())
    scale = math.hypot(along, across) / float((a * a).sum())
    turn = math.atan2(across, along)
    moved = scale * ahead.mean(axis=0) @ _rotation(turn).T
    return scale, turn, np.asarray(arm.mean(axis=0) - moved)


def _rotation(turn: float) -> Points:
    return np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])


def _residuals(table: Points, arm: Points, scale: float, turn: float, offset: Points) -> Points:
    expected = scale * table @ _AHEAD.T @ _rotation(turn).T + offset
    return np.asarray(np.linalg.norm(expected - arm, axis=1))


def _check_spread(arm: Points) -> None:
    """Points on a line would fit a mirrored table as well."""
    across = np.linalg.svd(arm - arm.mean(axis=0), compute_uv=False)[-1] / math.sqrt(len(arm))
    if across < NARROW_MM:
        raise CalibrationError(
            f"the points lie too near to one line ({across:.0f} mm): touch points in all corners"
        )


def _diagnosis(table: Points, arm: Points, residuals: Points) -> str:
    """Mirrored, one point wrong, or all of them."""
    told = ", ".join(f"{value:.1f}" for value in residuals)
    mirrored = table * [-1.0, 1.0]
    if _residuals(mirrored, arm, *similarity(mirrored, arm)).max() <= MOST_MM:
        return "left and right are swapped in the points: x is to the right, y away from you"
    if len(table) > FEWEST:
        without = {n: _worst_without(table, arm, n) for n in range(len(table))}
        point = min(without, key=lambda n: without[n])
        if without[point] <= MOST_MM:
            return (
                f"point {point + 1} does not fit the others, which fit within "
                f"{without[point]:.1f} mm: touch it again (residuals {told} mm)"
            )
    return (
        f"the points deviate by up to {residuals.max():.1f} mm (at most {MOST_MM:g}; residuals "
        f"{told}): home the arm, fasten it and the table, touch them again"
    )


def _worst_without(table: Points, arm: Points, point: int) -> float:
    keep = np.arange(len(table)) != point
    found = similarity(table[keep], arm[keep])
    return float(_residuals(table[keep], arm[keep], *found).max())

"""The table before the camera, from the four markers in its corners; says what lies wrong.

Pure: pictures in, values out. Lengths on the table in mm from its middle, x right, y away from the
person; a marker is printed upright, its top away from the person. Source: robot.md 7.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from agent.config import CameraConfig
from agent.errors import CalibrationError
from scene import edges, opencv
from scene.calibration import Lens, Table, rows
from scene.exposure import blur, exposure
from scene.sight import Pixels, Points
from scene.types import EDGE

CORNERS = {40: "near left", 41: "near right", 42: "far right", 43: "far left"}
"""Each marker's number, none of which is on the board, and where on the table it belongs."""
MOST_PX, MOST_MM, MOST_AWAY_MM, MOST_SHAKE = 1.0, 0.8, 1.5, 1.0
"""A table is refused where a corner deviates by both: so many pixels, so many mm on the table
(near by, a pixel is less than a person can lay paper to); where a marker lies so many mm from where
the other three have it; or where one wanders by so many pixels between pictures."""
PRINT = 0.006
"""From so much on (of 1) a marker's print is of the wrong size."""

Corners = Mapping[int, Points]
"""Each marker's corners (4, 2), clockwise as printed, from its upper left one; seen ones in pixels
of the undistorted picture."""


class Layout(NamedTuple):
    """Where the markers lie: the table's side, theirs, and how far inside the corners (mm)."""

    side: float
    marker: float
    inset: float

    def places(self) -> dict[int, Points]:
        """Each marker's corners on the table (4, 2; mm)."""
        half, at = self.marker / 2, self.side / 2 - self.inset - self.marker / 2
        square = np.array([[-half, half], [half, half], [half, -half], [-half, -half]])
        middles = {40: (-at, -at), 41: (at, -at), 42: (at, at), 43: (-at, at)}
        return {number: square + np.array(middle) for number, middle in middles.items()}


def layout(config: CameraConfig) -> Layout:
    """As configured."""
    return Layout(config.table, config.marker, config.inset)


def find(pixels: Pixels, limits: CameraConfig, lens: Lens) -> Corners:
    """The four markers in a picture. Raises CalibrationError that says why they are not seen."""
    bright = opencv.gray(pixels)
    rough = _rough(bright)
    if len(rough) < len(CORNERS):
        raise CalibrationError(_unseen(pixels, rough, limits))
    for four in rough.values():
        trouble = blur(pixels, limits, four)
        if trouble is not None:
            raise CalibrationError(trouble)
    return {number: edges.corners(bright, four, lens.flat) for number, four in rough.items()}


def _rough(bright: opencv.Gray) -> dict[int, Points]:
    """Those of the four that are seen, in the picture as it is."""
    seen = opencv.find_markers(bright)
    return {number: seen[number] for number in CORNERS if number in seen}


def _unseen(pixels: Pixels, found: Corners, limits: CameraConfig) -> str:
    trouble = exposure(pixels, limits) or blur(pixels, limits)
    if trouble is not None:
        return trouble
    turned = opencv.find_markers(opencv.gray(np.ascontiguousarray(pixels[:, ::-1])))
    if len(found) < sum(number in turned for number in CORNERS):
        return "the picture is mirrored: switch mirroring off in the camera's settings"
    if not found:
        return (
            "none of the four markers is seen: lay them in the table's corners "
            "(`armchat calibrate print`), and have the whole table in the picture"
        )
    hidden = [where for number, where in CORNERS.items() if number not in found]
    return f"{_markers(hidden)} not seen: is it covered, out of the picture, or in glaring light?"


def _markers(where: Sequence[str]) -> str:
    if len(where) == 1:
        return f"the {where[0]} marker is"
    return f"the {', '.join(where[:-1])} and {where[-1]} markers are"


def mean(pictures: Sequence[Corners]) -> dict[int, Points]:
    """Each corner's median over pictures. Raises CalibrationError where camera or table move."""
    result = {}
    for number, where in CORNERS.items():
        several = np.array([one[number] for one in pictures])
        result[number] = np.median(several, axis=0)
        shake = float(np.abs((several - result[number]).mean(axis=1)).max())
        if shake > MOST_SHAKE:
            raise CalibrationError(
                f"the {where} marker wanders by {shake:.1f} pixels from picture to picture: fasten "
                "camera and table"
            )
    return result


def fit(pictures: Sequence[Corners], lens: Lens, plan: Layout, source: str, date: str) -> Table:
    """The table. Raises CalibrationError with reason and remedy where it would not be good.

    The plane is the rigid one through the calibrated lens: a free homography follows a marker that
    lies wrong (evals/LOG.md), so RANSAC's tells only what kind of wrong it is.
    """
    seen, places = mean(pictures), plan.places()
    plane, eye = _rigid(seen, places, lens)
    on_table, pixels = _stacked(places), _stacked(seen)
    away = max(float(np.hypot(*_away(number, seen, places, lens))) for number in CORNERS)
    if _misfit(seen, places, lens) >= 1 or away >= MOST_AWAY_MM or eye.centre[2] <= 0:
        raise CalibrationError(_diagnosis(seen, places, plan, lens))
    off = np.linalg.norm(_mapped(plane, on_table) - pixels, axis=1)
    at_table = np.linalg.norm(_mapped(_inverse(plane), pixels) - on_table, axis=1)
    unit = plan.side / 2 / EDGE
    in_units = plane @ np.diag([unit, unit, 1.0])
    x, y, z = (float(value) for value in eye.centre / unit)
    return Table(
        date=date, source=source, size=lens.size, lens=lens.date, side=plan.side,
        homography=rows(in_units / in_units[2, 2]), camera=(x, y, z), px_max=float(off.max()),
        mm_mean=float(at_table.mean()), mm_max=float(at_table.max()), frames=len(pictures),
    )  # fmt: skip


def _rigid(seen: Corners, places: Corners, lens: Lens) -> tuple[Points, opencv.Pose]:
    """The homography (mm to pixels) of a plane seen through the lens, and where it stands."""
    matrix = np.array(lens.matrix)
    at = _stacked({number: places[number] for number in seen})
    eye = opencv.pose(at, _stacked(seen), matrix)
    return matrix @ np.column_stack((eye.rotation[:, :2], eye.translation)), eye


def moved_since(pixels: Pixels, lens: Lens, table: Table, plan: Layout) -> float | None:
    """How far (mm) the farthest marker in a picture is from its place on a calibrated table.

    None if none is seen.
    """
    bright, unit, places = opencv.gray(pixels), plan.side / 2 / EDGE, plan.places()
    away = []
    for number, rough in _rough(bright).items():
        at = table.view.points(edges.corners(bright, rough, lens.flat)) * unit
        away.append(float(np.hypot(*(at - places[number]).mean(axis=0))))
    return max(away, default=None)


# --- what lies wrong -------------------------------------------------------------------------


def _diagnosis(seen: Corners, places: Corners, plan: Layout, lens: Lens) -> str:
    """Why the markers do not fit where they should lie: the simplest reason that explains all."""
    for reason in (_turned, _swapped):
        found = reason(seen, places, lens)
        if found is not None:
            return found
    printed = _printed(seen, places)
    if abs(printed / plan.marker - 1) > PRINT:
        return (
            f"the markers look {printed:.1f} mm wide, not {plan.marker:g}: print them at 100 % "
            "(`armchat calibrate print`); marker and table in [camera] are what a ruler says (mm)"
        )
    moved = _moved(seen, places, lens)
    free = opencv.homography(_stacked(places), _stacked(seen), MOST_PX)
    as_plane = float(np.linalg.norm(_mapped(free, _stacked(places)) - _stacked(seen), axis=1).max())
    other_lens = (
        "camera, zoom or focus are not those that were calibrated (`armchat calibrate camera`)"
    )
    if moved is not None:
        return f"{moved}; or {other_lens}" if as_plane < MOST_PX else moved
    if as_plane < MOST_PX:
        return f"the table is not seen as through the calibrated lens: {other_lens}"
    return (
        "the markers do not lie where they should: lay each flat, its outer corner "
        f"{_where(plan)}, and see that table in [camera] is the table's side in mm"
    )


def _where(plan: Layout) -> str:
    if plan.inset == 0:
        return "on the table's corner"
    side = "inside" if plan.inset > 0 else "outside"
    return f"{abs(plan.inset):g} mm {side} the table's corner along both edges"


def _turned(seen: Corners, places: Corners, lens: Lens) -> str | None:
    """One marker that fits if it is turned by quarters."""
    for number, where in CORNERS.items():
        for quarters in (1, 2, 3):
            other = {**seen, number: np.roll(seen[number], quarters, axis=0)}
            if _misfit(other, places, lens) < 1:
                turn = 360 - 90 * quarters
                return f"the {where} marker is turned by {turn}°: its top goes away from you"
    return None


def _swapped(seen: Corners, places: Corners, lens: Lens) -> str | None:
    """Two markers that fit in each other's place."""
    numbers = list(CORNERS)
    for n, one in enumerate(numbers):
        for other in numbers[n + 1 :]:
            changed = {**seen, one: seen[other], other: seen[one]}
            if _misfit(changed, places, lens) < 1:
                return f"the {CORNERS[one]} and {CORNERS[other]} markers are swapped"
    return None


def _moved(seen: Corners, places: Corners, lens: Lens) -> str | None:
    """The marker without which the others fit best, if they do; by how much it is off."""
    left_out = {number: _misfit(_without(number, seen), places, lens) for number in CORNERS}
    number = min(CORNERS, key=lambda one: left_out[one])
    if left_out[number] >= 1:
        return None
    away = _away(number, seen, places, lens)
    return (
        f"the {CORNERS[number]} marker lies {math.hypot(*away):.1f} mm from where the others say "
        f"({_direction(away)}), or is bent: lay it right"
    )


def _away(number: int, seen: Corners, places: Corners, lens: Lens) -> Points:
    """By how much (2,; mm) a marker's middle is off where the other three have it."""
    plane, _ = _rigid(_without(number, seen), places, lens)
    actual = _mapped(_inverse(plane), seen[number])
    return np.asarray(actual.mean(axis=0) - places[number].mean(axis=0))


def _without(number: int, seen: Corners) -> dict[int, Points]:
    return {one: four for one, four in seen.items() if one != number}


def _direction(away: Points) -> str:
    x, y = away
    across = f"{abs(x):.1f} to the {'right' if x > 0 else 'left'}"
    return f"{across}, {abs(y):.1f} {'away from you' if y > 0 else 'towards you'}"


def _printed(seen: Corners, places: Corners) -> float:
    """How wide the markers are (mm), if their outer corners lie right."""
    outer = {40: 3, 41: 2, 42: 1, 43: 0}
    plane = opencv.homography(
        np.array([places[number][n] for number, n in outer.items()]),
        np.array([seen[number][n] for number, n in outer.items()]),
    )
    back = _inverse(plane)
    sides = [
        np.linalg.norm(four - np.roll(four, 1, axis=0), axis=1)
        for four in (_mapped(back, seen[number]) for number in CORNERS)
    ]
    return float(np.median(sides))


def _misfit(seen: Corners, places: Corners, lens: Lens) -> float:
    """How far the best plane is from markers that are seen, of what may be: good below 1."""
    at, pixels = _stacked({number: places[number] for number in seen}), _stacked(seen)
    plane, _ = _rigid(seen, places, lens)
    px = np.linalg.norm(_mapped(plane, at) - pixels, axis=1).max() / MOST_PX
    mm = np.linalg.norm(_mapped(_inverse(plane), pixels) - at, axis=1).max() / MOST_MM
    return float(min(px, mm))


def _stacked(corners: Corners) -> Points:
    return np.concatenate([corners[number] for number in CORNERS if number in corners])


def _inverse(plane: Points) -> Points:
    return np.asarray(np.linalg.inv(plane), np.float64)


def _mapped(plane: Points, points: Points) -> Points:
    flat = np.column_stack((points, np.ones(len(points)))) @ plane.T
    return np.asarray(flat[:, :2] / flat[:, 2:])

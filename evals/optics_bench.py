"""Figures of the eye's optics: how true lens, table and arm are, on pictures whose truth is known.

Pictures are drawn (`evals.optics_world`) and go through the product's own road: find, fit,
undistort, view. A table's error is taken at 21 x 21 points over all of it, from where each truly
appears, after one picture (the product averages ten). All seeded: cameras and boards 0 to 2, poses
from 1000 on, touches from 5000 on.
"""

from __future__ import annotations

import math
import statistics
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from agent.config import CameraConfig
from agent.errors import CalibrationError
from evals import optics_world as world
from evals.figures import Figure, at_most, median, times
from scene import lens, markers, touched
from scene.calibration import Lens, Table
from scene.sight import Picture, Points

CAMERAS, POSES, TOUCHED = 3, 120, 500
LAID_MM = 0.3
"""How well a person lays paper: standard deviation of x and y (mm), and of the turn (degrees)."""
TOUCH_MM, SEEN_PX = 0.4, 0.1
"""How well an arm's tip is brought to a mark (mm), and a drawn marker's corner is seen (pixels):
standard deviations of x and y."""
SMALL, OFFSET = 75.0, np.array([240.0, 0.0])
"""Half an arm's table (mm), and where its middle is for the arm."""
GRID: Points = np.stack(np.meshgrid(*2 * [np.linspace(-1, 1, 21)]), axis=-1).reshape(-1, 2)
CONFIG = CameraConfig()
PLAN, HALF = markers.layout(CONFIG), CONFIG.table / 2


class Case(NamedTuple):
    """A camera, what was found of its lens, and by how much (of 1) the focal length is off."""

    eye: world.Eye
    lens: Lens
    off: float


def figures(poses: int = POSES) -> dict[str, Figure]:
    """All figures, for `armchat bench scene`, with ``poses`` tables for each of them."""
    cases = [_case(number) for number in range(CAMERAS)]
    return {
        "lens_px": _mean([case.lens.px for case in cases], None, "px"),
        "lens_focal_off": _mean([100 * case.off for case in cases], None, "%"),
        **_tables(cases, poses),
        **_arm(cases),
        **_times(cases[0]),
    }


def _case(number: int, size: tuple[int, int] = (1280, 960)) -> Case:
    view, k1 = (55.0, 62.0, 70.0)[number], (-0.05, -0.12, -0.18)[number]
    eye = world.camera(size, view=view, k1=k1, seed=number)
    boards = [
        lens.find(world.picture_of_board(eye, shot), CONFIG)
        for shot in world.board_shots(eye, lens.WANTED, seed=number)
    ]
    found = lens.fit(boards, size, "drawn", f"camera {number}")
    return Case(eye, found, abs(found.matrix[0][0] / eye.matrix[0, 0] - 1))


# --- the table -------------------------------------------------------------------------------


def _tables(cases: Sequence[Case], poses: int) -> dict[str, Figure]:
    small = _case(1, (640, 480))
    exact = _errors(cases, poses, 0.0)
    laid = _errors(cases, poses, LAID_MM)
    coarse = _errors([small], poses // 4, 0.0)
    return {
        **_told("table", exact, 0.5, 1.0),
        **_told(f"table_laid_to_{LAID_MM:g}_mm", laid, 0.5, 1.0),
        **_told("table_640x480", coarse, None, None),
    }


class Errors(NamedTuple):
    """Of each accepted table: mean and largest error (mm), the camera's (mm); how many refused."""

    means: list[float]
    worst: list[float]
    centres: list[float]
    refused: int


def _errors(cases: Sequence[Case], poses: int, laid: float) -> Errors:
    found = Errors([], [], [], 0)
    for number in range(poses):
        case = cases[number % len(cases)]
        chance = np.random.default_rng(1000 + number)
        shot = _shot(case.eye, chance)
        try:
            table = _table(case, shot, _laid(chance, laid))
        except CalibrationError:
            found = found._replace(refused=found.refused + 1)
            continue
        seen = case.lens.flat(shot.seen(case.eye, GRID * HALF))
        off = np.linalg.norm(table.view.points(seen) - GRID, axis=1) * HALF
        found.means.append(float(off.mean()))
        found.worst.append(float(off.max()))
        found.centres.append(math.dist(np.array(table.camera) * HALF, shot.centre))
    return found


def _table(case: Case, shot: world.Shot, laid: list[world.Marker]) -> Table:
    pixels = world.picture_of_table(case.eye, shot, laid)
    return markers.fit([markers.find(pixels, CONFIG, case.lens)], case.lens, PLAN, "drawn", "")


def _shot(eye: world.Eye, chance: np.random.Generator) -> world.Shot:
    """A camera anywhere that has the whole table in its picture; any blur, light and noise that
    the exposure check lets pass."""
    edge = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * (HALF + 10)
    while True:
        shot = world.over_table(
            chance.uniform(450, 950), chance.uniform(0, 25), chance.uniform(0, 360),
            tuple(chance.uniform(-30, 30, 2)), blur=chance.uniform(0.4, 1.4),
            light=chance.uniform(0.5, 1.1), noise=chance.uniform(1, 5),
        )._replace(seed=int(chance.integers(1 << 30)))  # fmt: skip
        seen = shot.seen(eye, edge)
        if (seen > 4).all() and (seen < np.array(eye.size) - 5).all():
            return shot


def _laid(
    chance: np.random.Generator, off: float, plan: markers.Layout = PLAN
) -> list[world.Marker]:
    result = []
    for number, four in plan.places().items():
        x, y = four.mean(axis=0) + chance.normal(0, off, 2)
        result.append(world.Marker(number, x, y, plan.marker, chance.normal(0, off)))
    return result


def _told(name: str, errors: Errors, mean: float | None, worst: float | None) -> dict[str, Figure]:
    count = len(errors.means)
    return {
        f"{name}_mean_mm": _mean(errors.means, mean, "mm"),
        f"{name}_max_mm": at_most(max(errors.worst), worst, "mm", count),
        f"{name}_max_p95_mm": at_most(float(np.percentile(errors.worst, 95)), None, "mm", count),
        f"{name}_camera_off_mm": _mean(errors.centres, None, "mm"),
        f"{name}_refused": at_most(
            100 * errors.refused / (count + errors.refused), None, "%", count + errors.refused
        ),
    }


def _mean(values: Sequence[float], goal: float | None, unit: str) -> Figure:
    mean, n = statistics.fmean(values), len(values)
    stderr = statistics.stdev(values) / math.sqrt(n) if n > 1 else None
    return Figure(
        value=mean, unit=unit, n=n, stderr=stderr,
        goal=None if goal is None else f"<= {goal:g}",
        met=None if goal is None else mean <= goal,
    )  # fmt: skip


# --- the arm, and how long it takes ----------------------------------------------------------


def _arm(cases: Sequence[Case]) -> dict[str, Figure]:
    """From the camera to the arm, at a table of 150 mm: markers laid and touched by a careful hand.

    Markers are not drawn here; their corners are seen with ``SEEN_PX``.
    """
    arms, ends, refused = [], [], 0
    for number in range(TOUCHED):
        chance = np.random.default_rng(5000 + number)
        try:
            arm, end = _touched(cases[number % len(cases)], chance)
        except CalibrationError:
            refused += 1
            continue
        arms.append(float(arm.mean()))
        ends.append(float(np.median(end)))
    return {
        "arm_mean_mm": _mean(arms, None, "mm"),
        "camera_to_arm_median_mm": median(ends, 3.0, "mm"),
        "camera_to_arm_p95_mm": at_most(float(np.percentile(ends, 95)), None, "mm", len(ends)),
        "arm_refused": at_most(100 * refused / TOUCHED, None, "%", TOUCHED),
    }


def _touched(case: Case, chance: np.random.Generator) -> tuple[Points, Points]:
    """How far off (mm) each point of the table is: by the arm's fit, and seen and then reached."""
    plan = markers.Layout(2 * SMALL, 50.0, 0.0)
    laid, turn = _laid(chance, LAID_MM, plan), math.radians(chance.uniform(-5, 5))
    shot = world.over_table(chance.uniform(300, 450), chance.uniform(0, 20), chance.uniform(0, 360))
    seen = {
        one.number: case.lens.flat(shot.seen(case.eye, one.corners()))
        + chance.normal(0, SEEN_PX, (4, 2))
        for one in laid
    }
    table = markers.fit([seen], case.lens, plan, "drawn", "")
    middles = np.array([[one.x, one.y] for one in laid]) / SMALL
    reached = _stand(middles, SMALL, turn, OFFSET) + chance.normal(0, TOUCH_MM, (4, 2))
    asked = np.array([four.mean(axis=0) for four in plan.places().values()]) / SMALL
    touches = [
        touched.Touch((float(x), float(y)), (float(a), float(b), -68.0))
        for (x, y), (a, b) in zip(asked, reached, strict=True)
    ]
    found = touched.fit(touches, 2 * SMALL, "drawn", "")

    def ours(points: Points) -> Points:
        return _stand(points, found.scale, math.radians(found.turn), np.array(found.offset))

    truth = _stand(GRID, SMALL, turn, OFFSET)
    eyes = table.view.points(case.lens.flat(shot.seen(case.eye, GRID * SMALL)))
    arm, end = (np.linalg.norm(ours(points) - truth, axis=1) for points in (GRID, eyes))
    return np.asarray(arm), np.asarray(end)


def _stand(points: Points, scale: float, turn: float, offset: Points) -> Points:
    """`robot_bridge.dobot_cell`'s map, written out once more."""
    ahead = scale * np.column_stack((points[:, 1], -points[:, 0]))
    c, s = math.cos(turn), math.sin(turn)
    return np.asarray(ahead @ np.array([[c, s], [-s, c]]) + offset)


def _times(case: Case) -> dict[str, Figure]:
    shot = world.over_table(700.0, 10.0, 250.0)
    pixels = world.picture_of_table(case.eye, shot, _laid(np.random.default_rng(0), 0.0))
    flatten = case.lens.flattener()
    return {
        "undistort_ms": median(times(lambda: flatten(Picture(pixels, 0.0)), 30)),
        "find_markers_ms": median(times(lambda: markers.find(pixels, CONFIG, case.lens), 30)),
    }

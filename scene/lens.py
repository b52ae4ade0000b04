"""A camera's lens from pictures of the ChArUco board: what is still to be shown, then the fit.

Pure: pictures in, values out. Frame of a board: x right, y down, z away from the camera. Source:
robot.md 7, Zhang's method as in OpenCV.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from agent.config import CameraConfig
from agent.errors import CalibrationError
from scene import opencv
from scene.calibration import Lens, Size, rows
from scene.exposure import blur, exposure
from scene.sight import Pixels, Points

BOARD = opencv.Board(7, 5, 38.0, 28.0)
"""7x5 squares of 38 mm, markers of 28: it fills an A4 sheet (scene/sheets.py prints it)."""
CORNERS = (BOARD.across - 1) * (BOARD.down - 1)
FEWEST_CORNERS = 12
WANTED, FEWEST, MOST = 15, 10, 40
"""Pictures: enough, the least, and the most that are taken."""
PARTS = tuple(f"{row} {column}".replace("middle middle", "middle")
              for row in ("upper", "middle", "lower")
              for column in ("left", "middle", "right"))  # fmt: skip
TILTS = ("left", "right", "up", "down")
LEAN = 14.0
"""From so many degrees on a board is tilted."""
MOST_WAY = 2.0
"""Pixels by which a board that is held still may move from one picture to the next."""
MOST_PX, MOST_STRETCH, MOST_SPREAD = 0.8, 0.01, 0.01
"""A fit is refused beyond: root-mean-square (pixels), fx against fy, deviation of them."""


class Shown(NamedTuple):
    """A board in a picture: its corners' ``places`` (n, 2; mm) and ``pixels`` (n, 2).

    ``facing`` (3,): the way its back looks, in the camera's frame, by a guessed focal length.
    """

    places: Points
    pixels: Points
    facing: Points


def find(pixels: Pixels, limits: CameraConfig) -> Shown:
    """The board in a picture. Raises CalibrationError that says why it cannot be used."""
    bright = opencv.gray(pixels)
    places, seen = opencv.find_board(bright, BOARD)
    if len(places) < FEWEST_CORNERS:
        raise CalibrationError(_unfound(pixels, len(places), limits))
    trouble = blur(pixels, limits, seen)
    if trouble is not None:
        raise CalibrationError(trouble)
    return shown(places, seen, (pixels.shape[1], pixels.shape[0]))


def _unfound(pixels: Pixels, count: int, limits: CameraConfig) -> str:
    trouble = exposure(pixels, limits) or blur(pixels, limits)
    if trouble is not None:
        return trouble
    turned = opencv.gray(np.ascontiguousarray(pixels[:, ::-1]))
    if len(opencv.find_board(turned, BOARD)[0]) >= FEWEST_CORNERS:
        return "the picture is mirrored: switch mirroring off in the camera's settings"
    return f"{count} of the board's {CORNERS} corners are seen, {FEWEST_CORNERS} are needed"


def shown(places: Points, pixels: Points, size: Size) -> Shown:
    """A board by its corners. Raises CalibrationError where they lie on a line."""
    guess = np.array([[size[0], 0, size[0] / 2], [0, size[0], size[1] / 2], [0, 0, 1.0]])
    return Shown(places, pixels, opencv.pose(places, pixels, guess).rotation[:, 2])


def is_new(one: Shown, others: Sequence[Shown], size: Size) -> bool:
    """Whether a board stands elsewhere, or is tilted otherwise, than all that were kept."""
    return all(
        math.dist(one.pixels.mean(axis=0), other.pixels.mean(axis=0)) > 0.08 * size[0]
        or float(one.facing @ other.facing) < math.cos(math.radians(8))
        for other in others
    )


def is_still(one: Shown, before: Shown | None) -> bool:
    """Whether a board stands where it stood in the picture before: what moves is skewed."""
    if before is None:
        return False
    there = {tuple(place): pixel for place, pixel in zip(before.places, before.pixels, strict=True)}
    ways = [
        math.dist(pixel, there[tuple(place)])
        for place, pixel in zip(one.places, one.pixels, strict=True)
        if tuple(place) in there
    ]
    return bool(ways) and max(ways) <= MOST_WAY


def missing(boards: Sequence[Shown], size: Size) -> tuple[str, ...]:
    """What the board has not been shown in yet, for a person who holds it."""
    if not boards:
        return ("any picture of the board",)
    seen = np.concatenate([one.pixels for one in boards])
    column = np.clip(seen[:, 0] * 3 // size[0], 0, 2)
    row = np.clip(seen[:, 1] * 3 // size[1], 0, 2)
    counts = np.bincount((3 * row + column).astype(int), minlength=9)
    parts = [f"the {PARTS[n]} of the picture" for n in range(9) if counts[n] < 4]
    done = {tilt(one) for one in boards}
    return (*parts, *(f"tilted to face {way}" for way in TILTS if way not in done))


def tilt(one: Shown) -> str | None:
    """Which way a board faces more than the camera itself; None if it is flat before it."""
    x, y, z = one.facing
    if math.degrees(math.acos(min(1.0, abs(z)))) < LEAN:
        return None
    if abs(x) > abs(y):
        return "left" if x > 0 else "right"
    return "up" if y > 0 else "down"


def fit(boards: Sequence[Shown], size: Size, source: str, date: str) -> Lens:
    """The lens. Raises CalibrationError with reason and remedy where it would not be good."""
    if len(boards) < FEWEST:
        raise CalibrationError(
            f"{len(boards)} usable pictures of the board, at least {FEWEST} are needed "
            f"({WANTED} are good)"
        )
    lacking = missing(boards, size)
    if lacking:
        raise CalibrationError(f"the board was not shown in: {', '.join(lacking)}")
    kept = list(boards[:MOST])
    found = _fit(kept, size)
    agree = found.errors <= max(1.0, 3 * float(np.median(found.errors)))
    if not agree.all() and agree.sum() >= FEWEST:
        kept = [one for one, good in zip(kept, agree, strict=True) if good]
        found = _fit(kept, size)
    return _judged(found, [len(one.places) for one in kept], size, source, date)


def _fit(boards: Sequence[Shown], size: Size) -> opencv.LensFit:
    return opencv.calibrate([one.places for one in boards], [one.pixels for one in boards], size)


def _judged(
    found: opencv.LensFit, corners: Sequence[int], size: Size, source: str, date: str
) -> Lens:
    px = math.sqrt(float(np.average(found.errors**2, weights=corners)))
    (fx, _, cx), (_, fy, cy), _ = found.matrix.tolist()
    again = "run `armchat calibrate camera` again"
    if not px <= MOST_PX:
        raise CalibrationError(
            f"the corners deviate by {px:.2f} pixels (at most {MOST_PX:g}): is the board flat, "
            f"is everything sharp, does the camera refocus? Mend it and {again}"
        )
    if abs(fx / fy - 1) > MOST_STRETCH:
        raise CalibrationError(
            f"the board is stretched by {abs(fx / fy - 1):.1%} in one direction: print it at 100 % "
            f"(`armchat calibrate print`), check the ruler, and {again}"
        )
    if max(found.spread[:2]) > MOST_SPREAD * fx:
        raise CalibrationError(
            f"the focal length is known to {max(found.spread[:2]) / fx:.1%} only: tilt the board "
            f"more, come closer, and {again}"
        )
    if not (size[0] / 3 < cx < size[0] * 2 / 3 and size[1] / 3 < cy < size[1] * 2 / 3):
        raise CalibrationError(f"the lens's centre would lie at ({cx:.0f}, {cy:.0f}): {again}")
    k1, k2, p1, p2, k3 = map(float, found.distortion)
    return Lens(
        date=date, source=source, size=size, matrix=rows(found.matrix),
        distortion=(k1, k2, p1, p2, k3),
        pictures=len(corners), px=px, mm=px * float(found.distances.mean()) / fx,
        focal_sd=float(max(found.spread[:2])),
    )  # fmt: skip

"""What was calibrated, as files: the lens, the table before the camera, the arm at the table.

One JSON file each in a folder (the user's data folder unless the configuration names another),
with date, camera, picture size and figures. What does not fit together is refused when it is
loaded, with what to do. Made by `scene.lens`, `scene.markers`, `scene.touched`; source: robot.md 7.
"""

from __future__ import annotations

import math
import os
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

import msgspec
import numpy as np
from platformdirs import user_data_path

from agent.errors import CalibrationError
from scene import opencv
from scene.sight import Picture, Points, View

Rows = tuple[tuple[float, float, float], ...]
Size = tuple[int, int]


class Lens(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A camera's intrinsics. ``size``: width and height of the pictures they are of.

    ``matrix`` (3, 3) and ``distortion`` (k1 k2 p1 p2 k3) as in OpenCV. ``px``, ``mm``: the
    root-mean-square of what the board's corners deviate by, in the picture and at the board.
    ``focal_sd``: the focal length's standard deviation (pixels).
    """

    date: str
    source: str
    size: Size
    matrix: Rows
    distortion: tuple[float, float, float, float, float]
    pictures: int
    px: float
    mm: float
    focal_sd: float

    def flat(self, pixels: Points) -> Points:
        """Pixels (n, 2) of a picture as pixels of the undistorted one."""
        return opencv.undistort_points(pixels, *self.arrays())

    def flattener(self) -> Callable[[Picture], Picture]:
        """What undistorts pictures. Its maps are made here, once.

        It raises CalibrationError for a picture of another size.
        """
        undistort = opencv.undistorter(*self.arrays(), self.size)

        def flatten(picture: Picture) -> Picture:
            self.check_size((picture.pixels.shape[1], picture.pixels.shape[0]))
            return Picture(undistort(picture.pixels), picture.t)

        return flatten

    def arrays(self) -> tuple[Points, Points]:
        """Matrix (3, 3) and distortion (5,)."""
        return np.array(self.matrix), np.array(self.distortion)

    def check_size(self, size: Size) -> None:
        """Raises CalibrationError where pictures have another size."""
        if size != self.size:
            raise CalibrationError(
                f"the camera was calibrated at {_by(self.size)} pixels, its pictures are "
                f"{_by(size)}: set size in [camera], or run `armchat calibrate camera` again"
            )


class Table(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """How undistorted pictures show the table, from its four markers.

    ``homography`` (3, 3): table units to pixels; ``camera``: the camera's centre (table units).
    ``lens``: the date of the lens that it was made with. ``side``: the table's (mm). ``px_max``,
    ``mm_mean``, ``mm_max``: by what the markers' corners deviate. ``frames``: pictures it is the
    mean of.
    """

    date: str
    source: str
    size: Size
    lens: str
    side: float
    homography: Rows
    camera: tuple[float, float, float]
    px_max: float
    mm_mean: float
    mm_max: float
    frames: int

    @property
    def view(self) -> View:
        """The same for those who detect."""
        return View(np.array(self.homography), self.camera)


class Standing(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """How the arm stands at the table: a similarity, from touched points.

    ``scale``: mm per table unit; ``offset``: x and y that the arm reads over the table's middle,
    ``floor`` its z there (mm); ``turn``: degrees (`robot_bridge.dobot_cell`). ``residuals``: of
    each point (mm); ``floor_mm``: the largest of the heights.
    """

    date: str
    source: str
    scale: float
    offset: tuple[float, float]
    floor: float
    turn: float
    residuals: tuple[float, ...]
    floor_mm: float

    @property
    def mm_max(self) -> float:
        """The largest residual."""
        return max(self.residuals)


Kept = TypeVar("Kept", Lens, Table, Standing)

_FILES: dict[type, tuple[str, str]] = {
    Lens: ("camera.json", "camera"), Table: ("table.json", "table"),
    Standing: ("robot.json", "robot"),
}  # fmt: skip


def folder(configured: str | None = None) -> Path:
    """Where calibrations are kept."""
    if configured is not None:
        return Path(configured).expanduser()
    return user_data_path("armchat") / "calibration"


def path(kind: type[Lens] | type[Table] | type[Standing], where: Path) -> Path:
    """The file of one of them in a folder; a path that is a file already is itself."""
    return where if where.suffix == ".json" else where / _FILES[kind][0]


def save(value: Lens | Table | Standing, where: Path) -> Path:
    """Write it, whole or not at all; the file. Raises CalibrationError."""
    file = path(type(value), where)
    text = msgspec.json.format(msgspec.json.encode(value), indent=2)
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=file.parent, prefix=file.name)
        with os.fdopen(handle, "wb") as out:
            out.write(text + b"\n")
        Path(name).replace(file)
    except OSError as error:
        raise CalibrationError(f"{file} cannot be written: {error.strerror or error}") from error
    return file


def load(kind: type[Kept], where: Path) -> Kept:
    """What was saved. Raises CalibrationError where it is missing or damaged, with what to do."""
    file, command = path(kind, where), _FILES[kind][1]
    remedy = f"run `armchat calibrate {command}`"
    try:
        value = msgspec.json.decode(file.read_bytes(), type=kind)
    except FileNotFoundError as error:
        raise CalibrationError(f"no calibration of the {command} ({file}): {remedy}") from error
    except OSError as error:
        raise CalibrationError(f"{file}: {error.strerror or error}") from error
    except msgspec.DecodeError as error:
        raise CalibrationError(f"{file} is damaged ({error}): {remedy} again") from error
    if not _finite(msgspec.to_builtins(value)):
        raise CalibrationError(f"{file} is damaged (not a number): {remedy} again")
    return value


def eye(where: Path, size: Size, side: float) -> tuple[Lens, Table]:
    """Lens and table for pictures of ``size`` of a table of ``side`` mm.

    Raises CalibrationError where one is missing, or they are of other pictures, another table or
    not of each other.
    """
    lens, table = load(Lens, where), load(Table, where)
    lens.check_size(size)
    again = "run `armchat calibrate table` again"
    if table.size != size:
        raise CalibrationError(
            f"the table was calibrated at {_by(table.size)} pixels, not {_by(size)}: {again}"
        )
    if table.lens != lens.date:
        raise CalibrationError(f"the lens was calibrated after the table: {again}")
    if not math.isclose(table.side, side):
        raise CalibrationError(
            f"a table of {table.side:g} mm was calibrated, [camera] says {side:g}: {again}"
        )
    return lens, table


def rows(matrix: Points) -> Rows:
    """A (3, 3) array as it is kept."""
    return tuple((float(a), float(b), float(c)) for a, b, c in matrix)


def _finite(value: object) -> bool:
    if isinstance(value, float):
        return math.isfinite(value)
    if isinstance(value, dict):
        return all(map(_finite, value.values()))
    return not isinstance(value, (list, tuple)) or all(map(_finite, value))


def _by(size: Size) -> str:
    return f"{size[0]}x{size[1]}"

"""`calibrate camera`, `table`, `robot`, `print`: from pictures and touches to files that are used.

Progress goes to standard error, the result to standard output. What is computed is in `scene.lens`,
`scene.markers` and `scene.touched`; here pictures and touches are gathered for it.
"""

from __future__ import annotations

import argparse
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

import msgspec

from agent.errors import CalibrationError, ConfigError

if TYPE_CHECKING:
    from agent.config import CameraConfig
    from scene.calibration import Lens, Standing, Table
    from scene.lens import Shown
    from scene.markers import Corners
    from scene.sight import Camera, Picture

FRAMES, ATTEMPTS = 10, 100
"""Pictures of the table that are averaged, and those that are tried for them at most."""

Say = Callable[[str], None]
"""Tells the person one line, on standard error."""


def add_calibrations(parts: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """The commands of this module, beside `calibrate clarifier`."""
    camera = parts.add_parser("camera", help="the lens, from pictures of the printed board")
    table = parts.add_parser("table", help="where the table is, from the markers in its corners")
    for command, act in ((camera, _camera), (table, _table)):
        command.add_argument(
            "--source", metavar="SOURCE", help="0, /dev/video0, clip.mp4, pictures/: see [camera]"
        )
        command.add_argument("--json", action="store_true", help="print what is kept as JSON")
        command.set_defaults(act=act)
    robot = parts.add_parser("robot", help="how the arm stands at the table, from touched points")
    robot.add_argument(
        "--points", metavar="FILE",
        help='measured pairs instead: [{"table": [x, y], "arm": [x, y, z]}, ...] (units, mm)',
    )  # fmt: skip
    robot.add_argument(
        "--at", metavar="X,Y", action="append", default=[], type=_point,
        help="touch this point of the table (units) instead of the markers' middles (repeatable)",
    )  # fmt: skip
    robot.add_argument("--port", metavar="PORT", help="the arm's serial port (`armchat ports`)")
    robot.add_argument("--json", action="store_true", help="print what is kept as JSON")
    robot.set_defaults(act=_robot)
    sheets = parts.add_parser("print", help="the board and the markers, to be printed at 100 %%")
    sheets.add_argument("--out", required=True, metavar="FILE", help="F.pdf, or F.png (two files)")
    sheets.set_defaults(act=_print)


def _point(text: str) -> tuple[float, float]:
    x, _, y = text.partition(",")
    return float(x), float(y)


def _told(line: str) -> None:
    print(f"armchat: {line}", file=sys.stderr)


def _now() -> str:
    return datetime.now().astimezone().isoformat(timespec="seconds")


def _config(source: str | None) -> CameraConfig:
    from agent.config import load

    return load({"camera.source": source}).camera


def _camera(arguments: argparse.Namespace) -> int:
    config = _config(arguments.source)
    from scene.camera import UsbCamera

    with _eye(config) as eye:
        lens = calibrate_camera(eye, config, _told, live=isinstance(eye, UsbCamera))
    text = (
        f"The lens: corners deviate by {lens.px:.2f} pixels ({lens.mm:.2f} mm at the board) in "
        f"{lens.pictures} pictures; focal length {lens.matrix[0][0]:.1f} ± {lens.focal_sd:.1f} "
        "pixels."
    )
    return _keep(lens, config.folder, text, arguments.json, sys.stdout)


def _table(arguments: argparse.Namespace) -> int:
    config = _config(arguments.source)
    with _eye(config) as eye:
        table = calibrate_table(eye, config, _told)
    high = table.camera[2] * table.side / 2
    text = (
        f"The table: the markers' corners deviate by {table.mm_mean:.2f} mm, at most "
        f"{table.mm_max:.2f} mm ({table.px_max:.2f} pixels), in {table.frames} pictures; the "
        f"camera is {high:.0f} mm above it."
    )
    return _keep(table, config.folder, text, arguments.json, sys.stdout)


def _robot(arguments: argparse.Namespace) -> int:
    config = _config(None)
    if arguments.points:
        standing = calibrate_from(Path(arguments.points), config)
    else:
        standing = calibrate_by_touch(arguments.port, arguments.at, config, sys.stdin, _told)
    residuals = ", ".join(f"{value:.2f}" for value in standing.residuals)
    text = (
        f"The arm: {standing.scale:.2f} mm per table unit, turned by {standing.turn:.2f}°, middle "
        f"at ({standing.offset[0]:.1f}, {standing.offset[1]:.1f}), table at {standing.floor:.1f} "
        f"mm. Residuals {residuals} mm; heights within {standing.floor_mm:.2f} mm."
    )
    return _keep(standing, config.folder, text, arguments.json, sys.stdout)


def _keep(
    value: Lens | Table | Standing, folder: str | None, text: str, as_json: bool, out: TextIO
) -> int:
    """Save it and say so. ``folder``: that of [camera]."""
    from scene import calibration

    file = calibration.save(value, calibration.folder(folder))
    if as_json:
        out.write(msgspec.json.encode(value).decode() + "\n")
    else:
        out.write(f"{text} Kept in {file}\n")
    return 0


@contextmanager
def _eye(config: CameraConfig) -> Iterator[Camera]:
    """The configured camera, started. Raises CameraError."""
    from scene.camera import UsbCamera, camera

    eye = camera(str(config.source), config.size)
    try:
        if isinstance(eye, UsbCamera):
            eye.start()
        yield eye
    finally:
        eye.close()


def _pictures(eye: Camera, say: Say) -> Iterator[tuple[int, Picture]]:
    """Each picture with its number, all of one size. Raises CalibrationError where they differ."""
    from scene.camera import frames

    first: tuple[int, ...] | None = None
    for number, picture in enumerate(frames(eye), 1):
        size = picture.pixels.shape[1::-1]
        if first is None:
            first = size
            say(f"pictures are {size[0]}x{size[1]} pixels")
        elif size != first:
            raise CalibrationError(
                f"picture {number} is {size[0]}x{size[1]} pixels, the first {first[0]}x{first[1]}: "
                "all must be of one camera at one size"
            )
        yield number, picture


# --- the lens --------------------------------------------------------------------------------


def calibrate_camera(eye: Camera, config: CameraConfig, say: Say, live: bool = False) -> Lens:
    """Gather boards until the camera's pictures end; the lens.

    ``live``: a person holds the board, which counts where it is held still, until all is shown.
    Raises CameraError, CalibrationError.
    """
    from scene import lens

    kept: list[Shown] = []
    before: Shown | None = None
    size, told = (0, 0), ""
    for number, picture in _pictures(eye, say):
        size = (picture.pixels.shape[1], picture.pixels.shape[0])
        try:
            shown = lens.find(picture.pixels, config)
            line = "hold still" if live and not lens.is_still(shown, before) else ""
            line, before = line or _kept(shown, kept, size), shown
        except CalibrationError as error:
            line, before = str(error), None
        if line != told:
            say(f"picture {number}: {line}")
            told = line
        enough = live and len(kept) >= lens.WANTED and not lens.missing(kept, size)
        if enough or len(kept) == lens.MOST:
            break
    return lens.fit(kept, size, str(config.source), _now())


def _kept(shown: Shown, kept: list[Shown], size: tuple[int, int]) -> str:
    """Keep a board if it adds something; what to tell."""
    from scene import lens

    if not lens.is_new(shown, kept, size):
        return "seen like this before: move or tilt the board"
    kept.append(shown)
    lacking = lens.missing(kept, size)
    still = f"still missing: {', '.join(lacking)}" if lacking else "everything is shown"
    return f"{len(kept)} of {lens.WANTED}; {still}"


# --- the table -------------------------------------------------------------------------------


def calibrate_table(eye: Camera, config: CameraConfig, say: Say) -> Table:
    """The table, from the first pictures in which all four markers are seen.

    Raises CameraError, CalibrationError (also where the lens is not calibrated).
    """
    from scene import calibration, markers

    lens = calibration.load(calibration.Lens, calibration.folder(config.folder))
    seen: list[Corners] = []
    trouble = "the camera showed no picture"
    for number, picture in _pictures(eye, say):
        lens.check_size((picture.pixels.shape[1], picture.pixels.shape[0]))
        try:
            seen.append(markers.find(picture.pixels, config, lens))
        except CalibrationError as error:
            if str(error) != trouble:
                say(f"picture {number} is left out: {error}")
            trouble = str(error)
        if len(seen) == FRAMES or number == ATTEMPTS:
            break
    if not seen:
        raise CalibrationError(trouble)
    return markers.fit(seen, lens, markers.layout(config), str(config.source), _now())


# --- the arm ---------------------------------------------------------------------------------


def calibrate_from(file: Path, config: CameraConfig) -> Standing:
    """The arm's place from a file of measured pairs. Raises ConfigError, CalibrationError."""
    from scene import touched

    try:
        touches = msgspec.json.decode(file.read_bytes(), type=list[touched.Touch])
    except OSError as error:
        raise ConfigError(f"{file}: {error.strerror or error}") from error
    except msgspec.DecodeError as error:
        raise ConfigError(f"{file}: {error}") from error
    return touched.fit(touches, config.table, str(file), _now())


def calibrate_by_touch(
    port: str | None, at: list[tuple[float, float]], config: CameraConfig, lines: TextIO, say: Say
) -> Standing:
    """The arm's place from points that a person brings its tip to.

    Raises RobotError where the arm cannot be had or is lost, CalibrationError.
    """
    from agent.hardware import SAFETY, opened
    from agent.touching import touch_all
    from scene import markers, touched

    layout = markers.layout(config)
    half = layout.side / 2
    middles = {
        f"the middle of the {markers.CORNERS[number]} marker": tuple(four.mean(axis=0) / half)
        for number, four in layout.places().items()
    }
    own = {f"your point {n}": point for n, point in enumerate(at, 1)}
    say(SAFETY.removeprefix("armchat: "))
    with opened(port) as robot:
        touches = touch_all(own or middles, robot, lines, say, threading.Event().wait)
    return touched.fit(touches, config.table, port or "dobot", _now())


# --- what is printed -------------------------------------------------------------------------


def _print(arguments: argparse.Namespace) -> int:
    return print_sheets(Path(arguments.out), _config(None).marker, sys.stdout)


def print_sheets(file: Path, marker: float, out: TextIO) -> int:
    """Write the board and the markers. Raises ConfigError."""
    from scene import sheets

    pages = sheets.sheets(marker)
    if file.suffix.lower() == ".pdf":
        files = {file: sheets.pdf(pages)}
    elif file.suffix.lower() == ".png":
        files = {file.with_stem(f"{file.stem}-{page.name}"): sheets.png(page) for page in pages}
    else:
        raise ConfigError(f"{file}: a .pdf or a .png")
    for path, data in files.items():
        try:
            path.write_bytes(data)
        except OSError as error:
            raise ConfigError(f"{path}: {error.strerror or error}") from error
        out.write(f"{path}\n")
    _told('print on A4 at 100 % (not "fit to page") and measure the 100 mm ruler')
    return 0

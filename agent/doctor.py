"""`doctor`: what armchat needs, line by line: ok, warn or fail, and what to do. Changes nothing."""

from __future__ import annotations

import platform
import sys
from collections.abc import Callable, Iterator
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import TYPE_CHECKING, Literal, NamedTuple, TextIO

from agent.config import CameraConfig, DobotConfig
from agent.errors import ArmchatError, CalibrationError

if TYPE_CHECKING:
    from scene.calibration import Lens, Table
    from scene.sight import Pixels

PACKAGES = (
    "eclipse-zenoh", "kiwisolver", "lark", "msgspec", "numpy", "onnxruntime", "platformdirs",
    "pyspellchecker", "rapidfuzz", "textual", "tokenizers",
)  # fmt: skip
EXTRAS = {
    "pybullet": "sim", "pydobot": "dobot", "opencv-python-headless": "camera", "torch": "train",
}  # fmt: skip


class Line(NamedTuple):
    """One finding; ``fix`` says what to do where it is not ok."""

    verdict: Literal["ok", "warn", "fail"]
    text: str
    fix: str = ""


def doctor(dobot: bool, port: str | None, out: TextIO) -> int:
    """Print every finding; 0 if nothing failed, else 1. ``dobot``: look at the arm too."""
    failed = False
    for line in findings(dobot, port):
        out.write(f"{line.verdict:5} {line.text}{f': {line.fix}' if line.fix else ''}\n")
        out.flush()
        failed |= line.verdict == "fail"
    return int(failed)


def findings(dobot: bool, port: str | None) -> Iterator[Line]:
    """What is looked at, in order; the arm last."""
    yield _python()
    yield from (_package(name) for name in PACKAGES)
    yield from (_extra(name, extra, dobot) for name, extra in EXTRAS.items())
    for look in (_configuration, _weights, _worker):
        yield _tried(look)
    yield from _eye()
    if dobot:
        yield from _arm(port)
    else:
        yield from _ports()


def _python() -> Line:
    told = f"Python {platform.python_version()} on {platform.system()} {platform.machine()}"
    if sys.version_info[:2] == (3, 11):
        return Line("ok", told)
    return Line("fail", told, "armchat needs Python 3.11")


def _package(name: str) -> Line:
    try:
        return Line("ok", f"{name} {version(name)}")
    except PackageNotFoundError:
        return Line("fail", f"{name} is missing", "make run, or: pip install armchat")


def _extra(name: str, extra: str, needed: bool) -> Line:
    try:
        return Line("ok", f"{name} {version(name)}")
    except PackageNotFoundError:
        verdict: Literal["warn", "fail"] = "fail" if needed and extra == "dobot" else "warn"
        return Line(verdict, f"{name} is missing", f"pip install 'armchat[{extra}]' if you need it")


def _tried(look: Callable[[], Line]) -> Line:
    try:
        return look()
    except ArmchatError as error:
        return Line("fail", look.__name__.strip("_"), str(error))


def _configuration() -> Line:
    from agent.config import load

    config = load()
    return Line("ok", f"configuration: robot {config.robot.kind or 'by what is installed'}")


def _weights() -> Line:
    from agent.compose import speakers

    speakers().whole()
    return Line("ok", f"weights of the translator: {speakers().model}")


def _worker() -> Line:
    from agent.execute import Executor

    with Executor() as executor:
        if executor.hardened:
            return Line("ok", "programs run behind a system-call filter")
    return Line("warn", "no system-call filter", "real arms move on Linux x86-64 and aarch64 only")


# --- the camera ------------------------------------------------------------------------------


def _eye() -> Iterator[Line]:
    """The camera, what it shows, and whether its calibrations fit it; without one, a warning."""
    from agent.config import load
    from scene.camera import UsbCamera, camera

    try:
        config = load().camera
        eye = camera(str(config.source), config.size)
        if isinstance(eye, UsbCamera):
            eye.start()
        try:
            pixels = eye.look().pixels
        finally:
            eye.close()
    except ArmchatError as error:
        yield Line("warn", "no camera", f"{error} (needed to see a real table only)")
        return
    yield from _shown(pixels, config, isinstance(eye, UsbCamera))
    yield from _calibrations(pixels, config)


def _shown(pixels: Pixels, config: CameraConfig, asked: bool) -> Iterator[Line]:
    """``asked``: whether it is a device, which is asked for a size."""
    from scene.exposure import blur, exposure

    height, width = pixels.shape[:2]
    yield Line("ok", f"camera {config.source}: {width}x{height} pixels")
    if asked and (width, height) != config.size:
        fix = f"set size = [{width}, {height}] in [camera], or another that it can do"
        yield Line("warn", f"it was asked for {config.size[0]}x{config.size[1]}", fix)
    for trouble in (exposure(pixels, config), blur(pixels, config)):
        if trouble is not None:
            what, _, fix = trouble.rpartition(": ")
            yield Line("warn", what, fix)


def _calibrations(pixels: Pixels, config: CameraConfig) -> Iterator[Line]:
    from scene import calibration

    where, size = calibration.folder(config.folder), (pixels.shape[1], pixels.shape[0])
    try:
        lens = calibration.load(calibration.Lens, where)
        lens.check_size(size)
        yield Line("ok", f"lens of {lens.date[:10]}: {lens.px:.2f} pixels, {lens.mm:.2f} mm")
        _, table = calibration.eye(where, size, config.table)
    except CalibrationError as error:
        missing = isinstance(error.__cause__, FileNotFoundError)
        yield Line("warn" if missing else "fail", "calibration of the eye", str(error))
        return
    told = f"table of {table.date[:10]}: mean {table.mm_mean:.2f}, at most {table.mm_max:.2f} mm"
    yield Line("ok", told)
    yield _still_there(pixels, config, lens, table)


def _still_there(pixels: Pixels, config: CameraConfig, lens: Lens, table: Table) -> Line:
    """Whether the markers that are seen are where the calibration has them."""
    from scene import markers

    moved = markers.moved_since(pixels, lens, table, markers.layout(config))
    if moved is None:
        return Line("warn", "no marker is seen", "whether camera or table moved cannot be told")
    if moved <= markers.MOST_AWAY_MM:
        return Line("ok", f"the markers are where they were, within {moved:.1f} mm")
    fix = "fasten them, and run `armchat calibrate table` again"
    return Line("fail", f"camera or table have moved by {moved:.1f} mm", fix)


# --- the arm ---------------------------------------------------------------------------------


def _ports() -> Iterator[Line]:
    try:
        from robot_bridge.ports import ports

        likely = [port.device for port in ports() if port.likely]
    except ArmchatError as error:
        yield Line("warn", "serial ports not looked at", str(error))
        return
    if likely:
        yield Line("ok", f"may be a Dobot: {', '.join(likely)}; --robot dobot looks at it")
    else:
        yield Line("warn", "no port looks like a Dobot's", "needed for a real arm only")


def _arm(port: str | None) -> Iterator[Line]:
    """The port and what the arm at it says. Nothing is cleared, set or moved."""
    from agent.compose import need_dobot, stands
    from agent.config import load
    from robot_bridge.ports import choose, permitted, remedy

    try:
        need_dobot()
        config = stands(load({"dobot.port": port}).dobot)
        device = config.port or choose()
    except ArmchatError as error:
        yield Line("fail", "port", str(error))
        return
    if Path(device).exists() and not permitted(device):
        yield Line("fail", f"{device} may not be opened", remedy(device))
        return
    yield _stand(config)
    yield from _greeted(device, config)


def _stand(config: DobotConfig) -> Line:
    """Whether the arm, as it is configured to stand, can work there at all."""
    from robot_bridge.api import PARK
    from robot_bridge.dobot_cell import Cell

    cell = Cell(config)
    told = f"as it stands it reaches {cell.share():.0%} of the table at heights up to 60 mm"
    if cell.reach(PARK) is not None:
        fix = f"it cannot reach where it waits ({cell.reach(PARK)}): smaller scale, other offset"
        return Line("fail", told, f"{fix} in [dobot]")
    return Line("ok", told) if cell.share() > 0.9 else Line("warn", told, "a smaller scale helps")


def _greeted(device: str, config: DobotConfig) -> Iterator[Line]:
    from robot_bridge import dobot_alarms
    from robot_bridge.dobot import DobotLink
    from robot_bridge.dobot_cell import Cell
    from robot_bridge.dobot_guard import bounds
    from robot_bridge.dobot_start import greet

    link = DobotLink(device, bounds(config))
    try:
        link.open()
        arm = greet(link)
    except ArmchatError as error:
        yield Line("fail", device, f"{error}: is it a Dobot, switched on, green light?")
        return
    finally:
        link.close()
    yield Line("ok", f"{device}: firmware {arm.firmware}")
    codes, at = arm.alarms, Cell(config).pose(arm.pose)
    if codes:
        yield Line("fail", dobot_alarms.describe(codes), dobot_alarms.remedy(codes))
    else:
        yield Line("ok", "no alarms")
    where = ", ".join(f"{value:.1f}" for value in arm.pose[:3])
    yield Line("ok", f"pose ({where}) mm, ({at.x:.2f}, {at.y:.2f}, {at.z:.2f}) in table units")
    if arm.homed:
        yield Line("ok", "homed since it was switched on")
    else:
        yield Line("warn", "not homed", f"armchat home --robot dobot --port {device}")

"""`doctor`: what armchat needs, line by line: ok, warn or fail, and what to do. Changes nothing."""

from __future__ import annotations

import platform
import sys
from collections.abc import Callable, Iterator
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Literal, NamedTuple, TextIO

from agent.config import DobotConfig
from agent.errors import ArmchatError

PACKAGES = (
    "eclipse-zenoh", "kiwisolver", "lark", "msgspec", "numpy", "onnxruntime", "platformdirs",
    "pyspellchecker", "rapidfuzz", "textual", "tokenizers",
)  # fmt: skip
EXTRAS = {"pybullet": "sim", "pydobot": "dobot", "torch": "train"}


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
    from agent.compose import load_translator
    from agent.config import load

    model = load().translator.model
    load_translator(None if model is None else Path(model))
    return Line("ok", f"weights of the translator: {model or 'those that come with armchat'}")


def _worker() -> Line:
    from agent.execute import Executor

    with Executor() as executor:
        if executor.hardened:
            return Line("ok", "programs run behind a system-call filter")
    return Line("warn", "no system-call filter", "real arms move on Linux x86-64 and aarch64 only")


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

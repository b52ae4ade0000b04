"""Wire the parts together for one process: the only module that knows every part by name.

Imports are inside the functions: what a command does not use is never loaded.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import cache
from importlib.resources import files
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Literal, NamedTuple

import msgspec

from agent.config import DobotConfig, load
from agent.errors import ConfigError, SceneError
from agent.messages import Attention, KeepOut, TranslateRequest, Translation
from scene.types import Scene, read_scene

if TYPE_CHECKING:
    from agent.execute import Executor
    from agent.speaking import Speakers
    from agent.turn import Decide, Parts
    from clarifier.taught import Taught
    from robot_bridge.api import Simulated, Workspace

RobotKind = Literal["ideal", "bullet", "dobot"]
UNSEEN = (
    "armchat: no camera sees this table: what is said of it is computed from the arm's measured "
    "motion on the scene that you gave"
)


def table(name: str) -> Scene:
    """A scene that comes with armchat: ``kitchen`` or ``check``."""
    text = (files("scene") / "tables" / f"{name}.json").read_text(encoding="utf-8")
    return read_scene(json.loads(text))


def scene_from(path: str | None, default: str = "kitchen") -> Scene:
    """The scene of a file, or the default table. Raises SceneError naming file and fault."""
    if path is None:
        return table(default)
    try:
        return read_scene(json.loads(Path(path).read_text(encoding="utf-8")))
    except OSError as error:
        raise SceneError(f"cannot read the scene {path}: {error.strerror}") from error
    except (ValueError, SceneError) as error:
        raise SceneError(f"{path}: {error}") from error


def default_robot() -> RobotKind:
    """PyBullet where it is installed, else the ideal table (said on standard error)."""
    if find_spec("pybullet") is not None:
        return "bullet"
    print("armchat: no PyBullet here; using the ideal table without physics", file=sys.stderr)
    return "ideal"


def make_robot(
    kind: RobotKind, scene: Scene, *, seed: int = 0, pace: float = 0.0,
    keep_outs: Sequence[KeepOut] = (), speed: float = 1.0, gui: bool = False,
    dobot: DobotConfig | None = None,
) -> Simulated:  # fmt: skip
    """An arm at this scene. Raises ConfigError where what it needs is not installed; a real one
    RobotError where it cannot be reached."""
    if kind == "dobot":
        return make_dobot(scene, keep_outs, stands(dobot).slowed(speed))
    if kind == "ideal":
        from robot_bridge.ideal import IdealRobot

        return IdealRobot(scene, pace=pace, keep_outs=keep_outs, speed=speed)
    try:
        from robot_bridge.bullet import BulletRobot
    except ImportError as error:
        raise ConfigError(
            "the PyBullet arm needs: pip install 'armchat[sim]' (Linux x86_64); "
            "--robot ideal works everywhere"
        ) from error
    return BulletRobot(scene, seed=seed, pace=pace, keep_outs=keep_outs, speed=speed, gui=gui)


def make_dobot(scene: Scene, keep_outs: Sequence[KeepOut], config: DobotConfig) -> Simulated:
    """The real arm at its port, ready but for homing. Raises ConfigError, RobotError."""
    need_dobot()
    from robot_bridge.dobot_arm import open_dobot
    from robot_bridge.ports import choose

    config = msgspec.structs.replace(config, port=config.port or choose())
    robot = open_dobot(config, keep_outs, scene)
    print(UNSEEN, file=sys.stderr)
    return robot


def stands(dobot: DobotConfig | None = None) -> DobotConfig:
    """A Dobot, or the configured one, as it stands by its calibration. Raises CalibrationError."""
    from robot_bridge.dobot_fit import fitted

    config = load()
    return fitted(dobot or config.dobot, config.camera.folder)


def need_dobot() -> None:
    """Raises ConfigError where pydobot is not installed."""
    if find_spec("pydobot") is None:
        raise ConfigError("the Dobot arm needs: pip install 'armchat[dobot]' (pydobot)")


def workspace(
    kind: RobotKind, keep_outs: Sequence[KeepOut], dobot: DobotConfig | None = None
) -> Workspace:
    """Where an arm of this kind can go; nothing is opened."""
    if kind == "dobot":
        from robot_bridge.dobot_cell import Cell

        return Cell(stands(dobot), keep_outs)
    from robot_bridge.ideal import IdealRobot

    return IdealRobot(keep_outs=keep_outs)


@cache
def speakers() -> Speakers:
    """The translators of this process; the configured one speaks first."""
    from agent.speaking import Speakers

    return Speakers(load().translator)


def translate(request: TranslateRequest) -> Translation:
    """Translate in this process, whole or phrase by phrase; weights are read at the first call."""
    return speakers()(request)


def attend(request: TranslateRequest) -> tuple[Attention, ...]:
    """What the translator of this process looks at for each candidate of a request."""
    return speakers().attend(request)


class Mind(NamedTuple):
    """The clarifier over this process's translator, the program worker, and where no arm goes."""

    decide: Decide
    executor: Executor
    keep_outs: tuple[KeepOut, ...]


@contextmanager
def thinking(taught: Taught | None = None, robot: RobotKind = "ideal") -> Iterator[Mind]:
    """A mind with its worker process, closed at the end. It knows the configured keep-outs.

    ``taught``: the words of the person who speaks to it; without, each conversation has its own.
    ``robot``: whose reach it thinks within.
    """
    from agent.execute import Executor
    from clarifier.decide import Clarifier
    from robot_bridge.ideal import predict
    from translator.hearing import hear

    with Executor() as executor:
        keep_outs = load().robot.keep_outs
        table = workspace(robot, keep_outs)
        clarifier = Clarifier(translate, executor, predict, table, taught, hears=hear)
        yield Mind(clarifier.decide, executor, keep_outs)


@contextmanager
def parts_on(
    mind: Mind, scene: Scene, robot: RobotKind = "ideal", *, seed: int = 0, pace: float = 0.0,
    speed: float | None = None, gui: bool = False, dobot: DobotConfig | None = None,
) -> Iterator[Parts]:  # fmt: skip
    """Everything a turn needs, in this process, on an arm of its own.

    ``speed``: a share of its full speeds (of a Dobot's configured ones); None: as configured.
    """
    from agent.arm import LocalArm
    from agent.turn import Parts
    from robot_bridge.ideal import predict

    config = load().robot
    arm = make_robot(
        robot, scene, seed=seed, pace=pace, keep_outs=mind.keep_outs,
        speed=config.speed if speed is None else speed, gui=gui, dobot=dobot,
    )  # fmt: skip
    try:
        yield Parts(mind.decide, mind.executor, predict, LocalArm(arm), config.retries)
    finally:
        arm.close()

"""The eye that a configuration names, wired together: camera, calibration, detector, what the arm
hides. Imports are inside the functions: who has no camera loads none of it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import ExitStack
from typing import TYPE_CHECKING, NamedTuple

from agent.bus import Bus
from agent.config import CameraConfig, Config, DobotConfig
from agent.daemon import Service
from scene.types import Pose, Scene

if TYPE_CHECKING:
    from scene.eye import Eye, Undistort
    from scene.lean import Eye as Centre
    from scene.lean import Shade
    from scene.robot_word import Shades
    from scene.sight import Camera, Detection, Detector, Picture, View

ARM_MM, WRIST_MM, SHOULDER_MM = 90.0, 70.0, 138.0
"""A real arm as it hides the table: its width, and its heights above the cup and at the base."""


class Seeing(NamedTuple):
    """A camera that gives pictures, the eye behind it, and what the arm hides from it."""

    camera: Camera
    eye: Eye
    shades: Shades


def scene_service(bus: Bus, stack: ExitStack, scene: Scene, config: Config) -> Service:
    """The scene service over the source that ``[scene]`` names; ``scene``: what waits in the tray.

    Raises ConfigError, CameraError, CalibrationError.
    """
    if config.scene.source == "world":
        from scene.service import SceneService

        return SceneService(bus)
    from scene import opencv
    from scene.eye import Seen
    from scene.live import EyeService, Pace
    from scene.robot_word import RobotWord

    opencv.loaded()
    seeing = seen_by(bus, config, scene.table_m)
    stack.callback(seeing.camera.close)
    return EyeService(
        bus, seeing.camera, seeing.eye, opencv.jpeg, word=RobotWord(seeing.shades),
        seen=Seen(tray=scene.tray, table_m=scene.table_m),
        pace=Pace(config.scene.looks, config.scene.pictures),
    )  # fmt: skip


def seen_by(bus: Bus, config: Config, table_m: float) -> Seeing:
    """The camera of a configuration, started, and its eye; ``table_m``: a simulated table's side.

    Raises as `scene_service`.
    """
    if config.scene.source == "sim":
        from scene.bus_camera import BusCamera

        return simulated(BusCamera(bus), config.scene.size, table_m)
    camera, eye = calibrated(config.camera)
    return Seeing(camera, eye, dobot_shades(config.dobot, eye.view.camera))


def simulated(camera: Camera, size: tuple[int, int], table_m: float = 0.40) -> Seeing:
    """The eye over the PyBullet arm's table: its view is known exactly."""
    from robot_bridge.bullet import overhead

    view = overhead(*size)
    return Seeing(camera, eye_over(table_m, view), drawn_shades(view))


def calibrated(config: CameraConfig) -> tuple[Camera, Eye]:
    """A real camera, started, behind its calibration. Raises CameraError, CalibrationError."""
    from scene import calibration
    from scene.camera import UsbCamera
    from scene.camera import camera as named

    lens, table = calibration.eye(calibration.folder(config.folder), config.size, config.table)
    eye = eye_over(config.table / 1000, table.view, lens.flattener())
    camera = named(str(config.source), config.size, loop=True)
    if isinstance(camera, UsbCamera):
        camera.start()
    return camera, eye


def eye_over(table_m: float, view: View, undistort: Undistort | None = None) -> Eye:
    """The detector with its weights, its closer look, and the names that a person has shown it,
    behind a lens. A closer look is left to when the scene is told.

    ``table_m``: the table's side in metres. Raises ConfigError where there are no weights.
    """
    from scene.closer import Closer
    from scene.detector import NetDetector
    from scene.eye import Eye
    from scene.shown import ShownStore, named

    closer = Closer(NetDetector(table_m), later=True)
    taught = Taught(closer, lambda seen: named(ShownStore().load(), seen))
    seeing = Eye(taught, view, settle=closer.settle)
    return seeing if undistort is None else seeing._replace(undistort=undistort)


class Taught:
    """A detector whose detections get the names that a person gave to things like them."""

    def __init__(
        self,
        detector: Detector,
        names: Callable[[tuple[Detection, ...]], tuple[Detection, ...]],
    ) -> None:
        self._detector, self._names = detector, names

    def detect(
        self, picture: Picture, view: View, expected: Sequence[Detection] = ()
    ) -> tuple[Detection, ...]:
        """See `scene.sight.Detector`."""
        return self._names(self._detector.detect(picture, view, expected))


def drawn_shades(view: View) -> Shades:
    """What the drawn arm of the PyBullet table hides, and its tool."""
    from robot_bridge.drawing import arm_links
    from robot_bridge.things import TOOL_RADIUS
    from scene.lean import Bar, shade

    def shades(tip: Pose) -> tuple[Shade, ...]:
        links = arm_links(tip)
        tool = Bar((tip.x, tip.y, tip.z), links[-1].end, 2 * TOOL_RADIUS)
        return tuple(shade(bar, view.camera) for bar in (*(Bar(*link) for link in links), tool))

    return shades


def dobot_shades(config: DobotConfig, eye: Centre) -> Shades:
    """What a Dobot hides, taken as one bar from its shoulder to above its cup."""
    from robot_bridge.dobot_cell import Cell, Millimetres
    from scene.lean import Bar, shade

    scale = config.scale
    foot = Cell(config).pose(Millimetres(0.0, 0.0, config.floor + SHOULDER_MM, 0.0))
    base = (foot.x, foot.y, foot.z)

    def shades(tip: Pose) -> tuple[Shade, ...]:
        head = (tip.x, tip.y, tip.z + WRIST_MM / scale)
        bars = Bar(base, head, ARM_MM / scale), Bar(head, (tip.x, tip.y, tip.z), ARM_MM / scale)
        return tuple(shade(bar, eye) for bar in bars)

    return shades

"""`armchat scene`: what the eye sees, as a table, JSON or a picture; names for what it sees."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterator, Mapping
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, TextIO

import msgspec

from agent.bus import Bus
from agent.errors import CameraError, ConfigError
from agent.messages import PictureInfo, SceneCall, SceneSnapshot
from agent.showing import add_showing
from scene.types import Scene, SceneObject

if TYPE_CHECKING:
    from scene.annotate import Write
    from scene.eye import Eye
    from scene.sight import Camera, Picture, Pixels, View

PICTURES = 5
"""Pictures of a source that are looked at, at most: a place is the surer for them."""
PATIENCE = 15.0
"""Seconds that a running agent's eye may take."""


class Found(NamedTuple):
    """What an eye sees: the scene, the standard deviations and what is unseen, by id; the picture
    without its lens's distortion, and its view, where they are wanted."""

    scene: Scene
    sd: Mapping[str, float]
    unseen: Mapping[str, float]
    picture: tuple[Pixels, View] | None = None


Options = Callable[[argparse.ArgumentParser], None]


def add_scene(
    commands: argparse._SubParsersAction[argparse.ArgumentParser], scene_options: Options
) -> None:
    """`scene` and what it can do."""
    scene = commands.add_parser("scene", help="the table: simulated, or as the eye sees it")
    whats = scene.add_subparsers(dest="what", metavar="WHAT", required=True)
    snapshot = whats.add_parser("snapshot", help="the scene object, and what a camera sees of it")
    scene_options(snapshot)
    snapshot.add_argument("--picture", metavar="FILE", help="write a PNG, from overhead")
    snapshot.add_argument("--size", type=int, nargs=2, metavar=("W", "H"), default=(640, 480))
    snapshot.set_defaults(act=_snapshot)
    show = whats.add_parser("show", help="what the eye sees: a camera's, or the simulated arm's")
    scene_options(show)
    show.add_argument("--source", metavar="SOURCE", help="a calibrated camera, video, pictures/")
    show.add_argument("--connect", metavar="ENDPOINT", help="the eye of a running agent")
    show.add_argument("--json", action="store_true", help="the scene object, sd and unseen by id")
    show.add_argument("--picture", metavar="FILE", help="write a PNG with footprints and ids")
    show.set_defaults(act=_show)
    call = whats.add_parser("call", help="give a thing that the eye sees a name, for good")
    call.add_argument("id", help="as `scene show` has it, e.g. thing_1")
    call.add_argument("name", help='e.g. "widget"')
    call.add_argument("--connect", metavar="ENDPOINT", help="the agent whose eye it is")
    call.set_defaults(act=_call)
    add_showing(whats)


def _snapshot(arguments: argparse.Namespace) -> int:
    from agent.snapshot import snapshot

    size = tuple(arguments.size)
    return snapshot(arguments.scene, arguments.seed or 0, arguments.picture, size, sys.stdout)


def _show(arguments: argparse.Namespace) -> int:
    if arguments.connect and arguments.source:
        raise ConfigError("--connect looks through another eye: leave out --source")
    if arguments.connect:
        found = _connected(arguments.connect, bool(arguments.picture))
    elif arguments.source:
        found = _through(arguments.source)
    else:
        found = _simulated(arguments.scene, arguments.seed or 0)
    if arguments.picture:
        _write_picture(found, Path(arguments.picture))
    show(found, arguments.json, sys.stdout)
    return 0


def show(found: Found, as_json: bool, out: TextIO) -> None:
    """Print the scene object with ``sd`` and ``unseen`` added, or a table for people."""
    if as_json:
        tree = {**msgspec.to_builtins(found.scene), "sd": found.sd, "unseen": found.unseen}
        out.write(msgspec.json.encode(tree).decode() + "\n")
        return
    out.writelines(f"{line}\n" for line in lines(found))


def lines(found: Found) -> Iterator[str]:
    """The table for people; millimetres."""
    mm = 1000 * found.scene.table_m / 2
    yield f"{'id':14} {'name':12} {'colour':8} {'x mm':>6} {'y mm':>6} {'± mm':>5}  size mm     on"
    for item in found.scene.objects:
        x, y = (mm * value for value in item.position)
        off = mm * found.sd.get(item.id, 0.0)
        unseen = found.unseen.get(item.id, 0.0)
        late = f"  unseen for {unseen:.0f} s" if unseen >= 1 else ""
        yield (
            f"{item.id:14} {item.name:12} {item.color or '-':8} {x:6.0f} {y:6.0f} {off:5.1f}  "
            f"{_size(item, mm):11} {item.on}{late}"
        )
    for item in found.scene.tray:
        yield f"{item.id:14} {item.name:12} {item.color or '-':8} {'':20} {_size(item, mm):11} tray"


def _size(item: SceneObject, mm: float) -> str:
    return "x".join(f"{mm * side:.0f}" for side in (item.width, item.height, item.tall))


# --- through which eye ------------------------------------------------------------------------


def _simulated(scene: str | None, seed: int) -> Found:
    """The PyBullet arm's table, seen by its camera."""
    from agent.compose import scene_from
    from agent.config import load
    from agent.eyes import simulated
    from robot_bridge.bullet import BulletRobot

    size = load().scene.size
    robot = BulletRobot(scene_from(scene), seed)
    try:
        table = robot.scene()
        camera = _Still(robot.picture(*size))
    finally:
        robot.close()
    return look(camera, simulated(camera, size, table.table_m).eye, table.table_m)


class _Still:
    """A camera that has one picture."""

    def __init__(self, pixels: Pixels) -> None:
        self._pixels: Pixels | None = pixels

    def look(self) -> Picture:
        from scene.sight import Picture

        pixels, self._pixels = self._pixels, None
        if pixels is None:
            raise CameraError("there is only one picture")
        return Picture(pixels, 0.0)

    def close(self) -> None:
        """Nothing is open."""


def _through(source: str) -> Found:
    """A calibrated camera's table."""
    from agent.config import load
    from agent.eyes import calibrated

    config = load({"camera.source": source}).camera
    camera, eye = calibrated(config)
    try:
        return look(camera, eye, config.table / 1000)
    finally:
        camera.close()


def look(camera: Camera, eye: Eye, table_m: float) -> Found:
    """What is seen in up to `PICTURES` of a camera's pictures. Raises CameraError without any."""
    from scene.eye import Seen, look_at
    from scene.sight import Picture
    from scene.track import LIVE, ONCE
    from scene.tracks import Hint

    pictures = [camera.look()]
    for _ in range(PICTURES - 1):
        try:
            pictures.append(camera.look())
        except CameraError:
            break  # the end of a file, or a camera that is gone: what there is has to do
    rules = LIVE if len(pictures) >= LIVE.confirm else ONCE
    if rules is ONCE:  # what a closer look sees is told with the picture behind it
        for _ in range(PICTURES):
            eye.detect(pictures[-1])
            eye.settle()
    seen = Seen(table_m=table_m)
    for number, picture in enumerate(pictures):
        # things at rest: when each was taken is no matter
        seen, sight = look_at(seen, Picture(picture.pixels, number / 10), eye, Hint(), rules)
        eye.settle()
    flat = eye.undistort(pictures[-1]).pixels
    return Found(sight.scene, sight.sd, sight.unseen, (flat, eye.view))


def _connected(endpoint: str, with_picture: bool) -> Found:
    """What the eye of a running agent sees."""
    from agent.config import load
    from agent.daemon import open_bus

    with open_bus(load({"bus.connect": endpoint}).bus) as bus:
        return asked(bus, with_picture)


def asked(bus: Bus, with_picture: bool) -> Found:
    """What the scene service on a bus says and shows. Raises BusError, Declined."""
    told = bus.ask(bus.keys.snapshot(), None, SceneSnapshot, PATIENCE)
    return Found(told.scene, told.sd, told.unseen, _shown(bus) if with_picture else None)


def _shown(bus: Bus) -> tuple[Pixels, View]:
    """The picture that a scene service has, and its view."""
    import numpy as np

    from scene import opencv
    from scene.sight import View

    data, metadata = bus.ask_raw(bus.keys.camera(), PATIENCE)
    info = msgspec.json.decode(metadata, type=PictureInfo)
    if len(info.homography) != 9 or len(info.camera) != 3:
        raise ConfigError("that eye does not say how its pictures show the table")
    x, y, z = info.camera
    return opencv.decode(data), View(np.array(info.homography).reshape(3, 3), (x, y, z))


def _write_picture(found: Found, path: Path) -> None:
    """The picture with footprints, and ids where OpenCV is there to write them."""
    from robot_bridge.png import png
    from scene.annotate import annotated

    assert found.picture is not None
    pixels, view = found.picture
    try:
        path.write_bytes(png(annotated(pixels, found.scene, view, _writer())))
    except OSError as error:
        raise ConfigError(f"cannot write {path}: {error.strerror}") from error


def _writer() -> Write | None:
    if find_spec("cv2") is None:
        return None
    from scene import opencv

    return opencv.write


# --- names ------------------------------------------------------------------------------------


def _call(arguments: argparse.Namespace) -> int:
    from agent.config import LOCAL_ENDPOINT, load
    from agent.daemon import open_bus

    config = load({"bus.connect": arguments.connect})
    if not config.bus.connect:
        config = load({"bus.connect": LOCAL_ENDPOINT})
    with open_bus(config.bus) as bus:
        give_name(bus, arguments.id, arguments.name, sys.stdout)
    return 0


def give_name(bus: Bus, id_: str, name: str, out: TextIO) -> None:
    """Name a thing for the eye on a bus. Raises Declined where it does not see that thing."""
    told = bus.ask(bus.keys.call(), SceneCall(id_, name), SceneSnapshot, PATIENCE)
    item = told.scene.get(id_)
    out.write(f"{item.id} is called {item.name} now.\n")

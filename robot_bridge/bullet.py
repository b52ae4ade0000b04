"""The arm over a simulated table with physics (PyBullet); the only file that imports pybullet.

Profile `bench`: the contract's table, no reach limit, the arm drawn to scale by inverse
kinematics (visual only). The tool is a force-limited body on a constraint: it pushes, presses and
is stopped by what it cannot push; a motion that stalls ends there. Suction is a constraint, made
where a ray below the cup meets a level surface; it gives way above its force. Open containers,
whose middle is air, are held by their rim when the cup is level with it (a real arm would need a
gripper there). Same scene, seed and plans: same result, to the last bit, on one machine.
"""

from __future__ import annotations

import ctypes
import functools
import importlib
import itertools
import math
import os
import weakref
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from agent.errors import ConfigError, NotReady, Stopped
from agent.messages import KeepOut
from robot_bridge.drawing import Link, arm_links
from robot_bridge.furniture import Physics
from robot_bridge.mishaps import NONE, Mishaps
from robot_bridge.motion import along
from robot_bridge.physics import STEP, TICK, World
from robot_bridge.simulated import SimulatedArm
from scene.sight import View
from scene.types import Pose, Scene

PUSH_SPEED, DOWN_SPEED = 0.5, 0.9
"""Speed among things, and down (table units per second)."""
BRAKE = 24
"""Steps in which a stopped tool comes to rest."""
CAMERA_HEIGHT = 6.0
"""Height of the overhead camera above the table's middle (table units)."""
VIEW = 1.45
"""Half of the table's plane that the picture's shorter side shows (table units)."""


@functools.cache
def _engine() -> Physics:
    """The pybullet module, imported without the banner that it writes past Python.

    Raises ConfigError where there is no wheel.
    """
    flush = ctypes.CDLL(None).fflush
    kept, void = (os.dup(1), os.dup(2)), os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(void, 1)
        os.dup2(void, 2)
        return importlib.import_module("pybullet")
    except ImportError as error:
        raise ConfigError(
            "the PyBullet arm needs: pip install 'armchat[sim]' (Linux x86_64)"
        ) from error
    finally:
        flush(None)
        for number, copy in zip((1, 2), kept, strict=True):
            os.dup2(copy, number)
            os.close(copy)
        os.close(void)


class _Client:
    """pybullet's functions bound to one physics server."""

    def __init__(self, gui: bool) -> None:
        if gui and not os.environ.get("DISPLAY"):
            raise ConfigError("a window needs a display, and DISPLAY is not set: leave out --gui")
        self._module = _engine()
        self._id = self._module.connect(self._module.GUI if gui else self._module.DIRECT)
        weakref.finalize(self, self._module.disconnect, self._id)

    def __getattr__(self, name: str) -> Physics:
        value = getattr(self._module, name)
        if callable(value):
            value = functools.partial(value, physicsClientId=self._id)
        setattr(self, name, value)
        return value


class BulletRobot(SimulatedArm):
    """The simulated arm as a robot (`robot_bridge.api.Simulated`).

    ``seed`` varies masses a little; ``pace`` 0 runs as fast as it can, 1 in real time; ``speed`` is
    a share of the full speeds; ``gui`` shows the table in a window.
    Raises ConfigError where PyBullet is not installed, and for a window where there is no display.
    """

    def __init__(
        self,
        scene: Scene | None = None,
        seed: int = 0,
        pace: float = 0.0,
        gui: bool = False,
        keep_outs: Sequence[KeepOut] = (),
        mishaps: Mishaps = NONE,
        speed: float = 1.0,
    ) -> None:
        super().__init__(pace, keep_outs, mishaps, speed)
        self._seed = seed
        self._at_once = False
        self._client = _Client(gui)
        self._world = self._made(self._client)
        self._arm: dict[tuple[int, float], int] = {}
        self._pictured: tuple[tuple[float, ...], NDArray[np.uint8]] | None = None
        self.load(scene or Scene())

    def _made(self, client: Physics) -> World:
        """The world that the arm works in; a bench that listens to its steps makes its own."""
        return World(client)

    @property
    def _stage(self) -> World:
        return self._world

    def pose(self) -> Pose:
        """Where the tool's tip is, measured."""
        with self._lock:
            return self._world.tip()

    def _grip(self, on: bool) -> None:
        with self._lock:
            if on:
                self._world.take()
            else:
                self._world.let_go()
                self._world.settle()

    def _move(self, goal: Pose) -> None:
        with self._lock:
            start = self._world.target
            self._world.face(goal)
            turn_speed = self._limits.turn_speed
            poses = along(start, goal, self._speed(start, goal), STEP, turn_speed)
        free = True
        while free and (chunk := list(itertools.islice(poses, TICK))):
            with self._lock:
                free = self._world.advance(chunk)
            if self._halt.wait(TICK * STEP * self._pace) if self._pace else self._halt.is_set():
                if free and not self._at_once:
                    self._slow_down(list(poses))
                self._hold()
                raise Stopped("stop")
        self._hold()

    def _slow_down(self, rest: Sequence[Pose]) -> None:
        """Come to rest on what is left of the way, within BRAKE steps."""
        way = 0.0
        taken: list[Pose] = []
        for step in range(BRAKE):
            way += 1 - step / BRAKE
            taken += rest[int(way) : int(way) + 1]
        for first in range(0, len(taken), TICK):
            with self._lock:
                self._world.advance(taken[first : first + TICK])

    def _hold(self) -> None:
        """Stay where it is for a moment, until the tool has come to rest."""
        with self._lock:
            self._world.advance([self._world.target] * TICK)

    def _speed(self, start: Pose, goal: Pose) -> float:
        """Full speed above things, slower down, slow among them."""
        low = min(start.z, goal.z)
        aside = math.hypot(goal.x - start.x, goal.y - start.y) > 1e-3
        if aside and low < self._world.highest():
            return PUSH_SPEED * self._share
        return DOWN_SPEED * self._share if goal.z < start.z - 1e-3 else self._limits.speed

    def stop(self, now: bool = False) -> None:
        """Slow down and halt (``now``: halt), keep the grip, latch until `reset`."""
        self._at_once = now
        super().stop(now)

    def load(self, scene: Scene) -> None:
        """Make the world be this scene, arm parked, gripper empty.

        Raises NotReady while a plan runs.
        """
        with self._lock:
            if self._busy:
                raise NotReady("another plan is running")
            self._arm, self._pictured = {}, None
            self._world.build(scene, self._seed)

    def scene(self) -> Scene:
        """The world as it is now, settled unless a plan is running."""
        with self._lock:
            if not self._busy and not self._closed:
                self._world.settle()
            return self._world.scene()

    def picture(self, width: int = 320, height: int = 240) -> NDArray[np.uint8]:
        """What the overhead camera sees: rows from far to near, shape (height, width, 3), RGB.

        Drawn at twice the size and shrunk; while nothing has moved, the picture before.
        """
        with self._lock:
            state = (width, height, *self._world.places())
            if self._pictured is None or self._pictured[0] != state:
                self._pictured = state, self._photograph(width, height)
            return self._pictured[1].copy()

    def view(self, width: int = 320, height: int = 240) -> View:
        """How `picture` shows the table."""
        return overhead(width, height)

    def _photograph(self, width: int, height: int) -> NDArray[np.uint8]:
        self._draw_arm(arm_links(self._world.tip()))
        p, wide, high = self._client, 2 * width, 2 * height
        view = p.computeViewMatrix((0, 0, CAMERA_HEIGHT), (0, 0, 0), (0, 1, 0))
        angle = math.degrees(2 * math.atan(VIEW / CAMERA_HEIGHT))
        lens = p.computeProjectionMatrixFOV(angle, width / height, 0.5, CAMERA_HEIGHT + 2)
        seen = p.getCameraImage(wide, high, view, lens, renderer=p.ER_TINY_RENDERER)
        pixels = np.asarray(seen[2], dtype=np.float32).reshape(high, wide, 4)[:, :, :3]
        shrunk: NDArray[np.float32] = pixels.reshape(height, 2, width, 2, 3).mean(axis=(1, 3))
        return shrunk.astype(np.uint8)

    def _draw_arm(self, links: tuple[Link, ...]) -> None:
        """Put the drawn arm (visual bodies that touch nothing) where the tool is."""
        p = self._client
        lengths = tuple(round(math.dist(link.start, link.end), 6) for link in links)
        for index, (link, long) in enumerate(zip(links, lengths, strict=True)):
            key = (index, long)
            if key not in self._arm:
                self._arm[key] = _beam(p, link)
            p.resetBasePositionAndOrientation(self._arm[key], *_placed(p, link))
        for key, body in self._arm.items():
            if key not in set(enumerate(lengths)):
                p.resetBasePositionAndOrientation(body, (0, 0, -50), (0, 0, 0, 1))


def overhead(width: int, height: int) -> View:
    """How a picture of the overhead camera shows the table: straight from above, no distortion.

    The renderer samples its pixels at their lower left corners, not their middles (measured).
    """
    scale, corner = (
        height / (2 * VIEW),
        0.25,
    )  # half a pixel of the drawing, which is twice as large
    u, v = (width - 1) / 2 + corner, (height - 1) / 2 - corner
    homography = np.array([[scale, 0, u], [0, -scale, v], [0, 0, 1]], dtype=np.float64)
    return View(homography, (0.0, 0.0, CAMERA_HEIGHT))


def _beam(p: Physics, link: Link) -> int:
    """A drawn bar as long and thick as a link."""
    half = (link.thick / 2, link.thick / 2, math.dist(link.start, link.end) / 2)
    look = p.createVisualShape(p.GEOM_BOX, halfExtents=half, rgbaColor=(0.85, 0.86, 0.88, 1))
    return int(p.createMultiBody(0, -1, look, (0, 0, 0)))


def _placed(p: Physics, link: Link) -> tuple[list[float], Sequence[float]]:
    """Middle and orientation of a bar from one end of a link to the other."""
    span = [end - start for start, end in zip(link.start, link.end, strict=True)]
    pitch = math.acos(max(-1.0, min(1.0, span[2] / math.hypot(*span))))
    middle = [(start + end) / 2 for start, end in zip(link.start, link.end, strict=True)]
    return middle, p.getQuaternionFromEuler((0, pitch, math.atan2(span[1], span[0])))

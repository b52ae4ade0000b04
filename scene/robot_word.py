"""What a bridge says of its robot on the bus, kept as the hint that an eye needs. Thread-safe."""

from __future__ import annotations

import threading
from collections.abc import Callable

from agent.bus import Bus, Closing
from agent.messages import RobotEvent, RobotState, Waypoint
from agent.wire import Message
from scene.lean import Shade
from scene.tracks import Hint
from scene.types import Pose

Shades = Callable[[Pose], tuple[Shade, ...]]
"""What an arm hides from the camera when its tool is at a pose."""


def no_shades(tip: Pose) -> tuple[Shade, ...]:
    """Of an arm whose shape nobody told."""
    return ()


class RobotWord:
    """The newest of a robot's pose, suction and feeling."""

    def __init__(self, shades: Shades = no_shades) -> None:
        self._shades = shades
        self._lock = threading.Lock()
        self._hint = Hint()

    def listen(self, bus: Bus, robot: str) -> list[Closing]:
        """Follow a robot on the bus."""
        return [
            bus.subscribe(bus.keys.state(robot), self._state, latest=True),
            bus.subscribe(bus.keys.steps(robot), self._step),
        ]

    def hint(self) -> Hint:
        """What is known now, and what the arm hides."""
        with self._lock:
            hint = self._hint
        return hint if hint.tip is None else hint._replace(shades=self._shades(hint.tip))

    def _state(self, key: str, message: Message) -> None:
        if isinstance(message, RobotState):
            with self._lock:
                idle = message.program == "idle"
                self._hint = self._hint._replace(tip=_pose(message.pose), idle=idle)

    def _step(self, key: str, message: Message) -> None:
        if not isinstance(message, RobotEvent) or message.step is None:
            return
        step = message.step
        tip = _pose(step.reached)
        with self._lock:
            changed = step.reached.grip != self._hint.grip
            at = tip if changed else self._hint.at
            self._hint = self._hint._replace(tip=tip, grip=step.reached.grip, felt=step.held, at=at)


def _pose(point: Waypoint) -> Pose:
    return Pose(point.x, point.y, point.z, point.r)

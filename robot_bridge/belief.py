"""What ought to be on a real arm's table: the scene that was told, and what the arm did since.

Nothing sees the table here: what the arm's measured motion would do to it is computed on the ideal
table. A camera's scene takes its place where there is one.
"""

from __future__ import annotations

import threading

from agent.messages import Command
from robot_bridge.table import Table
from scene.types import Pose, Scene


class Belief:
    """A scene that follows the arm. Thread-safe."""

    def __init__(self, scene: Scene, tip: Pose) -> None:
        self._lock = threading.Lock()
        self._ideal = Table(scene, tip)

    def begins(self, tip: Pose) -> None:
        """A plan begins here; the tray has closed up."""
        with self._lock:
            if self._ideal.held is None:
                self._ideal.tip = tip
            self._ideal.reseat()

    def follows(self, command: Command, reached: Pose) -> None:
        """The arm did this and stands there."""
        with self._lock:
            if command.op == "grip":
                self._ideal.grip(command.grip)
            else:
                self._ideal.move(reached.x, reached.y, reached.z, reached.r)

    def scene(self) -> Scene:
        """The table as it ought to be."""
        with self._lock:
            return self._ideal.scene()

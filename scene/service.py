"""The live scene on the bus. Its source is a simulated robot's own world, until a camera sees one.

A snapshot query looks again (it asks the world), so that who moved something and then asks sees
what came of it; the stream is told on change, at most ten times a second.
"""

from __future__ import annotations

import threading
import time

from agent.bus import Bus, Closing
from agent.errors import BusError, Declined
from agent.messages import SceneSnapshot, WorldSnapshot
from agent.wire import Message
from scene.types import Scene

PERIOD = 0.1
"""Seconds between two snapshots at least."""


class SceneService:
    """Serves ``scene/<name>/...`` from the world of the simulated robot ``robot``."""

    def __init__(self, bus: Bus, robot: str = "r1", name: str = "main") -> None:
        self.name = name
        self._bus = bus
        self._robot = robot
        self._lock = threading.Lock()
        self._scene: Scene | None = None
        self._told: Scene | None = None
        self._seq = 0
        self._wake = threading.Event()
        self._closing = threading.Event()
        self._declared: list[Closing] = []
        self._teller: threading.Thread | None = None

    def start(self) -> None:
        """Serve; the service's token comes last."""
        keys = self._bus.keys
        self._declared = [
            self._bus.serve(keys.snapshot(self.name), self._look),
            self._bus.subscribe(keys.world(self._robot), self._seen, latest=True),
        ]
        self._teller = threading.Thread(target=self._telling, name="scene", daemon=True)
        self._teller.start()
        self._declared.append(self._bus.token(keys.alive("scene", self.name)))

    def close(self) -> None:
        """Withdraw from the bus."""
        self._closing.set()
        self._wake.set()
        for closing in reversed(self._declared):
            closing.close()
        self._declared.clear()
        if self._teller is not None:
            self._teller.join(timeout=2.0)

    def _seen(self, key: str, message: Message) -> None:
        if isinstance(message, WorldSnapshot):
            self._scene = message.scene
            self._wake.set()

    def _look(self, key: str, request: Message | None) -> SceneSnapshot:
        try:
            world = self._bus.ask(self._bus.keys.world(self._robot), None, WorldSnapshot, 2.0)
        except BusError as error:
            raise Declined("no_view", f"nothing to see: {error}") from error
        return self._snapshot(world.scene)

    def _snapshot(self, scene: Scene) -> SceneSnapshot:
        with self._lock:
            self._seq += 1
            return SceneSnapshot(self._seq, time.time(), scene)

    def _telling(self) -> None:
        while not self._closing.is_set():
            self._wake.wait()
            self._wake.clear()
            scene = self._scene
            if scene is not None and scene != self._told:
                self._told = scene
                self._bus.publish(self._bus.keys.objects(self.name), self._snapshot(scene))
                self._closing.wait(PERIOD)

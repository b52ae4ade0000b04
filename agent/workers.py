"""Who of several workers gets a request: of those whose token is there, the one with the least
in flight; the next one if it gives no answer. Requests to workers have no effects, so that a
second try does no harm.
"""

from __future__ import annotations

import random
import threading
from collections import Counter
from collections.abc import Callable
from typing import TypeVar

from agent.bus import Bus, Closing
from agent.errors import BusError, NoService
from agent.wire import ANY, Message

M = TypeVar("M")


READY = 2.0
"""Seconds to wait for a first worker: services start side by side."""


class Workers:
    """The live workers of one service ("translate", "clarify"), by their tokens; thread-safe."""

    def __init__(self, bus: Bus, service: str, key: Callable[[str], str]) -> None:
        self._bus = bus
        self._service = service
        self._key = key
        self._changed = threading.Condition()
        self._alive: set[str] = set()
        self._watching: Closing | None = None
        self._in_flight: Counter[str] = Counter()

    def ask(self, request: Message, reply_type: type[M], timeout: float) -> M:
        """Ask one worker after the other (seconds each). Raises NoService, or the last error."""
        last: BusError | None = None
        for worker in self._ranked():
            with self._changed:
                self._in_flight[worker] += 1
            try:
                return self._bus.ask(self._key(worker), request, reply_type, timeout)
            except BusError as error:
                last = error
            finally:
                with self._changed:
                    self._in_flight[worker] -= 1
        raise last or NoService(f"no {self._service} worker is alive")

    def _ranked(self) -> list[str]:
        """Live workers, the least busy first. The watch ends with the bus."""
        with self._changed:
            if self._watching is None:
                keys = self._bus.keys.alive(self._service, ANY)
                self._watching = self._bus.watch(keys, self._seen)
            self._changed.wait_for(lambda: self._alive, READY)
            workers = random.sample(sorted(self._alive), len(self._alive))
            return sorted(workers, key=lambda worker: self._in_flight[worker])

    def _seen(self, key: str, alive: bool) -> None:
        worker = key.rsplit("/", 1)[1]
        with self._changed:
            (self._alive.add if alive else self._alive.discard)(worker)
            self._changed.notify_all()

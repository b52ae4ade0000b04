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

from agent.bus import Bus
from agent.errors import BusError, NoService
from agent.wire import ANY, Message

M = TypeVar("M")


class Workers:
    """The live workers of one service ("translate", "clarify"); thread-safe."""

    def __init__(self, bus: Bus, service: str, key: Callable[[str], str]) -> None:
        self._bus = bus
        self._service = service
        self._key = key
        self._lock = threading.Lock()
        self._in_flight: Counter[str] = Counter()

    def ask(self, request: Message, reply_type: type[M], timeout: float) -> M:
        """Ask one worker after the other (seconds each). Raises NoService, or the last error."""
        last: BusError | None = None
        for worker in self._ranked():
            with self._lock:
                self._in_flight[worker] += 1
            try:
                return self._bus.ask(self._key(worker), request, reply_type, timeout)
            except BusError as error:
                last = error
            finally:
                with self._lock:
                    self._in_flight[worker] -= 1
        raise last or NoService(f"no {self._service} worker is alive")

    def _ranked(self) -> list[str]:
        tokens = self._bus.alive(self._bus.keys.alive(self._service, ANY))
        workers = [token.rsplit("/", 1)[1] for token in tokens]
        random.shuffle(workers)
        with self._lock:
            return sorted(workers, key=lambda worker: self._in_flight[worker])

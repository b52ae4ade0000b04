"""Who of several workers gets a request: of those whose token is there, the one with the least
in flight; the next one if it gives no answer. Requests to workers have no effects, so that a
second try does no harm.
"""

from __future__ import annotations

import random
import threading
from collections import Counter
from collections.abc import Callable, Set
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
        tried: set[str] = set()
        while worker := self._take_next(tried):
            tried.add(worker)
            try:
                return self._bus.ask(self._key(worker), request, reply_type, timeout)
            except BusError as error:
                last = error
            finally:
                with self._changed:
                    self._in_flight[worker] -= 1
        raise last or NoService(f"no {self._service} worker is alive")

    def _take_next(self, tried: Set[str]) -> str | None:
        """Choose and count the least busy live worker in one step, so that two never both do."""
        with self._changed:
            if self._watching is None:
                self._watch()
            self._changed.wait_for(lambda: self._alive or tried, READY)
            left = [worker for worker in sorted(self._alive) if worker not in tried]
            if not left:
                return None
            least = min(self._in_flight[worker] for worker in left)
            worker = random.choice([w for w in left if self._in_flight[w] == least])
            self._in_flight[worker] += 1
            return worker

    def _watch(self) -> None:
        """Know who is there now and who comes and goes. The watch ends with the bus."""
        keys = self._bus.keys.alive(self._service, ANY)
        self._watching = self._bus.watch(keys, self._seen)
        self._alive.update(key.rsplit("/", 1)[1] for key in self._bus.alive(keys))

    def _seen(self, key: str, alive: bool) -> None:
        worker = key.rsplit("/", 1)[1]
        with self._changed:
            (self._alive.add if alive else self._alive.discard)(worker)
            self._changed.notify_all()

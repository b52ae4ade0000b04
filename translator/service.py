"""The translator on the bus: one query, sentence in, candidates out; any number of workers."""

from __future__ import annotations

from collections.abc import Callable

from agent.bus import Bus, Closing
from agent.errors import Declined
from agent.messages import TranslateRequest, Translation
from agent.wire import Message
from agent.workers import Workers

Translate = Callable[[TranslateRequest], Translation]

TIMEOUT = 20.0
"""Seconds for one translation by one worker, the first one's loading of weights included."""


class TranslatorService:
    """Serves ``translate/<name>/run`` around a translate function."""

    def __init__(self, bus: Bus, translate: Translate, name: str = "t1") -> None:
        self.name = name
        self._bus = bus
        self._translate = translate
        self._declared: list[Closing] = []

    def start(self) -> None:
        """Serve; the worker's token comes last."""
        keys = self._bus.keys
        self._declared = [
            self._bus.serve(keys.translate(self.name), self._run),
            self._bus.token(keys.alive("translate", self.name)),
        ]

    def close(self) -> None:
        """Withdraw from the bus."""
        while self._declared:
            self._declared.pop().close()

    def _run(self, key: str, request: Message | None) -> Translation:
        if not isinstance(request, TranslateRequest):
            raise Declined("bad_payload", "translate takes a TranslateRequest")
        return self._translate(request)


def translate_over(bus: Bus) -> Translate:
    """Translate by whichever worker is alive. The function raises NoService, Declined, NoAnswer."""
    workers = Workers(bus, "translate", bus.keys.translate)
    return lambda request: workers.ask(request, Translation, TIMEOUT)

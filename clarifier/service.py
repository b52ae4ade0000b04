"""The clarifier on the bus: one query, a sentence with its scene and dialog in, a decision out."""

from __future__ import annotations

from collections.abc import Callable

from agent.bus import Bus, Closing
from agent.errors import Declined
from agent.messages import ClarifyRequest, Decision
from agent.wire import Message
from agent.workers import Workers

Decide = Callable[[ClarifyRequest], Decision]

TIMEOUT = 30.0
"""Seconds for one decision, the translation it needs included."""


class ClarifierService:
    """Serves ``clarify/<name>/turn`` around a decide function."""

    def __init__(self, bus: Bus, decide: Decide, name: str = "c1") -> None:
        self.name = name
        self._bus = bus
        self._decide = decide
        self._declared: list[Closing] = []

    def start(self) -> None:
        """Serve; the worker's token comes last."""
        keys = self._bus.keys
        self._declared = [
            self._bus.serve(keys.clarify(self.name), self._turn),
            self._bus.token(keys.alive("clarify", self.name)),
        ]

    def close(self) -> None:
        """Withdraw from the bus."""
        while self._declared:
            self._declared.pop().close()

    def _turn(self, key: str, request: Message | None) -> Decision:
        if not isinstance(request, ClarifyRequest):
            raise Declined("bad_payload", "clarify takes a ClarifyRequest")
        return self._decide(request)


def decide_over(bus: Bus) -> Decide:
    """Decide by whichever worker is alive. The function raises NoService, Declined, NoAnswer."""
    workers = Workers(bus, "clarify", bus.keys.clarify)
    return lambda request: workers.ask(request, Decision, TIMEOUT)

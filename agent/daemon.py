"""Services in one process: start them in order, wait for a signal, close them in reverse.

Each service has `start` and `close` and says by a token (``alive/<service>/<id>``) that it is
there; who depends on it sees the token go. A service that cannot start ends the daemon, with
everything that was started closed again.
"""

from __future__ import annotations

import logging
import signal
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from types import FrameType
from typing import Protocol

from agent.bus import Bus
from agent.config import BusConfig
from agent.errors import BusError, ConfigError, NoService
from agent.wire import ANY

log = logging.getLogger(__name__)

ALL = "all"
WAKE = 0.5
"""Seconds between two looks of an idle daemon for a signal."""


class Service(Protocol):
    """What a daemon runs."""

    def start(self) -> None:
        """Serve; the token of the service comes last."""
        ...

    def close(self) -> None:
        """Withdraw; nothing is left running."""
        ...


Factory = Callable[[Bus, ExitStack], Service]
"""Makes a service on a bus; what it opens besides (robot, worker process) goes on the stack."""


def chosen(names: Sequence[str], factories: Mapping[str, Factory]) -> list[str]:
    """The services meant by names, in the order of the factories. Raises ConfigError."""
    for name in names:
        if name != ALL and name not in factories:
            raise ConfigError(f"no service {name!r}; known: {', '.join([*factories, ALL])}")
    if not names or ALL in names:
        return list(factories)
    return [name for name in factories if name in names]


@contextmanager
def open_bus(config: BusConfig) -> Iterator[Bus]:
    """A bus as configured; with ``listen`` this process is also the hub. Raises BusError."""
    # Zenoh is loaded by whoever needs it: a program in one process does without.
    from agent.bus_zenoh import Hub, ZenohBus

    with ExitStack() as stack:
        if config.listen:
            stack.enter_context(Hub(config.listen))
            endpoints = tuple(_reachable(endpoint) for endpoint in config.listen)
            config = BusConfig(prefix=config.prefix, connect=endpoints[:1])
        try:
            bus = ZenohBus(config)
        except BusError as error:
            if not config.connect:
                raise
            where = ", ".join(config.connect)
            remedy = f"start `armchat`, or `armchat daemon --listen {config.connect[0]}`"
            raise NoService(f"nobody listens on {where}: {remedy}") from error
        stack.callback(bus.close)
        yield bus


def _reachable(endpoint: str) -> str:
    """Where this process finds what listens there: every interface includes the loopback."""
    return endpoint.replace("/0.0.0.0:", "/127.0.0.1:").replace("/[::]:", "/[::1]:")


@contextmanager
def running(bus: Bus, names: Sequence[str], factories: Mapping[str, Factory]) -> Iterator[None]:
    """The services, running within the block, closed in reverse at its end."""
    with ExitStack() as stack:
        for name in chosen(names, factories):
            service = factories[name](bus, stack)
            stack.callback(service.close)
            service.start()
            log.info("%s is ready", name)
        yield


def serve(bus: Bus, names: Sequence[str], factories: Mapping[str, Factory]) -> None:
    """Run services until SIGTERM or SIGINT (main thread only); other services' comings and goings
    are logged."""
    over = threading.Event()

    def end(number: int, frame: FrameType | None) -> None:
        log.info("%s: closing", signal.Signals(number).name)
        over.set()

    def told(key: str, alive: bool) -> None:
        log.info("%s %s", "/".join(key.split("/")[-2:]), "is there" if alive else "is gone")

    before = {number: signal.signal(number, end) for number in (signal.SIGTERM, signal.SIGINT)}
    try:
        with bus.watch(bus.keys.alive(ANY, ANY), told), running(bus, names, factories):
            # a signal that reached another thread first is seen only when this one wakes
            while not over.wait(WAKE):
                pass
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)

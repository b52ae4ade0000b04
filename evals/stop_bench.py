"""How long a STOP takes over the bus: at rest, in motion, with the agent hung, in a flood.

A daemon of its own holds the simulated arm, another one scene, translator, clarifier and agent. A
stop is timed from `Client.stop` to the bridge's acknowledgement, which comes after the robot's own
``stop`` was called; each one must leave the arm latched. Between two stops the owner resets.
"""

from __future__ import annotations

import os
import queue
import signal
import socket
import statistics
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from agent.arm import BusArm
from agent.bus import Bus, wait_for
from agent.client import Client
from agent.config import BusConfig
from agent.daemon import open_bus
from agent.errors import BusError, RobotError
from agent.messages import Command
from evals.figures import Figure, at_most
from robot_bridge.api import approve

ROOT = Path(__file__).parent.parent
STOPS = 100
GOAL_MS = 100.0
READY = 60.0
"""Seconds for a daemon to be there."""
FLOOD = """
import sys, threading
from agent.config import BusConfig
from agent.daemon import open_bus
from agent.errors import BusError
from agent.messages import RobotState
def ask(bus):
    while True:
        try:
            bus.ask(bus.keys.state("r1"), None, RobotState)
        except BusError:
            pass
with open_bus(BusConfig(prefix=sys.argv[2], connect=(sys.argv[1],))) as bus:
    for _ in range(8):
        threading.Thread(target=ask, args=(bus,), daemon=True).start()
    picture = bytes(100_000)
    print("on", flush=True)
    while True:
        bus.publish_raw(bus.keys.camera(), picture)
"""
"""Pictures of 100 kB, and eight askers of the arm's state, as fast as they can."""
THERE_AND_BACK = tuple(
    Command("move", x, 0.5, 0.9, 0, False, line) for line, x in enumerate((-1.0, 1.0) * 20, 1)
)


def stop_figures(stops: int = STOPS) -> dict[str, Figure]:
    """The 99th percentile, and the median beside it, of each circumstance."""
    found: dict[str, list[float]] = {}
    with _services() as (endpoint, prefix, thinker), ExitStack() as stack:
        bus = stack.enter_context(open_bus(BusConfig(prefix=prefix, connect=(endpoint,))))
        client = Client(bus, "stopper")
        stack.callback(client.close)
        wait_for(bus, bus.keys.alive("agent", "a1"), READY)
        client.acquire()
        found["idle"] = _resting(client, stops)
        found["moving"] = _moving(client, bus, stops)
        thinker.send_signal(signal.SIGSTOP)
        try:
            found["agent_hung"] = _moving(client, bus, stops)
        finally:
            thinker.send_signal(signal.SIGCONT)
        pictures = threading.Event()
        stack.enter_context(
            bus.subscribe_raw(bus.keys.camera(), lambda key, data, about: pictures.set())
        )
        with _flood(endpoint, prefix):
            pictures.wait(READY)
            found["flooded"] = _moving(client, bus, stops)
    figures = {}
    for name, times in found.items():
        figures[f"stop_{name}_p99"] = at_most(_p99(times), GOAL_MS, "ms", len(times))
        figures[f"stop_{name}_median"] = at_most(statistics.median(times), None, "ms", len(times))
    return figures


def _p99(times: list[float]) -> float:
    return sorted(times)[max(0, -(-99 * len(times) // 100) - 1)]


def _resting(client: Client, stops: int) -> list[float]:
    """Stops of an arm that does nothing."""
    times = []
    for _ in range(stops):
        times.append(_timed(client))
        _ready(client)
    return times


def _moving(client: Client, bus: Bus, stops: int) -> list[float]:
    """Stops of an arm that runs a plan, each from the middle of a motion."""
    times: list[float] = []
    while len(times) < stops:
        run = _Run(BusArm(bus, client.name))
        if run.moves():
            times.append(_timed(client))
        run.join()
        _ready(client)
    return times


class _Run:
    """A plan that runs, followed on a thread."""

    def __init__(self, arm: BusArm) -> None:
        self._arm, self._told = arm, queue.SimpleQueue[bool]()
        self._thread = threading.Thread(target=self._follow, daemon=True)
        self._thread.start()

    def _follow(self) -> None:
        try:
            plan = approve(THERE_AND_BACK, self._arm.start(), self._arm.workspace)
            for _ in self._arm.run(plan):
                self._told.put(True)
        except RobotError:
            self._told.put(False)

    def moves(self) -> bool:
        """Whether it got as far as its first motion: in a flood the lease may be lost before."""
        return self._told.get(timeout=READY)

    def join(self) -> None:
        """Wait for its end."""
        self._thread.join(READY)
        if self._thread.is_alive():
            raise TimeoutError("the run did not end by the stop")


def _timed(client: Client) -> float:
    """Milliseconds of one stop, which must leave the arm latched."""
    began = time.perf_counter()
    reply = client.stop()
    took = 1000 * (time.perf_counter() - began)
    if not reply.ok or _safety(client) != "stopped":
        raise RuntimeError(f"the stop left no latch: {reply}")
    return took


def _safety(client: Client) -> str:
    """What the bridge says of itself; in a flood it may have to be asked more than once."""
    until = time.monotonic() + READY
    while True:
        try:
            return client.state().safety
        except BusError:
            if time.monotonic() > until:
                raise


def _ready(client: Client) -> None:
    """The owner makes the arm ready again; one who was silent for too long acquires it anew."""
    until = time.monotonic() + READY
    while True:
        try:
            client.reset()
            client.resume()
        except BusError:
            if time.monotonic() > until:
                raise
            client.release()
        else:
            return


@contextmanager
def _services() -> Iterator[tuple[str, str, subprocess.Popen[bytes]]]:
    """Endpoint and prefix of a bus with two daemons, and the one that thinks."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        endpoint = f"tcp/127.0.0.1:{probe.getsockname()[1]}"
    prefix = f"stop-bench-{os.getpid()}"
    with ExitStack() as stack:
        settings = {"ARMCHAT_BUS__PREFIX": prefix, "ARMCHAT_ROBOT__KIND": "ideal"}
        arm = ["robot", "--listen", endpoint]
        stack.enter_context(_process([*_daemon(*arm)], settings))
        _await_port(endpoint)
        mind = [stack.enter_context(_process([*_daemon(name, "--connect", endpoint)], settings))
                for name in ("scene", "translator", "clarifier", "agent")]  # fmt: skip
        yield endpoint, prefix, mind[-1]


def _daemon(*arguments: str) -> list[str]:
    return [sys.executable, "-m", "agent.cli", "daemon", *arguments]


@contextmanager
def _process(command: list[str], settings: dict[str, str]) -> Iterator[subprocess.Popen[bytes]]:
    process = subprocess.Popen(
        command, cwd=ROOT, env=os.environ | settings, stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
    )  # fmt: skip
    try:
        yield process
    finally:
        process.kill()
        process.wait()
        assert process.stdout is not None
        process.stdout.close()


def _await_port(endpoint: str) -> None:
    host, _, port = endpoint.removeprefix("tcp/").rpartition(":")
    until = time.monotonic() + READY
    while time.monotonic() < until:
        try:
            socket.create_connection((host, int(port)), timeout=1.0).close()
        except OSError:
            threading.Event().wait(0.05)
        else:
            return
    raise TimeoutError(f"no daemon listens on {endpoint}")


@contextmanager
def _flood(endpoint: str, prefix: str) -> Iterator[None]:
    """A process of `FLOOD`."""
    command = [sys.executable, "-c", FLOOD, endpoint, prefix]
    with _process(command, {}) as process:
        assert process.stdout is not None
        process.stdout.readline()
        yield

"""How long a STOP takes over the bus: at rest, in motion, with the agent hung, in a flood.

A daemon of its own holds the simulated arm, another one scene, translator, clarifier and agent. A
stop is timed from `Client.stop` to the bridge's acknowledgement, which comes after the robot's own
``stop`` was called; each one must leave the arm latched. Between two stops the owner resets.
"""

from __future__ import annotations

import os
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
from agent.errors import RobotError
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
    times = []
    for _ in range(stops):
        arm = BusArm(bus, client.name)
        plan = approve(THERE_AND_BACK, arm.start(), arm.workspace)
        began, ended = threading.Event(), threading.Event()

        def follow(arm: BusArm = arm, began: threading.Event = began) -> None:
            try:
                for _ in arm.run(plan):  # noqa: B023 - joined before the next turn
                    began.set()
            except RobotError:
                ended.set()  # noqa: B023

        thread = threading.Thread(target=follow, daemon=True)
        thread.start()
        if not began.wait(READY):
            raise TimeoutError("the plan did not begin")
        times.append(_timed(client))
        if not ended.wait(READY):
            raise TimeoutError("the run did not end by the stop")
        thread.join()
        _ready(client)
    return times


def _timed(client: Client) -> float:
    """Milliseconds of one stop."""
    began = time.perf_counter()
    reply = client.stop()
    took = 1000 * (time.perf_counter() - began)
    if not reply.ok or client.state().safety != "stopped":
        raise RuntimeError(f"the stop left no latch: {reply}")
    return took


def _ready(client: Client) -> None:
    client.reset()
    client.resume()


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

"""`say --connect`, `stop`, `reset`, `pause` ...: the shell as a client of a running agent."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import TextIO

from agent.arm import BusArm
from agent.bus import Bus
from agent.client import Client
from agent.commands import EXIT_DONE, exit_status, show
from agent.config import LOCAL_ENDPOINT, load
from agent.daemon import open_bus
from agent.errors import NoAnswer, NoService
from agent.messages import Kind, RobotReply, Turn
from robot_bridge.moves import Axis, step


@contextmanager
def _joined(connect: str | None) -> Iterator[tuple[Bus, Client]]:
    """Bus and client of the agent at an endpoint, the configured one, or this machine's chat."""
    config = load({"bus.connect": connect})
    if not config.bus.connect:
        config = load({"bus.connect": LOCAL_ENDPOINT})
    with open_bus(config.bus) as bus:
        client = Client(bus, f"shell-{os.getpid()}")
        try:
            yield bus, client
        finally:
            client.close()


@contextmanager
def _client(connect: str | None) -> Iterator[Client]:
    with _joined(connect) as (_, client):
        yield client


def say_remotely(
    connect: str, text: str, answers: Sequence[str], *, task: Kind | None, dry_run: bool,
    as_json: bool, timeout: float, out: TextIO,
) -> int:  # fmt: skip
    """One sentence to a running agent, and the answers to the questions that come."""
    with _client(connect) as client:
        client.wait_ready(min(timeout, 10.0))
        try:
            turn = _turn(client, text, task, dry_run, timeout)
            for answer in answers:
                if turn.question is None:
                    break
                show(turn, as_json, out)
                turn = _turn(client, answer, task, dry_run, timeout)
        except NoAnswer as error:
            raise TimeoutError(str(error)) from error
        show(turn, as_json, out)
        return exit_status(turn)


def _turn(client: Client, text: str, task: Kind | None, dry_run: bool, timeout: float) -> Turn:
    for event in client.say(text, task, dry_run, timeout):
        if event.turn is not None:
            return event.turn
    raise NoService("the agent ended the conversation without an answer")


def stop_remotely(connect: str | None, out: TextIO) -> int:
    """STOP: no lease, no model. 0 once a bridge acknowledged it, else NoService or NoAnswer."""
    with _client(connect) as client:
        client.stop()
    out.write("Stopped. `armchat reset` clears the stop; it never moves the arm.\n")
    return EXIT_DONE


def reset_remotely(connect: str | None, out: TextIO) -> int:
    """Clear the latched stop and allow motion again."""
    with _client(connect) as client:
        client.reset()
        client.resume()
    out.write("Ready again. Nothing moved.\n")
    return EXIT_DONE


def home_remotely(connect: str | None, out: TextIO) -> int:
    """Home and park the arm of a running agent; takes the lease if it is free."""
    with _client(connect) as client:
        client.home()
    out.write("Home.\n")
    return EXIT_DONE


def jog_remotely(connect: str | None, axis: Axis, amount: float, unit: str, out: TextIO) -> int:
    """One step of a running agent's arm: approved here, and by its bridge again.

    ``amount`` in mm (by the configured scale) or degrees. Raises RobotError, Declined.
    """
    with _joined(connect) as (bus, client):
        client.acquire()
        arm = BusArm(bus, client.name)
        for done in arm.run(step(arm.start(), arm.workspace, axis, amount)):
            out.write(f"{axis} {getattr(done.reached, axis):.3f} {unit}\n")
    return EXIT_DONE


VERBS = {
    "pause": "Holds before the next motion. `armchat resume` goes on, `armchat step` a line.\n",
    "resume": "Motion is allowed; what was held goes on.\n",
    "step": "Goes on to the end of a line, and holds there.\n",
}
"""What a program that runs can be told, and what is said once the bridge has taken it."""


def tell_remotely(connect: str | None, verb: str, out: TextIO) -> int:
    """One of `VERBS` to the bridge. Raises Declined naming the owner if that is somebody else."""
    with _client(connect) as client:
        send: Callable[[], RobotReply] = getattr(client, verb)
        send()
    out.write(VERBS[verb])
    return EXIT_DONE

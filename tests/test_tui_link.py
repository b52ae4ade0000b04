"""What the terminal sends, from which thread and in which order."""

from __future__ import annotations

import queue
import threading
from typing import ClassVar

import pytest

from agent.messages import RobotReply
from tui.link import CommandOver, Link

PATIENCE = 10.0
OK = RobotReply(True, 1, "", "")


class SlowClient:
    """Answers ``pause`` and ``home`` when told to, everything else at once; records what came."""

    slow: ClassVar = ("pause", "home")

    def __init__(self):
        self.came = queue.Queue()
        self.answer = {verb: threading.Event() for verb in self.slow}

    def __getattr__(self, verb):
        def send(*_):
            self.came.put(verb)
            if verb in self.answer:
                assert self.answer[verb].wait(PATIENCE)
            return OK

        return send


class Pump:
    """Stands where the application does; keeps what it is told."""

    def __init__(self):
        self.over = queue.Queue()

    def post_message(self, message):
        assert isinstance(message, CommandOver)
        self.over.put(message.verb)
        return True


def test_a_verb_is_sent_when_the_one_before_is_answered():
    client, pump = SlowClient(), Pump()
    link = Link(client, pump)
    for verb in ("pause", "resume", "step"):
        link.command(verb)
    assert client.came.get(timeout=PATIENCE) == "pause"
    with pytest.raises(queue.Empty):
        client.came.get(timeout=0.2)
    client.answer["pause"].set()
    assert [pump.over.get(timeout=PATIENCE) for _ in range(3)] == ["pause", "resume", "step"]


def test_neither_stop_nor_a_verb_waits_for_the_end_of_a_motion_or_another_verb():
    client, pump = SlowClient(), Pump()
    link = Link(client, pump)
    link.command("home")
    link.command("pause")
    link.stop()
    came = {client.came.get(timeout=PATIENCE) for _ in range(3)}
    assert came == {"home", "pause", "stop"}
    assert pump.over.get(timeout=PATIENCE) == "stop"
    for event in client.answer.values():
        event.set()
    assert {pump.over.get(timeout=PATIENCE) for _ in range(2)} == {"home", "pause"}

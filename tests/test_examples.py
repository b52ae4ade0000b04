"""The plain-Zenoh example against a real daemon in a process of its own: question and answer."""

import json
import runpy
import socket
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, nullcontext
from pathlib import Path

import pytest

from agent.client import Client
from agent.config import BusConfig
from agent.daemon import open_bus

pytestmark = pytest.mark.live

ROOT = Path(__file__).parent.parent
EXAMPLE = ROOT / "examples" / "remote_client.py"


def free_endpoint() -> str:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return f"tcp/127.0.0.1:{probe.getsockname()[1]}"


@contextmanager
def daemon(service: str, *options: str) -> Iterator[subprocess.Popen[str]]:
    """A daemon on the ideal table, ready; ended by SIGTERM, which it must obey."""
    process = subprocess.Popen(
        [sys.executable, "-m", "agent.cli", "daemon", service, "--robot", "ideal", *options],
        cwd=ROOT, stderr=subprocess.PIPE, text=True,
        env={"ARMCHAT_ROBOT__PACE": "0", "PATH": "/usr/bin:/bin"},
    )  # fmt: skip
    assert process.stderr is not None
    last = "agent" if service == "all" else service
    for line in process.stderr:
        if f"{last} is ready" in line:
            break
    drain = threading.Thread(target=process.stderr.read, daemon=True)
    drain.start()
    yield process
    process.terminate()
    assert process.wait(timeout=20) == 0


@pytest.fixture(scope="module")
def endpoint() -> Iterator[str]:
    """All services in one process, on a free port of the loopback."""
    where = free_endpoint()
    with daemon("all", "--listen", where):
        yield where


def armchat(*arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "agent.cli", *arguments]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=60)


def test_the_example_imports_nothing_of_ours():
    code = EXAMPLE.read_text(encoding="utf-8")
    assert not any(f"import {name}" in code or f"from {name}" in code
                   for name in ("agent", "scene", "tui", "translator", "clarifier"))  # fmt: skip


def test_a_foreign_client_is_asked_answers_and_follows_to_the_end(endpoint):
    command = [sys.executable, str(EXAMPLE), endpoint, "pick up the fruit", "the red one"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stdout + done.stderr
    events = [json.loads(line) for line in done.stdout.splitlines()]
    turns = [event["turn"] for event in events if event.get("turn")]
    assert [turn["status"] for turn in turns] == ["asked", "done"]
    assert "step" in {event["stage"] for event in events}


def test_say_over_the_bus_answers_and_exits_as_in_process(endpoint):
    assert armchat("say", "what can you see?", "--connect", endpoint).returncode == 0
    assert armchat("say", "put the cup on the guitar", "--connect", endpoint).returncode in (1, 4)


def test_stop_and_reset_from_another_process(endpoint):
    assert armchat("stop", "--connect", endpoint).returncode == 0
    assert armchat("say", "touch the cup", "--connect", endpoint).returncode == 1
    assert armchat("reset", "--connect", endpoint).returncode == 0


def test_only_the_owner_pauses_steps_and_resumes_and_the_refusal_names_it(endpoint):
    for verb in ("pause", "step"):
        refused = armchat(verb, "--connect", endpoint)
        assert (refused.returncode, "no program is running" in refused.stderr) == (1, True)
    with ExitStack() as stack:
        bus = stack.enter_context(open_bus(BusConfig(connect=(endpoint,))))
        owner = Client(bus, "tui-123")
        stack.callback(owner.close)
        owner.acquire()
        for verb in ("pause", "resume", "step"):
            refused = armchat(verb, "--connect", endpoint)
            assert (refused.returncode, "held by tui-123: only it" in refused.stderr) == (1, True)


def test_each_service_runs_in_a_process_of_its_own_and_its_loss_is_said():
    where = free_endpoint()
    with ExitStack() as stack:
        stack.enter_context(daemon("robot", "--listen", where))
        for service in ("scene", "clarifier", "agent"):
            stack.enter_context(daemon(service, "--connect", where))
        with daemon("translator", "--connect", where):
            done = armchat("say", "pick up the apple", "--connect", where)
            assert (done.returncode, "I hold the apple." in done.stdout) == (0, True)
        lost = armchat("say", "touch the cup", "--connect", where)
        assert (lost.returncode, "no translate worker" in lost.stdout) == (1, True)


class Session:
    """A session on which an agent is alive, as far as the example's ``main`` looks at it."""

    def liveliness(self):
        return self

    def get(self, key, timeout):
        return ["alive"]

    def declare_subscriber(self, key, callback):
        self.listens = key


def test_the_example_answers_what_a_failed_turn_asks(monkeypatch):
    example = runpy.run_path(str(EXAMPLE))
    turns = [
        {"status": "failed", "question": {"kind": "confirm", "text": "Shall I try again?"}},
        {"status": "done", "question": None},
    ]
    said = []

    def say(session, events, text):
        said.append(text)
        return turns[len(said) - 1]

    main = example["main"]
    monkeypatch.setitem(main.__globals__, "open_session", lambda endpoint: nullcontext(Session()))
    monkeypatch.setitem(main.__globals__, "Robot", nullcontext)
    monkeypatch.setitem(main.__globals__, "say", say)
    assert main("tcp/nowhere", ["put the apple on the plate", "try again", "thanks"]) == 0
    assert said == ["put the apple on the plate", "try again"]

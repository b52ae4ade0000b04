"""The plain-Zenoh example against a real daemon in a process of its own: question and answer."""

import json
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
EXAMPLE = ROOT / "examples" / "remote_client.py"


@pytest.fixture(scope="module")
def endpoint() -> Iterator[str]:
    """A daemon with all services on a free port of the loopback, ready."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    where = f"tcp/127.0.0.1:{port}"
    daemon = subprocess.Popen(
        [sys.executable, "-m", "agent.cli", "daemon", "all", "--robot", "ideal", "--listen", where],
        cwd=ROOT, stderr=subprocess.PIPE, text=True,
        env={"ARMCHAT_ROBOT__PACE": "0", "PATH": "/usr/bin:/bin"},
    )  # fmt: skip
    assert daemon.stderr is not None
    for line in daemon.stderr:
        if "agent is ready" in line:
            break
    yield where
    daemon.terminate()
    assert daemon.wait(timeout=20) == 0


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

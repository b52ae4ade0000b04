"""The program in a real terminal: chat, question, STOP, leave; and what a kill leaves behind."""

import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator

import pexpect
import pytest

pytestmark = pytest.mark.live

ESCAPES = re.compile(r"\x1b(\[[0-9;?<>=]*[a-zA-Z~]|\][^\x07]*\x07|[()][A-Z0-9]|[=>78])")


@pytest.fixture
def chat(tmp_path) -> Iterator[pexpect.spawn]:
    """`armchat chat` on the ideal table in a terminal of 120 by 40, alone on its bus."""
    env = {**os.environ, "TERM": "xterm-256color", "XDG_STATE_HOME": str(tmp_path)}
    child = pexpect.spawn(
        sys.executable, ["-m", "agent.cli", "chat", "--robot", "ideal"],
        dimensions=(40, 120), env=env, encoding="utf-8", timeout=30,
    )  # fmt: skip
    yield child
    child.close(force=True)


def see(chat: pexpect.spawn, words: str) -> None:
    """Wait until the words were drawn; escapes between them do not count."""
    seen = ""
    deadline = time.monotonic() + 30
    while words not in ESCAPES.sub("", seen):
        assert time.monotonic() < deadline, ESCAPES.sub("", seen)[-2000:]
        try:
            seen += chat.read_nonblocking(4096, timeout=1)
        except pexpect.TIMEOUT:
            continue


def workers_of(pid: int) -> list[int]:
    """Processes whose parent is this one."""
    told = subprocess.run(["ps", "-o", "pid=", "--ppid", str(pid)], capture_output=True, text=True)
    return [int(line) for line in told.stdout.split()]


def gone(pid: int) -> bool:
    told = subprocess.run(["ps", "-o", "stat=", "-p", str(pid)], capture_output=True, text=True)
    return told.stdout.strip() in ("", "Z", "Zs")


def test_a_person_chats_is_asked_stops_and_leaves(chat):
    see(chat, "Say what to do")
    chat.send("pick up the fruit\r")
    see(chat, "Which fruit do you mean")
    chat.send("1")
    see(chat, "I hold the apple")
    chat.send("\x1b[19~")  # F8
    see(chat, "STOP acknowledged")
    chat.send("/quit\r")
    chat.expect(pexpect.EOF)
    chat.wait()
    assert chat.exitstatus == 0
    assert "Which fruit do you mean" in ESCAPES.sub("", chat.before)


def test_killing_the_chat_leaves_nothing_running(chat):
    see(chat, "Say what to do")
    chat.send("what can you see?\r")
    see(chat, "I can see")
    workers = workers_of(chat.pid)
    assert workers
    os.kill(chat.pid, signal.SIGKILL)
    deadline = time.monotonic() + 10
    while not all(map(gone, workers)):
        assert time.monotonic() < deadline, "a worker outlived the chat"
        time.sleep(0.05)

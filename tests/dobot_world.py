"""Emulated Dobots for tests: ours opened on one, and stock pydobot in a process that is watched."""

from __future__ import annotations

import subprocess
import sys
import time
from contextlib import contextmanager

from agent.config import DobotConfig
from robot_bridge.dobot import DobotLink
from robot_bridge.dobot_guard import bounds
from robot_bridge.emulator import Emulator
from robot_bridge.faults import Faults

BOUNDS = bounds(DobotConfig(speed=300.0))
PATIENCE = 10.0
STOCK = """\
import struct, sys, threading, time
import pydobot
port = sys.argv[1]
def made():
    return pydobot.Dobot(port)
"""


def stock(emulator: Emulator, code: str, patience: float = PATIENCE) -> tuple[str, str]:
    """How stock pydobot fares: "ok", "hang" or "error", and what it printed."""
    command = [sys.executable, "-c", STOCK + code, emulator.port]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=patience)
    except subprocess.TimeoutExpired as error:
        return "hang", (error.stdout or b"").decode()
    return ("error" if done.returncode else "ok"), done.stdout + done.stderr


@contextmanager
def linked(faults: Faults | None = None, pace: float = 40.0, **more):
    """An emulator and our line to it."""
    with Emulator(faults, pace) as emulator:
        link = DobotLink(emulator.port, BOUNDS, **more)
        link.open()
        try:
            yield emulator, link
        finally:
            link.close()


def until(ready, patience: float = PATIENCE) -> None:
    """Wait until something is so, looking again and again."""
    end = time.monotonic() + patience
    while not ready():
        assert time.monotonic() < end, "it never came to pass"
        time.sleep(0.002)

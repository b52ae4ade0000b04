"""A Dobot Magician on a pseudo-terminal: what opens its port cannot tell it from an arm's.

One thread serves the port and lets the emulated clock run, ``speed`` times as fast as real time.
There are no modem lines. Both ends are raw, and a slave end stays open here, so that a client can
leave and come back; closing both is the unplugging of the cable.
"""

from __future__ import annotations

import contextlib
import os
import select
import threading
import time
import tty
from collections import deque
from pathlib import Path
from typing import Self

from robot_bridge.dobot_frames import QUEUED, Frame, Reader, encode
from robot_bridge.emulated import REMEMBERED, Controller
from robot_bridge.faults import Faults

TICK = 0.005
"""Longest wait for a request while the arm moves, so that what happens on the way does (s)."""
IDLE = 0.05
BYTE_S = 10 / 115200
STALE = (Frame(246, 0, bytes(8)), Frame(84, 3, (7).to_bytes(8, "little")))
"""What an earlier program left unread."""
GARBAGE = bytes((0x00, 0xAA, 0x13, 0xAA, 0xAA, 0x40, 0x0A, 0xFF))


class Emulator:
    """The port and its thread; a context manager. ``port`` is the path to open.

    ``link``: a path that points to the port, also after it was plugged in again. All of the
    controller that is read or changed from outside is, with ``lock`` held.
    """

    def __init__(
        self, faults: Faults | None = None, speed: float = 1.0, link: Path | None = None
    ) -> None:
        self.faults = faults or Faults()
        self.speed = speed
        self.lock = threading.RLock()
        self.controller = Controller(self.faults, self.now())
        self.port = ""
        self.arrived: deque[tuple[float, int]] = deque(maxlen=REMEMBERED)
        self._link = link
        self._master = self._slave = -1
        self._reader = Reader()
        self._over = threading.Event()
        self._asked, self._cut_off = threading.Event(), threading.Event()
        self._woken, self._waker = os.pipe()
        self._thread: threading.Thread | None = None

    @property
    def plugged(self) -> bool:
        """Whether there is a port."""
        return self._master >= 0

    def now(self) -> float:
        """Seconds of the emulated clock."""
        return time.monotonic() * self.speed

    def __enter__(self) -> Self:
        self.start()
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def start(self) -> None:
        """Make the port and serve it. Raises OSError where no pseudo-terminal can be had."""
        self.plug()
        self._thread = threading.Thread(target=self._serve, name="emulator", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """End the thread and take the port away."""
        self._over.set()
        os.write(self._waker, b"!")
        if self._thread is not None:
            self._thread.join()
        self._cut()
        os.close(self._woken)
        os.close(self._waker)

    def plug(self) -> None:
        """Make a port, perhaps of another name than the last."""
        with self.lock:
            self._master, self._slave = os.openpty()
            tty.setraw(self._slave)
            os.set_blocking(self._master, False)
            self.port = os.ttyname(self._slave)
            self._reader.clear()
            if self.faults.stale:
                self._send(b"".join(map(encode, STALE)))
            if self._link is not None:
                self._link.unlink(missing_ok=True)
                self._link.symlink_to(self.port)

    def unplug(self) -> None:
        """Cut the line; the arm goes on. Waits for the thread that serves it: hold no lock."""
        self._cut_off.clear()
        self._asked.set()
        os.write(self._waker, b"!")
        self._cut_off.wait()

    def _cut(self) -> None:
        with self.lock:
            for end in {self._master, self._slave} - {-1}:
                os.close(end)
            self._master = self._slave = -1
            if self._link is not None:
                self._link.unlink(missing_ok=True)

    # --- the thread -----------------------------------------------------------------------------

    def _serve(self) -> None:
        while not self._over.is_set():
            with self.lock:
                master, moving = self._master, self.controller.moving
            ends = [self._woken] if master < 0 else [self._woken, master]
            ready, _, _ = select.select(ends, [], [], TICK if moving else IDLE)
            if self._woken in ready:
                os.read(self._woken, 64)
            if master in ready:
                self._take(master)
            if self._asked.is_set():
                self._asked.clear()
                self._cut()
                self._cut_off.set()
            self._advance()

    def _advance(self) -> None:
        with self.lock:
            self.controller.advance(self.now())
            if self.controller.unplug:
                self.controller.unplug = False
                self._cut()

    def _take(self, master: int) -> None:
        try:
            data = os.read(master, 4096)
        except OSError:  # it was unplugged meanwhile, or nobody has the port open
            return
        if self.faults.line_time:
            self._over.wait(len(data) * BYTE_S)
        if data and self.faults.hit("lost_byte"):
            data = data[: len(data) // 2] + data[len(data) // 2 + 1 :]
        for frame in self._reader.feed(data):
            self._answer(frame)

    def _answer(self, frame: Frame) -> None:
        with self.lock:
            self.arrived.append((time.monotonic(), frame.id))
            reply = self.controller.receive(frame, self.now())
        if reply is not None and not (frame.ctrl == QUEUED and self.faults.hit("lost_reply")):
            self._reply(reply)

    def _reply(self, reply: Frame) -> None:
        faults, data = self.faults, encode(reply)
        if faults.line_time:
            self._over.wait(len(data) * BYTE_S)
        if faults.hit("late"):
            self._over.wait(faults.delay)
        if faults.hit("dropped"):
            return
        if faults.hit("bad_sum"):
            data = data[:-1] + bytes((data[-1] ^ 0x55,))
        if faults.hit("cut"):
            data = data[: len(data) // 2]
        if faults.hit("garbage"):
            data = GARBAGE + data
        if faults.hit("split"):
            self._send(data[:4])
            self._over.wait(0.03)
            data = data[4:]
        self._send(data)

    def _send(self, data: bytes) -> None:
        """Bytes for whoever has the port open; lost where nobody reads them, or it is unplugged."""
        with self.lock, contextlib.suppress(OSError):
            if self._master >= 0:
                os.write(self._master, data)

"""The line to a Dobot Magician: pydobot, hardened. The only file that imports pydobot.

pydobot 1.3.2 miscounts checksums, reads whatever bytes lie there as a reply, waits without end and
opens the port so that the arm may reset (docs/dobot.md lists eleven such defects). This
subclass keeps its commands and replaces what carries them: own frames, replies that must match in
sum, length and id, deadlines, reads repeated, queued commands never. Millimetres and degrees.

It moves nothing by itself and holds every frame that it sends against the arm's reach and speed
(`robot_bridge.dobot_guard`); plans come from `robot_bridge.dobot_arm`.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import pydobot
import serial
from pydobot.enums import PTPMode
from pydobot.message import Message

from agent.errors import LinkDown, NoReply, NotReady
from robot_bridge import dobot_alarms, dobot_frames
from robot_bridge.dobot_cell import Millimetres
from robot_bridge.dobot_frames import QUEUED, READ, WRITE, Frame, Reader, floats, read_floats
from robot_bridge.dobot_guard import Bounds, admit

REPLY_S = 0.4
"""Seconds until a command counts as not answered."""
TRIES = 3
"""How often a read, or a setting that can be made twice, is tried."""
SLICE_S = 0.05
"""Longest single wait for bytes."""
QUIET_S = 0.3
"""Longest wait for late replies to end, after one did not come in time."""
ROOM_TRIES, ROOM_S = 40, 0.05
"""How often, and how far apart, a full queue is looked at before it counts as staying full."""
PAUSE_MS = 300
"""How long suction is given to take hold, and to let go, before the next motion."""
LOST = "connection lost, motion state unknown"


class DobotLink(pydobot.Dobot):  # type: ignore[misc] # pydobot has no types
    """One Dobot on one port. Thread-safe: one exchange at a time, `urgent` at any.

    ``limits``: what every frame is held against. ``make`` is `serial.Serial`, or what stands in
    for it. Methods raise NoReply, LinkDown.
    """

    def __init__(  # pydobot's own opens the port, with its lines high, and sends seven commands
        self, port: str, limits: Bounds, make: Callable[[], serial.Serial] = serial.Serial
    ) -> None:
        self.port = port
        self.verbose = False
        self.lock = threading.Lock()
        self.ser: serial.Serial | None = None
        self._limits = limits
        self._make = make
        self._writing = threading.Lock()
        self._reader = Reader()
        self._late = self._closing = False
        self._issued: int | None = None

    @property
    def is_open(self) -> bool:
        """Whether there is a line to the arm."""
        return self.ser is not None

    # --- the port -------------------------------------------------------------------------------

    def open(self) -> None:
        """Open the port for this process alone, DTR and RTS low; sends nothing. Raises LinkDown."""
        line = self._make()
        line.port, line.baudrate = self.port, 115200
        line.timeout, line.write_timeout = SLICE_S, REPLY_S
        line.dtr = line.rts = False
        line.exclusive = True
        try:
            line.open()
        except (OSError, serial.SerialException) as error:
            raise LinkDown(f"cannot open {self.port}: {_why(error)}") from error
        with self.lock:
            self._reader.clear()
            self._late, self._closing, self._issued = True, False, None
            self.ser = line

    def close(self) -> None:
        """Let go of the port; whoever waits for a reply is told that the link is down."""
        self._closing = True
        line = self.ser
        if line is None:
            return
        with _lost_line_is_no_error():
            line.cancel_read()
        held = self.lock.acquire(timeout=SLICE_S)
        try:
            self.ser = None
            with _lost_line_is_no_error():
                line.close()
        finally:
            if held:
                self.lock.release()

    @contextmanager
    def _line(self) -> Iterator[serial.Serial]:
        """The open port; what goes wrong with it means that the link is down."""
        line = self.ser
        if line is None or self._closing:
            raise LinkDown(LOST)
        try:
            yield line
        except (OSError, TypeError) as error:
            # TypeError: pyserial's answer to a port that another thread has closed
            self.ser = None
            with _lost_line_is_no_error():
                line.close()
            raise LinkDown(f"{LOST} ({self.port}: {error})") from error

    # --- one exchange ---------------------------------------------------------------------------

    def _exchange(self, frame: Frame, fits: Callable[[Frame], bool]) -> Frame | None:
        """Send once; the reply that echoes the command and fits, None if none came in time."""
        with self.lock:
            self._drain()
            self._write(frame)
            until = time.monotonic() + REPLY_S
            while time.monotonic() < until:
                for reply in self._read():
                    if reply[:2] == frame[:2] and fits(reply):
                        return reply
            self._late = True
            return None

    def _write(self, frame: Frame) -> None:
        admit(frame, self._limits)
        with self._writing, self._line() as line:
            line.write(dobot_frames.encode(frame))

    def _read(self) -> list[Frame]:
        with self._line() as line:
            data = line.read(max(1, line.in_waiting))
        return self._reader.feed(data)

    def _drain(self) -> None:
        """Drop what lies there; after a reply that did not come, wait until nothing does."""
        until = time.monotonic() + QUIET_S
        with self._line() as line:
            while (line.in_waiting or self._late) and time.monotonic() < until:
                if not line.read(max(1, line.in_waiting)):
                    self._late = False
        self._late = False
        self._reader.clear()

    def query(self, command: int, size: int, params: bytes = b"") -> bytes:
        """Read: tried three times; at least ``size`` bytes of parameters. Raises NoReply."""
        return self._repeated(Frame(command, READ, params), lambda reply: len(reply.params) >= size)

    def set(self, command: int, params: bytes = b"") -> None:
        """Write and act at once: settings, which can be made twice. Raises NoReply."""
        self._repeated(Frame(command, WRITE, params), lambda reply: True)

    def _repeated(self, frame: Frame, fits: Callable[[Frame], bool]) -> bytes:
        for _ in range(TRIES):
            reply = self._exchange(frame, fits)
            if reply is not None:
                return reply.params
        raise NoReply(f"the arm did not answer command {frame.id}, asked {TRIES} times")

    def queue(self, command: int, params: bytes) -> int:
        """Put a command into the queue, once, where it has room; its number there.

        Raises NotReady where the queue stays full, NoReply where the outcome is unknown.
        """
        self._make_room()
        reply = self._exchange(Frame(command, QUEUED, params), self._is_next)
        if reply is None:
            raise NoReply(f"command {command} was sent and not answered: outcome unknown")
        self._issued = int.from_bytes(reply.params, "little")
        return self._issued

    def _is_next(self, reply: Frame) -> bool:
        """Whether a reply carries a number that the queue has not given before."""
        number = int.from_bytes(reply.params, "little")
        return len(reply.params) in (4, 8) and (self._issued is None or number > self._issued)

    def _make_room(self) -> None:
        for _ in range(ROOM_TRIES):
            if int.from_bytes(self.query(dobot_frames.LEFT_SPACE, 4)[:8], "little"):
                return
            time.sleep(ROOM_S)
        raise NotReady("the arm's queue stays full: reset clears it")

    def urgent(self, command: int, params: bytes = b"") -> None:
        """Send at once, whoever waits for a reply, and wait for none: to stop. Raises LinkDown."""
        self._write(Frame(command, WRITE, params))

    def _send_command(self, msg: Message, wait: bool = False) -> Message:
        """Carries every command of pydobot's own; to wait is the business of who knows how long."""
        if wait:
            raise NotReady("this link waits for no motion: run a plan")
        msg.refresh()
        frame, params = (int(msg.id), int(msg.ctrl)), bytes(msg.params)
        if frame[1] == QUEUED:
            return _message(*frame, self.queue(frame[0], params).to_bytes(8, "little"))
        if frame[1] == READ:
            return _message(*frame, self.query(frame[0], 1, params))
        self.set(frame[0], params)
        return _message(*frame, b"")

    # --- what the arm says ----------------------------------------------------------------------

    def firmware(self) -> str:
        """Version of the firmware, as "3.7.0"."""
        return ".".join(str(number) for number in self.query(dobot_frames.VERSION, 3)[:3])

    def alarms(self) -> tuple[int, ...]:
        """The codes of the alarms that are set."""
        mask = self.query(dobot_frames.ALARMS, dobot_alarms.MASK_BYTES)
        return dobot_alarms.codes(mask[: dobot_alarms.MASK_BYTES])

    def finished(self) -> int:
        """The number of the queued command that ended last, as the controller tells it: it may be
        stale, or no number at all while the arm moves."""
        return int.from_bytes(self.query(dobot_frames.INDEX, 4)[:8], "little")

    def pose(self) -> Millimetres:
        """Where the tool is, measured."""
        return Millimetres(*read_floats(self.query(dobot_frames.POSE, 32))[:4])

    # --- what it is told ------------------------------------------------------------------------

    def clear(self) -> None:
        """Empty the queue; its numbers may begin anew."""
        self.set(dobot_frames.CLEAR)
        self._issued = None

    def speed(self, velocity: float = 100.0, acceleration: float = 100.0) -> None:
        """Speed (mm/s and degrees/s) and acceleration of straight motions; ratios stay at 100 %.

        Raises NotReady above the fastest that is allowed.
        """
        told = floats(velocity, velocity, acceleration, acceleration)
        self.set(dobot_frames.PTP_COORDINATE, told)
        self.set(dobot_frames.PTP_COMMON, floats(100, 100))

    def line_to(self, at: Millimetres) -> int:
        """Queue a straight motion; its number. Raises Unreachable before it is sent."""
        reply = self._set_ptp_cmd(*at, PTPMode.MOVL_XYZ, False)
        return int.from_bytes(reply.params, "little")

    def suck(self, enable: bool) -> int:
        """Queue suction on, or off with the pump really off; the number of the last command."""
        self._set_end_effector_suction_cup(enable)
        reply = self._set_wait_cmd(PAUSE_MS)
        if not enable:
            reply = _message(0, 0, self.queue(dobot_frames.SUCTION, bytes(2)).to_bytes(8, "little"))
        return int.from_bytes(reply.params, "little")

    def move_to(self, x: float, y: float, z: float, r: float, wait: bool = False) -> None:
        """Not here: a motion is part of a plan that passed the check. Raises NotReady."""
        raise NotReady("a motion passes robot_bridge.api.approve: run a plan")

    def go(self, x: float, y: float, z: float, r: float = 0.0) -> None:
        """Not here either. Raises NotReady."""
        self.move_to(x, y, z, r)

    def grip(self, enable: bool) -> None:
        """There is no gripper here. Raises NotReady."""
        raise NotReady("this arm holds by suction")


@contextmanager
def _lost_line_is_no_error() -> Iterator[None]:
    """For who lets go of a port that may be gone already."""
    try:
        yield
    except (OSError, TypeError):
        return


def _message(command: int, ctrl: int, params: bytes) -> Message:
    """A reply as pydobot's own methods read it."""
    return Message(dobot_frames.encode(Frame(command, ctrl, params)))


def _why(error: Exception) -> str:
    """What to do about a port that does not open."""
    text, number = str(error), getattr(error, "errno", None)
    if number == 2 or "No such file" in text:
        return "there is no such port; `armchat ports` lists them"
    if number == 13 or "Permission" in text:
        return "no permission; join its group (`armchat ports` says how), then log in again"
    if "exclusively lock" in text:
        return "another program has it; close that, or use the agent that runs (--connect)"
    return text

"""The controller of an emulated Dobot Magician: what it keeps, queues and does (no thread).

It follows the vendor's protocol as far as docs/dobot.md lists it, with that page's
doubts as switches (`robot_bridge.faults`). The clock is passed in, so that time can be sped up.
Unknown commands, 21 among them, are not answered.
"""

from __future__ import annotations

import struct
from collections import deque
from typing import NamedTuple

from robot_bridge import dobot_alarms, dobot_frames
from robot_bridge.dobot_cell import Fault, Millimetres, joints_at
from robot_bridge.dobot_frames import QUEUED, READ, Frame, floats, read_floats
from robot_bridge.emulated_motion import LINEAR_MODES, Travel, goal_of, plan
from robot_bridge.faults import Faults

SWITCHED_ON = Millimetres(210.0, 30.0, 40.0, 0.0)
"""Where the arm stands when it is switched on, and its counts are not what they should be."""
HOMING_S = 20.0
"""Seconds that homing takes."""
VERSION = bytes((3, 7, 0))
NAME = b"Dobot Magician (emulated)"
JOINT_SPEED = 200.0
REMEMBERED = 100_000
"""How many of the last commands and motions it remembers."""
JOG_WAY = 60.0
"""How far a jog goes that nobody ends (mm)."""

_SETTINGS: dict[int, bytes] = {
    dobot_frames.SERIAL_NUMBER: b"EMULATED",
    dobot_frames.NAME: NAME,
    dobot_frames.HOME_PARAMS: floats(250, 0, 50, 0),
    dobot_frames.TOOL: floats(61, 0, 0),
    dobot_frames.LASER: bytes(2), dobot_frames.SUCTION: bytes(2), dobot_frames.GRIPPER: bytes(2),
    dobot_frames.JOG_JOINT: floats(*[15] * 4, *[50] * 4),
    dobot_frames.JOG_COORDINATE: floats(*[60] * 4, *[60] * 4),
    dobot_frames.JOG_COMMON: floats(50, 50),
    dobot_frames.PTP_JOINT: floats(*[200] * 8),
    dobot_frames.PTP_COORDINATE: floats(200, 200, 200, 200),
    dobot_frames.PTP_JUMP: floats(20, 100),
    dobot_frames.PTP_COMMON: floats(50, 50),
    dobot_frames.CP_PARAMS: floats(100, 100, 100) + bytes(1),
}  # fmt: skip
"""What can be set and read, as it is when the arm is switched on."""


class Work(NamedTuple):
    """A queued command that is being done: its number, when it began and how long it takes."""

    number: int
    frame: Frame
    began: float
    seconds: float
    travel: Travel | None = None


class Made(NamedTuple):
    """A motion that was begun: its number, command, target and whether it came to its end."""

    number: int
    id: int
    goal: Millimetres
    whole: bool


class Controller:
    """The arm's controller. Not thread-safe; times are seconds of the emulated clock."""

    def __init__(self, faults: Faults, now: float) -> None:
        self.faults = faults
        self.made: deque[Made] = deque(maxlen=REMEMBERED)
        self.seen: deque[Frame] = deque(maxlen=REMEMBERED)
        self.unplug = False
        self.force_stops = 0
        self.switch_on(now)

    def switch_on(self, now: float) -> None:
        """Everything as it is after power-on."""
        self._now = now
        self.settings = dict(_SETTINGS)
        self.io: dict[int, int] = {}
        self.pose = SWITCHED_ON
        self.alarms: set[int] = set()
        self.homed = False
        self.running = True
        self._queue: deque[tuple[int, Frame]] = deque()
        self._work: Work | None = None
        self._next = self.faults.first
        self._done = 0

    @property
    def tool(self) -> float:
        """From the wrist's axis to the tool's (mm), as it was set."""
        return read_floats(self.settings[dobot_frames.TOOL])[0]

    @property
    def pump(self) -> bool:
        """Whether the pump runs."""
        return bool(self.settings[dobot_frames.SUCTION][0])

    @property
    def moving(self) -> bool:
        """Whether something is being done."""
        return self._work is not None

    # --- commands -------------------------------------------------------------------------------

    def receive(self, frame: Frame, now: float) -> Frame | None:
        """Obey a command; the reply, None where there is none."""
        self.advance(now)
        self.seen.append(frame)
        params: bytes | None
        if frame.ctrl == READ:
            params = self._told(frame)
        elif frame.ctrl == QUEUED:
            params = self._queued(frame)
        else:
            params = self._at_once(frame)
        self.advance(now)
        return None if params is None else Frame(frame.id, frame.ctrl, params)

    def _told(self, frame: Frame) -> bytes | None:
        if frame.id in self.settings:
            return self.settings[frame.id]
        if frame.id == dobot_frames.VERSION:
            return VERSION
        if frame.id == dobot_frames.POSE:
            return floats(*self.pose, *self._joints())
        if frame.id == dobot_frames.ALARMS:
            return dobot_alarms.mask(self.alarms)
        if frame.id == dobot_frames.INDEX:
            return self._finished()
        if frame.id == dobot_frames.LEFT_SPACE:
            left = max(0, self.faults.capacity - len(self._queue))
            return left.to_bytes(self.faults.left, "little")
        if frame.id == dobot_frames.IO and frame.params:
            return bytes((frame.params[0], self.io.get(frame.params[0], 0)))
        return None

    def _finished(self) -> bytes:
        if self.moving and self.faults.busy == "ones":
            return b"\xff" * 8
        low = self.moving and self.faults.busy == "low" and self._done > 0
        return struct.pack("<Q", self._done - low)

    def _joints(self) -> tuple[float, ...]:
        found = joints_at(self.pose, self.tool)
        if isinstance(found, Fault):
            return (0.0, 0.0, 0.0, 0.0)
        return tuple(57.29577951308232 * joint for joint in found)

    def _queued(self, frame: Frame) -> bytes | None:
        also = (*dobot_frames.MOTIONS, dobot_frames.WAIT, dobot_frames.IO)
        if frame.id not in self.settings and frame.id not in also:
            return None
        number = self._next
        if len(self._queue) < self.faults.capacity:
            self._next += 1
            self._queue.append((number, frame))
        return struct.pack("<Q", number)

    def _at_once(self, frame: Frame) -> bytes | None:
        if frame.id in self.settings:
            self.settings[frame.id] = frame.params
        elif frame.id == dobot_frames.ALARMS:
            self.alarms = self.alarms if self.faults.reassert else set()
        elif frame.id in (dobot_frames.START, dobot_frames.STOP):
            self.running = frame.id == dobot_frames.START
        elif frame.id == dobot_frames.FORCE_STOP:
            self._force_stop()
        elif frame.id == dobot_frames.CLEAR:
            self._queue.clear()
            if self.faults.zeroed:
                self._next, self._done = self.faults.first, 0
        elif frame.id == dobot_frames.IO and len(frame.params) == 2:
            self.io[frame.params[0]] = frame.params[1]
        elif frame.id in dobot_frames.MOTIONS:
            self._queue.appendleft((self._next, frame))
            self._next += 1
        else:
            return None
        return b""

    def _force_stop(self) -> None:
        """Halt where it is: what was being done is over and does not count as done."""
        self.running, self.force_stops = False, self.force_stops + 1
        if self._work is not None and self._work.travel is not None:
            self.made.append(self._record(self._work, whole=False))
        self._work = None

    # --- the queue ------------------------------------------------------------------------------

    def advance(self, now: float) -> None:
        """Do what there is to do up to this time."""
        while True:
            work = self._work
            if work is None:
                if not self._begin():
                    break
                continue
            end = work.began + work.seconds
            if now < end or (self.faults.frozen and work.travel is not None):
                self._go_on(work, now)
                break
            self._end(work)
            self._now = max(self._now, end)
        self._now = max(self._now, now)

    def _begin(self) -> bool:
        """Take the next command of the queue; whether there was one to do."""
        held = self.alarms and self.faults.under_alarm == "holds"
        if not self._queue or not self.running or held:
            return False
        number, frame = self._queue.popleft()
        self._work = Work(number, frame, self._now, 0.0)
        if frame.id in dobot_frames.MOTIONS:
            travel = self._planned(frame)
            homing = HOMING_S if frame.id == dobot_frames.HOME else 0.0
            skipped = bool(self.alarms) and frame.id != dobot_frames.HOME
            if skipped:
                travel = travel._replace(goal=travel.start, until=0.0, alarm=0)
            seconds = 0.0 if travel.until <= 0 else travel.seconds + homing
            self._work = self._work._replace(seconds=seconds, travel=travel)
        elif frame.id == dobot_frames.WAIT:
            (ms,) = struct.unpack("<I", frame.params)
            self._work = self._work._replace(seconds=ms / 1000)
        return True

    def _planned(self, frame: Frame) -> Travel:
        here, tool = self.pose, self.tool
        if frame.id == dobot_frames.HOME:
            goal = Millimetres(*read_floats(self.settings[dobot_frames.HOME_PARAMS])[:4])
            return Travel(here, goal, False, JOINT_SPEED, JOINT_SPEED, tool)
        if frame.id == dobot_frames.JOG:
            return self._jogged(frame)
        mode, values = frame.params[0], read_floats(frame.params[1:17])
        if frame.id == dobot_frames.CP:
            mode, values = 2, (*read_floats(frame.params[1:13]), here.r)
        speed, _, acceleration, _ = read_floats(self.settings[dobot_frames.PTP_COORDINATE])
        ratio = read_floats(self.settings[dobot_frames.PTP_COMMON])[0] / 100
        if mode not in LINEAR_MODES:
            speed = acceleration = JOINT_SPEED
        goal = goal_of(mode, values, here, tool)
        pace = max(1e-3, speed * ratio * self.faults.slow)
        return self._broken_off(plan(here, goal, mode, pace, max(1.0, acceleration), tool))

    def _jogged(self, frame: Frame) -> Travel:
        axis, way = (frame.params[1] - 1) // 2, JOG_WAY if frame.params[1] % 2 else -JOG_WAY
        values = [way if number == axis else 0.0 for number in range(4)]
        goal = goal_of(7, tuple(values), self.pose, self.tool)
        return plan(self.pose, goal, 2, 50.0, 60.0, self.tool)

    def _broken_off(self, travel: Travel) -> Travel:
        """The next motion ends early where a fault says so."""
        share = self.faults.alarm_at
        if share is None or travel.alarm:
            return travel
        self.faults.alarm_at = None
        return travel._replace(until=share, alarm=self.faults.alarm)

    def _go_on(self, work: Work, now: float) -> None:
        travel = work.travel
        if travel is None or self.faults.frozen:
            return
        self.pose = travel.at(now - work.began)
        share = travel.start.apart(self.pose) / travel.way
        if self.faults.unplug_at is not None and share >= self.faults.unplug_at:
            self.unplug, self.faults.unplug_at = True, None
        if self.faults.power_at is not None and share >= self.faults.power_at:
            self.faults.power_at = None
            self.made.append(self._record(work, whole=False))
            stood = self.pose
            self.switch_on(now)
            self.pose = stood

    def _end(self, work: Work) -> None:
        self._work, self._done = None, work.number
        travel = work.travel
        if travel is None:
            if work.frame.id in self.settings:
                self.settings[work.frame.id] = work.frame.params
            elif work.frame.id == dobot_frames.IO:
                self.io[work.frame.params[0]] = work.frame.params[1]
            return
        self.pose = travel.part(travel.until)
        if travel.alarm:
            self.alarms.add(travel.alarm)
        self.homed |= work.frame.id == dobot_frames.HOME
        if travel.until > 0:
            self.made.append(self._record(work, whole=travel.until >= 1))

    def _record(self, work: Work, *, whole: bool) -> Made:
        assert work.travel is not None
        return Made(work.number, work.frame.id, work.travel.goal, whole)

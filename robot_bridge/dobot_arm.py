"""A Dobot Magician as a Robot (`robot_bridge.api`): plans in, measured poses out.

One motion is in the controller's queue at a time, so that a stop, an alarm or a lost line leaves
nothing behind that could go on by itself. Each is over when its number is told and the arm rests
within 1 mm of its target (`robot_bridge.dobot_watch`). Whatever ends a plan early, the queue is
emptied and the arm halted. Source: docs/dobot.md.
"""

from __future__ import annotations

import contextlib
import struct
import threading
import time
from collections.abc import Callable, Iterator, Sequence

import serial

from agent.config import DobotConfig
from agent.errors import (
    AlarmError,
    LinkDown,
    MoveTimeout,
    NoReply,
    NotReady,
    RobotError,
    Stopped,
    Unreachable,
)
from agent.messages import Command, KeepOut, StepReport, Waypoint
from robot_bridge import dobot_alarms, dobot_frames, dobot_start
from robot_bridge.api import PARK, ApprovedPlan, Limits, approve, waypoint
from robot_bridge.belief import Belief
from robot_bridge.dobot import LOST, DobotLink
from robot_bridge.dobot_cell import Cell, Millimetres
from robot_bridge.dobot_guard import bounds
from robot_bridge.dobot_watch import STALL_S, STILL, Watch
from robot_bridge.motion import length
from robot_bridge.simulated import AT_START
from scene.types import Pose, Scene

POLL_S = 0.02
"""Seconds between two looks at a motion."""
CLEAR_S = 0.2
"""Seconds after which alarms that were cleared are looked at again."""
GRACE_S = 0.25
"""Seconds in which a stopped motion may end by itself before it is broken off."""
REST_S = 1.0
"""Longest wait for a halted arm to rest."""
HOMING_S, HOMING_STALL_S = 60.0, 40.0
SYNC_S, GRIP_S = 2.0, 5.0
"""Seconds in which the queue must run at all, and suction be switched."""
LOOSE, EXTRA_S = 2.0, 5.0
"""A motion may take so many times as long as it should, and so much longer."""


class DobotRobot:
    """The real arm. Thread-safe; opens its port on the first `reset`, not on construction.

    ``scene`` is what stands on the table (`robot_bridge.belief`). ``pace``: how many times faster
    than real its clock goes, for an emulator of the same pace. ``make`` makes the serial port.
    """

    def __init__(
        self, config: DobotConfig | None = None, keep_outs: Sequence[KeepOut] = (),
        scene: Scene | None = None, *, pace: float = 1.0,
        make: Callable[[], serial.Serial] = serial.Serial,
    ) -> None:  # fmt: skip
        self._config = config or DobotConfig()
        self._cell = Cell(self._config, keep_outs)
        self._link = DobotLink(self._config.port or "", bounds(self._config), make)
        self._pace = pace
        self._lock = threading.Lock()
        self._halt = threading.Event()
        self._at_once = self._busy = self._closed = self._suction = self._moved = False
        self._trouble = "the port is not open: reset it first"
        self._belief = Belief(self._cell.at_scale(scene or Scene()), PARK)

    # --- where it is, and can go ----------------------------------------------------------------

    @property
    def limits(self) -> Limits:
        """The workspace, fixed for the robot's life."""
        return self._cell.limits

    def reach(self, pose: Pose) -> str | None:
        """None if the arm can be there, else why not."""
        return self._cell.reach(pose)

    def pose(self) -> Pose:
        """Where the tool's tip is, measured. Raises NoReply, LinkDown."""
        return self._cell.pose(self._link.pose())

    @property
    def scale(self) -> float:
        """Millimetres in a table unit."""
        return self._config.scale

    def reading(self) -> Millimetres:
        """The same as the arm itself has it. Raises NoReply, LinkDown."""
        return self._link.pose()

    def scene(self) -> Scene:
        """The table as it ought to be: nothing sees it."""
        return self._belief.scene()

    def load(self, scene: Scene) -> None:
        """This is on the table now. Moves nothing. Raises NotReady while suction is on, or busy."""
        tip = self.pose()
        with self._lock:
            if self._busy or self._suction:
                raise NotReady("another plan is running" if self._busy else "let go first")
            self._belief = Belief(self._cell.at_scale(scene), tip)

    # --- plans ----------------------------------------------------------------------------------

    def run(self, plan: ApprovedPlan) -> Iterator[StepReport]:
        """Run the plan, one report a primitive. Raises NotReady and Unreachable at once.

        On the way it raises Stopped, AlarmError, MoveTimeout, NotAtTarget, NoReply, LinkDown.
        """
        if not isinstance(plan, ApprovedPlan):
            raise TypeError("a robot runs an ApprovedPlan and nothing else")
        self._idle()
        here = self._reachable(plan)
        self._ready()
        self._at_start(plan)
        return self._run(here)

    def _at_start(self, plan: ApprovedPlan) -> None:
        if length(self.pose(), plan.start) > AT_START:
            raise NotReady("the arm is not where the plan begins: plan again")

    def _idle(self) -> None:
        """Raises NotReady where no motion may begin, whatever the arm says."""
        if self._closed:
            raise NotReady("the robot is closed")
        if self._halt.is_set():
            raise NotReady("stopped: reset it first")
        if self._busy:
            raise NotReady("another plan is running")
        if self._trouble:
            raise NotReady(self._trouble)

    def _reachable(self, plan: ApprovedPlan) -> ApprovedPlan:
        """The plan as this arm's own limits have it: it may have been approved for another."""
        here = approve(plan.told, plan.start, self, plan.program, plan.scene)
        if here.told != plan.told:
            raise Unreachable("the plan was approved for another arm")
        return here

    def _ready(self) -> None:
        """Raises NotReady where the arm itself cannot begin."""
        codes = self._link.alarms()
        if codes:
            what, remedy = dobot_alarms.describe(codes), dobot_alarms.remedy(codes)
            raise NotReady(f"{what}: {remedy}")
        if not dobot_start.is_homed(self._link):
            raise NotReady(
                "the arm is not homed since it was switched on: `armchat home`, or /home"
            )

    def _run(self, plan: ApprovedPlan) -> Iterator[StepReport]:
        count = len(plan.told)
        self._claim()
        over = False
        try:
            self._synchronise()
            self._at_start(plan)  # what an earlier program left moving has ended by now
            self._belief.begins(plan.start)
            steps = zip(plan.told, plan.durations, strict=True)
            for index, (command, seconds) in enumerate(steps):
                reached = self._step(command, seconds)
                self._belief.follows(command, reached)
                at = Waypoint(reached.x, reached.y, reached.z, reached.r, self._suction)
                yield StepReport(index, count, command.line, waypoint(command), at)
            over = True
        except LinkDown as error:
            error.moving = self._moved
            raise
        finally:
            if not over:
                self._break_off()
            self._busy = False

    def _claim(self) -> None:
        if self._halt.is_set():
            raise Stopped("stop")
        with self._lock:
            self._idle()
            self._busy, self._moved = True, False

    def _synchronise(self) -> None:
        """Empty the queue and see that it runs: from here on its numbers mean something."""
        self._link.clear()
        self._link.set(dobot_frames.START)
        number = self._link.queue(dobot_frames.WAIT, struct.pack("<I", 1))
        try:
            self._await(number, None, SYNC_S)
        except MoveTimeout as error:
            raise NotReady("the arm's queue does not run: reset it") from error

    def _step(self, command: Command, seconds: float) -> Pose:
        """One primitive, to its end; where the tool is then."""
        if self._halt.is_set():
            raise Stopped("stop")
        if command.op == "grip":
            self._suction = command.grip
            return self._cell.pose(self._await(self._link.suck(command.grip), None, GRIP_S))
        target = self._cell.millimetres(Pose(command.x, command.y, command.z, command.r))
        self._moved = True
        number = self._link.line_to(target)
        return self._cell.pose(self._await(number, target, LOOSE * seconds + EXTRA_S))

    def _await(
        self, number: int, target: Millimetres | None, deadline: float, stall: float = STALL_S
    ) -> Millimetres:
        """Where the arm rests once a queued command is over. Raises what ended it otherwise."""
        watch = Watch(number, target, self._link.pose(), self._now(), deadline, stall)
        while True:
            self._stopped()
            codes = self._link.alarms()
            if codes:
                raise self._alarmed(codes)
            finished, here = self._link.finished(), self._link.pose()
            if watch.look(finished, here, self._now()):
                return here
            self._halt.wait(POLL_S / self._pace)

    def _now(self) -> float:
        return time.monotonic() * self._pace

    # --- what ends a plan early -----------------------------------------------------------------

    def _stopped(self) -> None:
        if not self._halt.is_set():
            return
        if not self._at_once and not self._closed:
            self._rest(GRACE_S)
        raise Stopped("stop")

    def _rest(self, patience: float) -> None:
        """Wait until the arm rests, for so long at most."""
        until, last = self._now() + patience, self._link.pose()
        pause = threading.Event()
        while self._now() < until:
            pause.wait(POLL_S / self._pace)
            here = self._link.pose()
            if here.apart(last) <= STILL:
                return
            last = here

    def _alarmed(self, codes: Sequence[int]) -> AlarmError:
        """Flush, clear, look again; the error that says what it was, and what to do."""
        self._link.set(dobot_frames.STOP)
        self._link.clear()
        if dobot_alarms.loses_position(codes):
            dobot_start.mark_homed(self._link, False)
        self._link.set(dobot_frames.ALARMS)
        threading.Event().wait(CLEAR_S / self._pace)
        again = self._link.alarms()
        still = "" if not again else ", and it cannot be cleared"
        text = f"{dobot_alarms.describe(codes)}{still}: {dobot_alarms.remedy(codes)}"
        if again:
            self._trouble = text
        return AlarmError(text, tuple(codes), dobot_alarms.remedy(codes))

    def _break_off(self) -> None:
        """Halt, empty the queue, wait for rest: nothing that was sent goes on by itself."""
        try:
            self._link.urgent(dobot_frames.FORCE_STOP)
            self._link.clear()
            self._rest(REST_S)
            here = self._cell.pose(self._link.pose())
            self._belief.follows(Command("move", here.x, here.y, here.z, here.r, False), here)
        except LinkDown:
            if not self._closed:
                self._trouble = f"{LOST}: reset it first"
        except RobotError as error:
            self._trouble = f"the arm could not be told to halt ({error}): reset it first"

    # --- home, stop, reset, close ---------------------------------------------------------------

    def home(self) -> Pose:
        """Have the controller home itself, to where the arm waits; where it is then.

        The one motion that is the controller's own. Clears alarms first. Raises as `run` does.
        """
        why = self.reach(PARK)
        if why is not None:
            raise Unreachable(f"where the arm waits is out of reach, see [dobot]: {why}")
        self._claim()
        over = False
        try:
            self._start_up()
            self._synchronise()
            number = dobot_start.queue_homing(self._link, self._cell.millimetres(PARK))
            here = self._await(number, None, HOMING_S, HOMING_STALL_S)
            dobot_start.mark_homed(self._link, True)
            self._belief.begins(self._cell.pose(here))
            over = True
        finally:
            if not over:
                self._break_off()
            self._busy = False
        return self._cell.pose(here)

    def _connect(self) -> None:
        """Open the port if need be, anew if it is dead, and start up."""
        self._trouble = ""
        if self._link.is_open:
            try:
                self._start_up()
                return
            except LinkDown:
                self._link.close()
        self._link.open()
        self._start_up()

    def _start_up(self) -> dobot_start.Greeting:
        """Settings, and a look whether alarms are gone. Raises AlarmError where they are not."""
        greeting = dobot_start.start_up(self._link, self._config)
        if greeting.alarms:
            lost = dobot_alarms.loses_position(greeting.alarms)
            if lost:
                dobot_start.mark_homed(self._link, False)
            threading.Event().wait(CLEAR_S / self._pace)
            codes = self._link.alarms()
            if codes:
                raise self._alarmed(codes)
        return greeting

    def stop(self, now: bool = False) -> None:
        """Halt, keep the grip, latch until `reset`. From any thread.

        Nothing further begins; what is under way may end within 0.25 s and is broken off then, or
        at once (``now``). Raises LinkDown where the arm could not be told.
        """
        self._at_once = self._at_once or now
        self._halt.set()
        if self._link.is_open:
            self._link.urgent(dobot_frames.FORCE_STOP if now else dobot_frames.STOP)

    def reset(self) -> None:
        """Clear latch and alarms, and open the port if it is not; never moves.

        Raises LinkDown where the port does not open, NoReply where no Dobot answers, AlarmError
        where an alarm stays, NotReady while a plan runs, or has not yet ended after a stop.
        """
        if self._closed:
            return
        if self._busy:  # else it might take the cleared latch for leave to go on
            raise NotReady("a plan is running, or still ending: stop it, and wait for its end")
        try:
            self._connect()
        except (LinkDown, NoReply):
            self._link.close()
            self._trouble = f"{LOST}: reset it first"
            raise
        self._at_once = False
        self._halt.clear()

    def close(self) -> None:
        """Halt what moves, pump off, let go of the port; never waits for a motion."""
        if self._closed:
            return
        self._closed = True
        self._halt.set()
        with contextlib.suppress(LinkDown):
            if self._link.is_open:
                if self._busy:
                    self._link.urgent(dobot_frames.FORCE_STOP)
                self._link.urgent(dobot_frames.SUCTION, bytes(2))
        self._link.close()


def open_dobot(
    config: DobotConfig, keep_outs: Sequence[KeepOut] = (), scene: Scene | None = None
) -> DobotRobot:
    """An arm at its port, ready but for homing. Raises as `DobotRobot.reset` does."""
    robot = DobotRobot(config, keep_outs, scene)
    try:
        robot.reset()
    except RobotError:
        robot.close()
        raise
    return robot

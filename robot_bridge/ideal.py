"""A robot without physics or time: the ideal table as a Robot, and as a prediction.

`predict` says what a list of primitives would do to a scene; the check runs it before any motion.
`IdealRobot` is the same table behind the Robot protocol; with ``pace`` it takes the time an arm
would, so that a screen can show the motion.
"""

from __future__ import annotations

import math
import threading
from collections.abc import Iterator, Sequence

from agent.errors import NotReady, Stopped
from agent.messages import Command, StepReport, Waypoint
from robot_bridge.api import PARK, ApprovedPlan, Limits, waypoint
from robot_bridge.table import Table
from scene.types import Pose, Scene

TICK = 1 / 30
"""Seconds between two positions of a paced motion."""


def predict(commands: Sequence[Command], scene: Scene, start: Pose | None = None) -> Scene:
    """The scene after the primitives, on the ideal table; pure. ``start``: pose of the tool.

    Without ``start`` the tool is parked, or at the top of what the scene says is held.
    """
    return rehearse(commands, scene, start)[0]


def rehearse(
    commands: Sequence[Command], scene: Scene, start: Pose | None = None
) -> tuple[Scene, tuple[StepReport, ...]]:
    """Like `predict`, and what each primitive reached (told and reached differ where blocked)."""
    table = Table(scene, start or _start(scene))
    steps = tuple(
        _step(table, command, index, len(commands)) for index, command in enumerate(commands)
    )
    return table.scene(), steps


def _start(scene: Scene) -> Pose:
    for item in scene.objects:
        if item.held:
            return Pose(*item.position, item.top)
    return PARK


def _step(table: Table, command: Command, index: int, count: int) -> StepReport:
    if command.op == "move":
        table.move(command.x, command.y, command.z, command.r)
    else:
        table.grip(command.grip)
    return _report(table, command, index, count)


def _report(table: Table, command: Command, index: int, count: int) -> StepReport:
    tip = table.tip
    reached = Waypoint(tip.x, tip.y, tip.z, tip.r, table.suction)
    held = table.held is not None
    return StepReport(index, count, command.line, waypoint(command), reached, held)


class IdealRobot:
    """The ideal table as a robot (`robot_bridge.api.Simulated`). Thread-safe.

    ``pace`` 0 moves at once, 1 at the arm's own speed, 2 at half of it. A `stop` latches: a run
    under way raises Stopped, a new one NotReady, until `reset`.
    """

    def __init__(self, scene: Scene | None = None, *, pace: float = 0.0) -> None:
        self._limits = Limits()
        self._pace = pace
        self._lock = threading.RLock()
        self._halt = threading.Event()
        self._busy = False
        self._closed = False
        self._table = Table(scene or Scene(), PARK)

    @property
    def limits(self) -> Limits:
        """The workspace, fixed for the robot's life."""
        return self._limits

    def reach(self, pose: Pose) -> str | None:
        """None: the ideal arm reaches everything inside its limits."""
        return None

    def pose(self) -> Pose:
        """Where the tool's tip is."""
        with self._lock:
            return self._table.tip

    def run(self, plan: ApprovedPlan) -> Iterator[StepReport]:
        """Run the plan, one report a primitive. Raises NotReady now, Stopped while it runs."""
        if not isinstance(plan, ApprovedPlan):
            raise TypeError("a robot runs an ApprovedPlan and nothing else")
        self._claim()
        return self._run(plan)

    def _claim(self) -> None:
        if self._closed:
            raise NotReady("the robot is closed")
        if self._halt.is_set():
            raise NotReady("stopped: reset it first")
        if self._busy:
            raise NotReady("another plan is running")

    def _run(self, plan: ApprovedPlan) -> Iterator[StepReport]:
        self._busy = True
        try:
            with self._lock:
                self._table.reseat()
            for index, command in enumerate(plan.told):
                self._go(command)
                with self._lock:
                    report = _report(self._table, command, index, len(plan.told))
                yield report
        finally:
            self._busy = False

    def _go(self, command: Command) -> None:
        """One primitive, in pieces if it is to take its time. Raises Stopped."""
        if self._halt.is_set():
            raise Stopped("stop")
        if command.op == "grip":
            with self._lock:
                self._table.grip(command.grip)
            return
        for piece in self._pieces(command):
            with self._lock:
                free = self._table.move(piece.x, piece.y, piece.z, piece.r)
            if self._pace and self._halt.wait(TICK):
                raise Stopped("stop")
            if not free:
                return

    def _pieces(self, command: Command) -> Iterator[Pose]:
        start = self.pose()
        goal = Pose(command.x, command.y, command.z, command.r)
        if self._pace:
            span = math.dist((start.x, start.y, start.z), (goal.x, goal.y, goal.z))
            turn = math.remainder(goal.r - start.r, math.tau)
            seconds = max(span, abs(turn) / math.pi) / self._limits.speed * self._pace
            count = math.ceil(seconds / TICK)
            for piece in range(1, count):
                share = piece / count
                yield Pose(
                    start.x + (goal.x - start.x) * share,
                    start.y + (goal.y - start.y) * share,
                    start.z + (goal.z - start.z) * share,
                    start.r + turn * share,
                )
        yield goal

    def home(self) -> Pose:
        """Up, then to PARK, keeping what is held. Raises NotReady, Stopped."""
        self._claim()
        up = self.pose()
        for goal in (Pose(up.x, up.y, max(up.z, PARK.z), PARK.r), PARK):
            self._go(Command("move", goal.x, goal.y, goal.z, goal.r, False))
        return self.pose()

    def stop(self, now: bool = False) -> None:
        """Halt where it is, keep the grip, latch until `reset`. From any thread."""
        self._halt.set()

    def reset(self) -> None:
        """Clear the latch; never moves."""
        if not self._closed:
            self._halt.clear()

    def close(self) -> None:
        """End whatever runs and take nothing more."""
        self._closed = True
        self._halt.set()

    def load(self, scene: Scene) -> None:
        """Make the world be this scene, arm parked, gripper empty (what was held is let go)."""
        with self._lock:
            self._table = Table(scene, _start(scene))
            self._table.grip(False)
            self._table.tip = PARK

    def scene(self) -> Scene:
        """The world as it is now."""
        with self._lock:
            return self._table.scene()

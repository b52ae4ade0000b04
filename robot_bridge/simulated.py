"""What the simulated arms share: one plan at a time, from where it begins; a latched stop."""

from __future__ import annotations

import threading
from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from typing import Protocol

from agent.errors import NotReady, Stopped
from agent.messages import Command, KeepOut, StepReport, Waypoint
from robot_bridge.api import ApprovedPlan, Limits, waypoint
from robot_bridge.mishaps import NONE, Mishaps
from robot_bridge.motion import at, length
from scene.types import Pose, Scene

AT_START = 0.02
"""How far from where a plan begins the tip may be (table units): its first way was checked."""


class Stage(Protocol):
    """A world with a tool in it, as both simulations have one."""

    suction: bool

    @property
    def holding(self) -> bool:
        """Whether the tool holds something."""
        ...

    def reseat(self) -> None:
        """Let the tray close up after things were taken from it."""
        ...

    def lose(self) -> None:
        """What is held slips off and falls; suction stays on."""
        ...

    def scene(self) -> Scene:
        """The world as a Scene."""
        ...


class SimulatedArm(ABC):
    """Base of the simulated arms (`robot_bridge.api.Robot`). Thread-safe.

    A `stop` latches: a run under way raises Stopped, a new one NotReady, until `reset`. Every
    access to the world happens with the lock held, and never for longer than a moment, so that
    `pose`, `scene` and `stop` can be called from any thread while a plan runs.
    """

    def __init__(
        self,
        pace: float,
        keep_outs: Sequence[KeepOut] = (),
        mishaps: Mishaps = NONE,
        speed: float = 1.0,
    ) -> None:
        limits = Limits(
            keep_outs=tuple(keep_outs), everywhere=True, simulated=True, yields=True
        )  # fmt: skip
        self._limits, self._share = limits.slowed(speed), speed
        self._pace = pace
        self._mishaps = mishaps
        self._lock = threading.RLock()
        self._halt = threading.Event()
        self._busy = self._closed = False

    @property
    @abstractmethod
    def _stage(self) -> Stage:
        """The world that the arm works in."""

    @abstractmethod
    def _move(self, goal: Pose) -> None:
        """One straight motion, ended early where something blocks it. Raises Stopped."""

    @abstractmethod
    def _grip(self, on: bool) -> None:
        """Suction on or off."""

    @abstractmethod
    def pose(self) -> Pose:
        """Where the tool's tip is, measured."""

    @property
    def limits(self) -> Limits:
        """The workspace, fixed for the robot's life."""
        return self._limits

    def reach(self, pose: Pose) -> str | None:
        """None: a simulated arm reaches everything inside its limits."""
        return None

    def run(self, plan: ApprovedPlan) -> Iterator[StepReport]:
        """Run the plan, one report a primitive. Raises NotReady at once, Stopped on the way."""
        if not isinstance(plan, ApprovedPlan):
            raise TypeError("a robot runs an ApprovedPlan and nothing else")
        self._ready(plan)
        return self._run(plan)

    def _ready(self, plan: ApprovedPlan) -> None:
        """Raises NotReady where no motion may begin, or not this one."""
        if self._closed:
            raise NotReady("the robot is closed")
        if self._halt.is_set():
            raise NotReady("stopped: reset it first")
        if self._busy:
            raise NotReady("another plan is running")
        if plan.limits != self._limits:
            raise NotReady("the plan was approved for another arm: plan again")
        if length(self.pose(), plan.start) > AT_START:
            raise NotReady("the arm is not where the plan begins: plan again")

    def _run(self, plan: ApprovedPlan) -> Iterator[StepReport]:
        if self._halt.is_set():
            raise Stopped("stop")
        self._claim(plan)
        try:
            for index, command in enumerate(plan.told):
                self._step(command)
                yield self._report(command, index, len(plan.told))
        finally:
            self._busy = False

    def _claim(self, plan: ApprovedPlan) -> None:
        with self._lock:
            self._ready(plan)
            self._busy = True
            self._stage.reseat()

    def _step(self, command: Command) -> None:
        if self._halt.is_set():
            raise Stopped("stop")
        if command.op == "move":
            self._go(Pose(command.x, command.y, command.z, command.r))
        elif command.grip and not self._mishaps.seals():
            with self._lock:
                self._stage.suction = True
        else:
            self._grip(command.grip)

    def _go(self, goal: Pose) -> None:
        """To a pose; what is held may slip off on the way."""
        share = self._mishaps.slips() if self._stage.holding else None
        if share is not None:
            self._move(at(self.pose(), goal, share))
            with self._lock:
                self._stage.lose()
        self._move(goal)

    def _report(self, command: Command, index: int, count: int) -> StepReport:
        with self._lock:
            tip, stage = self.pose(), self._stage
            reached = Waypoint(tip.x, tip.y, tip.z, tip.r, stage.suction)
            return StepReport(index, count, command.line, waypoint(command), reached, stage.holding)

    def stop(self, now: bool = False) -> None:
        """Halt where it is, keep the grip, latch until `reset`. From any thread."""
        self._halt.set()

    def reset(self) -> None:
        """Clear the latch; never moves."""
        if not self._closed:
            self._halt.clear()

    def close(self) -> None:
        """End whatever runs and take nothing more; never waits."""
        self._closed = True
        self._halt.set()

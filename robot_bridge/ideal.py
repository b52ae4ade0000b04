"""A robot without physics or time: the ideal table as a Robot, and as a prediction.

`predict` says what a list of primitives would do to a scene; the check runs it before any motion.
`IdealRobot` is the same table behind the Robot protocol; with ``pace`` it takes the time an arm
would, so that a screen can show the motion.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from agent.errors import NotReady, Stopped
from agent.messages import Command, KeepOut, StepReport, Waypoint
from robot_bridge.api import PARK, waypoint
from robot_bridge.mishaps import NONE, Mishaps
from robot_bridge.motion import along
from robot_bridge.simulated import SimulatedArm
from robot_bridge.table import Table
from scene.types import Pose, Scene

TICK = 1 / 30
"""Seconds between two positions of a paced motion."""


def predict(commands: Sequence[Command], scene: Scene, start: Pose | None = None) -> Scene:
    """The scene after the primitives, on the ideal table; pure. ``start``: pose of the tool.

    Without ``start`` the tool is parked. What the scene says is held hangs from its tip.
    """
    return rehearse(commands, scene, start)[0]


def rehearse(
    commands: Sequence[Command], scene: Scene, start: Pose | None = None
) -> tuple[Scene, tuple[StepReport, ...]]:
    """Like `predict`, and what each primitive reached (told and reached differ where blocked)."""
    holding = any(item.held for item in scene.objects)
    table = Table(scene, _start(scene) if start is None or holding else start)
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
    return StepReport(index, count, command.line, waypoint(command), reached, table.holding)


class IdealRobot(SimulatedArm):
    """The ideal table as a robot (`robot_bridge.api.Simulated`).

    ``pace`` 0 moves at once, 1 at the arm's own speed, 2 at half of it. ``speed``: the share of
    the full speeds that is its limit.
    """

    def __init__(
        self,
        scene: Scene | None = None,
        *,
        pace: float = 0.0,
        keep_outs: Sequence[KeepOut] = (),
        mishaps: Mishaps = NONE,
        speed: float = 1.0,
    ) -> None:
        super().__init__(pace, keep_outs, mishaps, speed)
        self._table = Table(scene or Scene(), PARK)

    @property
    def _stage(self) -> Table:
        return self._table

    def pose(self) -> Pose:
        """Where the tool's tip is."""
        with self._lock:
            return self._table.tip

    def _grip(self, on: bool) -> None:
        with self._lock:
            self._table.grip(on)

    def _move(self, goal: Pose) -> None:
        for piece in self._pieces(goal):
            with self._lock:
                free = self._table.move(piece.x, piece.y, piece.z, piece.r)
            if self._pace and self._halt.wait(TICK):
                raise Stopped("stop")
            if not free:
                return

    def _pieces(self, goal: Pose) -> Iterator[Pose]:
        """The ways between two ticks of a paced motion; the whole way at once without pace."""
        if self._pace:
            limits, tick = self._limits, TICK / self._pace
            yield from along(self.pose(), goal, limits.speed, tick, limits.turn_speed)
        yield goal

    def load(self, scene: Scene) -> None:
        """Make the world be this scene, arm parked, gripper empty (what was held is let go).

        Raises NotReady while a plan runs.
        """
        with self._lock:
            if self._busy:
                raise NotReady("another plan is running")
            self._table = Table(scene, _start(scene))
            self._table.grip(False)
            self._table.tip = PARK

    def scene(self) -> Scene:
        """The world as it is now."""
        with self._lock:
            return self._table.scene()

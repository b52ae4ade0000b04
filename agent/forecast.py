"""What a checked plan would do to the scene, command by command, on the ideal table (pure)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from agent.messages import Command
from robot_bridge.api import ApprovedPlan
from scene.types import Pose, Scene

Predict = Callable[[Sequence[Command], Scene, Pose | None], Scene]
"""What a list of primitives would do to a scene, from a pose of the tool (None: parked); pure."""


class Forecast:
    """The predicted scene after any number of a plan's commands, computed when asked for."""

    def __init__(self, plan: ApprovedPlan, scene: Scene, predict: Predict) -> None:
        self.commands = plan.told
        self.start = plan.start
        self.scene = scene
        self._predict = predict
        self._known: dict[int, Scene] = {0: scene}

    def after(self, count: int) -> Scene:
        """The scene after the first ``count`` commands."""
        if count not in self._known:
            self._known[count] = self._predict(self.commands[:count], self.scene, self.start)
        return self._known[count]

    def first(self, happened: Callable[[Scene], bool]) -> int:
        """The number of the command that brings it about, given that it holds at the end."""
        low, high = 0, len(self.commands)
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (low, middle) if happened(self.after(middle)) else (middle, high)
        return max(0, high - 1)

    def ways(self) -> Iterator[tuple[Pose, Command]]:
        """Each command with the pose from which it goes."""
        here = self.start
        for command in self.commands:
            yield here, command
            here = Pose(command.x, command.y, command.z, command.r)

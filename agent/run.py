"""The state of one run of a program, and its budgets."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from agent.arrange import Arrangement
from agent.errors import LimitReached
from agent.guards import Value
from agent.messages import Command
from scene.types import SceneObject

MAX_STEPS = 100_000
MAX_COMMANDS = 500
SOLVE_STEPS = 50
"""Steps that one solver.solve() counts for."""


@dataclass(slots=True)
class Run:
    """The state of one run. ``objects`` maps every name the program may use; None: absent.

    ``gripping`` is what the gripper was told last: True from the start if something is held.
    """

    objects: Mapping[str, SceneObject | None]
    arrangement: Arrangement
    gripping: bool = False
    steps: int = 0
    line: int = 0
    variables: dict[str, Value] = field(default_factory=dict)
    commands: list[Command] = field(default_factory=list)

    def step(self, count: int = 1) -> None:
        """Count work. Raises LimitReached."""
        self.steps += count
        if self.steps > MAX_STEPS:
            raise LimitReached(f"the program runs longer than {MAX_STEPS:,} steps")


Evaluate = Callable[[Run], Value]

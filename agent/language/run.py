"""The state of one run of a program, and its budgets."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from agent.errors import LimitReached, ProgramFailed
from agent.language.arrange import Arrangement
from agent.language.guards import Value
from agent.messages import Command
from scene.types import SceneObject

MAX_STEPS = 100_000
MAX_COMMANDS = 500
SOLVE_STEPS = 50
"""Steps that one solver.solve() counts for."""

Own = tuple[Sequence[str], "Callable[[Run], str | None]"]
"""A function written in the language: its parameters and its compiled body."""


@dataclass(slots=True)
class Run:
    """The state of one run. ``objects`` maps every name the program may use; None: absent.

    ``arrangement`` is None in a manipulate program. ``own`` has the functions written in the
    language; ``result`` is what the one just left returned, ``within`` how deep the run is in them.
    ``placed`` is where things that the program moved stand by now, by id.
    ``gripping`` is what the gripper was told last: True from the start if something is held.
    """

    objects: Mapping[str, SceneObject | None]
    arrangement: Arrangement | None
    own: Callable[[str], Own]
    gripping: bool = False
    steps: int = 0
    line: int = 0
    statement: int = 0
    variables: dict[str, Value] = field(default_factory=dict)
    commands: list[Command] = field(default_factory=list)
    placed: dict[str, SceneObject] = field(default_factory=dict)
    result: Value = None
    within: int = 0

    def unknown(self, item: SceneObject, axis: str) -> Value:
        """Where an object of the tray goes, along x or y. Raises ProgramFailed to manipulate
        what the tray has no room for."""
        if self.arrangement is None:
            raise ProgramFailed(f"the tray has no room for the {item.name}: it has no {axis}")
        return self.arrangement.coordinate(item, axis)

    @property
    def solver(self) -> Arrangement:
        """What ``solver`` is in an arrange program; no other program can name it."""
        assert self.arrangement is not None
        return self.arrangement

    def step(self, count: int = 1) -> None:
        """Count work. Raises LimitReached."""
        self.steps += count
        if self.steps > MAX_STEPS:
            raise LimitReached(f"the program runs longer than {MAX_STEPS:,} steps")


Evaluate = Callable[[Run], Value]

"""What a person wants done, as a program that can be executed: what holds before, and after."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from agent.check import Checked, check
from agent.errors import SceneError
from agent.execute import Executor
from agent.messages import Command, Kind
from clarifier.motions import does_the_same
from evals.postconditions import Malformed, holds
from evals.seed_proof import Value, fill, lines_of
from evals.superlatives import told_apart
from evals.world import World
from robot_bridge.ideal import IdealRobot, predict
from scene.types import Scene, identifiers


class Intent(NamedTuple):
    """A program over slots, what must hold after it, and what it takes for given."""

    program: str
    after: tuple[str, ...]
    given: tuple[str, ...]


class Variant(NamedTuple):
    """The intent with things bound: its program, how the scene ends, what must hold then."""

    program: str
    commands: tuple[Command, ...]
    after: Scene
    lines: tuple[str, ...]


class Meaning(NamedTuple):
    """One thing that the words may mean; any of its ``variants`` will do.

    ``picked``: ids of what it takes for the open reference. ``said``: a sentence that says it and
    leaves nothing open; ``words``, ``short``: what was left out. ``refused``: what the check said
    of the variants that may not run.
    """

    kind: Kind
    picked: tuple[str, ...]
    said: str
    variants: tuple[Variant, ...]
    refused: tuple[str, ...] = ()
    words: str = ""
    short: str = ""

    def fits(self, before: Scene, after: Scene, commands: Sequence[Command]) -> bool:
        """Whether what was done is what is meant: the same end, or all holds that must."""
        world = World(before, after, tuple(commands))
        return self.ends_so(before, after, commands) or any(
            _met(one.lines, world) for one in self.variants
        )

    def ends_so(self, before: Scene, after: Scene, commands: Sequence[Command]) -> bool:
        """Whether things ended just as the intent's own program would have them."""
        done = Variant("", tuple(commands), after, ())
        return any(_same_end(one, done, before) for one in self.variants)


def distinct(meanings: Sequence[Meaning], scene: Scene) -> tuple[Meaning, ...]:
    """The meanings that differ in how things end: of two that come to the same, the first."""
    kept: list[Meaning] = []
    for meaning in meanings:
        first = meaning.variants[0]
        if not any(_same_end(one.variants[0], first, scene) for one in kept):
            kept.append(meaning)
    return tuple(kept)


def _same_end(one: Variant, other: Variant, scene: Scene) -> bool:
    ends = [Checked("", "manipulate", each.commands, each.after) for each in (one, other)]
    return does_the_same(ends[0], ends[1], scene)


def fitting(
    meanings: Sequence[Meaning], before: Scene, after: Scene, commands: Sequence[Command]
) -> list[int]:
    """Which of the meanings what was done fits: those with the very end, else those of which all
    holds that must ("touch two cups" is true of three, too)."""
    exact = [n for n, one in enumerate(meanings) if one.ends_so(before, after, commands)]
    return exact or [n for n, one in enumerate(meanings) if one.fits(before, after, commands)]


class Table:
    """Executes intents on scenes with the worker, the check and the ideal table."""

    def __init__(self, executor: Executor) -> None:
        self._executor = executor

    def given(self, intent: Intent, values: Mapping[str, Value], scene: Scene) -> bool:
        """Whether the scene is as the intent takes for given; what it chooses by size is seen."""
        world = World(scene, scene, ())
        try:
            seen = told_apart(intent.program, values, scene)
            return seen and all(holds(line, world) for line in lines_of(intent.given, values))
        except (Malformed, SceneError):
            return False

    def meaning(
        self, intent: Intent, bindings: Sequence[Mapping[str, Value]], scene: Scene, kind: Kind,
        picked: Value, said: str,
    ) -> Meaning:  # fmt: skip
        """The meaning whose variants are the intent over these bindings, as far as it may run."""
        variants, refused = list[Variant](), list[str]()
        for values in bindings:
            checked = self._checked(fill(intent.program, values), values, scene, kind)
            if checked.plan is None or checked.after is None:
                refused += [problem.reason for problem in checked.problems[:1]]
                continue
            lines = tuple(lines_of(intent.after, values))
            variants.append(Variant(checked.program, checked.commands, checked.after, lines))
        known = identifiers(scene)
        names = [picked] if isinstance(picked, str) else picked if isinstance(picked, list) else []
        ids = tuple(known[name].id for name in names)
        bad = tuple(reason for reason in refused if reason != "bad_program")
        return Meaning(kind, ids, said, tuple(variants), bad)

    def _checked(
        self, program: str, values: Mapping[str, Value], scene: Scene, kind: Kind
    ) -> Checked:
        known = identifiers(scene)
        named = [one for value in values.values() if not isinstance(value, float)
                 for one in ([value] if isinstance(value, str) else value)]  # fmt: skip
        return self.check(program, kind, scene, [known[name].id for name in named])

    def check(self, program: str, kind: Kind, scene: Scene, touched: Sequence[str]) -> Checked:
        """What a program would do there, moving these things (ids) and no others."""
        robot = IdealRobot(scene)
        return check(
            program, kind, scene, executor=self._executor, predict=predict, workspace=robot,
            start=robot.pose(), touched=touched,
        )  # fmt: skip


def _met(lines: Sequence[str], world: World) -> bool:
    """Whether all holds; never where nothing is stated but what stays."""
    if all(line.split()[0] == "only" for line in lines):
        return False
    try:
        return all(holds(line, world) for line in lines)
    except (Malformed, SceneError):
        return False

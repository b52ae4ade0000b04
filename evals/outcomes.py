"""Score by outcome: what was done, asked, refused and left alone, on sentences held out.

    python -m evals.outcomes [FILE.jsonl ...] [--failures]

A case is a scene, the person's sentences and what may become of them: the statuses allowed turn by
turn, the kind and options of a question, and what must hold at the end (`evals.postconditions`).
The sets in ``wild/`` were written by people who saw neither seeds nor generator nor clarifier; they
are never trained on and no rule is written from them. Wrong but confident is the worst outcome.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
from collections import Counter, defaultdict
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, Literal, NamedTuple, get_args

import msgspec

from agent.compose import parts_on, thinking
from agent.errors import ArmchatError, SceneError
from agent.messages import Command, Dialog, QuestionKind, Status, Turn, Waypoint
from agent.turn import Parts, run_turn
from evals.postconditions import Malformed, holds
from evals.world import World
from scene.types import Scene, read_scene

WILD = Path(__file__).parent / "wild"
Outcome = Literal["right", "wrong", "over_asked", "asked_wrongly", "missed", "refused", "failed"]
"""``missed``: did nothing wrong, but not what it should have refused or asked about; ``refused``:
refused or only talked where it should have acted or asked."""


class Want(msgspec.Struct, frozen=True):
    """What may become of one turn; ``options`` are ids that a question must offer."""

    status: tuple[Status, ...]
    kind: tuple[QuestionKind, ...] = ()
    options: tuple[str, ...] = ()


class Case(msgspec.Struct, frozen=True):
    """One case; ``after`` must hold at the end, or all of one entry of ``after_any``."""

    id: str
    family: str
    voice: str
    scene: Any
    turns: tuple[str, ...]
    want: tuple[Want, ...]
    after: tuple[str, ...] = ()
    after_any: tuple[tuple[str, ...], ...] = ()


class Score(NamedTuple):
    """The outcome of a case, and why in a few words."""

    case: Case
    outcome: Outcome
    why: str
    turns: tuple[Turn, ...] = ()


def read_cases(path: Path) -> list[Case]:
    """The cases of a file."""
    return [msgspec.json.decode(line, type=Case) for line in path.open("rb")]


def play(cases: Iterable[Case]) -> list[Score]:
    """Play every case on the ideal table, with the product's own parts."""
    with thinking() as mind:
        scores = []
        for case in cases:
            scene = read_scene(case.scene)
            with parts_on(mind, scene) as parts:
                scores.append(_play(case, scene, parts))
        return scores


def _play(case: Case, scene: Scene, parts: Parts) -> Score:
    dialog, turns = Dialog(), list[Turn]()
    for say, want in zip(case.turns, case.want, strict=True):
        try:
            turn, dialog = run_turn(say, dialog, parts)
        except ArmchatError as error:
            return Score(case, "failed", f"{type(error).__name__}: {error}", tuple(turns))
        turns.append(turn)
        if turn.status not in want.status:
            return Score(case, _missed(turn, want), f"{turn.status}: {turn.reply}", tuple(turns))
        if turn.question is not None and turn.status == "asked":
            offered = {one for option in turn.question.options for one in option.objects}
            fits = not want.kind or turn.question.kind in want.kind
            if not fits or not set(want.options) <= offered:
                return Score(case, "asked_wrongly", turn.question.text, tuple(turns))
    if turns[-1].status != "done":
        return Score(case, "right", "", tuple(turns))
    wrong = _unmet(case, World(scene, parts.arm.scene(), tuple(_path(turns))))
    return Score(case, "wrong" if wrong else "right", wrong, tuple(turns))


def _missed(turn: Turn, want: Want) -> Outcome:
    """What a turn that ended otherwise than allowed counts as."""
    if turn.status in ("done", "failed"):
        return "wrong" if turn.status == "done" else "failed"
    if turn.status == "asked":
        return "over_asked"
    return "refused" if {"done", "asked"} & set(want.status) else "missed"


def _unmet(case: Case, world: World) -> str:
    """The first condition that does not hold; empty if all of one group do."""
    groups = case.after_any or (case.after,)
    unmet = [_first_unmet(group, world) for group in groups]
    return "" if "" in unmet else unmet[0]


def _first_unmet(lines: Sequence[str], world: World) -> str:
    for line in lines:
        try:
            if not holds(line, world):
                return f"not true: {line}"
        except (Malformed, SceneError) as error:
            return f"not true: {line} ({error})"
    return ""


def _path(turns: Sequence[Turn]) -> Iterable[Command]:
    """The primitives that the robot was told, from the waypoints of all turns."""
    grip = False
    points: list[Waypoint] = [point for turn in turns for point in turn.trajectory]
    for point in points:
        changed, grip = point.grip is not grip, point.grip
        yield Command("grip" if changed else "move", point.x, point.y, point.z, point.r, grip)


def report(scores: Sequence[Score], failures: bool) -> str:
    """A table by family, and the totals with their standard errors."""
    kinds: tuple[Outcome, ...] = get_args(Outcome)
    families: dict[str, Counter[Outcome]] = defaultdict(Counter)
    for score in scores:
        families[score.case.family][score.outcome] += 1
    lines = [f"{'':28}" + "".join(f"{kind:>14}" for kind in (*kinds, "n"))]
    rows = [*sorted(families.items()), ("all", Counter(score.outcome for score in scores))]
    for family, counts in rows:
        row = [counts[kind] for kind in kinds] + [sum(counts.values())]
        lines.append(f"{family:28}" + "".join(f"{value:>14}" for value in row))
    for kind in ("right", "wrong"):
        share = sum(score.outcome == kind for score in scores) / max(1, len(scores))
        error = math.sqrt(share * (1 - share) / max(1, len(scores)))
        lines.append(f"{kind}: {100 * share:.1f} % (± {100 * error:.1f})")
    if failures:
        lines += [
            f"{score.outcome:14} {score.case.id} {score.case.turns!r}: {score.why}"
            + (f" | {score.turns[-1].program!r}" if score.turns else "")
            for score in scores
            if score.outcome != "right"
        ]
    return "\n".join(lines)


def main(arguments: Sequence[str] | None = None) -> int:
    """Play the files named (default: the wild sets) and print the tables."""
    parser = argparse.ArgumentParser(prog="python -m evals.outcomes", description=__doc__)
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("--failures", action="store_true", help="list what did not go right")
    parser.add_argument("--json", action="store_true", help="one object a case")
    options = parser.parse_args(arguments)
    for path in options.files or sorted(WILD.glob("*.jsonl")):
        scores = play(read_cases(path))
        if options.json:
            for score in scores:
                print(json.dumps({"id": score.case.id, "outcome": score.outcome, "why": score.why}))
        else:
            print(f"{path.name}\n{report(scores, options.failures)}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())

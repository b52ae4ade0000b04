"""Score by outcome: what was done, asked, refused and left alone, on sentences held out.

    python -m evals.outcomes [FILE.jsonl ...] [--failures] [--json] [--out SCORES.jsonl]

A case is a scene, the person's sentences and what may become of them: the statuses allowed turn by
turn, the kind and options of a question, and what must hold at the end (`evals.postconditions`).
The sets in ``wild/`` were written by people who saw neither seeds nor generator nor clarifier; they
are never trained on and no rule is written from them. Sets from outside are read by
`evals.external` where they lie. Wrong but confident is the worst outcome.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path

import msgspec

from agent.compose import parts_on, thinking
from agent.errors import ArmchatError, SceneError
from agent.messages import Command, Dialog, Turn, Waypoint
from agent.turn import Parts, run_turn
from evals.cases import Case, Outcome, Score, Want
from evals.external import case_of, is_external
from evals.goals import holds as reached
from evals.postconditions import Malformed, holds
from evals.tally import by_family, summary, table
from evals.world import World
from scene import relations
from scene.types import Scene, read_scene

WILD = Path(__file__).parent / "wild"


def read_cases(path: Path) -> list[Case]:
    """The cases of a file. Raises Malformed that names the line."""
    cases = []
    for number, line in enumerate(path.read_bytes().splitlines(), 1):
        try:
            row = msgspec.json.decode(line, type=dict)
            case = case_of(row) if is_external(row) else msgspec.convert(row, Case)
        except msgspec.MsgspecError as error:
            raise Malformed(f"{path}:{number}: {error}") from error
        if case is not None:
            cases.append(case)
    return cases


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
    """Say the sentences until a turn ends otherwise than allowed, and judge what came of it."""
    dialog, turns = Dialog(), list[Turn]()
    for say, want in zip(case.turns, case.want, strict=True):
        try:
            turn, dialog = run_turn(say, dialog, parts, task=case.task)
        except ArmchatError as error:
            return Score(case, "failed", f"{type(error).__name__}: {error}", tuple(turns))
        turns.append(turn)
        if turn.status not in want.status:
            break
    return judge(case, scene, parts.arm.scene(), turns)


def judge(case: Case, before: Scene, after: Scene, turns: Sequence[Turn]) -> Score:
    """What a dialogue counts as: the first turn that goes wrong decides, then what holds."""
    world = World(before, after, tuple(path_of(turns)), tuple(turn.status for turn in turns))
    outcome, why = next(filter(None, map(_misstep, turns, case.want)), None) or _end(case, world)
    metrics = {
        name: all(reached(call, world) for call in calls) for name, calls in case.metrics.items()
    }
    return Score(case, outcome, why, tuple(turns), metrics)


def _misstep(turn: Turn, want: Want) -> tuple[Outcome, str] | None:
    """What a turn that went otherwise than allowed counts as, and why."""
    if turn.status not in want.status:
        return _missed(turn, want), f"{turn.status}: {turn.reply}"
    if turn.status != "done" and turn.trajectory:
        return "wrong", f"moved and {turn.status}"
    if turn.status == "asked" and turn.question is not None:
        offered = {one for option in turn.question.options for one in option.objects}
        fits = not want.kind or turn.question.kind in want.kind
        if not fits or not set(want.options) <= offered:
            return "asked_wrongly", turn.question.text
    return None


def _missed(turn: Turn, want: Want) -> Outcome:
    """What a turn that ended otherwise than allowed counts as."""
    if turn.status in ("done", "failed"):
        return "wrong" if turn.status == "done" else "failed"
    if turn.status == "asked":
        return "over_asked"
    return "refused" if {"done", "asked"} & set(want.status) else "missed"


def _end(case: Case, world: World) -> tuple[Outcome, str]:
    """What a dialogue whose turns all ended as they may counts as, and why."""
    why = _unmet(case, world)
    return ("wrong" if why else "right"), why


def _unmet(case: Case, world: World) -> str:
    """The first condition that does not hold; empty if all do, or all of one group of a choice."""
    if "done" not in world.statuses and any(
        relations.moved(item, world.after.get(item.id)) for item in world.before
    ):
        return "nothing was done, yet something moved"
    unmet = [""]
    if world.statuses[-1] == "done":
        unmet = [_first_unmet(group, world) for group in case.after_any or (case.after,)]
    goal = (f"not true: {call}" for call in case.goal if not reached(call, world))
    return next(goal, "") if "" in unmet else unmet[0]


def _first_unmet(lines: Sequence[str], world: World) -> str:
    for line in lines:
        try:
            if not holds(line, world):
                return f"not true: {line}"
        except (Malformed, SceneError) as error:
            return f"not true: {line} ({error})"
    return ""


def path_of(turns: Sequence[Turn]) -> Iterable[Command]:
    """The primitives that the robot was told, from the waypoints of all turns."""
    grip = False
    points: list[Waypoint] = [point for turn in turns for point in turn.trajectory]
    for point in points:
        changed, grip = point.grip is not grip, point.grip
        yield Command("grip" if changed else "move", point.x, point.y, point.z, point.r, grip)


def failures(scores: Iterable[Score]) -> str:
    """A line for each case that did not go right."""
    return "\n".join(
        f"{score.outcome:14} {score.case.id} {score.case.turns!r}: {score.why}"
        + (f" | {score.turns[-1].program!r}" if score.turns else "")
        for score in scores
        if score.outcome != "right"
    )


def _line(score: Score) -> bytes:
    statuses = [turn.status for turn in score.turns]
    return msgspec.json.encode(
        {"id": score.case.id, "family": score.case.family, "outcome": score.outcome,
         "why": score.why, "statuses": statuses, "metrics": score.metrics}
    )  # fmt: skip


def main(arguments: Sequence[str] | None = None) -> int:
    """Play the files named (default: the wild sets) and print the tables."""
    parser = argparse.ArgumentParser(prog="python -m evals.outcomes", description=__doc__)
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("--failures", action="store_true", help="list what did not go right")
    parser.add_argument("--json", action="store_true", help="the counts as one object")
    parser.add_argument("--out", type=Path, help="write one object a case to this file")
    options = parser.parse_args(arguments)
    paths = options.files or sorted(WILD.glob("*.jsonl"))
    try:
        files = {path.stem: read_cases(path) for path in paths}
    except (OSError, Malformed) as error:
        parser.error(str(error))
    if len(files) < len(paths):
        parser.error("two files have one name")
    scores = {name: play(cases) for name, cases in files.items()}
    if options.out:
        every = [score for played in scores.values() for score in played]
        options.out.write_bytes(b"".join(_line(score) + b"\n" for score in every))
    counted = {name: summary(by_family(played)) for name, played in scores.items()}
    total = summary(scores)
    if options.json:
        print(msgspec.json.encode({"files": counted, "total": total}).decode())
        return 0
    for name, played in scores.items():
        print(f"{name}\n{table(counted[name])}\n")
        if options.failures:
            print(failures(played) + "\n")
    if len(scores) > 1:
        print(f"total\n{table(total)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""Trials in a closed loop: a sentence, a program, an arm with physics, a look at what came of it.

    python -m evals.trials [--trials N] [--faults] [--blind] [--frames N] [--failures] [--out FILE]

A trial counts by the true state of the simulated table at its end, and by the way that the tool
really went, never by what was said or told:
`right` if the turn is `done` and every postcondition holds, `claimed` if it is `done` and one does
not, else `admitted`. ``--faults``: a tenth of the grips does not seal, and the eye errs by 3 mm.
``--blind``: nobody looks again after a program; what was predicted is taken for what happened.
"""

from __future__ import annotations

import argparse
import math
import sys
import time
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Literal, NamedTuple

import msgspec

from agent.arm import LocalArm
from agent.called import CalledArm
from agent.compose import Mind, thinking
from agent.messages import Dialog, StepReport, Turn, Waypoint
from agent.turn import Parts, Watch, run_turn
from evals.draws import Trial, paper_trials, seed_trials, unmet
from evals.figures import Figure, at_most
from robot_bridge.api import ApprovedPlan, Simulated
from robot_bridge.bullet import BulletRobot
from robot_bridge.ideal import predict
from robot_bridge.mishaps import Haze, Mishaps
from scene.types import Scene

Outcome = Literal["right", "claimed", "admitted"]
PAPER, SEEDS = 25, 500
"""Trials of the paper's corpora, and of the seeds."""
UNSEALED, ERROR_MM, FRAMES = 0.1, 3.0, 30
"""Share of grips that fail; the eye's error in a picture (mm along x, y); pictures in a look: those
of a second."""


class Circumstances(NamedTuple):
    """What goes wrong, and whether anybody looks again."""

    faults: bool = False
    blind: bool = False
    frames: int = FRAMES


class Result(msgspec.Struct, frozen=True):
    """What became of a trial; ``why``: what does not hold, or what was admitted. Seconds, looks of
    the eye (0: not counted)."""

    name: str
    say: str
    outcome: Outcome
    why: str
    reply: str
    program: str
    tries: int
    seconds: float
    looks: int = 0


class Blind(LocalArm):
    """An arm nobody watches: after a motion, what was predicted is what is seen."""

    def __init__(self, robot: Simulated, eye: Haze) -> None:
        super().__init__(robot, eye)  # it takes what it sees for exact
        self._believed: Scene | None = None

    def scene(self) -> Scene:
        """The forecast of the last plan; before the first, what is seen."""
        return super().scene() if self._believed is None else self._believed

    def run(self, plan: ApprovedPlan, *, hold: bool = False) -> Iterator[StepReport]:
        """Run to the end, whatever the gripper feels."""
        before, start = self.scene(), self.start()
        for step in super().run(plan, hold=hold):
            yield msgspec.structs.replace(step, held=None)
        self._believed = predict(plan.told, before, start)


class Followed(CalledArm):
    """An arm whose ways are kept as they were gone: a motion may be held up by what it meets."""

    def __init__(self, arm: LocalArm, names: Mapping[str, str]) -> None:
        super().__init__(arm, names)
        self.gone: list[Waypoint] = []

    def run(self, plan: ApprovedPlan, *, hold: bool = False) -> Iterator[StepReport]:
        """See `agent.arm.Arm`."""
        for step in super().run(plan, hold=hold):
            self.gone.append(step.reached)
            yield step


def play(trial: Trial, mind: Mind, circumstances: Circumstances) -> Result:
    """One trial on an arm of its own; what happens by chance follows from the trial's sentence."""
    seed = sum(trial.say.encode())
    faults = circumstances.faults
    mishaps = Mishaps(seed, UNSEALED if faults else 0.0)
    eye = Haze(seed, ERROR_MM if faults else 0.0, circumstances.frames)
    robot = BulletRobot(trial.scene, seed, mishaps=mishaps)
    try:
        arm = Blind(robot, eye) if circumstances.blind else LocalArm(robot, eye, eye.sd)
        return msgspec.structs.replace(tried(trial, mind, robot, arm), looks=eye.looks)
    finally:
        robot.close()


def tried(trial: Trial, mind: Mind, robot: Simulated, arm: LocalArm) -> Result:
    """What becomes of a trial on an arm over ``robot``, whose table tells the truth of it."""
    began = time.perf_counter()
    before = robot.scene()
    plans: list[ApprovedPlan] = []
    watch = Watch(plan=lambda plan, kind, after: plans.append(plan))
    followed = Followed(arm, {})
    parts = Parts(mind.decide, mind.executor, predict, followed)
    turn, _ = run_turn(trial.say, Dialog(), parts, task=trial.kind, watch=watch)
    turn = msgspec.structs.replace(turn, trajectory=tuple(followed.gone))
    return _result(trial, before, robot.scene(), turn, len(plans), time.perf_counter() - began)


def _result(
    trial: Trial, before: Scene, after: Scene, turn: Turn, tries: int, seconds: float
) -> Result:
    why = unmet(trial, before, after, turn) if turn.status == "done" else turn.reply
    done: Outcome = "claimed" if why else "right"
    return Result(
        trial.name, trial.say, done if turn.status == "done" else "admitted", why,
        turn.reply, turn.program or "", tries, seconds,
    )  # fmt: skip


def drawn_trials(count: int, mind: Mind, seed: int = 0) -> tuple[list[Trial], int]:
    """Of ``count`` trials the first few from the paper's corpora, and how many were drawn."""
    few = min(PAPER, max(1, count // 20))
    paper = paper_trials(few, mind, seed)
    seeds = seed_trials(max(0, count - few), mind, seed)
    return [*paper.trials, *seeds.trials], paper.drawn + seeds.drawn


CONDITIONS = {
    "trials": Circumstances(),
    "trials_with_faults": Circumstances(faults=True),
    "trials_with_faults_not_looking_again": Circumstances(faults=True, blind=True),
}
GOALS = {"trials": 99.0, "trials_with_faults": 95.0}
"""Percent right to reach."""


def trial_figures(count: int = PAPER + SEEDS) -> dict[str, Figure]:
    """Shares right, by what goes wrong and whether anybody looks again; claims that were none."""
    figures: dict[str, Figure] = {}
    with thinking() as mind:
        trials, drawn = drawn_trials(count, mind)
        for name, circumstances in CONDITIONS.items():
            results = [play(trial, mind, circumstances) for trial in trials]
            figures[f"{name}_right"] = _right(results, GOALS.get(name))
            claimed = sum(one.outcome == "claimed" for one in results)
            goal = None if circumstances.blind else 0.0
            figures[f"{name}_claimed_falsely"] = at_most(claimed, goal, "", len(results))
    understood = 100 * len(trials) / drawn
    figures["trials_understood_of_drawn"] = at_most(understood, None, "%", drawn)
    return figures


def _right(results: Sequence[Result], goal: float | None) -> Figure:
    share = sum(one.outcome == "right" for one in results) / len(results)
    stderr = 100 * math.sqrt(share * (1 - share) / len(results))
    return Figure(
        value=100 * share, unit="%", n=len(results), stderr=stderr,
        goal=None if goal is None else f">= {goal:g}",
        met=None if goal is None else 100 * share >= goal,
    )  # fmt: skip


def summary(results: Sequence[Result], drawn: int) -> str:
    """Counts and shares in a few lines."""
    count = Counter(result.outcome for result in results)
    n = len(results)
    share = count["right"] / n
    stderr = math.sqrt(share * (1 - share) / n)
    again = sum(result.tries > 1 for result in results)
    looks = sorted(result.looks for result in results)
    return (
        f"{n} trials of {drawn} sentences drawn: {count['right']} right "
        f"({100 * share:.1f} % ± {100 * stderr:.1f}), {count['claimed']} claimed that were not, "
        f"{count['admitted']} admitted; {again} needed another try; "
        f"looks: {looks[n // 2]} in the median, {sum(looks) / n:.1f} in the mean; "
        f"{sum(result.seconds for result in results) / n:.2f} s each"
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Play trials and print the counts; 1 if a success was claimed that was none."""
    parser = argparse.ArgumentParser(prog="python -m evals.trials", description=__doc__)
    parser.add_argument("--trials", type=int, default=PAPER + SEEDS)
    parser.add_argument("--faults", action="store_true")
    parser.add_argument("--blind", action="store_true")
    parser.add_argument("--frames", type=int, default=FRAMES)
    parser.add_argument("--failures", action="store_true", help="list what did not go right")
    parser.add_argument("--out", type=Path, help="add one object a trial to this file")
    options = parser.parse_args(arguments)
    circumstances = Circumstances(options.faults, options.blind, options.frames)
    results: list[Result] = []
    with thinking() as mind:
        trials, drawn = drawn_trials(options.trials, mind)
        for trial in trials:
            results.append(play(trial, mind, circumstances))
            if options.out:
                with options.out.open("ab") as file:
                    file.write(msgspec.json.encode(results[-1]) + b"\n")
    print(summary(results, drawn))
    if options.failures:
        for one in results:
            if one.outcome != "right":
                print(f"{one.outcome:9} {one.name} {one.say!r}: {one.why} | {one.program!r}")
    return int(any(one.outcome == "claimed" for one in results))


if __name__ == "__main__":
    sys.exit(main())

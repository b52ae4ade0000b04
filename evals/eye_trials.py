"""Trials in a closed loop from pictures alone: sentence, picture, program, suction, picture.

    python -m evals.eye_trials [--trials N] [--seed S] [--pretend] [--own] [--size W H] [--failures]

The trials of `evals.trials`, but the scene that the sentence is understood on, and the one in which
is seen what came of it, are what detector and tracker make of the overhead camera's pictures, with
noise; a trial still counts by the true state of the table. The detector knows twelve kinds: what it
calls otherwise than the sentence would is introduced by name before the trial, and counted.
``--own``: only trials without an introduction. ``--pretend``: no pictures, but a detector that is
told the table and errs as it should: what tracker and language do without the real detector's
mistakes.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import msgspec
import numpy as np

from agent.arm import LocalArm
from agent.compose import Mind, thinking
from agent.doubt import Doubt, Stands
from agent.errors import ConfigError
from agent.eyes import drawn_shades, eye_over
from agent.messages import StepReport
from evals.draws import Trial
from evals.figures import Figure, at_most
from evals.trials import PAPER, SEEDS, Result, drawn_trials, tried
from robot_bridge.api import ApprovedPlan
from robot_bridge.bullet import BulletRobot, overhead
from scene.eye import Eye, Seen, look_at, noticed
from scene.kinds import head_noun
from scene.lean import Shade, seen_at
from scene.live import FRESH
from scene.look import UNKNOWN
from scene.shapes import KINDS
from scene.sight import Detection, Picture, View
from scene.track import call
from scene.tracks import Hint
from scene.types import Pose, Scene, SceneObject

SIZE = (480, 360)
"""Pixels of a picture."""
NOISE, GAIN = 3.0, 0.03
"""Standard deviation of each pixel (of 255), and of the brightness from picture to picture."""
ERROR_MM, SIZES, MISS = 1.5, 0.04, 0.02
"""What the pretended detector errs by: places, sizes (share), chance of a miss."""
SECOND = 1.0
"""Seconds between two pictures of a look: what is gone is missed long enough to be believed."""
APART = 0.25
"""A thing farther than this from where it is said to be is not the one introduced (table units)."""
UNWATCHED = (Shade((-9.0, 0.0), (9.0, 0.0), 9.0),)
"""While the arm moves nobody looks: nothing is missed."""


class Pretended:
    """A detector that is told the table (`scene.sight.Detector`), and errs."""

    def __init__(self, robot: BulletRobot, seed: int) -> None:
        self._robot, self._chance = robot, np.random.default_rng(seed)

    def detect(
        self, picture: Picture, view: View, expected: Sequence[Detection] = ()
    ) -> tuple[Detection, ...]:
        """What stands in the open, in no order that matters."""
        scene = self._robot.scene()
        shades = drawn_shades(view)(self._robot.pose())
        return tuple(
            self._seen(item, scene, view)
            for item in scene.objects
            if _open(item, scene, shades) and self._chance.random() > MISS
        )

    def _seen(self, item: SceneObject, scene: Scene, view: View) -> Detection:
        sd = scene.units(ERROR_MM / 1000)
        x, y = seen_at(item.position, item.z, view.camera)
        noun = head_noun(item.name)
        width, height, tall = np.exp(self._chance.normal(0, SIZES, 3)).tolist()
        return Detection(
            noun if noun in KINDS else UNKNOWN, 0.9,
            x + self._chance.normal(0, sd), y + self._chance.normal(0, sd), sd,
            item.width * width, item.height * height, item.tall * tall, item.r, item.color,
            np.zeros(0, np.float32),
        )  # fmt: skip


def _open(item: SceneObject, scene: Scene, shades: Sequence[Shade]) -> bool:
    """Whether a camera from above can see the thing."""
    above = (other for other in scene.objects if other.on == item.id)
    hidden = any(math.dist(other.position, item.position) < 0.1 for other in above)
    return (
        item.on != "floor"
        and not hidden
        and not any(s.distance(item.position) < s.half for s in shades)
    )


class EyeArm(LocalArm):
    """A simulated arm whose table is known from pictures alone; its gripper feels."""

    def __init__(
        self, robot: BulletRobot, eye: Eye, size: tuple[int, int], seed: int, blank: bool
    ) -> None:
        super().__init__(robot)
        self._bullet, self._size, self._blank = robot, size, blank
        self._sight = eye
        self._shades = drawn_shades(self._sight.view)
        self._chance = np.random.default_rng(seed)
        self._hint = Hint(tip=robot.pose(), eye=self._sight.view.camera)
        self._t, self._doubt, self._heights = 0.0, dict[str, float](), dict[str, float]()
        self._unseen: Collection[str] = ()
        self._stands: Stands = {}
        world = robot.scene()
        self._seen = Seen(tray=world.tray, table_m=world.table_m)

    def scene(self) -> Scene:
        """What as many pictures show as make a thing believed, be it missed in one."""
        tip = self._bullet.pose()
        hint = self._hint._replace(tip=tip, shades=self._shades(tip))
        for _ in range(FRESH):
            self._t += SECOND
            self._seen, sight = look_at(self._seen, self._look(), self._sight, hint)
            self._sight.settle()
        self._doubt, self._heights = dict(sight.sd), dict(sight.tall_sd)
        self._stands = dict(sight.stands)
        self._unseen = {id_ for id_, seconds in sight.unseen.items() if seconds > SECOND}
        return sight.scene

    def doubt(self) -> Doubt:
        """See `agent.arm.Arm`."""
        return self._doubt

    def heights(self) -> Doubt:
        """See `agent.arm.Arm`."""
        return self._heights

    def unseen(self) -> Collection[str]:
        """See `agent.arm.Arm`."""
        return self._unseen

    def stands(self) -> Stands:
        """See `agent.arm.Arm`."""
        return self._stands

    def run(self, plan: ApprovedPlan, *, hold: bool = False) -> Iterator[StepReport]:
        """See `agent.arm.Arm`; what each step tells is kept for the tracker."""
        for step in super().run(plan, hold=hold):
            self._follow(step)
            yield step

    def introduce(self, truth: Scene) -> int:
        """Call each thing what it is called in ``truth``; how many had to be told."""
        count = 0
        for one in self.scene().objects:
            real = min(truth.objects, key=lambda item: math.dist(item.position, one.position))
            if one.name != real.name and math.dist(real.position, one.position) < APART:
                named = call(self._seen.tracks, one.id, real.name)
                self._seen = replace(self._seen, tracks=named)
                count += 1
        return count

    def _look(self) -> Picture:
        width, height = self._size
        if self._blank:
            return Picture(np.zeros((1, 1, 3), np.uint8), self._t)
        pixels = self._bullet.picture(width, height) * (1 + self._chance.normal(0, GAIN))
        noisy = pixels + self._chance.normal(0, NOISE, pixels.shape)
        return Picture(np.clip(np.rint(noisy), 0, 255).astype(np.uint8), self._t)

    def _follow(self, step: StepReport) -> None:
        """One primitive as the robot tells of it."""
        reached = step.reached
        tip = Pose(reached.x, reached.y, reached.z, reached.r)
        at = tip if reached.grip != self._hint.grip else self._hint.at
        self._hint = self._hint._replace(tip=tip, grip=reached.grip, felt=step.held, at=at)
        self._t += 0.1
        hint = self._hint._replace(shades=UNWATCHED, idle=False)
        self._seen, _ = noticed(self._seen, (), self._t, hint)


class Manner(NamedTuple):
    """Which detector: the real one, or (``pretend``) one that is told; pixels of a picture."""

    pretend: bool = False
    size: tuple[int, int] = SIZE


class Played(NamedTuple):
    """What became of a trial, and how many of its things had to be introduced."""

    result: Result
    introduced: int


def play(trial: Trial, mind: Mind, manner: Manner = Manner()) -> Played:  # noqa: B008 - a value
    """One trial from pictures; chance follows from its sentence. Raises ConfigError without
    weights."""
    seed = sum(trial.say.encode())
    robot = BulletRobot(trial.scene, seed)
    try:
        view = overhead(*manner.size)
        sees = (
            Eye(Pretended(robot, seed), view) if manner.pretend
            else eye_over(trial.scene.table_m, view)
        )  # fmt: skip
        arm = EyeArm(robot, sees, manner.size, seed, manner.pretend)
        introduced = arm.introduce(robot.scene())
        return Played(tried(trial, mind, robot, arm), introduced)
    finally:
        robot.close()


def own(trial: Trial) -> bool:
    """Whether all things of a trial are of the detector's own kinds, bearing their names."""
    return all(item.name in KINDS for item in trial.scene)


def figures(count: int = PAPER + SEEDS, manner: Manner = Manner()) -> Mapping[str, Figure]:  # noqa: B008
    """Shares right and claims that were none; those with nothing introduced apart."""
    with thinking() as mind:
        trials, _ = drawn_trials(count, mind)
        try:
            played = [play(trial, mind, manner) for trial in trials]
        except ConfigError as error:
            return {"eye_trials_right": Figure(value=None, unit="%", n=0, why=str(error))}
    told = [one.result for one in played]
    alone = [one.result for one in played if not one.introduced]
    claimed = sum(one.outcome == "claimed" for one in told)
    return {
        "eye_trials_right": _right(told),
        "eye_trials_right_nothing_introduced": _right(alone),
        "eye_trials_claimed_falsely": at_most(claimed, 0.0, "", len(told)),
    }


def _right(results: Sequence[Result]) -> Figure:
    if not results:
        return Figure(value=None, unit="%", n=0, why="no such trial")
    share = sum(one.outcome == "right" for one in results) / len(results)
    stderr = 100 * math.sqrt(share * (1 - share) / len(results))
    return Figure(value=100 * share, unit="%", n=len(results), stderr=stderr)


def main(arguments: Sequence[str] | None = None) -> int:
    """Play trials and print the counts; 1 if a success was claimed that was none."""
    parser = argparse.ArgumentParser(prog="python -m evals.eye_trials", description=__doc__)
    parser.add_argument("--trials", type=int, default=PAPER + SEEDS)
    parser.add_argument("--seed", type=int, default=0, help="of the sentences and scenes")
    parser.add_argument("--pretend", action="store_true")
    parser.add_argument("--own", action="store_true")
    parser.add_argument("--size", type=int, nargs=2, default=SIZE)
    parser.add_argument("--failures", action="store_true")
    parser.add_argument("--out", type=Path, help="add one object a trial to this file")
    options = parser.parse_args(arguments)
    manner = Manner(options.pretend, tuple(options.size))
    count: Counter[str] = Counter()
    with thinking() as mind:
        trials, drawn = drawn_trials(options.trials, mind, options.seed)
        for trial in trials:
            if options.own and not own(trial):
                continue
            result, introduced = play(trial, mind, manner)
            count[result.outcome] += 1
            count["introduced"] += introduced
            if options.out:
                with options.out.open("ab") as file:
                    file.write(msgspec.json.encode(result) + b"\n")
            if options.failures and result.outcome != "right":
                print(f"{result.outcome:9} {result.name} {result.say!r}: {result.why}", flush=True)
    n = count["right"] + count["claimed"] + count["admitted"]
    print(
        f"{n} trials ({drawn} sentences drawn): {count['right']} right, {count['claimed']} claimed "
        f"that were not, {count['admitted']} admitted; {count['introduced']} things introduced"
    )
    return int(count["claimed"] > 0)


if __name__ == "__main__":
    sys.exit(main())

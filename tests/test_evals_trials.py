"""Trials in a closed loop: what they count as, and how their sentences are drawn."""

import random

import msgspec
import pytest

from agent.arm import LocalArm
from agent.compose import thinking
from agent.messages import Command
from evals.draws import Trial, joined, paper_trials, seed_trials
from evals.robot_bench import Reached
from evals.trials import Circumstances, Followed, play, summary
from robot_bridge.api import Limits, approve
from robot_bridge.ideal import IdealRobot
from scene.types import Pose, Scene, SceneObject
from translator.corpus.seed import Seed

pytest.importorskip("pybullet")
SIZES = {"width": 0.2, "height": 0.2, "tall": 0.2}
APPLE = SceneObject(id="apple_1", name="apple", x=-0.5, y=0.0, **SIZES)
PLATE = SceneObject(id="p", name="plate", x=0.5, y=0.0, width=0.6, height=0.6, tall=0.08)
ON_PLATE = Trial(
    "t", "put the apple on the plate", "manipulate", Scene(objects=(APPLE, PLATE)),
    ("on apple plate", "only apple"),
)  # fmt: skip


@pytest.fixture(scope="module")
def mind():
    with thinking() as mind:
        yield mind


def test_a_trial_that_ends_as_it_must_is_right(mind):
    result = play(ON_PLATE, mind, Circumstances())
    assert (result.outcome, result.why, result.tries) == ("right", "", 1)


def test_a_success_that_was_none_is_claimed_and_never_right(mind):
    wrong = ON_PLATE._replace(after=("on plate apple",))
    result = play(wrong, mind, Circumstances())
    assert (result.outcome, result.why) == ("claimed", "on plate apple")


def test_who_does_not_look_again_claims_what_did_not_happen(mind, monkeypatch):
    monkeypatch.setattr("evals.trials.UNSEALED", 1.0)
    blind = play(ON_PLATE, mind, Circumstances(faults=True, blind=True))
    seen = play(ON_PLATE, mind, Circumstances(faults=True))
    assert (blind.outcome, blind.tries) == ("claimed", 1)
    assert (seen.outcome, seen.tries) == ("admitted", 3)
    assert "could not keep hold of the apple in 3 tries" in seen.reply


def test_a_trial_is_the_same_again(mind):
    once, again = (play(ON_PLATE, mind, Circumstances(faults=True)) for _ in range(2))
    assert msgspec.structs.replace(once, seconds=0) == msgspec.structs.replace(again, seconds=0)


def test_drawn_trials_are_understood_and_the_same_each_time(mind):
    drawn = seed_trials(3, mind, seed=1)
    assert len(drawn.trials) == 3 and drawn.drawn >= 3
    assert drawn == seed_trials(3, mind, seed=1)
    assert len(paper_trials(2, mind).trials) == 2


SEED = Seed(
    id="x", family="f", program="put(a, left_of(a, b))", after=("left_of a b", "only a"),
    say=("put {a} left of {b}",),
)  # fmt: skip


def test_two_seeds_are_joined_over_different_things():
    both = joined(SEED, SEED, random.Random(0))
    assert both is not None
    assert both.program == "put(a, left_of(a, b))\nput(c, left_of(c, d))"
    assert both.say == ("put {a} left of {b}, then put {c} left of {d}",)
    assert both.after == ("left_of a b", "left_of c d", "only a c")


def test_seeds_that_need_more_slots_than_there_are_are_not_joined():
    wide = msgspec.structs.replace(
        SEED, program="row([a, b, c, d])", say=("a row of {a}, {b}, {c} and {d}",)
    )
    assert joined(wide, wide, random.Random(0)) is None


def test_a_postcondition_about_what_is_not_there_is_unmet(mind):
    turn = play(ON_PLATE._replace(after=("on cup plate",)), mind, Circumstances())
    assert "on cup plate" in turn.why


def test_the_summary_counts(mind):
    results = [play(ON_PLATE, mind, Circumstances())]
    assert summary(results, 2).startswith("1 trials of 2 sentences drawn: 1 right (100.0 %")


@pytest.mark.parametrize(
    ("goal", "seconds", "forbidden"),
    [
        (Pose(1.7, 0, 0.5), 2.0, 0),
        (Pose(1.71, 0, 0.5), 2.0, 1),
        (Pose(0, 0, -0.001), 2.0, 1),
        (Pose(float("nan"), 0, 0.5), 2.0, 1),
        (Pose(1.0, 0, 0.5), 0.5, 1),
    ],
)
def test_what_is_forbidden_is_counted_where_it_reaches_a_driver(goal, seconds, forbidden):
    reached = Reached()
    reached.went(Pose(0, 0, 0.5), goal, Limits(), seconds)
    assert (reached.poses, reached.forbidden) == (1, forbidden)


def test_the_way_that_counts_is_the_one_that_was_gone(mind):
    touched = ON_PLATE._replace(say="touch the apple", after=("touches apple", "only"))
    assert play(touched, mind, Circumstances()).outcome == "right"
    arm = Followed(LocalArm(IdealRobot(ON_PLATE.scene)), {})
    low = [Command("move", -0.5, 0.0, z, 0.0, False) for z in (1.2, 0.05, 1.2)]
    told = [step.told.z for step in arm.run(approve(low, arm.start(), arm.workspace))]
    assert told == [1.2, 0.05, 1.2]
    assert [point.z for point in arm.gone] == pytest.approx([1.2, 0.2, 1.2])

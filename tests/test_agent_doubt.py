"""What is within the eye's error of a limit is not inside it; without an error nothing changes."""

import math

import pytest
from msgspec.structs import replace

from agent.arm import LocalArm
from agent.attempt import Manner, Watch, attempt
from agent.check import check_commands
from agent.doubt import SURE, both, slack
from agent.messages import Command, Turn
from agent.report import TOLERANCE, changed, strays
from robot_bridge.api import PARK, Limits
from robot_bridge.ideal import IdealRobot, predict
from scene.types import Scene, SceneObject

APPLE = SceneObject(id="apple_1", name="apple", x=0.2, y=0.0, width=0.3, height=0.3, tall=0.3)
BOOK = SceneObject(id="book_1", name="book", x=-0.5, y=0.0, width=0.6, height=0.6, tall=0.1)
SCENE = Scene(objects=(APPLE, BOOK))


def carry(item, x, y, z=0.0):
    """The item taken by its middle and let go with its base at a place."""
    at, top = item.position, item.top
    return (
        Command("move", *at, 0.9, 0.0, False, 1),
        Command("move", *at, top, 0.0, False, 1),
        Command("grip", 0, 0, 0, 0, True, 2),
        Command("move", *at, 0.9, 0.0, True, 3),
        Command("move", x, y, 0.9, 0.0, True, 3),
        Command("move", x, y, z + item.tall, 0.0, True, 3),
        Command("grip", 0, 0, 0, 0, False, 4),
        Command("move", x, y, 0.9, 0.0, False, 5),
    )


class Table:
    """A workspace with an edge of reach at some x."""

    def __init__(self, reach=2.0):
        self.limits, self._reach = Limits(simulated=True), reach

    def reach(self, pose):
        return None if pose.x <= self._reach else "too far"


def problems(commands, scene=SCENE, doubt=SURE, workspace=None):
    checked = check_commands(
        commands, "", "manipulate", scene, predict=predict, workspace=workspace or Table(),
        start=PARK, touched=["apple_1", "book_1"], doubt=doubt,
    )  # fmt: skip
    return [(one.reason, one.object) for one in checked.problems]


def test_what_is_well_inside_every_limit_is_no_problem():
    assert problems(carry(APPLE, 0.0, 0.5), doubt={"apple_1": 0.02}) == []


def test_a_pick_within_the_error_of_the_reach_is_refused():
    near = Table(reach=0.25)
    commands = carry(APPLE, 0.0, 0.5)
    assert problems(commands, workspace=near) == []
    assert problems(commands, workspace=near, doubt={"apple_1": 0.01}) == []
    assert problems(commands, workspace=near, doubt={"apple_1": 0.02}) == [
        ("unreachable", "apple_1")
    ]


def test_a_thing_within_the_error_of_the_edge_may_not_be_on_the_table():
    scene = SCENE.replace(replace(APPLE, x=0.97))
    commands = carry(scene.get("apple_1"), 0.0, 0.5)
    assert problems(commands, scene) == []
    assert problems(commands, scene, {"apple_1": 0.02}) == [("unreachable", "apple_1")]


def test_what_is_let_go_within_the_error_of_the_edge_may_fall():
    commands = carry(APPLE, 0.0, 0.96)
    assert problems(commands) == []
    assert problems(commands, doubt={"apple_1": 0.02}) == [("unsafe", "apple_1")]


def test_what_is_put_within_the_error_of_a_carriers_side_may_fall_off():
    commands = carry(APPLE, -0.25, 0.0, z=0.1)
    assert problems(commands) == []
    assert problems(commands, doubt={"apple_1": 0.02}) == [("unsafe", "apple_1")]
    assert problems(commands, doubt={"apple_1": 0.01, "book_1": 0.02}) == [("unsafe", "apple_1")]


def test_the_doubt_about_other_things_is_no_matter():
    assert problems(carry(APPLE, 0.0, 0.96), doubt={"book_1": 0.1}) == []


def test_a_forecast_is_met_within_the_error_of_the_eye_and_never_within_less():
    def seen(off):
        return SCENE.replace(replace(APPLE, x=0.2 + off))

    assert strays(SCENE, seen(TOLERANCE * 0.9), {"apple_1": 1e-4}) == []
    assert strays(SCENE, seen(0.05)) != []
    assert strays(SCENE, seen(0.05), {"apple_1": 0.02}) == []
    assert strays(SCENE, seen(0.07), {"apple_1": 0.02}) != []


def test_what_did_not_move_farther_than_the_eye_errs_is_not_told_as_moved():
    seen = SCENE.replace(replace(APPLE, x=0.215))
    assert changed(SCENE, seen)
    assert not changed(SCENE, seen, {"apple_1": 0.01})


def test_three_standard_deviations_of_both_places():
    assert slack(SURE, "apple_1") == 0.0
    assert slack({"a": 0.03, "b": 0.04}, "a", "b") == pytest.approx(0.15)
    assert both({"a": 0.03}, {"a": 0.04, "b": 0.1}) == {"a": pytest.approx(0.05), "b": 0.1}


class Hazy(LocalArm):
    """An arm whose eye sees everything 8 mm to the right of where it is, and may know it."""

    def __init__(self, robot, sd):
        super().__init__(robot, self._beside)
        self._sd, self._looks = sd, 0

    def _beside(self, scene):
        self._looks += 1
        off = 0.04 if self._looks > 1 else 0.0
        moved = tuple(replace(item, x=item.x + off) for item in scene.objects)
        return replace(scene, objects=moved)

    def doubt(self):
        return {} if self._sd is None else {"apple_1": self._sd, "book_1": self._sd}


@pytest.mark.parametrize("sd", [None, 0.02])
def test_done_is_not_said_of_what_is_seen_beside_its_place_however_uncertain_the_eye(sd):
    robot = IdealRobot(SCENE)
    arm = Hazy(robot, sd)
    scene = arm.scene()
    checked = check_commands(
        carry(APPLE, 0.0, 0.5), "", "manipulate", scene, predict=predict, workspace=robot,
        start=arm.start(), touched=["apple_1"], doubt=arm.doubt(),
    )  # fmt: skip
    turn = Turn(say=None, status="done", reply="", program="", kind="manipulate")
    manner = Manner(False, False, Watch())
    done = attempt(checked, scene, ["apple_1"], predict, arm, manner, turn, retries=0)
    assert done.status == "failed"
    assert math.dist(robot.scene().get("apple_1").position, (0.0, 0.5)) < 1e-6

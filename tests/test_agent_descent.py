"""Where heights are uncertain the tool goes down until it feels something, and claims no other."""

import msgspec
import pytest

from agent.arm import LocalArm
from agent.check import check_commands
from agent.compose import table
from agent.descent import KNOWN, lowered, unfelt
from agent.forecast import Forecast
from agent.messages import Command, StepReport, Waypoint
from agent.turn import Parts, run_program
from robot_bridge.api import PARK, Limits, approve
from robot_bridge.ideal import IdealRobot, predict
from scene.types import Scene, SceneObject

CAN = SceneObject(id="can_1", name="can", x=0.2, y=0.0, width=0.3, height=0.3, tall=0.4)
BOOK = SceneObject(id="book_1", name="book", x=-0.5, y=0.0, width=0.6, height=0.6, tall=0.1)
CUP = SceneObject(id="cup_1", name="cup", x=0.2, y=0.6, width=0.4, height=0.4, tall=0.4)
SCENE = Scene(objects=(CAN, BOOK, CUP))
BLURRED = {"can_1": 0.04, "cup_1": 0.04}


class Table:
    """A workspace whose arm ends a motion at what it meets, or does not."""

    def __init__(self, yields=True):
        self.limits = Limits(simulated=True, everywhere=True, yields=yields)

    def reach(self, pose):
        return None


def touching(item):
    at = item.position
    return (
        Command("move", *at, 1.2, 0.0, False, 1),
        Command("move", *at, item.top, 0.0, False, 1),
        Command("move", *at, 1.2, 0.0, False, 1),
    )


def carrying(item, x, y, base=0.0):
    at = item.position
    return (
        *touching(item)[:2],
        Command("grip", 0, 0, 0, 0, True, 2),
        Command("move", *at, 1.2, 0.0, True, 3),
        Command("move", x, y, 1.2, 0.0, True, 3),
        Command("move", x, y, base + item.tall, 0.0, True, 3),
        Command("grip", 0, 0, 0, 0, False, 4),
        Command("move", x, y, 1.2, 0.0, False, 5),
    )


def forecast(commands, scene=SCENE):
    return Forecast(approve(commands, PARK, Table()), scene, predict)


def checked(commands, heights, yields=True):
    return check_commands(
        commands, "", "manipulate", SCENE, predict=predict, workspace=Table(yields), start=PARK,
        touched=["can_1", "book_1", "cup_1"], heights=heights,
    )  # fmt: skip


def test_a_top_of_unknown_height_is_gone_down_to_as_low_as_it_may_be():
    down = lowered(forecast(touching(CAN)), BLURRED)[1]
    assert (down.x, down.y, down.z) == (0.2, 0.0, pytest.approx(0.4 - 0.12))
    assert lowered(forecast(touching(CAN)), {"can_1": 1.0})[1].z == pytest.approx(0.02)


def test_a_height_that_is_known_changes_nothing():
    plan = forecast(touching(CAN))
    assert lowered(plan, {}) == lowered(plan, {"can_1": KNOWN / 3}) == plan.commands


def test_what_is_set_down_goes_down_until_it_stands_on_what_is_as_uncertain():
    (there,) = (c for c in lowered(forecast(carrying(CAN, 0.2, -0.6)), BLURRED)[5:6])
    assert there.z == pytest.approx(0.4 - 0.12)
    on_book = lowered(forecast(carrying(CAN, -0.5, 0.0, 0.1)), {**BLURRED, "book_1": 0.03})[5]
    assert on_book.z == pytest.approx(0.5 - 0.15)
    dropped = lowered(forecast(carrying(CAN, 0.2, -0.6, 0.3)), BLURRED)[5]
    assert dropped.z == pytest.approx(0.7)


def test_a_container_is_touched_at_its_rim_and_gripped_where_it_was():
    touch = lowered(forecast(touching(CUP)), BLURRED)
    assert {(round(one.x, 6), one.y) for one in touch} == {(round(0.2 + 0.2 - 0.04, 6), 0.6)}
    grip = carrying(CUP, 0.2, -0.6)
    assert lowered(forecast(grip), BLURRED)[:4] == forecast(grip).commands[:4]


def test_only_an_arm_that_yields_is_told_to_go_on_down_and_what_is_meant_stays():
    plan, stiff = checked(touching(CAN), BLURRED), checked(touching(CAN), BLURRED, yields=False)
    assert plan.plan.told[1].z < plan.commands[1].z == plan.meant.told[1].z == 0.4
    assert stiff.plan.told == stiff.meant.told == plan.commands


def step(at, told, reached):
    return {
        at: StepReport(at, 3, 1, Waypoint(0, 0, told, 0, False), Waypoint(0, 0, reached, 0, False))
    }


@pytest.mark.parametrize(
    ("reached", "yields", "names"),
    [
        (0.36, True, ()), (0.44, True, ()), (0.28, True, ("can_1",)), (0.9, True, ("can_1",)),
        (0.36, False, ("can_1",)),
    ],
)  # fmt: skip
def test_a_touch_counts_where_the_tool_was_held_up_at_a_height_the_top_may_have(
    reached, yields, names
):
    plan = forecast(touching(CAN))
    assert unfelt(plan, {}, BLURRED, step(1, 0.28, reached), yields) == names
    assert unfelt(plan, {}, {}, step(1, 0.4, 0.4), yields) == ()


def test_a_side_that_is_seen_worse_than_it_must_be_met_is_never_surely_touched():
    beside = CAN.x - CAN.width / 2 - 0.04
    plan = forecast((
        Command("move", beside - 0.06, 0.0, 1.2, 0.0, False, 1),
        Command("move", beside - 0.06, 0.0, 0.2, 0.0, False, 1),
        Command("move", beside, 0.0, 0.2, 0.0, False, 1),
        Command("move", beside - 0.06, 0.0, 0.2, 0.0, False, 1),
    ))  # fmt: skip
    assert unfelt(plan, {"can_1": 0.01}, {}, {}, True) == ("can_1",)
    assert unfelt(plan, {"can_1": 0.002}, {}, {}, True) == unfelt(plan, {}, {}, {}, True) == ()


class Blurred(LocalArm):
    """An arm whose eye sees the apple higher or lower than it is, and knows how badly it sees."""

    def __init__(self, robot, off):
        super().__init__(robot, self._seen)
        self._off = off

    def _seen(self, scene):
        apple = scene.get("apple_1")
        return scene.replace(msgspec.structs.replace(apple, tall=apple.tall + self._off))

    def heights(self):
        return {"apple_1": 0.05}


@pytest.mark.parametrize("off", [-0.06, 0.0, 0.06])
@pytest.mark.parametrize("program", ["touch(apple)", "put(apple, [0.0, 0.8])"])
def test_a_height_that_is_wrong_is_felt_and_what_is_claimed_is_so(executor, off, program):
    robot = IdealRobot(table("kitchen"))
    parts = Parts(lambda request: None, executor, predict, Blurred(robot, off))
    turn = run_program(program, "manipulate", parts)
    assert turn.status == "done"
    top = robot.scene().get("apple_1").top
    if program.startswith("touch"):
        assert min(point.z for point in turn.trajectory) < top
    else:
        assert robot.scene().get("apple_1").position == pytest.approx((0.0, 0.8), abs=0.01)


def test_what_is_not_there_was_not_touched_and_that_is_said(executor):
    robot = IdealRobot(table("kitchen"))
    parts = Parts(lambda request: None, executor, predict, Blurred(robot, 0.3))
    turn = run_program("touch(apple)", "manipulate", parts)
    assert turn.status == "failed"
    assert "touched the apple" in turn.reply

"""What a plan handles or comes close to, and what it leaves far aside."""

import pytest

from agent.forecast import Forecast
from agent.messages import Command
from agent.stirred import CLOSE, OVER, stirred
from robot_bridge.api import PARK, TOOL_RADIUS, approve
from robot_bridge.ideal import IdealRobot, predict
from scene.types import Scene, SceneObject

APPLE = SceneObject(id="a", name="apple", x=0.2, y=0.0, width=0.3, height=0.2, tall=0.3)
BLOCK = SceneObject(id="b", name="block", x=-0.5, y=0.0, width=0.2, height=0.2, tall=0.2)


def plan_of(*commands, scene):
    return Forecast(approve(commands, PARK, IdealRobot(scene)), scene, predict)


def move(x, y, z):
    return Command("move", x, y, z, 0.0, False)


def carried(x, y, low=None):
    """The apple taken and let go at a place."""
    (at_x, at_y), top = APPLE.position, APPLE.top
    return (
        move(at_x, at_y, 1.2), move(at_x, at_y, top), Command("grip", 0, 0, 0, 0, True),
        move(at_x, at_y, 1.2), move(x, y, 1.2), move(x, y, low or top),
        Command("grip", 0, 0, 0, 0, False), move(x, y, 1.2),
    )  # fmt: skip


def test_what_is_carried_over_the_others_comes_near_nothing():
    scene = Scene(objects=(APPLE, BLOCK))
    assert stirred(plan_of(*carried(-0.9, 0.6), scene=scene)) == {"a"}


def test_what_is_taken_and_set_down_where_it_stood_was_handled():
    assert stirred(plan_of(*carried(*APPLE.position), scene=Scene(objects=(APPLE,)))) == {"a"}


@pytest.mark.parametrize(("off", "found"), [(-0.01, {"a", "b"}), (0.01, {"a"})])
def test_what_is_set_down_close_to_another_may_have_moved_it(off, found):
    gap = CLOSE + off
    y = BLOCK.position[1] + (BLOCK.height + APPLE.height) / 2 + gap
    assert stirred(plan_of(*carried(-0.5, y), scene=Scene(objects=(APPLE, BLOCK)))) == found


@pytest.mark.parametrize(("off", "found"), [(-0.01, {"b"}), (0.01, set())])
def test_the_tool_itself_counts_where_it_is_low_enough(off, found):
    scene = Scene(objects=(APPLE, BLOCK))
    y = BLOCK.height / 2 + TOOL_RADIUS + CLOSE + off
    beside = (move(-0.9, y, 1.2), move(-0.9, y, 0.1), move(-0.2, y, 0.1), move(-0.2, y, 1.2))
    assert stirred(plan_of(*beside, scene=scene)) == found
    over = BLOCK.tall + OVER + off
    above = (move(-0.9, 0, 1.2), move(-0.9, 0, over), move(-0.2, 0, over), move(-0.2, 0, 1.2))
    assert stirred(plan_of(*above, scene=scene)) == found


def test_what_is_pushed_stirs_what_it_is_pushed_up_to():
    plum = SceneObject(id="p", name="plum", x=-0.15, y=0.0, width=0.2, height=0.2, tall=0.2)
    far = SceneObject(id="f", name="plum", x=-0.5, y=0.6, width=0.2, height=0.2, tall=0.2)
    scene = Scene(objects=(BLOCK, plum, far))
    push = (move(-0.8, 0, 1.2), move(-0.8, 0, 0.05), move(-0.52, 0, 0.05), move(-0.52, 0, 1.2))
    forecast = plan_of(*push, scene=scene)
    assert forecast.after(4).get("p") == plum
    assert stirred(forecast) == {"b", "p"}


def test_what_comes_from_the_tray_was_handled():
    waits = SceneObject(id="w", name="cup", on="tray", width=0.2, height=0.2, tall=0.2)
    robot = IdealRobot(Scene(objects=(BLOCK,), tray=(waits,)))
    from scene.tray import tray_positions

    x, y = tray_positions(robot.scene())["w"]
    take = (
        move(x, y, 1.2), move(x, y, 0.2), Command("grip", 0, 0, 0, 0, True), move(x, y, 1.2),
        move(0.5, 0.5, 1.2), move(0.5, 0.5, 0.2), Command("grip", 0, 0, 0, 0, False),
        move(0.5, 0.5, 1.2),
    )  # fmt: skip
    assert stirred(plan_of(*take, scene=robot.scene())) == {"w"}

"""A plan in words: its primitives can be run again, its numbers add up, its limits are real."""

import pytest

from agent.compose import table
from agent.explain import as_text, explain, primitive
from agent.messages import Command, KeepOut
from agent.primitives import primitives
from agent.programs import laid_out
from robot_bridge.api import PARK, Limits, approve
from robot_bridge.ideal import IdealRobot
from scene.types import Pose

POST = KeepOut("post", (0.9, 1.1), (0.9, 1.1), (0.0, 1.0))


@pytest.fixture
def plan(executor):
    def plan(source, kind="manipulate", keep_outs=()):
        scene = laid_out(table("check"), kind)
        (draft,) = executor.run(source, kind, [scene])
        robot = IdealRobot(scene, keep_outs=keep_outs)
        return approve(primitives(draft, scene), PARK, robot, source, scene)

    return plan


def approach(plan, limit, **limits):
    found = {one.limit: one for one in explain(plan, Limits(**limits)).approaches}
    return found[limit]


@pytest.mark.parametrize(
    ("source", "kind"),
    [("swap(apple, banana)", "manipulate"), ("turn(banana, 0.7)", "manipulate"),
     ('put(apple, corner(apple, "left", "near"))', "arrange")],
)  # fmt: skip
def test_what_is_shown_is_a_program_that_does_the_same(executor, plan, source, kind):
    whole = plan(source, kind)
    shown = "\n".join(one.primitive for one in explain(whole, Limits()).stretches)
    (again,) = executor.run(shown, "manipulate", [table("check")])
    assert len(again.commands) == len(whole.told)
    for one, other in zip(again.commands, whole.told, strict=True):
        assert (one.op, one.grip) == (other.op, other.grip)
        assert (one.x, one.y, one.z, one.r) == pytest.approx(
            (other.x, other.y, other.z, other.r), abs=1e-4
        )


def test_lengths_and_times_are_those_of_the_plan(plan):
    whole = plan("put(apple, [0, 0])")
    told = explain(whole, Limits())
    assert [one.seconds for one in told.stretches] == list(whole.durations)
    assert told.seconds == pytest.approx(sum(whole.durations))
    assert told.length == pytest.approx(sum(one.length for one in told.stretches))
    assert told.stretches[1].length == pytest.approx(1.2 - 0.14)
    assert {one.line for one in told.stretches} == {1}


def test_numbers_are_written_plainly():
    assert primitive(Command("move", -0.0, 1.25, 1e-9, -0.00001, False)) == (
        "robot.move(0, 1.25, 0, 0)"
    )
    assert primitive(Command("grip", 0, 0, 0, 0, True)) == "robot.grip(True)"


def test_the_closest_approach_to_each_limit_and_its_line(plan):
    whole = plan("robot.move(0, 0, 1, 0)\nrobot.move(1.5, -0.5, 0.3, 2)\nrobot.move(0, 0, 1, 0)")
    assert approach(whole, "most x 1.7")[1:] == (pytest.approx(0.2), "units", 2)
    assert approach(whole, "the table")[1:] == (pytest.approx(0.3), "units", 2)
    assert approach(whole, "most z 1.5")[1:] == (pytest.approx(0.5), "units", 1)
    room = approach(whole, "most r 3.142")
    assert (room.room, room.unit, room.line) == (pytest.approx(3.14159 - 2, abs=1e-4), "rad", 2)
    assert approach(whole, "500 motions")[1:] == (497, "motions", 3)
    length = explain(whole, Limits()).length
    assert approach(whole, "path 200").room == pytest.approx(200 - length)


def test_the_nearest_way_past_a_keep_out(plan):
    whole = plan("robot.move(0, 0, 0.5, 0)\nrobot.move(0.7, 1.2, 0.5, 0)", keep_outs=(POST,))
    near = approach(whole, "keep-out post", keep_outs=(POST,))
    assert near.line == 2 and 0.1 < near.room <= 0.2


def test_a_plan_without_motions_has_nothing_to_approach(plan):
    told = explain(plan("pass"), Limits())
    assert told == ((), (), 0, 0)
    assert "total" in as_text(told, 0.4)


def test_the_text_gives_units_and_millimetres(plan):
    text = as_text(explain(plan("robot.move(0, -1.2, 1.4, 0)"), Limits()), 0.4)
    first = text.splitlines()[1].split()
    assert first == ["1", "robot.move(0,", "-1.2,", "1.4,", "0)", "0.500", "100", "0.71"]
    assert "closest approach to each limit" in text and "20 mm" in text
    assert Pose(0, -1.2, 0.9) == PARK

"""The arm goes out of the way where it hides what it was at, looks, and comes back."""

import math

import msgspec
import pytest

from agent.arm import LocalArm
from agent.compose import table
from agent.turn import Parts, run_program
from robot_bridge.api import PARK
from robot_bridge.ideal import IdealRobot, predict


class Shaded(LocalArm):
    """An arm that hides what its tool is over; what it hides seems to be 1 cm beside."""

    def __init__(self, robot):
        super().__init__(robot, self._seen)
        self.robot, self.looked_from, self._hidden = robot, [], ()

    def _seen(self, scene):
        tip = self.robot.pose()
        self.looked_from.append((tip.x, tip.y))
        near = {one.id for one in scene.objects if math.dist(one.position, (tip.x, tip.y)) < 0.3}
        self._hidden = tuple(near)
        moved = (
            msgspec.structs.replace(one, x=one.x + 0.05) if one.id in near else one
            for one in scene.objects
        )
        return msgspec.structs.replace(scene, objects=tuple(moved))

    def unseen(self):
        return self._hidden


def played(executor, program):
    robot = IdealRobot(table("kitchen"))
    arm = Shaded(robot)
    turn = run_program(program, "manipulate", Parts(lambda r: None, executor, predict, arm))
    return turn, arm, robot


def test_what_the_arm_hides_is_looked_at_again_from_where_it_waits(executor):
    turn, arm, robot = played(executor, "put(apple, [0.0, 0.8])")
    assert turn.status == "done"
    assert arm.looked_from[-1] == (PARK.x, PARK.y)
    end = turn.trajectory[-1]
    assert (robot.pose().x, robot.pose().y) == (end.x, end.y) == pytest.approx((0.0, 0.8))


def test_what_is_in_full_view_needs_no_second_look(executor):
    turn, arm, _ = played(executor, "put(apple, [0.0, 0.8])\nrobot.move(-0.9, -0.9, 1.2, 0)")
    assert turn.status == "done"
    assert (PARK.x, PARK.y) not in arm.looked_from[1:]


def test_an_arm_that_holds_something_stays_where_it_is(executor):
    turn, _, robot = played(executor, "pick(apple)")
    assert turn.status == "done"
    assert (robot.pose().x, robot.pose().y) != (PARK.x, PARK.y)
    assert robot.scene().get("apple_1").held

"""A stop takes effect within one control period: told by positions, never by the clock.

Positions of the simulated arms change with their lock held only, so what is read and stopped
under that lock is exactly where the tip was when the stop came.
"""

import math
import threading

import pytest

from agent.errors import Stopped
from agent.messages import Command
from robot_bridge.api import TRAVEL_SPEED, approve
from robot_bridge.bullet import BRAKE, BulletRobot
from robot_bridge.ideal import TICK, IdealRobot
from robot_bridge.physics import STEP
from robot_bridge.physics import TICK as STEPS_A_TICK
from scene.types import Scene

PATIENCE = 30.0
FAR = (Command("move", 0, 1.2, 0.9, 0, False, 1), Command("move", 1.2, 1.2, 0.9, 0, False, 2))
IDEAL_PERIOD = TRAVEL_SPEED * TICK
BULLET_PERIOD = TRAVEL_SPEED * STEPS_A_TICK * STEP
BRAKING = TRAVEL_SPEED * STEP * sum(1 - step / BRAKE for step in range(BRAKE))
"""The way (table units) at full speed in one control period; and in braking, see `_slow_down`."""
LAG = 0.03
"""How far the simulated tool trails what it follows (table units): it still catches up."""


def distance(one, other):
    return math.dist((one.x, one.y, one.z), (other.x, other.y, other.z))


def travel_after_stop(robot, at, now=False):
    """How far the tip goes from the moment of a stop, given once it has gone ``at`` units.

    The stop comes at the worst moment: the arm has seen none, and takes its next period.
    """
    plan = approve(FAR, robot.pose(), robot)
    ended = []

    def run():
        try:
            list(robot.run(plan))
        except Stopped as error:
            ended.append(error)

    thread = threading.Thread(target=run)
    thread.start()
    pulse, start = threading.Event(), plan.start
    while thread.is_alive():
        with robot._lock:
            there = robot.pose()
            if distance(start, there) >= at:
                pulse.wait(2 * TICK)  # by now the arm waits for the lock
                robot.stop(now)
                break
        pulse.wait(0.001)
    thread.join(PATIENCE)
    assert ended, "the run came to its end before the stop"
    return distance(there, robot.pose())


@pytest.mark.parametrize("at", [0.01, 0.3, 0.6])
def test_the_ideal_arm_stops_within_one_control_period(at):
    robot = IdealRobot(Scene(), pace=1.0)
    assert travel_after_stop(robot, at) <= IDEAL_PERIOD + 1e-9


@pytest.mark.parametrize("at", [0.01, 0.6])
def test_the_bullet_arm_begins_to_brake_within_one_control_period(at):
    pytest.importorskip("pybullet")
    robot = BulletRobot(Scene(), pace=0.5)
    assert travel_after_stop(robot, at) <= BULLET_PERIOD + BRAKING + LAG
    robot.close()


def test_the_bullet_arm_that_is_forced_to_stop_does_not_brake():
    pytest.importorskip("pybullet")
    robot = BulletRobot(Scene(), pace=0.5)
    assert travel_after_stop(robot, 0.6, now=True) <= BULLET_PERIOD + LAG
    robot.close()


@pytest.mark.parametrize("make", [IdealRobot, BulletRobot])
def test_after_a_stop_nothing_moves_until_a_reset(make):
    pytest.importorskip("pybullet")
    robot = make(Scene(), pace=0.2)
    travel_after_stop(robot, 0.1)
    rest = robot.pose()
    robot.reset()
    assert distance(rest, robot.pose()) < 1e-9
    robot.close()

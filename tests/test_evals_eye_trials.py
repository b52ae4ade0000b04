"""Trials from pictures: the loop closes over what is seen, and counts by what is true."""

import math

import numpy as np
import pytest

pytest.importorskip("pybullet")

from agent.messages import Command
from evals.draws import Trial
from evals.eye_trials import EyeArm, Pretended, own
from evals.track_bench import frame_times
from robot_bridge.api import PARK, approve
from robot_bridge.bullet import BulletRobot, overhead
from scene.eye import Eye
from scene.types import Scene, SceneObject

APPLE = SceneObject(
    id="apple_9", name="apple", x=0.2, y=0.1, width=0.36, height=0.36, tall=0.36, color="red"
)
BOOK = SceneObject(
    id="book_9", name="book", x=-0.5, y=0.1, width=0.6, height=0.6, tall=0.12, color="blue"
)
SCENE = Scene(objects=(APPLE, BOOK))
CARRY = (
    Command("move", 0.2, 0.1, 0.9, 0.0, False, 1),
    Command("move", 0.2, 0.1, 0.36, 0.0, False, 1),
    Command("grip", 0, 0, 0, 0, True, 1),
    Command("move", 0.2, 0.1, 0.9, 0.0, True, 1),
    Command("move", 0.5, -0.4, 0.9, 0.0, True, 1),
    Command("move", 0.5, -0.4, 0.36, 0.0, True, 1),
    Command("grip", 0, 0, 0, 0, False, 1),
    Command("move", 0.5, -0.4, 0.9, 0.0, False, 1),
    Command("move", PARK.x, PARK.y, PARK.z, 0.0, False, 1),
)


@pytest.fixture
def arm():
    robot = BulletRobot(SCENE)
    eye = Eye(Pretended(robot, 1), overhead(64, 48))
    yield EyeArm(robot, eye, (64, 48), 1, blank=True), robot
    robot.close()


def test_the_arm_knows_of_its_table_what_the_detector_found(arm):
    eye, _ = arm
    seen = eye.scene()
    assert sorted(item.name for item in seen.objects) == ["apple", "thing"]
    assert math.dist(seen.get("apple_1").position, APPLE.position) < 0.03
    assert 0 < eye.doubt()["apple_1"] < 0.02


def test_what_the_detector_does_not_know_is_introduced_once(arm):
    eye, robot = arm
    assert eye.introduce(robot.scene()) == 1
    assert sorted(item.name for item in eye.scene().objects) == ["apple", "book"]
    assert eye.introduce(robot.scene()) == 0


def test_what_the_arm_carries_is_seen_where_it_was_put(arm):
    eye, robot = arm
    eye.scene()
    steps = list(eye.run(approve(CARRY, eye.start(), eye.workspace)))
    assert len(steps) == len(CARRY)
    apple = eye.scene().get("apple_1")
    assert math.dist(apple.position, robot.scene().get("apple_9").position) < 0.03
    assert (apple.on, apple.held) == ("table", False)
    assert math.dist(apple.position, (0.5, -0.4)) < 0.04


def test_a_picture_has_noise_and_no_two_are_alike():
    robot = BulletRobot(SCENE)
    shown = []

    class Camera:
        def detect(self, picture, view, expected=()):
            shown.append(picture.pixels)
            return ()

    EyeArm(robot, Eye(Camera(), overhead(64, 48)), (64, 48), 1, blank=False).scene()
    robot.close()
    one, other, *_ = (pixels.astype(float) for pixels in shown)
    assert 1.0 < np.std(one - other) < 12.0


def test_a_trial_of_the_detectors_own_kinds_needs_no_introduction():
    trial = Trial("x", "push the apple", "manipulate", SCENE, ())
    assert not own(trial)
    assert own(trial._replace(scene=Scene(objects=(APPLE,))))


def test_every_frame_arrives_on_the_bus():
    took = frame_times(5)
    assert len(took) >= 5 and min(took) > 0

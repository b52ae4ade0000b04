"""Faults of the simulated arms: seeded, as often as said, and alike on both tables."""

import math
import platform
import statistics
import sys

import msgspec
import pytest

from agent.messages import Command
from robot_bridge.api import approve
from robot_bridge.ideal import IdealRobot
from robot_bridge.mishaps import Haze, Mishaps
from scene.types import Scene, SceneObject

WHEEL = sys.platform == "linux" and platform.machine() == "x86_64"
APPLE = SceneObject(id="a", name="block", x=-0.5, y=0.0, width=0.2, height=0.2, tall=0.2)
TRAY = SceneObject(id="t", name="cup", on="tray", width=0.2, height=0.2, tall=0.2)
SCENE = Scene(objects=(APPLE,), tray=(TRAY,))


def bullet(**options):
    from robot_bridge.bullet import BulletRobot

    return BulletRobot(SCENE, **options)


@pytest.fixture(params=["ideal", "bullet"])
def make(request):
    if request.param == "bullet":
        if not WHEEL:
            pytest.skip("PyBullet has no wheel here")
        return bullet
    return lambda **options: IdealRobot(SCENE, **options)


def carry(robot):
    """Steps of taking the block and carrying it half a table to the right."""
    moves = [(-0.5, 0.9), (-0.5, 0.2), None, (-0.5, 0.9), (0.5, 0.9)]
    grip = Command("grip", 0, 0, 0, 0, True)
    commands = [grip if at is None else Command("move", at[0], 0, at[1], 0, False) for at in moves]
    return list(robot.run(approve(commands, robot.pose(), robot)))


def test_a_cup_that_does_not_seal_holds_nothing(make):
    robot = make(mishaps=Mishaps(unsealed=1.0))
    steps = carry(robot)
    assert [step.held for step in steps] == [False] * 5
    assert steps[2].reached.grip
    assert robot.scene().get("a").position == pytest.approx(APPLE.position, abs=0.005)
    robot.close()


def test_what_slips_falls_on_the_way_and_is_felt_to(make):
    robot = make(mishaps=Slip(on=2))
    steps = carry(robot)
    assert [step.held for step in steps] == [False, False, True, True, False]
    now = robot.scene().get("a")
    assert now.on == "table" and -0.4 < now.position[0] < 0.4
    robot.close()


class Slip(Mishaps):
    """What is held is lost half way, on the carrying motion of this number."""

    def __init__(self, on):
        super().__init__()
        self.on, self.motions = on, 0

    def slips(self):
        self.motions += 1
        return 0.5 if self.motions == self.on else None


def test_without_mishaps_everything_holds(make):
    robot = make()
    assert [step.held for step in carry(robot)] == [False, False, True, True, True]
    robot.close()


def test_mishaps_are_as_frequent_as_said_and_follow_from_the_seed():
    def draws(seed):
        mishaps = Mishaps(seed, unsealed=0.1, slips=0.2)
        return [mishaps.seals() for _ in range(4000)], [mishaps.slips() for _ in range(4000)]

    seals, slips = draws(5)
    assert (seals, slips) == draws(5)
    assert (seals, slips) != draws(6)
    assert 0.08 < seals.count(False) / 4000 < 0.12
    shares = [share for share in slips if share is not None]
    assert 0.17 < len(shares) / 4000 < 0.23
    assert all(0 <= share < 1 for share in shares)


@pytest.mark.parametrize(("frames", "spread"), [(1, 3.0), (16, 0.75)])
def test_an_eye_errs_by_its_millimetres_and_by_less_over_many_pictures(frames, spread):
    eye = Haze(1, mm=3.0, frames=frames)
    tables = [SCENE.replace(msgspec.structs.replace(APPLE, y=0.1 * n)) for n in (0, 1)] * 1000
    off = [1000 * (eye(one).objects[0].x - APPLE.x) * SCENE.table_m / 2 for one in tables]
    assert statistics.pstdev(off) == pytest.approx(spread, rel=0.08)
    assert abs(statistics.mean(off)) < 4 * spread / math.sqrt(2000)


def test_a_table_on_which_nothing_moves_is_seen_better_look_by_look_and_the_eye_says_so():
    def last(seed, looks):
        eye = Haze(seed, mm=3.0, frames=4)
        seen = [eye(SCENE).objects[0] for _ in range(looks)][-1]
        return seen.x - APPLE.x, eye.sd()["a"]

    off = [last(seed, 9) for seed in range(400)]
    assert [sd for _, sd in off] == pytest.approx([SCENE.units(0.0005)] * 400)
    assert statistics.pstdev(x for x, _ in off) == pytest.approx(SCENE.units(0.0005), rel=0.12)
    assert last(1, 1)[1] == pytest.approx(3 * off[0][1])


def test_what_moved_is_seen_anew():
    eye = Haze(1, mm=3.0, frames=4)
    for _ in range(5):
        eye(SCENE)
    eye(SCENE.replace(msgspec.structs.replace(APPLE, x=-0.4)))
    assert eye.sd() == {"a": pytest.approx(SCENE.units(0.0015))}
    assert eye.looks == 6


def test_an_eye_without_error_sees_what_is_and_the_tray_has_no_places():
    eye = Haze(1)
    assert eye.sd() == {} and eye(SCENE) is SCENE and eye.sd() == {}
    assert Haze(1, mm=3.0)(SCENE).tray == SCENE.tray

"""`approve`: the last check before any motion, and the only maker of an ApprovedPlan."""

import math
import random

import msgspec
import pytest

from agent.errors import Unreachable
from agent.messages import Command, KeepOut
from robot_bridge.api import PARK, ApprovedPlan, Limits, approve, distance, parking
from robot_bridge.motion import along, crosses, profile, seconds
from scene.types import Pose, Scene, SceneObject

POST = KeepOut("the camera post", (0.4, 0.6), (-0.1, 0.1), (0.0, 1.0))
SCENE = Scene(
    objects=(SceneObject(id="a", name="apple", x=0, y=0, width=0.1, height=0.1, tall=0.1),)
)


class Cell:
    """A workspace with a hole around the arm's base: reach is not convex."""

    def __init__(self, hole=0.0, **limits):
        self.limits = Limits(**limits)
        self.hole = hole

    def reach(self, pose):
        return "too near the base" if math.hypot(pose.x, pose.y) < self.hole else None


def move(x, y, z=0.5, r=0.0, line=1):
    return Command("move", x, y, z, r, False, line)


def refusal(commands, workspace, start=PARK):
    with pytest.raises(Unreachable) as refused:
        approve(commands, start, workspace)
    return refused.value


@pytest.mark.parametrize("axis", ["x", "y", "z", "r"])
@pytest.mark.parametrize("side", [0, 1])
def test_every_point_lies_in_the_box(axis, side):
    limit = getattr(Limits(r=(-2.0, 2.0)), axis)[side]
    beyond = limit + (0.001 if side else -0.001)
    at = dict.fromkeys(("x", "y"), 0.0) | {"z": 0.5, "r": 0.0}
    cell = Cell(r=(-2.0, 2.0))
    assert approve([move(**{**at, axis: limit})], PARK, cell)
    refused = refusal([move(**at), move(**{**at, axis: beyond}, line=7)], cell)
    assert refused.line == 7 and axis in str(refused)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("axis", range(4))
def test_what_is_not_a_number_is_no_place(axis, value):
    numbers = [0.0, 0.0, 0.5, 0.0]
    numbers[axis] = value
    assert "not a finite number" in str(refusal([move(*numbers)], Cell()))


def test_rounding_errors_at_the_box_are_clipped_and_told():
    plan = approve([move(0, 0, -1e-7)], PARK, Cell())
    assert plan.told[0].z == 0.0


def test_a_rotation_is_told_by_its_shorter_name():
    assert approve([move(0, 0, r=1.5 * math.pi)], PARK, Cell()).told[0].r == -math.pi / 2


def test_a_way_through_a_keep_out_is_refused_though_both_ends_are_outside():
    refused = refusal([move(0, 0), move(1, 0, line=4)], Cell(keep_outs=(POST,)))
    assert refused.line == 4 and "the camera post" in str(refused)
    assert approve([move(0, 0), move(0, 0.5), move(1, 0.5)], PARK, Cell(keep_outs=(POST,)))
    assert approve([move(0, 0, 1.3), move(1, 0, 1.3)], PARK, Cell(keep_outs=(POST,)))


def test_the_first_way_counts_too():
    assert refusal([move(1, 0)], Cell(keep_outs=(POST,)), Pose(0, 0, 0.5))


def test_the_tool_has_a_width():
    assert refusal([move(0.5, 0.13)], Cell(keep_outs=(POST,)))
    assert approve([move(0.5, 0.15)], Pose(0.5, 1, 0.5), Cell(keep_outs=(POST,)))


def test_reach_is_looked_at_along_the_way():
    refused = refusal([move(-0.9, 0), move(0.9, 0, line=3)], Cell(hole=0.3))
    assert refused.line == 3 and "too near the base" in str(refused)
    assert approve([move(-0.9, 0), move(-0.9, 0.9), move(0.9, 0.9)], PARK, Cell(hole=0.3))


def test_length_and_count_have_limits():
    far = [move(-1, 0), move(1, 0, line=2)] * 60
    assert "longer than 20 units" in str(refusal(far, Cell(length=20.0)))
    assert "120 motions" in str(refusal(far, Cell(commands=119, length=1e3)))
    assert approve(far, PARK, Cell(commands=120, length=1e3))


def test_durations_are_those_of_the_speed_limits():
    slow = Cell(speed=0.5, acceleration=2.0, turn_speed=1.0)
    start = Pose(0, 0, 0.5)
    plan = approve([move(1, 0), Command("grip", 0, 0, 0, 0, True), move(1, 0, r=2.0)], start, slow)
    assert plan.durations == pytest.approx((1 / 0.5 + 0.5 / 2.0, 0.0, 2.0 + 0.5 / 2.0))


def test_a_duration_is_that_of_the_simulated_motion():
    for length in (0.01, 0.3, 2.0):
        assert seconds(length, 1.25) == pytest.approx(
            len(profile(length, 1.25, 1e-3)) * 1e-3, abs=2e-3
        )


def test_a_grip_happens_where_the_arm_is():
    plan = approve([move(0.1, 0.2, 0.3), Command("grip", 9, 9, 9, 9, True)], PARK, Cell())
    grip = plan.told[1]
    assert (grip.x, grip.y, grip.z) == (0.1, 0.2, 0.3)


def test_the_digest_is_of_program_scene_motions_and_limits():
    def digest(x=0.0, program="p", scene=SCENE, **limits):
        return approve([move(x, 0)], PARK, Cell(**limits), program, scene).digest

    others = [
        digest(program="q"), digest(scene=None), digest(scene=SCENE.replace(_moved())),
        digest(x=0.001), digest(speed=1.0), digest(keep_outs=(POST,)),
    ]  # fmt: skip
    assert len({digest(), *others}) == 7
    assert digest() == digest()


def _moved():
    return msgspec.structs.replace(SCENE.objects[0], x=0.5)


def test_nobody_else_makes_or_changes_a_plan():
    plan = approve([move(0, 0)], PARK, Cell())
    fields = {name: getattr(plan, name) for name in ApprovedPlan.__slots__}
    with pytest.raises(TypeError):
        ApprovedPlan(object(), **fields)
    for name in fields:
        with pytest.raises(AttributeError):
            setattr(plan, name, fields[name])
    with pytest.raises(AttributeError):
        plan.other = 1


def test_home_is_a_plan_like_any_other():
    told = approve(parking(Pose(0.5, 0.5, 0.1)), Pose(0.5, 0.5, 0.1), Cell()).told
    assert [(one.x, one.y, one.z) for one in told] == [(0.5, 0.5, 0.9), (PARK.x, PARK.y, PARK.z)]


def test_a_way_crosses_a_box_where_a_point_of_it_is_inside():
    """The slab method against 2,000 points of each of 300 random ways."""
    chance = random.Random(3)

    def pose():
        return Pose(*(chance.uniform(-1, 1) for _ in range(3)))

    for _ in range(300):
        edges = [chance.uniform(-0.8, 0.5) for _ in range(3)]
        box = KeepOut("box", *((edge, edge + chance.uniform(0.1, 0.5)) for edge in edges))
        start, goal, margin = pose(), pose(), chance.uniform(0, 0.1)
        ways = [(getattr(start, axis), getattr(goal, axis), *getattr(box, axis)) for axis in "xyz"]
        deep = [
            min(min(a + (b - a) * n / 2000 - low, high - a - (b - a) * n / 2000) + margin
                for a, b, low, high in ways)
            for n in range(2001)
        ]  # fmt: skip
        if abs(max(deep)) > 2e-3:
            assert crosses(start, goal, box, margin) is (max(deep) > 0)
        if max(deep) - margin < 0:
            assert distance(start, goal, box) == pytest.approx(margin - max(deep), abs=3e-3)


def test_along_ends_at_the_goal():
    *_, last = along(Pose(0, 0, 1), Pose(1, -1, 0.2), 1.25, 1 / 30)
    assert (last.x, last.y, last.z) == pytest.approx((1, -1, 0.2))

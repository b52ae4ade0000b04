"""Table frame and millimetres, forward and inverse, and where the arm can go at all."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agent.config import DobotConfig, load
from agent.errors import ConfigError, Unreachable
from agent.messages import Command
from robot_bridge.api import PARK, approve
from robot_bridge.dobot_cell import JOINTS, Cell, Fault, Millimetres, joints_at
from robot_bridge.kinematics import Joints, forward
from scene.types import Pose

CELL = Cell(DobotConfig())
TOOL = DobotConfig().tool
ANGLES = st.tuples(*(st.floats(low, high) for low, high in JOINTS))


@given(ANGLES)
def test_the_inverse_finds_the_point_that_the_joints_reach(degrees):
    """FK(IK(p)) = p within 1e-6 mm, for every p that some joints within their limits reach."""
    x, y, z, r = forward(Joints(*map(math.radians, degrees)), TOOL)
    found = joints_at(Millimetres(x, y, z, math.degrees(r)), TOOL)
    if isinstance(found, Fault):  # the other branch of the elbow: the arm cannot bend that way
        j2, j3 = degrees[1:3]
        assert found.code == 0x12 and (j2 + j3 < 1 or math.hypot(x, y) < TOOL + 1)
        return
    again = forward(found, TOOL)
    assert math.dist(again[:3], (x, y, z)) <= 1e-6
    assert abs(math.remainder(again[3] - r, math.tau)) <= 1e-9


@pytest.mark.parametrize(
    ("height", "near", "far"),
    [(0, 170, 317), (10, 162, 323), (25, 146, 330), (40, 124, 335), (60, 94, 339), (80, 141, 341),
     (120, 182, 336), (160, 201, 321)],
)  # fmt: skip
def test_the_reach_is_the_ring_of_the_docs(height, near, far):
    z = height - 68.0

    def ok(radius):
        return isinstance(joints_at(Millimetres(radius, 0, z, 0), TOOL), Joints)

    reached = [radius for radius in range(60, 400) if ok(radius)]
    assert abs(min(reached) - near) <= 1 and abs(max(reached) - far) <= 1


def test_nowhere_at_240_mm():
    assert not any(
        isinstance(joints_at(Millimetres(r, 0, 172.0, 0), TOOL), Joints) for r in range(1, 400)
    )


@given(*(st.floats(-0.8, 0.8) for _ in range(2)), st.floats(0.2, 0.8), st.floats(-1.1, 1.1))
def test_there_and_back_between_the_frames(x, y, z, r):
    pose = Pose(x, y, z, r)
    assert CELL.reach(pose) is None
    again = CELL.pose(CELL.millimetres(pose))
    assert math.dist((again.x, again.y, again.z, again.r), (x, y, z, r)) <= 1e-9


@given(st.floats(-0.6, 0.6), st.floats(-0.6, 0.6), st.floats(-20, 20))
def test_there_and_back_where_the_table_is_turned(x, y, turn):
    cell = Cell(DobotConfig(turn=turn, offset=(235.0, 4.0), scale=70.0))
    pose = Pose(x, y, 0.3, 0.2)
    again = cell.pose(cell.millimetres(pose))
    assert math.dist((again.x, again.y, again.z, again.r), (x, y, 0.3, 0.2)) <= 1e-9


def test_a_turned_table_turns_about_its_middle_and_takes_the_tool_along():
    cell = Cell(DobotConfig(turn=90.0, offset=(240.0, 0.0), scale=75.0))
    middle = cell.pose(Millimetres(240, 0, -68, 90))
    assert (middle.x, middle.y, middle.z, middle.r) == pytest.approx((0, 0, 0, 0))
    # counter-clockwise by a quarter, the table's y runs along the arm's y
    assert cell.pose(Millimetres(240, 30, -68, 0)).y == pytest.approx(0.4)


def test_the_map_is_that_of_the_docs():
    at = CELL.millimetres(Pose(0.4, 0.2, 0.1, 0.5))
    assert at[:3] == pytest.approx((240 + 15, -30, -60.5)) and at.r == pytest.approx(28.6478898)
    moved = Cell(DobotConfig(scale=100.0, offset=(230.0, 5.0), floor=-60.0))
    assert moved.millimetres(Pose(0.2, 0.1, 0.1)) == pytest.approx((240, -15, -50, 0))


@pytest.mark.parametrize(
    ("scale", "ahead", "share"),
    [(70, 240, 1.0), (75, 240, 0.97), (80, 240, 0.93), (100, 232, 0.76), (150, 232, 0.54)],
)
def test_as_much_of_the_table_is_reached_as_the_docs_say(scale, ahead, share):
    cell = Cell(DobotConfig(scale=scale, offset=(ahead, 0.0)))
    assert cell.share() == pytest.approx(share, abs=0.02)


def test_the_tool_turns_65_degrees_everywhere():
    wide = [
        CELL.reach(Pose(x, y, 0.3, math.radians(turn))) is None
        for x in (-0.8, 0, 0.8) for y in (-0.8, 0, 0.8) for turn in (-65, 0, 65)
    ]  # fmt: skip
    assert all(wide)
    assert "joint 4" in CELL.reach(Pose(0, 0, 0.3, math.radians(100)))


def test_home_can_be_reached():
    assert CELL.reach(PARK) is None


@pytest.mark.parametrize(
    ("pose", "why"),
    [(Pose(0, 1.7, 0.2), "farther"), (Pose(0, -1.7, 0.0), "joint"), (Pose(0, 1.6, 1.5), "farther")],
)
def test_what_is_out_of_reach_says_why_and_is_never_approved(pose, why):
    assert why in CELL.reach(pose)
    with pytest.raises(Unreachable) as caught:
        approve([Command("move", pose.x, pose.y, pose.z, 0, False, 7)], PARK, CELL)
    assert caught.value.line == 7


def test_a_straight_way_past_the_arms_axis_is_refused_though_both_ends_are_in_reach():
    cell = Cell(DobotConfig(scale=150.0, offset=(0.0, 0.0)))
    left, right = Pose(-1.6, 0.6, 0.1), Pose(1.6, 0.6, 0.1)
    assert cell.reach(left) is None and cell.reach(right) is None
    with pytest.raises(Unreachable):
        approve([Command("move", right.x, right.y, right.z, 0, False, 1)], left, cell)


# --- configuration -----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[dobot]\nscal = 75\n", r"no key dobot\.scal; did you mean dobot\.scale\?"),
        ("[dobot]\nscale = 1\n", r"armchat\.toml: scale must be in \[10, 300\].*dobot"),
        ("[dobot]\nspeed = 900\n", r"speed must be in \[1, 300\]"),
        ("[dobot]\nspeed = nan\n", r"speed must be in \[1, 300\]"),
        ("[dobot]\noffset = [900, 0]\n", "offset must lie within"),
        ("[dobot]\noffset = [240]\n", r"dobot\.offset"),
    ],
)
def test_a_bad_key_or_value_names_itself(tmp_path, text, message):
    (tmp_path / "armchat.toml").write_text(text)
    with pytest.raises(ConfigError, match=message):
        load({}, {}, tmp_path / "armchat.toml", tmp_path / "none")


def test_the_port_comes_from_anywhere(tmp_path):
    (tmp_path / "armchat.toml").write_text('[robot]\nkind = "dobot"\n[dobot]\nport = "/dev/a"\n')
    files = {"project": tmp_path / "armchat.toml", "user": tmp_path / "none"}
    assert load({}, {}, **files).dobot.port == "/dev/a"
    assert load({}, {"ARMCHAT_DOBOT__PORT": "/dev/b"}, **files).dobot.port == "/dev/b"
    assert load({"dobot.port": "/dev/c"}, {}, **files).dobot.port == "/dev/c"
    assert load({}, {}, **files).robot.kind == "dobot"

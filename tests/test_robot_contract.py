"""What every arm does alike: one specification, run over the ideal table, PyBullet and a Dobot.

The Dobot is the emulated one, sped up; its table is what its measured motion would do to the ideal
one (`robot_bridge.belief`), so that it feels nothing and senses nothing held.
"""

import math
import platform
import sys
import threading
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from typing import NamedTuple

import pytest

from agent.config import DobotConfig
from agent.errors import NotReady, RobotError, Stopped, Unreachable
from agent.messages import Command
from robot_bridge.api import PARK, Robot, Simulated, approve, parking
from robot_bridge.emulator import Emulator
from robot_bridge.ideal import IdealRobot
from scene.tray import tray_positions
from scene.types import Scene, SceneObject

WHEEL = sys.platform == "linux" and platform.machine() == "x86_64"


class Kind(NamedTuple):
    """A robot and its tolerances (table units, radians): placing, pushing, the tool, turning.

    ``senses``: it knows whether it holds something, and is stopped by what it comes down upon.
    """

    name: str
    place: float
    push: float
    tool: float
    turn: float
    senses: bool = True


IDEAL = Kind("ideal", 1e-6, 1e-6, 1e-6, 1e-6)
BULLET = Kind("bullet", 0.0025, 0.015, 0.002, math.radians(1))
"""0.5 mm placed, 3 mm pushed, 0.4 mm of the tool, 1 degree on the 0.40 m table."""

DOBOT = Kind("dobot", 1e-5, 1e-5, 1e-5, 1e-5, senses=False)
"""What float32 leaves of a position. At 50 mm a unit, so that the tray is within its reach."""
PACE = 40.0

NO_WHEEL = pytest.mark.skipif(not WHEEL, reason="PyBullet has no wheel here")


@pytest.fixture(
    params=[IDEAL, pytest.param(BULLET, marks=NO_WHEEL), DOBOT], ids=lambda kind: kind.name
)
def kind(request):
    return request.param


@pytest.fixture
def robot(kind):
    with make(kind) as made:
        yield made


@contextmanager
def make(kind, pace=0.0) -> Iterator[Simulated]:
    with ExitStack() as stack:
        if kind.name == "ideal":
            made = IdealRobot(pace=pace)
        elif kind.name == "bullet":
            from robot_bridge.bullet import BulletRobot

            made = BulletRobot(pace=pace)
        else:
            made = dobot(stack)
        stack.callback(made.close)
        yield made


def dobot(stack):
    from robot_bridge.dobot_arm import DobotRobot

    emulator = stack.enter_context(Emulator(speed=PACE))
    config = DobotConfig(port=emulator.port, scale=50.0, speed=300.0, acceleration=400.0)
    made = DobotRobot(config, pace=PACE)
    made.reset()
    made.home()
    return made


def thing(name, x=None, y=None, width=0.12, height=0.12, tall=0.10, **more):
    sizes = {"width": width, "height": height, "tall": tall}
    return SceneObject(id=f"{name}_1", name=name, x=x, y=y, **sizes, **more)


APPLE = thing("apple", -0.4, 0.2)
BLOCK = thing("block", -0.5, -0.5, 0.2, 0.2, 0.2)
BOWL = thing("bowl", 0.3, 0.6, 0.36, 0.36, 0.12)
BOTTLE = thing("bottle", 0.55, -0.1, 0.1, 0.1, 0.3)
ORANGE = thing("orange", on="tray")
TABLE = Scene(objects=(APPLE, BLOCK, BOWL, BOTTLE), tray=(ORANGE,))


def move(x, y, z, r=0.0):
    return Command("move", x, y, z, r, False)


def grip(on):
    return Command("grip", 0.0, 0.0, 0.0, 0.0, on)


def pick(item):
    x, y = item.position
    return [move(x, y, 0.9), move(x, y, item.top), grip(True), move(x, y, 0.9)]


def place(item, x, y, base=0.0):
    return [move(x, y, 0.9), move(x, y, base + item.tall), grip(False), move(x, y, 0.9)]


def push(start, goal, z=0.04):
    return [move(*start, 0.9), move(*start, z), move(*goal, z), move(*goal, 0.9)]


def load(robot, scene):
    """Begin with this scene, the arm parked; one that is real does not move for it by itself."""
    if not robot.limits.simulated:
        away = [grip(False), *parking(robot.pose())]
        list(robot.run(approve(away, robot.pose(), robot)))
    robot.load(scene)


def tells(step, kind, held):
    """Whether a step says so of what is held; None where that is not sensed."""
    return step.held is (held if kind.senses else None)


def perform(robot, commands, scene=TABLE):
    load(robot, scene)
    return list(robot.run(approve(commands, robot.pose(), robot)))


def where(robot, item):
    return robot.scene().get(item.id)


def others_stay(robot, kind, *moved):
    for item in TABLE.objects:
        if item not in moved:
            now = where(robot, item)
            assert math.dist(now.position, item.position) <= kind.place, f"{item.id} moved"
            assert now.on == "table" and now.upright


# --- the tool ----------------------------------------------------------------------------------


def test_it_is_a_simulated_robot(robot):
    assert isinstance(robot, Robot) and isinstance(robot, Simulated)


def test_it_starts_parked(robot, kind):
    pose = robot.pose()
    assert math.dist((pose.x, pose.y, pose.z), (PARK.x, PARK.y, PARK.z)) <= kind.tool


def test_each_primitive_is_reported_with_what_was_told_and_reached(robot, kind):
    steps = perform(robot, [move(0.5, 0.3, 0.9, 0.5), move(0.5, 0.3, 0.5, 0.5), grip(True)])
    assert [(step.index, step.count) for step in steps] == [(0, 3), (1, 3), (2, 3)]
    for step in steps:
        told, reached = step.told, step.reached
        gap = math.dist((told.x, told.y, told.z), (reached.x, reached.y, reached.z))
        assert gap <= kind.tool and abs(told.r - reached.r) <= kind.turn
    assert steps[-1].reached.grip


def test_the_pose_is_where_the_last_move_ended(robot, kind):
    perform(robot, [move(-0.3, 0.4, 0.7)])
    pose = robot.pose()
    assert math.dist((pose.x, pose.y, pose.z), (-0.3, 0.4, 0.7)) <= kind.tool


def test_home_is_the_parking_pose(robot, kind):
    perform(robot, [move(-0.3, 0.4, 0.3)])
    perform(robot, parking(robot.pose()))
    pose = robot.pose()
    assert math.dist((pose.x, pose.y, pose.z), (PARK.x, PARK.y, PARK.z)) <= kind.tool


def test_it_runs_nothing_but_an_approved_plan(robot):
    with pytest.raises(TypeError):
        robot.run([move(0, 0, 0.9)])


def test_a_point_outside_the_workspace_is_never_approved(robot):
    with pytest.raises(Unreachable):
        approve([move(3.0, 0, 0.9)], robot.pose(), robot)


# --- pick and place ----------------------------------------------------------------------------


def test_a_picked_thing_hangs_in_the_gripper(robot, kind):
    steps = perform(robot, pick(APPLE))
    apple = where(robot, APPLE)
    assert tells(steps[-1], kind, True) and apple.held and apple.on == "gripper"
    assert apple.z == pytest.approx(0.9 - APPLE.tall, abs=2 * kind.place)


def test_pick_and_place_on_the_table(robot, kind):
    steps = perform(robot, pick(APPLE) + place(APPLE, 0.0, 0.0))
    apple = where(robot, APPLE)
    assert tells(steps[-1], kind, False) and not apple.held
    assert apple.on == "table" and apple.upright
    assert math.dist(apple.position, (0.0, 0.0)) <= kind.place
    others_stay(robot, kind, APPLE)


def test_a_thing_is_stacked_on_another(robot, kind):
    perform(robot, pick(APPLE) + place(APPLE, *BLOCK.position, BLOCK.tall))
    apple = where(robot, APPLE)
    assert apple.on == BLOCK.id and apple.z == pytest.approx(BLOCK.tall, abs=kind.push)
    others_stay(robot, kind, APPLE)


def test_a_thing_released_over_a_bowl_lies_in_it(robot, kind):
    perform(robot, pick(APPLE) + place(APPLE, *BOWL.position, BOWL.tall))
    apple = where(robot, APPLE)
    assert apple.on == BOWL.id and apple.z < 0.05
    others_stay(robot, kind, APPLE)


def test_what_lies_in_a_bowl_goes_along_when_the_bowl_is_carried(robot):
    apple_in = pick(APPLE) + place(APPLE, *BOWL.position, BOWL.tall)
    perform(robot, apple_in + pick(BOWL) + place(BOWL, -0.4, 0.5))
    apple, bowl = where(robot, APPLE), where(robot, BOWL)
    assert apple.on == BOWL.id and bowl.on == "table"
    assert math.dist(apple.position, bowl.position) < 0.12


def test_turning_the_tool_turns_what_it_holds(robot, kind):
    x, y = BLOCK.position
    perform(robot, [*pick(BLOCK), move(x, y, 0.9, 0.6), move(x, y, BLOCK.tall, 0.6), grip(False)])
    block = where(robot, BLOCK)
    assert block.r == pytest.approx(0.6, abs=kind.turn)
    assert math.dist(block.position, BLOCK.position) <= kind.place


def test_a_grip_on_nothing_holds_nothing(robot, kind):
    steps = perform(robot, [move(0, 0, 0.9), move(0, 0, 0.05), grip(True)])
    assert tells(steps[-1], kind, False)
    assert not any(item.held for item in robot.scene())
    others_stay(robot, kind)


def test_a_grip_far_above_a_thing_holds_nothing(robot, kind):
    steps = perform(robot, [move(*APPLE.position, 0.9), move(*APPLE.position, 0.2), grip(True)])
    assert tells(steps[-1], kind, False)
    assert not any(item.held for item in robot.scene())


def test_a_tray_object_is_picked_from_its_waiting_place(robot, kind):
    waits = thing("orange", *tray_positions(TABLE)[ORANGE.id])
    perform(robot, pick(waits) + place(ORANGE, 0.0, 0.0))
    scene = robot.scene()
    orange = scene.get(ORANGE.id)
    assert scene.tray == () and scene.objects[-1].id == ORANGE.id
    assert orange.on == "table" and math.dist(orange.position, (0, 0)) <= kind.place
    others_stay(robot, kind)


def test_the_tray_closes_up_between_two_plans(robot, kind):
    lemon = thing("lemon", on="tray")
    load(robot, Scene(tray=(ORANGE, lemon)))
    for waiting, x in ((ORANGE, -0.3), (lemon, 0.3)):
        waits = thing(waiting.name, *tray_positions(robot.scene())[waiting.id])
        plan = approve(pick(waits) + place(waiting, x, 0.0), robot.pose(), robot)
        list(robot.run(plan))
    assert [item.on for item in robot.scene().objects] == ["table", "table"]


# --- pushing -----------------------------------------------------------------------------------


def test_a_push_slides_a_thing_ahead_of_the_tool(robot, kind):
    perform(robot, push((-0.26, 0.2), (-0.56, 0.2)))
    apple = where(robot, APPLE)
    ahead = -0.56 - 0.04 - APPLE.width / 2
    assert apple.x == pytest.approx(ahead, abs=kind.push)
    assert apple.y == pytest.approx(0.2, abs=kind.push)
    assert apple.on == "table" and apple.upright
    others_stay(robot, kind, APPLE)


def test_a_push_past_the_edge_ends_on_the_floor(robot, kind):
    perform(robot, push((-0.26, 0.2), (-1.1, 0.2)))
    apple = where(robot, APPLE)
    assert apple.on == "floor" and apple.x < -1.0 and apple.z == 0.0
    others_stay(robot, kind, APPLE)


def test_a_thing_on_the_floor_stays_where_it_fell(robot, kind):
    perform(robot, push((-0.26, 0.2), (-1.1, 0.2)))
    fell = where(robot, APPLE)
    again = approve(push((-1.0, 0.2), (-1.5, 0.2)), robot.pose(), robot)
    list(robot.run(again))
    now = where(robot, APPLE)
    assert now.on == "floor" and math.dist(now.position, fell.position) <= kind.place


def test_a_pushed_thing_pushes_the_next(robot, kind):
    second = thing("box", -0.65, 0.2, 0.14, 0.14, 0.1)
    scene = Scene(objects=(thing("block", -0.4, 0.2), second))
    perform(robot, push((-0.26, 0.2), (-0.6, 0.2)), scene)
    block, box = robot.scene().objects
    assert block.x == pytest.approx(-0.70, abs=kind.push)
    assert box.x == pytest.approx(-0.83, abs=2 * kind.push)


def test_what_stands_on_a_pushed_thing_goes_along(robot, kind):
    stack = pick(APPLE) + place(APPLE, *BLOCK.position, BLOCK.tall)
    perform(robot, stack + push((-0.3, -0.5), (-0.5, -0.5)))
    apple, block = where(robot, APPLE), where(robot, BLOCK)
    assert block.x == pytest.approx(-0.64, abs=kind.push)
    assert apple.on == BLOCK.id
    assert math.dist(apple.position, block.position) <= kind.push


@pytest.mark.parametrize(("mm", "upright"), [(8, True), (28, True), (45, False)])
def test_a_padlock_slides_when_pushed_low_and_topples_when_pushed_high(robot, mm, upright):
    padlock = thing("padlock", 0.0, 0.0, 0.21, 0.10, 0.325)
    perform(robot, push((0.0, -0.2), (0.0, 0.1), z=mm / 200), Scene(objects=(padlock,)))
    assert where(robot, padlock).upright is upright


@pytest.mark.parametrize(
    ("name", "wide", "tall", "z", "upright"),
    [
        ("candle", 0.20, 0.50, 0.32, True),  # 1.6 extents up: below extent / (2 * 0.3)
        ("candle", 0.20, 0.50, 0.42, False),  # 2.1
        ("bottle", 0.26, 0.60, 0.41, True),
        ("bottle", 0.26, 0.60, 0.55, False),
        ("candle", 0.20, 0.36, 0.35, False),  # 1.75, by the smooth lip of the tool
        ("bottle", 0.26, 0.48, 0.47, False),
        ("can", 0.265, 0.42, 0.41, True),
    ],
)
def test_a_thing_topples_above_the_height_that_friction_allows_and_slides_below_it(
    robot, name, wide, tall, z, upright
):
    """In between, from 1.67 to 1.95 extents up, a simulated tool with friction topples by its lip
    only (evals/LOG.md)."""
    item = thing(name, 0.0, 0.0, wide, wide, tall)
    start = -wide / 2 - 0.08
    perform(robot, push((start, 0.0), (wide, 0.0), z=z), Scene(objects=(item,)))
    assert where(robot, item).upright is upright


def test_a_tall_thing_pushed_low_stays_upright(robot):
    perform(robot, push((0.7, -0.1), (0.4, -0.1), z=0.04))
    assert where(robot, BOTTLE).upright


def test_a_tall_thing_pushed_high_topples_away_from_the_tool(robot):
    perform(robot, push((0.7, -0.1), (0.5, -0.1), z=0.25))
    bottle = where(robot, BOTTLE)
    assert not bottle.upright and bottle.on == "table"
    assert bottle.x < BOTTLE.x - 0.1
    assert bottle.tall == pytest.approx(BOTTLE.width, abs=0.02)
    assert bottle.width == pytest.approx(BOTTLE.tall, abs=0.02)


def test_a_tool_that_comes_down_onto_a_thing_stops_at_its_top(robot, kind):
    if not kind.senses:
        pytest.skip("nothing on its table: the check refuses to press upon things")
    steps = perform(robot, [move(*BLOCK.position, 0.9), move(*BLOCK.position, 0.05)])
    assert steps[-1].reached.z == pytest.approx(BLOCK.tall, abs=0.01)
    others_stay(robot, kind)


# --- stop, reset, close ------------------------------------------------------------------------


def test_a_stop_from_another_thread_ends_the_run(kind):
    with make(kind, pace=0.2) as robot:
        stopped_on_the_way(robot)


def stopped_on_the_way(robot):
    load(robot, TABLE)
    plan = approve([move(1, 1, 0.9), move(-1, -1, 0.9)] * 20, robot.pose(), robot)
    ended: list[BaseException] = []
    moving = threading.Event()

    def run():
        try:
            for _ in robot.run(plan):
                moving.set()
        except RobotError as error:
            ended.append(error)

    thread = threading.Thread(target=run)
    thread.start()
    assert moving.wait(30)
    robot.stop()
    thread.join(30)
    assert not thread.is_alive()
    assert [type(error) for error in ended] == [Stopped]


def test_a_stop_latches_until_reset(robot):
    load(robot, TABLE)
    robot.stop()
    plan = approve([move(0, 0, 0.9)], robot.pose(), robot)
    with pytest.raises(NotReady):
        robot.run(plan)
    before = robot.pose()
    robot.reset()
    assert robot.pose() == before
    assert len(list(robot.run(plan))) == 1


def test_a_stop_between_two_steps_keeps_the_grip(robot):
    load(robot, TABLE)
    steps = robot.run(approve(pick(APPLE) + place(APPLE, 0, 0), robot.pose(), robot))
    for step in steps:
        if step.reached.grip:
            break
    robot.stop()
    with pytest.raises(Stopped) as error:
        next(steps)
    assert error.value.by
    assert where(robot, APPLE).held


def test_two_plans_never_run_at_once(robot):
    load(robot, TABLE)
    plan = approve([move(0, 0, 0.9), move(0.5, 0, 0.9)], robot.pose(), robot)
    first = robot.run(plan)
    next(first)
    with pytest.raises(NotReady):
        robot.run(plan)
    with pytest.raises(NotReady):
        robot.load(TABLE)
    assert len(list(first)) == 1


def test_a_plan_runs_from_where_it_begins_only(robot):
    load(robot, TABLE)
    plan = approve([move(0, 0, 0.9), move(0.5, 0, 0.9)], robot.pose(), robot)
    assert len(list(robot.run(plan))) == 2
    with pytest.raises(NotReady, match="plan again"):
        robot.run(plan)


def test_a_closed_robot_takes_nothing_more(robot):
    plan = approve([move(0, 0, 0.9)], robot.pose(), robot)
    robot.close()
    robot.reset()
    with pytest.raises(NotReady):
        robot.run(plan)


def test_load_starts_afresh(robot, kind):
    perform(robot, pick(APPLE))
    load(robot, TABLE)
    others_stay(robot, kind)
    assert robot.scene().tray == TABLE.tray
    pose = robot.pose()
    assert math.dist((pose.x, pose.y, pose.z), (PARK.x, PARK.y, PARK.z)) <= kind.tool


def test_the_same_plan_has_the_same_result(robot):
    plan = pick(APPLE) + place(APPLE, *BLOCK.position, BLOCK.tall) + push((0.7, -0.1), (0.4, -0.1))
    perform(robot, plan)
    first = robot.scene()
    perform(robot, plan)
    assert robot.scene() == first

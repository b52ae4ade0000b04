"""What only the arm with physics does: forces, pictures, a banner-free import, its geometry."""

import hashlib
import itertools
import math
import platform
import random
import resource
import subprocess
import sys
import zlib
from pathlib import Path

import msgspec
import numpy as np
import pytest

from agent.errors import ConfigError
from agent.messages import Command
from robot_bridge import objects
from robot_bridge.api import PARK, TRAVEL_SPEED, approve
from robot_bridge.body import Body
from robot_bridge.drawing import arm_links
from robot_bridge.ideal import IdealRobot, predict
from robot_bridge.kinematics import Joints, forward, inverse
from robot_bridge.motion import ACCELERATION, along, profile
from robot_bridge.physics import STEP
from robot_bridge.png import png
from robot_bridge.standing import oriented, support_of
from scene.generate import CLASSES, random_scene
from scene.types import Pose, Scene, SceneObject

needs_wheel = pytest.mark.skipif(
    not (sys.platform == "linux" and platform.machine() == "x86_64"),
    reason="PyBullet has no wheel here",
)


@pytest.fixture
def robot():
    from robot_bridge.bullet import BulletRobot

    made = BulletRobot()
    yield made
    made.close()


def thing(name, x, y, width, height, tall, **more):
    sizes = {"width": width, "height": height, "tall": tall}
    return SceneObject(id=f"{name}_1", name=name, x=x, y=y, **sizes, **more)


def lift(robot, item, to):
    x, y = item.position
    robot.load(Scene(objects=(item,)))
    commands = [
        Command("move", x, y, 1.2, 0, False),
        Command("move", x, y, item.tall, 0, False),
        Command("grip", 0, 0, 0, 0, True),
        Command("move", x, y, to, 0, False),
    ]
    return list(robot.run(approve(commands, robot.pose(), robot)))


# --- forces ------------------------------------------------------------------------------------


@needs_wheel
@pytest.mark.parametrize(("side", "lifted"), [(0.678, True), (0.777, False)])
def test_suction_lifts_a_kilogram_and_not_one_and_a_half(robot, side, lifted):
    """Cubes of 400 kg/m3 and 1.0, 1.5 kg, give or take the seed's 5 %."""
    cube = thing("cube", 0.0, 0.0, side, side, side)
    steps = lift(robot, cube, 1.3)
    assert steps[2].held is True
    assert steps[3].held is lifted


@needs_wheel
def test_suction_needs_a_level_surface(robot):
    apple = thing("apple", 0.0, 0.0, 0.36, 0.36, 0.36)
    robot.load(Scene(objects=(apple,)))
    beside = [
        Command("move", 0.16, 0.0, 0.9, 0, False),
        Command("move", 0.16, 0.0, 0.25, 0, False),
        Command("grip", 0, 0, 0, 0, True),
    ]
    assert list(robot.run(approve(beside, robot.pose(), robot)))[-1].held is False


@needs_wheel
@pytest.mark.parametrize("noun", sorted(CLASSES))
def test_every_class_stands_where_it_is_put_and_can_be_picked_up(robot, noun):
    item = random_scene(random.Random(7), [noun]).objects[0]
    robot.load(Scene(objects=(item,)))
    rests = robot.scene().objects[0]
    assert rests.upright and rests.on == "table"
    assert math.dist(rests.position, item.position) < 0.005
    steps = lift(robot, item, 1.2)
    assert steps[-1].held is True


# --- determinism -------------------------------------------------------------------------------

SCRIPT = """
import hashlib, random, msgspec
from agent.messages import Command
from robot_bridge.api import approve
from robot_bridge.bullet import BulletRobot
from scene.generate import random_scene
robot = BulletRobot(seed=3)
scene = random_scene(random.Random(5), ["apple", "banana", "cup", "bottle"])
for turn in range(3):
    if turn:  # what was on the table before leaves no trace
        robot.load(random_scene(random.Random(turn), ["plate", "can", "orange"]))
    robot.load(scene)
    moves = [(-0.9, 0.0, 0.9), (-0.9, 0.0, 0.05), (0.9, 0.1, 0.05), (0.9, 0.1, 0.9)]
    told = [Command("move", *move, 0.0, False) for move in moves]
    list(robot.run(approve(told, robot.pose(), robot)))
    print(hashlib.sha256(msgspec.json.encode(robot.scene())).hexdigest())
"""


@needs_wheel
def test_two_processes_and_three_loads_give_one_hash():
    runs = [
        subprocess.run(
            [sys.executable, "-c", SCRIPT], capture_output=True, text=True, check=True
        ).stdout.split()
        for _ in range(2)
    ]
    assert len(runs[0]) == 3
    assert len(set(runs[0] + runs[1])) == 1


@needs_wheel
def test_a_picture_changes_nothing(robot):
    scene = random_scene(random.Random(5), ["apple", "banana", "cup"])
    told = [Command("move", 0.5, y, 0.06, 0.0, False) for y in (-1.0, 0.5)]
    hashes = []
    for look in (False, True):
        robot.load(scene)
        for _ in robot.run(approve(told, robot.pose(), robot)):
            if look:
                robot.picture(64, 48)
        hashes.append(hashlib.sha256(msgspec.json.encode(robot.scene())).hexdigest())
    assert hashes[0] == hashes[1]


@needs_wheel
def test_a_load_leaks_nothing(robot):
    """The engine keeps the vertices that it is handed: 8 kB a shape, unless they are lent."""
    scenes = [random_scene(random.Random(i), ["apple", "bottle", "plate", "cup"]) for i in range(3)]
    for turn in range(30):
        robot.load(scenes[turn % 3])
    before = resident()
    for turn in range(60):
        robot.load(scenes[turn % 3])
    assert resident() - before < 1.0


def resident() -> float:
    """Megabytes of this process."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * resource.getpagesize() / 2**20


# --- speed -------------------------------------------------------------------------------------


@needs_wheel
@pytest.mark.parametrize("share", [1.0, 0.3])
def test_no_motion_is_faster_than_the_share_of_its_speed(share):
    from robot_bridge.bullet import BulletRobot

    robot = BulletRobot(speed=share)
    told = []
    aim = robot._world.aim
    robot._world.aim = lambda pose: (told.append(pose), aim(pose))
    commands = [
        Command("move", -1.0, 0.0, 0.9, 0, False),
        Command("move", 1.0, 0.0, 0.9, 1.5, False),
        Command("move", 1.0, 0.0, 0.1, 1.5, False),
    ]
    list(robot.run(approve(commands, robot.pose(), robot)))
    robot.close()
    steps = [math.dist((a.x, a.y, a.z), (b.x, b.y, b.z)) for a, b in itertools.pairwise(told)]
    fastest = max(steps) / STEP
    assert 0.9 * share * TRAVEL_SPEED < fastest <= share * TRAVEL_SPEED + 1e-6


def test_a_plan_takes_longer_at_a_share_of_the_speed():
    commands = [Command("move", 1.0, 0.0, 0.9, 2.0, False)]
    full, slow = (
        approve(commands, PARK, IdealRobot(speed=share)).durations[0] for share in (1.0, 0.25)
    )
    assert 3.0 < slow / full < 4.0


@pytest.mark.parametrize("share", [0.0, -0.1, 1.01, math.nan])
def test_a_speed_beyond_the_full_one_is_refused(share):
    with pytest.raises(ConfigError, match="at most 100 %"):
        IdealRobot(speed=share)


# --- what it shows -----------------------------------------------------------------------------


@needs_wheel
def test_the_overhead_picture_shows_things_where_they_are(robot):
    red = thing("block", 0.5, 0.5, 0.3, 0.3, 0.1, color="red")
    blue = thing("block", -0.5, -0.5, 0.3, 0.3, 0.1, color="blue")
    blue = msgspec.structs.replace(blue, id="block_2")
    robot.load(Scene(objects=(red, blue)))
    picture = robot.picture(160, 120)
    assert picture.shape == (120, 160, 3) and picture.dtype.name == "uint8"
    warm = picture[..., 0].astype(int) - picture[..., 2]
    row, column = divmod(int(warm.argmax()), 160)
    assert row < 60 and column > 80
    row, column = divmod(int(warm.argmin()), 160)
    assert row > 60 and column < 80


@needs_wheel
def test_a_picture_at_rest_is_the_one_before_and_a_later_one_is_not(robot):
    block = thing("block", 0.0, 0.0, 0.3, 0.3, 0.1, color="red")
    robot.load(Scene(objects=(block,)))
    drawn = []
    photograph = robot._photograph
    robot._photograph = lambda *size: drawn.append(size) or photograph(*size)
    first, again = robot.picture(64, 48), robot.picture(64, 48)
    assert (first == again).all() and len(drawn) == 1
    told = [
        Command("move", x, 0.0, z, 0.0, False) for x, z in ((0.5, 0.9), (0.5, 0.04), (0.2, 0.04))
    ]
    list(robot.run(approve(told, robot.pose(), robot)))
    assert (robot.picture(64, 48) != first).any() and len(drawn) == 2


@needs_wheel
def test_a_window_without_a_display_is_refused_in_words(monkeypatch):
    from robot_bridge.bullet import BulletRobot

    monkeypatch.delenv("DISPLAY", raising=False)
    with pytest.raises(ConfigError, match="needs a display"):
        BulletRobot(gui=True)


def test_a_png_holds_the_picture():
    pixels = np.arange(2 * 3 * 3, dtype=np.uint8).reshape(2, 3, 3)
    data = png(pixels)
    assert data.startswith(b"\x89PNG\r\n\x1a\n") and data[16:24] == bytes((0, 0, 0, 3, 0, 0, 0, 2))
    start = data.index(b"IDAT") + 4
    rows = zlib.decompress(data[start : start + int.from_bytes(data[start - 8 : start - 4])])
    assert rows == b"".join(b"\0" + row.tobytes() for row in pixels)


@needs_wheel
def test_it_writes_nothing_past_python():
    script = "from robot_bridge.bullet import BulletRobot\nBulletRobot()\nprint('said')"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (0, "said\n", "")


# --- shapes (pure) -----------------------------------------------------------------------------


@pytest.mark.parametrize("noun", [*sorted(CLASSES), "thingamajig"])
def test_a_shape_fills_its_box_and_stays_inside_it(noun):
    size = (0.4, 0.3, 0.5)
    model = objects.model(noun, *size)
    points = [point for ring in model.rings for point in ring]
    for part in model.parts:
        cos, sin = abs(math.cos(part.yaw)), abs(math.sin(part.yaw))
        a, b, c = part.half
        reach = (a * cos + b * sin, a * sin + b * cos, c)
        for sign in (-1, 1):
            points.append(tuple(at + sign * r for at, r in zip(part.at, reach, strict=True)))
    for axis, side in enumerate(size):
        values = [point[axis] for point in points]
        assert max(values) <= side / 2 + 0.03 and min(values) >= -side / 2 - 0.03
        assert max(values) - min(values) >= 0.7 * side
    assert len(model.parts) <= objects.MOST_PARTS


def test_a_surface_is_closed_and_faces_outwards():
    model = objects.model("apple", 0.3, 0.3, 0.3)
    points, indices = objects.triangles(model.rings)
    edges: dict[tuple[int, int], int] = {}
    for first in range(0, len(indices), 3):
        a, b, c = indices[first : first + 3]
        for edge in ((a, b), (b, c), (c, a)):
            edges[edge] = edges.get(edge, 0) + 1
    assert all(count == 1 and edges.get((b, a)) == 1 for (a, b), count in edges.items())
    volume = 0.0
    for first in range(0, len(indices), 3):
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (points[i] for i in indices[first : first + 3])
        volume += ax * (by * cz - bz * cy) - ay * (bx * cz - bz * cx) + az * (bx * cy - by * cx)
    assert volume > 0


def test_a_lying_thing_swaps_tall_with_the_side_that_points_up():
    over_y = (1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0)
    width, height, tall, r, upright = oriented((0.1, 0.2, 0.5), over_y)
    assert (width, height, tall, upright) == (0.1, 0.5, 0.2, False)
    assert r == pytest.approx(0.0)


@needs_wheel
def test_the_tool_is_smooth_only_where_all_on_its_way_is_met_near_its_top(robot):
    candle, block = thing("candle", 0.0, 0.0, 0.2, 0.2, 0.36), thing("block", 0.6, 0, 0.2, 0.2, 0.5)
    robot.load(Scene(objects=(candle, block)))
    world = robot._world
    ways = [((-0.4, 0.35), (0.2, 0.35)), ((-0.4, 0.2), (0.2, 0.2)), ((-0.4, 0.35), (0.6, 0.35)),
            ((-0.4, 1.0), (0.6, 1.0))]  # fmt: skip
    found = []
    for (x, z), (to_x, to_z) in ways:
        world.target = Pose(x, 0.0, z, 0.0)
        world.face(Pose(to_x, 0.0, to_z, 0.0))
        found.append(world.smooth)
    assert found == [True, False, False, False]


@needs_wheel
@pytest.mark.parametrize(("share", "upright"), [(1.6, True), (1.72, False)])
@pytest.mark.parametrize("noun", ["vase", "candle"])
def test_what_is_pushed_near_its_top_topples_where_the_ideal_table_says(
    robot, noun, share, upright
):
    """From extent / (2 * friction) on: from 1.67 times its width."""
    item = thing(noun, 0.0, 0.0, 0.28, 0.28, share * 0.28 / 0.95)
    scene, z = Scene(objects=(item,)), share * 0.28
    way = [(-0.3, 1.2), (-0.3, z), (0.28, z), (0.28, 1.2)]
    commands = [Command("move", x, 0.0, height, 0.0, False) for x, height in way]
    robot.load(scene)
    list(robot.run(approve(commands, robot.pose(), robot)))
    assert robot.scene().get(item.id).upright is upright
    assert predict(commands, scene).get(item.id).upright is upright


@pytest.mark.parametrize(
    ("size", "z", "on"),
    [
        ((0.38, 0.26, 0.26), 0.32, "cup_1"),  # too wide, sunk into the mouth
        ((0.38, 0.26, 0.26), 0.38, "cup_1"),  # on the rim
        ((0.2, 0.2, 0.2), 0.03, "cup_1"),
        ((0.9, 0.9, 0.1), 0.0, "table"),
    ],
)
def test_what_lies_in_the_mouth_of_a_container_is_in_it(size, z, on):
    cup = Body(thing("cup", 0.0, 0.0, 0.41, 0.35, 0.39), 0.0, 0.0)
    item = Body(thing("lemon", 0.0, 0.0, *size, z=z), 0.0, 0.0)
    assert support_of(item, [cup]) == on


# --- motion and arm (pure) ---------------------------------------------------------------------


@pytest.mark.parametrize("length", [0.001, 0.1, 0.5, 3.0])
def test_a_motion_starts_and_ends_at_rest_and_keeps_its_limits(length):
    step, speed = 1 / 240, 1.25
    ways = [0.0, *profile(length, speed, step)]
    steps = [after - before for before, after in itertools.pairwise(ways)]
    assert ways[-1] == length
    assert all(0 <= way <= speed * step + 1e-9 for way in steps)
    changes = [b - a for a, b in zip([0.0, *steps], [*steps, 0.0], strict=True)]
    assert max(abs(change) for change in changes) <= ACCELERATION * step * step * 1.01


def test_a_motion_takes_the_short_way_round():
    poses = list(along(Pose(0, 0, 0.5, 3.0), Pose(0, 0, 0.5, -3.0), 1.25, 1 / 240))
    assert poses[-1] == Pose(0, 0, 0.5, pytest.approx(3.0 + math.remainder(-6.0, math.tau)))


def test_forward_kinematics_undo_the_inverse():
    rng = random.Random(1)
    for _ in range(200):
        joints = Joints(
            rng.uniform(-1.5, 1.5), rng.uniform(0.1, 1.4), rng.uniform(0.0, 1.4), rng.uniform(-1, 1)
        )
        pose = forward(joints)
        found = inverse(*pose)
        assert found is not None
        assert forward(found) == pytest.approx(pose, abs=1e-6)


def test_beyond_the_links_there_is_no_solution():
    assert inverse(400.0, 0.0, 0.0, 0.0) is None


@pytest.mark.parametrize("tip", [PARK, Pose(0, 0, 0.1), Pose(-1.7, 1.7, 0.0), Pose(1.0, -1.0, 0.9)])
def test_the_drawn_arm_is_one_piece_that_ends_above_the_cup(tip):
    links = arm_links(tip)
    for link, following in itertools.pairwise(links):
        assert link.end == following.start
    assert links[-1].end[:2] == (tip.x, tip.y)


@needs_wheel
@pytest.mark.parametrize(("name", "off"), [("brick", 0.03), ("coin", 0.03), ("can", 0.15)])
def test_a_tool_told_to_go_lower_ends_at_the_top_and_moves_nothing(robot, name, off):
    kind = CLASSES[name]
    item = thing(name, -0.3, 0.02, kind.width, kind.height, kind.tall)
    robot.load(Scene(objects=(item,)))
    way = [
        Command("move", -0.3, 0.02, z, 0.0, False) for z in (1.2, max(item.tall - off, 0.005), 1.2)
    ]
    steps = list(robot.run(approve(way, robot.pose(), robot)))
    assert steps[1].reached.z == pytest.approx(item.tall, abs=0.004)
    assert math.dist(robot.scene().objects[0].position, item.position) < 0.003

"""The ideal table: what exactly its tool does to things, and that a prediction is the robot."""

import math
import random

import msgspec
import pytest

from agent.messages import Command
from robot_bridge.api import approve
from robot_bridge.body import Body, heights_meet, inside, overlap
from robot_bridge.ideal import IdealRobot, predict, rehearse
from scene.generate import CLASSES, random_scene
from scene.tray import tray_positions
from scene.types import Pose, Scene, SceneObject


def thing(name, x=None, y=None, width=0.12, height=0.12, tall=0.10, **more):
    sizes = {"width": width, "height": height, "tall": tall}
    return SceneObject(**{"id": name, "name": name, "x": x, "y": y, **sizes, **more})


def table(*things):
    return Scene(objects=things)


def move(x, y, z, r=0.0):
    return Command("move", x, y, z, r, False)


def grip(on):
    return Command("grip", 0.0, 0.0, 0.0, 0.0, on)


def carry(item, x, y, base=0.0):
    from_x, from_y = item.position
    return [
        move(from_x, from_y, 0.9),
        move(from_x, from_y, item.top),
        grip(True),
        move(from_x, from_y, 0.9),
        move(x, y, 0.9),
        move(x, y, base + item.tall),
        grip(False),
        move(x, y, 0.9),
    ]


def push(start, goal, z=0.04):
    return [move(*start, 0.9), move(*start, z), move(*goal, z), move(*goal, 0.9)]


def at(scene, item):
    return scene.get(item.id)


# --- pushing -----------------------------------------------------------------------------------


@pytest.mark.parametrize("angle", [0.0, 0.3, math.pi / 4, 1.0, math.pi / 2, 2.5, -2.0])
def test_a_centred_push_moves_a_thing_along_its_direction_only(angle):
    block, (ux, uy) = thing("block", 0.0, 0.0), (math.cos(angle), math.sin(angle))
    after = at(predict(push((-0.4 * ux, -0.4 * uy), (0.3 * ux, 0.3 * uy)), table(block)), block)
    along, across = after.x * ux + after.y * uy, after.y * ux - after.x * uy
    assert across == pytest.approx(0.0, abs=1e-9)
    assert 0.3 + 0.04 + 0.06 - 1e-9 <= along <= 0.3 + 0.04 + 0.06 * math.sqrt(2) + 1e-9


def test_a_turned_thing_is_met_where_its_own_side_is():
    bar = thing("bar", 0.0, 0.0, 0.4, 0.1, r=math.pi / 2)
    after = at(predict(push((-0.3, 0.0), (0.1, 0.0)), table(bar)), bar)
    assert after.x == pytest.approx(0.1 + 0.04 + 0.05)


def test_a_chain_moves_by_what_is_left_of_the_way_after_the_gaps():
    one, two = thing("one", 0.0, 0.0), thing("two", 0.3, 0.0)
    after = predict(push((-0.2, 0.0), (0.2, 0.0)), table(one, two))
    assert at(after, one).x == pytest.approx(0.3)
    assert at(after, two).x == pytest.approx(0.42)


def test_a_thing_brushed_by_its_flank_is_shoved_aside_not_along():
    post = thing("post", 0.0, 0.0)
    after = at(predict(push((-0.4, 0.085), (0.4, 0.085)), table(post)), post)
    assert after.x == pytest.approx(0.0)
    assert after.y == pytest.approx(-0.015, abs=1e-3)


def test_a_long_thing_pushed_askew_meets_one_whose_middle_lies_behind_its_own():
    banana = thing("banana", -0.07, 0.18, 0.63, 0.22)
    knife = thing("knife", -0.3, -0.07, 0.67, 0.11, tall=0.06)
    after = predict(push((-0.37, 0.43), (-0.11, 0.22)), table(banana, knife))
    pushed, aside = at(after, banana), at(after, knife)
    assert pushed.y < 0.06 and aside.y < -0.2
    assert (pushed.height + aside.height) / 2 <= pushed.y - aside.y + 1e-3


def test_a_tool_that_misses_moves_nothing():
    post = thing("post", 0.0, 0.0)
    scene = table(post)
    assert predict(push((-0.4, 0.1), (0.4, 0.1)), scene) == scene
    assert predict(push((-0.4, 0.0), (0.4, 0.0), z=0.1), scene) == scene


def test_what_is_held_pushes_what_it_meets():
    apple, post = thing("apple", 0.0, 0.0), thing("post", 0.4, 0.0)
    plan = [move(0, 0, 0.9), move(0, 0, 0.1), grip(True), move(0.4, 0, 0.1)]
    after = predict(plan, table(apple, post))
    assert at(after, apple).x == pytest.approx(0.4)
    assert at(after, post).x == pytest.approx(0.52)


def test_a_stack_goes_off_the_edge_together():
    plate = thing("plate", -0.8, 0.0, 0.2, 0.2, 0.1)
    apple = thing("apple", -0.8, 0.0, z=0.1, on="plate")
    after = predict(push((-0.6, 0.0), (-1.1, 0.0)), table(plate, apple))
    assert [at(after, item).on for item in (plate, apple)] == ["floor", "floor"]


def test_the_upper_thing_alone_is_pushed_off_the_lower_one():
    block = thing("block", 0.0, 0.0, 0.2, 0.2, 0.2)
    apple = thing("apple", 0.0, 0.0, z=0.2, on="block")
    after = predict(push((0.2, 0.0), (-0.1, 0.0), z=0.25), table(block, apple))
    assert at(after, block) == block
    assert at(after, apple).on == "table" and at(after, apple).z == 0.0
    assert at(after, apple).x <= -0.16 + 1e-6


def test_things_in_the_tray_are_pushed_by_nothing():
    scene = Scene(tray=(thing("orange", on="tray"),))
    x, y = tray_positions(scene)["orange"]
    after = predict(push((x, y - 0.3), (x, y + 0.3)), scene)
    assert after == scene


def test_inside_a_bowl_the_tool_pushes_the_bowl_from_within():
    bowl = thing("bowl", 0.0, 0.0, 0.4, 0.4, 0.12)
    after = at(predict([move(0, 0, 0.9), move(0, 0, 0.05), move(0.3, 0, 0.05)], table(bowl)), bowl)
    assert after.x == pytest.approx(0.3 - (0.2 - 0.03 - 0.04))


# --- toppling ----------------------------------------------------------------------------------


@pytest.mark.parametrize(("lever", "upright"), [(0.16, True), (0.175, False)])
def test_a_thing_topples_above_extent_over_twice_the_friction(lever, upright):
    post = thing("post", 0.0, 0.0, 0.1, 0.1, 0.4)
    after = at(predict(push((-0.3, 0.0), (0.0, 0.0), z=lever), table(post)), post)
    assert after.upright is upright


def test_a_toppled_thing_lies_away_from_the_tool_with_its_sides_swapped():
    post = thing("post", 0.0, 0.0, 0.1, 0.12, 0.4)
    after = at(predict(push((-0.3, 0.0), (-0.08, 0.0), z=0.3), table(post)), post)
    assert (after.width, after.height, after.tall) == (0.4, 0.12, 0.1)
    assert after.x == pytest.approx(0.01 - 0.02 + 0.06 + 0.2)


def test_what_stands_on_a_toppled_thing_falls_off_it():
    post = thing("post", 0.0, 0.0, 0.14, 0.14, 0.5)
    cube = thing("cube", 0.0, 0.0, 0.1, 0.1, 0.1, z=0.5, on="post")
    after = predict(push((-0.3, 0.0), (-0.05, 0.0), z=0.4), table(post, cube))
    assert at(after, cube).on == "table" and at(after, cube).z == 0.0
    assert at(after, cube).x > 0.3


# --- coming down, gripping, releasing ----------------------------------------------------------


def test_a_motion_down_into_a_thing_ends_at_its_top_and_says_so():
    apple = thing("apple", 0.2, 0.2)
    scene, steps = rehearse([move(0.2, 0.2, 0.9), move(0.2, 0.2, 0.02)], table(apple))
    assert steps[1].told.z == 0.02
    assert steps[1].reached.z == pytest.approx(0.1)
    assert scene == table(apple)


def test_what_is_held_stops_on_what_is_below_it():
    apple, wide = thing("apple", 0.0, 0.0), thing("post", 0.4, 0.0, tall=0.2)
    plan = [*carry(apple, 0.48, 0.0)[:5], move(0.48, 0.0, 0.1)]
    scene, steps = rehearse(plan, table(apple, wide))
    assert steps[-1].reached.z == pytest.approx(0.3)
    assert at(scene, apple).held and at(scene, apple).z == pytest.approx(0.2)


def test_a_slanting_motion_ends_where_it_meets_a_top():
    block = thing("block", 0.0, 0.0, 0.4, 0.4, 0.2)
    _, steps = rehearse([move(-0.8, 0, 0.5), move(0.4, 0, 0.0)], table(block))
    assert steps[1].reached.x < 0.2 and steps[1].reached.z >= 0.2 - 0.02


def test_of_a_full_bowl_the_grip_takes_what_its_tip_touches():
    bowl = thing("bowl", 0.0, 0.0, 0.4, 0.4, 0.12)
    apple = thing("apple", 0.0, 0.0, z=0.012, tall=0.1, on="bowl")
    scene = table(bowl, apple)
    touch_apple = [move(0, 0, 0.9), move(0, 0, 0.112), grip(True)]
    touch_rim = [move(0, 0, 0.9), move(0, 0, 0.12), grip(True), move(0, 0, 0.5)]
    assert at(predict(touch_apple, scene), apple).held
    lifted = predict(touch_rim, scene)
    assert at(lifted, bowl).held and at(lifted, apple).z == pytest.approx(0.5 - 0.12 + 0.012)


def test_what_does_not_fit_into_a_cup_stands_on_its_rim():
    apple, cup = thing("apple", 0.0, 0.0), thing("cup", 0.5, 0.0, 0.1, 0.1, 0.2)
    after = at(predict(carry(apple, 0.5, 0.0, 0.2), table(apple, cup)), apple)
    assert after.on == "cup" and after.z == pytest.approx(0.2)


def test_a_second_thing_finds_room_beside_the_first_in_a_box():
    box = thing("box", 0.4, 0.0, 0.5, 0.5, 0.15)
    one, two = thing("one", -0.5, 0.5), thing("two", -0.5, -0.5)
    plan = carry(one, 0.4, 0.0, 0.15) + carry(two, 0.4, 0.0, 0.15)
    after = predict(plan, table(box, one, two))
    a, b = at(after, one), at(after, two)
    assert (a.on, b.on) == ("box", "box")
    assert a.z == b.z == pytest.approx(0.015)
    assert overlap(Body(a, a.x, a.y), Body(b, b.x, b.y)) <= 1e-4


def test_a_heap_in_a_container_still_lies_in_it():
    box = thing("box", 0.4, 0.0, 0.2, 0.2, 0.3)
    one, two = thing("one", -0.5, 0.5), thing("two", -0.5, -0.5)
    plan = carry(one, 0.4, 0.0, 0.3) + carry(two, 0.4, 0.0, 0.3)
    after = at(predict(plan, table(box, one, two)), two)
    assert after.on == "box" and after.z > 0.1


def test_a_heap_grows_where_it_is_lowest():
    box = thing("box", 0.4, 0.0, 0.5, 0.3, 0.3)
    tall, flat, third = (
        thing("tall", -0.5, 0.5, 0.2, 0.2, 0.2), thing("flat", -0.5, 0.0, 0.2, 0.2, 0.05),
        thing("third", -0.5, -0.5, 0.2, 0.2, 0.1),
    )  # fmt: skip
    plan = carry(tall, 0.3, 0.0, 0.3) + carry(flat, 0.5, 0.0, 0.3) + carry(third, 0.3, 0.0, 0.3)
    after = predict(plan, table(box, tall, flat, third))
    assert at(after, third).z == pytest.approx(at(after, flat).top)
    assert abs(at(after, third).x - at(after, flat).x) < 0.1


def test_what_is_shoved_off_a_heap_falls_and_what_the_walls_keep_in_does_not():
    bowl = thing("bowl", 0.0, 0.0, 0.4, 0.4, 0.25)
    base, heaped = thing("base", -0.6, 0.6, 0.34, 0.34, 0.24), thing("heaped", -0.6, -0.6)
    heap = carry(base, 0.0, 0.0, 0.25) + carry(heaped, 0.0, 0.0, 0.27)
    before = predict(heap, table(bowl, base, heaped))
    assert at(before, heaped).on == "bowl" and at(before, heaped).z > bowl.top
    shove = [move(-0.4, 0.0, 0.9), move(-0.4, 0.0, 0.31), move(0.3, 0.0, 0.31)]
    after = predict(heap + shove, table(bowl, base, heaped))
    assert (at(after, heaped).on, at(after, heaped).z) == ("table", 0.0)
    assert at(after, heaped).x > bowl.x + bowl.width / 2
    assert at(after, base).on == "bowl"


@pytest.mark.parametrize("across", [True, False])
def test_a_thing_lies_across_two_as_high_and_falls_between_two_that_are_not(across):
    left, right = thing("left", -0.08, 0.0), thing("right", 0.08, 0.0, tall=0.1 if across else 0.05)
    board = thing("board", -0.5, 0.5, 0.2, 0.1, 0.04)
    after = at(predict(carry(board, 0.0, 0.0, 0.1), table(left, right, board)), board)
    assert after.on == ("left" if across else "table")


def test_what_looks_out_of_a_box_a_little_does_not_carry_the_next_thing():
    box = thing("box", 0.4, 0.0, 0.5, 0.3, 0.2)
    one, two = thing("one", -0.5, 0.5, 0.1, 0.1, 0.22), thing("two", -0.5, -0.5, 0.1, 0.1, 0.1)
    plan = carry(one, 0.4, 0.0, 0.2) + carry(two, 0.4, 0.0, 0.3)
    after = at(predict(plan, table(box, one, two)), two)
    assert (after.on, after.z) == (
        "box",
        pytest.approx(at(predict(plan, table(box, one, two)), one).z),
    )


def test_a_thing_released_beyond_the_edge_falls_to_the_floor():
    apple = thing("apple", 0.0, 0.0)
    after = at(predict(carry(apple, 1.2, 0.0), table(apple)), apple)
    assert after.on == "floor" and after.x == pytest.approx(1.2) and after.z == 0.0


def test_a_dropped_thing_lands_on_the_table():
    apple = thing("apple", 0.0, 0.0)
    plan = [*carry(apple, 0.3, 0.3)[:5], grip(False)]
    after = at(predict(plan, table(apple)), apple)
    assert (after.on, after.z, after.held) == ("table", 0.0, False)


def test_a_second_grip_while_holding_changes_nothing():
    apple = thing("apple", 0.0, 0.0)
    plan = [*carry(apple, 0.3, 0.3)[:4], grip(True)]
    assert at(predict(plan, table(apple)), apple).held


def test_turning_carries_what_is_off_the_axis_around_it():
    bar = thing("bar", 0.0, 0.0, 0.4, 0.1)
    plan = [move(0.1, 0, 0.9), move(0.1, 0, 0.1), grip(True), move(0.1, 0, 0.9, math.pi / 2)]
    after = at(predict(plan, table(bar)), bar)
    assert after.position == pytest.approx((0.1, -0.1))
    assert after.r == pytest.approx(math.pi / 2)


# --- prediction and robot ----------------------------------------------------------------------


def test_a_prediction_starts_with_what_the_scene_says_is_held():
    apple = thing("apple", 0.0, 0.0)
    holding = predict(carry(apple, 0.3, 0.3)[:4], table(apple))
    placed = predict([move(0.3, 0.3, 0.9), move(0.3, 0.3, 0.1), grip(False)], holding)
    assert at(placed, apple).on == "table"
    assert at(placed, apple).position == pytest.approx((0.3, 0.3))


def test_a_prediction_may_start_from_any_pose():
    block = thing("block", 0.0, 0.0)
    after = predict([move(0.3, 0.0, 0.04)], table(block), Pose(-0.3, 0.0, 0.04))
    assert at(after, block).x == pytest.approx(0.4)


def test_nothing_happens_without_commands():
    scene = random_scene(random.Random(1), ["apple", "cup", "red star"], ["orange"])
    assert predict([], scene) == scene


@pytest.mark.parametrize("pace", [0.0, 0.001])
def test_the_robot_does_what_was_predicted(pace):
    rng = random.Random(4)
    for _ in range(3):
        scene = random_scene(rng, ["apple", "bottle", "bowl", "book"])
        commands = [*carry(scene.objects[0], 0.0, 0.0), *push((0.9, 0.9), (-0.9, -0.9))]
        robot = IdealRobot(scene, pace=pace)
        list(robot.run(approve(commands, robot.pose(), robot)))
        for got, said in zip(robot.scene().objects, predict(commands, scene).objects, strict=True):
            assert got.on == said.on and got.upright == said.upright
            assert math.dist(got.position, said.position) < (1e-9 if pace == 0 else 0.02)


def test_load_lets_go_of_what_the_scene_says_is_held():
    robot = IdealRobot()
    robot.load(table(thing("apple", 0.1, 0.1, z=0.8, on="gripper", held=True)))
    apple = robot.scene().objects[0]
    assert (apple.on, apple.held, apple.z) == ("table", False, 0.0)


def random_plan(rng, scene):
    item = rng.choice(scene.objects)
    if rng.random() < 0.5:
        return carry(item, rng.uniform(-0.9, 0.9), rng.uniform(-0.9, 0.9), rng.uniform(0, 0.4))
    ends = [(rng.uniform(-1.1, 1.1), rng.uniform(-1.1, 1.1)) for _ in range(2)]
    return push(*ends, z=rng.uniform(0.03, 0.3))


@pytest.mark.parametrize("seed", range(40))
def test_whatever_happens_things_stay_things(seed):
    """Random plans: no two things in one place, none half on the table or in mid-air, ids and
    sizes kept."""
    rng = random.Random(seed)
    scene = random_scene(rng, rng.choices(list(CLASSES), k=5))
    for _ in range(4):
        after = predict(random_plan(rng, scene), scene)
        assert [item.id for item in after] == [item.id for item in scene]
        for old, new in zip(scene, after, strict=True):
            sizes = sorted((new.width, new.height, new.tall))
            assert sizes == sorted((old.width, old.height, old.tall))
        bodies = [Body(o, *o.position) for o in after.objects if o.on != "floor" and not o.held]
        for body in bodies:
            if body.on == "table":
                assert max(abs(body.x), abs(body.y)) <= 1.0 + 1e-6
            for other in bodies:
                if body.on == other.id:
                    assert overlap(body, other) > 0, f"{body.id} is beside {other.id}, not on it"
                if other is not body and heights_meet(body, other):
                    nested = inside(body, other) or inside(other, body)
                    assert nested or overlap(body, other) <= 5e-3, f"{body.id} in {other.id}"
        scene = msgspec.structs.replace(after)

"""What the check calls unsafe to let go, to carry past things, or to come down upon."""

import msgspec
import pytest
from check_world import SCENE, checks, only, pick_and_place, thing

from agent.landing import supported
from agent.messages import KeepOut
from robot_bridge import ideal
from scene.types import Scene


@pytest.fixture
def checked(executor):
    return checks(executor)


@pytest.fixture
def ideally(executor):
    """Checked with the forecast of the ideal table."""
    return checks(executor, ideal.predict)


# --- what is let go -----------------------------------------------------------------------------


def test_letting_go_where_another_stands_is_unsafe(checked):
    program = pick_and_place("apple", "orange.x + 0.05", "orange.y", "apple.tall")
    problem = only(checked(program, touched=["apple_1"]))
    assert (problem.reason, problem.object, problem.line) == ("unsafe", "apple_1", 7)
    assert "where the orange stands" in problem.text


def test_setting_down_on_something_far_too_small_is_unsafe(checked):
    program = pick_and_place("plate", "bottle.x", "bottle.y", "bottle.tall + plate.tall")
    scene = Scene(objects=tuple(item for item in SCENE.objects if item.name != "cherry"))
    assert "not stand safely on the bottle" in only(checked(program, scene)).text


def test_letting_go_beyond_the_edge_is_unsafe_even_for_a_named_object(checked):
    program = pick_and_place("apple", 1.2, 0, "apple.tall")
    problem = only(checked(program, touched=["apple_1"]))
    assert "dropped off the table" in problem.text and problem.line == 7


def test_an_arrange_program_that_demands_an_overlap_is_unsafe(checked):
    scene = Scene(objects=(thing("cube", 0.0, 0.0),), tray=(thing("apple"),))
    program = """\
solver.addConstraint(apple.x == cube.x + 0.02)
solver.addConstraint(apple.y == cube.y)"""
    assert only(checked(program, scene, "arrange")).object == "apple_1"


def test_what_stands_on_a_named_object_may_go_along(executor):
    def carried(commands, scene, start):
        plate, cherry = scene.get("plate_1"), scene.get("cherry_1")
        scene = scene.replace(msgspec.structs.replace(plate, x=0.5))
        return scene.replace(msgspec.structs.replace(cherry, x=0.6))

    for touched, ok in ((["plate_1"], True), (["cherry_1"], False)):
        result = checks(executor, carried)("robot.move(0, 0, 0.5, 0)", touched=touched)
        assert result.ok is ok


def test_on_the_ideal_table_things_go_into_containers_and_not_onto_rims(ideally):
    scene = Scene(objects=(thing("apple", -0.4, 0.2), thing("bowl", 0.3, 0.2, size=0.3)))

    def outcome(x):
        program = pick_and_place("apple", x, "bowl.y", "bowl.tall + apple.tall")
        return ideally(program, scene, touched=["apple_1", "bowl_1"])

    assert outcome("bowl.x").after.get("apple_1").on == "bowl_1"
    assert outcome("bowl.x").ok
    assert "slide off the bowl" in only(outcome("bowl.x + 0.17")).text


@pytest.mark.parametrize(
    ("y", "neighbour", "ok"),
    [
        (0.0, None, True),
        (0.14, None, True),  # its middle is just over the book
        (0.16, None, False),  # 45 % of it is, its middle is not
        (0.2, 0.39, True),  # it lies across to the tin
        (0.2, 0.44, False),  # of which only a sliver is below it
    ],
)
def test_what_carries_is_below_the_middle_or_on_both_sides_of_it(y, neighbour, ok):
    book, lid = thing("book", 0.0, 0.0, size=0.3), thing("lid", 0.0, y, size=0.2, z=0.1)
    tins = () if neighbour is None else (thing("tin", 0.0, neighbour, size=0.3),)
    scene = Scene(objects=(book, lid, *tins))
    assert supported(lid, book, scene, "manipulate") is ok


def test_what_is_shoved_aside_on_a_full_container_does_not_stay_there(ideally):
    """The mug comes down on the apple's flank and goes beyond the rim of the glass."""
    scene = Scene(objects=(
        thing("glass", 0.33, -0.64, size=0.34, tall=0.44), thing("mug", -0.54, 0.29, size=0.36),
        thing("apple", -0.06, 0.77, size=0.33, tall=0.33),
        thing("book", -0.59, -0.58, size=0.5, tall=0.12),
    ))  # fmt: skip
    named = [item.id for item in scene]
    found = ideally("put_all_on([apple, mug, book], glass)", scene, touched=named)
    assert not found.ok and "off the" in found.problems[0].text


ROAD = Scene(objects=(
    thing("apple", -0.6, 0.0), thing("box", 0.0, 0.0, size=0.3, tall=0.5),
    thing("lid", 0.0, 0.0, size=0.3, tall=0.1, z=0.5, on="box_1"),
))  # fmt: skip


@pytest.mark.parametrize(
    ("height", "words"),
    [(0.9, None), (0.65, "the apple would knock the lid off"), (0.3, None)],
)
@pytest.mark.parametrize("release", ["\nrobot.grip(False)", ""])
def test_what_is_carried_knocks_nothing_off_on_its_way(ideally, height, words, release):
    """All three things are named; the box, on the table, may be pushed with the apple."""
    program = f"""\
pick(apple)
robot.move(-0.6, 0, {height}, 0)
robot.move(0.6, 0, {height}, 0)
robot.move(0.6, 0, 0.1, 0){release}"""
    found = ideally(program, ROAD, touched=["apple_1", "box_1", "lid_1"])
    assert found.ok is (words is None)
    if words is not None:
        assert words in found.problems[0].text and found.problems[0].object == "apple_1"


@pytest.mark.parametrize(("by", "refused"), [(0.005, False), (0.02, True)])
def test_letting_go_moves_nothing_else(executor, by, refused):
    """In this forecast the release moves the orange, by less or by more than a hair."""

    def shoving(commands, scene, start):
        after = ideal.predict(commands, scene, start)
        if not any(one.op == "grip" and not one.grip for one in commands):
            return after
        orange = after.get("orange_1")
        return after.replace(msgspec.structs.replace(orange, x=orange.x + by))

    named = ["apple_1", "orange_1"]
    found = checks(executor, shoving)("put(apple, [-0.5, -0.5])", touched=named)
    assert found.ok is not refused
    if refused:
        assert only(found).text == "the apple would shove the orange away where it is let go"


def test_gripping_what_is_held_already_and_keeping_it_is_no_deed(ideally):
    held = thing("apple", 0.0, 0.0, z=0.8, held=True, on="gripper")
    program = "robot.move(apple.x, apple.y, apple.z + apple.tall, 0)\nrobot.grip(True)"
    result = ideally(program, Scene(objects=(held,)), touched=["apple_1"])
    assert only(result).reason == "impossible"
    assert "holds the apple already" in only(result).text


# --- what is come down upon, and carried through ------------------------------------------------


@pytest.mark.parametrize(
    ("program", "words"),
    [
        ("robot.move(apple.x, apple.y, 1, 0)\nrobot.move(apple.x, apple.y, 0.02, 0)",
         "the apple would be pressed down upon"),
        ("pick(apple)\nrobot.move(orange.x, orange.y, 1.2, 0)\n"
         "robot.move(orange.x, orange.y, 0.05, 0)", "pressed down onto what is below"),
        ("pick(apple)\nrobot.move(-0.8, -0.8, 1.2, 0)\nrobot.move(-0.8, -0.8, 0.02, 0)",
         "pressed down onto what is below"),
    ],
)  # fmt: skip
def test_nothing_is_pressed_down(ideally, program, words):
    result = ideally(program)
    assert result.plan is None
    assert result.problems[0].reason == "unsafe" and words in result.problems[0].text
    assert result.problems[0].line == program.count("\n") + 1


@pytest.mark.parametrize(
    "program",
    ["touch(apple)", "push(apple, [0, 0.2])", "put_on(apple, plate)", "topple(bottle, 1)",
     "robot.move(-0.8, -0.8, 1, 0)\nrobot.move(-0.8, -0.8, 0, 0)", "put(apple, [-0.7, -0.7])"],
)  # fmt: skip
def test_touching_pushing_and_setting_down_is_not_pressing(ideally, program):
    assert ideally(program).problems == ()


POST = KeepOut("the post", (-0.75, -0.65), (-0.75, -0.65), (0.0, 0.15))


def test_what_is_carried_keeps_out_too(ideally):
    over = "robot.move(-0.7, -0.9, {z}, 0)\nrobot.move(-0.7, -0.5, {z}, 0)"
    low = "pick(apple)\n" + over.format(z=0.22)
    result = ideally(low, keep_outs=(POST,))
    assert [problem.text for problem in result.problems] == [
        "the apple would be carried through the post"
    ]
    assert result.problems[0].line == 3
    assert ideally(over.format(z=0.22), keep_outs=(POST,)).ok
    assert ideally("pick(apple)\n" + over.format(z=0.3), keep_outs=(POST,)).ok


@pytest.mark.parametrize(("tall", "words"), [(0.9, "would be carried into the vase"), (0.3, None)])
def test_nothing_is_carried_into_what_stands_in_its_way(ideally, tall, words):
    """The candle hangs 0.5 above the table where it is carried; both things are named."""
    scene = Scene(objects=(
        thing("candle", 0.8, 0.0, size=0.2, tall=0.7), thing("vase", 0.2, 0.0, size=0.3, tall=tall),
    ))  # fmt: skip
    found = ideally("put(candle, [-0.5, 0])", scene, touched=["candle_1", "vase_1"])
    assert found.ok is (words is None)
    if words is not None:
        assert words in found.problems[0].text and found.problems[0].object == "candle_1"

"""What the check lets through and what it calls impossible, unreachable or unsafe."""

import math

import msgspec
import pytest

from agent.check import check, rising_first
from agent.execute import Executor
from agent.landing import supported
from agent.messages import Command, KeepOut
from robot_bridge import ideal
from robot_bridge.api import Limits
from scene.types import Pose, Scene, SceneObject

START = Pose(0.0, -1.2, 0.9)


def thing(name, x=None, y=None, size=0.12, tall=0.1, **more):
    return SceneObject(
        id=f"{name}_1", name=name, x=x, y=y, width=size, height=size, tall=tall,
        on=more.pop("on", "tray" if x is None else "table"), **more,
    )  # fmt: skip


class Reach:
    """A workspace: the default box, and a radius from the base behind the near edge."""

    def __init__(self, radius=9.0, **limits):
        self.radius = radius
        self.limits = Limits(simulated=True, **limits)

    def reach(self, pose):
        return None if math.hypot(pose.x, pose.y + 2) <= self.radius else "too far from the base"


def predict(commands, scene, tip=START):
    """A table in twenty lines: a low tip pushes what it meets along x; the gripper carries."""
    held = None
    for command in commands:
        if command.op == "move":
            moved = [_follow(item, tip, command, item.id == held) for item in scene.objects]
            scene = msgspec.structs.replace(scene, objects=tuple(moved))
            tip = Pose(command.x, command.y, command.z)
        elif command.grip:
            scene, held = _pick(scene, tip)
        elif held is not None:
            scene, held = scene.replace(_settle(scene, scene.get(held))), None
    return scene


def _follow(item, tip, to, held):
    if held:
        return msgspec.structs.replace(item, x=to.x, y=to.y, z=to.z - item.tall)
    low = to.z < item.top - 0.01 and tip.z < item.top - 0.01
    meets = abs(to.y - item.y) < item.height / 2 and tip.x < item.x < to.x + item.width / 2
    if not (low and meets and item.on == "table"):
        return item
    if to.z > item.z + 2 * item.width:
        return msgspec.structs.replace(item, upright=False)
    x = to.x + item.width / 2
    return msgspec.structs.replace(item, x=x, on="floor" if x > 1 else "table")


def _pick(scene, tip):
    for item in scene:
        x, y = (1.12, -1.54) if item.x is None else item.position
        if math.dist((x, y, item.top), (tip.x, tip.y, tip.z)) < 0.03:
            taken = msgspec.structs.replace(item, x=x, y=y, on="gripper", held=True)
            others = tuple(o for o in scene.objects if o.id != item.id)
            tray = tuple(o for o in scene.tray if o.id != item.id)
            return Scene(objects=(*others, taken), tray=tray), item.id
    return scene, None


def _settle(scene, item):
    below = [
        o for o in scene.objects
        if o.id != item.id and max(abs(o.x - item.x), abs(o.y - item.y)) <= o.width / 2
    ]  # fmt: skip
    carrier = max(below, key=lambda o: o.top, default=None)
    if carrier is not None:
        return msgspec.structs.replace(item, z=carrier.top, on=carrier.id, held=False)
    on = "table" if max(abs(item.x), abs(item.y)) <= 1 else "floor"
    return msgspec.structs.replace(item, z=0.0, on=on, held=False)


SCENE = Scene(
    objects=(
        thing("apple", -0.4, 0.2),
        thing("orange", 0.3, 0.2),
        thing("bottle", 0.5, -0.4, tall=0.3),
        thing("plate", 0.0, -0.6, size=0.4, tall=0.03),
        thing("cherry", 0.1, -0.6, size=0.04, tall=0.04, z=0.03, on="plate_1"),
    ),
)


@pytest.fixture(scope="module")
def executor():
    with Executor() as executor:
        yield executor


@pytest.fixture
def checked(executor):
    def run(program, scene=SCENE, kind="manipulate", touched=None, radius=9.0):
        return check(
            program, kind, scene, executor=executor, predict=predict,
            workspace=Reach(radius), start=START, touched=touched,
        )  # fmt: skip

    return run


def pick_and_place(item, x, y, z):
    return f"""\
robot.move({item}.x, {item}.y, 0.9, 0)
robot.move({item}.x, {item}.y, {item}.z + {item}.tall, 0)
robot.grip(True)
robot.move({item}.x, {item}.y, 0.9, 0)
robot.move({x}, {y}, 0.9, 0)
robot.move({x}, {y}, {z}, 0)
robot.grip(False)
robot.move({x}, {y}, 0.9, 0)"""


PUSH_OFF = """\
robot.move(orange.x - 0.2, orange.y, 0.3, 0)
robot.move(orange.x - 0.2, orange.y, 0.04, 0)
robot.move(1.1, orange.y, 0.04, 0)"""


def only(result):
    (problem,) = result.problems
    assert not result.ok
    return problem


# --- what may run -------------------------------------------------------------------------------


def test_a_good_program_comes_back_with_its_motions_and_the_scene_after(checked):
    result = checked(pick_and_place("apple", 0.3, -0.1, "apple.tall"), touched=["apple_1"])
    assert result.ok and len(result.commands) == 8
    assert result.after.get("apple_1").position == (0.3, -0.1)
    assert result.commands[2].x == -0.4


def test_a_grip_before_any_motion_is_where_the_robot_is(checked):
    (command,) = checked("robot.grip(True)").commands
    assert (command.x, command.y, command.z) == (START.x, START.y, START.z)


def test_pushing_a_named_object_off_the_table_is_legal(checked):
    assert checked(PUSH_OFF, touched=["orange_1"]).ok


def test_setting_down_on_a_larger_thing_is_legal(checked):
    program = pick_and_place("apple", "plate.x - 0.1", "plate.y", "plate.tall + apple.tall")
    result = checked(program, touched=["apple_1", "plate_1"])
    assert result.ok and result.after.get("apple_1").on == "plate_1"


def test_setting_down_on_a_thing_that_nobody_named_is_unsafe(checked):
    program = pick_and_place("apple", "plate.x - 0.1", "plate.y", "plate.tall + apple.tall")
    assert "end up on the plate" in only(checked(program, touched=["apple_1"])).text


def test_gripping_nothing_is_not_what_was_asked_for(checked):
    program = "robot.move(0.5, -0.5, 0.5, 0)\nrobot.grip(True)"
    assert only(checked(program, touched=["apple_1"])).reason == "unreachable"
    assert checked(program, touched=None).ok


def test_what_fell_to_the_floor_cannot_be_picked_up(checked):
    scene = Scene(objects=(thing("apple", 1.2, 0.0, on="floor"),))
    program = "robot.move(apple.x, apple.y, 0.9, 0)\nrobot.grip(True)"
    assert "lies on the floor" in only(checked(program, scene, touched=["apple_1"])).text


def test_setting_back_on_the_thing_it_stood_on_is_legal(checked):
    apple = thing("apple", 0.3, 0.2, z=0.1, on="plate_1")
    scene = Scene(objects=(thing("plate", 0.3, 0.2, size=0.4), apple))
    program = pick_and_place("apple", "apple.x", "apple.y", "apple.z + apple.tall")
    assert checked(program, scene, touched=["apple_1"]).ok


def test_an_arrange_program_is_checked_as_the_motions_it_becomes(checked):
    scene = Scene(objects=(thing("plate", 0.0, 0.0),), tray=(thing("apple"),))
    program = "solver.addConstraint(apple.x == plate.x - 0.3)\nsolver.addConstraint(apple.y == 0)"
    result = checked(program, scene, "arrange", touched=["apple_1"])
    assert result.ok and result.after.get("apple_1").position == pytest.approx((-0.3, 0.0))


def test_a_program_that_does_nothing_may_run(checked):
    assert checked("if kiwi is None:\n    return").commands == ()


# --- programs that cannot be --------------------------------------------------------------------


@pytest.mark.parametrize(
    ("program", "kind", "line"),
    [
        ("x = 1\nimport os", "manipulate", 2),
        ("x = aple.x", "manipulate", 1),
        ("x = 1\n\nx = x / 0", "manipulate", 3),
        ("while True:\n    pass", "manipulate", 2),
    ],
)
def test_a_broken_program_is_a_bad_program(checked, program, kind, line):
    result = checked(program, kind=kind)
    problem = only(result)
    assert (problem.reason, problem.line) == ("bad_program", line)
    assert result.commands == () and result.after is None


def test_constraints_that_cannot_hold_are_impossible(checked):
    scene = Scene(tray=(thing("apple"),))
    program = "solver.addConstraint(apple.x == 0)\nsolver.addConstraint(apple.x == 1.5)"
    problem = only(checked(program, scene, "arrange"))
    assert (problem.reason, problem.line) == ("impossible", 2)


def test_what_leaves_the_workspace_is_unreachable(checked):
    problem = only(checked("robot.move(0, 0, 0.5, 0)\nrobot.move(5, 0, 0.5, 0)"))
    assert (problem.reason, problem.line) == ("unreachable", 2)


def test_what_the_arm_cannot_reach_is_unreachable(checked):
    problem = only(checked("robot.move(0, 0.9, 0.5, 0)", radius=2.0))
    assert problem.reason == "unreachable" and "too far from the base" in problem.text


def test_what_finds_no_room_in_the_tray_is_unreachable(checked):
    scene = Scene(tray=(thing("board", size=1.9),))
    assert only(checked("solver.addConstraint(board.x == 0)", scene, "arrange")).reason == (
        "unreachable"
    )


# --- what nobody asked to be moved --------------------------------------------------------------


def test_pushing_what_was_not_named_is_unsafe(checked):
    program = "robot.move(-0.7, 0.2, 0.04, 0)\nrobot.move(-0.3, 0.2, 0.04, 0)"
    problem = only(checked(program, touched=["orange_1"]))
    assert (problem.reason, problem.object, problem.line) == ("unsafe", "apple_1", 2)
    assert "the apple would be moved" in problem.text


def test_pushing_what_was_not_named_off_the_table_is_unsafe(checked):
    problem = only(checked(PUSH_OFF, touched=["apple_1"]))
    assert (problem.object, problem.line) == ("orange_1", 3)
    assert "fall off the table" in problem.text


def test_toppling_what_was_not_named_is_unsafe(checked):
    program = "robot.move(0.2, -0.4, 0.27, 0)\nrobot.move(0.5, -0.4, 0.27, 0)"
    assert "topple" in only(checked(program, touched=[])).text
    assert checked(program, touched=["bottle_1"]).ok


def test_picking_up_what_was_not_named_is_unsafe(checked):
    program = "\n".join(pick_and_place("apple", 0, 0, 0).splitlines()[:4])
    assert "picked up" in only(checked(program, touched=["orange_1"])).text


def test_whoever_names_nothing_in_particular_may_move_anything(checked):
    assert checked(PUSH_OFF, touched=None).ok


def test_problems_come_in_the_order_in_which_they_would_occur(checked):
    program = PUSH_OFF + "\n" + pick_and_place("apple", 1.3, 0, 0.1)
    problems = checked(program, touched=["apple_1"]).problems
    assert [problem.object for problem in problems] == ["orange_1", "apple_1"]


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
        result = check(
            "robot.move(0, 0, 0.5, 0)", "manipulate", SCENE, executor=executor, predict=carried,
            workspace=Reach(), start=START, touched=touched,
        )  # fmt: skip
        assert result.ok is ok


def test_on_the_ideal_table_things_go_into_containers_and_not_onto_rims(executor):
    scene = Scene(objects=(thing("apple", -0.4, 0.2), thing("bowl", 0.3, 0.2, size=0.3)))

    def outcome(x):
        return check(
            pick_and_place("apple", x, "bowl.y", "bowl.tall + apple.tall"), "manipulate", scene,
            executor=executor, predict=ideal.predict, workspace=Reach(), start=START,
            touched=["apple_1", "bowl_1"],
        )  # fmt: skip

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


def test_what_is_shoved_aside_on_a_full_container_does_not_stay_there(executor):
    """The mug comes down on the apple's flank and goes beyond the rim of the glass."""
    scene = Scene(objects=(
        thing("glass", 0.33, -0.64, size=0.34, tall=0.44), thing("mug", -0.54, 0.29, size=0.36),
        thing("apple", -0.06, 0.77, size=0.33, tall=0.33),
        thing("book", -0.59, -0.58, size=0.5, tall=0.12),
    ))  # fmt: skip
    found = check(
        "put_all_on([apple, mug, book], glass)", "manipulate", scene, executor=executor,
        predict=ideal.predict, workspace=Reach(), start=START,
        touched=["apple_1", "mug_1", "book_1", "glass_1"],
    )  # fmt: skip
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
def test_what_is_carried_knocks_nothing_off_on_its_way(executor, height, words, release):
    """All three things are named; the box, on the table, may be pushed with the apple."""
    program = f"""\
pick(apple)
robot.move(-0.6, 0, {height}, 0)
robot.move(0.6, 0, {height}, 0)
robot.move(0.6, 0, 0.1, 0){release}"""
    found = check(
        program, "manipulate", ROAD, executor=executor, predict=ideal.predict, workspace=Reach(),
        start=START, touched=["apple_1", "box_1", "lid_1"],
    )  # fmt: skip
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

    found = check(
        "put(apple, [-0.5, -0.5])", "manipulate", SCENE, executor=executor, predict=shoving,
        workspace=Reach(), start=START, touched=["apple_1", "orange_1"],
    )  # fmt: skip
    assert found.ok is not refused
    if refused:
        assert only(found).text == "the apple would shove the orange away where it is let go"


def test_gripping_what_is_held_already_and_keeping_it_is_no_deed(executor):
    held = thing("apple", 0.0, 0.0, z=0.8, held=True, on="gripper")
    result = check(
        "robot.move(apple.x, apple.y, apple.z + apple.tall, 0)\nrobot.grip(True)", "manipulate",
        Scene(objects=(held,)), executor=executor, predict=ideal.predict, workspace=Reach(),
        start=START, touched=["apple_1"],
    )  # fmt: skip
    assert only(result).reason == "impossible"
    assert "holds the apple already" in only(result).text


# --- what is come down upon, and carried through ------------------------------------------------


def on_the_ideal_table(program, scene=SCENE, **limits):
    """Checked with the real forecast; the executor is the module's own."""

    def run(executor):
        return check(
            program, "manipulate", scene, executor=executor, predict=ideal.predict,
            workspace=Reach(**limits), start=START, touched=None,
        )  # fmt: skip

    return run


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
def test_nothing_is_pressed_down(executor, program, words):
    result = on_the_ideal_table(program)(executor)
    assert result.plan is None
    assert result.problems[0].reason == "unsafe" and words in result.problems[0].text
    assert result.problems[0].line == program.count("\n") + 1


@pytest.mark.parametrize(
    "program",
    ["touch(apple)", "push(apple, [0, 0.2])", "put_on(apple, plate)", "topple(bottle, 1)",
     "robot.move(-0.8, -0.8, 1, 0)\nrobot.move(-0.8, -0.8, 0, 0)", "put(apple, [-0.7, -0.7])"],
)  # fmt: skip
def test_touching_pushing_and_setting_down_is_not_pressing(executor, program):
    assert on_the_ideal_table(program)(executor).problems == ()


POST = KeepOut("the post", (-0.75, -0.65), (-0.75, -0.65), (0.0, 0.15))


def test_what_is_carried_keeps_out_too(executor):
    over = "robot.move(-0.7, -0.9, {z}, 0)\nrobot.move(-0.7, -0.5, {z}, 0)"
    low = "pick(apple)\n" + over.format(z=0.22)
    result = on_the_ideal_table(low, keep_outs=(POST,))(executor)
    assert [problem.text for problem in result.problems] == [
        "the apple would be carried through the post"
    ]
    assert result.problems[0].line == 3
    assert on_the_ideal_table(over.format(z=0.22), keep_outs=(POST,))(executor).ok
    assert on_the_ideal_table("pick(apple)\n" + over.format(z=0.3), keep_outs=(POST,))(executor).ok


def test_without_a_system_call_filter_only_simulated_arms_move(executor):
    class Unfiltered:
        hardened = False
        run = executor.run

    def checked(simulated):
        workspace = Reach()
        workspace.limits = Limits(simulated=simulated)
        return check(
            "robot.move(0, 0, 1, 0)", "manipulate", SCENE, executor=Unfiltered(),
            predict=predict, workspace=workspace, start=START, touched=None,
        )  # fmt: skip

    assert checked(simulated=True).ok
    refused = checked(simulated=False)
    assert refused.plan is None and "system-call filter" in refused.problems[0].text


def test_a_plan_is_made_only_where_there_is_no_problem(checked):
    assert checked("robot.move(0, 0, 0.9, 0)").plan is not None
    bad = checked("robot.move(orange.x - 0.2, orange.y, 0.9, 0)\n"
                  "robot.move(orange.x - 0.2, orange.y, 0.04, 0)\n"
                  "robot.move(1.2, orange.y, 0.04, 0)", touched=["apple_1"])  # fmt: skip
    assert bad.problems and bad.commands and bad.plan is None


@pytest.mark.parametrize(("tall", "rises"), [(0.4, False), (1.0, True)])
def test_the_tool_rises_before_it_goes_over_what_is_as_tall(tall, rises):
    standing = SceneObject(
        id="vase_1", name="vase", x=0.0, y=-0.6, width=0.3, height=0.3, tall=tall
    )
    over = [Command("move", 0.0, 0.5, 1.2, 0.0, False)]
    risen = rising_first(over, START, Scene(objects=(standing,)))
    up = Command("move", START.x, START.y, 1.2, 0.0, False)
    assert risen == ([up, *over] if rises else over)

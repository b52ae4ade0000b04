"""What the check lets through, and what it calls impossible, unreachable, or unsafe to move."""

import pytest
from check_world import PUSH_OFF, START, checks, only, pick_and_place, thing

from agent.check import rising_first
from agent.messages import Command
from scene.types import Scene, SceneObject


@pytest.fixture
def checked(executor):
    return checks(executor)


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


def test_without_a_system_call_filter_only_simulated_arms_move(executor):
    class Unfiltered:
        hardened = False
        run = executor.run

    def checked(simulated):
        return checks(Unfiltered())("robot.move(0, 0, 1, 0)", simulated=simulated)

    assert checked(simulated=True).ok
    refused = checked(simulated=False)
    assert refused.plan is None and "system-call filter" in refused.problems[0].text


def test_a_plan_is_made_only_where_there_is_no_problem(checked):
    assert checked("robot.move(0, 0, 0.9, 0)").plan is not None
    bad = checked("robot.move(orange.x - 0.2, orange.y, 0.9, 0)\n"
                  "robot.move(orange.x - 0.2, orange.y, 0.04, 0)\n"
                  "robot.move(1.2, orange.y, 0.04, 0)", touched=["apple_1"])  # fmt: skip
    assert bad.problems and bad.commands and bad.plan is None


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


@pytest.mark.parametrize(("tall", "rises"), [(0.4, False), (1.0, True)])
def test_the_tool_rises_before_it_goes_over_what_is_as_tall(tall, rises):
    standing = SceneObject(
        id="vase_1", name="vase", x=0.0, y=-0.6, width=0.3, height=0.3, tall=tall
    )
    over = [Command("move", 0.0, 0.5, 1.2, 0.0, False)]
    risen = rising_first(over, START, Scene(objects=(standing,)))
    up = Command("move", START.x, START.y, 1.2, 0.0, False)
    assert risen == ([up, *over] if rises else over)

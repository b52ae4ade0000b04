"""No path leads to a robot but through the check: by type checker, and by `ast` over the tree."""

import ast
import inspect
from pathlib import Path

import pytest
from mypy import api as mypy

from robot_bridge.api import Robot, Simulated
from robot_bridge.bullet import BulletRobot
from robot_bridge.dobot_arm import DobotRobot
from robot_bridge.ideal import IdealRobot

ROOT = Path(__file__).parent.parent
FOLDERS = ("agent", "clarifier", "evals", "examples", "robot_bridge", "scene", "translator", "tui")
SOURCES = {
    str(path.relative_to(ROOT)): ast.parse(path.read_text(encoding="utf-8"))
    for folder in FOLDERS
    for path in sorted((ROOT / folder).rglob("*.py"))
}
DRIVERS = (IdealRobot, BulletRobot, DobotRobot)


def where(matches) -> set[str]:
    """Files with a node for which ``matches`` is true."""
    return {name for name, tree in SOURCES.items() if any(matches(node) for node in ast.walk(tree))}


def calls(name):
    """A test for calls of a function or method of this name."""

    def matches(node):
        called = node.func if isinstance(node, ast.Call) else None
        return getattr(called, "id", None) == name or getattr(called, "attr", None) == name

    return matches


def names(*known):
    """A test for any mention of these names, as variable, attribute, import or text."""

    def matches(node):
        mentioned = {getattr(node, "id", None), getattr(node, "attr", None)}
        mentioned |= {getattr(node, "name", None)} if isinstance(node, ast.alias) else set()
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            mentioned.add(node.value)
        return bool(mentioned & set(known))

    return matches


# --- who makes a plan ----------------------------------------------------------------------------


def test_the_check_and_the_bridge_alone_approve():
    bridge = {
        "robot_bridge/runner.py", "robot_bridge/service.py", "robot_bridge/dobot_arm.py",
        "robot_bridge/moves.py",
    }  # fmt: skip
    timed = {"evals/program_bench.py"}  # measures how long it takes, and runs nothing
    # measure on arms of their own, simulated or emulated
    emulated = {"evals/fault_matrix.py", "evals/dobot_bench.py"}
    simulated = {f"evals/{name}.py" for name in ("robot_bench", "soak", "stop_bench")}
    assert where(calls("approve")) - bridge - timed - emulated - simulated == {"agent/check.py"}


def test_nobody_but_approve_makes_a_plan():
    assert where(calls("ApprovedPlan")) == {"robot_bridge/api.py"}
    assert where(names("_SEAL")) == {"robot_bridge/api.py"}


def test_no_plan_is_copied_unpickled_or_made_around_its_constructor():
    assert where(names("__new__", "__reduce__", "__setstate__", "pickle")) == set()
    assert where(names("__setattr__")) <= {"robot_bridge/api.py"}


def test_a_plan_cannot_be_subclassed_into_something_else():
    made = {
        node.name
        for tree in SOURCES.values()
        for node in ast.walk(tree)
        if isinstance(node, ast.ClassDef)
        and any(getattr(base, "id", None) == "ApprovedPlan" for base in node.bases)
    }
    assert made == set()


# --- what a robot takes --------------------------------------------------------------------------


@pytest.mark.parametrize("driver", [*DRIVERS, Robot, Simulated])
def test_of_all_that_a_robot_does_in_public_only_run_moves_the_arm(driver):
    public = {name for name in dir(driver) if not name.startswith("_")}
    still = {"limits", "reach", "pose", "stop", "reset", "close", "load", "scene", "picture"}
    still |= {
        "view",
        "scale",
        "reading",
    }  # where its camera stands, its table's scale, its pose in mm
    own = {"home"} if driver is DobotRobot else set()  # the controller's own motion, to one place
    assert public <= {"run", *still, *own}
    taken = inspect.signature(driver.run, eval_str=False).parameters
    assert [(name, one.annotation) for name, one in taken.items()] == [
        ("self", inspect.Parameter.empty), ("plan", "ApprovedPlan")
    ]  # fmt: skip


def test_what_moves_inside_a_driver_is_called_by_drivers_alone():
    inside = {"_move", "_grip", "_step", "_run", "_claim", "_world", "_table"}
    outside = {
        (name, node.attr)
        for name, tree in SOURCES.items()
        for node in ast.walk(tree)
        if isinstance(node, ast.Attribute) and node.attr in inside
        and getattr(node.value, "id", None) != "self"
    }  # fmt: skip
    # records what reaches the simulated drivers, which it makes itself
    assert {name for name, _ in outside} <= {"evals/robot_bench.py"}


def test_every_driver_is_known_here():
    """A new arm must come under these tests."""
    found = {
        node.name
        for name, tree in SOURCES.items()
        if name.startswith("robot_bridge/")
        for node in ast.walk(tree)
        if isinstance(node, ast.ClassDef)
        and (
            {"run", "reach"} <= {getattr(part, "name", None) for part in node.body}
            or "SimulatedArm" in {getattr(base, "id", None) for base in node.bases}
        )
    }
    assert found == {"SimulatedArm", *(driver.__name__ for driver in DRIVERS)}


@pytest.mark.parametrize("driver", DRIVERS)
def test_a_robot_refuses_at_run_time_what_the_type_checker_would(driver):
    class Forged:
        told = durations = ()

    robot = driver()
    for other in ([], None, "robot.move(0, 0, 1, 0)", Forged()):
        with pytest.raises(TypeError):
            robot.run(other)
    robot.close()


# --- the type checker ----------------------------------------------------------------------------

HEAD = (
    "from agent.arm import Arm\nfrom agent.messages import Command\n"
    "from robot_bridge.api import ApprovedPlan, Robot\n"
    "def use(robot: Robot, arm: Arm, plan: ApprovedPlan, commands: list[Command]) -> None:\n"
)
MISUSES = {
    "robot.run(commands)": "ApprovedPlan",
    "robot.run(tuple(commands))": "ApprovedPlan",
    "arm.run(commands)": "ApprovedPlan",
    "arm.run(plan.told)": "ApprovedPlan",
    "robot.run('robot.move(0, 0, 1, 0)')": "ApprovedPlan",
    "robot.run(ApprovedPlan())": "Missing positional argument",
    "robot.move(0, 0, 1, 0)": "no attribute",
    "robot.home()": "no attribute",
    "arm.move(0, 0, 1, 0)": "no attribute",
}


@pytest.fixture(scope="module")
def judged(tmp_path_factory):
    """What mypy says of each misuse, all in one run: line -> errors."""
    path = tmp_path_factory.mktemp("misuse") / "misuse.py"
    lines = ["robot.run(plan)", "arm.run(plan)", *MISUSES]
    path.write_text(HEAD + "".join(f"    {line}\n" for line in lines))
    quiet = ["--strict", "--no-error-summary", "--config-file=", "--ignore-missing-imports"]
    out, err, _ = mypy.run([*quiet, str(path)])
    assert not err
    found = {}
    for line in out.splitlines():
        # by name alone: what mypy remembers of an equal file, it tells of where that one lay
        place, _, text = line.rpartition(f"{path.name}:")[2].partition(": error: ")
        if place.isdigit():
            found[int(place)] = found.get(int(place), "") + text
    return found


def test_the_type_checker_lets_a_plan_through_and_nothing_else(judged):
    first = HEAD.count("\n") + 1
    assert first not in judged and first + 1 not in judged
    for line, (misuse, words) in enumerate(MISUSES.items(), first + 2):
        assert words in judged.get(line, ""), misuse

"""Programs run in a worker process: what comes back, and what is refused."""

import pytest
from program_scenes import GOOD, table, thing, tray

from agent.errors import (
    LimitReached,
    NotAllowed,
    ProgramError,
    ProgramFailed,
    SolverFailed,
    Unsatisfiable,
)
from agent.execute import Executor
from agent.messages import Command, Draft, Placement
from agent.primitives import primitives
from scene.types import Scene

# --- one program, many scenes ------------------------------------------------------------------


def test_one_program_runs_on_many_scenes_in_order(executor):
    scenes = [Scene(objects=(thing("apple", n / 100, 0.0),)) for n in range(60)]
    results = executor.run(GOOD, "manipulate", scenes)
    assert [result.commands[0].x for result in results] == [n / 100 for n in range(60)]


def test_each_scene_has_its_own_names_and_its_own_outcome(executor):
    scenes = [table("apple"), table("pear"), table("pear", "apple")]
    source = "robot.move(1 / apple.x, 0, 0, 0)"
    first, second, third = executor.run(source, "manipulate", scenes)
    assert isinstance(first, ProgramFailed) and "division" in first.reason
    assert isinstance(second, NotAllowed) and "apple is unknown" in second.reason
    assert isinstance(third, Draft)


def test_scenes_too_large_to_send_are_refused_without_a_worker_dying(executor):
    before = executor.pid
    huge = Scene(objects=(thing("a" * 400_000, 0.0, 0.0),))
    (result, *_) = executor.run(GOOD, "manipulate", [huge] * 50)
    assert type(result) is SolverFailed and "bytes" in result.reason
    assert executor.pid == before


def test_no_scene_no_result(executor):
    assert executor.run(GOOD, "manipulate", []) == []


@pytest.mark.parametrize(
    ("source", "kind"),
    [
        ("import os", NotAllowed),
        ("x = 1\rimport os", NotAllowed),
        ("x = 1" + " " * 9000, NotAllowed),
        ("x = 1 / 0", ProgramFailed),
        ("while True:\n    pass", LimitReached),
    ],
)
def test_errors_are_values(executor, source, kind):
    (result,) = executor.run(source, "manipulate", [table("apple")])
    assert type(result) is kind


# --- arrange -----------------------------------------------------------------------------------


def places(executor, source, scene):
    (draft,) = executor.run(source, "arrange", [scene])
    assert isinstance(draft, Draft), draft
    return {p.object: (p.x, p.y) for p in draft.placements}


def failure(executor, source, scene):
    (error,) = executor.run(source, "arrange", [scene])
    assert isinstance(error, ProgramError), error
    return error


def test_constraints_become_placements_in_order_of_first_use(executor):
    source = """\
solver.addConstraint(orange.x == 0.3)
solver.addConstraint(apple.x + apple.width / 2 + 0.05 <= orange.x - orange.width / 2)
solver.addConstraint((apple.y == orange.y) | "strong")
solver.addConstraint(orange.y == 0.5)"""
    (draft,) = executor.run(source, "arrange", [tray("apple", "orange", "cup")])
    assert [(p.object, p.line) for p in draft.placements] == [("orange_1", 1), ("apple_1", 2)]
    orange, apple = draft.placements
    assert (orange.x, orange.y, apple.y) == pytest.approx((0.3, 0.5, 0.5))
    assert apple.x <= 0.3 - 0.12 - 0.05 + 1e-6


def test_what_the_program_never_constrains_stays_in_the_tray(executor):
    source = "solver.addConstraint(apple.x + cup.width == 0)"
    assert set(places(executor, source, tray("apple", "cup"))) == {"apple_1"}
    assert places(executor, "x = apple.width", tray("apple")) == {}


def test_an_intermediate_solution_can_be_looked_at(executor):
    source = """\
gap = Variable("gap")
solver.addConstraint(gap >= 0.2)
solver.addConstraint(apple.x == -0.5)
solver.solve()
if apple.x.value() < 0:
    solver.addConstraint(orange.x == -apple.x.value())
solver.addConstraint((orange.y - apple.y == gap) | "strong")
solver.addConstraint(apple.y == 0)
solver.solve()
solver.addConstraint((cup.y == (orange.y - apple.y).value() / 2) | "medium")
solver.addConstraint(cup.x == 0)"""
    result = places(executor, source, tray("apple", "orange", "cup"))
    assert result["orange_1"] == pytest.approx((0.5, 0.2))
    assert result["cup_1"] == pytest.approx((0.0, 0.1))


def test_objects_on_the_table_are_numbers(executor):
    scene = tray("apple", objects=[thing("plate", 0.4, -0.3)])
    source = """\
solver.addConstraint(apple.x == plate.x - 0.5)
solver.addConstraint(apple.y == plate.y.value())
solver.addConstraint(plate.x <= 1)"""
    assert places(executor, source, scene)["apple_1"] == pytest.approx((-0.1, -0.3))


def test_strengths_decide_between_wishes(executor):
    source = """\
solver.addConstraint((apple.x == -0.5) | "weak")
solver.addConstraint((apple.x == 0.5) | "strong")
solver.addConstraint((apple.y == 0.1) | "medium")
solver.addConstraint((apple.y == 0.2) | "required")"""
    assert places(executor, source, tray("apple"))["apple_1"] == pytest.approx((0.5, 0.2))


def test_every_placed_object_stays_on_the_table(executor):
    scene = tray("apple")
    source = 'solver.addConstraint((apple.x == 5) | "strong")'
    assert places(executor, source, scene)["apple_1"][0] == pytest.approx(1 - 0.06)
    error = failure(executor, "x = 0\nsolver.addConstraint(apple.x >= 0.95)", scene)
    assert type(error) is Unsatisfiable and error.line == 2


def test_freedom_is_resolved_towards_the_middle(executor):
    assert places(executor, "solver.addConstraint(apple.x >= 0.5)", tray("apple")) == {
        "apple_1": pytest.approx((0.5, 0.0))
    }


def overlap(one, other, size=0.12):
    return all(abs(a - b) < size - 1e-6 for a, b in zip(one, other, strict=True))


def test_objects_left_free_to_overlap_are_moved_apart(executor):
    source = """\
solver.addConstraint(apple.x >= -0.5)
solver.addConstraint(orange.x >= -0.5)
solver.addConstraint((cup.x == 0) | "strong")"""
    scene = tray("apple", "orange", "cup", objects=[thing("plate", 0.0, 0.0)])
    result = [*places(executor, source, scene).values(), (0.0, 0.0)]
    pairs = [(a, b) for n, a in enumerate(result) for b in result[:n]]
    assert not any(overlap(a, b) for a, b in pairs)
    assert result[2][0] == pytest.approx(0.0)


def test_moving_apart_keeps_required_and_strong_constraints(executor):
    source = """\
solver.addConstraint(apple.y == 0)
solver.addConstraint((apple.x <= -0.1) | "strong")"""
    scene = tray("apple", objects=[thing("plate", -0.1, 0.0)])
    x, y = places(executor, source, scene)["apple_1"]
    assert (x, y) == pytest.approx((-0.1 - 0.12 - 0.03, 0.0))


def test_an_overlap_that_the_program_demands_is_left_alone(executor):
    source = "solver.addConstraint(apple.x == plate.x)\nsolver.addConstraint(apple.y == plate.y)"
    scene = tray("apple", objects=[thing("plate", 0.3, 0.3, size=0.4, tall=0.02)])
    assert places(executor, source, scene)["apple_1"] == pytest.approx((0.3, 0.3))


def test_the_same_program_always_gives_the_same_placements(executor):
    source = 'gap = Variable("gap")\nsolver.addConstraint(cup.x + gap >= orange.x - 0.3)\n'
    names = ("apple", "orange", "cup", "pear", "plum")
    source += "\n".join(f"solver.addConstraint({n}.x <= 0.2 + gap)" for n in names)
    results = executor.run(source, "arrange", [tray(*names)] * 20)
    with Executor() as another:
        results += another.run(source, "arrange", [tray(*names)] * 5)
    assert all(result == results[0] for result in results)


@pytest.mark.parametrize(
    ("source", "reason"),
    [
        ("solver.addConstraint(0 <= apple.x <= 1)", "no a <= b <= c"),
        ("solver.addConstraint(apple.x <= 1 and apple.x >= 0)", "neither true nor false"),
        ("if apple.x >= 0:\n    pass", "to test, call solver.solve()"),
        ("if apple.x:\n    pass", "use .value() in tests"),
        ("x = not (apple.x == 1)", "neither true nor false"),
        ("solver.addConstraint(apple.x < 1)", "<=, >= or =="),
        ("solver.addConstraint(apple.x != 1)", "<=, >= or =="),
        ("solver.addConstraint(apple.x * orange.x == 1)", "cannot be multiplied"),
        ("solver.addConstraint(1 / apple.x == 1)", "not linear"),
        ("solver.addConstraint(apple.x ** 2 == 1)", "not an unknown"),
        ("solver.addConstraint(abs(apple.x) <= 1)", "add two constraints"),
        ("solver.addConstraint(max(apple.x, 0) <= 1)", "not an unknown"),
        ("solver.addConstraint(math.sin(apple.x) <= 1)", "not an unknown"),
        ("solver.addConstraint(apple.x)", "not an unknown"),
        ("solver.addConstraint(3)", "needs a comparison"),
        ("solver.addConstraint(apple.x | 'strong')", "belongs to a constraint"),
        ("x = [apple.x, 1]\ny = 1 in x", "neither true nor false"),
        ("x = apple.x.value()", "call solver.solve() before"),
        ("solver.addConstraint(apple.x == 0)\nsolver.solve()\nx = orange.x.value()",
         "add a constraint on it"),
        ("solver.addConstraint(apple.x * 1e9 <= 1)", "too large"),
        ("solver.addConstraint(apple.x <= 1e300)", "too large"),
        ("x = Variable(3)", "needs a name"),
    ],
)  # fmt: skip
def test_wrong_use_of_unknowns_is_explained(executor, source, reason):
    assert reason in failure(executor, source, tray("apple", "orange")).reason


@pytest.mark.parametrize(
    "source",
    [
        "solver.addConstraint(apple.x == 0)\nsolver.addConstraint(apple.x == 0.5)",
        "solver.addConstraint(apple.x == 0)\nsolver.addConstraint(apple.x - apple.x == 1)",
        "solver.addConstraint(apple.x == 0)\nsolver.addConstraint(apple.width >= 3)",
    ],
)
def test_constraints_that_cannot_all_hold_name_the_line(executor, source):
    error = failure(executor, source, tray("apple"))
    assert type(error) is Unsatisfiable and error.line == 2


def test_constraints_and_unknowns_have_budgets(executor):
    many = "for i in range(201):\n    solver.addConstraint(apple.x >= -0.5 - i)"
    assert type(failure(executor, many, tray("apple"))) is LimitReached
    free = "for i in range(101):\n    x = Variable('x')"
    assert type(failure(executor, free, tray("apple"))) is LimitReached
    doubled = "e = apple.x\nfor i in range(15):\n    e = e + e\nsolver.addConstraint(e == 0)"
    assert "apple_1" in places(executor, doubled, tray("apple"))


# --- primitives --------------------------------------------------------------------------------


def test_placements_become_pick_and_place_motions():
    scene = tray("apple")
    motions = primitives(Draft(placements=(Placement("apple_1", 0.2, -0.3, 4),)), scene)
    assert [(c.op, c.grip) for c in motions] == [
        ("move", False), ("move", False), ("grip", True), ("move", True), ("move", True),
        ("move", True), ("grip", False), ("move", False),
    ]  # fmt: skip
    pick, place = motions[2], motions[6]
    assert (pick.x > 1, pick.z) == (True, 0.1)
    assert (place.x, place.y, place.z) == (0.2, -0.3, 0.1)
    assert {c.line for c in motions} == {4}


def test_what_is_placed_on_something_is_let_go_on_its_top_and_after_it():
    scene = Scene(
        objects=(thing("box", 0.0, 0.0, size=0.5, tall=0.2),),
        tray=(thing("apple"), thing("plate", size=0.4, tall=0.02)),
    )
    draft = Draft(placements=(Placement("apple_1", 0.0, 0.0, 1), Placement("plate_1", 0.0, 0.0, 2)))
    releases = [c for c in primitives(draft, scene) if c.op == "grip" and not c.grip]
    assert [(c.line, pytest.approx(c.z)) for c in releases] == [(2, 0.22), (1, 0.32)]


def test_tall_things_are_carried_above_everything_that_stands():
    scene = Scene(objects=(thing("lamp", 0.0, 0.0, tall=0.8),), tray=(thing("bottle", tall=0.4),))
    motions = primitives(Draft(placements=(Placement("bottle_1", 0.5, 0.5),)), scene)
    assert max(c.z for c in motions) >= 1.2


def test_an_object_without_a_place_in_the_tray_cannot_be_placed():
    scene = Scene(tray=(thing("board", size=3.9),))
    with pytest.raises(ProgramError, match="no room"):
        primitives(Draft(placements=(Placement("board_1", 0.0, 0.0, 1),)), scene)


def test_the_primitives_of_a_manipulate_program_are_its_commands():
    commands = (Command("move", 0.0, 0.0, 0.5, 0.0, False, 1),)
    assert primitives(Draft(commands=commands), Scene()) == commands

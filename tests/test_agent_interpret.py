"""What a manipulate program computes, and the limits it runs into."""

import math

import msgspec
import pytest

from agent.errors import LimitReached, NotAllowed, ProgramFailed
from agent.language.interpret import compile_program, execute
from agent.program import parse
from scene.tray import tray_positions
from scene.types import EDGE, Scene, SceneObject, identifiers


def thing(name, x=None, y=None, number=1, **more):
    on = "tray" if x is None else "table"
    sizes = {"width": 0.12, "height": 0.10, "tall": 0.08} | more
    return SceneObject(id=f"{name}_{number}", name=name, x=x, y=y, on=on, **sizes)


SCENE = Scene(objects=(thing("apple", -0.4, 0.2), thing("orange", 0.3, 0.1, r=0.5)))


def no_solver():
    raise AssertionError("a manipulate program has no solver")


def run(source, scene=SCENE):
    program = parse(source, "manipulate", identifiers(scene))
    return execute(compile_program(program), scene, no_solver)


def result_of(expression, scene=SCENE, before=""):
    """The number an expression has, seen through the one window there is: a motion."""
    (command,) = run(f"{before}\nrobot.move({expression}, 0, 0, 0)", scene).commands
    return command.x


def test_commands_carry_their_line_and_the_state_of_the_gripper():
    draft = run("robot.move(0.1, 0.2, 0.3, 0.4)\nrobot.grip(True)\n\nrobot.move(0, 0, 0, 0)")
    assert [(c.op, c.line, c.grip) for c in draft.commands] == [
        ("move", 1, False), ("grip", 2, True), ("move", 4, True),
    ]  # fmt: skip
    assert (draft.commands[1].x, draft.commands[1].z) == (0.1, 0.3)


def test_an_object_that_is_held_already_counts_as_gripped():
    held = thing("apple", 0.0, 0.0)
    scene = Scene(objects=(SceneObject(**{f: getattr(held, f) for f in held.__struct_fields__}
                                       | {"on": "gripper", "held": True}),))  # fmt: skip
    assert run("robot.move(0, 0, 0.5, 0)", scene).commands[0].grip is True


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("apple.x + apple.width / 2", -0.34),
        ("orange.r", 0.5),
        ("-apple.y ** 2", -0.04),
        ("7 // 2 + 7 % 4", 6),
        ("2 ** 10", 1024),
        ("2 ** -1", 0.5),
        ("1 if apple.x < orange.x <= 1 else 0", 1),
        ("math.hypot(3, 4) + math.floor(2.7) + math.ceil(0.2)", 8),
        ("math.degrees(math.atan2(1, 0))", 90),
        ("abs(-2) + min(3, 1, 2) + max([4, 5])", 8),
        ("round(2.567, 1) + round(2.4)", 4.6),
        ("len([1, 2]) + sum([1, 2, 3]) + sum(range(4))", 14),
        ("sorted([3, 1, 2])[0] + sorted([(2, 0), (1, 9)])[0][1]", 10),
        ("[i * j for i, j in [(1, 2), (3, 4)] if i > 1][-1]", 12),
        ("int(2.9) + float(1) + bool(3)", 4),
        ("(1 and 0) or 5", 5),
        ("1 if not [] else 0", 1),
        ("1 if 2 in (1, 2) and 3 not in [1] else 0", 1),
        ("1 if (1, 2) == (1, 2) and [1] != [2] else 0", 1),
        ("1 if (1, 2) < (1, 3) else 0", 1),
        ("([1] + [2, 3])[2] + list((1, 2))[0] + tuple([4])[0]", 8),
    ],
)
def test_expressions_mean_what_they_mean_in_python(expression, value):
    assert result_of(expression) == pytest.approx(value)


def test_statements_mean_what_they_mean_in_python():
    before = """\
total = 0
a, (b, c) = 1, [2, 3]
d = e = 4
for i in range(10):
    if i == 2:
        continue
    if i > 5:
        break
    total += i
while d > 0:
    d -= 1
    if d == 1:
        break
row = [1, 2, 3]
row[0] = 10
row.append(20)
i = 100
inner = [i for i in range(3)]
total = total + a + b + c + d + e + row[0] + row[-1] + i"""
    assert result_of("total", before=before) == 13 + 6 + 1 + 4 + 30 + 100


def test_return_ends_the_program_from_inside_a_loop():
    source = "for i in range(5):\n    while True:\n        robot.grip(True)\n        return"
    assert len(run(source + "\nrobot.grip(False)").commands) == 1


def test_each_run_starts_afresh():
    program = compile_program(
        parse("xs = []\nxs.append(1)\nrobot.move(len(xs), 0, 0, 0)", "manipulate", ["apple"])
    )
    scene = Scene(objects=(thing("apple", 0.0, 0.0),))
    assert execute(program, scene, no_solver) == execute(program, scene, no_solver)


# --- objects that are not there ------------------------------------------------------------------


@pytest.mark.parametrize("test", ["kiwi is None", "kiwi == None", "not kiwi", "not (kiwi and 1)"])
def test_an_absent_object_is_none(test):
    assert result_of(f"1 if {test} else 0") == 1


@pytest.mark.parametrize("test", ["apple is not None", "apple != None", "apple", "apple and 1"])
def test_a_present_object_is_not(test):
    assert result_of("hit", before=f"hit = 0\nif {test}:\n    hit = 1") == 1


def test_an_absent_object_has_no_position():
    with pytest.raises(ProgramFailed, match="if kiwi is None") as failure:
        run("if kiwi is None:\n    pass\nrobot.move(kiwi.x, 0, 0, 0)")
    assert failure.value.line == 3


def test_one_of_several_is_never_taken_for_absent():
    fruit = [
        SceneObject(id=name, name="fruit", x=0.0, y=0.0, width=0.1, height=0.1, tall=0.1)
        for name in ("red", "green")
    ]
    with pytest.raises(NotAllowed, match="red, green"):
        run("if fruit is None:\n    robot.grip(True)", Scene(objects=tuple(fruit)))


# --- what goes wrong says so -------------------------------------------------------------------


@pytest.mark.parametrize(
    ("expression", "reason"),
    [
        ("1 / 0", "division by zero"),
        ("1 % 0", "division by zero"),
        ("1e308 * 10", "not a finite number"),
        ("1e308 - -1e308", "not a finite number"),
        ("2 ** 60", "too large"),
        ("10.0 ** 400", "too large"),
        ("9 ** 9 ** 9", "too large"),
        ("(-8) ** 0.5", "not a real number"),
        ("0 ** -1", "not a real number"),
        ("9007199254740992 * 9007199254740992", "too large"),
        ("int(1e300)", "too large"),
        ("math.sqrt(-1)", "no real, finite result"),
        ("math.log(0)", "no real, finite result"),
        ("math.exp(1000)", "no real, finite result"),
        ("[1] * 1000000", "needs a number, not a list"),
        ("'a' * 100", "needs a number, not a text"),
        ("'a' + 'b'", "needs a number, not a text"),
        ("(1,) + (2,)", "needs a number, not a tuple"),
        ("None + 1", "needs a number, not None"),
        ("1 < None", "needs a number, not None"),
        ("min([])", "empty list"),
        ("sorted([1, (2, 3)])[0]", "cannot be put in order together"),
        ("max([[1], [[2]]])", "needs a number, not a list"),
        ("[1, 2][2]", "no element 2"),
        ("[1, 2][0.5]", "whole number"),
        ("1[0]", "needs a list"),
        ("len(3)", "needs a list"),
        ("range(1.5)", "whole number"),
        ("range(0, 5, 0)", "step of 0"),
        ("round(1.5, 99)", "at most 20 digits"),
        ("[1]", "needs a number, not a list"),
        ("later", "no value yet"),
    ],
)
def test_a_program_error_names_line_and_reason(expression, reason):
    with pytest.raises(ProgramFailed) as failure:
        run(f"if apple.x > 100:\n    later = 1\nrobot.move({expression}, 0, 0, 0)")
    assert reason in failure.value.reason
    assert failure.value.line == 3


@pytest.mark.parametrize(
    ("source", "reason"),
    [
        ("a, b = 1, 2, 3", "2 variables cannot take 3 values"),
        ("a, b = 1", "needs a list"),
        ("for i in 3:\n    pass", "needs a list"),
        ("x = 1\nx.append(2)", "belongs to a list"),
        ("x = (1, 2)\nx[0] = 1", "set in a list"),
        ("robot.grip(0.5)", "True or False"),
        ("robot.grip(None)", "needs a number"),
    ],
)
def test_a_statement_that_cannot_be_carried_out_says_so(source, reason):
    with pytest.raises(ProgramFailed) as failure:
        run(source)
    assert reason in failure.value.reason


def test_what_waits_in_the_tray_is_where_the_arm_takes_it_from():
    scene = Scene(tray=(thing("cup"), thing("plate")))
    (x, y) = tray_positions(scene)["cup_1"]
    assert result_of("cup.tall", scene) == 0.08
    assert (result_of("cup.x", scene), result_of("cup.y", scene)) == (x, y) and x > EDGE


def test_what_the_tray_has_no_room_for_has_no_position():
    huge = msgspec.structs.replace(thing("cup"), width=1.5)
    with pytest.raises(ProgramFailed, match="no room for the cup"):
        run("robot.move(cup.x, 0, 0, 0)", Scene(tray=(huge,)))


# --- budgets -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("source", "limit"),
    [
        ("while True:\n    pass", "100,000 steps"),
        ("while True:\n    x = [i for i in range(1000)]", "100,000 steps"),
        ("x = list(range(1000))\nwhile True:\n    y = sum(x)", "100,000 steps"),
        ("for i in range(10001):\n    pass", "10,000 numbers"),
        ("for i in range(0, 9007199254740992):\n    pass", "10,000 numbers"),
        ("x = range(1001)", "1,000 elements"),
        ("x = []\nwhile True:\n    x.append(1)", "1,000 elements"),
        ("x = [1]\nwhile True:\n    x = x + x", "1,000 elements"),
        ("x = [i for i in range(2000)]", "1,000 elements"),
        ("while True:\n    robot.grip(True)", "500 times"),
        ("x = [1]\ny = [1]\nfor i in range(30):\n    x = [x, x]\n    y = [y, y]\nz = x == y",
         "too large"),
        ("x = [1]\nx.append(x)\ny = [1]\ny.append(y)\nz = x == y", "too large"),
    ],
)  # fmt: skip
def test_budgets_end_a_program(source, limit):
    with pytest.raises(LimitReached, match=limit) as reached:
        run(source)
    assert reached.value.line > 0


def test_a_long_range_may_be_walked():
    assert result_of("n", before="n = 0\nfor i in range(10000):\n    n += 1") == 10000


def test_numbers_of_the_scene_reach_the_program_unchanged():
    angle = math.pi / 7
    scene = Scene(objects=(thing("red cube", 1 / 3, -0.25, r=angle, z=0.125),))
    (command,) = run("robot.move(red_cube.x, red_cube.y, red_cube.z, red_cube.r)", scene).commands
    assert (command.x, command.y, command.z, command.r) == (1 / 3, -0.25, 0.125, angle)

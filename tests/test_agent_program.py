"""What the little language lets through, what it refuses, and what it tells the writer."""

import ast

import pytest

from agent.errors import NotAllowed
from agent.language import allowed, evaluate, interpret
from agent.language.builtin import INSTEAD
from agent.program import MAX_CHARACTERS, MAX_LINES, instantiate, parse

NAMES = ("apple", "orange", "banana_1", "banana_2")

PUSH = """\
if orange.x < 0:
    edge, side = -1, 1
else:
    edge, side = 1, -1
robot.move(orange.x + side * (orange.width / 2 + 0.08), orange.y, 0.3, 0)
robot.move(edge * 1.1, orange.y, 0.04, 0)
"""
PICK = """\
robot.move(apple.x, apple.y, apple.z + apple.tall, 0)
robot.grip(True)
x = orange.x - orange.width / 2 - apple.width / 2 - 0.05
robot.move(x, orange.y, apple.tall, math.pi / 2)
robot.grip(False)
"""
CIRCLE = """\
# once around the apple
for i in range(13):
    a = 2 * math.pi * i / 12
    robot.move(apple.x + 0.3 * math.cos(a), apple.y + 0.3 * math.sin(a), 0.2, 0)
"""
LISTS = """\
points = [(apple.x, apple.y), (orange.x, orange.y)]
points.append((0, 0))
near = sorted([(math.hypot(x, y), x, y) for x, y in points if x >= -1])[0]
while len(points) > 1:
    points = [p for p in points if p[0] != near[1]]
    if not points:
        break
"""
ABSENT = """\
if kiwi is None or pear == None:
    return
if plum and apple.x < 0:
    robot.move(plum.x, plum.y, 0.9, 0)
robot.move(kiwi.x, pear.y, 0.9, 0)
"""
ROW = """\
solver.addConstraint(apple.x + apple.width / 2 + 0.05 <= orange.x - orange.width / 2)
solver.addConstraint((apple.y == orange.y) | "strong")
gap = Variable("gap")
solver.addConstraint(orange.x - apple.x == gap)
solver.solve()
if apple.x.value() < -0.5:
    solver.addConstraint((apple.x + orange.x) / 2 == 0)
"""


@pytest.mark.parametrize("source", [PUSH, PICK, CIRCLE, LISTS, ABSENT])
def test_the_papers_kind_of_manipulate_program_is_accepted(source):
    assert parse(source, "manipulate", NAMES).source == source


def test_the_papers_kind_of_arrange_program_is_accepted():
    program = parse(ROW, "arrange", NAMES)
    assert program.objects == {"apple", "orange"}
    assert program.variables == {"gap"}


def test_a_name_that_is_tested_for_none_may_be_absent():
    assert parse(ABSENT, "manipulate", NAMES).absent == {"kiwi", "pear", "plum"}


# --- exactly the listed node types -----------------------------------------------------------

STATEMENTS = {
    "Assign", "AugAssign", "Expr", "If", "For", "While", "Break", "Continue", "Return", "Pass",
}  # fmt: skip
EXPRESSIONS = {
    "Constant", "Name", "BinOp", "UnaryOp", "BoolOp", "Compare", "IfExp", "List", "Tuple",
    "Subscript", "ListComp", "Attribute", "Call",
}  # fmt: skip
OPERATORS = {
    "Add", "Sub", "Mult", "Div", "FloorDiv", "Mod", "Pow", "UAdd", "USub", "Not", "And", "Or",
    "Eq", "NotEq", "Lt", "LtE", "Gt", "GtE", "In", "NotIn", "Is", "IsNot",
}  # fmt: skip


def every_node_class():
    todo, found = [ast.AST], set()
    while todo:
        for kind in todo.pop().__subclasses__():
            if kind not in found:
                found.add(kind)
                todo.append(kind)
    return found


def test_every_ast_class_of_this_python_is_either_listed_or_refused():
    handled = {*allowed.STATEMENTS, *allowed.EXPRESSIONS}
    handled |= {*allowed.BINARY, *allowed.UNARY, *allowed.BOOLEAN, *allowed.ORDER}
    handled |= set(allowed.IDENTITY)
    listed = {k for k in every_node_class() if k.__name__ in STATEMENTS | EXPRESSIONS | OPERATORS}
    assert handled == listed
    assert not handled & set(INSTEAD)


def test_the_interpreter_handles_the_same_nodes_as_the_allow_list():
    assert set(interpret.STATEMENTS) == set(allowed.STATEMENTS)
    assert set(evaluate.EXPRESSIONS) == set(allowed.EXPRESSIONS)


# --- refusals: what is refused, and what the writer is told ------------------------------------

REFUSED = {
    "import os": "math is already there",
    "from os import path": "math is already there",
    "def f():\n    pass": "only its body",
    "x = lambda: 0": "where it is needed",
    "class A:\n    pass": "numbers and lists",
    "try:\n    pass\nfinally:\n    pass": "test with if",
    "with apple:\n    pass": "one after another",
    "raise 1": "use return",
    "del apple": "leave the variable alone",
    "global x": "belong to the program",
    "assert True": "use if",
    "x: float = 1": "name = value",
    "x = (y := 1)": "on a line of its own",
    "x = yield": "append to a list",
    "async def f():\n    pass": "only its body",
    "match 1:\n    case _:\n        pass": "if and elif",
    "x = f'{1}'": "only need numbers",
    "x = {1: 2}": "variables or lists",
    "x = {1}": "use a list",
    "x = sum(i for i in [1])": "in [ ]",
    "x = [*[1]]": "write the values out",
    "robot.move(*[1, 2, 3, 4])": "write the values out",
    "x = [1, 2][0:1]": "index one element",
    "x = 1 | 2": "use or",
    "x = 1 & 2": "use and",
    "x = 1 << 9": "use arithmetic",
    "x = ~1": "use not",
    "x = 1 @ 1": "use *",
    "x = b'1'": "write a number",
    "x = 1j": "write a number",
    "x = ...": "write a number",
    "x = 1e999": "not finite",
    "x = 9007199254740993": "too large",
    "apple.x = 1": "cannot be set",
    "apple.color": "does nothing",
    "x = apple.color": "x, y, z, r, width, height, tall",
    "x = apple + 1": "such as apple.x",
    "x = -apple": "such as apple.x",
    "x = apple < orange": "such as apple.x",
    "x = max(apple, orange)": "such as apple.x",
    "robot.move(apple, 0, 0, 0)": "such as apple.x",
    "x = math.sin(apple)": "such as apple.x",
    "x = apple\nx.color = 1": "cannot be set",
    "x = apple\ny = x.color": "x, y, z, r, width, height, tall",
    "x = group": "is unknown",
    "x = pick": "is unknown",
    "group('a', 'b')": "takes 0 to 1 arguments",
    "pick()": "write pick(thing)",
    "put(apple)": "write put(thing, place)",
    "pik(apple)": "did you mean pick?",
    "robot = 1": "another variable name",
    "min = 1": "another variable name",
    "apple = 1": "is an object",
    "for apple in [1]:\n    pass": "is an object",
    "x = [1 for apple in [1]]": "is an object",
    "apple += 1": "is an object",
    "x = robot": "cannot be passed around",
    "x = math": "cannot be passed around",
    "x = robot.move": "cannot be passed around",
    "x = math.sin": "did you mean",
    "x = min": "as in min(...)",
    "x = [range]": "cannot be passed around",
    "x = sorted([1], reverse)": "takes 1 arguments, not 2",
    "robot.move(1, 2, 3)": "takes 4 arguments, not 3",
    "robot.move(x=1, y=2, z=3, r=4)": "in order",
    "robot.home()": "robot.move(x, y, z, r)",
    "robot.mov(1, 2, 3, 4)": "did you mean robot.move?",
    "x = math.sinus(1)": "did you mean math.sin?",
    "x = aple.x": "did you mean apple?",
    "x = banana.x": "banana_1, banana_2",
    "if banana is None:\n    pass": "banana_1, banana_2",
    "x = print(1)": "there is no function print",
    "x = eval('1')": "there is no function eval",
    "x = getattr(apple, 'x')": "there is no function getattr",
    "x = 'a'.upper()": "is not allowed",
    "x = (1).real": "only objects of the scene",
    "x = [1].append": "only objects of the scene",
    "x = [1]\nx.pop()": ".append(x) of a list",
    "x = [1]()": "only named functions",
    "x = 1 if 1 is 1 else 0": "write ==",
    "break": "outside a loop",
    "for i in [1]:\n    pass\nelse:\n    pass": "use a variable and if",
    "x = [1 for i in [1] for j in [1]]": "use a loop",
    "'apple'": "write a comment",
    "solver.solve()": "belongs to arrange programs",
    "x = Variable('a')": "there is no function Variable",
    "x = apple.x.value()": "use the number itself",
    "": "empty",
    "# nothing": "empty",
    "x = ": "not valid Python",
    "if apple.x < 0:\n    return\n  robot.grip(True)": "not valid Python",
}


@pytest.mark.parametrize("source", REFUSED)
def test_refusals_tell_the_writer_what_to_do_instead(source):
    with pytest.raises(NotAllowed) as refusal:
        parse(source, "manipulate", NAMES)
    assert REFUSED[source] in refusal.value.reason


def test_a_refusal_names_line_and_column():
    with pytest.raises(NotAllowed) as refusal:
        parse("x = 1\nif x > 0:\n    y = aple.x", "manipulate", NAMES)
    assert (refusal.value.line, refusal.value.column) == (3, 9)


def test_dead_code_is_checked_too():
    with pytest.raises(NotAllowed):
        parse("return\nimport os", "manipulate", NAMES)


@pytest.mark.parametrize(
    ("source", "advice"),
    [
        ("robot.move(0, 0, 0, 0)", "solver.addConstraint"),
        ('solver.addConstraint(apple.x <= 0 | "strong" | 1)', "strength is one of"),
        ('solver.addConstraint((apple.x <= 0) | "hard")', "required, strong, medium, weak"),
        ("solver.addConstraint()", "takes 1 arguments, not 0"),
        ("x = Variable", "cannot be passed around"),
        ("solver = 1", "another variable name"),
    ],
)
def test_arrange_programs_have_the_solver_and_no_robot(source, advice):
    with pytest.raises(NotAllowed, match=None) as refusal:
        parse(source, "arrange", NAMES)
    assert advice in refusal.value.reason


# --- tricks with the text ----------------------------------------------------------------------

TRICKS = [
    "x = 1\rimport os",
    "x = 1\x0cimport os",
    "x = 1\x0bimport os",
    "x = 1\x00",
    "if True:\n\tpass",
    "x = 1 \\\n + 1",
    "x = '\\x41'",
    "x = apple.__class__",
    "x = '__class__'",
    "# __",
    "x = “1”",
    "ｘ = 1",
    "аpple = 1",
    "x = 1\u2028import os",
    "\ufeffx = 1",
    "x = '\u202e'",
    "\udc80 = 1",
    "x = " + "9" * 31,
    "x = 1" + "_0" * 20,
    "a" * 41 + " = 1",
    "x = " + "(" * 21 + ")" * 21,
    "x = " + "-" * 200 + "1",
    "x = (" + ("-" * 290 + "\n") * 20 + "1)",
    "x = (" + ("not " * 70 + "\n") * 20 + "1)",
    "x = (" + ("+1" * 120 + "\n") * 30 + ")",
    "x = 1" + " " * 300,
    "\n" * (MAX_LINES + 1),
    "x = 1\n" + "#" * MAX_CHARACTERS,
    "x = [" + "[" * 19 + "1" + "]" * 19 + "\n]]",
]


@pytest.mark.parametrize("source", TRICKS, ids=range(len(TRICKS)))
def test_tricks_with_the_text_are_refused(source):
    with pytest.raises(NotAllowed):
        parse(source, "manipulate", NAMES)


def test_a_long_chain_of_elif_is_refused_before_the_stack_runs_out():
    chain = "if apple.x > 0:\n    pass\n" + "elif apple.x > 1:\n    pass\n" * 95
    with pytest.raises(NotAllowed, match="nested too deeply"):
        parse(chain, "manipulate", NAMES)


# --- slots -------------------------------------------------------------------------------------


def test_instantiate_replaces_whole_names_all_at_once():
    body = 'robot.move(m1.x, m12.m1, m2.x, 0)  # m1 stays\nx = Variable("m1")\nm1_x = m1.y'
    filled = instantiate(body, {"m1": "m2", "m2": "apple"})
    assert filled == (
        'robot.move(m2.x, m12.m1, apple.x, 0)  # m1 stays\nx = Variable("m1")\nm1_x = m2.y'
    )

"""The language means what Python means: the same bodies in the interpreter and in Python itself.

`tests/data/benign.toml` and the expert pairs of the paper run on random scenes twice: here, by
Python itself with plain stand-ins for the robot, the solver and the objects, and by the language.
Both must do exactly the same: equal commands to the last bit, equal constraints; where Python
raises, the language reports a ProgramError.

Where the language differs from Python, no benign body goes:
- whole numbers beyond 2**53, infinities and NaN are errors; so is a complex number at once;
- nothing repeats sequences (no ``[0] * 3``), and texts are not joined;
- a range is a list (``range(3) == [0, 1, 2]``), texts have no order, letters or length;
- lists are ordered by the numbers that they begin with, the rest must not decide; comparing huge
  or self-containing ones is an error;
- ``float("1")`` and ``int("1")`` are errors: there is no text that is a number;
- a comparison of two numbers may carry a strength, as a constraint does;
- neither a constraint nor an unknown is true or false, not even through ``in``;
- a comprehension stands in another's only as what that one walks over;
- the gripper takes 0, 1, False or True, nothing else; no motion goes to the end of the world.
"""

import ast
import builtins
import math
import random
import re
import tomllib
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

import msgspec
import program_texts
import program_trees
import pytest
from plain_python import Stated, python_commands, python_constraints
from program_texts import free_names

from agent.errors import ProgramError, ProgramFailed, Unsatisfiable
from agent.execute import Executor
from agent.language.allowed import (
    BINARY,
    BOOLEAN,
    EXPRESSIONS,
    IDENTITY,
    ORDER,
    STATEMENTS,
    UNARY,
)
from agent.language.builtin import (
    BUILTINS,
    MATH_CALLS,
    MATH_CONSTANTS,
    OBJECT_NUMBERS,
)
from agent.language.interpret import compile_program, execute
from agent.messages import Draft
from agent.program import parse
from scene.generate import random_scene
from scene.types import identifiers
from translator.corpus.load import load

SCENES = 40
BENIGN = Path(__file__).parent / "data" / "benign.toml"


@dataclass(frozen=True)
class Body:
    """A program and the scenes it is for; see the head of benign.toml."""

    id: str
    kind: str
    program: str
    sometimes: tuple = ()
    absent: tuple = ()
    also: tuple = ()
    on_table: tuple = ()
    may_raise: bool = False
    states_nothing: bool = False
    error: str = ""


def read_benign():
    tables = tomllib.loads(BENIGN.read_text(encoding="utf-8"))
    for section, entries in tables.items():
        kind = "arrange" if section == "arrange" else "manipulate"
        for number, entry in enumerate(entries, 1):
            entry = {"id": f"{section}-{number}", **entry}
            yield section, Body(kind=kind, **{k: _frozen(v) for k, v in entry.items()})


def _frozen(value):
    return tuple(value) if isinstance(value, list) else value


def section(name):
    return [body for where, body in read_benign() if where == name]


def paper(kind):
    return [Body(pair.id, kind, pair.program) for pair in load(kind)]


def by_id(bodies):
    return pytest.mark.parametrize("body", bodies, ids=[body.id for body in bodies])


# --- scenes ------------------------------------------------------------------------------------


def noun(name):
    """``cup_2`` -> "cup", ``red_cube`` -> "red cube"."""
    return re.sub(r"_\d+$", "", name).replace("_", " ")


@cache
def scene_of(kind, present, on_table, seed):
    rng = random.Random(f"{present} {seed}")
    standing = [name for name in present if kind == "manipulate" or name in on_table]
    waiting = [name for name in present if name not in standing]
    scene = random_scene(rng, [noun(name) for name in standing], [noun(name) for name in waiting])
    turned = [msgspec.structs.replace(o, r=round(rng.uniform(-1.5, 1.5), 3)) for o in scene.objects]
    scene = msgspec.structs.replace(scene, objects=tuple(turned))
    assert set(identifiers(scene)) == set(present)
    return scene


def scenes_of(body, count=SCENES):
    names = [name for name in free_names(body.program) if name not in body.absent]
    names += [name for name in body.also if name not in names]
    often = [name for name in names if name not in body.sometimes]
    return [
        scene_of(body.kind, tuple(often if seed % 2 else names), body.on_table, seed)
        for seed in range(count)
    ]


# --- motions -----------------------------------------------------------------------------------


def our_commands(result):
    if isinstance(result, ProgramError):
        return result
    assert isinstance(result, Draft)
    return [(c.op, c.x, c.y, c.z, c.r, c.grip) for c in result.commands]


def alike(ours, pythons):
    """Equal commands (the sign of zero counts), or an error on both sides."""
    if isinstance(ours, ProgramError) or isinstance(pythons, Exception):
        return isinstance(ours, ProgramError) and isinstance(pythons, Exception)
    return repr(ours) == repr(pythons)


@pytest.fixture(scope="module")
def executor():
    with Executor(deadline_s=10.0) as executor:
        yield executor


@by_id(section("manipulate") + paper("manipulate"))
def test_a_manipulate_program_moves_the_robot_as_python_would(executor, body):
    scenes = scenes_of(body)
    results = executor.run(body.program, "manipulate", scenes)
    for scene, result in zip(scenes, results, strict=True):
        ours, pythons = our_commands(result), python_commands(body.program, scene)
        assert alike(ours, pythons), (ours, pythons)
        assert body.may_raise or not isinstance(pythons, Exception)


@by_id(section("failing"))
def test_what_python_raises_is_an_error_of_the_program(executor, body):
    scenes = scenes_of(body, 2)
    results = executor.run(body.program, "manipulate", scenes)
    for scene, result in zip(scenes, results, strict=True):
        assert type(python_commands(body.program, scene)).__name__ == body.error
        assert isinstance(result, ProgramFailed) and result.line


def test_a_random_program_that_gets_to_its_end_moves_the_robot_as_python_would():
    scene = program_texts.SCENES["manipulate"]
    compared = 0
    for seed in range(1500):
        source = program_trees.body(random.Random(seed), "manipulate", wild=False)
        try:
            program = parse(source, "manipulate", identifiers(scene))
            ours = our_commands(execute(compile_program(program), scene, Refuser))
        except ProgramError:
            continue
        assert alike(ours, python_commands(source, scene)), seed
        compared += 1
    assert compared > 300


# --- constraints -------------------------------------------------------------------------------


class AllStated(Exception):
    """The body ended; what its solution would be is not asked here."""


@dataclass
class Recorder:
    """The solver passed to the language; see `agent.language.arrange.Solver`."""

    solves: bool
    constraints: list = field(default_factory=list)
    solutions: list = field(default_factory=list)

    def add(self, constraint, weight=None):
        if weight is None:
            expression = constraint.expression
            self.constraints.append(
                Stated(
                    dict(expression.terms),
                    expression.constant,
                    constraint.relation,
                    constraint.strength,
                )
            )
        return True

    def values(self):
        if not self.solves:
            raise AllStated
        self.solutions.append(some_solution(self.constraints))
        return self.solutions[-1]


class Refuser:
    """A solver that can do nothing: objects that overlap stay where they are."""

    def add(self, constraint, weight=None):
        return False

    def values(self):
        return {}


def some_solution(constraints):
    """A point where all required constraints hold, if there is one: by projecting on each."""
    required = [c for c in constraints if c.strength == "required"]
    keys = sorted({key for c in constraints for key in c.terms})
    point = {key: math.sin(1 + 2.3 * key) for key in keys}
    for _ in range(2000):
        misses = [_project(constraint, point) for constraint in required]
        if max(misses, default=0.0) < 1e-9:
            break
    return point


def _project(constraint, point):
    """Move the point to the nearest one where the constraint holds; how far it missed."""
    left = constraint.constant + sum(c * point[key] for key, c in constraint.terms.items())
    holds = {"<=": left <= 0, ">=": left >= 0, "==": left == 0}[constraint.relation]
    if holds:
        return 0.0
    norm = sum(c * c for c in constraint.terms.values())
    for key, coefficient in constraint.terms.items():
        point[key] -= coefficient * left / norm
    return abs(left)


def our_constraints(body, scene):
    """What a body states when the language runs it, the solutions it saw, whether it ended."""
    recorder = Recorder(".solve()" in body.program)
    solvers = iter([recorder])
    code = compile_program(parse(body.program, "arrange", identifiers(scene)))
    ended = True
    try:
        execute(code, scene, lambda: next(solvers, None) or Refuser())
    except AllStated:
        pass
    except Unsatisfiable:
        ended = False
    return recorder.constraints, recorder.solutions, ended


def canonical(stated):
    """Without the freedom of writing ``a >= b`` as ``b <= a``, or ``a == b`` as ``b == a``."""
    keys = sorted(stated.terms)
    flip = stated.relation == ">=" or (stated.relation == "==" and stated.terms[keys[0]] < 0)
    sign = -1 if flip else 1
    relation = "==" if stated.relation == "==" else "<="
    numbers = [sign * stated.constant, *(sign * stated.terms[key] for key in keys)]
    return keys, relation, stated.strength, pytest.approx(numbers, rel=1e-12, abs=1e-12)


def assert_same_constraints(ours, pythons):
    for our, python in zip(ours, pythons, strict=True):
        *words, numbers = canonical(our)
        *python_words, python_numbers = canonical(python)
        assert words == python_words
        assert numbers.expected == python_numbers


@by_id(section("arrange") + paper("arrange"))
def test_an_arrange_program_states_the_constraints_that_python_would(body):
    for scene in scenes_of(body):
        ours, solutions, ended = our_constraints(body, scene)
        assert ours or body.states_nothing
        pythons, python_ended = python_constraints(body.program, scene, solutions)
        assert_same_constraints(ours, pythons)
        assert ended == python_ended


@by_id(section("arrange"))
def test_a_benign_layout_is_solved_in_the_worker_too(executor, body):
    results = executor.run(body.program, "arrange", scenes_of(body, 4))
    assert all(isinstance(result, Draft | Unsatisfiable) for result in results), results


# --- the benign bodies leave nothing out -----------------------------------------------------


def every_node():
    for where, body in read_benign():
        if where != "failing":
            yield from ast.walk(ast.parse(body.program))


def test_benign_bodies_use_every_construct():
    used = {type(node) for node in every_node()}
    listed = {*STATEMENTS, *EXPRESSIONS, *BINARY, *UNARY, *BOOLEAN, *ORDER, *IDENTITY}
    assert listed <= used


def calls(owner):
    """(name, number of arguments) of every call of a function of ``math`` or of Python's own."""
    for node in every_node():
        if not isinstance(node, ast.Call):
            continue
        function = node.func
        if owner is None and isinstance(function, ast.Name):
            yield function.id, len(node.args)
        elif owner and isinstance(function, ast.Attribute) and _is_name(function.value, owner):
            yield function.attr, len(node.args)


def _is_name(node, name):
    return isinstance(node, ast.Name) and node.id == name


def arities(low, high):
    """The numbers of arguments to try: all of a few, else the fewest and some more."""
    return range(low, min(high, low + 2) + 1)


def test_benign_bodies_call_every_function_with_few_and_many_arguments():
    of_python = {name: arity for name, arity in BUILTINS.items() if hasattr(builtins, name)}
    wanted = {(name, n) for name, arity in of_python.items() for n in arities(*arity)}
    assert wanted - set(calls(None)) == set()
    wanted = {(name, n) for name, (_, low, high) in MATH_CALLS.items() for n in arities(low, high)}
    assert wanted - set(calls("math")) == set()


def attributes(of_math):
    for node in every_node():
        if isinstance(node, ast.Attribute) and _is_name(node.value, "math") is of_math:
            yield node.attr


def test_benign_bodies_read_every_number():
    assert set(MATH_CONSTANTS) <= set(attributes(of_math=True))
    assert set(OBJECT_NUMBERS) <= set(attributes(of_math=False))


def test_there_are_enough_benign_bodies():
    assert len(section("manipulate")) >= 160
    assert len(section("arrange")) >= 60

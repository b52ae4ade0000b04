"""Runs a Program on one scene: closures compiled from the tree, in a fresh environment each time.

Values are numbers, bools, None, short texts, lists, tuples and opaque handles
(`agent.language.guards`): program code never holds an object of the host. Budgets are counted,
not timed; nothing in the language can catch an error. There is no exec and no eval. Nothing here
moves a robot: a run yields a Draft, which nobody trusts until it is checked.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cache, partial
from typing import Any

import msgspec

from agent.errors import LimitReached, NotAllowed, ProgramError
from agent.language import guards, operators
from agent.language.allowed import Checker
from agent.language.arrange import Arrangement, NewSolver
from agent.language.evaluate import iterate, load_name, store_to, truth, value
from agent.language.naming import Names
from agent.language.prelude import functions
from agent.language.run import Own, Run
from agent.messages import Draft, Kind
from agent.program import Program
from scene.tray import tray_positions
from scene.types import Scene, SceneObject, identifiers, slug

Execute = Callable[[Run], str | None]
"""Runs a statement; returns "break", "continue" or "return" when it leaves the block."""


@dataclass(frozen=True)
class Code:
    """A program ready to run, on any scene that has its names."""

    program: Program
    body: Execute


def compile_program(program: Program) -> Code:
    """Closures for a program that passed the allow-list."""
    return Code(program, block(program.body))


def execute(code: Code, scene: Scene, new_solver: NewSolver) -> Draft:
    """Run a program on a scene from its first line to its last.

    Raises ProgramFailed, Unsatisfiable or LimitReached with the line, NotAllowed when the scene
    has several of an object that the program takes for absent.
    """
    program = code.program
    objects: dict[str, SceneObject | None] = dict(identifiers(scene))
    _absent(program, scene, objects)
    holding = any(item.held for item in scene.objects)
    arrangement = Arrangement(scene, new_solver) if program.kind == "arrange" else None
    if arrangement is None:
        objects |= _waiting(objects, scene)
    run = Run(objects, arrangement, partial(own_function, program.kind), holding)
    try:
        code.body(run)
        placements = arrangement.finish() if arrangement is not None else ()
    except ProgramError as error:
        if error.line:
            raise
        raise type(error)(error.reason, run.line, error.column) from None
    except RecursionError:
        raise LimitReached("the program is nested too deeply", run.line) from None
    return Draft(tuple(run.commands), placements, run.steps)


def _waiting(objects: Mapping[str, SceneObject | None], scene: Scene) -> dict[str, SceneObject]:
    """What waits in the tray, by the names that the program may use, where the arm takes it from;
    what the tray has no room for has no place."""
    places = tray_positions(scene)
    return {
        name: msgspec.structs.replace(item, x=places[item.id][0], y=places[item.id][1])
        for name, item in objects.items()
        if item is not None and item.id in places
    }


def _absent(program: Program, scene: Scene, objects: dict[str, SceneObject | None]) -> None:
    for name in sorted(program.absent):
        same = [known for known, item in objects.items() if item and slug(item.name) == name]
        if same:
            raise NotAllowed(f"there are several: write one of {', '.join(same)}, not {name}")
        objects[name] = None


@cache
def own_function(kind: Kind, name: str) -> Own:
    """A function of `agent.language.prelude`, checked as every program is, and compiled."""
    function = functions(kind)[name]
    nodes = [node for part in function.body for node in ast.walk(part)]
    variables = Names.of(nodes, ()).variables | set(function.parameters)
    names = Names(frozenset(), frozenset(), frozenset(variables))
    Checker(kind, names).block(function.body)
    return function.parameters, block(function.body)


# --- statements ---


def block(body: Iterable[ast.stmt]) -> Execute:
    """Statements one after another."""
    steps = [(node.lineno, STATEMENTS[type(node)](node)) for node in body]

    def run_block(run: Run) -> str | None:
        for line, statement in steps:
            if not run.within:
                run.line = line
                run.statement += 1
            run.step()
            leave = statement(run)
            if leave is not None:
                return leave
        return None

    return run_block


def _assign(node: ast.Assign) -> Execute:
    source = value(node.value)
    stores = [store_to(target) for target in node.targets]

    def run_assign(run: Run) -> None:
        result = source(run)
        for store in stores:
            store(run, result)

    return run_assign


def _augmented(node: ast.AugAssign) -> Execute:
    assert isinstance(node.target, ast.Name)
    load, right = load_name(node.target.id), value(node.value)
    name, operate = node.target.id, operators.BINARY[type(node.op)]

    def run_augmented(run: Run) -> None:
        run.step()
        before, more = load(run), right(run)
        if isinstance(before, list) and isinstance(node.op, ast.Add):
            before += guards.items(more, "+=")  # all who hold the list see it, as in Python
            guards.sized(before)
        else:
            run.variables[name] = operate(before, more)

    return run_augmented


def _expression(node: ast.Expr) -> Execute:
    call = value(node.value)

    def run_expression(run: Run) -> None:
        call(run)

    return run_expression


def _if(node: ast.If) -> Execute:
    test, then, otherwise = truth(node.test), block(node.body), block(node.orelse)
    return lambda run: then(run) if test(run) else otherwise(run)


def _while(node: ast.While) -> Execute:
    test, body, line = truth(node.test), block(node.body), node.lineno

    def run_while(run: Run) -> str | None:
        while test(run):
            run.step()
            leave = body(run)
            if leave == "break":
                break
            if leave == "return":
                return leave
            if not run.within:
                run.line = line
        return None

    return run_while


def _for(node: ast.For) -> Execute:
    each, store, body = iterate(node.iter), store_to(node.target), block(node.body)

    def run_for(run: Run) -> str | None:
        for item in each(run):
            run.step()
            store(run, item)
            leave = body(run)
            if leave == "break":
                break
            if leave == "return":
                return leave
        return None

    return run_for


def _return(node: ast.Return) -> Execute:
    result = value(node.value) if node.value is not None else None

    def run_return(run: Run) -> str:
        run.result = result(run) if result is not None else None
        return "return"

    return run_return


STATEMENTS: dict[type[ast.stmt], Callable[[Any], Execute]] = {
    ast.Assign: _assign,
    ast.AugAssign: _augmented,
    ast.Expr: _expression,
    ast.If: _if,
    ast.For: _for,
    ast.While: _while,
    ast.Break: lambda node: lambda run: "break",
    ast.Continue: lambda node: lambda run: "continue",
    ast.Return: _return,
    ast.Pass: lambda node: lambda run: None,
}

"""Expressions and calls of the little language, compiled to closures over a `Run`.

Attributes and calls were recognised when the program was checked: nothing is looked up on a host
object by a name that a program chose, but for the numbers of a scene object (`OBJECT_NUMBERS`).
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator
from typing import Any, cast

from agent.errors import ProgramFailed
from agent.language import functions, guards, operators
from agent.language.builtin import MATH_CONSTANTS, STRENGTHS
from agent.language.calls import (
    HANDLE_CALLS,
    about,
    append,
    by_now,
    call_function,
    call_own,
    choices,
    either,
    group,
    known,
    no_less,
    open_box,
    placed,
    present,
    same_color,
    so_far,
    tool_at,
    turned,
    value_of,
    variable,
    where,
    wish,
)
from agent.language.expression import Constraint
from agent.language.guards import Value
from agent.language.naming import none_test
from agent.language.run import Evaluate, Run
from agent.language.things import Thing


def value(node: ast.expr) -> Evaluate:
    """The closure that computes an expression."""
    return EXPRESSIONS[type(node)](node)


def truth(node: ast.expr) -> Callable[[Run], bool]:
    """The closure that tests an expression; an object is true if it is there."""
    compute = value(node)
    return lambda run: guards.truth(compute(run))


def _constant(node: ast.Constant) -> Evaluate:
    constant = cast(Value, node.value)  # bytes, complex and ... were refused
    return lambda run: constant


def _name(node: ast.Name) -> Evaluate:
    return load_name(node.id)


def load_name(name: str) -> Evaluate:
    """The closure that reads a variable of the program, or an object (None if it is absent)."""

    def load(run: Run) -> Value:
        try:
            return run.variables[name]
        except KeyError:
            pass
        try:
            item = run.objects[name]
        except KeyError:
            raise ProgramFailed(f"{name} has no value yet: assign it first") from None
        return None if item is None else Thing(item)

    return load


def _binary(node: ast.BinOp) -> Evaluate:
    left, right = value(node.left), value(node.right)
    if isinstance(node.op, ast.BitOr):
        return lambda run: _strengthen(left(run), right(run))
    operate = operators.BINARY[type(node.op)]

    def compute(run: Run) -> Value:
        run.step()
        return operate(left(run), right(run))

    return compute


def _strengthen(constraint: Value, strength: Value) -> Value:
    if not (isinstance(strength, str) and strength in STRENGTHS):
        raise ProgramFailed(f"a strength is one of {', '.join(STRENGTHS)}")
    if isinstance(constraint, bool):  # both sides were numbers: it holds, or it never will
        return constraint or strength != "required"
    if not isinstance(constraint, Constraint):
        raise ProgramFailed(
            f"a strength belongs to a constraint, not to {guards.describe(constraint)}"
        )
    return Constraint(constraint.expression, constraint.relation, strength)  # type: ignore[arg-type]


def _unary(node: ast.UnaryOp) -> Evaluate:
    if isinstance(node.op, ast.Not):
        test = truth(node.operand)
        return lambda run: not test(run)
    operand = value(node.operand)
    operate = operators.negate if isinstance(node.op, ast.USub) else operators.positive
    return lambda run: operate(operand(run))


def _boolean(node: ast.BoolOp) -> Evaluate:
    parts = [value(part) for part in node.values]
    stop_at = isinstance(node.op, ast.Or)

    def compute(run: Run) -> Value:
        result: Value = None
        for part in parts:
            result = part(run)
            if guards.truth(result) is stop_at:
                break
        return result

    return compute


def _compare(node: ast.Compare) -> Evaluate:
    if none_test(node):
        return _compare_none(node)
    first = value(node.left)
    rest = [(type(op), value(part)) for op, part in zip(node.ops, node.comparators, strict=True)]

    def compute(run: Run) -> Value:
        left, result = first(run), True
        for number, (op, part) in enumerate(rest):
            right, budget = part(run), [operators.MAX_COMPARED]
            outcome = operators.compare(op, left, right, budget)
            run.step(1 + operators.MAX_COMPARED - budget[0])
            if number == len(rest) - 1:
                return outcome
            result = guards.truth(outcome)
            if not result:
                return result
            left = right
        return result

    return compute


def _compare_none(node: ast.Compare) -> Evaluate:
    negated = isinstance(node.ops[0], ast.IsNot | ast.NotEq)
    compute = value(node.left)
    return lambda run: (compute(run) is None) is not negated


def _conditional(node: ast.IfExp) -> Evaluate:
    test, then, otherwise = truth(node.test), value(node.body), value(node.orelse)
    return lambda run: then(run) if test(run) else otherwise(run)


def _list(node: ast.List) -> Evaluate:
    parts = [value(part) for part in node.elts]

    def compute(run: Run) -> Value:
        run.step(len(parts))
        return guards.sized([part(run) for part in parts])

    return compute


def _tuple(node: ast.Tuple) -> Evaluate:
    parts = [value(part) for part in node.elts]

    def compute(run: Run) -> Value:
        run.step(len(parts))
        return tuple(guards.sized([part(run) for part in parts]))

    return compute


def _index(node: ast.Subscript) -> Evaluate:
    owner, position = value(node.value), value(node.slice)

    def compute(run: Run) -> Value:
        run.step()
        values = guards.items(owner(run), "an index")
        return values[guards.index(values, position(run))]

    return compute


def _comprehension(node: ast.ListComp) -> Evaluate:
    clause = node.generators[0]
    each, store, element = iterate(clause.iter), store_to(clause.target), value(node.elt)
    tests = [truth(test) for test in clause.ifs]

    def compute(run: Run) -> Value:
        outer, result = run.variables, list[Value]()
        source = each(run)
        run.variables = dict(outer)  # its variable is its own, as in Python
        try:
            for item in source:
                run.step()
                store(run, item)
                if all(test(run) for test in tests):
                    guards.sized(result)
                    result.append(element(run))
        finally:
            run.variables = outer
        return guards.sized(result)

    return compute


def _attribute(node: ast.Attribute) -> Evaluate:
    attribute = node.attr  # one of OBJECT_NUMBERS, or of MATH_CONSTANTS: checked
    if isinstance(node.value, ast.Name):
        return _attribute_of_name(node.value.id, attribute)
    owner = value(node.value)
    return lambda run: _number_of(run, owner(run), attribute)


def _attribute_of_name(name: str, attribute: str) -> Evaluate:
    if name == "math":
        constant = MATH_CONSTANTS[attribute]
        return lambda run: constant

    variable = load_name(name)

    def load(run: Run) -> Value:
        if name in run.variables or name not in run.objects:
            return _number_of(run, variable(run), attribute)
        item = run.objects[name]
        if item is None:
            raise ProgramFailed(f"there is no {name}: test `if {name} is None` before using it")
        result: float | None = getattr(item, attribute)
        return run.unknown(item, attribute) if result is None else result

    return load


def _number_of(run: Run, owner: Value, attribute: str) -> Value:
    item = guards.thing(owner, f".{attribute}").item
    result: float | None = getattr(item, attribute)
    return run.unknown(item, attribute) if result is None else result


def iterate(node: ast.expr) -> Callable[[Run], Iterator[Value]]:
    """The elements of a list, or of a ``range`` (which here may be longer than a list)."""
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "range":
        arguments = [value(argument) for argument in node.args]
        return lambda run: iter(functions.span(*[argument(run) for argument in arguments]))
    source = value(node)
    return lambda run: iter(guards.items(source(run), "for"))


def store_to(node: ast.expr) -> Callable[[Run, Value], None]:
    """The closure that assigns to a variable, to several, or to an element of a list."""
    if isinstance(node, ast.Name):
        name = node.id
        return lambda run, result: run.variables.__setitem__(name, result)
    if isinstance(node, ast.Subscript):
        return _store_element(node)
    assert isinstance(node, ast.Tuple | ast.List)
    stores = [store_to(part) for part in node.elts]

    def unpack(run: Run, result: Value) -> None:
        for store, part in zip(stores, guards.unpack(result, len(stores)), strict=True):
            store(run, part)

    return unpack


def _store_element(node: ast.Subscript) -> Callable[[Run, Value], None]:
    owner, position = value(node.value), value(node.slice)

    def store(run: Run, result: Value) -> None:
        values = owner(run)
        if not isinstance(values, list):
            raise ProgramFailed(
                f"an element can be set in a list, not in {guards.describe(values)}"
            )
        values[guards.index(values, position(run))] = result

    return store


# --- calls ---


def _call(node: ast.Call) -> Evaluate:
    arguments = [value(argument) for argument in node.args]
    if isinstance(node.func, ast.Name):
        return _call_name(node.func.id, arguments)
    assert isinstance(node.func, ast.Attribute)
    method, base = node.func.attr, node.func.value
    if isinstance(base, ast.Name) and base.id == "math":
        return call_function(functions.mathematical(method), arguments)
    if isinstance(base, ast.Name) and base.id in ("robot", "solver"):
        return HANDLE_CALLS[base.id, method](arguments)
    owner = value(base)
    if method == "value":
        return lambda run: value_of(run, owner(run))
    return lambda run: append(run, owner(run), arguments[0](run))


_OF_PLACES = {"where": where, "known": known, "either": either, "choices": choices,
              "about": about, "no_less": no_less, "so_far": so_far}  # fmt: skip
_OF_OBJECTS: dict[str, Callable[..., Value]] = {
    "group": group, "placed": placed, "turned": turned, "present": present, "by_now": by_now,
    "same_color": same_color, "open_box": open_box, "wish": wish,
    "tool_at": tool_at,
}  # fmt: skip


def _call_name(name: str, arguments: list[Evaluate]) -> Evaluate:
    if name == "Variable":
        return lambda run: variable(run, arguments[0](run))
    if name in _OF_OBJECTS:
        of_objects = _OF_OBJECTS[name]
        return lambda run: of_objects(run, *[argument(run) for argument in arguments])
    if name in _OF_PLACES:
        of_place = _OF_PLACES[name]
        return lambda run: of_place(run, arguments[0](run))
    if name in functions.FUNCTIONS:
        return call_function(functions.FUNCTIONS[name], arguments)
    return call_own(name, arguments)


EXPRESSIONS: dict[type[ast.expr], Callable[[Any], Evaluate]] = {
    ast.Constant: _constant,
    ast.Name: _name,
    ast.BinOp: _binary,
    ast.UnaryOp: _unary,
    ast.BoolOp: _boolean,
    ast.Compare: _compare,
    ast.IfExp: _conditional,
    ast.List: _list,
    ast.Tuple: _tuple,
    ast.Subscript: _index,
    ast.ListComp: _comprehension,
    ast.Attribute: _attribute,
    ast.Call: _call,
}

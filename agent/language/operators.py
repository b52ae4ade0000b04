"""Operators of the little language, each guarded.

They take and return values of the language only (`Value`) and raise ProgramFailed without a line.
"""

from __future__ import annotations

import ast
import math
import operator
from collections.abc import Callable, Sequence
from typing import Any

from agent.errors import LimitReached, ProgramFailed
from agent.language import expression as linear
from agent.language.allowed import MAX_INT
from agent.language.expression import Constraint, Expression
from agent.language.guards import Number, Value, items, number, settled, sized, truth
from agent.language.things import Thing

MAX_COMPARED = 10_000
"""Most pairs of elements compared by one ``==`` or ``in``: lists may hold lists."""


def add(left: Value, right: Value) -> Value:
    """``left + right``: of numbers, of unknowns, or of two lists or two tuples."""
    if isinstance(left, Expression) or isinstance(right, Expression):
        return linear.add(_linear(left, "+"), _linear(right, "+"))
    if isinstance(left, list) and isinstance(right, list):
        return sized([*left, *right])
    if isinstance(left, tuple) and isinstance(right, tuple):
        return tuple(sized([*left, *right]))
    return settled(number(left, "+") + number(right, "+"))


def _subtract(left: Value, right: Value) -> Value:
    if isinstance(left, Expression) or isinstance(right, Expression):
        return linear.add(_linear(left, "-"), _linear(right, "-"), -1.0)
    return settled(number(left, "-") - number(right, "-"))


def _multiply(left: Value, right: Value) -> Value:
    if isinstance(left, Expression) and isinstance(right, Expression):
        if not left.terms or not right.terms:
            return (
                linear.scale(left, right.constant)
                if left.terms
                else linear.scale(right, left.constant)
            )
        raise ProgramFailed("two unknowns cannot be multiplied: constraints are linear")
    if isinstance(left, Expression):
        return linear.scale(left, float(number(right, "*")))
    if isinstance(right, Expression):
        return linear.scale(right, float(number(left, "*")))
    return settled(number(left, "*") * number(right, "*"))


def _divide(left: Value, right: Value) -> Value:
    if isinstance(right, Expression):
        raise ProgramFailed("dividing by an unknown is not linear: multiply the other side")
    divisor = number(right, "/")
    if divisor == 0:
        raise ProgramFailed("division by zero")
    if isinstance(left, Expression):
        return linear.scale(left, 1.0 / divisor)
    return settled(number(left, "/") / divisor)


def _whole(symbol: str, compute: Callable[[Any, Any], Any]) -> Callable[[Value, Value], Value]:
    def guarded(left: Value, right: Value) -> Value:
        dividend, divisor = number(left, symbol), number(right, symbol)
        if divisor == 0:
            raise ProgramFailed("division by zero")
        return settled(compute(dividend, divisor))

    return guarded


def _power(left: Value, right: Value) -> Value:
    base, exponent = number(left, "**"), number(right, "**")
    try:
        size = math.pow(base, exponent)  # decides whether the exact power can be computed
    except (ValueError, OverflowError):
        raise ProgramFailed("the power is too large, or not a real number") from None
    exact = isinstance(base, int) and isinstance(exponent, int) and exponent >= 0
    if exact and abs(size) > MAX_INT:
        raise ProgramFailed("the result is too large a number")
    return settled(base**exponent if exact else size)


def _linear(value: Value, symbol: str) -> Expression | Number:
    return value if isinstance(value, Expression) else number(value, symbol)


def negate(value: Value) -> Value:
    """``-value``."""
    return linear.scale(value, -1.0) if isinstance(value, Expression) else -number(value, "-")


def positive(value: Value) -> Value:
    """``+value``."""
    return value if isinstance(value, Expression) else +number(value, "+")


BINARY: dict[type[ast.operator], Callable[[Value, Value], Value]] = {
    ast.Add: add,
    ast.Sub: _subtract,
    ast.Mult: _multiply,
    ast.Div: _divide,
    ast.FloorDiv: _whole("//", operator.floordiv),
    ast.Mod: _whole("%", operator.mod),
    ast.Pow: _power,
}

_RELATIONS: dict[type[ast.cmpop], linear.Relation] = {
    ast.LtE: "<=",
    ast.GtE: ">=",
    ast.Eq: "==",
}
_ORDER: dict[type[ast.cmpop], Callable[[Any, Any], bool]] = {
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
}


def compare(op: type[ast.cmpop], left: Value, right: Value, budget: list[int]) -> Value:
    """One comparison; between unknowns it is a constraint, else true or false.

    ``budget`` holds how many pairs of elements may still be compared. Raises LimitReached.
    """
    if isinstance(left, Expression) or isinstance(right, Expression):
        return _relate(op, left, right)
    if op is ast.In or op is ast.NotIn:
        found = any(_equal(left, item, budget) for item in items(right, "in"))
        return found is (op is ast.In)
    if op is ast.Eq or op is ast.NotEq:
        return _equal(left, right, budget) is (op is ast.Eq)
    one, other = order([left, right])
    return _ORDER[op](one, other)


def _relate(op: type[ast.cmpop], left: Value, right: Value) -> Constraint:
    if op not in _RELATIONS:
        raise ProgramFailed("a constraint on an unknown is written with <=, >= or ==")
    if isinstance(left, Constraint) or isinstance(right, Constraint):
        linear.no_truth("constraint")
    return linear.relate(_linear(left, "<="), _RELATIONS[op], _linear(right, "<="))


def _equal(left: Value, right: Value, budget: list[int], depth: int = 0) -> bool:
    """Equality with a budget shared by the whole comparison: a list may hold itself."""
    budget[0] -= 1
    if budget[0] < 0 or depth > 20:
        raise LimitReached("the lists compared are too large")
    for value in (left, right):
        if isinstance(value, Expression | Constraint):
            truth(value)
    if isinstance(left, Thing):
        return left.same(right)
    if isinstance(left, list | tuple) and type(left) is type(right):
        other = items(right, "==")
        return len(left) == len(other) and all(
            _equal(a, b, budget, depth + 1) for a, b in zip(left, other, strict=True)
        )
    if isinstance(left, list | tuple) or isinstance(right, list | tuple):
        return False
    return left == right


Key = tuple[Number, ...]


def order(values: Sequence[Value]) -> list[Key]:
    """What the values are put in order by: they are all numbers, or all lists that begin with some.

    What follows the numbers in a list ("(distance, apple)") must not be needed to tell two apart.
    Raises ProgramFailed.
    """
    if not any(isinstance(value, list | tuple) for value in values):
        return [(number(value, "putting values in order"),) for value in values]
    keys, whole = [], True
    for value in values:
        if not isinstance(value, list | tuple) or type(value) is not type(values[0]):
            if not isinstance(value, list | tuple):
                number(value, "putting values in order")
            raise ProgramFailed("numbers, lists and tuples cannot be put in order together")
        numbers = _leading(value)
        if value and not numbers:
            number(value[0], "putting lists in order")
        whole = whole and len(numbers) == len(value)
        keys.append(numbers)
    if not whole and len(set(keys)) < len(keys):
        raise ProgramFailed("two of these cannot be told apart by their numbers: add an index")
    return keys


def _leading(values: Sequence[Value]) -> Key:
    """The numbers that a list begins with."""
    found: list[Number] = []
    for value in values:
        if not isinstance(value, int | float):
            break
        found.append(value)
    return tuple(found)

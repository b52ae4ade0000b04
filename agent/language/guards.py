"""Operators and functions of the little language, each guarded: types, sizes, finite results.

They take and return values of the language only (`Value`) and raise ProgramFailed without a
line: the interpreter knows the line.
"""

from __future__ import annotations

import ast
import math
import operator
from collections.abc import Callable, Sequence
from typing import Any, TypeAlias, Union

from agent.errors import LimitReached, ProgramFailed
from agent.language import expression as linear
from agent.language.allowed import MAX_INT
from agent.language.builtin import MATH_CALLS
from agent.language.expression import Constraint, Expression
from agent.language.things import Thing

MAX_LIST = 1_000
MAX_RANGE = 10_000
MAX_COMPARED = 10_000
"""Most pairs of elements compared by one ``==`` or ``in``: lists may hold lists."""

Number = int | float
Value: TypeAlias = Union[
    int, float, bool, str, "list[Value]", "tuple[Value, ...]", Thing, Expression, Constraint, None
]


def describe(value: Value) -> str:
    """What kind of value this is, for messages."""
    names: dict[type, str] = {
        bool: "true or false",
        int: "a number",
        float: "a number",
        str: "a text",
        list: "a list",
        tuple: "a tuple",
        Thing: "an object",
        Expression: "an unknown",
        Constraint: "a constraint",
    }
    return names.get(type(value), "None")


def number(value: Value, what: str) -> Number:
    """The value if it is a number. Raises ProgramFailed naming what needed one."""
    if isinstance(value, int | float):
        return value
    if isinstance(value, Expression):
        raise ProgramFailed(
            f"{what} needs a number, not an unknown: call solver.solve() and use .value()"
        )
    if isinstance(value, Thing):
        raise ProgramFailed(f"{what} needs a number, not an object: use its x, y, width ...")
    raise ProgramFailed(f"{what} needs a number, not {describe(value)}")


def integer(value: Value, what: str) -> int:
    """The value if it is a whole number of type int. Raises ProgramFailed."""
    if isinstance(value, int):
        return value
    raise ProgramFailed(f"{what} needs a whole number, not {describe(value)}: use int(...)")


def settled(value: object) -> Number:
    """A result of arithmetic, checked. Raises ProgramFailed unless finite, real and not huge."""
    if isinstance(value, float):
        if math.isfinite(value):
            return value
        raise ProgramFailed("the result is not a finite number")
    if isinstance(value, int):
        if abs(value) <= MAX_INT:
            return value
        raise ProgramFailed("the result is too large a number")
    raise ProgramFailed("the result is not a real number")


def items(value: Value, what: str) -> list[Value] | tuple[Value, ...]:
    """The value if it is a list or a tuple. Raises ProgramFailed."""
    if isinstance(value, list | tuple):
        return value
    raise ProgramFailed(f"{what} needs a list, not {describe(value)}")


def sized(values: list[Value]) -> list[Value]:
    """The list, if it is not too long. Raises LimitReached."""
    if len(values) > MAX_LIST:
        raise LimitReached(f"a list has at most {MAX_LIST:,} elements")
    return values


def truth(value: Value) -> bool:
    """Whether the value counts as true. Raises ProgramFailed for unknowns and constraints."""
    if isinstance(value, Expression):
        linear.no_truth("unknown")
    if isinstance(value, Constraint):
        linear.no_truth("constraint")
    return bool(value)


# --- operators ---


def _add(left: Value, right: Value) -> Value:
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
    ast.Add: _add,
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
    one, other = _keys([left, right])
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


def _keys(values: Sequence[Value]) -> list[Key]:
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


# --- functions ---


def _absolute(value: Value) -> Value:
    if isinstance(value, Expression):
        raise ProgramFailed("abs of an unknown is not linear: add two constraints instead")
    return settled(abs(number(value, "abs")))


def _extreme(name: str, choose: Callable[[Any], Any]) -> Callable[..., Value]:
    def guarded(*values: Value) -> Value:
        pool = list(items(values[0], name)) if len(values) == 1 else list(values)
        if not pool:
            raise ProgramFailed(f"{name} of an empty list")
        keys = _keys(pool)
        return pool[keys.index(choose(keys))]

    return guarded


def _round(value: Value, digits: Value = None) -> Value:
    if digits is None:
        return settled(round(number(value, "round")))
    places = integer(digits, "round")
    if abs(places) > 20:
        raise ProgramFailed("round takes at most 20 digits")
    return settled(round(number(value, "round"), places))


def _sum(values: Value) -> Value:
    result: Value = 0
    for value in items(values, "sum"):
        result = _add(result, value)
    return result


def _sorted(values: Value) -> Value:
    pool = list(items(values, "sorted"))
    keys = _keys(pool)
    return [pool[at] for at in sorted(range(len(pool)), key=keys.__getitem__)]


def span(*values: Value) -> range:
    """``range(...)`` of whole numbers. Raises ProgramFailed, LimitReached beyond 10,000."""
    numbers = [integer(value, "range") for value in values]
    if len(numbers) == 3 and numbers[2] == 0:
        raise ProgramFailed("range cannot have a step of 0")
    result = range(*numbers)
    if len(result) > MAX_RANGE:
        raise LimitReached(f"a range has at most {MAX_RANGE:,} numbers")
    return result


def _range(*values: Value) -> Value:
    return sized(list(span(*values)))


def _truncated(value: Value) -> Value:
    return settled(int(number(value, "int")))


def _list(values: Value = ()) -> Value:
    return list(items(values, "list"))


def _tuple(values: Value = ()) -> Value:
    return tuple(items(values, "tuple"))


def mathematical(name: str) -> Callable[..., Value]:
    """A function of ``math``, guarded."""
    compute = MATH_CALLS[name][0]

    def guarded(*values: Value) -> Value:
        numbers = [float(number(value, f"math.{name}")) for value in values]
        try:
            return settled(compute(*numbers))
        except (ValueError, OverflowError):
            text = ", ".join(f"{value:g}" for value in numbers)
            raise ProgramFailed(f"math.{name}({text}) has no real, finite result") from None

    return guarded


def thing(value: Value, what: str) -> Thing:
    """The value if it is an object. Raises ProgramFailed naming what needed one."""
    if isinstance(value, Thing):
        return value
    raise ProgramFailed(f"{what} belongs to an object, not to {describe(value)}")


def standing(value: Value, *at: Value) -> Value:
    """``at(thing, x, y, z)``: the object as if it stood there, its base at height z."""
    x, y, z = (float(number(part, "at")) for part in at)
    return thing(value, "at").standing(x, y, z)


FUNCTIONS: dict[str, Callable[..., Value]] = {
    "abs": _absolute,
    "min": _extreme("min", min),
    "max": _extreme("max", max),
    "round": _round,
    "len": lambda values: len(items(values, "len")),
    "range": _range,
    "sum": _sum,
    "sorted": _sorted,
    "int": _truncated,
    "float": lambda value: float(number(value, "float")),
    "bool": lambda value: truth(value),
    "list": _list,
    "tuple": _tuple,
    "at": standing,
}
"""The built-in functions; how many arguments each takes was checked with the program."""


def index(values: Value, position: Value) -> int:
    """A valid position in a list or tuple. Raises ProgramFailed."""
    pool = items(values, "an index")
    place = integer(position, "an index")
    if not pool:
        raise ProgramFailed("the list is empty: test len(...) before")
    if not -len(pool) <= place < len(pool):
        raise ProgramFailed(f"there is no element {place} in a list of {len(pool)}")
    return place


def unpack(value: Value, count: int) -> Sequence[Value]:
    """The elements for ``count`` targets. Raises ProgramFailed if there are not so many."""
    parts = items(value, "assigning several variables at once")
    if len(parts) != count:
        raise ProgramFailed(f"{count} variables cannot take {len(parts)} values")
    return parts

"""What values of the little language must be where they are used: types, sizes, finite numbers.

Others raise ProgramFailed without a line: the interpreter knows the line.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TypeAlias, Union

from agent.errors import LimitReached, ProgramFailed
from agent.language import expression as linear
from agent.language.allowed import MAX_INT
from agent.language.expression import Constraint, Expression
from agent.language.things import Thing

MAX_LIST = 1_000

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


def thing(value: Value, what: str) -> Thing:
    """The value if it is an object. Raises ProgramFailed naming what needed one."""
    if isinstance(value, Thing):
        return value
    raise ProgramFailed(f"{what} belongs to an object, not to {describe(value)}")


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

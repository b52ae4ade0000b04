"""Functions that are built into the little language, each guarded.

They take and return values of the language only (`Value`) and raise ProgramFailed without a line.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from agent.errors import LimitReached, ProgramFailed
from agent.language.builtin import MATH_CALLS
from agent.language.expression import Expression
from agent.language.guards import Value, integer, items, number, settled, sized, thing, truth
from agent.language.operators import add, order
from agent.language.things import Thing

MAX_RANGE = 10_000


def _absolute(value: Value) -> Value:
    if isinstance(value, Expression):
        raise ProgramFailed("abs of an unknown is not linear: add two constraints instead")
    return settled(abs(number(value, "abs")))


def _extreme(name: str, choose: Callable[[Any], Any]) -> Callable[..., Value]:
    def guarded(*values: Value) -> Value:
        pool = list(items(values[0], name)) if len(values) == 1 else list(values)
        if not pool:
            raise ProgramFailed(f"{name} of an empty list")
        keys = order(pool)
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
        result = add(result, value)
    return result


def _sorted(values: Value) -> Value:
    pool = list(items(values, "sorted"))
    keys = order(pool)
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


def standing(value: Value, *at: Value) -> Thing:
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

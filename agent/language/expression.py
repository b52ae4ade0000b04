"""Linear expressions and constraints over the solver's unknowns: values a program can hold.

They know nothing of any solver: `agent.language.cassowary` converts them, in the worker only.
Terms are merged, every number is finite, and neither has a truth value, since ``if apple.x >= 1``
on an unknown would silently be wrong.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Literal, NoReturn

from agent.errors import LimitReached, ProgramFailed

MAX_TERMS = 100
MAX_SIZE = 1e6
"""Largest sum of an expression's numbers, without signs: the table is 2 units wide."""
NEGLIGIBLE = 1e-12
"""Coefficients below are rounding errors of terms that cancel."""

Relation = Literal["<=", ">=", "=="]
Strength = Literal["required", "strong", "medium", "weak"]


def no_truth(what: str) -> NoReturn:
    """Raise the error for using an unknown or a constraint as true or false."""
    if what == "constraint":
        raise ProgramFailed(
            "a constraint is neither true nor false: give solver.addConstraint one comparison "
            "at a time (no a <= b <= c, no and); to test, call solver.solve() and use .value()"
        )
    raise ProgramFailed(
        "an unknown is neither true nor false: call solver.solve() and use .value() in tests"
    )


class Expression:
    """``constant + sum(coefficient * unknown)``; unknowns are numbered from 0. Never changed."""

    __slots__ = ("constant", "terms")
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, terms: Mapping[int, float], constant: float = 0.0) -> None:
        if len(terms) > MAX_TERMS:
            raise LimitReached(f"an expression has at most {MAX_TERMS} unknowns")
        if not sum(map(abs, terms.values()), abs(constant)) <= MAX_SIZE:  # also true for NaN
            raise ProgramFailed("a number in a constraint is too large or not finite")
        self.terms = terms
        self.constant = constant

    def __bool__(self) -> bool:
        no_truth("unknown")

    def at(self, values: Mapping[int, float]) -> float:
        """The value where each unknown has the given value. Raises KeyError for a missing one."""
        result = self.constant
        for unknown, coefficient in self.terms.items():
            result += coefficient * values[unknown]
        return result


class Constraint:
    """``expression relation 0`` with a strength, and the line that states it. Never changed."""

    __slots__ = ("expression", "line", "relation", "strength")
    __hash__ = None  # type: ignore[assignment]

    def __init__(
        self,
        expression: Expression,
        relation: Relation,
        strength: Strength = "required",
        line: int = 0,
    ) -> None:
        self.expression = expression
        self.relation = relation
        self.strength: Strength = strength
        self.line = line

    def __bool__(self) -> bool:
        no_truth("constraint")

    def violation(self, values: Mapping[int, float]) -> float:
        """By how much the constraint misses at these values (0: it holds)."""
        left = self.expression.at(values)
        if self.relation == "<=":
            return max(0.0, left)
        return max(0.0, -left) if self.relation == ">=" else abs(left)


Linear = Expression | float | int


def unknown(index: int) -> Expression:
    """The unknown with this number, alone."""
    return Expression({index: 1.0})


def add(left: Linear, right: Linear, sign: float = 1.0) -> Expression:
    """``left + sign * right``, terms merged."""
    terms: dict[int, float] = dict(left.terms) if isinstance(left, Expression) else {}
    constant = left.constant if isinstance(left, Expression) else float(left)
    if not isinstance(right, Expression):
        return Expression(terms, constant + sign * right)
    for key, coefficient in right.terms.items():
        total = terms.get(key, 0.0) + sign * coefficient
        terms[key] = total
        if abs(total) < NEGLIGIBLE:
            del terms[key]
    return Expression(terms, constant + sign * right.constant)


def scale(expression: Expression, factor: float) -> Expression:
    """``factor * expression``. Raises ProgramFailed when a number gets too large."""
    if not math.isfinite(factor):
        raise ProgramFailed("a number in a constraint is not finite")
    terms = {key: value * factor for key, value in expression.terms.items()}
    terms = {key: value for key, value in terms.items() if abs(value) >= NEGLIGIBLE}
    return Expression(terms, expression.constant * factor)


def bound(index: int, relation: Relation, limit: float, line: int = 0) -> Constraint:
    """``unknown relation limit`` as a required constraint."""
    return Constraint(Expression({index: 1.0}, -limit), relation, "required", line)


def relate(
    left: Linear, relation: Relation, right: Linear, strength: Strength = "required"
) -> Constraint:
    """``left relation right`` as a constraint."""
    return Constraint(add(left, right, -1.0), relation, strength)


def total(parts: Iterable[Linear]) -> Expression:
    """The sum of numbers and expressions."""
    result = Expression({})
    for part in parts:
        result = add(result, part)
    return result

"""The Cassowary solver: the only file that imports kiwisolver; only the worker imports it.

kiwisolver aborts the whole process (an uncaught C++ exception) on some finite, ordinary input.
That is why no other process may load this module.
"""

from __future__ import annotations

import re
from functools import cache

import kiwisolver

from agent.language.arrange import MAX_UNKNOWNS
from agent.language.expression import Constraint

WEIGHTS = {
    "required": kiwisolver.strength.required,
    "strong": kiwisolver.strength.strong,
    "medium": kiwisolver.strength.medium,
    "weak": kiwisolver.strength.weak,
}

DIGITS = 10
"""Decimals of a solution: what is beyond them is rounding error."""


@cache
def _pool() -> list[kiwisolver.Variable]:
    """The solver's variables, one for each unknown, shared by all runs: they hold no state.

    kiwisolver orders the terms of a constraint by where its variables lie in memory, and pivots
    in that order. Handing the variables out in the order of their places makes it the program's
    own order, so that a program has one solution, in every process. A dump of a solver that
    knows them all lists them in that order.
    """
    variables = {str(n): kiwisolver.Variable(str(n)) for n in range(MAX_UNKNOWNS)}
    solver = kiwisolver.Solver()
    for variable in variables.values():
        solver.addConstraint(kiwisolver.Constraint(kiwisolver.Expression([1 * variable]), "=="))
    listed = re.search(r"^Variables\n-+\n((?:\d+ = \S+\n)*)", solver.dumps(), re.MULTILINE)
    names = [line.split(" ")[0] for line in listed[1].splitlines()] if listed else []
    if sorted(names) != sorted(variables):
        raise RuntimeError("this kiwisolver does not list its variables as expected")
    return [variables[name] for name in names]


class Cassowary:
    """Makes the solvers of one run; what was converted for one of them serves the others too."""

    def __init__(self) -> None:
        self._converted: dict[int, tuple[Constraint, kiwisolver.Constraint]] = {}

    def solver(self) -> KiwiSolver:
        """A new, empty system."""
        return KiwiSolver(self)

    def convert(self, constraint: Constraint, weight: float | None) -> kiwisolver.Constraint:
        """The solver's own constraint; ``weight`` replaces its strength."""
        if weight is None and id(constraint) in self._converted:
            return self._converted[id(constraint)][1]
        pool, terms = _pool(), constraint.expression.terms
        expression = kiwisolver.Expression(
            [kiwisolver.Term(pool[key], terms[key]) for key in terms],
            constraint.expression.constant,
        )
        strength = WEIGHTS[constraint.strength] if weight is None else weight
        own = kiwisolver.Constraint(expression, constraint.relation, strength)
        if weight is None:
            self._converted[id(constraint)] = (constraint, own)  # both: an id must not come again
        return own


class KiwiSolver:
    """One system of linear constraints; see `agent.language.arrange.Solver`."""

    def __init__(self, owner: Cassowary) -> None:
        self._owner = owner
        self._solver = kiwisolver.Solver()
        self._keys: set[int] = set()

    def add(self, constraint: Constraint, weight: float | None = None) -> bool:
        """Add a constraint; False if it is required and cannot hold with those before it."""
        self._keys.update(constraint.expression.terms)
        try:
            self._solver.addConstraint(self._owner.convert(constraint, weight))
        except kiwisolver.UnsatisfiableConstraint:
            return False
        return True

    def values(self) -> dict[int, float]:
        """The solution: a value for every unknown of the constraints added so far."""
        self._solver.updateVariables()
        pool = _pool()
        return {key: round(pool[key].value(), DIGITS) + 0.0 for key in sorted(self._keys)}

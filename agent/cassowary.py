"""The Cassowary solver: the only file that imports kiwisolver; only the worker imports it.

kiwisolver aborts the whole process (an uncaught C++ exception) on some finite, ordinary input.
That is why no other process may load this module.
"""

from __future__ import annotations

import kiwisolver

from agent.expression import Constraint

WEIGHTS = {
    "required": kiwisolver.strength.required,
    "strong": kiwisolver.strength.strong,
    "medium": kiwisolver.strength.medium,
    "weak": kiwisolver.strength.weak,
}


class KiwiSolver:
    """One system of linear constraints; see `agent.arrange.Solver`."""

    def __init__(self) -> None:
        self._solver = kiwisolver.Solver()
        self._unknowns: dict[int, kiwisolver.Variable] = {}

    def add(self, constraint: Constraint, weight: float | None = None) -> bool:
        """Add a constraint; False if it is required and cannot hold with those before it."""
        terms = [
            kiwisolver.Term(self._variable(key), coefficient)
            for key, coefficient in constraint.expression.terms.items()
        ]
        expression = kiwisolver.Expression(terms, constraint.expression.constant)
        strength = WEIGHTS[constraint.strength] if weight is None else weight
        try:
            self._solver.addConstraint(
                kiwisolver.Constraint(expression, constraint.relation, strength)
            )
        except kiwisolver.UnsatisfiableConstraint:
            return False
        return True

    def values(self) -> dict[int, float]:
        """The solution: a value for every unknown of the constraints added so far."""
        self._solver.updateVariables()
        return {key: variable.value() for key, variable in self._unknowns.items()}

    def _variable(self, key: int) -> kiwisolver.Variable:
        if key not in self._unknowns:
            self._unknowns[key] = kiwisolver.Variable(str(key))
        return self._unknowns[key]

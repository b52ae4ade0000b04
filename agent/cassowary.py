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


class Cassowary:
    """Makes the solvers of one run; what was converted for one of them serves the others too."""

    def __init__(self) -> None:
        self._unknowns: dict[int, kiwisolver.Variable] = {}
        self._converted: dict[int, tuple[Constraint, kiwisolver.Constraint]] = {}

    def solver(self) -> KiwiSolver:
        """A new, empty system."""
        return KiwiSolver(self)

    def unknown(self, key: int) -> kiwisolver.Variable:
        """The solver's own variable for an unknown."""
        if key not in self._unknowns:
            self._unknowns[key] = kiwisolver.Variable(str(key))
        return self._unknowns[key]

    def convert(self, constraint: Constraint, weight: float | None) -> kiwisolver.Constraint:
        """The solver's own constraint; ``weight`` replaces its strength."""
        if weight is None and id(constraint) in self._converted:
            return self._converted[id(constraint)][1]
        terms = constraint.expression.terms
        expression = kiwisolver.Expression(
            [kiwisolver.Term(self.unknown(key), terms[key]) for key in terms],
            constraint.expression.constant,
        )
        strength = WEIGHTS[constraint.strength] if weight is None else weight
        own = kiwisolver.Constraint(expression, constraint.relation, strength)
        if weight is None:
            self._converted[id(constraint)] = (constraint, own)  # both: an id must not come again
        return own


class KiwiSolver:
    """One system of linear constraints; see `agent.arrange.Solver`."""

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
        return {key: self._owner.unknown(key).value() for key in sorted(self._keys)}

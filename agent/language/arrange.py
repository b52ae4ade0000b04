"""What ``solver`` does in an arrange program: unknown positions, constraints, placements.

Positions of tray objects are unknowns. Every object that the program constrains stays on the
table, required. Freedom that the program leaves is resolved by fixed rules: a pull to the middle
of the table, far weaker than any constraint of the program, and then `agent.language.separate`.
Knows no solver: one is passed in (`agent.language.cassowary`, in the worker).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Protocol

from agent.errors import LimitReached, ProgramFailed, SolverFailed, Unsatisfiable
from agent.language import expression as linear
from agent.language.expression import Constraint, Expression
from agent.language.separate import Layout, Piece, separate
from agent.messages import Placement
from scene.relations import extents
from scene.types import EDGE, Scene, SceneObject

MAX_CONSTRAINTS = 200
MAX_UNKNOWNS = 100
PULL = 1e-3
"""Weight of the pull to a default position; the program's "weak" is 1."""
WISH = 1e-2
"""Weight of where a function of the prelude would have what nothing places: more than the pull."""
FARTHEST = linear.MAX_SIZE / 2
"""A solution beyond this is none: what is pulled to it would be too large a constraint."""
TOLERANCE = 1e-5
"""Largest miss of a constraint that still counts as holding (table units)."""


class Solver(Protocol):
    """A system of linear constraints that grows."""

    def add(self, constraint: Constraint, weight: float | None = None) -> bool:
        """Add a constraint; False if it is required and cannot hold with those before it."""
        ...

    def values(self) -> dict[int, float]:
        """The solution: a value for every unknown of the constraints added so far."""
        ...


NewSolver = Callable[[], Solver]


class Arrangement:
    """The unknowns and constraints of one run, in the order the program states them."""

    def __init__(self, scene: Scene, new_solver: NewSolver) -> None:
        self._scene = scene
        self._new_solver = new_solver
        self._solver: Solver | None = None
        self._unknowns = 0
        self._coordinates: dict[tuple[str, str], int] = {}
        self._expressions: dict[int, Expression] = {}
        self._owners: dict[int, SceneObject] = {}
        self._placed: dict[str, tuple[SceneObject, int]] = {}
        self._constraints: list[Constraint] = []
        self._free: set[int] = set()
        self._bounds: list[Constraint] = []
        self._stated = 0
        self._wishes = 0
        self._stated_of: set[int] = set()
        self._solved: dict[int, float] | None = None

    def variable(self) -> Expression:
        """A free unknown. Raises LimitReached."""
        if self._unknowns >= MAX_UNKNOWNS:
            raise LimitReached(f"a program has at most {MAX_UNKNOWNS} unknowns")
        self._unknowns += 1
        return linear.unknown(self._unknowns - 1)

    def coordinate(self, item: SceneObject, axis: str) -> Expression:
        """The unknown x or y of an object in the tray."""
        key = self._coordinates.get((item.id, axis))
        if key is None:
            key = self._unknowns
            self._expressions[key] = self.variable()
            self._coordinates[item.id, axis] = key
            self._owners[key] = item
        return self._expressions[key]

    def add(self, constraint: Constraint | bool, line: int) -> None:
        """State a constraint. Raises Unsatisfiable if it cannot hold, LimitReached."""
        self._count()
        if isinstance(constraint, Constraint) and constraint.expression.terms:
            stated = Constraint(
                constraint.expression, constraint.relation, constraint.strength, line
            )
            self._place(stated)
            self._stated_of.update(stated.expression.terms)
            self._require(stated)
            self._constraints.append(stated)
        elif not _holds(constraint):
            raise Unsatisfiable("nothing in this constraint can move, and it does not hold", line)

    def wish(self, number: Expression, wanted: float, line: int) -> None:
        """Make a number what is wanted if nothing was said of it yet, nor will decide it.

        Of wishes that cannot all be the last counts most: it is of what the others go by.
        Raises LimitReached.
        """
        if self._stated_of & number.terms.keys():
            return
        self._count()
        self._stated_of.update(number.terms)
        stated = linear.relate(number, "==", wanted)
        self._place(Constraint(stated.expression, "==", "weak", line))
        self._wishes += 1
        self._own.add(stated, WISH * (1 + self._wishes / 10))

    def solve(self) -> None:
        """Compute a value for every unknown constrained so far.

        Raises Unsatisfiable; SolverFailed if the solution lies beyond all numbers of the language.
        """
        self._solved = self._own.values()
        if any(not abs(value) <= FARTHEST for value in self._solved.values()):
            raise SolverFailed("the solver failed: its solution lies far beyond the table")
        wrong = [
            c
            for c in (*self._bounds, *self._constraints)
            if c.strength == "required" and c.violation(self._solved) > TOLERANCE
        ]
        if wrong:
            raise Unsatisfiable("the solver found no position for this constraint", wrong[0].line)

    def so_far(self, place: Sequence[linear.Linear]) -> list[float] | None:
        """The numbers of a place by what is stated so far; None: nothing speaks of any of them.

        Raises as `solve` does.
        """
        unknown = [part for part in place if isinstance(part, Expression)]
        if not any(self._stated_of & part.terms.keys() for part in unknown):
            return None
        self.solve()
        return [self.value(part) if isinstance(part, Expression) else part for part in place]

    def value(self, expression: Expression) -> float:
        """The value in the last solution. Raises ProgramFailed before there is one."""
        if self._solved is None:
            raise ProgramFailed("there is no value yet: call solver.solve() before .value()")
        try:
            return expression.at(self._solved)
        except KeyError:
            raise ProgramFailed(
                "there is no value yet: add a constraint on it and call solver.solve()"
            ) from None

    def finish(self) -> tuple[Placement, ...]:
        """Solve, separate what overlaps, and say where each constrained object goes."""
        if not self._placed:
            return ()
        self.solve()
        assert self._solved is not None
        pieces = [self._piece(item) for item, _ in self._placed.values()]
        layout = Layout(pieces, obstacles(self._scene), self._solved, self._resolve, self._missed)
        values = separate(layout)
        return tuple(
            Placement(
                item.id,
                values[self._coordinates[item.id, "x"]],
                values[self._coordinates[item.id, "y"]],
                line,
            )
            for item, line in self._placed.values()
        )

    @property
    def _own(self) -> Solver:
        if self._solver is None:
            self._solver = self._new_solver()
        return self._solver

    def _count(self) -> None:
        self._stated += 1
        if self._stated > MAX_CONSTRAINTS:
            raise LimitReached(f"a program states at most {MAX_CONSTRAINTS} constraints")

    def _place(self, constraint: Constraint) -> None:
        """Objects the program constrains for the first time stay on the table from now on.

        Each unknown meets the solver alone first: that fixes their order, and so the solution.
        """
        for key in constraint.expression.terms:
            item = self._owners.get(key)
            if item is None and key not in self._free:
                self._free.add(key)
                self._own.add(linear.bound(key, "==", 0.0), PULL)
            if item is None or item.id in self._placed:
                continue
            self._placed[item.id] = (item, constraint.line)
            for axis, half in zip("xy", extents(item), strict=True):
                self.coordinate(item, axis)
                where = self._coordinates[item.id, axis]
                limits = (
                    linear.bound(where, ">=", half - EDGE, constraint.line),
                    linear.bound(where, "<=", EDGE - half, constraint.line),
                )
                for limit in limits:
                    self._require(limit)
                self._bounds += limits
                self._own.add(linear.bound(where, "==", 0.0), PULL)

    def _require(self, constraint: Constraint) -> None:
        if not self._own.add(constraint):
            raise Unsatisfiable(
                "this cannot hold together with the constraints before it "
                "(every object stays on the table)",
                constraint.line,
            )

    def _piece(self, item: SceneObject) -> Piece:
        half_x, half_y = extents(item)
        x, y = self.coordinate(item, "x"), self.coordinate(item, "y")
        return Piece(item.id, x, y, half_x, half_y)

    def _resolve(self, extra: list[Constraint]) -> dict[int, float] | None:
        """Solve again with more required constraints, pulled to the program's own solution.

        None when that breaks a required or strong constraint that held before.
        """
        assert self._solved is not None
        solver = self._new_solver()
        stated = [*self._bounds, *self._constraints, *extra]
        for key, value in self._solved.items():
            solver.add(linear.bound(key, "==", value), PULL)
        if not all(solver.add(constraint) for constraint in stated):
            return None
        values = solver.values()
        kept = [c for c in stated if c.strength == "required"] + [
            c
            for c in self._constraints
            if c.strength == "strong" and c.violation(self._solved) <= TOLERANCE
        ]
        return values if all(c.violation(values) <= TOLERANCE for c in kept) else None

    def _missed(self, values: dict[int, float]) -> float:
        """By how much values miss the constraints of medium strength, summed."""
        return sum(c.violation(values) for c in self._constraints if c.strength == "medium")


def _holds(constraint: Constraint | bool) -> bool:
    if isinstance(constraint, bool):
        return constraint
    return constraint.strength != "required" or constraint.violation({}) <= TOLERANCE


def obstacles(scene: Scene) -> list[Piece]:
    """Footprints of what stands on the table now, as fixed pieces."""
    pieces = []
    for item in scene.objects:
        if item.on in ("floor", "gripper") or item.held:
            continue
        x, y = item.position
        half_x, half_y = extents(item)
        pieces.append(Piece(item.id, Expression({}, x), Expression({}, y), half_x, half_y))
    return pieces

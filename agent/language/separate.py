"""Moves placements apart where an arrange program left them free to overlap.

A fixed rule: the first overlapping pair, in order of first use, is pushed apart in the direction
(left, right, below, above) that keeps all required and strong constraints, misses those of medium
strength least, and then moves the placed objects least; then the next pair, with a bounded search
back. Where nothing works the overlap stays, and the check reports it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from agent.language import expression as linear
from agent.language.expression import Constraint, Expression

GAP = 0.03
"""Clearance between footprints that were moved apart (table units)."""
OVERLAP = 1e-4
"""Footprints that share less than this on an axis touch; they do not overlap."""
MAX_SOLVES = 80

Values = dict[int, float]


@dataclass(frozen=True)
class Piece:
    """A footprint: its centre (unknown or fixed) and half extents (table units)."""

    name: str
    x: Expression
    y: Expression
    half_x: float
    half_y: float


@dataclass
class Layout:
    """Pieces to place, obstacles that stay, a first solution, how to solve with more, and by how
    much a solution misses what is of medium strength."""

    pieces: Sequence[Piece]
    fixed: Sequence[Piece]
    values: Values
    resolve: Callable[[list[Constraint]], Values | None]
    missed: Callable[[Values], float] = lambda values: 0.0
    solves: int = field(default=0, init=False)


def separate(layout: Layout) -> Values:
    """The solution with no overlaps, or the first one if there is none within the search."""
    found = _search(layout, layout.values, [])
    return layout.values if found is None else found


def _search(layout: Layout, values: Values, extra: list[Constraint]) -> Values | None:
    pair = _first_overlap(layout, values)
    if pair is None:
        return values
    trials: list[tuple[float, float, int, Values, Constraint]] = []
    for apart in _directions(*pair):
        if layout.solves >= MAX_SOLVES:
            break
        layout.solves += 1
        solved = layout.resolve([*extra, apart])
        if solved is not None:
            missed, moved = round(layout.missed(solved), 6), round(_moved(layout, solved), 9)
            trials.append((missed, moved, len(trials), solved, apart))
    for _, _, _, solved, apart in sorted(trials, key=lambda trial: trial[:3]):
        found = _search(layout, solved, [*extra, apart])
        if found is not None:
            return found
    return None


def _first_overlap(layout: Layout, values: Values) -> tuple[Piece, Piece] | None:
    for number, piece in enumerate(layout.pieces):
        for other in (*layout.pieces[:number], *layout.fixed):
            if _overlap(piece, other, values):
                return piece, other
    return None


def _overlap(one: Piece, other: Piece, values: Values) -> bool:
    across = abs(one.x.at(values) - other.x.at(values)) - one.half_x - other.half_x
    along = abs(one.y.at(values) - other.y.at(values)) - one.half_y - other.half_y
    return max(across, along) < -OVERLAP


def _directions(one: Piece, other: Piece) -> list[Constraint]:
    """``one`` left of, right of, below, above ``other``."""
    wide = one.half_x + other.half_x + GAP
    deep = one.half_y + other.half_y + GAP
    return [
        linear.relate(linear.add(one.x, wide), "<=", other.x),
        linear.relate(linear.add(other.x, wide), "<=", one.x),
        linear.relate(linear.add(one.y, deep), "<=", other.y),
        linear.relate(linear.add(other.y, deep), "<=", one.y),
    ]


def _moved(layout: Layout, values: Values) -> float:
    """How far the pieces are from where the program's own solution has them, summed."""
    return sum(
        abs(place.at(values) - place.at(layout.values))
        for piece in layout.pieces
        for place in (piece.x, piece.y)
    )

"""Who is who: the assignment of least cost between things known and things seen (pure).

The shortest augmenting paths of Kuhn and Munkres, with potentials: exact, O(n^2 (n + m)), a few
milliseconds for thirty things.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Costs = NDArray[np.float64]
NEVER = 1e9
"""In place of an infinite cost: leaving a row alone is always cheaper."""


def assign(costs: Costs, alone: float) -> list[int | None]:
    """For each row of ``costs`` (n, m) its column, or None; the sum of costs is the least there is.

    A row that is left alone costs ``alone``, a column nothing; an infinite cost forbids a pair.
    """
    rows, columns = costs.shape
    if not rows or not columns:
        return [None] * rows
    # each row has a column of its own for being alone
    lonely = np.full((rows, rows), NEVER)
    np.fill_diagonal(lonely, alone)
    table = np.hstack([np.minimum(costs, NEVER), lonely])
    return [column if column < columns else None for column in _matched(table)]


def _matched(table: Costs) -> list[int]:
    """The column of each row in the cheapest assignment of all rows; at least as many columns."""
    rows, columns = table.shape
    of_row, of_column = np.zeros(rows), np.zeros(columns)  # potentials
    owner = np.full(columns, -1)
    for row in range(rows):
        _augment(table, row, of_row, of_column, owner)
    result = [0] * rows
    for column, row in enumerate(owner.tolist()):
        if row >= 0:
            result[row] = column
    return result


def _augment(
    table: Costs, row: int, of_row: Costs, of_column: Costs, owner: NDArray[np.int_]
) -> None:
    """Give ``row`` a column by the shortest path over columns that other rows give up for it."""
    columns = table.shape[1]
    far, before = np.full(columns, np.inf), np.full(columns, -1)
    done = np.zeros(columns, dtype=bool)
    at, here, length = -1, row, 0.0
    while True:
        ways = length + table[here] - of_row[here] - of_column
        shorter = ~done & (ways < far)
        far[shorter], before[shorter] = ways[shorter], at
        at = int(np.argmin(np.where(done, np.inf, far)))
        length = float(far[at])
        if owner[at] < 0:
            break
        done[at], here = True, int(owner[at])
    of_row[owner[done]] += length - far[done]
    of_row[row] += length
    of_column[done] -= length - far[done]
    while at >= 0:
        previous = int(before[at])
        owner[at] = row if previous < 0 else owner[previous]
        at = previous

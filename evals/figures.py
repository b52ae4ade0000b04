"""Measured figures: what a bench returns, and how times become one."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Sequence

import msgspec


class Figure(msgspec.Struct, frozen=True, kw_only=True):
    """One measured figure; ``met`` compares with the goal, where there is one."""

    value: float | None
    unit: str
    n: int
    stderr: float | None = None
    goal: str | None = None
    met: bool | None = None
    why: str | None = None


def times(act: Callable[[], object], n: int) -> list[float]:
    """Milliseconds of each of ``n`` runs, after one that is not counted."""
    act()
    result = []
    for _ in range(n):
        began = time.perf_counter()
        act()
        result.append(1000 * (time.perf_counter() - began))
    return result


def at_most(value: float, goal: float | None, unit: str, n: int) -> Figure:
    """A figure that is good if it is small; without a goal just a figure."""
    return Figure(
        value=value, unit=unit, n=n, goal=None if goal is None else f"<= {goal:g}",
        met=None if goal is None else value <= goal,
    )  # fmt: skip


def at_least(value: float, goal: float, unit: str, n: int) -> Figure:
    """A figure that is good if it is large."""
    return Figure(value=value, unit=unit, n=n, goal=f">= {goal:g}", met=value >= goal)


def median(values: Sequence[float], goal: float | None = None, unit: str = "ms") -> Figure:
    """The median of times (or of anything in ``unit``)."""
    return at_most(statistics.median(values), goal, unit, len(values))

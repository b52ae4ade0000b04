"""A plan in words: each primitive with its length and time, and how near it comes to each limit.

The primitives are written as the little language writes them: what is shown can be run.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from agent.messages import Command
from robot_bridge.api import ApprovedPlan, Limits, distance, length
from scene.types import Pose


class Stretch(NamedTuple):
    """One primitive: as a line of the language, its way (table units) and time (seconds)."""

    line: int
    primitive: str
    length: float
    seconds: float


class Approach(NamedTuple):
    """How much room a plan leaves to a limit at its closest, in ``unit``, and in which line.

    ``unit`` is ``units`` (table units), ``rad``, ``units/s`` or ``motions``.
    """

    limit: str
    room: float
    unit: str
    line: int


class Explanation(NamedTuple):
    """All of a plan in numbers: table units and seconds."""

    stretches: tuple[Stretch, ...]
    approaches: tuple[Approach, ...]
    length: float
    seconds: float


def primitive(command: Command) -> str:
    """The command as the little language writes it."""
    if command.op == "grip":
        return f"robot.grip({command.grip})"
    numbers = ", ".join(f"{value:.4f}".rstrip("0").rstrip(".") for value in
                        (command.x, command.y, command.z, command.r))  # fmt: skip
    return f"robot.move({numbers})".replace("-0,", "0,").replace("-0)", "0)")


def explain(plan: ApprovedPlan, limits: Limits) -> Explanation:
    """The numbers of a plan, for a robot with these limits."""
    stretches = tuple(
        Stretch(command.line, primitive(command), length(here, _goal(command)), seconds)
        for (here, command), seconds in zip(_ways(plan), plan.durations, strict=True)
    )
    total = sum(stretch.length for stretch in stretches)
    return Explanation(
        stretches, tuple(_approaches(plan, limits, total)), total, sum(plan.durations)
    )


def _goal(command: Command) -> Pose:
    return Pose(command.x, command.y, command.z, command.r)


def _ways(plan: ApprovedPlan) -> Iterator[tuple[Pose, Command]]:
    here = plan.start
    for command in plan.told:
        yield here, command
        here = _goal(command)


def _approaches(plan: ApprovedPlan, limits: Limits, total: float) -> Iterator[Approach]:
    if not plan.told:
        return
    for axis in ("x", "y", "z", "r"):
        unit = "rad" if axis == "r" else "units"
        for side, sign, limit in zip(
            ("least", "most"), (1, -1), getattr(limits, axis), strict=True
        ):
            near = min(plan.told, key=lambda command: sign * getattr(command, axis))
            room = sign * (getattr(near, axis) - limit)
            name = "the table" if (axis, side) == ("z", "least") else f"{side} {axis} {limit:.4g}"
            yield Approach(name, room, unit, near.line)
    for zone in limits.keep_outs:
        ways = [(distance(here, _goal(command), zone), command.line)
                for here, command in _ways(plan) if command.op == "move"]  # fmt: skip
        if ways:
            yield Approach(f"keep-out {zone.name}", *_split(min(ways)))
    yield Approach(f"path {limits.length:.4g}", limits.length - total, "units", plan.told[-1].line)
    count = limits.commands - len(plan.told)
    yield Approach(f"{limits.commands} motions", count, "motions", plan.told[-1].line)


def _split(way: tuple[float, int]) -> tuple[float, str, int]:
    return way[0], "units", way[1]


def as_text(explanation: Explanation, table_m: float) -> str:
    """The explanation as a table for people; lengths in table units and millimetres."""
    rows = [("line", "primitive", "units", "mm", "s")]
    rows += [
        (str(one.line or "-"), one.primitive, f"{one.length:.3f}", _mm(one.length, table_m),
         f"{one.seconds:.2f}")
        for one in explanation.stretches
    ]  # fmt: skip
    rows.append(("", "total", f"{explanation.length:.3f}", _mm(explanation.length, table_m),
                 f"{explanation.seconds:.2f}"))  # fmt: skip
    lines = [*_columns(rows, "<<>>>"), "", "closest approach to each limit"]
    limits = [
        (f"  {one.limit}", f"{one.room:.4g} {one.unit}",
         f"{_mm(one.room, table_m)} mm" if one.unit == "units" else "", f"line {one.line or '-'}")
        for one in explanation.approaches
    ]  # fmt: skip
    return "\n".join([*lines, *_columns(limits, "<>>>")]) + "\n"


def _mm(units: float, table_m: float) -> str:
    return f"{units * table_m * 500:.0f}"


def _columns(rows: Sequence[tuple[str, ...]], align: str) -> list[str]:
    widths = [max(len(row[column]) for row in rows) for column in range(len(align))] if rows else []
    return [
        "  ".join(f"{cell:{side}{width}}" for cell, side, width in
                  zip(row, align, widths, strict=True)).rstrip()
        for row in rows
    ]  # fmt: skip

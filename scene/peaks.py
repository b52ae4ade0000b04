"""From the detector's maps to things: peaks, places, sizes, turns (pure numpy).

Cells are ``unit`` table units a side, the first in the picture's far left corner; angles come as
cosine and sine of twice and of four times the long side's angle, so that symmetric things have
one answer, and a thing that looks the same at any angle has short vectors.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Maps = NDArray[np.float32]

OTHER = "other"
"""The name of things of no kind that the detector knows."""
LEAST = 0.3
"""A peak of less is no thing."""
CERTAIN = 0.4
"""A kind less likely than this, given that something is there, is not named."""
ANGULAR = 0.35
"""Shorter vectors of four times the angle are of round things, which are not turned."""
LONG = 0.35
"""Shorter vectors of twice the angle are of things that are as wide as long."""


class Peak(NamedTuple):
    """A thing in the maps. ``kind``: its channel; lengths in table units; ``error``: of ``x, y``.

    ``u, v``: the cell (column, row) of its visible middle.
    """

    kind: int
    score: float
    x: float
    y: float
    error: float
    width: float
    height: float
    tall: float
    r: float
    u: int
    v: int


def peaks(maps: Mapping[str, Maps], unit: float, other: int) -> list[Peak]:
    """The things in ``heat`` (kinds, rows, columns), ``place`` (4, ...), ``shape`` (7, ...).

    ``place``: right, down, log of the error, and how much of the rectangle is likely right, by
    which a score is less. ``other``: the channel of things of no kind. Surest first.
    """
    heat = maps["heat"]
    total = heat.sum(0)
    rows, columns = np.nonzero(_tops(total) & (total >= LEAST))
    found = [
        _peak(heat[:, v, u], maps["place"][:, v, u], maps["shape"][:, v, u], u, v, total.shape,
              unit, other)
        for v, u in zip(rows.tolist(), columns.tolist(), strict=True)
    ]  # fmt: skip
    return sorted(found, key=lambda one: -one.score)


def _tops(total: Maps) -> NDArray[np.bool_]:
    """Cells that are higher than their eight neighbours; of equal ones, the first in order."""
    rows, columns = total.shape
    padded = np.pad(total, 1, constant_values=-1.0)
    top = np.ones(total.shape, bool)
    for number in range(9):
        around = padded[number // 3 :, number % 3 :][:rows, :columns]
        if number != 4:
            top &= total > around if number < 4 else total >= around
    return top


def _peak(
    heat: Maps,
    place: Maps,
    shape: Maps,
    u: int,
    v: int,
    cells: tuple[int, ...],
    unit: float,
    other: int,
) -> Peak:
    total = float(heat.sum())
    kind = int(heat.argmax())
    score = float(heat[kind])
    if kind != other and score < CERTAIN * total:
        kind, score = other, total - score
    x = (u + float(place[0]) - (cells[1] - 1) / 2) * unit
    y = ((cells[0] - 1) / 2 - v - float(place[1])) * unit
    long, short, tall = (unit * math.exp(min(4.0, float(log))) for log in shape[:3])
    width, height, r = folded(long, short, turn_of(*shape[3:].tolist()))
    score *= float(place[3])
    return Peak(kind, score, x, y, unit * math.exp(float(place[2])), width, height, tall, r, u, v)


def folded(width: float, height: float, r: float) -> tuple[float, float, float]:
    """The same rectangle with ``r`` in (-pi/4, pi/4]: where needed, the sides change names."""
    turns = math.ceil(r / (math.pi / 2) - 0.5)
    r -= turns * math.pi / 2
    return (height, width, r) if turns % 2 else (width, height, r)


def turn_of(cos2: float, sin2: float, cos4: float, sin4: float) -> float:
    """The long side's angle: the fourfold one is finer, the double one says which side is long.

    Where the fourfold one is not to be had, a long thing has the double one's.
    """
    rough = math.atan2(sin2, cos2) / 2
    if math.hypot(cos4, sin4) < ANGULAR:
        return rough if math.hypot(cos2, sin2) >= LONG else 0.0
    fine = math.atan2(sin4, cos4) / 4
    quarters = round((rough - fine) / (math.pi / 2))
    return fine + quarters * math.pi / 2

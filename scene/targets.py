"""What the detector's network should say of a picture, in cells; and turned pictures (pure numpy).

`Truth` is all of a picture's things as arrays; it is turned and mirrored with the picture, and
then laid out over the cells (`targets`).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene.pictured import SHOWN, Label
from scene.rectify import Grid, Planes
from scene.sight import Pixels

STRIDE = 4
"""Pixels a side of a cell."""
UNKNOWN = -1
"""No answer is asked for."""


class Truth(NamedTuple):
    """Things (n, ...): ``place`` (n, 2) and camera in table units, sizes (n, 3: long, short, tall).

    ``turn``: the long side's angle; ``round``, ``seen`` as in `Label`; ``kind``, ``color``,
    ``look``: numbers, `UNKNOWN` where not asked for.
    """

    camera: tuple[float, float, float]
    place: NDArray[np.float64]
    size: NDArray[np.float64]
    turn: NDArray[np.float64]
    round: NDArray[np.bool_]
    seen: NDArray[np.float64]
    kind: NDArray[np.int64]
    color: NDArray[np.int64]
    look: NDArray[np.int64]


class Targets(NamedTuple):
    """``heat`` (rows, columns) in [0, 1], ``mind`` (rows, columns): 0 where nothing is asked.

    For each of m cells near a thing's middle: its number in the picture, ``weight``, ``place``
    (m, 2), ``shape`` (m, 7), ``kind``, ``color``, ``look`` (m), as in `scene.detector_net.Maps`.
    """

    heat: Planes
    mind: Planes
    cell: NDArray[np.int64]
    weight: Planes
    place: Planes
    shape: Planes
    kind: NDArray[np.int64]
    color: NDArray[np.int64]
    look: NDArray[np.int64]


def truth(
    labels: Sequence[Label],
    camera: tuple[float, float, float],
    kinds: Sequence[str],
    colors: Sequence[str],
    looks: Mapping[str, int],
) -> Truth:
    """A picture's labels as arrays."""
    lengthwise = [one.width >= one.height for one in labels]
    return Truth(
        camera,
        np.array([(one.x, one.y) for one in labels]).reshape(-1, 2),
        np.array([(max(o.width, o.height), min(o.width, o.height), o.tall) for o in labels])
        .reshape(-1, 3),
        np.array([one.r + (0 if long else math.pi / 2)
                  for one, long in zip(labels, lengthwise, strict=True)]),
        np.array([one.round for one in labels], bool),
        np.array([one.seen for one in labels]),
        np.array([kinds.index(one.name) for one in labels], np.int64),
        np.array([colors.index(one.color) if one.color in colors else UNKNOWN for one in labels],
                 np.int64),
        np.array([looks.get(one.look, UNKNOWN) for one in labels], np.int64),
    )  # fmt: skip


def turned(level: Pixels, known: Truth, quarter: int, mirrored: bool) -> tuple[Pixels, Truth]:
    """The same table mirrored (left for right), then turned counter-clockwise by quarters."""
    camera, place, turn = np.array(known.camera), known.place, known.turn
    if mirrored:
        level, turn = level[:, ::-1], math.pi - turn
        camera, place = camera * (-1, 1, 1), place * (-1, 1)
    cos, sin = round(math.cos(quarter * math.pi / 2)), round(math.sin(quarter * math.pi / 2))
    about = np.array([[cos, sin], [-sin, cos]])
    x, y = camera[:2] @ about
    moved = known._replace(
        camera=(float(x), float(y), float(camera[2])),
        place=place @ about,
        turn=turn + quarter * math.pi / 2,
    )
    return np.rot90(level, quarter), moved


def middles(known: Truth) -> NDArray[np.float64]:
    """Where on the table (n, 2) the middles of things, at half their height, seem to be."""
    camera = np.array(known.camera)
    half = np.minimum(known.size[:, 2:] / 2, 0.8 * camera[2])
    seen: NDArray[np.float64] = camera[:2] + (known.place - camera[:2]) * (
        camera[2] / (camera[2] - half)
    )
    return seen


def targets(known: Truth, grid: Grid) -> Targets:
    """The answers wanted, cell by cell."""
    cells, unit = grid.size // STRIDE, STRIDE * grid.pixel
    heat, mind = np.zeros((cells, cells), np.float32), np.ones((cells, cells), np.float32)
    rows: list[tuple[int, float, int, float, float]] = []
    seen, stand = _cells(middles(known), unit, cells), _cells(known.place, unit, cells)
    for number, (u, v) in enumerate(seen):
        if not (-0.5 <= u < cells - 0.5 and -0.5 <= v < cells - 0.5):
            continue
        spread = float(np.clip(known.size[number, 1] / unit / 5, 0.6, 2.2))
        bump = _bump(u, v, spread, cells)
        if known.seen[number] < SHOWN:
            mind[bump > 0.02] = 0
            continue
        heat = np.maximum(heat, bump)
        column, row = round(u), round(v)
        heat[row, column] = 1
        for dv in (-1, 0, 1):
            for du in (-1, 0, 1):
                if 0 <= row + dv < cells and 0 <= column + du < cells:
                    weight = (1.0, 0.5, 0.25)[abs(du) + abs(dv)]
                    at = (row + dv) * cells + column + du
                    right, down = stand[number] - (column + du, row + dv)
                    rows.append((at, weight, number, right, down))
    mind[heat == 1] = 1
    which = np.array([row[2] for row in rows], np.int64)
    return Targets(
        heat, mind,
        np.array([row[0] for row in rows], np.int64),
        np.array([row[1] for row in rows], np.float32),
        np.array([row[3:] for row in rows], np.float32).reshape(-1, 2),
        _shapes(known, unit)[which],
        known.kind[which], known.color[which], known.look[which],
    )  # fmt: skip


def _cells(points: NDArray[np.float64], unit: float, cells: int) -> NDArray[np.float64]:
    """Column and row (n, 2), in cells, of points of the table."""
    return points * (1, -1) / unit + (cells - 1) / 2


def _bump(u: float, v: float, spread: float, cells: int) -> Planes:
    steps = np.arange(cells)
    across = np.exp(-0.5 * ((steps - round(u)) / spread) ** 2)
    down = np.exp(-0.5 * ((steps - round(v)) / spread) ** 2)
    return np.outer(down, across).astype(np.float32)


def _shapes(known: Truth, unit: float) -> Planes:
    """Logs of the sizes in cells, and the angle doubled and fourfold, as far as it can be seen."""
    longer = np.clip((known.size[:, 0] / known.size[:, 1] - 1) / 0.3, 0, 1)
    twice, angular = longer * ~known.round, (~known.round).astype(float)
    return np.column_stack([
        np.log(known.size / unit),
        twice * np.cos(2 * known.turn), twice * np.sin(2 * known.turn),
        angular * np.cos(4 * known.turn), angular * np.sin(4 * known.turn),
    ]).astype(np.float32)  # fmt: skip

"""What is true of a picture, as one array of numbers: what the detector learns from (numpy).

`MOST` rows of `COLUMNS` numbers, one row a thing, the rest empty; so that many pictures are one
array, and go to the machine that learns as they are.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene.colors import COLOR_VALUES, SEEN_COLORS
from scene.generate import CLASSES
from scene.peaks import OTHER
from scene.pictured import NUMBERED, Label
from scene.rectify import Grid
from scene.shapes import KINDS
from scene.sight import Pixels

Rows = NDArray[np.float32]
GRID: Final = Grid(240, 2.0)
NAMES: Final = (*KINDS, OTHER)
MOST: Final = 16
COLUMNS: Final = (
    "x",
    "y",
    "long",
    "short",
    "tall",
    "turn",
    "round",
    "seen",
    "kind",
    "color",
    "look",
)
"""Place and sizes in table units, the long side's angle, whether it looks the same at any angle,
the share of it that is seen (-1: no thing), and numbers in `NAMES`, `SEEN_COLORS` and `LOOKS`."""
UNKNOWN: Final = -1
"""No answer is asked for."""
EMPTY: Final = -1.0
"""Seen, in rows of nothing."""
LOOKS: Final = tuple(
    sorted(
        {f"{name} {color}" for name, kind in KINDS.items() for color in kind.colors}
        | {f"{name} {color}" for name, kind in CLASSES.items() for color in (*kind.colors, None)}
        | {f"thing {number}" for number in range(NUMBERED)}
        | {f"{name} {color}" for name in KINDS for color in COLOR_VALUES if color in SEEN_COLORS}
    )
)
"""Looks that appear on many pictures, so that features can learn to tell them."""
_LOOK = {look: number for number, look in enumerate(LOOKS)}
_KIND = {name: number for number, name in enumerate(NAMES)}
_COLOR = {color: number for number, color in enumerate(SEEN_COLORS)}


class Lessons(NamedTuple):
    """Pictures rectified by `GRID` (n, size, size, 3), cameras (n, 3; table units), and `truth`."""

    levels: Pixels
    cameras: Rows
    rows: Rows


def truth(labels: Sequence[Label]) -> Rows:
    """The labels of a picture as (`MOST`, columns)."""
    rows = np.zeros((MOST, len(COLUMNS)), np.float32)
    rows[:, COLUMNS.index("seen")] = EMPTY
    for row, one in zip(rows, labels, strict=False):
        lengthwise = one.width >= one.height
        long, short = (one.width, one.height) if lengthwise else (one.height, one.width)
        row[:] = (
            one.x, one.y, long, short, one.tall, one.r if lengthwise else one.r + np.pi / 2,
            one.round, one.seen, _KIND.get(one.name, UNKNOWN),
            _COLOR.get(one.color or "", UNKNOWN), _LOOK.get(one.look, UNKNOWN),
        )  # fmt: skip
    return rows

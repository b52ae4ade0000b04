"""A heat strip as a picture: rows of shares under the words they are shares of. Needs OpenCV."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

FONT, SIZE, THIN = cv2.FONT_HERSHEY_SIMPLEX, 0.45, 1
ROW = 24
"""Height of a row (pixels)."""
PAD = 8
MOST = 46
"""Characters of a row's label at most; the middle of a longer one is left out."""
INK, PAPER, HEAT = (40, 40, 40), (255, 255, 255), (160, 90, 20)
"""Colours as blue, green, red: a share of 1 is HEAT, of 0 PAPER."""
SIGNS = {"⏎": "\\n", "⇥": ">>", "⇤": "<<"}
"""Signs for layout that the font lacks; other letters beyond ASCII become "?"."""

Picture = NDArray[np.uint8]


def draw(rows: Sequence[str], columns: Sequence[str], shares: Sequence[Sequence[float]]) -> Picture:
    """Rows with a label on the left, columns with theirs on top; (height, width, 3), BGR.

    A cell is shaded by its share, which is written into it in percent from 1 on.
    """
    labels, heads = [_short(_ascii(one)) for one in rows], [_ascii(one) for one in columns]
    left = max(map(_width, labels)) + 2 * PAD
    widths = [max(_width(one), _width("100")) + 2 * PAD for one in heads]
    picture = np.full((ROW * (len(rows) + 1), left + sum(widths), 3), 255, dtype=np.uint8)
    edges = [left, *(left + int(end) for end in np.cumsum(widths))]
    for head, start in zip(heads, edges, strict=False):
        _write(picture, head, start + PAD, 0, INK)
    for number, (label, row) in enumerate(zip(labels, shares, strict=True), start=1):
        _write(picture, label, PAD, number, INK)
        for share, (start, end) in zip(row, pairwise(edges), strict=True):
            top = number * ROW
            picture[top + 1 : top + ROW, start + 1 : end] = _shade(share)
            if share >= 0.01:
                text = f"{100 * share:.0f}"
                at = (start + end - _width(text)) // 2
                _write(picture, text, at, number, PAPER if share > 0.5 else INK)
    return picture


def save(picture: Picture, path: Path) -> None:
    """Write a PNG. Raises OSError."""
    path.write_bytes(cv2.imencode(".png", picture)[1].tobytes())


def _shade(share: float) -> list[int]:
    return [round(low + (high - low) * share) for low, high in zip(PAPER, HEAT, strict=True)]


def _width(text: str) -> int:
    return int(cv2.getTextSize(text, FONT, SIZE, THIN)[0][0])


def _write(picture: Picture, text: str, x: int, row: int, ink: tuple[int, int, int]) -> None:
    at = (x, row * ROW + ROW - PAD)
    cv2.putText(picture, text, at, FONT, SIZE, ink, THIN, cv2.LINE_AA)


def _ascii(text: str) -> str:
    return "".join(SIGNS.get(one, one) for one in text).encode("ascii", "replace").decode()


def _short(text: str) -> str:
    half = (MOST - 5) // 2
    return text if len(text) <= MOST else f"{text[:half]} ... {text[-half:]}"

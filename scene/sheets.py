"""What is printed for calibration, at true scale: the ChArUco board and the four markers, on A4.

A sheet is black rectangles and words in mm, from its upper left corner right and down; it is
written as PDF (vectors) or PNG (its resolution in pHYs), each with a 100 mm ruler.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from agent.errors import ConfigError
from scene import opencv
from scene.lens import BOARD
from scene.markers import CORNERS

A4 = (210.0, 297.0)
PER_MM = 12
"""Pixels of a PNG in a millimetre: 304.8 dpi."""
POINT = 72 / 25.4
"""PDF units in a millimetre."""
PAPER, CLEAR, GAP = 0.2, 0.15, 4.0
"""White around a marker inside its cutting line, and without any word (of its side: its edges are
looked for in there, `scene.edges`); between two of them (mm)."""


class Box(NamedTuple):
    """A black rectangle: upper left corner, width, height (mm)."""

    x: float
    y: float
    width: float
    height: float


class Word(NamedTuple):
    """Text: its lower left corner and height (mm)."""

    x: float
    y: float
    text: str
    high: float = 3.0


class Sheet(NamedTuple):
    """A page: its name, width and height (mm), and what is on it."""

    name: str
    width: float
    height: float
    boxes: tuple[Box, ...]
    words: tuple[Word, ...]


def sheets(marker: float) -> tuple[Sheet, Sheet]:
    """The board, and the markers with sides of ``marker`` mm. Raises ConfigError if too large."""
    return _board(), _markers(marker)


def _board() -> Sheet:
    width, height = A4[1], A4[0]
    left, top = 24.0, (height - BOARD.down * BOARD.square) / 2
    cell = BOARD.square / 114  # a marker's cells are whole pixels then
    boxes = _boxes(opencv.draw_board(BOARD, 114), left, top, cell)
    words = [Word(6, 48, "100 mm", 2.0), Word(6, 160, "print at", 2.0), Word(6, 164, "100 %", 2.0)]
    return Sheet("board", width, height, (*boxes, *_ruler(9, 50, True)), tuple(words))


def _markers(side: float) -> Sheet:
    width, height = A4
    paper = PAPER * side
    pitch = side + 2 * paper + GAP
    if 2 * pitch > width - 10 or 2 * pitch > height - 50:
        raise ConfigError(f"markers of {side:g} mm do not fit on A4: a smaller marker in [camera]")
    boxes: list[Box] = []
    words = [Word(20, height - 12, "100 mm: measure it. Print at 100 %, cut along the thin lines.")]
    for n, (number, where) in enumerate(CORNERS.items()):
        x = width / 2 + (n % 2 - 1) * pitch + paper + GAP / 2
        y = 16 + n // 2 * pitch + paper
        boxes += _boxes(opencv.draw_marker(number, 6), x, y, side / 6)
        boxes += _frame(x - paper, y - paper, side + 2 * paper)
        words.append(Word(x, y - CLEAR * side, f"{number} {where}: away from you", side / 30))
    return Sheet("markers", width, height, (*boxes, *_ruler(20, height - 24, False)), tuple(words))


def _boxes(cells: opencv.Gray, left: float, top: float, side: float) -> Iterator[Box]:
    """The black cells of a picture as boxes: equal rows and neighbours are one."""
    row = 0
    while row < len(cells):
        end = row + 1
        while end < len(cells) and (cells[end] == cells[row]).all():
            end += 1
        black = np.concatenate(([0], (cells[row] < 128).astype(int), [0]))
        starts, ends = np.flatnonzero(np.diff(black) == 1), np.flatnonzero(np.diff(black) == -1)
        for begin, over in zip(starts, ends, strict=True):
            yield Box(
                left + begin * side, top + row * side, (over - begin) * side, (end - row) * side
            )
        row = end


def _frame(x: float, y: float, side: float) -> Iterator[Box]:
    thin = 0.1
    yield from (Box(x, y, side, thin), Box(x, y + side, side, thin))
    yield from (Box(x, y, thin, side), Box(x + side, y, thin, side))


def _ruler(x: float, y: float, upright: bool) -> Iterator[Box]:
    """100 mm between the outer sides of its first and last mark."""
    thin = 0.2
    yield Box(x, y, thin, 100) if upright else Box(x, y, 100, thin)
    for n in range(11):
        at, long = n * (100 - thin) / 10, 4.0 if n % 5 == 0 else 2.0
        yield Box(x, y + at, long, thin) if upright else Box(x + at, y, thin, long)


# --- files -----------------------------------------------------------------------------------


def pdf(pages: Sequence[Sheet]) -> bytes:
    """All sheets as one PDF (ISO 32000-1)."""
    first = 4
    kids = " ".join(f"{first + 2 * n} 0 R" for n in range(len(pages)))
    objects = [
        "<</Type/Catalog/Pages 2 0 R/ViewerPreferences<</PrintScaling/None>>>>",
        f"<</Type/Pages/Kids[{kids}]/Count {len(pages)}>>",
        "<</Type/Font/Subtype/Type1/BaseFont/Helvetica>>",
    ]
    for n, page in enumerate(pages):
        drawn = _drawn(page)
        objects += [
            f"<</Type/Page/Parent 2 0 R/MediaBox[0 0 {page.width * POINT:.4f} "
            f"{page.height * POINT:.4f}]/Resources<</Font<</F 3 0 R>>>>"
            f"/Contents {first + 2 * n + 1} 0 R>>",
            f"<</Length {len(drawn)}>>stream\n{drawn}\nendstream",
        ]
    return _numbered(objects)


def _drawn(page: Sheet) -> str:
    """A page's content; the unit is made the millimetre, y runs up."""
    parts = [f"q {POINT:.6f} 0 0 {POINT:.6f} 0 0 cm"]
    for x, y, width, height in page.boxes:
        parts.append(f"{x:.4f} {page.height - y - height:.4f} {width:.4f} {height:.4f} re f")
    for word in page.words:
        x, y = word.x, page.height - word.y
        parts.append(f"BT /F {word.high * 1.4:.2f} Tf {x:.2f} {y:.2f} Td ({word.text}) Tj ET")
    return "\n".join((*parts, "Q"))


def _numbered(objects: Sequence[str]) -> bytes:
    data, places = b"%PDF-1.7\n", []
    for number, text in enumerate(objects, 1):
        places.append(len(data))
        data += f"{number} 0 obj\n{text}\nendobj\n".encode("ascii")
    table = "".join(f"{place:010} 00000 n \n" for place in places)
    end = f"trailer\n<</Size {len(objects) + 1}/Root 1 0 R>>\nstartxref\n{len(data)}\n%%EOF\n"
    return data + f"xref\n0 {len(objects) + 1}\n0000000000 65535 f \n{table}{end}".encode("ascii")


def raster(page: Sheet) -> opencv.Gray:
    """A sheet as a grey picture, ``PER_MM`` pixels a millimetre."""
    size = round(page.height * PER_MM), round(page.width * PER_MM)
    picture = np.full(size, 255, np.uint8)
    for x, y, width, height in page.boxes:
        left, top = round(x * PER_MM), round(y * PER_MM)
        right, bottom = round((x + width) * PER_MM), round((y + height) * PER_MM)
        picture[top : max(bottom, top + 1), left : max(right, left + 1)] = 0
    for word in page.words:
        at = (round(word.x * PER_MM), round(word.y * PER_MM))
        opencv.write(picture, word.text, at, round(word.high * PER_MM))
    return picture


def png(page: Sheet) -> bytes:
    """A sheet as PNG; pHYs says how many pixels a metre has."""
    data = opencv.png(raster(page))
    head = 8 + 4 + 4 + 13 + 4  # signature; length, name, data and sum of IHDR
    body = b"pHYs" + struct.pack(">IIB", 1000 * PER_MM, 1000 * PER_MM, 1)
    chunk = struct.pack(">I", 9) + body + struct.pack(">I", zlib.crc32(body))
    return data[:head] + chunk + data[head:]

"""A grid of terminal cells with four pixels each, seen as a square of the world from above.

A cell is twice as tall as wide; its four pixels (quadrant blocks) hold two colours at most.
Lines are braille dots (2 x 4 a cell). World coordinates are the table frame: x right, y away,
so y grows upwards on the screen. No widget and no terminal here: the result is plain values.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator
from typing import NamedTuple

Rgb = tuple[int, int, int]

QUADRANTS = " ▘▝▀▖▌▞▛▗▚▐▜▄▙▟█"
"""Block characters by the bits of their filled pixels: 1 upper left, 2 upper right, 4, 8 lower."""
BRAILLE = ((0x01, 0x08), (0x02, 0x10), (0x04, 0x20), (0x40, 0x80))
"""Bit of each braille dot, by row and column within a cell."""


class Cell(NamedTuple):
    """One character with its colours."""

    char: str
    fg: Rgb
    bg: Rgb
    bold: bool = False


class View(NamedTuple):
    """Which part of the world the grid shows: ``-across..across`` in x, ``-along..along`` in y."""

    width: int
    height: int
    across: float
    along: float

    def column(self, x: float) -> int:
        """The column of cells that holds x (table units), clipped to the grid."""
        at = math.floor((x + self.across) / (2 * self.across) * self.width)
        return min(max(at, 0), self.width - 1)

    def row(self, y: float) -> int:
        """The row of cells that holds y (table units), clipped to the grid."""
        at = math.floor((self.along - y) / (2 * self.along) * self.height)
        return min(max(at, 0), self.height - 1)

    def x(self, column: float) -> float:
        """The x (table units) at a fractional column."""
        return column / self.width * 2 * self.across - self.across

    def y(self, row: float) -> float:
        """The y (table units) at a fractional row."""
        return self.along - row / self.height * 2 * self.along


class Canvas:
    """Pixels, dots and characters over a background, flattened to cells by `cells`."""

    def __init__(self, view: View, ground: Callable[[int, int], Rgb]) -> None:
        """``ground(column, row)`` is the colour of a cell where nothing is drawn."""
        self.view = view
        self._ground = ground
        self._pixels: dict[tuple[int, int], Rgb] = {}
        self._dots: dict[tuple[int, int], tuple[int, Rgb]] = {}
        self._thin: set[tuple[int, int]] = set()
        self._chars: dict[tuple[int, int], tuple[str, Rgb, Rgb | None, bool]] = {}

    def fill(self, inside: Callable[[float, float], bool], box: Box, color: Rgb) -> None:
        """Colour the pixels whose centre (table units) is ``inside``; only ``box`` is searched."""
        for column in range(self.view.column(box.left), self.view.column(box.right) + 1):
            for row in range(self.view.row(box.top), self.view.row(box.bottom) + 1):
                for px, py in _pixels(column, row):
                    if inside(self.view.x((px + 0.5) / 2), self.view.y((py + 0.5) / 2)):
                        self._pixels[px, py] = color

    def line(self, x1: float, y1: float, x2: float, y2: float, color: Rgb) -> None:
        """Dots along a segment (table units); what leaves the grid is left out."""
        view = self.view
        across = abs(x2 - x1) / view.across * view.width
        along = abs(y2 - y1) / view.along * view.height * 2
        count = max(1, math.ceil(max(across, along)))
        for index in range(count + 1):
            share = index / count
            self._dot(x1 + (x2 - x1) * share, y1 + (y2 - y1) * share, color)

    def _dot(self, x: float, y: float, color: Rgb) -> None:
        view = self.view
        dot_x = math.floor((x + view.across) / view.across * view.width)
        dot_y = math.floor((view.along - y) / view.along * view.height * 2)
        cell = dot_x // 2, dot_y // 4
        bits, _ = self._dots.get(cell, (0, color))
        self._dots[cell] = bits | BRAILLE[dot_y % 4][dot_x % 2], color

    def write(
        self, column: int, row: int, text: str, fg: Rgb, bg: Rgb | None = None, bold: bool = False
    ) -> None:
        """Characters from a cell on, over everything; ``bg`` None keeps what is beneath."""
        for offset, char in enumerate(text):
            if 0 <= column + offset < self.view.width and 0 <= row < self.view.height:
                self._chars[column + offset, row] = char, fg, bg, bold
                self._thin.discard((column + offset, row))

    def rule(self, column: int, row: int, text: str, fg: Rgb) -> None:
        """Characters that a label may cover if need be."""
        self.write(column, row, text, fg)
        self._thin.update((column + offset, row) for offset in range(len(text)))

    def crowd(self, column: int, row: int) -> int:
        """How bad a label would be on this cell: 0 free, 1 over a rule, 3 over something."""
        if not (0 <= column < self.view.width and 0 <= row < self.view.height):
            return 3
        if (column, row) in self._thin:
            return 1
        taken = (column, row) in self._chars or any(
            pixel in self._pixels for pixel in _pixels(column, row)
        )
        return 3 if taken else 0

    def cells(self) -> list[list[Cell]]:
        """Everything flattened: ``height`` rows of ``width`` cells."""
        width, height = self.view.width, self.view.height
        return [[self._cell(column, row) for column in range(width)] for row in range(height)]

    def _cell(self, column: int, row: int) -> Cell:
        ground = self._ground(column, row)
        colors = [self._pixels.get(pixel, ground) for pixel in _pixels(column, row)]
        ranked = [color for color, _ in Counter(colors).most_common(2)]
        covered = (column, row) in self._thin and colors != [ground] * 4
        if (column, row) in self._chars and not covered:
            char, fg, bg, bold = self._chars[column, row]
            return Cell(char, fg, bg or ranked[0], bold)
        if len(ranked) == 1:
            dots = self._dots.get((column, row))
            if dots is not None and ranked[0] == ground:
                return Cell(chr(0x2800 + dots[0]), dots[1], ground)
            return Cell(" " if ranked[0] == ground else "█", ranked[0], ranked[0])
        fg, bg = ranked if ranked[1] == ground else (ranked[1], ranked[0])
        bits = sum(1 << index for index, color in enumerate(colors) if color == fg)
        return Cell(QUADRANTS[bits], fg, bg)


class Box(NamedTuple):
    """An axis-aligned part of the world (table units)."""

    left: float
    right: float
    bottom: float
    top: float


def _pixels(column: int, row: int) -> Iterator[tuple[int, int]]:
    yield 2 * column, 2 * row
    yield 2 * column + 1, 2 * row
    yield 2 * column, 2 * row + 1
    yield 2 * column + 1, 2 * row + 1

"""The map panel: the table from above, redrawn at most 15 times a second and only on change."""

from __future__ import annotations

import time
from collections.abc import Iterator
from functools import lru_cache
from itertools import groupby

from textual.app import ComposeResult
from textual.color import Color
from textual.containers import Vertical
from textual.content import Content, Span
from textual.style import Style
from textual.widget import Widget
from textual.widgets import Static

from agent.messages import Waypoint
from scene.types import Scene
from tui.canvas import Cell, Rgb
from tui.drawing import DARK, LIGHT, NEXT, Picture, draw, labels
from tui.plain import millimetres, one_line

REDRAW = 1 / 15
"""Least seconds between two redraws."""


class TableMap(Widget):
    """The picture alone, as large a square as fits."""

    def __init__(self, *, id: str | None = None) -> None:
        super().__init__(id=id)
        self._picture = Picture()
        self._rows: list[list[Cell]] = []

    def show(self, picture: Picture) -> None:
        """Draw another picture."""
        self._picture = picture
        self._rows = []
        self.refresh()

    def notify_style_update(self) -> None:
        """Draw again in the colours of the new theme."""
        super().notify_style_update()
        self._rows = []

    def on_resize(self) -> None:
        """Draw again to the new size."""
        self._rows = []

    def rows(self) -> list[list[Cell]]:
        """The cells on screen now, top row first."""
        if not self._rows:
            palette = DARK if self.app.current_theme.dark else LIGHT
            self._rows = draw(self._picture, self.size.width, self.size.height, palette)
        return self._rows

    def render(self) -> Content:
        """The cells as coloured text."""
        rows = self.rows()
        text = "\n".join("".join(cell.char for cell in row) for row in rows)
        return Content(text, list(_spans(rows)))


def _spans(rows: list[list[Cell]]) -> Iterator[Span]:
    """Runs of cells with the same colours, as spans of the rows joined by line breaks."""
    at = 0
    for row in rows:
        for (fg, bg, bold), run in groupby(row, key=lambda cell: cell[1:]):
            length = len(list(run))
            yield Span(at, at + length, _style(fg, bg, bold))
            at += length
        at += 1


@lru_cache(maxsize=2048)
def _style(fg: Rgb, bg: Rgb, bold: bool) -> Style:
    return Style(Color(*bg), Color(*fg), bold=bold)


class MapPanel(Vertical):
    """Heading with the tip's position, the map, and a line about what is not on the table."""

    def __init__(self, *, id: str | None = None) -> None:
        super().__init__(id=id)
        self.picture = Picture()
        self._drawn_at = 0.0
        self._waiting = False

    def compose(self) -> ComposeResult:
        """Heading, map, line below."""
        yield Static(id="map-title", classes="heading")
        yield TableMap(id="map")
        yield Static(id="map-aside")

    def on_mount(self) -> None:
        """Show the empty table."""
        self._redraw()

    def show(self, picture: Picture) -> None:
        """Draw the picture soon; an equal one costs nothing."""
        if picture == self.picture:
            return
        self.picture = picture
        if self._waiting:
            return
        self._waiting = True
        self.set_timer(max(self._drawn_at + REDRAW - time.monotonic(), 0.001), self._redraw)

    def _redraw(self) -> None:
        self._waiting = False
        self._drawn_at = time.monotonic()
        self.query_one("#map-title", Static).update(title(self.picture))
        below = self.query_one("#map-aside", Static)
        below.update(Content(aside(self.picture)))
        below.display = bool(aside(self.picture))
        self.query_one(TableMap).show(self.picture)


def title(picture: Picture) -> Content:
    """The heading: the table's side and the tip's position, with units."""
    if picture.scene is None:
        return Content.styled("table", "bold") + Content.styled(
            "  not seen yet", "$foreground-muted"
        )
    side = picture.scene.table_m
    heading = Content.styled("table", "bold")
    heading += Content.styled(f" {side * 1000:.0f} mm", "$foreground-muted")
    tool = picture.tool
    if tool is not None:
        at = ", ".join(millimetres(value, side) for value in (tool.x, tool.y, tool.z))
        heading += Content.styled(f"  tip {at} mm", "$foreground-muted")
    return heading


def aside(picture: Picture) -> str:
    """What comes next; what is in the tray, on the floor or in the gripper; a legend for grips; of
    what the eye is unsure, and what it does not see."""
    parts = [] if picture.scene is None else list(_elsewhere(picture.scene))
    parts += _doubts(picture)
    if len({point.grip for point in picture.plan}) > 1:
        parts.insert(0, "○ grips  ● lets go")
    if picture.next is not None:
        parts.insert(0, f"{NEXT} next: {_coming(picture, picture.next)}")
    return "  ".join(parts)


def _doubts(picture: Picture) -> Iterator[str]:
    if picture.scene is None:
        return
    names = labels(list(picture.scene.objects))
    unsure = [f"{names[id_]} ±{mm} mm" for id_, mm in picture.unsure if id_ in names]
    unseen = [f"{names[id_]} for {seconds} s" for id_, seconds in picture.unseen if id_ in names]
    for what, things in (("unsure", unsure), ("unseen", unseen)):
        if things:
            yield f"{what}: {', '.join(things)}"


def _coming(picture: Picture, point: Waypoint) -> str:
    """What the tool does next: close, open, or go somewhere."""
    before = picture.plan[picture.done - 1] if picture.done else picture.start
    if before is not None and before.grip != point.grip:
        return "grip" if point.grip else "let go"
    side = 0.4 if picture.scene is None else picture.scene.table_m
    return ", ".join(millimetres(value, side) for value in (point.x, point.y, point.z)) + " mm"


def _elsewhere(scene: Scene) -> Iterator[str]:
    held = [item.name for item in scene.objects if item.held or item.on == "gripper"]
    floor = [item.name for item in scene.objects if item.on == "floor"]
    tray = [item.name for item in scene.tray]
    for where, names in (("held", held), ("floor", floor), ("tray", tray)):
        if names:
            yield f"{where}: {one_line(', '.join(names))}"

"""The table from above as cells: objects to scale, the planned path, the end effector.

Pure: a `Picture` (values from the bus and what the person points at) and a size in, cells out.
x grows to the right, y upwards; the person sits below the last row.
"""

from __future__ import annotations

import itertools
import math
from collections import Counter
from collections.abc import Callable, Collection, Iterator, Sequence
from typing import NamedTuple

from textual.color import Color, ColorParseError

from agent.messages import Target, Waypoint
from scene.types import EDGE, Scene, SceneObject
from tui.canvas import Box, Canvas, Cell, Rgb, View
from tui.plain import one_line, shorten

SPAN = 1.12
"""Half of what the map shows at least (table units): the table and a strip of floor around it."""
UNLIKE = 70
"""Least difference of an object's colour from the table's, summed over red, green, blue."""
FUZZ = 0.002
"""Slack of footprints (table units), so that a measured angle of nearly 0 leaves no ragged edge."""
LABEL = 14
"""Longest label on the map, characters."""
RING = 24
"""Corners of a ring."""
NEXT = "◇"
"""Where the tool goes next."""


class Palette(NamedTuple):
    """The map's colours for one kind of theme."""

    floor: Rgb
    table: Rgb
    edge: Rgb
    text: Rgb
    faint: Rgb
    plan: Rgb
    done: Rgb
    tool: Rgb
    mark: Rgb
    thing: Rgb


DARK = Palette(
    floor=(17, 20, 28), table=(38, 44, 58), edge=(92, 104, 130), text=(226, 230, 240),
    faint=(128, 138, 160), plan=(112, 196, 255), done=(74, 92, 118), tool=(255, 200, 87),
    mark=(255, 214, 64), thing=(142, 152, 172),
)  # fmt: skip
LIGHT = Palette(
    floor=(222, 225, 231), table=(247, 247, 243), edge=(132, 140, 156), text=(24, 28, 38),
    faint=(104, 112, 128), plan=(20, 104, 190), done=(176, 186, 200), tool=(196, 92, 0),
    mark=(190, 110, 0), thing=(136, 144, 160),
)  # fmt: skip

COLORS: dict[str, Rgb] = {
    "red": (222, 70, 66), "green": (78, 176, 92), "blue": (70, 126, 226),
    "yellow": (240, 208, 64), "orange": (244, 146, 46), "purple": (152, 98, 208),
    "violet": (152, 98, 208), "pink": (242, 142, 178), "brown": (150, 100, 62),
    "black": (12, 12, 14), "white": (238, 238, 234), "gray": (150, 154, 162),
    "grey": (150, 154, 162), "cyan": (70, 196, 206), "silver": (192, 196, 204),
    "gold": (214, 174, 62), "beige": (222, 206, 170),
}  # fmt: skip


class Picture(NamedTuple):
    """What the map shows. ``plan[:done]`` is behind the tool; ``marked`` are highlighted ids.

    ``ahead``: the way to ``plan[done]`` is under way or comes next, and is shown as such.
    ``unsure``: ids with the standard deviation of their places (mm), where that is worth telling;
    ``unseen``: ids with the whole seconds for which the eye has not seen them.
    """

    scene: Scene | None = None
    plan: tuple[Waypoint, ...] = ()
    start: Waypoint | None = None
    done: int = 0
    tool: Waypoint | None = None
    marked: frozenset[str] = frozenset()
    targets: tuple[Target, ...] = ()
    ahead: bool = False
    unsure: tuple[tuple[str, int], ...] = ()
    unseen: tuple[tuple[str, int], ...] = ()

    @property
    def next(self) -> Waypoint | None:
        """Where the tool goes now, or will go next."""
        return self.plan[self.done] if self.ahead and self.done < len(self.plan) else None


def draw(picture: Picture, width: int, height: int, palette: Palette) -> list[list[Cell]]:
    """``height`` rows of ``width`` cells: the table as large as fits, floor around it.

    The last row says where the person sits and which way x grows.
    """
    canvas = Canvas(*_view(width, height - 1, palette))
    _edges(canvas, palette)
    _path(canvas, picture, palette)
    items = _drawn(picture.scene)
    for item in items:
        _footprint(canvas, item, palette)
    for item in items:
        if item.id in dict(picture.unsure) and picture.scene is not None:
            _ring(
                canvas, item, dict(picture.unsure)[item.id] / picture.scene.table_m / 500, palette
            )
    _grips(canvas, picture, palette)
    names = labels(items, {id_ for id_, _ in picture.unseen})
    for item in items:
        _label(canvas, item, names[item.id], palette, item.id in picture.marked)
    for number, target in enumerate(picture.targets, 1):
        char = "◎" if len(picture.targets) == 1 else str(number)
        column, row = canvas.view.column(target.x), canvas.view.row(target.y)
        canvas.write(column, row, char, palette.mark, bold=True)
    if picture.next is not None:
        column, row = canvas.view.column(picture.next.x), canvas.view.row(picture.next.y)
        canvas.write(column, row, NEXT, palette.tool, bold=True)
    _tool(canvas, picture.tool, palette)
    canvas.write(0, 0, "y↑", palette.faint)
    return [*canvas.cells(), _axis(width, palette)]


def _axis(width: int, palette: Palette) -> list[Cell]:
    text = "you".center(width)[: max(width - 3, 0)] + " x→"
    return [Cell(char, palette.faint, palette.floor) for char in text[:width].ljust(width)]


def _view(width: int, height: int, palette: Palette) -> tuple[View, Callable[[int, int], Rgb]]:
    """The view that fills the grid at one scale on both axes, and its background."""
    rows_a_unit = max(min(height, width / 2), 1) / (2 * SPAN)
    view = View(
        max(width, 1), max(height, 1), width / (4 * rows_a_unit), height / (2 * rows_a_unit)
    )
    return view, _ground(view, palette).color


def _ground(view: View, palette: Palette) -> _Ground:
    return _Ground(view.column(-EDGE), view.column(EDGE), view.row(EDGE), view.row(-EDGE), palette)


class _Ground(NamedTuple):
    """The cells of the table's edges: table inside, floor outside."""

    left: int
    right: int
    top: int
    bottom: int
    palette: Palette

    def color(self, column: int, row: int) -> Rgb:
        inside = self.left < column < self.right and self.top < row < self.bottom
        return self.palette.table if inside else self.palette.floor


def _edges(canvas: Canvas, palette: Palette) -> None:
    ground = _ground(canvas.view, palette)
    across = "─" * (ground.right - ground.left - 1)
    canvas.rule(ground.left, ground.top, f"┌{across}┐", palette.edge)
    canvas.rule(ground.left, ground.bottom, f"└{across}┘", palette.edge)
    for row in range(ground.top + 1, ground.bottom):
        canvas.rule(ground.left, row, "│", palette.edge)
        canvas.rule(ground.right, row, "│", palette.edge)


def _drawn(scene: Scene | None) -> list[SceneObject]:
    """The objects with a position, lower ones first so that what stands on them covers them."""
    placed = [] if scene is None else [item for item in scene.objects if item.x is not None]
    return sorted(placed, key=lambda item: (item.z, item.top, -item.width * item.height))


def labels(items: list[SceneObject], unseen: Collection[str] = ()) -> dict[str, str]:
    """What each object is called on the map, by id: its name, or its id if two share the name.

    What the eye does not see now has a question mark.
    """
    shared = Counter(item.name for item in items)
    names = {item.id: item.name if shared[item.name] == 1 else item.id for item in items}
    short = {key: shorten(one_line(name), LABEL) for key, name in names.items()}
    return {key: f"{name}?" if key in unseen else name for key, name in short.items()}


def _ring(canvas: Canvas, item: SceneObject, sd: float, palette: Palette) -> None:
    """A faint ring about a thing that may stand elsewhere, 3 ``sd`` (table units) from its side."""
    x, y = _centre(canvas.view, item)
    radius = max(item.width, item.height) / 2 + 3 * sd
    turns = [math.tau * step / RING for step in range(RING + 1)]
    points = [(x + radius * math.cos(turn), y + radius * math.sin(turn)) for turn in turns]
    for start, end in itertools.pairwise(points):
        canvas.line(*start, *end, palette.faint)


def _centre(view: View, item: SceneObject) -> tuple[float, float]:
    """The object's centre, brought to the rim of the view if it lies farther out."""
    x, y = item.position
    across, along = view.across - item.width / 2, view.along - item.height / 2
    return min(max(x, -across), across), min(max(y, -along), along)


def _footprint(canvas: Canvas, item: SceneObject, palette: Palette) -> None:
    view = canvas.view
    x, y = _centre(view, item)
    cos, sin = math.cos(item.r), math.sin(item.r)
    # half a pixel at least, so that nothing is lost between pixel centres
    half_w = max(item.width / 2, view.across / view.width / 2)
    half_h = max(item.height / 2, view.along / view.height / 2)
    reach = math.hypot(half_w, half_h)

    def inside(at_x: float, at_y: float) -> bool:
        dx, dy = at_x - x, at_y - y
        return abs(dx * cos + dy * sin) < half_w + FUZZ and abs(dy * cos - dx * sin) < half_h + FUZZ

    box = Box(x - reach, x + reach, y - reach, y + reach)
    canvas.fill(inside, box, color_of(item, palette))


def color_of(item: SceneObject, palette: Palette) -> Rgb:
    """The object's colour word as a colour; grey if it has none or nobody knows the word.

    A colour too close to the table's is brought nearer to the edge's, or it could not be seen.
    """
    word = (item.color or "").strip().lower()
    color = COLORS.get(word) or _parsed(word) or palette.thing
    if sum(abs(one - other) for one, other in zip(color, palette.table, strict=True)) > UNLIKE:
        return color
    return _between(color, palette.edge)


def _between(one: Rgb, other: Rgb) -> Rgb:
    return (one[0] + other[0]) // 2, (one[1] + other[1]) // 2, (one[2] + other[2]) // 2


def _parsed(word: str) -> Rgb | None:
    try:
        parsed = Color.parse(word.replace(" ", "")) if word else None
    except ColorParseError:
        return None
    return None if parsed is None else (parsed.r, parsed.g, parsed.b)


def _label(canvas: Canvas, item: SceneObject, label: str, palette: Palette, marked: bool) -> None:
    """The name inside the footprint if it fits, else where it disturbs least; marked: reversed."""
    view = canvas.view
    x, y = _centre(view, item)
    left, right = view.column(x - item.width / 2), view.column(x + item.width / 2)
    if right - left - 1 >= len(label):
        column, row = (left + right + 1 - len(label)) // 2, view.row(y)
        fg = _contrast(color_of(item, palette))
    else:
        column, row = _room(canvas, item, label)
        # tinted by its object, so that close neighbours' names are not mistaken
        fg = _between(color_of(item, palette), palette.text)
    if marked:
        canvas.write(column, row, label, palette.floor, palette.mark, bold=True)
    else:
        canvas.write(column, row, label, fg)


def _room(canvas: Canvas, item: SceneObject, label: str) -> tuple[int, int]:
    """Where the label disturbs least: beside, below or above, not touching other things."""
    x, _ = _centre(canvas.view, item)
    left = canvas.view.column(x - item.width / 2)
    right = canvas.view.column(x + item.width / 2)

    def trouble(place: tuple[int, int]) -> int:
        column, row = place
        over = sum(canvas.crowd(column + offset, row) for offset in range(len(label)))
        sides = (column - 1, column + len(label))
        touching = sum(canvas.crowd(at, row) > 1 for at in sides if not (left <= at <= right))
        return over + touching

    column, row = min(_places(canvas.view, item, len(label)), key=trouble)
    return min(max(column, 0), max(canvas.view.width - len(label), 0)), row


def _places(view: View, item: SceneObject, length: int) -> Iterator[tuple[int, int]]:
    x, y = _centre(view, item)
    left, right = view.column(x - item.width / 2), view.column(x + item.width / 2)
    top, bottom = view.row(y + item.height / 2), view.row(y - item.height / 2)
    middle = (left + right + 1 - length) // 2
    yield right + 1, view.row(y)
    yield left - length, view.row(y)
    for row in (bottom + 1, top - 1):
        for column in (middle, left, right + 1 - length, right + 1, left - length):
            yield column, row


def _path(canvas: Canvas, picture: Picture, palette: Palette) -> None:
    """What is done, what is to come, and last, over both, the way at hand."""
    if not picture.plan:
        return
    points = (picture.start or picture.plan[0], *picture.plan)
    for index in range(len(picture.plan)):
        _way(canvas, points, index, palette.done if index < picture.done else palette.plan)
    if picture.next is not None:
        _way(canvas, points, picture.done, palette.tool)


def _way(canvas: Canvas, points: Sequence[Waypoint], index: int, color: Rgb) -> None:
    one, other = points[index], points[index + 1]
    canvas.line(one.x, one.y, other.x, other.y, color)


def _grips(canvas: Canvas, picture: Picture, palette: Palette) -> None:
    """A ring where the gripper will close, a disc where it will open."""
    holding = picture.start is not None and picture.start.grip
    for index, point in enumerate(picture.plan):
        if point.grip != holding and index >= picture.done:
            column, row = canvas.view.column(point.x), canvas.view.row(point.y)
            canvas.write(column, row, "○" if point.grip else "●", palette.plan, bold=True)
        holding = point.grip


def _tool(canvas: Canvas, tool: Waypoint | None, palette: Palette) -> None:
    if tool is None:
        return
    column, row = canvas.view.column(tool.x), canvas.view.row(tool.y)
    canvas.write(column, row, "╋" if tool.grip else "┼", palette.floor, palette.tool, bold=True)


def _contrast(color: Rgb) -> Rgb:
    red, green, blue = color
    bright = 0.3 * red + 0.59 * green + 0.11 * blue
    return (20, 22, 28) if bright > 120 else (246, 246, 248)

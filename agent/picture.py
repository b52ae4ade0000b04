"""A checked plan as one SVG picture for a report: from above, and the tool's height on its way.

Pure; the same plan gives the same bytes. Drawn in table units (x right, y up, the person below)
with millimetres beside them; pixels are complex numbers. Names and program text are data: cleaned,
shortened, text nodes only.
"""

from __future__ import annotations

import cmath
import math
import unicodedata
from collections import Counter
from collections.abc import Iterator
from typing import NamedTuple
from xml.etree.ElementTree import Element, SubElement, tostring

from msgspec.structs import replace

from robot_bridge.api import ApprovedPlan, Limits, length
from scene.kinds import COLORS, color_in, head_noun, words
from scene.relations import extents, moved
from scene.tray import DEPTH, GAP, tray_positions
from scene.types import EDGE, Pose, Scene, SceneObject

LOW, FAR = 0.3, 2.0
"""Low is below the tallest thing, or this height; limits farther out do not widen the picture."""
TOP, SIZE = 66 + 76j, 710 + 710j
"""Where the view from above lies (pixels)."""
CELL, LINES = 5, 30
"""Labels keep apart by squares of so many pixels; how many lines of the program are shown."""
ANGULAR = {"block", "book", "box", "brick", "case", "crate", "cube", "dice", "die", "tile", "tray"}
"""Other things that are about as wide as high are drawn round."""
LOOKS = {
    "paper": "fill:#fff", "floor": "fill:#eceef2", "table": "fill:#fbf9f3;stroke:#8c8775",
    "tray": "fill:#dfe3ea", "grid": "stroke:#d6dae2", "faint": "fill:#667080",
    "limit": "stroke:#b3261e;fill:none;stroke-dasharray:2 4", "text": "fill:#1d2430",
    "keep-out": "fill:url(#hatch);stroke:#b3261e", "strong": "fill:#1d2430;font-weight:bold",
    "back": "fill:#fff;fill-opacity:0.75", "thing": "stroke:#4c5362;fill-opacity:0.6",
    "on-gripper": "stroke-width:3", "on-floor": "fill-opacity:0.2;stroke-dasharray:1 2",
    "end": "fill-opacity:0.15;stroke:#3f4655;stroke-dasharray:4 3", "on": "stroke-width:3.4",
    "high": "stroke:#1f66b0;stroke-width:1.6;stroke-dasharray:7 4;fill:#1f66b0",
    "low": "stroke:#c8440b;stroke-width:1.8;fill:#c8440b", "head": "stroke:none",
    "vertical": "fill:#5a3a9c;stroke:#5a3a9c;stroke-width:1.6", "leader": "stroke:#8a909e",
    "start": "fill:#ffb000;stroke:#1d2430;stroke-width:1.5", "release": "fill:#1d2430;stroke:#fff",
    "grip": "fill:none;stroke:#1d2430;stroke-width:2.2", "chip": "fill:#1d2430;stroke:none",
    "carry": "stroke:#3f4655;fill:#3f4655", "number": "fill:#fff",
    "program": "font-family:DejaVu Sans Mono,Menlo,monospace;font-size:10px",
}  # fmt: skip
"""How each class is drawn; written into each element, as viewers differ over style sheets."""
LEGEND = (
    "start the tool starts here|high moves above all things: z ≥ {0} units|low moves among them: "
    "z < {0} units|on thick: suction is on|vertical straight ↑ or ↓ to this z (units)|grip grips|"
    "release lets go|chip first point of a program line|end where a thing ends|carry its way there|"
    "keep-out the tool keeps out|limit limits: x {1:g} to {2:g}, y {3:g} to {4:g} units"
)
DISCS = {"vertical": 2.5, "release": 4.5, "start": 5.5, "grip": 7.0}
"""Radius of each symbol (pixels); the wider is drawn over the narrower."""
PARTS = {
    "at": "x y", "size": "width height", "mid": "cx cy", "one": "x1 y1", "other": "x2 y2",
    "corner": "rx ry",
}  # fmt: skip
"""The attributes that a complex number is written as."""
SIDES = (1, -1, 1j, -1j, 1 - 1j, -1 - 1j, 1 + 1j, -1 + 1j)
Pair = tuple[float, float]
Pixels = tuple[complex, complex]
Name = tuple[complex, complex, str]
"""A label that waits until all is drawn: middle and half the size of what it names, text."""


class Way(NamedTuple):
    """One primitive: look, goal, path until there; its line if it is its first; what changes."""

    look: str
    goal: Pose
    path: float
    line: int
    note: str


def svg(plan: ApprovedPlan, limits: Limits, after: Scene | None = None) -> str:
    """The plan as an SVG document; ``after`` is where the things are expected to end."""
    scene = plan.scene or Scene(table_m=(after or Scene()).table_m)
    tops = [item.top for item in scene.objects if item.on not in ("floor", "gripper")]
    low, mm = max(tops, default=LOW), scene.table_m * 500
    ways = list(_ways(plan, low))
    total = ways[-1].path if ways else 0.0
    plural = "" if len(ways) == 1 else "s"
    caption = f"{len(ways)} motion{plural} · path {total:.2f} units = {total * mm:.0f} mm · "
    caption += f"{sum(plan.durations):.1f} s · 1 unit = {_n(mm)} mm"
    caption += "" if plan.scene or after else " (assumed)"
    root = Element("svg", xmlns="http://www.w3.org/2000/svg", viewBox="0 0 1100 1110", role="img")
    root.attrib |= {"width": "1100", "height": "1110", "font-size": "11"}
    root.set("font-family", "Helvetica, Arial, 'Liberation Sans', sans-serif")
    _add(root, "title", "", f"armchat plan {plan.digest[:12]}: {caption}")
    turned = {"patternUnits": "userSpaceOnUse", "patternTransform": "rotate(45)"}
    defs = _add(root, "defs")
    _add(_add(defs, "clipPath", id="view"), "rect", at=TOP, size=SIZE)
    hatch = _add(defs, "pattern", id="hatch", size=7 + 7j, **turned)
    _add(hatch, "rect", size=2 + 7j, fill="#b3261e", opacity=0.35)
    _add(root, "rect", "paper", size=1100 + 1110j)
    _add(root, "text", "strong", f"Checked plan {plan.digest[:12]}", at=66 + 32j, font_size=18)
    _add(root, "text", "text caption", caption, at=66 + 54j, font_size=13)
    panel = _from_above(_add(root, "g", "above"), plan.start, limits, scene, after, ways)
    _from_the_side(_add(root, "g", "side"), plan.start, limits, ways, mm)
    panel.node = _add(root, "g", "beside")
    _beside(panel, LEGEND.format(_n(low), *limits.x, *limits.y), plan.program)
    return tostring(root, encoding="unicode") + "\n"


def _ways(plan: ApprovedPlan, low: float) -> Iterator[Way]:
    here, path, lines = plan.start, 0.0, {0}
    for told in plan.told:
        goal = Pose(told.x, told.y, told.z, told.r)
        look = "low" if min(here.z, goal.z) < low - 1e-6 else "high"
        if math.dist((here.x, here.y), (goal.x, goal.y)) < 1e-3:
            look = "vertical"
        look += " on" if told.grip else ""
        if told.op == "grip":
            look = "grip" if told.grip else "release"
        rise, turn = goal.z - here.z, math.degrees(math.remainder(goal.r - here.r, math.tau))
        note = f"{'↑' if rise > 0 else '↓'}{_n(goal.z)} " if abs(rise) > 1e-6 else ""
        note += f"r{turn:+.0f}° " if abs(turn) > 0.5 else ""
        path += length(here, goal)
        yield Way(look, goal, path, 0 if told.line in lines else told.line, note)
        here, lines = goal, lines | {told.line}


def _from_above(
    node: Element, start: Pose, limits: Limits, scene: Scene, after: Scene | None, ways: list[Way]
) -> _Panel:
    poses = [start, *(way.goal for way in ways)]
    rims = [_in(-FAR, rim, FAR) for rim in (*limits.x, *limits.y)]
    rims += [at for pose in poses for at in (pose.x, pose.y)]
    span = min(-EDGE, *rims) - 0.08, max(EDGE + DEPTH + GAP, *rims) + 0.08
    panel = _Panel(node, TOP, SIZE, span, span, scene.table_m * 500)
    panel.area("tray", (EDGE + GAP / 2, EDGE + DEPTH + GAP), (-1.63, 1.63))
    panel.area("table", (-EDGE, EDGE), (-EDGE, EDGE))
    panel.area("limit", limits.x, limits.y)
    _add(node, "text", "faint", "tray", at=panel.at(EDGE + DEPTH / 2, 1.52))
    for at, text in ((405 + 828j, "▲ you"), (66 + 828j, "x → (units)"), (4 + 84j, "y ↑ (units)")):
        _add(node, "text", "text", text, at=at)
    panel.node = _add(node, "g", "things", clip_path="url(#view)")
    names = list(_things(panel, scene, after or Scene()))
    panel.node = node
    for zone in limits.keep_outs:
        text = f"{_short(zone.name, 20)}: z {_n(zone.z[0])} to {_n(zone.z[1])} units"
        names.append((*panel.area("keep-out", zone.x, zone.y), text))
    points = [panel.at(pose.x, pose.y) for pose in poses]
    names.append((points[0], 7 + 7j, f"start, z {_n(start.z)} units"))
    noted = [way if "vertical" in way.look else way._replace(note="") for way in ways]
    panel.walk(points, noted, names, 0.6)
    return panel


def _from_the_side(node: Element, start: Pose, limits: Limits, ways: list[Way], mm: float) -> None:
    total = (ways[-1].path if ways else 0.0) or 1.0
    heights = [0.0, start.z, *(_in(0, z, FAR) for z in limits.z), *(way.goal.z for way in ways)]
    x, y = (-0.02 * total, 1.02 * total), (min(heights) - 0.15, max(heights) + 0.15)
    panel = _Panel(node, 66 + 888j, 1004 + 172j, x, y, mm)
    title = "Height z of the tool (units) along its path (units)"
    _add(node, "text", "strong", title, at=66 + 876j)
    panel.area("table", x, (y[0], 0.0))
    _add(node, "text", "faint", "table", at=panel.at(0, 0) + 11j)
    for z in limits.z:
        panel.line("limit", panel.at(x[0], z), panel.at(x[1], z))
    points = [panel.at(0, start.z), *(panel.at(way.path, way.goal.z) for way in ways)]
    limit = panel.at(total, limits.z[1]), 0j, f"limit z {_n(limits.z[1])} units"
    panel.walk(points, ways, [limit], 0.0)


def _things(panel: _Panel, scene: Scene, after: Scene) -> Iterator[Name]:
    """Draw the things where they are, then where those that move end."""
    things = {item.id: item for item in _placed(scene)}
    shared = Counter(item.name for item in things.values())
    for thing in sorted(things.values(), key=lambda thing: (thing.z, thing.top)):
        yield _footprint(panel, "thing", thing, shared[thing.name] > 1)
    for end in _placed(after):
        item = things.get(end.id)
        still = item and (end.on, end.r) == (item.on, item.r) and not moved(item, end)
        if still or end.on == "tray":
            continue
        yield _footprint(panel, "end", end, shared[end.name] > 1)
        one, other = panel.at(*(item or end).position), panel.at(*end.position)
        aside = 6j * (other - one) / max(abs(other - one), 1)  # the tool's way is in the middle
        panel.line("carry", one + aside, other + aside, 1.0)


def _placed(scene: Scene) -> list[SceneObject]:
    """The things with a place, those of the tray where they wait."""
    places = tray_positions(scene)
    waiting = [(item, *places[item.id]) for item in scene.tray if item.id in places]
    placed = [item for item in scene.objects if item.x is not None and item.y is not None]
    return placed + [replace(item, x=x, y=y, on="tray") for item, x, y in waiting]


def _footprint(panel: _Panel, look: str, item: SceneObject, shared: bool) -> Name:
    (x, y), scale = item.position, panel.size.real / (panel.x[1] - panel.x[0])
    at, around = panel.at(x, y), complex(*extents(item)) * scale
    half = complex(item.width, item.height) * scale / 2
    color = (words(item.color or "") or ("",))[-1]
    fill = (color if color in COLORS else color_in(item.name)) or "#b4bac6"
    flat = abs(half.real - half.imag) > 0.1 * half.real or head_noun(item.name) in ANGULAR
    corner = 1 + 1j if flat else half  # a rectangle with such round corners is an ellipse
    place = item.on if item.on in ("floor", "gripper", "tray") else "table"
    turned = f"rotate({_n(-math.degrees(item.r))} {_n(at.real)} {_n(at.imag)})"
    _add(panel.node, "rect", f"{look} on-{place}", at=at - half, size=2 * half, corner=corner,
         fill=fill, transform=turned, data_id=_short(item.id, 40))  # fmt: skip
    panel.take(at, around, 1)
    state = {"floor": " (floor)", "gripper": " (held)"}.get(place, "")
    beyond = not (panel.x[0] <= x <= panel.x[1] and panel.y[0] <= y <= panel.y[1])
    state += f" at {_n(x)}, {_n(y)}" if beyond else ""
    return at, around, _short(item.id if shared else item.name, 18) + state


def _beside(panel: _Panel, legend: str, program: str) -> None:
    """The legend and the program, to the right of the table."""
    for row, entry in enumerate(legend.split("|")):
        (look, text), at = entry.split(" ", 1), complex(812, 86 + 19 * row)
        if look in DISCS:
            panel.mark(look, at)
        elif look in ("chip", "end", "limit", "keep-out"):
            _add(panel.node, "rect", look, at=at - 12 - 6j, size=24 + 12j)
        else:
            panel.line("high on" if look == "on" else look, at - 14, at + 14, 0.6)
        _add(panel.node, "text", "text", text, at=at + 24 + 4j)
    lines = program.split("\n") if program.strip() else []
    for row, line in enumerate(lines[:LINES]):
        at, indent = complex(824, 356 + 14 * row), min(len(line) - len(line.lstrip()), 16)
        _add(panel.node, "text", "faint", str(row + 1), at=at - 8, text_anchor="end")
        text = "\xa0" * indent + _short(line, 43 - indent)
        _add(panel.node, "text", "text program", text, at=at)
    if len(lines) > LINES:
        text = f"and {len(lines) - LINES} more lines"
        _add(panel.node, "text", "faint", text, at=complex(824, 356 + 14 * LINES))


class _Panel:
    """Axes with ticks: table units to pixels, and which pixels are taken when labels are put."""

    def __init__(
        self, node: Element, top: complex, size: complex, x: Pair, y: Pair, mm: float
    ) -> None:
        self.node, self.top, self.size, self.x, self.y = node, top, size, x, y
        self.taken: Counter[complex] = Counter()
        self.left_out = 0
        _add(node, "rect", "floor", at=top, size=size)
        ticks = [(n, self.at(n, y[0]), self.at(n, y[1]), 14j, "middle") for n in _ticks(*x)]
        ticks += [(n, self.at(x[0], n), self.at(x[1], n), -6 - 1j, "end") for n in _ticks(*y)]
        for value, one, other, off, anchor in ticks:
            _add(node, "line", "grid", one=one, other=other)
            _add(node, "text", "text", _n(value), at=one + off, text_anchor=anchor)
            text = f"{value * mm:.0f} mm"
            _add(node, "text", "faint", text, at=one + off + 12j, text_anchor=anchor)

    def at(self, x: float, y: float) -> complex:
        """The pixel of a point; one beyond the rim is brought to it."""
        (x0, x1), (y0, y1) = self.x, self.y
        across, along = (_in(x0, x, x1) - x0) / (x1 - x0), (y1 - _in(y0, y, y1)) / (y1 - y0)
        return self.top + complex(across * self.size.real, along * self.size.imag)

    def area(self, look: str, x: Pair, y: Pair) -> Pixels:
        """A rectangle in table units, cut off at the rim. Its middle and half its size."""
        top, bottom = self.at(x[0], y[1]), self.at(x[1], y[0])
        _add(self.node, "rect", look, at=top, size=bottom - top)
        return (top + bottom) / 2, (bottom - top) / 2

    def line(self, look: str, one: complex, other: complex, head: float = 0.0) -> None:
        """A line, with an arrowhead at this share of it; labels rather keep off it."""
        _add(self.node, "line", look, one=one, other=other)
        steps = int(abs(other - one) / CELL) + 1
        for step in range(steps + 1):
            self.take(one + (other - one) * step / steps, 0, 1)
        if head and steps > 2:
            tip, way = one + (other - one) * head, math.degrees(cmath.phase(other - one))
            place = f"translate({_n(tip.real)} {_n(tip.imag)}) rotate({_n(way)})"
            _add(self.node, "path", f"{look} head", d="M0 0L-9 3.5V-3.5Z", transform=place)

    def mark(self, look: str, at: complex) -> None:
        """A symbol; labels keep off it."""
        size = DISCS.get(look.split()[0], 2.0)
        _add(self.node, "circle", look, mid=at, r=size)
        self.take(at, complex(size, size), 20)

    def take(self, at: complex, half: complex, weight: int) -> None:
        """Have labels keep off a box of this half size."""
        for cell in _cells(at, half):
            self.taken[cell] += weight

    def label(self, at: complex, around: complex, text: str, chip: str = "") -> None:
        """Text, after a chip with line numbers, where it disturbs least about a thing this large.

        Left out, and counted, where other labels take every place.
        """
        half = complex((_wide(chip) + _wide(text)) / 2, 7)
        places = [at] if half.real < around.real and half.imag + 2 < around.imag else []
        for away in (1, 8, 18, 32, 48, 68):
            out = around + half + complex(away, away)
            places += [at + complex(i.real * out.real, i.imag * out.imag) for i in SIDES]
        trouble, n = min((self._trouble(place, half) + n / 4, n) for n, place in enumerate(places))
        if trouble >= 100:
            self.left_out += 1
            return
        place, way = places[n], at - places[n]
        near = place + complex(_in(-half.real, way.real, half.real), _in(-7, way.imag, 7))
        if abs(near - at) > abs(around) + 16:
            self.line("leader", near, at)
        self.take(place, half + 8, 100)
        _add(self.node, "rect", "back", at=place - half, size=2 * half)
        if chip:
            _add(self.node, "rect", "chip", at=place - half, size=_wide(chip) + 14j)
            _add(self.node, "text", "number", chip, at=place - half + 3 + 11j)
        if text:
            _add(self.node, "text", "text", text, at=place - half + _wide(chip) + 3 + 11j)

    def _trouble(self, at: complex, half: complex) -> float:
        near, far = at - half - self.top, self.top + self.size - at - half
        out = min(near.real, near.imag, far.real, far.imag) < 0
        return 1000 * out + sum(self.taken[cell] for cell in _cells(at, half))

    def walk(self, points: list[complex], ways: list[Way], names: list[Name], head: float) -> None:
        """The tool's path through points; they get the lines that first lead there, and notes."""
        steps = list(zip(points, points[1:], ways, strict=False))
        for one, other, way in sorted(steps, key=lambda step: DISCS.get(step[2].look, 0)):
            if abs(other - one) < 0.3:
                self.mark(way.look, other)
            else:
                self.line(way.look, one, other, head)
        self.mark("start", points[0])
        for name in names:
            self.label(*name)
        stops: dict[complex, list[Way]] = {}
        for _, at, way in steps:
            stops.setdefault(complex(round(at.real), round(at.imag)), []).append(way)
        for at, found in stops.items():
            lines = " ".join(str(way.line) for way in found if way.line)
            notes = "".join(dict.fromkeys(way.note for way in found))
            if lines or notes:
                self.label(at, 7 + 7j, _short(notes, 24), _short(lines, 16))
        if self.left_out:
            text, at = f"{self.left_out} labels found no room", self.top + self.size + 42j
            _add(self.node, "text", "faint", text, at=at, text_anchor="end")


def _add(
    parent: Element, tag: str, look: str = "", text: str = "", **values: str | complex
) -> Element:
    """A new element of these classes, drawn as `LOOKS` says."""
    style = ";".join(LOOKS[word] for word in look.split() if word in LOOKS)
    drawn = {"class": look, "style": style}
    node = SubElement(parent, tag, {name: value for name, value in drawn.items() if value})
    node.text = text or None
    for name, value in values.items():
        if name in PARTS:
            one, other = PARTS[name].split()
            node.attrib |= {one: _n(complex(value).real), other: _n(complex(value).imag)}
        else:
            node.set(name.replace("_", "-"), value if isinstance(value, str) else _n(value.real))
    return node


def _n(value: float) -> str:
    return f"{round(value, 2) + 0.0:g}"


def _in(low: float, value: float, high: float) -> float:
    return max(low, min(value, high))


def _short(text: str, most: int) -> str:
    """The text on one line, without control characters, cut to so many letters."""
    line = "".join(c for c in " ".join(text.split()) if unicodedata.category(c)[0] != "C")
    return line if len(line) <= most else line[: most - 1] + "…"


def _wide(text: str) -> float:
    """About how wide a label is (pixels), its margins included; 0 without text."""
    narrow, broad = sum(map(text.count, "ijltfr.,:;'|()[] ↑↓")), sum(c > "\u2e80" for c in text)
    return 6.2 * len(text) - 2.9 * narrow + 5 * broad + 6 if text else 0.0


def _cells(at: complex, half: complex) -> list[complex]:
    first, last = (at - half) / CELL, (at + half) / CELL
    rows = range(math.floor(first.imag), math.floor(last.imag) + 1)
    columns = range(math.floor(first.real), math.floor(last.real) + 1)
    return [complex(column, row) for column in columns for row in rows]


def _ticks(low: float, high: float) -> list[float]:
    """Round numbers between two, at most nine or so."""
    power = 10.0 ** math.floor(math.log10((high - low) / 8))
    step = next(power * nice for nice in (1, 2, 5, 10) if power * nice >= (high - low) / 8)
    return [step * count for count in range(math.ceil(low / step), math.floor(high / step) + 1)]

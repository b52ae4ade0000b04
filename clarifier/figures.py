"""The figure that things are to form: "in a V with its tip away from me in the left half", "in a
square with sides of 12 cm", "in a diamond at the right edge".

A program that puts the things there, or forms another figure with them, is given the one that is
said (`drawn`); what ends in none of its shape is dropped (`stated`). How figures are said otherwise
is put into these words by `figure_words`.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

from agent.messages import Quantity
from clarifier.lexicon import Lexicon
from clarifier.placed import Placed
from clarifier.spoken import Linked
from scene.relations import moved
from scene.types import Scene

FIGURES = "V|L|cross|diamond|square|triangle|circle|zigzag row"
_SAID = re.compile(
    rf"\bin an? (?P<figure>{FIGURES})\b(?P<around> around\b)?(?: with its tip (?P<tip>towards me|"
    r"away from me))?(?: with (?:sides|a radius) of (?P<size>[^,;]+? "
    r"?(?:cm|mm|centimet\w+|millimet\w+|inch\w*)))?",
    re.IGNORECASE,
)
_PART = re.compile(
    r"(?: (?:in|at|on) (?:the|my) (?:(?:far|near|top|bottom|back|front|left|right|middle|centre|"
    r"center)(?:-hand)? ?){1,2}(?:half|corner|edge|side)?(?: of the table)?)?"
)
_MIDDLE = re.compile(r"\bin the middle of the table\W*$")
_MORE = re.compile(
    r"\b(?:one|inside|filled?|it|its|round|grid|rows?|columns?|others?|rest|and|not)\b"
)
_SHAPES = {"V": "v", "L": "l", "CROSS": "cross", "ZIGZAG ROW": "zigzag", "DIAMOND": "diamond",
           "CIRCLE": "circle", "SQUARE": "4", "TRIANGLE": "3"}  # fmt: skip
_LEAST = {"v": 3, "l": 3, "cross": 5, "zigzag": 3, "diamond": 4, "circle": 4, "4": 4, "3": 3}
OFF = 0.06
"""What is no farther from its place in a figure stands there (table units)."""
STRETCHED = 2.0
"""A figure is no more than so much larger along one axis than along the other."""
MIDDLE = 0.4
"""Along x and y the middle of a figure in the middle of the table is no farther off."""
_VERBS = frozenset({"place", "pick", "arrange", ""})


class Figure(NamedTuple):
    """``things`` end in a shape of the prelude's ``figure_steps``, in the ``middle`` of the table;
    of a cross the ``first`` is in the middle, where that is said. ``whole``: nothing else is."""

    shape: str
    slots: tuple[str, ...]
    things: tuple[str, ...]
    first: str = ""
    middle: bool = False
    whole: bool = False


def figures(linked: Linked, binding: Mapping[str, tuple[str, ...]]) -> tuple[Figure, ...]:
    """The figure that the sentence says, for one binding of its mentions; none where it says more
    than one, or something else is to be done as well."""
    said = list(_SAID.finditer(linked.text))
    if len(said) != 1 or any(one.verb not in _VERBS for one in linked.spoken):
        return ()
    shape = _SHAPES[said[0]["figure"].upper()]
    if shape == "v" and (said[0]["tip"] or "").lower() == "away from me":
        shape = "v far"
    rest = _rest(linked, said[0])
    if _MORE.search(rest):
        return ()
    made = [one for one in linked.spoken if one.mention.end <= said[0].start()]
    middle = linked.spoken[len(made) :]
    around = said[0]["around"] is not None
    if not made or len(middle) != around or (len(made) > 1 and (around or shape != "zigzag")):
        return ()
    slots = tuple(one.mention.slot for one in (*middle, *made))
    things = tuple(o for slot in slots for o in binding.get(slot, ()))
    first = things[0] if around and things else ""
    if around and shape != "cross":
        return ()
    if shape == "cross" and len(things) == 4:
        shape = "diamond"  # the four ends of it
    whole = re.fullmatch(rf"(?:put|make)?{_PART.pattern}\W*", rest) is not None
    return (Figure(shape, slots, things, first, _MIDDLE.search(linked.text) is not None, whole),)


def _rest(linked: Linked, said: re.Match[str]) -> str:
    """What is said beside the figure and what it is made of."""
    inside = {at for one in linked.spoken for at in range(one.opened, one.last)}
    made = [one for one in linked.spoken if one.mention.end <= said.start()]
    inside |= set(range(made[0].opened, made[-1].last)) if made else set()
    words = [
        token.text for at, token in enumerate(linked.tokens)
        if at not in inside and not said.start() <= token.start < said.end()
    ]  # fmt: skip
    return re.sub(r"^(put|make)\b", r"\1", " ".join(words))


_FORMED = re.compile(
    r"put_each\((?P<things>.+), (?P<figure>in_\w+)\((?P=things)(?:, (?P<corners>.+))?\)\)|"
    r"put_all\((?P<all>m\d+), \"[a-z ]+\"\)|(?:row|column)\((?P<row>.+)\)|"
    r"put_in_line\((?P<line>m\d+|\[[^\]]+\]), .+\)|"
    r"put_each\((?P<edge>.+), along_edge\((?P=edge), .+\)\)"
)
_ROWS = ("row", "line", "edge")
_OWN = {"v": "in_v", "v far": "in_v", "l": "in_l", "cross": "in_cross", "diamond": "in_diamond",
        "circle": "in_shape", "4": "in_shape", "3": "in_shape"}  # fmt: skip
_SLOT = re.compile(r"\bm\d+\b")


def drawn(body: str, goals: Sequence[object]) -> str:
    """The program with the figure that the sentence says where it has another word for it or, with
    the part of the table, none: the translator knows no words for both at once."""
    said = [goal for goal in goals if isinstance(goal, Figure)]
    call = _FORMED.fullmatch(body)
    if len(said) != 1 or call is None:
        return body
    (goal,) = said
    things = next(call[part] for part in ("things", "all", *_ROWS) if call[part])
    if set(_SLOT.findall(things)) != set(goal.slots) or not _may_be(goal, call):
        return body
    part = next((one.part for one in goals if isinstance(one, Placed)), "")
    part = "middle" if goal.middle else part
    if call["figure"] and not part and goal.shape != "v far":
        return body
    if goal.first:
        things = f"[{goal.slots[0]}] + {goal.slots[1]}"
    shape = goal.shape if goal.shape.isdigit() else f'"{goal.shape}"'
    return f'put_each({things}, figure({things}, {shape}, "{part}", 0))'


def _may_be(goal: Figure, call: re.Match[str]) -> bool:
    """Whether a program forms the figure, but for where and which way round, or no other one."""
    if any(call[part] for part in _ROWS):
        return goal.shape == "zigzag"
    if call["figure"] is None:
        return True
    corners = {"4": "4", "3": "3", "circle": f"len({call['things']})"}.get(goal.shape)
    return call["figure"] == _OWN.get(goal.shape) and call["corners"] == corners


_IN_FIGURE = re.compile(r"put_each\((?P<things>.+), in_\w+\(.+\)\)")


def sized(body: str, text: str, measures: Sequence[Quantity]) -> str:
    """The program with the size of the figure that the sentence says, where it leaves it out."""
    said, call = _SAID.search(text), _IN_FIGURE.fullmatch(body)
    if said is None or said["size"] is None or call is None or [m.slot for m in measures] != ["d1"]:
        return body
    shape = _SHAPES[said["figure"].upper()]
    things = call["things"]
    part = "middle" if re.search(r"\bin the middle of the table\b", text) else ""
    name = shape if shape.isdigit() else f'"{shape}"'
    return f'put_each({things}, figure({things}, {name}, "{part}", d1))'


def in_figure(goal: Figure, after: Scene) -> bool:
    """Whether the things end in that shape, at any size."""
    items = [after.get(one) for one in goal.things]
    if any(item.x is None or item.held for item in items):
        return False
    if len(items) < _LEAST[goal.shape.split()[0]]:
        return False  # no such few make one
    spots = [item.position for item in items]
    if goal.middle and max(map(abs, _mean(spots))) > MIDDLE:
        return False
    if goal.shape == "circle":
        return _round(spots)
    first = bool(goal.first)
    listed = [x for x, _ in spots] if len(goal.slots) == len(spots) else []
    if goal.shape == "zigzag" and listed != sorted(listed):
        return False
    return any(_fits(spots, steps, first) for steps in _patterns(goal.shape, len(spots)))


def figured_wholly(
    goals: Sequence[object], linked: Linked, lexicon: Lexicon, before: Scene, after: Scene
) -> bool:
    """Whether a figure is all that a sentence says, and just that comes of it."""
    said = [goal for goal in goals if isinstance(goal, Figure)]
    shifted = {item.id for item in before if moved(item, after.get(item.id)) > 0}
    return (
        len(said) == 1
        and said[0].whole
        and shifted <= set(said[0].things)
        and in_figure(said[0], after)
    )


def _mean(spots: Sequence[tuple[float, float]]) -> tuple[float, float]:
    x, y = (sum(axis) / len(spots) for axis in zip(*spots, strict=True))
    return x, y


def _round(spots: Sequence[tuple[float, float]]) -> bool:
    """Whether the places lie evenly on a circle."""
    x, y = _mean(spots)
    far = [math.dist((x, y), spot) for spot in spots]
    ways = sorted(math.atan2(spot[1] - y, spot[0] - x) for spot in spots)
    gaps = [b - a for a, b in pairwise([*ways, ways[0] + math.tau])]
    return max(far) - min(far) < 2 * OFF and max(gaps) < 1.5 * math.tau / len(spots)


_Steps = list[tuple[float, float]]


def _patterns(shape: str, count: int) -> list[_Steps]:
    """The places of so many things in a shape, each way that it may lie."""
    if shape.isdigit() or shape == "diamond":
        return [_polygon(4 if shape == "diamond" else int(shape), shape == "diamond", count)]
    if shape == "cross":
        ways = [(-1, 0), (1, 0), (0, 1), (0, -1)]
        arms = [(ways[i % 4][0] * (i // 4 + 1), ways[i % 4][1] * (i // 4 + 1))
                for i in range(count - 1)]  # fmt: skip
        return [[(0.0, 0.0), *arms]]
    if shape == "zigzag":
        return [[(i * 0.75, (i + first) % 2) for i in range(count)] for first in (0, 1)]
    if shape == "l":
        high = count // 2
        return [[(max(i - high, 0), max(high - i, 0)) for i in range(count)]]
    arms = [((i + 1) // 2 * (1 - i % 2 * 2), (i + 1) // 2) for i in range(count)]
    up = -1.0 if shape == "v far" else 1.0
    return [[(float(x), y * up) for x, y in arms]]


def _polygon(corners: int, tipped: bool, count: int) -> _Steps:
    """Places along the sides of a polygon, at its corners first (the prelude's ``in_turns``)."""
    start = math.pi / 4 if corners == 4 and not tipped else math.pi / 2
    tips = [(math.cos(start + side * math.tau / corners), math.sin(start + side * math.tau /
            corners)) for side in range(corners)]  # fmt: skip
    places: _Steps = []
    for side in range(corners):
        share = (side + 1) * count // corners - side * count // corners
        (x, y), (end_x, end_y) = tips[side], tips[(side + 1) % corners]
        places += [(x + (end_x - x) * i / share, y + (end_y - y) * i / share) for i in range(share)]
    return places


def _fits(spots: Sequence[tuple[float, float]], steps: _Steps, first: bool) -> bool:
    """Whether places lie as steps do, moved and stretched along either axis, and the ``first`` as
    the first does."""
    ends, scales = list[list[float]](), list[float]()
    for axis in (0, 1):
        have, want = ([one[axis] for one in many] for many in (spots, steps))
        wide = max(want) - min(want)
        scale = (max(have) - min(have)) / wide
        scales.append(scale)
        ends.append([min(have) + (one - min(want)) * scale for one in want])
    if min(scales) * STRETCHED < max(scales):
        return False
    left = list(spots)
    for spot in zip(*ends, strict=True):
        led = first and len(left) == len(spots)
        near = spots[0] if led else min(left, key=lambda one: math.dist(one, spot))
        if math.dist(near, spot) > OFF:
            return False
        left.remove(near)
    return True

"""The order in which a sentence says that things are to end: by size, by name, as they are listed.

"Smallest at the front", "from left to right: red, green, blue", "the blue one at the bottom and the
red one on top" become pairs of things, the first of which ends before the second along an axis.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import pairwise, product
from typing import Literal, NamedTuple

from clarifier.spoken import Linked, Spoken
from scene.types import Scene, SceneObject

Axis = Literal["x", "y", "z"]
APART = 0.02
"""Coordinates that differ by less are the same (table units)."""
_ALIKE = 0.01
"""Sizes that differ by less are the same (table units, or their product)."""


class Before(NamedTuple):
    """``first`` ends at a lower coordinate than ``second``."""

    first: str
    second: str
    axis: Axis


_ENDS: Mapping[str, tuple[Axis, int]] = {
    "left": ("x", 0), "right": ("x", 2), "front": ("y", 0), "near": ("y", 0), "me": ("y", 0),
    "back": ("y", 2), "far": ("y", 2), "bottom": ("y", 0), "top": ("y", 2),
    "middle": ("y", 1), "centre": ("y", 1), "center": ("y", 1),
}  # fmt: skip
_UPRIGHT = re.compile(r"\b(?:stack|pile|tower|one another|each other|pyramid)\w*\b")
_ORDERING = re.compile(
    r"\b(?:stack|pile|tower|pyramid|line|row|column|order|sort|arrang|rearrang|align|queue|rank|"
    r"organi[sz]|sequence|read|set out|lay out|from (?:left|right|front|back)|left to right|"
    r"right to left)\w*\b"
)
_END = (
    r"(?:ones? |of (?:them|all) )?(?:(?:is|are|goes|being|comes|stands?) )?"
    r"(?:(?:at|on|in|to|nearest|closest|most near|near|towards)(?: to)? )?"
    r"(?:the |my )?(?:very )?(?:far )?"
    r"(?P<end>left|right|front|back|top|bottom|me)\b(?! (?:to|of)\b)"
)
_GREAT = {
    "biggest": "size", "largest": "size", "tallest": "tall", "highest": "tall", "widest": "wide",
    "broadest": "wide", "thickest": "wide", "longest": "long",
}  # fmt: skip
_SLIGHT = {
    "smallest": "size", "littlest": "size", "tiniest": "size", "shortest": "tall",
    "lowest": "tall", "narrowest": "wide", "thinnest": "wide",
}  # fmt: skip
_SIZES = "|".join((*_GREAT, *_SLIGHT))
_AT_END = re.compile(rf"\b(?P<size>{_SIZES}) {_END}")
_FROM_TO = re.compile(
    rf"\b(?P<size>{_SIZES}|small|big|large|short|tall|low|high) (?:ones? )?"
    r"(?:to|until|till|through to|up to|down to) (?:the )?"
    rf"(?:{_SIZES}|small|big|large|short|tall|low|high)\b"
)
_FIRST = re.compile(rf"\b(?P<size>{_SIZES}) (?:ones? )?(?:comes? |goes )?first\b")
_GROWING = re.compile(
    r"\b(?P<way>increasing|ascending|rising|growing|descending|decreasing|falling)"
    r"(?: (?:order|sequence))?(?: (?:of|by|in))?(?: their)? (?P<of>size|height|width|length)\b"
)
_PEAK = re.compile(
    rf"\b(?P<size>{_SIZES})(?: one)?(?: of (?:them|the \w+))? "
    r"(?:(?:be|is|goes?|being|stands?|comes?) )?(?:at|on|in|to) (?:its|the|their) (?:very )?"
    r"(?P<end>far|near|left|right|front|back|top|bottom)(?:[ -]hand)? "
    r"(?:point|tip|corner|end|vertex)\b"
)
_PLAIN = {"small": "smallest", "short": "shortest", "low": "lowest", "big": "biggest",
          "large": "largest", "tall": "tallest", "high": "highest"}  # fmt: skip
_ALONG = re.compile(
    r"\b(?:from )?(?:the )?(?P<a>left|right|front|back|near|far|bottom|top)(?: (?:side|edge|end))?"
    r" to (?:the )?(?P<b>left|right|front|back|near|far|bottom|top)\b"
)
_RISING = re.compile(r"\bfrom (?:the )?(?P<way>bottom up|top down)\b")
_ALPHABET = re.compile(r"\b(?:alphabetic\w*|alphabet)\b")
_MEASURES: Mapping[str, Callable[[SceneObject], float]] = {
    "size": lambda one: one.width * one.height * one.tall,
    "tall": lambda one: one.tall,
    "wide": lambda one: one.width,
    "long": lambda one: max(one.width, one.height),
}
_NOUNS = {"size": "size", "height": "tall", "width": "wide", "length": "long"}
LISTING = frozenset({",", "and", "then", ";", "&", "finally", "next", "followed", "by", "lastly"})
_MOVED = frozenset({"arrange", "place", "pick", ""})
"""Classes of verbs by which things are put in an order; "touch them from left to right" is not."""


def sequence(
    linked: Linked, binding: Mapping[str, tuple[str, ...]], scene: Scene
) -> tuple[Before, ...]:
    """The pairs whose order the sentence says, for one binding of its mentions."""
    text = _text(linked)
    peak = _PEAK.search(text)
    if not _ORDERING.search(text) and peak is None:
        return ()
    themes = [one for one in linked.spoken if one.verb in _MOVED and _is_ordered(one, linked)]
    things = tuple(dict.fromkeys(o for one in themes for o in binding.get(one.mention.slot, ())))
    if len(things) < 2 or any(scene.get(o).x is None for o in things):
        return ()
    if peak is not None:
        return _at_peak(peak, text, things, scene)
    measured = _by_measure(text, things, scene)
    if measured or any(said.search(text) for said in (_AT_END, _FROM_TO, _FIRST, _GROWING)):
        return measured
    if _ALPHABET.search(text):
        names = {scene.get(o).name.lower() for o in things}
        keys = {o: sorted(names).index(scene.get(o).name.lower()) for o in things}
        return tuple(_pairs(things, keys, *(_along(text) or ("x", False))))
    return _as_ranked(themes, linked, binding) or _as_listed(themes, linked, binding, text)


def _is_ordered(one: Spoken, linked: Linked) -> bool:
    """What a verb acts on, and "a row with the red one on the left"."""
    return one.theme or (one.relation == "goal" and rank_of(one, linked) is not None)


def in_sequence(goal: Before, after: Scene) -> bool:
    """Whether a pair ends in its order."""
    one, other = after.get(goal.first), after.get(goal.second)
    if one.x is None or other.x is None:
        return False
    (x, y), (far_x, far_y) = one.position, other.position
    ahead = {"x": far_x - x, "y": far_y - y, "z": other.z - one.z}
    return ahead[goal.axis] > APART


def _pairs(
    things: Sequence[str], keys: Mapping[str, float], axis: Axis, falls: bool
) -> Iterator[Before]:
    """Each thing with each of the next greater key; ``falls``: the greatest comes lowest."""
    groups: list[list[str]] = []
    for thing in sorted(things, key=lambda o: keys[o], reverse=falls):
        if groups and abs(keys[groups[-1][0]] - keys[thing]) < _ALIKE * max(1e-9, abs(keys[thing])):
            groups[-1].append(thing)
        else:
            groups.append([thing])
    for lower, upper in pairwise(groups):
        yield from (Before(a, b, axis) for a, b in product(lower, upper))


# --- by a measure ------------------------------------------------------------


def _by_measure(text: str, things: Sequence[str], scene: Scene) -> tuple[Before, ...]:
    """ "smallest at the front", "shortest to tallest, left to right", "the biggest first"."""
    said = {(_kind(m["size"]), *_place(m["end"], text), _is_great(m["size"]))
            for m in _AT_END.finditer(text)}  # fmt: skip
    ways = {(kind, axis, great == (end == 0)) for kind, axis, end, great in said}
    along = _along(text)
    if along is not None:
        axis, back = along
        for found in (*_FROM_TO.finditer(text), *_FIRST.finditer(text)):
            ways.add((_kind(found["size"]), axis, _is_great(found["size"]) != back))
        for found in _GROWING.finditer(text):
            falls = found["way"] in ("descending", "decreasing", "falling")
            ways.add((_NOUNS[found["of"]], axis, falls != back))
    if len(ways) != 1:
        return ()
    ((kind, axis, falls),) = ways
    keys = {o: _MEASURES[kind](scene.get(o)) for o in things}
    return tuple(_pairs(things, keys, axis, falls))


def _at_peak(
    said: re.Match[str], text: str, things: Sequence[str], scene: Scene
) -> tuple[Before, ...]:
    """ "A diamond, the tallest at its far point": beyond all the others there."""
    measure = _MEASURES[_kind(said["size"])]
    order = sorted(things, key=lambda o: measure(scene.get(o)))
    *others, one = order if _is_great(said["size"]) else reversed(order)
    axis, rank = _place(said["end"], text)
    return tuple(Before(o, one, axis) if rank else Before(one, o, axis) for o in others)


def _kind(size: str) -> str:
    word = _PLAIN.get(size, size)
    return _GREAT.get(word) or _SLIGHT[word]


def _is_great(size: str) -> bool:
    return _PLAIN.get(size, size) in _GREAT


def _place(end: str, text: str) -> tuple[Axis, int]:
    """The axis of an end and where on it: 0 at its lower end; a tower stands upright."""
    axis, rank = _ENDS[end]
    return ("z" if end in ("top", "bottom", "middle") and _UPRIGHT.search(text) else axis), rank


def _along(text: str) -> tuple[Axis, bool] | None:
    """The axis of "left to right", and whether it is followed downwards ("right to left")."""
    found = _ALONG.search(text)
    if found is None:
        rising = _RISING.search(text) if _UPRIGHT.search(text) else None
        return None if rising is None else ("z", rising["way"] == "top down")
    (axis, first), (other, last) = _place(found["a"], text), _place(found["b"], text)
    return (axis, first > last) if axis == other and first != last else None


# --- as they are named ------------------------------------------------------------


def _as_listed(
    themes: Sequence[Spoken], linked: Linked, binding: Mapping[str, tuple[str, ...]], text: str
) -> tuple[Before, ...]:
    """ "red, green and blue from left to right": things that are listed, one behind another."""
    along = _along(text)
    named = [one for one in themes if not one.mention.plural]
    if along is None or len(named) < 2:
        return ()
    for one, other in pairwise(named):
        between = {token.text for token in linked.tokens[one.last : other.opened]}
        if not between or not between <= LISTING:
            return ()
    order = [binding[one.mention.slot][0] for one in named if binding.get(one.mention.slot)]
    axis, back = along
    if len(set(order)) < len(named):
        return ()
    return tuple(Before(a, b, axis) for a, b in pairwise(reversed(order) if back else order))


_RANKED = re.compile(
    r"^(?:one )?(?:(?:is|goes|comes|being|should be|to be|should go|must be) )?"
    r"(?:(?:at|on|in|to)(?: the)?(?: very)?|(?:nearest|closest|next)(?: to)?(?= me\b)) "
    r"(?P<end>bottom|middle|centre|center|top|left|right|front|back|me)\b(?! of\b)"
)


def _as_ranked(
    themes: Sequence[Spoken], linked: Linked, binding: Mapping[str, tuple[str, ...]]
) -> tuple[Before, ...]:
    """ "the blue one at the bottom, the red one in the middle and the green one on top"."""
    ranks: dict[str, tuple[Axis, int]] = {}
    for one in themes:
        rank = rank_of(one, linked)
        if rank is not None and not one.mention.plural and binding.get(one.mention.slot):
            ranks[binding[one.mention.slot][0]] = rank
    axes = {axis for axis, rank in ranks.values() if rank != 1}
    if len(ranks) == 1 and axes == {"z"}:
        ((one_end, (_, height)),) = ranks.items()
        others = [o for one in themes for o in binding.get(one.mention.slot, ()) if o not in ranks]
        ends = [(one_end, o) if height == 0 else (o, one_end) for o in dict.fromkeys(others)]
        return tuple(Before(lower, upper, "z") for lower, upper in ends)
    if len(ranks) < 2 or len(axes) != 1:
        return ()
    order = sorted(ranks, key=lambda o: ranks[o][1])
    (axis,) = axes
    return tuple(Before(a, b, axis) for a, b in pairwise(order) if ranks[a][1] < ranks[b][1])


def rank_of(one: Spoken, linked: Linked) -> tuple[Axis, int] | None:
    """The axis and the place on it (0, 1 or 2, in the middle) that is said behind a mention."""
    first = one.phrase.last if one.phrase is not None else one.last
    said = _RANKED.match(" ".join(token.text for token in linked.tokens[first:]))
    return None if said is None else _place(said["end"], _text(linked))


def upright(linked: Linked) -> bool:
    """Whether the sentence speaks of a tower."""
    return _UPRIGHT.search(_text(linked)) is not None


def _text(linked: Linked) -> str:
    return " ".join(token.text for token in linked.tokens)

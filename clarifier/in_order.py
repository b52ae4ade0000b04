"""Things of a kind told in an order, by what tells them apart: "the jars in a row, red blue green
from the left", "tower! red at the bottom, then blue, green on top". Put as which goes where: "put
the red jar, the blue jar and the green jar in a row from left to right", "put the blue block on the
red block and then ...".

Only where every word is one of them, a place in the order, the form, its gaps, or talk.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from agent.messages import Focus
from clarifier.ask import labels
from clarifier.lexicon import Lexicon
from clarifier.mentions import link
from clarifier.spoken import Linked, Spoken, settles
from clarifier.words import listing
from scene.types import Scene

_TOWER = re.compile(r"\b(?:stack\w*|tower|pile|heap|sandwich)\b")
_ROW = re.compile(r"\b(?:row|line|lined up|line up|side by side)\b")
_COLUMN = re.compile(
    r"\b(?:column|file|one behind (?:the other|another)|front to back|back to front)\b"
)
_BOTTOM = frozenset({"bottom", "base", "underneath", "lowest", "foundation", "floor"})
_TOP = frozenset({"top", "last", "crown", "crowning", "uppermost", "crowns", "tops"})
_UPON = frozenset({"on", "upon", "onto", "over", "above", "atop"})
_PLACES = _BOTTOM | _TOP | _UPON
_PLACES |= frozenset(
    {"!", ",", ".", ":", ";", "a", "after", "all", "and", "as", "at", "being", "both", "by"}
    | {"comes", "down", "finally", "first", "followed", "go", "goes", "in", "is", "it"}
    | {"lastly", "lies", "middle", "next", "of", "one", "place", "put", "right", "second"}
    | {"stands", "straight", "that", "the", "them", "then", "third", "this", "those", "tippy"}
    | {"to", "up", "very", "with"}
)  # fmt: skip
_LEFT = frozenset({"left", "leftmost"})
_RIGHT = frozenset({"right", "rightmost"})
_NEAR = frozenset({"front", "nearest", "closest", "foremost", "near"})
_FAR = frozenset({"back", "farthest", "furthest", "far", "behind", "rear"})
_SIDES = _LEFT | _RIGHT | _NEAR | _FAR
_SIDES |= frozenset(
    {"center", "centre", "me", "from", "end", "edge", "side", "hand"}
)  # fmt: skip
_EVEN = re.compile(r"\b(?:even(?:ly)?|equal(?:ly)?|uniform(?:ly)?|same|regular(?:ly)?)\b")
_GAP = re.compile(
    r"\b(?P<far>(?:\d+(?:[.,]\d+)?|\w+)(?: |-)?(?:mm|millimet\w+|cm|centimet\w+|inch\w*))(?: "
    r"minimum| at least)?"
    r"(?=\W|$)"
)
_SPACED = frozenset(
    {"allowing", "apart", "between", "breathing", "distance", "each", "equal", "equally"}
    | {"even", "evenly", "gap", "gaps", "intervals", "keep", "keeping", "least", "leaving"}
    | {"minimum", "neighbors", "neighbours", "order", "pitch", "regular", "room", "same"}
    | {"space", "spaced", "spaces", "spacing", "them", "uniform", "uniformly"}
)  # fmt: skip
_FORMING = frozenset(
    {"another", "arrange", "back", "behind", "big", "build", "by", "column", "do", "file"}
    | {"form", "from", "front", "get", "have", "heap", "i", "into", "just", "lay", "left"}
    | {"like", "line", "lined", "little", "long", "make", "might", "neat", "need", "nice"}
    | {"one", "only", "order", "other", "pile", "right", "row", "sandwich", "set", "should"}
    | {"side", "single", "so", "sort", "stack", "stacked", "stacking", "stand", "straight"}
    | {"tidy", "tower", "want", "would"}
)  # fmt: skip
_TALK = frozenset({"?", "that's", "you", "know", "please", "mind", "yes", "um", "uh"})
_NUMBERS = {2: "two", 3: "three", 4: "four", 5: "five", 6: "six"}
_LEAST = 2
_HEADING = 5
"""Most tokens of what stands before the list, with a mark behind it: "Shape sandwich time!"."""


class _Item(NamedTuple):
    """One of the things, and the tokens ``first:last`` that name it."""

    object: str
    first: int
    last: int


def told_in_order(text: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> str:
    """The sentence with the order of things in a tower, a row or a column told by which goes where;
    as it was where it says anything else."""
    linked = link(text, scene, focus, lexicon)
    said = linked.text.lower()
    tower, column, row = (form.search(said) for form in (_TOWER, _COLUMN, _ROW))
    if tower is None and column is None and row is None:
        return text
    items = list(_items(linked, scene))
    things = list(dict.fromkeys(one.object for one in items))
    if len(things) < _LEAST or _says_more(items, linked, lexicon, tower is not None):
        return text
    names = labels(things, scene, lexicon)
    if tower is not None:
        order = _upwards(items, linked)
        return text if order is None else _stacked([names[o] for o in order])
    group = next((set(one.mention.objects) for one in linked.spoken if one.mention.plural), set())
    if len(things) < 3 or not group >= set(things):
        return text  # "line up the cup, the jar and the box" is plain
    deep = column is not None
    order = _along(items, linked, deep)
    if order is None:
        return text
    gap, even = _GAP.search(said), _EVEN.search(said)
    apart = f" with {gap['far']} between them" if gap else " with equal gaps" if even else ""
    form = "a column from front to back" if deep else "a row from left to right"
    return f"put {listing(names[o] for o in order)} in {form}{apart}"


def _items(linked: Linked, scene: Scene) -> Iterator[_Item]:
    """The single things of the sentence, bare words that tell one of its group apart included."""
    group = next((one for one in linked.spoken if one.mention.plural), None)
    pool = [scene.get(o) for o in group.mention.objects] if group is not None else []
    inside: dict[int, Spoken] = {one.opened: one for one in linked.spoken if one is not group}
    taken = range(group.opened, group.last) if group is not None else range(0)
    at = 0
    while at < len(linked.tokens):
        one = inside.get(at)
        if one is not None and one.last > at:
            if settles(one.mention) and one.phrase is not None:
                yield _Item(one.mention.objects[0], at, one.last)
            at = one.last
            continue
        word = linked.tokens[at].text
        fitting = [i.id for i in pool if word == i.color or word in i.name.lower().split()]
        if at not in taken and len(fitting) == 1 and len(pool) > 1:
            yield _Item(fitting[0], at, at + 1)
        at += 1


def _says_more(items: Sequence[_Item], linked: Linked, lexicon: Lexicon, tower: bool) -> bool:
    """Whether a word is none of those by which an order, a form or talk is told."""
    group = {i for one in linked.spoken if one.mention.plural for i in range(one.opened, one.last)}
    inside = {i for item in items for i in range(item.first, item.last)} | group
    known = _PLACES | _FORMING | _TALK | lexicon.words("polite")
    known |= {_NUMBERS.get(len({item.object for item in items}), "")}
    known |= set() if tower else _SIDES | _SPACED
    opens = _heading(items, linked)
    measured = {i for c in linked.chunks if c.kind == "measure" for i in range(c.first, c.last)}
    return any(
        token.text not in known
        for i, token in enumerate(linked.tokens)
        if i >= opens and i not in inside and not (i in measured and not tower)
    )


def _heading(items: Sequence[_Item], linked: Linked) -> int:
    """The tokens of a heading, 0 where there is none: "Shape sandwich time! Square on ..."."""
    marks = [i for i, token in enumerate(linked.tokens[:_HEADING]) if token.text in "!:"]
    ends = marks[0] + 1 if marks else 0
    told = any(one.opened < ends for one in linked.spoken)
    bids = any(c.first < ends and c.kind == "verb" and c.value != "arrange" for c in linked.chunks)
    return 0 if told or bids or items[0].first < ends else ends


def _tags(items: Sequence[_Item], linked: Linked) -> list[set[str]]:
    """The words of each item and behind it, to the next one."""
    ends = [*(item.first for item in items[1:]), len(linked.tokens)]
    return [
        {token.text for token in linked.tokens[item.first : end]}
        for item, end in zip(items, ends, strict=True)
    ]


def _upwards(items: Sequence[_Item], linked: Linked) -> list[str] | None:
    """The things from the lowest to the highest; None where the sentence does not tell."""
    tags = _tags(items, linked)
    ahead = {token.text for token in linked.tokens[max(0, items[0].first - 3) : items[0].first]}
    order: list[str] = []
    for number, item in enumerate(items):
        led = number and linked.tokens[item.first - 1].text in _UPON
        if item.object in order:
            if not led or order[-2:-1] != [item.object]:
                return None  # upon another one than the last
            continue
        order.append(item.object)
    low = [n for n, tag in enumerate(tags) if tag & _BOTTOM]
    high = [n for n, tag in enumerate(tags) if tag & (_TOP - {"last"}) or "crown" in tag]
    if low == [0] or (not low and ahead & {"bottom", "base", "underneath", "first"}):
        return order
    last = len(items) - 1
    if low == [last] and (high == [0] or not high):
        return order[::-1]
    upon = any(linked.tokens[item.first - 1].text in _UPON for item in items[1:])
    return order if not low and high == [last] and not upon else None


def _stacked(names: Sequence[str]) -> str:
    steps = [f"{upper} on {lower}" for lower, upper in pairwise(names)]
    return "put " + " and then ".join(steps)


def _along(items: Sequence[_Item], linked: Linked, deep: bool) -> list[str] | None:
    """The things from the left, or from the near end; None where the sentence does not tell."""
    order = [item.object for item in items]
    if len(set(order)) < len(order):
        return None
    tags = _tags(items, linked)
    begin, end = (_NEAR, _FAR) if deep else (_LEFT, _RIGHT)
    said = [token.text for token in linked.tokens]
    ways = [" ".join(said)]
    forth = re.search(r"front to back|near to far|from (?:the )?(?:front|near)" if deep
                      else r"left to right|from (?:the )?left", ways[0])  # fmt: skip
    back = re.search(r"back to front|far to near|from (?:the )?(?:back|far)" if deep
                     else r"right to left|from (?:the )?right", ways[0])  # fmt: skip
    if forth and back:
        return None
    if forth or back:
        return order if forth else order[::-1]
    first, last = tags[0] | _led(items[0], linked), tags[-1]
    if first & begin and not first & end and not last & begin:
        return order
    if first & end and not first & begin and not last & end:
        return order[::-1]
    return None if deep or any(tag & (begin | end) for tag in tags) else order


def _led(item: _Item, linked: Linked) -> set[str]:
    """The words right before an item: "on the left the red one"."""
    return {token.text for token in linked.tokens[max(0, item.first - 3) : item.first]}

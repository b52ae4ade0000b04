"""The empty place in a row: "the four coins form a row with one gap; put the bronze coin in there".

Where one gap between neighbours is clearly the widest, it is named by the two beside it.
"""

from __future__ import annotations

import re
from itertools import pairwise

from clarifier.ranks import LINE
from clarifier.spoken import Spoken
from scene.types import Scene

CLEARLY = 1.5
"""A gap that is so many times as wide as the next is the one that is meant."""
_EMPTY = re.compile(
    r"\b(?:gap|hole|(?:empty|free|open|missing|vacant) (?:place|spot|space|slot|position)|"
    r"(?:place|spot|space|slot) (?:empty|free|open|missing))\b",
    re.IGNORECASE,
)
_THERE = re.compile(
    r"\b(?:in|into|to|on|onto|at) (?:that|the|this) (?:(?:empty|free|open|missing|vacant) )?"
    r"(?:place|spot|gap|hole|space|slot|position)"
    r"(?: (?:in|of|between) (?:it|them|the row|the line))?"
    r"(?=\s*(?:[.,;!]|$))",
    re.IGNORECASE,
)


def in_the_gap(told: str, deed: str, groups: tuple[Spoken, ...], scene: Scene) -> str | None:
    """The deed with "in that place" named by what stands beside it; None where none is told of."""
    there = _THERE.search(deed)
    if (
        there is None
        or _EMPTY.search(told) is None
        or len({g.mention.objects for g in groups}) != 1
    ):
        return None
    beside = _beside_the_gap(groups[0].mention.objects, scene)
    if beside is None:
        return None
    return (
        f"{deed[: there.start()]}between the {beside[0]} and the {beside[1]}{deed[there.end() :]}"
    )


def _beside_the_gap(members: tuple[str, ...], scene: Scene) -> tuple[str, str] | None:
    """The neighbours in a line between which the widest gap is, if it clearly is the widest."""
    items = [scene.get(one) for one in members]
    if len(items) < 3 or any(item.x is None for item in items):
        return None
    spreads = [max(each) - min(each) for each in zip(*(i.position for i in items), strict=True)]
    axis = 0 if spreads[0] >= spreads[1] else 1
    if spreads[axis] < LINE * spreads[1 - axis]:
        return None
    order = sorted(items, key=lambda item: item.position[axis])
    steps = sorted(
        ((b.position[axis] - a.position[axis], a.id, b.id) for a, b in pairwise(order)),
        reverse=True,
    )
    (wide, one, other), (second, _, _) = steps[:2]
    return (one, other) if wide >= CLEARLY * second else None

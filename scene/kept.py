"""What is known of the things in pictures, from one picture to the next, and what of it is seen.

What rests is known by its borders (`scene.rest`), whatever the detector makes of it meanwhile: with
something in it, or the arm before a part of it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from typing import NamedTuple

from scene.rest import Borders, gone
from scene.sight import Detection, Picture

STILL = 0.01
"""What is said to be no further away than this has not moved (table units)."""
RESTS = 0.004
"""Borders that have gone no further rest (table units; 0.8 mm)."""
SAME, SIZED = 0.4, 0.7
"""What is found so near to what rests (share of its side), and nearly as large (log of the area),
is that thing, however it looks now."""
WIDTH = 0.2
"""Footprints whose sides differ by less (logs) are the same."""


class Kept(NamedTuple):
    """What is known of a thing: what the detector said when it was looked at last, what came of
    that, and in which picture (0: no closer look yet). Its borders as it rests, the number of that
    (0: not taken yet), whether they are seen in this picture, and for how many they were not."""

    said: Detection
    made: Detection
    looked: int = 0
    borders: Borders | None = None
    stand: int = 0
    rests: bool = False
    changed: int = 0


Way = tuple[float, float]
"""From what is found to what is known: the shortest goes first."""
Apart = Callable[[Detection, Kept], Way | None]
"""The way from what is found to what is known; None where it is not that."""


def seen_again(one: Kept, picture: Picture) -> Kept:
    """With whether its borders are where they were."""
    edges = one.borders
    way = None if edges is None else gone(edges, picture.pixels)
    rests = edges is not None and way is not None and math.hypot(*way) * edges.pixel < RESTS
    return one._replace(rests=rests, changed=0 if rests else one.changed + 1)


def known_of(
    found: Sequence[Detection], kept: Sequence[Kept], apart: Apart | None = None
) -> list[Kept | None]:
    """For each thing found what was known of it, each known thing once: by default of what rests
    there or was said to be there."""
    way = apart or _found_there
    pairs = paired(
        (cost, n, k)
        for n, one in enumerate(found)
        for k, old in enumerate(kept)
        if (cost := way(one, old)) is not None
    )
    return [kept[pairs[n]] if n in pairs else None for n in range(len(found))]


def paired(ways: Iterable[tuple[Way, int, int]]) -> dict[int, int]:
    """Numbers of the one kind by those of the other, each once at most, the shortest ways first."""
    pairs, taken = dict[int, int](), set[int]()
    for _, n, k in sorted(ways):
        if n not in pairs and k not in taken:
            pairs[n] = k
            taken.add(k)
    return pairs


def rests_there(one: Detection, old: Kept) -> Way | None:
    """The way to what rests (an `Apart`): what rests longest first, for what was made of it and of
    what came beside it since may seem to rest as well."""
    return (old.stand, unlike(old.made, one)) if old.rests and alike(old.made, one) else None


def _found_there(one: Detection, old: Kept) -> Way | None:
    resting = rests_there(one, old)
    return (math.inf, far(one, old.made)) if resting is None and said_of(one, old) else resting


def alike(known: Detection, one: Detection) -> bool:
    """Whether what is found is where something is known to be, and nearly as large."""
    return _sized(known, one) < SIZED and far(known, one) < SAME * (known.width + known.height) / 2


def as_wide(known: Detection, one: Detection) -> bool:
    """Whether what is found is where something is known to be, and shows the same footprint: what
    fell over shows another, and is as tall as it looks."""
    sides = zip(sorted((known.width, known.height)), sorted((one.width, one.height)), strict=True)
    return alike(known, one) and all(abs(math.log(b / a)) < WIDTH for a, b in sides)


def unlike(known: Detection, one: Detection) -> float:
    """How far what is found is from what is known, in sizes and in place (shares of its side)."""
    return _sized(known, one) + 4 * far(known, one) / (known.width + known.height)


def _sized(known: Detection, one: Detection) -> float:
    return abs(math.log(one.width * one.height / (known.width * known.height)))


def far(one: Detection, other: Detection) -> float:
    """How far it is between the places of two things (table units)."""
    return math.dist((one.x, one.y), (other.x, other.y))


def named(one: Detection, old: Kept) -> bool:
    """Whether the detector calls the thing what it called it, or it rests and may be called so now
    and otherwise in the next picture."""
    return old.rests or old.said.name == one.name


def said_of(one: Detection, old: Kept) -> bool:
    """Whether the detector says of the thing what it said before."""
    return far(one, old.said) < STILL


def told(one: Detection, known: Kept | None) -> Detection:
    """What is said now, corrected as it was before; of what rests, what is known of it."""
    if known is None:
        return one
    said, made = known.said, known.made
    stand = known.stand if known.rests and known.borders is not None else 0
    if not said_of(one, known):
        return replace(made, score=one.score, stand=stand)
    if made is said:
        return replace(one, stand=stand)
    return replace(
        one, x=one.x + made.x - said.x, y=one.y + made.y - said.y, sd=made.sd,
        width=made.width, height=made.height, tall=made.tall, r=made.r,
        color=made.color if one.color == said.color else one.color, stand=stand,
    )  # fmt: skip

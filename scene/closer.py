"""A detector whose things are looked at closer, and known again where they rest.

What rests is known by its borders (`scene.rest`), whatever the detector makes of it meanwhile: with
something in it, or the arm before a part of it. What is new or moved gets a closer look at its
outline (`scene.fit`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import compress, count
from typing import NamedTuple

from scene.fit import closer, outlines
from scene.rest import Borders, borders, gone
from scene.sight import Detection, Detector, Picture, View

STILL, FOLLOWED = 0.01, 0.1
"""What is said to be no further away than this has not moved, or is the same that waited for its
turn before (table units)."""
RESTS = 0.004
"""Borders that have gone no further rest (table units; 0.8 mm)."""
SAME, SIZED = 0.4, 0.7
"""What is found so near to what rests (share of its side), and nearly as large (log of the area),
is that thing, however it looks now."""
WIDTH = 0.2
"""Footprints whose sides differ by less (logs) are the same."""
LOOKS, EVERY = 1, 4
"""Looks in a picture where something is new or moved; in how many pictures one where all rests."""
WORSE = 1.2
"""What rests and is seen so much less exactly than before is not looked at anew."""
CHANGED, REMEMBERED, FORGOTTEN = 60, 24, 300
"""For so many pictures borders that are not seen are those of a thing that something hides; so
many things that are not found any more are remembered, and for so many pictures: each is compared
with every one."""


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


class Shot(NamedTuple):
    """A picture, how it shows the table, and what it should show of what is known."""

    picture: Picture
    view: View
    expected: Sequence[Detection]

    def looked(self, found: Sequence[Detection], n: int) -> Detection:
        """A closer look at what was found with that number: as tall as it is known to be, where
        more is known of that than a picture tells; as it is where the outline is not clear."""
        one = found[n]
        tall = min(
            (it for it in self.expected if _as_wide(it, one)), key=lambda it: _far(it, one),
            default=one,
        )  # fmt: skip
        told = replace(one, tall=tall.tall, tall_sd=tall.tall_sd)
        made = closer(self.picture, self.view, [*found[:n], told, *found[n + 1 :]], n)
        return one if made is told else made


class Closer:
    """A detector whose things are looked at closer, few in a picture: one look takes a third to one
    and a half times as long as the detector itself.

    What is new or moved comes first, who waited longest before all; it is told as the detector
    says it until its turn. Where nothing waits, what rests is looked at again in turn, one thing in
    so many pictures, and keeps meanwhile by how much the closer look differed from what the
    detector said. One picture after the other, from one thread.
    """

    def __init__(self, detector: Detector, looks: int = LOOKS, every: int = EVERY) -> None:
        self._detector = detector
        self._looks, self._every = looks, every
        self._pictures = self._last = 0
        self._kept: list[Kept] = []
        self._waiting: list[Detection] = []
        self._stands = count(1)

    def detect(
        self, picture: Picture, view: View, expected: Sequence[Detection] = ()
    ) -> tuple[Detection, ...]:
        """See `scene.sight.Detector`. What is expected and not found is looked for."""
        self._pictures += 1
        kept = [_seen_again(one, picture) for one in self._kept]
        found = list(self._detector.detect(picture, view))
        before = _before(found, kept)
        seen = [_now(one, old) for one, old in zip(found, before, strict=True)]
        shot = Shot(picture, view, expected)
        missed = self._missed(shot, seen, kept)
        there = [*_there(expected, seen), *(one.made for one in missed)]
        apart = [not _of_several(one, there) for one in seen]
        found, before = list(compress(found, apart)), list(compress(before, apart))
        seen = [*compress(seen, apart), *(one.made for one in missed)]
        turns = self._turns(found, before)
        known = [
            # what is known of the others tells better than the detector where they end
            self._after(shot, [*seen[:n], one, *seen[n + 1 :]], n, before[n], n in turns)
            for n, one in enumerate(found)
        ]
        met = [*(old for old in before if old is not None), *missed]
        away = [
            one for one in kept
            if one.changed < FORGOTTEN and not any(one is old for old in met)
        ]  # fmt: skip
        self._kept = [*known, *missed, *away[:REMEMBERED]]
        return tuple(map(_now, (*found, *(one.said for one in missed)), (*known, *missed)))

    def _missed(self, shot: Shot, seen: Sequence[Detection], kept: Sequence[Kept]) -> list[Kept]:
        """What is expected and was not found: what rests there, and what a look there shows."""
        lost = [one for one in shot.expected if not any(_alike(one, it) for it in seen)]
        there = [
            next((old for old in kept if old.rests and _alike(one, old.made)), None) for one in lost
        ]
        turn = [n for n, old in enumerate(there) if old is None]
        for n in _turned(turn, self._pictures)[: self._looks]:
            one = lost[n]
            others = [*(it for it in seen if not _within(one, it)), *lost[:n], *lost[n + 1 :]]
            made = shot.looked([one, *others], 0)
            if made is not one:
                new = Kept(made, made, self._pictures)
                there[n] = self._bordered(new, shot, [made, *others], 0)
        return [one for one in there if one is not None]

    def _after(
        self, shot: Shot, found: Sequence[Detection], n: int, old: Kept | None, look: bool
    ) -> Kept:
        """What is known of a thing that was found, behind this picture."""
        one = found[n]
        known = old or Kept(one, one)
        if look:
            made = shot.looked(found, n)
            if known.rests and made.sd > WORSE * known.made.sd:  # something is before it
                said = replace(known.said, name=one.name)
                known = known._replace(said=said, looked=self._pictures)
            else:
                known = known._replace(said=one, made=made, looked=self._pictures)
        if known.rests or (known.stand and known.changed < CHANGED) or not (look or old):
            return known
        return self._bordered(known, shot, found, n)

    def _bordered(self, known: Kept, shot: Shot, found: Sequence[Detection], n: int) -> Kept:
        """With its borders as they are in this picture, under a new number."""
        others = list(outlines(found, shot.view.camera))
        own = others.pop(n)
        edges = borders(shot.picture.pixels, shot.view, own, others)
        return known._replace(borders=edges, stand=next(self._stands), rests=True, changed=0)

    def _turns(self, found: Sequence[Detection], before: Sequence[Kept | None]) -> list[int]:
        """Whose turn it is in this picture."""
        wait = [
            n for n, (one, old) in enumerate(zip(found, before, strict=True))
            if old is None or (_said(one, old) and not (old.looked and _named(one, old)))
        ]  # fmt: skip
        wait.sort(key=lambda n: _waited(found[n], self._waiting))
        self._waiting = [found[n] for n in wait[self._looks :]]
        if wait:
            self._last = self._pictures
            return wait[: self._looks]
        rest = [
            (old.looked, n) for n, (one, old) in enumerate(zip(found, before, strict=True))
            if old is not None and _said(one, old)
        ]  # fmt: skip
        if not rest or self._pictures < self._last + self._every:
            return []
        self._last = self._pictures
        return [min(rest)[1]]


def _seen_again(one: Kept, picture: Picture) -> Kept:
    """With whether its borders are where they were."""
    edges = one.borders
    way = None if edges is None else gone(edges, picture.pixels)
    rests = edges is not None and way is not None and math.hypot(*way) * edges.pixel < RESTS
    return one._replace(rests=rests, changed=0 if rests else one.changed + 1)


def _before(found: Sequence[Detection], kept: Sequence[Kept]) -> list[Kept | None]:
    """For each thing found what was known of it: of what rests there, or was said to be there."""
    pairs = sorted(
        (cost, n, k)
        for n, one in enumerate(found)
        for k, old in enumerate(kept)
        if (cost := _apart(one, old)) < math.inf
    )
    before: list[Kept | None] = [None] * len(found)
    taken = set[int]()
    for _, n, k in pairs:
        if before[n] is None and k not in taken:
            before[n] = kept[k]
            taken.add(k)
    return before


def _apart(one: Detection, old: Kept) -> float:
    """How far what is found is from what is known; infinite where it is not that."""
    if old.rests and _alike(old.made, one):
        return _far(one, old.made)
    return 1 + _far(one, old.made) if _said(one, old) else math.inf


def _alike(known: Detection, one: Detection) -> bool:
    """Whether what is found is where something is known to be, and nearly as large."""
    sized = abs(math.log(one.width * one.height / (known.width * known.height)))
    return sized < SIZED and _far(known, one) < SAME * (known.width + known.height) / 2


def _as_wide(known: Detection, one: Detection) -> bool:
    """Whether what is found is where something is known to be, and shows the same footprint: what
    fell over shows another, and is as tall as it looks."""
    sides = zip(sorted((known.width, known.height)), sorted((one.width, one.height)), strict=True)
    return _alike(known, one) and all(abs(math.log(b / a)) < WIDTH for a, b in sides)


def _within(one: Detection, other: Detection) -> bool:
    """Whether a thing stands where another one is."""
    return _far(one, other) < (other.width + other.height) / 4


def _there(expected: Sequence[Detection], seen: Sequence[Detection]) -> list[Detection]:
    """Of all that is expected what is found: as what is nearest to it."""
    pairs = ((one, [other for other in seen if _alike(one, other)]) for one in expected)
    return [min(near, key=lambda it: _far(one, it)) for one, near in pairs if near]


def _of_several(one: Detection, there: Sequence[Detection]) -> bool:
    """Whether what is found is several things taken for one: those of ``there``, which are known to
    stand on the table and are seen apart."""
    inside = [other for other in there if _within(other, one)]
    return len(inside) > 1 and all(other is not one for other in inside)


def _far(one: Detection, other: Detection) -> float:
    return math.dist((one.x, one.y), (other.x, other.y))


def _turned(numbers: Sequence[int], by: int) -> list[int]:
    """The numbers, begun elsewhere: so each has its turn."""
    start = by % len(numbers) if numbers else 0
    return [*numbers[start:], *numbers[:start]]


def _named(one: Detection, old: Kept) -> bool:
    """Whether the detector calls the thing what it called it, or it rests and may be called so now
    and otherwise in the next picture."""
    return old.rests or old.said.name == one.name


def _said(one: Detection, old: Kept) -> bool:
    """Whether the detector says of the thing what it said before."""
    return _far(one, old.said) < STILL


def _waited(one: Detection, waiting: Sequence[Detection]) -> int:
    """Its number among what waited, be it moved meanwhile; behind them all where it is new."""
    away = [_far(one, other) for other in waiting]
    least = min(away, default=math.inf)
    return away.index(least) if least < FOLLOWED else len(waiting)


def _now(one: Detection, known: Kept | None) -> Detection:
    """What is said now, corrected as it was before; of what rests, what is known of it."""
    if known is None:
        return one
    said, made = known.said, known.made
    stand = known.stand if known.rests and known.borders is not None else 0
    if not _said(one, known):
        return replace(made, score=one.score, stand=stand)
    if made is said:
        return replace(one, stand=stand)
    return replace(
        one, x=one.x + made.x - said.x, y=one.y + made.y - said.y, sd=made.sd,
        width=made.width, height=made.height, tall=made.tall, r=made.r,
        color=made.color if one.color == said.color else one.color, stand=stand,
    )  # fmt: skip

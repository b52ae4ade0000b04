"""A detector whose things are looked at closer, and known again where they rest.

What rests is known by its borders (`scene.kept`). What is new or moved gets a closer look at its
outline (`scene.fit`), when the scene of the picture is told already: such a look takes a third to
one and a half times as long as the detector itself.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import count
from typing import NamedTuple

from scene.fit import closer, outlines
from scene.found import Findings, within
from scene.kept import (
    STILL,
    Kept,
    alike,
    as_wide,
    far,
    known_of,
    named,
    rests_there,
    said_of,
    seen_again,
    told,
)
from scene.rest import borders
from scene.sight import Detection, Detector, Picture, View

FOLLOWED = 0.1
"""What is said to be no further away than this is the same that waited for its turn before (table
units)."""
LOOKS, EVERY = 1, 4
"""Looks in a picture where something is new or moved; in how many pictures one where all rests."""
LOST = 3
"""Looks in a picture for what was not found: what is not found for long is believed to be gone."""
AWAY = 0.04
"""What is so far from where it was looked for (share of its sides) is looked at once more."""
WORSE = 1.2
"""What rests and is seen so much less exactly than before is not looked at anew."""
CHANGED, REMEMBERED, FORGOTTEN = 60, 24, 300
"""For so many pictures borders that are not seen are those of a thing that something hides; so
many things that are not found any more are remembered, and for so many pictures: each is compared
with every one."""


class Shot(NamedTuple):
    """A picture, how it shows the table, and what it should show of what is known."""

    picture: Picture
    view: View
    expected: Sequence[Detection]

    def looked(self, found: Sequence[Detection], n: int) -> Detection:
        """A closer look at what was found with that number: as high as it is known to lie, as large
        as it was, as tall where more is known of that than a picture tells, and of the shape that a
        person's word for it says; as it is where the outline is not clear."""
        one = found[n]
        near = sorted((it for it in self.expected if alike(it, one)), key=lambda it: far(it, one))
        known = replace(one, base=near[0].base) if near else one
        same = next((it for it in near if as_wide(it, one)), None)
        if same is not None:
            width, height = same.width, same.height
            if (width < height) != (one.width < one.height):
                width, height = height, width
            known = replace(
                known, width=width, height=height, sides_sd=same.sides_sd, tall=same.tall,
                tall_sd=same.tall_sd, noun=same.noun,
            )  # fmt: skip
        made = closer(self.picture, self.view, [*found[:n], known, *found[n + 1 :]], n)
        return one if made is known else made

    def looked_for(self, one: Detection, others: Sequence[Detection]) -> Detection | None:
        """A closer look for what was not found. Where it is not where it was looked for, only a
        part of it was seen: so it is looked at where it is."""
        made = self.looked([one, *others], 0)
        if made is one:
            return None
        if far(made, one) < AWAY * (one.width + one.height):
            return made
        there = replace(one, x=made.x, y=made.y)
        again = self.looked([there, *others], 0)
        return made if again is there else again


class Closer:
    """A detector whose things are looked at closer, few a picture.

    What is new or moved comes first, who waited longest before all; it is told as the detector
    says it until its turn. Where nothing waits, what rests is looked at again in turn, one thing in
    so many pictures, and keeps meanwhile by how much the closer look differed from what the
    detector said. One picture after the other, from one thread.
    """

    def __init__(
        self, detector: Detector, looks: int = LOOKS, every: int = EVERY, later: bool = False
    ) -> None:
        """``later``: a picture's looks are left to `settle`, and tell with the next picture."""
        self._detector, self._later = detector, later
        self._looks, self._every = looks, every
        self._pictures = self._last = 0
        self._kept: list[Kept] = []
        self._waiting: list[Detection] = []
        self._stands = count(1)
        self._open: tuple[Shot, Findings] | None = None

    def detect(
        self, picture: Picture, view: View, expected: Sequence[Detection] = ()
    ) -> tuple[Detection, ...]:
        """See `scene.sight.Detector`. What is expected and not found is looked for."""
        self.settle()
        self._pictures += 1
        self._kept = [seen_again(one, picture) for one in self._kept]
        found = self._detector.detect(picture, view)
        shot = Shot(picture, view, expected)
        findings = Findings(found, known_of(found, self._kept)).parted(expected)
        self._forget(findings.wrong)
        if not self._later:
            return self._looked(shot, findings)
        self._open = shot, findings
        resting = self._resting(findings.lost(expected), findings)
        missed = [one for one in resting if one is not None]
        ready = findings.with_missed(missed, expected)
        return ready.told(ready.before)

    def settle(self) -> None:
        """The closer looks that the last picture asks for, if they are left to be done."""
        ready, self._open = self._open, None  # whatever comes of it, it is tried once
        if ready is not None:
            self._looked(*ready)

    def _looked(self, shot: Shot, findings: Findings) -> tuple[Detection, ...]:
        """What is told of a picture after a closer look at whose turn it is."""
        findings = findings.with_missed(self._missed(shot, findings), shot.expected)
        missed = [one.made for one in findings.missed]
        seen = list(map(told, findings.found, findings.before))
        turns = self._turns(findings.found, findings.before)
        known = [
            # what is known of the others tells better than the detector where they end
            self._after(shot, [*seen[:n], one, *seen[n + 1 :], *missed], n, findings, n in turns)
            for n, one in enumerate(findings.found)
        ]
        met = [*(old for old in findings.before if old is not None), *findings.missed]
        away = [
            one for one in self._kept
            if one.changed < FORGOTTEN and not any(one is old for old in met)
        ]  # fmt: skip
        self._kept = [*known, *findings.missed, *away[:REMEMBERED]]
        return findings.told(known)

    def _resting(self, lost: Sequence[Detection], findings: Findings) -> list[Kept | None]:
        """For each thing that was not found what is known of it, if it rests; of what was not met
        otherwise."""
        rest = [one for one in self._kept if not any(one is old for old in findings.before)]
        return known_of(lost, rest, rests_there)

    def _missed(self, shot: Shot, findings: Findings) -> list[Kept]:
        """What is expected and was not found: what rests there, and what a look there shows; what
        rests is looked at again now and then."""
        lost = findings.lost(shot.expected)
        there = self._resting(lost, findings)
        turn = _turned([n for n, old in enumerate(there) if old is None], self._pictures)[:LOST]
        again = [
            (old.looked, n) for n, old in enumerate(there)
            if old is not None and self._pictures >= old.looked + self._every
        ]  # fmt: skip
        for n in turn or [n for _, n in sorted(again)][: self._looks]:
            self._forget([there[n]])  # what comes of the look stands for it
            there[n] = self._found(shot, findings, lost, n, there[n])
        return [one for one in there if one is not None]

    def _found(
        self, shot: Shot, findings: Findings, lost: Sequence[Detection], n: int, old: Kept | None
    ) -> Kept | None:
        """What is known of a lost thing behind a closer look at where it should be."""
        one, seen = lost[n], findings.told(findings.before)
        others = [*(it for it in seen if not within(one, it)), *lost[:n], *lost[n + 1 :]]
        if one.base:  # what it lies on does not hide it
            others = [it for it in others if it.base == one.base]
        made = shot.looked_for(one, others)
        if made is None or (old is not None and made.sd > WORSE * old.made.sd):
            return None if old is None else old._replace(looked=self._pictures)
        if old is not None and far(made, old.made) < STILL:
            return old._replace(said=made, made=made, looked=self._pictures)
        new = Kept(made, made, self._pictures)
        return self._bordered(new, shot, [made, *others], 0)

    def _forget(self, wrong: Sequence[Kept | None]) -> None:
        self._kept = [one for one in self._kept if not any(one is old for old in wrong)]

    def _after(
        self, shot: Shot, found: Sequence[Detection], n: int, findings: Findings, look: bool
    ) -> Kept:
        """What is known of a thing that was found, behind this picture."""
        one, old = found[n], findings.before[n]
        known = old or Kept(one, one)
        if look:
            made = shot.looked(found, n)
            clear, same = made is not one, said_of(one, known)
            worse = made.sd > (WORSE if same else 1.0) * known.made.sd
            if known.rests and (worse or not (clear or same)):  # something is before it
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
            if old is None or (said_of(one, old) and not (old.looked and named(one, old)))
        ]  # fmt: skip
        wait.sort(key=lambda n: _waited(found[n], self._waiting))
        self._waiting = [found[n] for n in wait[self._looks :]]
        if wait:
            self._last = self._pictures
            return wait[: self._looks]
        rest = [
            (old.looked, n) for n, (one, old) in enumerate(zip(found, before, strict=True))
            if old is not None and (said_of(one, old) or old.rests)
        ]  # fmt: skip
        if not rest or self._pictures < self._last + self._every:
            return []
        self._last = self._pictures
        return [min(rest)[1]]


def _turned(numbers: Sequence[int], by: int) -> list[int]:
    """The numbers, begun elsewhere: so each has its turn."""
    start = by % len(numbers) if numbers else 0
    return [*numbers[start:], *numbers[:start]]


def _waited(one: Detection, waiting: Sequence[Detection]) -> int:
    """Its number among what waited, be it moved meanwhile; behind them all where it is new."""
    away = [far(one, other) for other in waiting]
    least = min(away, default=math.inf)
    return away.index(least) if least < FOLLOWED else len(waiting)

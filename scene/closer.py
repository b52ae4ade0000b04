"""A closer look at what the detector found: its outline in the whole picture, fitted.

The network sees the table at 2 mm a pixel and tells places, sizes and heights by what it learnt.
Where a thing's outline is clear against the table, its shape (`scene.outline`) is fitted to it by
least squares, the network's word being one more observation: what it called sure stays, what it
did not know, an unknown thing's height above all, the outline decides. Where the outline is not
clear, or fits no shape that such a thing has, the network's word stands.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from scene.contour import Contour, Room, contours
from scene.outline import BLOCK, SHAPES, UNKNOWN, Body, Eye, Floats, Shape, sloped, supports
from scene.peaks import folded
from scene.sight import Detection, Detector, Picture, View
from scene.stature import KNOWN
from scene.tint import tint

DOUBT = 2.0
"""How much wider than told the network's error is taken: a fit is for where it is wrong."""
SIDES, TURN = 0.08, 0.3
"""Standard deviations of the network's sides (logs) and turn (radians)."""
UNKNOWN_SIDES, UNKNOWN_TALL = 0.12, 0.5
"""Of the logs of sides and height of things of no kind."""
LEAST_TALL = 0.05
"""Least standard deviation of the log of a height: kinds differ."""
CLEAR_FIT = 16.0
"""An outline that fits no better than this (nats) is not the thing's alone, or not of its shape."""
ENOUGH = 4.0
"""An outline that fits as well as this is believed; else the thing is looked for otherwise too."""
TRIES, SMALL, STEP = 12, 2e-4, 0.12
"""Steps of a fit, when it is at its end, and the longest step (units and logs)."""
WIDE, TIGHT = 6.0, 2.5
"""Pixels of difference from which on a direction counts less: at first, and in the end."""
STILL, FOLLOWED = 0.01, 0.1
"""What is said to be no further away than this has not moved, or is the same that waited for its
turn before (table units)."""
LOOKS, EVERY = 1, 4
"""Looks in a picture where something is new or moved; in how many pictures one where all rests."""
TEMPER = 4.0
"""By how many nats a shape must fit worse to count by a factor of e less: supports in neighbouring
directions are not independent."""
FLOOR, SLACK = 0.0015, 2.0
"""A fit's deviation at its best (table units), and by how many nats of misfit its variance is a
half more (fitted on 110 drawn tables: what is told twice holds 19 of 20 times)."""


class Fitted(NamedTuple):
    """A body, the standard deviation of its place (table units), and how badly it fits (nats)."""

    body: Body
    sd: float
    misfit: float


class Kept(NamedTuple):
    """What came of a closer look, and what the detector had said then."""

    said: Detection
    made: Detection


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
        self._looks, self._every, self._pictures = looks, every, 0
        self._kept: list[Kept] = []
        self._waiting: list[Detection] = []

    def detect(self, picture: Picture, view: View) -> tuple[Detection, ...]:
        """See `scene.sight.Detector`."""
        found = self._detector.detect(picture, view)
        before = [_known(one, self._kept) for one in found]
        turns = self._turns(found, before)
        result, rest, looked = list(found), list[tuple[int, Kept]](), list[Kept]()
        for n, (one, at) in enumerate(zip(found, before, strict=True)):
            if n in turns:
                result[n] = closer(picture, view, found, n)
                looked.append(Kept(one, result[n]))
            elif at is not None:
                result[n] = _again(one, self._kept[at])
                rest.append((at, self._kept[at]))
        # the one that was looked at longest ago is first in what is kept
        self._kept = [old for _, old in sorted(rest, key=lambda pair: pair[0])] + looked
        return tuple(result)

    def _turns(self, found: Sequence[Detection], before: Sequence[int | None]) -> list[int]:
        """Whose turn it is in this picture."""
        wait = [
            n for n, (one, at) in enumerate(zip(found, before, strict=True))
            if at is None or self._kept[at].said.name != one.name
        ]  # fmt: skip
        wait.sort(key=lambda n: _waited(found[n], self._waiting))
        self._waiting = [found[n] for n in wait[self._looks :]]
        self._pictures += 1
        if wait:
            return wait[: self._looks]
        if not found or self._pictures < self._every:
            return []
        self._pictures = 0
        rest = [(at, n) for n, at in enumerate(before) if at is not None]
        return [min(rest)[1]]


def _waited(one: Detection, waiting: Sequence[Detection]) -> int:
    """Its number among what waited, be it moved meanwhile; behind them all where it is new."""
    at = _nearest(one, waiting, FOLLOWED)
    return len(waiting) if at is None else at


def _known(one: Detection, kept: Sequence[Kept]) -> int | None:
    """The number of what is kept of a thing that is said to be where it was."""
    return _nearest(one, [old.said for old in kept], STILL)


def _nearest(one: Detection, others: Sequence[Detection], within: float) -> int | None:
    """The number of the nearest of others that is no further away than that (table units)."""
    away = [math.dist((one.x, one.y), (other.x, other.y)) for other in others]
    least = min(away, default=math.inf)
    return away.index(least) if least < within else None


def _again(one: Detection, old: Kept) -> Detection:
    """What is said now, corrected as it was before."""
    if old.made is old.said:
        return one
    made = old.made
    return replace(
        one, x=one.x + made.x - old.said.x, y=one.y + made.y - old.said.y, sd=made.sd,
        width=made.width, height=made.height, tall=made.tall, r=made.r,
        color=made.color if one.color == old.said.color else one.color,
    )  # fmt: skip


def closer(picture: Picture, view: View, found: Sequence[Detection], which: int) -> Detection:
    """What was found with a number, its place, sides, turn and height as its outline tells them;
    as it is, where its outline is not clear."""
    one = found[which]
    outlines = list(_expected(found, view.camera))
    expected = outlines.pop(which)
    best: Fitted | None = None
    clear: Contour | None = None
    for seen in contours(picture.pixels, view, expected, outlines, _room(one)):
        fit = fitted(seen, one, view.camera)
        if best is None or fit.misfit < best.misfit:
            best, clear = fit, seen
        if best.misfit < ENOUGH:
            break
    if best is None or clear is None or best.misfit > CLEAR_FIT:
        return one
    body = best.body
    width, height, r = folded(body.width, body.height, body.r)
    return replace(
        one, x=body.x, y=body.y, sd=best.sd, width=width, height=height, tall=body.tall, r=r,
        color=tint(clear, one.color, one.name, body, view.camera),
    )  # fmt: skip


def _expected(found: Sequence[Detection], eye: Eye) -> Floats:
    bodies = (Body(one.x, one.y, one.width, one.height, one.r, one.tall) for one in found)
    return supports(BLOCK, np.array([body.vector() for body in bodies]), eye)


def _room(one: Detection) -> Room:
    """By the size of what is looked for, and how unsure its place is."""
    side = (one.width + one.height) / 2
    may = 0.12 * side + 3 * one.sd
    return Room(may, may + 0.35 * side, 0.15 * min(one.width, one.height))


# --- the fit ----------------------------------------------------------------------------------


def fitted(seen: Contour, one: Detection, eye: Eye) -> Fitted:
    """The body that fits an outline best, of any shape that a thing of that name may have.

    Where several fit, the place is their mean by likelihood, and their differences are added to
    its deviation.
    """
    long = one.height > one.width
    sides = (one.height, one.width) if long else (one.width, one.height)
    turn = one.r + math.pi / 2 if long else one.r
    start = Body(one.x, one.y, *sides, turn, one.tall).vector()
    tall = max(LEAST_TALL, KNOWN.get(one.name, UNKNOWN_TALL))
    side = SIDES if one.name in KNOWN else UNKNOWN_SIDES
    doubt = np.array((DOUBT * one.sd, DOUBT * one.sd, side, side, TURN, tall))
    fits = [_fit(shape, seen, start, doubt, eye) for shape in SHAPES.get(one.name, UNKNOWN)]
    best = min(fits, key=lambda fit: fit[2])
    weight = np.exp([(best[2] - misfit) / TEMPER for _, _, misfit in fits])
    weight /= weight.sum()
    places = np.array([vector[:2] for vector, _, _ in fits])
    middle = weight @ places
    apart = float(weight @ ((places - middle) ** 2).sum(1)) / 2
    vector = np.concatenate([middle, best[0][2:]])
    variance = (best[1] + apart + FLOOR**2) * (1 + best[2] / SLACK) / 2
    return Fitted(Body.of(vector), math.sqrt(variance), best[2])


def _fit(
    shape: Shape, seen: Contour, start: Floats, doubt: Floats, eye: Eye
) -> tuple[Floats, float, float]:
    """The vector of a body, the variance of its place, and its misfit: by Gauss and Newton."""
    vector, trust = start.copy(), 1 / doubt**2
    inverse: Floats = np.zeros((6, 6))
    for turn in range(TRIES):
        reach, slope = sloped(shape, vector, eye)
        off = (reach - seen.reach) / seen.pixel
        slope /= seen.pixel
        weight = 1 / (1 + (off / (WIDE if turn < 3 else TIGHT)) ** 2)
        inverse = np.asarray(np.linalg.inv((slope * weight) @ slope.T + np.diag(trust)))
        step = -inverse @ (slope @ (weight * off) + trust * (vector - start))
        vector += step.clip(-STEP, STEP)
        if turn > 3 and float(np.abs(step).max()) < SMALL:
            break
    off = (supports(shape, vector[None], eye)[0] - seen.reach) / seen.pixel
    misfit = float(np.log1p((off / TIGHT) ** 2).sum()) * TIGHT**2 / 2
    misfit += float((trust * (vector - start) ** 2).sum()) / 2
    return vector, float(inverse[0, 0] + inverse[1, 1]) / 2, misfit

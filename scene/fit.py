"""A closer look at what the detector found: its outline in the whole picture, fitted.

The network sees the table at 2 mm a pixel and tells places, sizes and heights by what it learnt.
Where a thing's outline is clear against the table, its shape (`scene.outline`) is fitted to it by
least squares, the network's word being one more observation: what it called sure stays, what it
did not know, an unknown thing's height above all, the outline decides. What a person calls a thing
says more of its shape than what the network does. Where the outline is not clear, or fits no shape
that such a thing has, the network's word stands.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from scene.contour import Contour, Room, contours
from scene.lean import seen_at, stands_at
from scene.outline import (
    BLOCK,
    ROUND,
    SHAPES,
    UNKNOWN,
    Body,
    Eye,
    Floats,
    Shape,
    sloped,
    supports,
)
from scene.peaks import folded
from scene.sight import Detection, Picture, View
from scene.stature import KNOWN
from scene.tint import tint

DOUBT = 2.0
"""How much wider than told the network's error is taken: a fit is for where it is wrong."""
SIDES, TURN = 0.08, 0.3
"""Standard deviations of the network's sides (logs) and turn (radians)."""
UNKNOWN_SIDES, UNKNOWN_TALL = 0.12, 0.5
"""Of the logs of sides and height of things of no kind."""
EVEN, LIES = 0.05, 0.25
"""Standard deviation of the log of one side beside the other of what is round; with as much as the
latter it lies on its side."""
LEAST_TALL = 0.05
"""Least standard deviation of the log of a height: kinds differ."""
CLEAR_FIT = 8.0
"""An outline that fits no better than this (nats) is not the thing's alone, or not of its shape."""
ENOUGH = 2.0
"""An outline that fits as well as this is believed; else the thing is looked for otherwise too."""
TRIES, SMALL, STEP = 12, 2e-4, 0.12
"""Steps of a fit, when it is at its end, and the longest step (units and logs)."""
WIDE, TIGHT = 6.0, 2.5
"""Pixels of difference from which on a direction counts less: at first, and in the end."""
TEMPER = 4.0
"""By how many nats a shape must fit worse to count by a factor of e less: supports in neighbouring
directions are not independent."""
FLOOR, SLACK = 0.0015, 2.0
"""A fit's deviation at its best (table units), and by how many nats of misfit its variance is a
half more (fitted on 110 drawn tables: what is told twice holds 19 of 20 times)."""
_DIFFER = np.array((0.0, 0.0, 1.0, -1.0, 0.0, 0.0))
_AS_WIDE_AS_DEEP = np.outer(_DIFFER, _DIFFER) / EVEN**2
"""How much is trusted (6, 6; see `Body.vector`) that the sides of a round thing are alike."""


class Fitted(NamedTuple):
    """A body, the standard deviation of its place (table units), and how badly it fits (nats)."""

    body: Body
    sd: float
    misfit: float


def closer(picture: Picture, view: View, found: Sequence[Detection], which: int) -> Detection:
    """What was found with a number, its place, sides, turn and height as its outline tells them;
    as it is, where its outline is not clear. What lies on something is seen against that, so of
    what else was found only what lies as high ends where it does."""
    low = found[which].base
    if low:
        level, one = view.raised(low), found[which]
        beside = (it for n, it in enumerate(found) if n != which and it.base == low)
        there = [_moved(it, stands_at((it.x, it.y), low, view.camera)) for it in (one, *beside)]
        made = _closer(picture, level, there, 0)
        return (
            one if made is there[0] else _moved(made, seen_at((made.x, made.y), low, view.camera))
        )
    return _closer(picture, view, found, which)


def _moved(one: Detection, to: tuple[float, float]) -> Detection:
    return replace(one, x=to[0], y=to[1])


def _closer(picture: Picture, view: View, found: Sequence[Detection], which: int) -> Detection:
    """The same of what stands on the surface of the view."""
    one = found[which]
    others = list(outlines(found, view.camera))
    expected = others.pop(which)
    best: Fitted | None = None
    clear: Contour | None = None
    for seen in contours(picture.pixels, view, expected, others, _room(one)):
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


def outlines(found: Sequence[Detection], eye: Eye) -> Floats:
    """How far blocks as large as what was found are seen to reach (n, `COUNT`; table units)."""
    bodies = (Body(one.x, one.y, one.width, one.height, one.r, one.tall) for one in found)
    return supports(BLOCK, np.array([body.vector() for body in bodies]), eye)


def _room(one: Detection) -> Room:
    """By the size of what is looked for, and how unsure its place is."""
    side = (one.width + one.height) / 2
    may = 0.12 * side + 3 * one.sd
    return Room(may, may + 0.35 * side, 0.15 * min(one.width, one.height))


# --- the fit ----------------------------------------------------------------------------------


def fitted(seen: Contour, one: Detection, eye: Eye) -> Fitted:
    """The body that fits an outline best, of any shape that a thing of that noun may have.

    Where several fit, the place is their mean by likelihood, and their differences are added to
    its deviation.
    """
    long = one.height > one.width
    sides = (one.height, one.width) if long else (one.width, one.height)
    turn = one.r + math.pi / 2 if long else one.r
    start = Body(one.x, one.y, *sides, turn, one.tall).vector()
    noun = one.noun or one.name
    told = one.tall_sd / one.tall
    tall = max(LEAST_TALL, min(told, KNOWN.get(noun, UNKNOWN_TALL)))
    side = min(SIDES if noun in KNOWN else UNKNOWN_SIDES, one.sides_sd)
    trust = np.diag(np.array((DOUBT * one.sd, DOUBT * one.sd, side, side, TURN, tall)) ** -2)
    if noun in ROUND and abs(start[2] - start[3]) < LIES:
        start[2:4] = start[2:4].mean()
        trust += _AS_WIDE_AS_DEEP
    fits = [_fit(shape, seen, start, trust, eye) for shape in SHAPES.get(noun, UNKNOWN)]
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
    shape: Shape, seen: Contour, start: Floats, trust: Floats, eye: Eye
) -> tuple[Floats, float, float]:
    """The vector of a body, the variance of its place, and its misfit: by Gauss and Newton, from
    where it starts, which counts as much as is trusted (6, 6)."""
    vector = start.copy()
    inverse: Floats = np.zeros((6, 6))
    for turn in range(TRIES):
        reach, slope = sloped(shape, vector, eye)
        off = (reach - seen.reach) / seen.pixel
        slope /= seen.pixel
        weight = seen.shown / (1 + (off / (WIDE if turn < 3 else TIGHT)) ** 2)
        inverse = np.asarray(np.linalg.inv((slope * weight) @ slope.T + trust))
        step = -inverse @ (slope @ (weight * off) + trust @ (vector - start))
        vector += step.clip(-STEP, STEP)
        if turn > 3 and float(np.abs(step).max()) < SMALL:
            break
    off = (supports(shape, vector[None], eye)[0] - seen.reach) / seen.pixel
    misfit = float(np.log1p((off / TIGHT) ** 2) @ seen.shown) * TIGHT**2 / 2
    misfit += float((vector - start) @ trust @ (vector - start)) / 2
    return vector, float(inverse[0, 0] + inverse[1, 1]) / 2, misfit

"""Rectangles on the table: how much two overlap, and average precision over them (numpy).

A rectangle is x, y, width, height, r (table units, radians). Average precision is COCO's: 101
points of recall, the best precision at or beyond each; of detections of one kind, surest first,
each true thing is found once.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

Rectangle = tuple[float, float, float, float, float]
Point = tuple[float, float]
OVERLAPS = tuple(np.arange(0.5, 0.96, 0.05).round(2).tolist())


class Claim(NamedTuple):
    """That a thing is at a rectangle of a picture."""

    picture: int
    score: float
    box: Rectangle


class Fact(NamedTuple):
    """A thing of a picture; one that is not ``asked`` for is no fault whether found or not."""

    picture: int
    box: Rectangle
    asked: bool = True


def overlap(one: Rectangle, other: Rectangle) -> float:
    """Intersection over union of two turned rectangles."""
    reach = math.hypot(*one[2:4]) / 2 + math.hypot(*other[2:4]) / 2
    if math.dist(one[:2], other[:2]) >= reach:
        return 0.0
    shape = _corners(one)
    edges = _corners(other)
    for start, end in zip(edges, edges[1:] + edges[:1], strict=True):
        shape = _cut(shape, start, end)
    common = _area(shape)
    return common / (one[2] * one[3] + other[2] * other[3] - common)


def _corners(box: Rectangle) -> list[Point]:
    x, y, width, height, r = box
    cos, sin = math.cos(r), math.sin(r)
    signs = ((1, 1), (-1, 1), (-1, -1), (1, -1))
    return [
        (x + a * cos * width / 2 - b * sin * height / 2, y + a * sin * width / 2
         + b * cos * height / 2)
        for a, b in signs
    ]  # fmt: skip


def _cut(shape: Sequence[Point], start: Point, end: Point) -> list[Point]:
    """What of a convex shape lies to the left of a line (Sutherland and Hodgman)."""

    def side(p: Point) -> float:
        return (end[0] - start[0]) * (p[1] - start[1]) - (end[1] - start[1]) * (p[0] - start[0])

    kept: list[Point] = []
    for index, here in enumerate(shape):
        before = shape[index - 1]
        a, b = side(before), side(here)
        if (a < 0) != (b < 0):
            part = a / (a - b)
            kept.append((before[0] + part * (here[0] - before[0]),
                         before[1] + part * (here[1] - before[1])))  # fmt: skip
        if b >= 0:
            kept.append(here)
    return kept


def _area(shape: Sequence[Point]) -> float:
    pairs = zip(shape, [*shape[1:], *shape[:1]], strict=True) if shape else ()
    return abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in pairs)) / 2


def average_precision(claims: Sequence[Claim], facts: Sequence[Fact], least: float) -> float | None:
    """Of one kind, at one least overlap; None where there is nothing to find."""
    wanted = sum(fact.asked for fact in facts)
    if not wanted:
        return None
    there: dict[int, list[tuple[int, Fact]]] = {}
    for number, fact in enumerate(facts):
        there.setdefault(fact.picture, []).append((number, fact))
    taken: set[int] = set()
    hits: list[bool] = []
    for claim in sorted(claims, key=lambda one: -one.score):
        fitting = [
            (common, fact.asked, number)
            for number, fact in there.get(claim.picture, [])
            if number not in taken and (common := overlap(claim.box, fact.box)) >= least
        ]
        if not fitting:
            hits.append(False)
            continue
        _, asked, number = max(fitting, key=lambda one: (one[1], one[0]))
        taken.add(number)
        if asked:
            hits.append(True)
    return _area_under(np.array(hits, bool), wanted)


def _area_under(hits: np.ndarray[tuple[int], np.dtype[np.bool_]], wanted: int) -> float:
    found = np.cumsum(hits)
    recall = found / wanted
    precision = found / np.arange(1, len(hits) + 1)
    best = np.maximum.accumulate(precision[::-1])[::-1] if len(hits) else precision
    points = np.linspace(0, 1, 101)
    at = np.searchsorted(recall, points - 1e-9)
    return float(
        np.where(at < len(hits), np.append(best, 0.0)[np.minimum(at, len(hits))], 0).mean()
    )

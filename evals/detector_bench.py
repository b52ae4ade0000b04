"""Figures of the detector, on pictures of other seeds than those it learnt from.

Tables are `scene.pictured` through a camera 0.6-0.8 m above, at most 10 degrees off the vertical,
640 x 480 (a table of 0.40 m; seeds ``test``), and PyBullet's overhead pictures (seeds ``bullet``).
Things of which less than `SHOWN` is seen are not asked for. Boxes are footprints on the table:
width x height, turned, about the position. A thing is found by the nearest detection of any name
within half of its size (40 mm at most); positions are of things found, each looked at closer
(`scene.closer`), as where a picture comes for the first time.
"""

from __future__ import annotations

import math
import random
import statistics
import time
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from evals.boxes import OVERLAPS, Claim, Fact, average_precision
from evals.bullet_sights import UNSEEN as UNSEEN_NOUNS
from evals.bullet_sights import simulated
from evals.figures import Figure, at_least, at_most, median
from scene.closer import EVERY, LOOKS, Closer
from scene.detector import NetDetector
from scene.fit import closer
from scene.peaks import OTHER
from scene.pictured import SHOWN, Label, Sight, Terms, camera_sight
from scene.shapes import KINDS, of_kind
from scene.sight import Detection, Detector, Picture, View
from scene.strange import SEEN, UNSEEN

PICTURES, FEWER = 500, 200
"""So many usual pictures; so many under each other condition, compared with the same ones."""
SIZE = (640, 480)
USUAL = Terms(height=(3.0, 4.0), tilt=(0.0, 10.0), gain=(0.7, 1.3), families=(*SEEN, *UNSEEN),
              strange=0.2, wide=0.0)  # fmt: skip
OTHERS: dict[str, Terms] = {
    "low_camera": USUAL._replace(height=(2.4, 3.2)),
    "high_camera": USUAL._replace(height=(3.6, 4.8)),
    "tilted_camera": USUAL._replace(tilt=(10.0, 10.0)),
    "half_light": USUAL._replace(gain=(0.35, 0.65)),
    "double_light": USUAL._replace(gain=(1.4, 2.6)),
    "any_size": USUAL._replace(wide=1.0),
}
MM = 200.0
"""Millimetres in a table unit."""
NEAR = 0.2
"""Detections further away than this (table units) are not of the thing."""


class Pair(NamedTuple):
    """A thing that was asked for, what found it, and where its picture box's middle would be.

    ``boxed``: the point of the table that shows in the middle of the thing's true box in the
    picture; None where the picture's renderer does not tell boxes.
    """

    picture: int
    label: Label
    seen: Detection | None
    boxed: tuple[float, float] | None


class Seen(NamedTuple):
    """What was detected on pictures, and what is there."""

    pairs: list[Pair]
    claims: dict[str, list[Claim]]
    facts: dict[str, list[Fact]]
    false: int
    pictures: int


def figures(pictures: int = PICTURES, fewer: int = FEWER) -> dict[str, Figure]:
    """Every figure, measured now; drawing takes most of the time."""
    detector = Looking(NetDetector())
    usual = seen_by(detector, _cameras("test", USUAL, pictures))
    result = {**_all(usual, ""), **_boxes_alone(usual)}
    result["looked_at_closer"] = _share(detector.clear, None)
    for prefix, number, wide in (("bullet_", pictures // 2, 0.0), ("bullet_any_size_", fewer, 1.0)):
        tables = simulated(prefix, number, UNSEEN_NOUNS, wide)
        result |= _all(seen_by(detector, tables), prefix)
    same = first(usual, fewer)
    for name, terms in OTHERS.items():
        other = seen_by(detector, _cameras("test", terms, fewer))
        result |= _losses(same, other, name, goal=name != "any_size")
    return result | _time(detector.net) | _closer_time(detector.net)


class Looking:
    """A detector and its closer look at pictures that have nothing to do with each other."""

    def __init__(self, net: NetDetector) -> None:
        self.net = net
        self.clear: list[bool] = []

    def detect(
        self, picture: Picture, view: View, expected: Sequence[Detection] = ()
    ) -> tuple[Detection, ...]:
        """See `scene.sight.Detector`; ``clear`` gets for each thing whether its outline told."""
        found = self.net.detect(picture, view)
        made = tuple(closer(picture, view, found, n) for n in range(len(found)))
        self.clear += [new is not old for new, old in zip(made, found, strict=True)]
        return made


def first(seen: Seen, pictures: int) -> Seen:
    """What was seen on the first so many pictures."""
    return Seen(
        [pair for pair in seen.pairs if pair.picture < pictures],
        {name: [one for one in claims if one.picture < pictures]
         for name, claims in seen.claims.items()},
        {name: [one for one in facts if one.picture < pictures]
         for name, facts in seen.facts.items()},
        seen.false, pictures,
    )  # fmt: skip


def _losses(usual: Seen, other: Seen, name: str, goal: bool) -> dict[str, Figure]:
    n = len(other.pairs)
    points = 100 * (mean_precision(usual, (0.5,)) - mean_precision(other, (0.5,)))
    further = _median_mm(other) - _median_mm(usual)
    return {
        f"{name}_loses_map50": at_most(points, 2.0 if goal else None, "points", n),
        f"{name}_loses_mm": at_most(further, 1.0 if goal else None, "mm", n),
    }


def seen_by(detector: Detector, sights: Iterator[Sight]) -> Seen:
    """Look at pictures and pair what is there with what is seen."""
    seen = Seen([], {}, {}, 0, 0)
    false = pictures = 0
    for number, sight in enumerate(sights):
        found = detector.detect(sight.picture, sight.view)
        pairs, extra = _paired(number, sight, found)
        seen.pairs.extend(pairs)
        false, pictures = false + extra, pictures + 1
        for one in found:
            box = (one.x, one.y, one.width, one.height, one.r)
            seen.claims.setdefault(one.name, []).append(Claim(number, one.score, box))
        for label in sight.labels:
            box = (label.x, label.y, label.width, label.height, label.r)
            fact = Fact(number, box, label.seen >= SHOWN)
            seen.facts.setdefault(label.name, []).append(fact)
    return seen._replace(false=false, pictures=pictures)


def _paired(number: int, sight: Sight, found: Sequence[Detection]) -> tuple[list[Pair], int]:
    """Each thing with the nearest detection, nearest pairs first; and how many are of nothing."""
    labels = sight.labels
    options = sorted(
        (math.dist((label.x, label.y), (one.x, one.y)), i, j)
        for i, label in enumerate(labels) for j, one in enumerate(found)
    )  # fmt: skip
    chosen: dict[int, int] = {}
    for away, i, j in options:
        half = max(labels[i].width, labels[i].height) / 2
        if away <= min(NEAR, half) and i not in chosen and j not in chosen.values():
            chosen[i] = j
    pairs = [
        Pair(number, label, found[chosen[i]] if i in chosen else None, _boxed(label, sight.view))
        for i, label in enumerate(labels) if label.seen >= SHOWN
    ]  # fmt: skip
    return pairs, len(found) - len(chosen)


def _boxed(label: Label, view: View) -> tuple[float, float] | None:
    if label.box is None:
        return None
    left, top, right, bottom = label.box
    x, y = view.points(np.array([[(left + right) / 2, (top + bottom) / 2]]))[0].tolist()
    return x, y


def mean_precision(seen: Seen, overlaps: Sequence[float] = OVERLAPS) -> float:
    """Mean over kinds (`OTHER` among them) and overlaps of the average precision."""
    every = [
        average_precision(seen.claims.get(name, []), facts, least)
        for name, facts in seen.facts.items() for least in overlaps
    ]  # fmt: skip
    return statistics.fmean(one for one in every if one is not None)


def away_mm(pair: Pair) -> float:
    """How far from its place a thing was seen (mm)."""
    assert pair.seen is not None
    return MM * math.dist((pair.label.x, pair.label.y), (pair.seen.x, pair.seen.y))


def _found(seen: Seen) -> list[Pair]:
    return [pair for pair in seen.pairs if pair.seen is not None]


def _median_mm(seen: Seen) -> float:
    return statistics.median(map(away_mm, _found(seen)))


def _all(seen: Seen, prefix: str) -> dict[str, Figure]:
    found, n = _found(seen), len(seen.pairs)
    away = np.array([away_mm(pair) for pair in found])
    worst = _worst(found)
    free = prefix == "bullet_any_size_"
    sizes = [
        MM * abs(getattr(pair.label, side) - getattr(pair.seen, side))
        for pair in found for side in ("width", "height")
    ]  # fmt: skip
    made: dict[str, Figure] = {
        "map50": at_least(mean_precision(seen, (0.5,)), 0.985, "", n),
        "map50_95": at_least(mean_precision(seen), 0.80, "", n),
        "position_median": at_most(float(np.median(away)), 1.5, "mm", len(found)),
        "position_p95": at_most(float(np.quantile(away, 0.95)), 4.0, "mm", len(found)),
        "position_worst_kind_p95": at_most(max(worst.values()), 8.0, "mm", len(found)),
        "size_median": at_most(statistics.median(sizes), 4.0, "mm", len(sizes)),
        "color_right": _share(_colors(found), 97),
        "unknown_is_other": _share(_unknown(seen, prefix), 95),
        "missed": _share([pair.seen is None for pair in seen.pairs], None),
        "kind_right": _share([pair.label.name == pair.seen.name for pair in found
                              if pair.seen and pair.label.name != OTHER], None),
        "of_nothing_per_picture": at_most(seen.false / seen.pictures, None, "", seen.pictures),
        "within_one_sd": _share(_within(found, 1), None),
        "within_two_sd": _share(_within(found, 2), None),
    }  # fmt: skip
    if free:
        made = {key: value for key, value in made.items() if key not in ("unknown_is_other",)}
    return {f"{prefix}{key}": value for key, value in made.items()}


def _worst(found: Sequence[Pair]) -> dict[str, float]:
    by: dict[str, list[float]] = {}
    for pair in found:
        by.setdefault(pair.label.name, []).append(away_mm(pair))
    return {name: float(np.quantile(all_, 0.95)) for name, all_ in by.items()}


def _colors(found: Sequence[Pair]) -> list[bool]:
    return [pair.label.color == pair.seen.color for pair in found if pair.seen and pair.label.color]


def _unknown(seen: Seen, prefix: str) -> list[bool]:
    """Of things of families never shown in training: are they there, and called other?"""
    looks = UNSEEN_NOUNS if prefix else UNSEEN
    return [
        pair.seen is not None and pair.seen.name == OTHER
        for pair in seen.pairs if pair.label.name == OTHER and pair.label.family in looks
    ]  # fmt: skip


def _within(found: Sequence[Pair], times: float) -> list[bool]:
    """Whether x, and y, lie within so many of their deviations."""
    return [
        abs(getattr(pair.label, axis) - getattr(pair.seen, axis)) <= times * pair.seen.sd
        for pair in found if pair.seen for axis in ("x", "y")
    ]  # fmt: skip


def _share(held: Sequence[bool], goal: float | None) -> Figure:
    if not held:
        return Figure(value=None, unit="%", n=0, why="nothing of the sort in the pictures")
    share, n = sum(held) / len(held), len(held)
    return Figure(
        value=100 * share, unit="%", n=n, stderr=100 * math.sqrt(share * (1 - share) / n),
        goal=None if goal is None else f">= {goal:g}",
        met=None if goal is None else 100 * share >= goal,
    )  # fmt: skip


def _boxes_alone(seen: Seen) -> dict[str, Figure]:
    """The floor under every detector of boxes: the middle of each thing's true picture box."""
    away = [
        MM * math.dist((pair.label.x, pair.label.y), pair.boxed)
        for pair in seen.pairs if pair.boxed
    ]  # fmt: skip
    return {
        "perfect_boxes_position_median": at_most(statistics.median(away), None, "mm", len(away)),
        "perfect_boxes_position_p95": at_most(
            float(np.quantile(away, 0.95)), None, "mm", len(away)
        ),
    }


def _time(detector: NetDetector) -> dict[str, Figure]:
    sight = camera_sight("time", USUAL, *SIZE)
    spent, worked = list[float](), list[float]()
    for _ in range(30):
        began, busy = time.perf_counter(), time.process_time()
        detector.detect(sight.picture, sight.view)
        spent.append(1000 * (time.perf_counter() - began))
        worked.append(1000 * (time.process_time() - busy))
    return {"one_frame": median(spent, 15), "one_frame_processor": median(worked)}


def _closer_time(net: NetDetector) -> dict[str, Figure]:
    """A frame of nine things that rest, and one while some are new; what is done of it when its
    scene is told; and all together until none is new."""
    things = [of_kind(random.Random(name), name, 1.0) for name in KINDS]
    sight = camera_sight("time", USUAL, *SIZE, more=things[:8])
    rest, new, behind, until = list[float](), list[float](), list[float](), list[float]()
    for _ in range(5):
        eye, told, settled = Closer(net, later=True), list[float](), list[float]()
        pictures = -(-len(net.detect(sight.picture, sight.view)) // LOOKS)
        for _ in range(pictures + 3 * EVERY):
            began = time.process_time()
            eye.detect(sight.picture, sight.view)
            seen = time.process_time()
            eye.settle()
            told.append(1000 * (seen - began))
            settled.append(1000 * (time.process_time() - seen))
        new += told[:pictures]
        rest += told[pictures:]
        behind += settled[:pictures]
        until.append(sum(told[:pictures]) + sum(settled[:pictures]))
    return {
        "one_frame_at_rest": median(rest, 15), "one_frame_at_rest_mean": _mean(rest),
        "one_frame_something_new": median(new, 15), "closer_look_behind_it": median(behind),
        "until_all_looked_at": median(until),
        "pictures_until_all_looked_at": Figure(value=pictures, unit="", n=len(until)),
    }  # fmt: skip


def _mean(spent: Sequence[float]) -> Figure:
    error = statistics.stdev(spent) / math.sqrt(len(spent))
    return Figure(value=statistics.fmean(spent), unit="ms", n=len(spent), stderr=error)


def _cameras(seed: str, terms: Terms, pictures: int) -> Iterator[Sight]:
    for number in range(pictures):
        yield camera_sight(f"{seed} {number}", terms, *SIZE)

"""What being shown a thing is worth: things of families never learnt, taught by a few views.

Of each thing the detector sees `VIEWS` views on as many tables; then it is looked for on others,
among things that it was not taught.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from evals.detector_bench import SIZE, USUAL, Pair, Seen, seen_by
from evals.figures import Figure
from scene.detector import NetDetector
from scene.pictured import Sight, camera_sight
from scene.shapes import Design
from scene.shown import learnt, named
from scene.strange import UNSEEN, numbered

TAUGHT, VIEWS, LOOKS = 15, 5, 6
FEW = USUAL._replace(most=5)


def figures(taught: int = TAUGHT) -> dict[str, Figure]:
    """How often taught things are named, and how often others are named so."""
    detector = NetDetector()
    right, wrong = list[bool](), list[bool]()
    for number in range(taught):
        design = numbered(number, tuple(UNSEEN))
        views = [
            pair.seen
            for pair in _pairs(detector, design, f"taught {number}", VIEWS)
            if pair.seen and pair.label.look == design.look
        ]
        known = learnt((), "taught", views) if views else ()
        for pair in _pairs(detector, design, f"looked for {number}", LOOKS):
            called = pair.seen is not None and named(known, [pair.seen])[0].name == "taught"
            (right if pair.label.look == design.look else wrong).append(called)
    return {"taught_named": _share(right), "others_named_so": _share(wrong)}


def _pairs(detector: NetDetector, design: Design, seed: str, pictures: int) -> list[Pair]:
    seen: Seen = seen_by(detector, _tables(design, seed, pictures))
    return seen.pairs


def _tables(design: Design, seed: str, pictures: int) -> Iterator[Sight]:
    for number in range(pictures):
        yield camera_sight(f"{seed} {number}", FEW, *SIZE, more=[design])


def _share(held: list[bool]) -> Figure:
    share, n = sum(held) / len(held), len(held)
    return Figure(value=100 * share, unit="%", n=n, stderr=100 * math.sqrt(share * (1 - share) / n))

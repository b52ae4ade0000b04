"""Things of no kind that the detector knows: families of shapes, their sizes and paints (pure).

Some families are shown in training, the others are kept for tests; all are called `OTHER`.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from scene.colors import COLOR_VALUES
from scene.peaks import OTHER
from scene.shapes import FLAT, MM, Design, Paint, ball, box, drum, shade
from scene.solids import Solid, lying


def _slab(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    return [box(0, 0, t / 2, w / 2, h / 2, t / 2)]


def _dish(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    return [Solid("cup", (w / 2, h / 2, t / 2), (0, 0, t / 2), FLAT, c.uniform(0.4, 0.8), 1.0)]


def _peak(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    return [drum(0, t, w / 2, h / 2, 1.0, c.uniform(0.02, 0.35))]


def _rod(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    turned = lying()
    tip = Solid("cone", (t / 2, h / 2, 0.06 * w), (0.44 * w, 0, t / 2), turned, 1.0, 0.1, 1)
    return [Solid("cone", (t / 2, h / 2, 0.44 * w), (-0.06 * w, 0, t / 2), turned), tip]


def _spoon(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    head = ball(0.36 * w, 0, t / 2, 0.14 * w, h / 2, t / 2)
    return [head, box(-0.12 * w, 0, t / 2, 0.38 * w, 0.14 * h, 0.3 * t, 1)]


def _car(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    wheels = [
        Solid("ball", (0.13 * w, 0.1 * h, 0.2 * t), (sx * 0.3 * w, sy * 0.4 * h, 0.2 * t), FLAT,
              paint=1)
        for sx in (-1, 1) for sy in (-1, 1)
    ]  # fmt: skip
    body = box(0, 0, 0.4 * t, w / 2, 0.45 * h, 0.22 * t)
    return [body, box(-0.05 * w, 0, 0.75 * t, 0.25 * w, 0.4 * h, 0.25 * t, 1), *wheels]


def _duck(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    body = ball(-0.1 * w, 0, 0.3 * t, 0.4 * w, h / 2, 0.3 * t)
    head = ball(0.2 * w, 0, 0.75 * t, 0.2 * w, 0.3 * h, 0.25 * t)
    return [body, head, ball(0.42 * w, 0, 0.7 * t, 0.08 * w, 0.12 * h, 0.06 * t, 1)]


def _mushroom(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    return [
        drum(0, 0.6 * t, 0.2 * w, 0.2 * h, paint=1),
        ball(0, 0, 0.6 * t, w / 2, h / 2, 0.4 * t),
    ]


def _angle(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    arm = c.uniform(0.15, 0.25)
    return [
        box(0, (arm - 0.5) * h, t / 2, w / 2, arm * h, t / 2),
        box((arm - 0.5) * w, 0, t / 2, arm * w, h / 2, t / 2, c.choice((0, 1))),
    ]


def _tower(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    split = c.uniform(0.3, 0.7)
    top = c.uniform(0.3, 0.8)
    upper = box(0, 0, (1 + split) / 2 * t, top * w / 2, top * h / 2, (1 - split) / 2 * t, 1)
    return [box(0, 0, split / 2 * t, w / 2, h / 2, split / 2 * t), upper]


def _globe(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    return [ball(0, 0, t / 2, w / 2, h / 2, t / 2)]


def _hat(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    brim = drum(0, 0.15 * t, w / 2, h / 2)
    return [brim, drum(0.15 * t, t, 0.3 * w, 0.3 * h, 1.0, c.uniform(0.5, 1.0), 1)]


def _ring(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    return [
        ball((0.5 * w - t / 2) * math.cos(a), (0.5 * h - t / 2) * math.sin(a), t / 2,
              0.09 * w + t / 4, 0.09 * h + t / 4, t / 2, step % 2)
        for step, a in enumerate(np.linspace(0, math.tau, 12, endpoint=False).tolist())
    ]  # fmt: skip


def _cross(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    return [
        box(0, 0, t / 2, w / 2, 0.16 * h, t / 2), box(0, 0, t / 2, 0.16 * w, h / 2, t / 2, 1),
    ]  # fmt: skip


def _dumbbell(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    ends = [ball(s * 0.33 * w, 0, t / 2, 0.17 * w, h / 2, t / 2) for s in (-1, 1)]
    return [*ends, box(0, 0, t / 2, 0.3 * w, 0.12 * h, 0.15 * t, 1)]


def _table(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    legs = [
        box(sx * 0.42 * w, sy * 0.42 * h, 0.4 * t, 0.08 * w, 0.08 * h, 0.4 * t, 1)
        for sx in (-1, 1) for sy in (-1, 1)
    ]  # fmt: skip
    return [*legs, box(0, 0, 0.9 * t, w / 2, h / 2, 0.1 * t)]


def _snowman(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    return [
        ball(0, 0, 0.3 * t, w / 2, h / 2, 0.3 * t),
        ball(0, 0, 0.75 * t, 0.32 * w, 0.32 * h, 0.25 * t, 1),
    ]


def _heap(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    """Any parts, side by side and on top of each other."""
    solids = [_piece(c, 0.0, 0.0, 0.0, 0)]
    for number in range(c.randint(1, 4)):
        under = c.choice(solids)
        x, y = (under.at[axis] + c.uniform(-1, 1) * under.half[axis] for axis in (0, 1))
        top = under.at[2] + under.half[2]
        solids.append(_piece(c, x, y, c.choice((0.0, 0.8 * top)), number % 2))
    return _fitted(solids, w, h, t)


def _pile(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    """Parts about one upright axis; never two round ones with upright sides: that is a bottle."""
    solids, top, before = list[Solid](), 0.0, ""
    for number in range(c.randint(2, 3)):
        shape = c.choice([one for one in ("ball", "box", "cone") if one != "cone" or before != one])
        solids.append(_piece(c, 0.0, 0.0, top, number % 2, shape))
        top, before = 0.9 * (solids[-1].at[2] + solids[-1].half[2]), shape
    return _fitted(solids, w, h, t)


def _piece(c: random.Random, x: float, y: float, z: float, paint: int, shape: str = "") -> Solid:
    """A part of any size that stands at a height z."""
    a, b, tall = (math.exp(c.uniform(-1.2, 0.3)) for _ in range(3))
    made = shape or c.choice(("ball", "box", "box", "cone"))
    if made == "cone":
        return Solid("cone", (a, a, tall), (x, y, z + tall), FLAT, 1.0, c.uniform(0.2, 1.0), paint)
    return (ball if made == "ball" else box)(x, y, z + tall, a, b, tall, paint)


def _fitted(solids: Sequence[Solid], w: float, h: float, t: float) -> list[Solid]:
    """The parts stretched and moved so that together they fill w x h x t."""
    at, half = np.array([one.at for one in solids]), np.array([one.half for one in solids])
    low, high = (at - half).min(0), (at + half).max(0)
    scale = np.array((w, h, t)) / (high - low)
    moved = (at - (low + high) / 2) * scale + (0, 0, t / 2)
    return [
        one._replace(at=(x, y, z), half=(a, b, c))
        for one, (x, y, z), (a, b, c) in zip(
            solids, moved.tolist(), (half * scale).tolist(), strict=True
        )
    ]


class Strange(NamedTuple):
    """A family of things of no kind: ranges of length, breadth and height in mm."""

    build: Callable[[random.Random, float, float, float], list[Solid]]
    long: tuple[float, float]
    broad: tuple[float, float]
    tall: tuple[float, float]
    symmetry: int = 2


SEEN: Mapping[str, Strange] = {
    "slab": Strange(_slab, (70, 160), (45, 110), (6, 60)),
    "dish": Strange(_dish, (90, 150), (90, 150), (12, 45), 0),
    "peak": Strange(_peak, (40, 90), (40, 90), (40, 110), 0),
    "rod": Strange(_rod, (90, 170), (9, 22), (9, 22), 1),
    "spoon": Strange(_spoon, (90, 170), (20, 40), (8, 16), 1),
    "car": Strange(_car, (55, 110), (28, 55), (24, 45), 1),
    "mushroom": Strange(_mushroom, (35, 90), (35, 90), (40, 90), 0),
    "angle": Strange(_angle, (50, 120), (50, 120), (10, 40), 1),
    "tower": Strange(_tower, (45, 100), (35, 90), (45, 110)),
    "globe": Strange(_globe, (28, 50), (28, 50), (24, 50), 0),
    "hat": Strange(_hat, (70, 130), (70, 130), (30, 70), 0),
    "ring": Strange(_ring, (50, 110), (50, 110), (10, 24), 0),
}
"""Families that the detector is shown in training."""
UNSEEN: Mapping[str, Strange] = {
    "duck": Strange(_duck, (50, 100), (35, 70), (45, 80), 1),
    "cross": Strange(_cross, (60, 130), (60, 130), (10, 35)),
    "dumbbell": Strange(_dumbbell, (70, 140), (28, 55), (28, 55)),
    "table": Strange(_table, (60, 120), (50, 100), (30, 80)),
    "snowman": Strange(_snowman, (40, 75), (40, 75), (60, 110), 0),
}
"""Families that are kept for tests."""
ANY: Mapping[str, Strange] = {
    "heap": Strange(_heap, (40, 150), (25, 110), (10, 110), 1),
    "pile": Strange(_pile, (30, 110), (30, 110), (25, 120)),
}
"""Things made up of parts at random, besides those families, for training alone."""
PATTERNS = ("plain", "bands", "dots", "checks", "marble")
PATTERN_COLORS = tuple(sorted(set(COLOR_VALUES) - {"grey", "violet", "cyan", "navy", "maroon"}))


def strange(chance: random.Random, families: Sequence[str], scale: float = 1.0) -> Design:
    """A thing of no kind, of one of these families: size, paints and all drawn."""
    family = chance.choice(families)
    return _strange(random.Random(chance.random()), family, scale)


def numbered(number: int, families: Sequence[str]) -> Design:
    """The thing of no kind that has this number, the same whenever it is asked for."""
    chance = random.Random(f"thing {number}")
    return _strange(chance, families[number % len(families)], 1.0, f"thing {number}")


def _strange(chance: random.Random, family: str, scale: float, look: str = "") -> Design:
    kind = {**SEEN, **UNSEEN, **ANY}[family]
    long, broad, tall = (
        chance.uniform(*span) * MM * scale for span in (kind.long, kind.broad, kind.tall)
    )
    broad = long if kind.symmetry in (0, 4) else min(broad, long)
    words = [chance.choice(PATTERN_COLORS) for _ in range(3)]
    tones = [shade(chance, word) for word in words]
    pattern = chance.choice(PATTERNS if family != "globe" else ("bands", "dots", "checks"))
    paints = (
        Paint(tones[0], tones[0] if pattern == "plain" else tones[1], pattern,
              chance.uniform(1, 5), chance.uniform(0, 4), chance.uniform(0, 0.4)),
        Paint(tones[2], tones[2]),
    )  # fmt: skip
    solids = tuple(kind.build(chance, long, broad, tall))
    size = (long, broad, tall)
    return Design(OTHER, None, size, solids, paints, kind.symmetry, look, family)

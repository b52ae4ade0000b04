"""What the things of the training pictures are made of: 12 kinds, and things of no kind (pure).

A design is a thing standing at the origin, its footprint's centre there, unturned: solids (table
units), the paints they wear, its size, and the word for its colour. The 12 kinds and their sizes
are those of the robot's table (design: robot.md section 5); what is not one of them is `OTHER`.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from scene.colors import COLOR_VALUES, RGB
from scene.solids import Solid, lying, upright

MM = 0.005
"""Table units in a millimetre, on a table of 0.40 m."""
OTHER = "other"


class Paint(NamedTuple):
    """Two colours in a pattern: ``across`` and ``along`` repeats over the thing's size."""

    first: RGB
    second: RGB
    pattern: str = "plain"
    across: float = 2.0
    along: float = 0.0
    shine: float = 0.1


class Design(NamedTuple):
    """``symmetry``: by what part of a full turn it looks, from above, as before (0: any turn)."""

    name: str
    color: str | None
    size: tuple[float, float, float]
    solids: tuple[Solid, ...]
    paints: tuple[Paint, ...]
    symmetry: int = 2
    look: str = ""
    family: str = ""


class Kind(NamedTuple):
    """Size in mm, the colours it comes in, how it is built, and its symmetry."""

    size: tuple[float, float, float]
    colors: tuple[str, ...]
    build: Callable[[random.Random, float, float, float], list[Solid]]
    symmetry: int = 2


FLAT = upright()


def _ball(x: float, y: float, z: float, a: float, b: float, c: float, paint: int = 0) -> Solid:
    return Solid("ball", (a, b, c), (x, y, z), FLAT, paint=paint)


def _box(x: float, y: float, z: float, a: float, b: float, c: float, paint: int = 0) -> Solid:
    return Solid("box", (a, b, c), (x, y, z), FLAT, paint=paint)


def _round(
    z0: float, z1: float, a: float, b: float, low: float = 1.0, high: float = 1.0, paint: int = 0
) -> Solid:
    return Solid(
        "cone", (a, b, (z1 - z0) / 2), (0.0, 0.0, (z0 + z1) / 2), FLAT, low, high, paint
    )  # fmt: skip


def _apple(chance: random.Random, w: float, h: float, t: float) -> list[Solid]:
    tilt = chance.uniform(-0.1, 0.1) * w
    stalk = Solid("cone", (0.03 * w, 0.03 * w, 0.06 * t), (tilt, 0, 0.94 * t), FLAT, paint=1)
    return [_ball(0, 0, 0.47 * t, w / 2, h / 2, 0.47 * t), stalk]


def _orange(chance: random.Random, w: float, h: float, t: float) -> list[Solid]:
    return [
        _ball(0, 0, t / 2, w / 2, h / 2, t / 2),
        _ball(chance.uniform(-0.2, 0.2) * w, 0, 0.95 * t, 0.05 * w, 0.05 * h, 0.04 * t, 1),
    ]


def _lemon(chance: random.Random, w: float, h: float, t: float) -> list[Solid]:
    tips = [_ball(s * 0.40 * w, 0, t / 2, 0.10 * w, 0.2 * h, 0.2 * t) for s in (-1, 1)]
    return [_ball(0, 0, t / 2, 0.46 * w, h / 2, t / 2), *tips]


def _pear(chance: random.Random, w: float, h: float, t: float) -> list[Solid]:
    big = _ball(-0.5 * w + 0.32 * w, 0, t / 2, 0.32 * w, h / 2, t / 2)
    neck = _ball(0.06 * w, 0, 0.45 * t, 0.30 * w, 0.36 * h, 0.36 * t)
    top = _ball(0.26 * w, 0, 0.42 * t, 0.18 * w, 0.24 * h, 0.24 * t)
    stalk = _box(0.45 * w, 0, 0.42 * t, 0.05 * w, 0.02 * w, 0.02 * w, 1)
    return [big, neck, top, stalk]


def _banana(chance: random.Random, w: float, h: float, t: float) -> list[Solid]:
    band, solids = chance.uniform(0.28, 0.34) * h, []
    for step in range(-4, 5):
        off = step / 4
        thick = 1 - 0.45 * off * off
        y = (h / 2 - band) * (1 - 2 * off * off) * (1 if abs(off) < 1 else 0.9)
        length = 0.115 * w if abs(step) < 4 else 0.07 * w
        x = off * (w / 2 - 0.07 * w)
        solids.append(_ball(x, y, 0.5 * t * thick, length, band * thick, 0.5 * t * thick, 0))
    solids[-1] = solids[-1]._replace(paint=1)
    near = min(one.at[1] - one.half[1] for one in solids)
    far = max(one.at[1] + one.half[1] for one in solids)
    stretch = h / (far - near)
    return [
        one._replace(
            at=(one.at[0], stretch * (one.at[1] - (near + far) / 2), one.at[2]),
            half=(one.half[0], stretch * one.half[1], one.half[2]),
        )
        for one in solids
    ]


def _cup(chance: random.Random, w: float, h: float, t: float) -> list[Solid]:
    low = chance.uniform(0.65, 1.0)
    if w < 1.08 * h:
        return [Solid("cup", (w / 2, h / 2, t / 2), (0, 0, t / 2), FLAT, low, 1.0)]
    body = Solid("cup", (h / 2, h / 2, t / 2), (h / 2 - w / 2, 0, t / 2), FLAT, low, 1.0)
    reach, rise = w - h, 0.3 * t
    ring = [
        _ball(w / 2 - reach + (reach - 0.05 * h) * math.cos(a), 0, 0.55 * t + rise * math.sin(a),
              0.05 * h, 0.06 * h, 0.09 * t)
        for a in np.linspace(-1.4, 1.4, 8).tolist()
    ]  # fmt: skip
    return [body, *ring]


def _bottle(chance: random.Random, w: float, h: float, t: float) -> list[Solid]:
    a, b, neck = w / 2, h / 2, chance.uniform(0.32, 0.46)
    shoulder, foot = chance.uniform(0.55, 0.66), chance.uniform(0.72, 0.84)
    return [
        _round(0, shoulder * t, a, b),
        _round(shoulder * t, foot * t, a, b, 1.0, neck),
        _round(foot * t, 0.92 * t, a, b, neck, neck),
        _round(0.90 * t, t, a, b, neck * 1.12, neck * 1.12, 1),
        _round(0.15 * t, 0.45 * t, 1.01 * a, 1.01 * b, paint=2),
    ]


def _can(chance: random.Random, w: float, h: float, t: float) -> list[Solid]:
    a, b = w / 2, h / 2
    return [
        _round(0.04 * t, 0.94 * t, a, b),
        _round(0.0, 0.04 * t, a, b, 0.9, 1.0, 1),
        _round(0.94 * t, t, a, b, 1.0, 0.9, 1),
    ]


def _padlock(chance: random.Random, w: float, h: float, t: float) -> list[Solid]:
    body, thick = 0.58 * t, 0.11 * w
    bow = [
        _ball(0.32 * w * math.cos(a), 0, body + (t - body - thick) * math.sin(a),
              thick, min(thick, 0.35 * h), thick, 1)
        for a in np.linspace(0, math.pi, 11).tolist()
    ]  # fmt: skip
    return [_box(0, 0, body / 2, w / 2, h / 2, body / 2), *bow]


def _magnet(chance: random.Random, w: float, h: float, t: float) -> list[Solid]:
    split = chance.uniform(-0.05, 0.25)
    left, right = (split + 0.5) * w, (0.5 - split) * w
    return [
        _box(-w / 2 + left / 2, 0, t / 2, left / 2, h / 2, t / 2),
        _box(w / 2 - right / 2, 0, t / 2, right / 2, h / 2, t / 2, 1),
    ]


def _block(chance: random.Random, w: float, h: float, t: float) -> list[Solid]:
    return [_box(0, 0, t / 2, w / 2, h / 2, t / 2)]


def _matchbox(chance: random.Random, w: float, h: float, t: float) -> list[Solid]:
    sides = _box(0, 0, t / 2, w / 2, h / 2, 0.48 * t, 1)
    return [sides, _box(0, 0, t / 2, 0.499 * w, 0.46 * h, t / 2)]


KINDS: Mapping[str, Kind] = {
    "apple": Kind((72, 72, 72), ("red", "green", "yellow"), _apple, 0),
    "orange": Kind((70, 70, 67), ("orange",), _orange, 0),
    "lemon": Kind((72, 50, 50), ("yellow",), _lemon),
    "pear": Kind((77, 62, 62), ("green", "yellow"), _pear, 1),
    "banana": Kind((152, 54, 33), ("yellow",), _banana, 1),
    "cup": Kind((105, 80, 79), ("white", "blue", "red", "green", "yellow", "black"), _cup, 1),
    "bottle": Kind((52, 52, 128), ("green", "brown", "blue", "white"), _bottle, 0),
    "can": Kind((53, 53, 91), ("red", "silver", "blue", "green"), _can, 0),
    "padlock": Kind((42, 20, 65), ("gold", "silver", "black"), _padlock),
    "magnet": Kind((49, 25, 13), ("red", "blue"), _magnet, 1),
    "block": Kind((40, 40, 40), ("red", "green", "blue", "yellow", "orange", "purple"), _block, 4),
    "matchbox": Kind((52, 35, 15), ("blue", "red", "yellow"), _matchbox),
}
"""The kinds that the detector knows by name."""
SECOND: Mapping[str, tuple[str, ...]] = {
    "apple": ("brown",), "orange": ("green", "brown"), "pear": ("brown",), "banana": ("brown",),
    "bottle": ("white", "blue", "black", "red"), "can": ("silver",), "padlock": ("silver",),
    "magnet": ("silver", "blue", "gray"), "matchbox": ("brown", "beige"),
}  # fmt: skip
"""What a kind's second part may be coloured: stalk, lid, poles."""


def shade(chance: random.Random, word: str, spread: float = 0.06) -> RGB:
    """A colour that goes by this word."""
    gain = chance.uniform(1 - 2 * spread, 1 + spread)
    red, green, blue = (
        min(1.0, max(0.02, gain * part + chance.uniform(-spread, spread) * 0.7))
        for part in COLOR_VALUES[word]
    )
    return red, green, blue


def of_kind(
    chance: random.Random, name: str, scale: float, color: str | None = None, skew: float = 0.0
) -> Design:
    """A thing of a kind: its colour drawn, ``scale`` times the kind's size; each side by itself
    bigger or smaller by up to ``skew``."""
    kind = KINDS[name]
    word = color or chance.choice(kind.colors)
    width, height, tall = (side * MM * scale * math.exp(chance.uniform(-skew, skew))
                           for side in kind.size)  # fmt: skip
    if kind.symmetry in (0, 4):
        height = width
    if name == "cup" and chance.random() < 0.3:
        width = height * 1.0
    first = shade(chance, word)
    other = shade(chance, chance.choice(SECOND.get(name, (word,))))
    label = shade(chance, chance.choice(("white", word, "red", "blue", "yellow")))
    pattern = {"apple": "marble", "banana": "marble", "pear": "marble"}.get(name, "plain")
    if name in ("can", "matchbox", "block") and chance.random() < 0.4:
        pattern = chance.choice(("bands", "dots"))
    tone = chance.uniform(0.6, 1.3)
    mottled = (min(1.0, first[0] * tone), min(1.0, first[1] * tone), min(1.0, first[2] * tone))
    shine = chance.uniform(0.0, 0.6 if word in ("silver", "gold") or name == "can" else 0.3)
    paints = (
        Paint(first, mottled, pattern, chance.uniform(1, 4), chance.uniform(0, 3), shine),
        Paint(other, other, shine=shine),
        Paint(label, label),
    )
    solids = tuple(kind.build(chance, width, height, tall))
    symmetry = 0 if name == "cup" and width == height else kind.symmetry
    return Design(name, word, (width, height, tall), solids, paints, symmetry, f"{name} {word}")


# --- things of no kind ------------------------------------------------------------------------


def _slab(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    return [_box(0, 0, t / 2, w / 2, h / 2, t / 2)]


def _dish(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    return [Solid("cup", (w / 2, h / 2, t / 2), (0, 0, t / 2), FLAT, c.uniform(0.4, 0.8), 1.0)]


def _peak(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    return [_round(0, t, w / 2, h / 2, 1.0, c.uniform(0.02, 0.35))]


def _rod(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    turned = lying()
    tip = Solid("cone", (t / 2, h / 2, 0.06 * w), (0.44 * w, 0, t / 2), turned, 1.0, 0.1, 1)
    return [Solid("cone", (t / 2, h / 2, 0.44 * w), (-0.06 * w, 0, t / 2), turned), tip]


def _spoon(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    head = _ball(0.36 * w, 0, t / 2, 0.14 * w, h / 2, t / 2)
    return [head, _box(-0.12 * w, 0, t / 2, 0.38 * w, 0.14 * h, 0.3 * t, 1)]


def _car(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    wheels = [
        Solid("ball", (0.13 * w, 0.1 * h, 0.2 * t), (sx * 0.3 * w, sy * 0.4 * h, 0.2 * t), FLAT,
              paint=1)
        for sx in (-1, 1) for sy in (-1, 1)
    ]  # fmt: skip
    body = _box(0, 0, 0.4 * t, w / 2, 0.45 * h, 0.22 * t)
    return [body, _box(-0.05 * w, 0, 0.75 * t, 0.25 * w, 0.4 * h, 0.25 * t, 1), *wheels]


def _duck(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    body = _ball(-0.1 * w, 0, 0.3 * t, 0.4 * w, h / 2, 0.3 * t)
    head = _ball(0.2 * w, 0, 0.75 * t, 0.2 * w, 0.3 * h, 0.25 * t)
    return [body, head, _ball(0.42 * w, 0, 0.7 * t, 0.08 * w, 0.12 * h, 0.06 * t, 1)]


def _mushroom(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    return [
        _round(0, 0.6 * t, 0.2 * w, 0.2 * h, paint=1),
        _ball(0, 0, 0.6 * t, w / 2, h / 2, 0.4 * t),
    ]


def _angle(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    arm = c.uniform(0.15, 0.25)
    return [
        _box(0, (arm - 0.5) * h, t / 2, w / 2, arm * h, t / 2),
        _box((arm - 0.5) * w, 0, t / 2, arm * w, h / 2, t / 2, c.choice((0, 1))),
    ]


def _tower(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    split = c.uniform(0.3, 0.7)
    top = c.uniform(0.3, 0.8)
    upper = _box(0, 0, (1 + split) / 2 * t, top * w / 2, top * h / 2, (1 - split) / 2 * t, 1)
    return [_box(0, 0, split / 2 * t, w / 2, h / 2, split / 2 * t), upper]


def _globe(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    return [_ball(0, 0, t / 2, w / 2, h / 2, t / 2)]


def _hat(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    brim = _round(0, 0.15 * t, w / 2, h / 2)
    return [brim, _round(0.15 * t, t, 0.3 * w, 0.3 * h, 1.0, c.uniform(0.5, 1.0), 1)]


def _ring(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    return [
        _ball((0.5 * w - t / 2) * math.cos(a), (0.5 * h - t / 2) * math.sin(a), t / 2,
              0.09 * w + t / 4, 0.09 * h + t / 4, t / 2, step % 2)
        for step, a in enumerate(np.linspace(0, math.tau, 12, endpoint=False).tolist())
    ]  # fmt: skip


def _cross(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    return [
        _box(0, 0, t / 2, w / 2, 0.16 * h, t / 2), _box(0, 0, t / 2, 0.16 * w, h / 2, t / 2, 1),
    ]  # fmt: skip


def _dumbbell(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    ends = [_ball(s * 0.33 * w, 0, t / 2, 0.17 * w, h / 2, t / 2) for s in (-1, 1)]
    return [*ends, _box(0, 0, t / 2, 0.3 * w, 0.12 * h, 0.15 * t, 1)]


def _table(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    legs = [
        _box(sx * 0.42 * w, sy * 0.42 * h, 0.4 * t, 0.08 * w, 0.08 * h, 0.4 * t, 1)
        for sx in (-1, 1) for sy in (-1, 1)
    ]  # fmt: skip
    return [*legs, _box(0, 0, 0.9 * t, w / 2, h / 2, 0.1 * t)]


def _snowman(c: random.Random, w: float, h: float, t: float) -> list[Solid]:
    return [
        _ball(0, 0, 0.3 * t, w / 2, h / 2, 0.3 * t),
        _ball(0, 0, 0.75 * t, 0.32 * w, 0.32 * h, 0.25 * t, 1),
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
    kind = {**SEEN, **UNSEEN}[family]
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

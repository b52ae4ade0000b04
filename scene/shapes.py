"""What the things of the training pictures are made of: 12 kinds, and things of no kind (pure).

A design is a thing standing at the origin, its footprint's centre there, unturned: solids (table
units), the paints they wear, its size, and the word for its colour. The 12 kinds and their sizes
are those of the robot's table (design: robot.md section 5); what is not one of them is `OTHER`.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np

from scene.colors import COLOR_VALUES, RGB
from scene.solids import Solid, upright

MM = 0.005
"""Table units in a millimetre, on a table of 0.40 m."""


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


def ball(x: float, y: float, z: float, a: float, b: float, c: float, paint: int = 0) -> Solid:
    """An ellipsoid about x, y, z, with these half axes."""
    return Solid("ball", (a, b, c), (x, y, z), FLAT, paint=paint)


def box(x: float, y: float, z: float, a: float, b: float, c: float, paint: int = 0) -> Solid:
    """A box about x, y, z, with these half sides."""
    return Solid("box", (a, b, c), (x, y, z), FLAT, paint=paint)


def drum(
    z0: float, z1: float, a: float, b: float, low: float = 1.0, high: float = 1.0, paint: int = 0
) -> Solid:
    """An upright piece of a cone, from z0 to z1, with half axes ``low`` to ``high`` of a, b."""
    return Solid(
        "cone", (a, b, (z1 - z0) / 2), (0.0, 0.0, (z0 + z1) / 2), FLAT, low, high, paint
    )  # fmt: skip


def _apple(chance: random.Random, w: float, h: float, t: float) -> list[Solid]:
    tilt = chance.uniform(-0.1, 0.1) * w
    stalk = Solid("cone", (0.03 * w, 0.03 * w, 0.06 * t), (tilt, 0, 0.94 * t), FLAT, paint=1)
    return [ball(0, 0, 0.47 * t, w / 2, h / 2, 0.47 * t), stalk]


def _orange(chance: random.Random, w: float, h: float, t: float) -> list[Solid]:
    return [
        ball(0, 0, t / 2, w / 2, h / 2, t / 2),
        ball(chance.uniform(-0.2, 0.2) * w, 0, 0.95 * t, 0.05 * w, 0.05 * h, 0.04 * t, 1),
    ]


def _lemon(chance: random.Random, w: float, h: float, t: float) -> list[Solid]:
    tips = [ball(s * 0.40 * w, 0, t / 2, 0.10 * w, 0.2 * h, 0.2 * t) for s in (-1, 1)]
    return [ball(0, 0, t / 2, 0.46 * w, h / 2, t / 2), *tips]


def _pear(chance: random.Random, w: float, h: float, t: float) -> list[Solid]:
    big = ball(-0.5 * w + 0.32 * w, 0, t / 2, 0.32 * w, h / 2, t / 2)
    neck = ball(0.06 * w, 0, 0.45 * t, 0.30 * w, 0.36 * h, 0.36 * t)
    top = ball(0.26 * w, 0, 0.42 * t, 0.18 * w, 0.24 * h, 0.24 * t)
    stalk = box(0.45 * w, 0, 0.42 * t, 0.05 * w, 0.02 * w, 0.02 * w, 1)
    return [big, neck, top, stalk]


def _banana(chance: random.Random, w: float, h: float, t: float) -> list[Solid]:
    band, solids = chance.uniform(0.28, 0.34) * h, []
    for step in range(-4, 5):
        off = step / 4
        thick = 1 - 0.45 * off * off
        y = (h / 2 - band) * (1 - 2 * off * off) * (1 if abs(off) < 1 else 0.9)
        length = 0.115 * w if abs(step) < 4 else 0.07 * w
        x = off * (w / 2 - 0.07 * w)
        solids.append(ball(x, y, 0.5 * t * thick, length, band * thick, 0.5 * t * thick, 0))
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
        ball(w / 2 - reach + (reach - 0.05 * h) * math.cos(a), 0, 0.55 * t + rise * math.sin(a),
              0.05 * h, 0.06 * h, 0.09 * t)
        for a in np.linspace(-1.4, 1.4, 8).tolist()
    ]  # fmt: skip
    return [body, *ring]


def _bottle(chance: random.Random, w: float, h: float, t: float) -> list[Solid]:
    a, b, neck = w / 2, h / 2, chance.uniform(0.32, 0.46)
    shoulder, foot = chance.uniform(0.55, 0.66), chance.uniform(0.72, 0.84)
    return [
        drum(0, shoulder * t, a, b),
        drum(shoulder * t, foot * t, a, b, 1.0, neck),
        drum(foot * t, 0.92 * t, a, b, neck, neck),
        drum(0.90 * t, t, a, b, neck * 1.12, neck * 1.12, 1),
        drum(0.15 * t, 0.45 * t, 1.01 * a, 1.01 * b, paint=2),
    ]


def _can(chance: random.Random, w: float, h: float, t: float) -> list[Solid]:
    a, b = w / 2, h / 2
    return [
        drum(0.04 * t, 0.94 * t, a, b),
        drum(0.0, 0.04 * t, a, b, 0.9, 1.0, 1),
        drum(0.94 * t, t, a, b, 1.0, 0.9, 1),
    ]


def _padlock(chance: random.Random, w: float, h: float, t: float) -> list[Solid]:
    body, thick = 0.58 * t, 0.11 * w
    bow = [
        ball(0.32 * w * math.cos(a), 0, body + (t - body - thick) * math.sin(a),
              thick, min(thick, 0.35 * h), thick, 1)
        for a in np.linspace(0, math.pi, 11).tolist()
    ]  # fmt: skip
    return [box(0, 0, body / 2, w / 2, h / 2, body / 2), *bow]


def _magnet(chance: random.Random, w: float, h: float, t: float) -> list[Solid]:
    split = chance.uniform(-0.05, 0.25)
    left, right = (split + 0.5) * w, (0.5 - split) * w
    return [
        box(-w / 2 + left / 2, 0, t / 2, left / 2, h / 2, t / 2),
        box(w / 2 - right / 2, 0, t / 2, right / 2, h / 2, t / 2, 1),
    ]


def _block(chance: random.Random, w: float, h: float, t: float) -> list[Solid]:
    return [box(0, 0, t / 2, w / 2, h / 2, t / 2)]


def _matchbox(chance: random.Random, w: float, h: float, t: float) -> list[Solid]:
    sides = box(0, 0, t / 2, w / 2, h / 2, 0.48 * t, 1)
    return [sides, box(0, 0, t / 2, 0.499 * w, 0.46 * h, t / 2)]


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

"""Random tables and their pictures, for training and tests of the detector: seeded, pure.

Everything that differs between rooms is drawn: camera, light, table, things, clutter, an arm in
the picture, and what a cheap camera does to it (blur, noise, JPEG). Lengths are table units.
"""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from scene.peaks import folded
from scene.render import Drawn, Standing, draw, looked_at
from scene.shapes import KINDS, Design, Paint, of_kind, shade
from scene.sight import Picture, View
from scene.solids import Array, Solid, moved, upright
from scene.strange import SEEN, UNSEEN, numbered, strange
from scene.surroundings import developed, random_ground, random_light

NUMBERED = 240
"""So many things of no kind appear again and again, so that features can learn to tell them."""
LEAST_STRANGE, MOST_BOX, BOXES = 0.75, 1.25, frozenset({"block", "magnet", "matchbox"})
"""Where all is bigger or smaller, a strange box is no smaller, and a known one no bigger: by what
else could they be told apart?"""
SHOWN = 0.35
"""Things of which less is seen are no fault of a detector that misses them."""


class Label(NamedTuple):
    """What is true of one thing; as a `Detection` (``r`` in (-pi/4, pi/4]: see `folded`).

    ``seen``: the share of it that nothing hides. ``look``: things of one look are alike.
    ``family``: of what family a thing of no kind is.
    ``box``: left, top, right, bottom in the picture, of all of it; None where not known.
    """

    name: str
    color: str | None
    x: float
    y: float
    width: float
    height: float
    tall: float
    r: float
    round: bool
    seen: float
    look: str
    box: tuple[float, float, float, float] | None
    family: str = ""


class Sight(NamedTuple):
    """A picture, how it shows the table, and what is on it."""

    picture: Picture
    view: View
    labels: tuple[Label, ...]


class Terms(NamedTuple):
    """What may be drawn: camera height and tilt (degrees), gain of the light, things of no kind."""

    height: tuple[float, float] = (2.3, 6.3)
    tilt: tuple[float, float] = (0.0, 18.0)
    gain: tuple[float, float] = (0.45, 1.6)
    families: tuple[str, ...] = tuple(SEEN)
    strange: float = 0.28
    wide: float = 0.35
    most: int = 11


# --- camera -----------------------------------------------------------------------------------


def camera_view(
    camera: tuple[float, float, float],
    target: tuple[float, float],
    roll: float,
    focal: float,
    width: int,
    height: int,
) -> View:
    """How a pinhole camera at a place, looking at a point of the table, shows it.

    ``focal`` in pixels; ``roll`` (radians) turns the camera about its axis; without it, y of the
    table is up in the picture.
    """
    centre = np.array(camera)
    ahead = np.array((*target, 0.0)) - centre
    ahead /= np.linalg.norm(ahead)
    right = np.cross(ahead, (math.sin(roll), math.cos(roll), 0.0))
    right /= np.linalg.norm(right)
    turn = np.stack([right, np.cross(ahead, right), ahead])
    lens = np.array(
        [[focal, 0, (width - 1) / 2], [0, focal, (height - 1) / 2], [0, 0, 1]], np.float64
    )
    flat = np.column_stack([turn[:, 0], turn[:, 1], -turn @ centre])
    return View(lens @ flat, camera)


def level_view(camera: tuple[float, float, float], half: float, size: int) -> View:
    """A picture (size, size) rectified to the table: the square +-``half``, far side up."""
    scale = size / (2 * half)
    middle = (size - 1) / 2
    return View(np.array([[scale, 0, middle], [0, -scale, middle], [0, 0, 1.0]]), camera)


def random_camera(chance: random.Random, terms: Terms) -> tuple[float, float, float]:
    """A place above the table from which the middle is seen at a tilt."""
    high = math.exp(chance.uniform(*(math.log(end) for end in terms.height)))
    tilt, side = math.radians(chance.uniform(*terms.tilt)), chance.uniform(0, math.tau)
    away = high * math.tan(tilt)
    return away * math.cos(side), away * math.sin(side), high


# --- what stands there ------------------------------------------------------------------------


def random_designs(chance: random.Random, terms: Terms) -> list[Design]:
    """Things for one table: kinds at their own sizes, or all of them much bigger or smaller."""
    wide = chance.random() < terms.wide
    overall = math.exp(chance.uniform(-1.1, 0.5)) if wide else 1.0
    designs = []
    for _ in range(chance.randint(0, terms.most)):
        scale = overall * chance.uniform(0.90, 1.08) * (chance.uniform(0.8, 1.25) if wide else 1)
        if chance.random() < terms.strange:
            again = chance.random() < 0.4 and not UNSEEN.keys() & terms.families
            designs.append(
                numbered(chance.randrange(NUMBERED), terms.families) if again
                else strange(chance, terms.families, max(LEAST_STRANGE, scale))
            )  # fmt: skip
        else:
            name = chance.choice(tuple(KINDS))
            most = MOST_BOX if name in BOXES else math.inf
            designs.append(of_kind(chance, name, min(scale, most), skew=0.12 if wide else 0.0))
    return designs


def placed(
    chance: random.Random, designs: Sequence[Design], span: float = 0.95
) -> list[tuple[Design, Standing]]:
    """Things where they find room, any way round; those that find none are left out."""
    taken: list[tuple[float, float, float]] = []
    result = []
    gap = chance.choice((0.0, 0.02, 0.08))
    for design in sorted(designs, key=lambda one: -one.size[0] * one.size[1]):
        reach = 0.5 * math.hypot(design.size[0], design.size[1])
        if design.symmetry == 0:
            reach = design.size[0] / 2
        for _ in range(30):
            x, y = chance.uniform(-span, span), chance.uniform(-span, span)
            if all(math.hypot(x - a, y - b) > reach + c + gap for a, b, c in taken):
                taken.append((x, y, reach))
                yaw = chance.uniform(-math.pi, math.pi) if chance.random() < 0.7 else 0.0
                result.append((design, standing(design, x, y, yaw)))
                break
    return result


def standing(design: Design, x: float, y: float, yaw: float) -> Standing:
    """A design put at a place of the table."""
    solids = tuple(moved(solid, x, y, yaw) for solid in design.solids)
    return Standing(solids, design.paints, x, y, yaw, design.size)


def _arm(chance: random.Random) -> Standing:
    """Bars from the near edge to a tool above the table, as a small arm has them."""
    x, y, high = chance.uniform(-0.9, 0.9), chance.uniform(-1.0, 0.8), chance.uniform(0.25, 1.0)
    base_x, base_y = chance.uniform(-0.4, 0.4), chance.uniform(-2.2, -1.3)
    yaw, long = math.atan2(y - base_y, x - base_x), math.hypot(x - base_x, y - base_y)
    thick = chance.uniform(0.05, 0.12)
    word = chance.choice(("gray", "white", "silver", "black", "orange"))
    paint = Paint(shade(chance, word), shade(chance, word), shine=0.2)
    middle = ((x + base_x) / 2, (y + base_y) / 2, high + 0.4)
    bar = Solid("box", (long / 2, thick, 0.08), middle, upright(yaw))
    tool = Solid("cone", (0.09, 0.09, 0.25), (x, y, high + 0.25), upright(), 0.4, 1.0)
    return Standing((bar, tool), (paint,), x, y, yaw, (1.0, 1.0, 1.0))


# --- together ---------------------------------------------------------------------------------


def labelled(pairs: Sequence[tuple[Design, Standing]], drawn: Drawn) -> list[Label]:
    """What is true of the things drawn; those quite outside of the picture are left out."""
    labels = []
    for number, (design, thing) in enumerate(pairs):
        if np.isnan(drawn.boxes[number, 0]):
            continue
        turned = design.symmetry == 0
        width, height, r = folded(*design.size[:2], 0.0 if turned else thing.yaw)
        left, top, right, bottom = drawn.boxes[number].tolist()
        labels.append(
            Label(design.name, design.color, thing.x, thing.y, width, height, design.size[2], r,
                  turned, float(drawn.shares[number]), design.look, (left, top, right, bottom),
                  design.family)
        )  # fmt: skip
    return labels


def level_sight(seed: int | str, terms: Terms, half: float, size: int) -> Sight:
    """A random table, rectified: drawn half as large again as ``size`` (even), and shrunk."""
    chance = random.Random(seed)
    camera = random_camera(chance, terms)
    finer = size * 3 // 2
    drawn, labels = _drawn(chance, terms, level_view(camera, half, finer), finer, finer)
    labels = [one._replace(box=_shrunk(one.box)) for one in labels]
    pixels = developed(chance, thirds(drawn.pixels))
    return Sight(Picture(pixels, 0.0), level_view(camera, half, size), tuple(labels))


def thirds(plane: Array) -> Array:
    """A plane (3 n, 3 m, ...) with each 3 x 3 pixels averaged, by area, into 2 x 2."""
    for axis in (0, 1):
        rows = np.moveaxis(plane, axis, 0)
        a, b, c = rows[0::3], rows[1::3], rows[2::3]
        shrunk = np.empty((2 * len(a), *rows.shape[1:]), np.float32)
        shrunk[0::2], shrunk[1::2] = (2 * a + b) / 3, (b + 2 * c) / 3
        plane = np.moveaxis(shrunk, 0, axis)
    return plane


def _shrunk(box: tuple[float, float, float, float] | None) -> tuple[float, float, float, float]:
    assert box is not None
    left, top, right, bottom = ((edge + 0.5) / 1.5 - 0.5 for edge in box)
    return left, top, right, bottom


def camera_sight(
    seed: int | str,
    terms: Terms,
    width: int,
    height: int,
    half: float = 1.2,
    more: Sequence[Design] = (),
) -> Sight:
    """A random table as a camera delivers it; all of the table is in the picture.

    ``more``: things that are there besides those drawn, if they find room.
    """
    chance = random.Random(seed)
    place = random_camera(chance, terms)
    target = (chance.uniform(-0.05, 0.05), chance.uniform(-0.05, 0.05))
    roll = chance.uniform(-0.15, 0.15)
    wide = camera_view(place, target, roll, 1.0, width, height)
    square = np.array([(a, b) for a in (-half, half) for b in (-half, half)])
    reach = np.abs(wide.pixels(square) - [(width - 1) / 2, (height - 1) / 2]).max(0)
    focal = min(width / 2 / reach[0], height / 2 / reach[1])
    view = camera_view(place, target, roll, float(focal), width, height)
    drawn, labels = _drawn(chance, terms, view, width, height, more)
    return Sight(Picture(developed(chance, drawn.pixels), 0.0), view, tuple(labels))


def _drawn(
    chance: random.Random,
    terms: Terms,
    view: View,
    width: int,
    height: int,
    more: Sequence[Design] = (),
) -> tuple[Drawn, list[Label]]:
    points = looked_at(view, width, height)
    designs = [*random_designs(chance, terms), *more]
    ground = random_ground(chance, points)
    pairs = placed(chance, designs)
    things = [thing for _, thing in pairs]
    arm = [_arm(chance)] if chance.random() < 0.2 else []
    light = random_light(chance, math.exp(chance.uniform(*map(math.log, terms.gain))))
    drawn = draw([*things, *arm], view, points, ground, light)
    if arm:
        drawn = drawn._replace(shares=drawn.shares[:-1], boxes=drawn.boxes[:-1])
    return drawn, labelled(pairs, drawn)

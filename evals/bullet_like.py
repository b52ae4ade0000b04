"""Tables that look like PyBullet's overhead picture, drawn without PyBullet, much faster. Seeded.

The same shapes (`robot_bridge.objects`) in the same places, in the light that its renderer has
(no shadows); so lessons can be drawn where there is no wheel of it, in any number.
"""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from robot_bridge.api import PARK
from robot_bridge.bullet import CAMERA_HEIGHT, VIEW
from robot_bridge.drawing import PALE, arm_links
from robot_bridge.objects import Model, model
from scene.colors import COLOR_VALUES, RGB, SEEN_COLORS
from scene.generate import CLASSES, SPREAD
from scene.kinds import is_container
from scene.lean import seen_at
from scene.peaks import OTHER, folded
from scene.pictured import Label, Sight
from scene.render import Light, Standing, draw, looked_at
from scene.shapes import FLAT, KINDS, MM, Paint
from scene.sight import Picture, View
from scene.solids import Array, Solid, moved, upright
from scene.types import EDGE, Pose

KNOWN = tuple(sorted(KINDS))
STRANGE = ("plate", "bowl", "box", "tray", "book", "spoon", "pen", "shoe", "sponge")
"""Nouns of no kind that the detector is shown; in this simulator all are boxes or open pots."""
ALIKE = (
    "peach", "plum", "strawberry", "tomato", "potato", "egg", "mug", "glass", "jar", "vase", "cube",
    "ball", "cylinder", "coin", "candle", "eraser", "key", "star", "toy", "scissors", "duck",
)  # fmt: skip
"""Nouns that look, or may look, like a kind: they are to be seen, whatever they are called."""
ANGULAR = frozenset({"block", "magnet", "matchbox"})
"""Here told apart by nothing but their sizes, so they come in no others."""
ROUND = frozenset({"apple", "orange", "lemon", "pear", "bottle", "can", "plate", "bowl", "pan"})
LIGHT = Light((-0.392, 0.236, 0.889), (0.378,) * 3, (0.6,) * 3, 0.0, even=1.0, casts=False)
"""Fitted to its pictures: of what it shines besides, little is left out."""
TABLE, FLOOR, ARM, TOOL = (
    (0.80, 0.76, 0.70),
    (0.45, 0.45, 0.48),
    (0.85, 0.86, 0.88),
    (0.2, 0.2, 0.25),
)
SIZES = ((320, 240), (320, 240), (480, 360))
UNASKED = ""
"""A label's name where nothing is asked about the kind."""


BEARING = frozenset({"thing", "book", "box", "tray", "plate", "bowl", "block", "sponge"})
"""Nouns of things that others stand on, or in."""


class Item(NamedTuple):
    """A thing of the simulator's: its noun, how it is called (a kind, `OTHER`, `UNASKED`), size."""

    noun: str
    called: str
    size: tuple[float, float, float]
    color: str | None


class Place(NamedTuple):
    """A thing where it stands: ``z`` is the height of its base."""

    item: Item
    x: float
    y: float
    r: float
    z: float = 0.0


def bullet_like(seed: str, wide: float = 0.5) -> Sight:
    """A random table; ``wide``: how often things of kinds are of any size."""
    chance = random.Random(seed)
    width, height = chance.choice(SIZES)
    places = _stacked(chance, _placed(chance, _items(chance, wide)))
    tip = Pose(chance.uniform(-1, 1), chance.uniform(-1.2, 0.9), chance.uniform(0.3, 1.2))
    return pictured(places, tip if chance.random() < 0.5 else PARK, width, height)


def straight(width: int, height: int) -> View:
    """How that picture shows the table; sampled in the middles of its pixels, as PyBullet's is not
    (`robot_bridge.bullet.overhead`)."""
    scale = height / (2 * VIEW)
    matrix = [[scale, 0, (width - 1) / 2], [0, -scale, (height - 1) / 2], [0, 0, 1]]
    return View(np.array(matrix, np.float64), (0.0, 0.0, CAMERA_HEIGHT))


def pictured(places: Sequence[Place], tip: Pose, width: int, height: int) -> Sight:
    """These things, and the arm with its tool's tip at a pose."""
    things = [*(_standing(place) for place in places), *_arm(tip)]
    view = straight(2 * width, 2 * height)
    points = looked_at(view, 2 * width, 2 * height)
    table = (np.abs(points).max(0) <= EDGE)[..., None]
    ground = np.where(table, np.array(TABLE, np.float32), np.array(FLOOR, np.float32))
    drawn = draw(things, view, points, ground, LIGHT)
    shades = (255 * np.clip(drawn.pixels, 0, 1)).astype(np.uint8).astype(np.float32)
    pixels = shades.reshape(height, 2, width, 2, 3).mean((1, 3)).astype(np.uint8)
    labels = tuple(
        _label(place, float(drawn.shares[n]), drawn.boxes[n])
        for n, place in enumerate(places) if not np.isnan(drawn.boxes[n, 0])
    )  # fmt: skip
    return Sight(Picture(pixels, 0.0), straight(width, height), labels)


# --- which things, and where ------------------------------------------------------------------


def _items(chance: random.Random, wide: float) -> list[Item]:
    overall = math.exp(chance.uniform(-1.25, 0.4)) if chance.random() < wide else 1.0
    return [_item(chance, overall) for _ in range(chance.randint(1, 10))]


def _item(chance: random.Random, overall: float) -> Item:
    what = chance.random()
    if what < 0.55:
        return _known(chance, chance.choice(KNOWN), overall)
    if what < 0.65:
        return _of_noun(chance, chance.choice(STRANGE), OTHER, 1.0)
    if what < 0.80:
        return _of_noun(chance, chance.choice(ALIKE), UNASKED, chance.choice((1.0, overall)))
    return _invented(chance)


def _known(chance: random.Random, name: str, overall: float) -> Item:
    scale = 1.0 if name in ANGULAR else overall
    size = [side * MM for side in KINDS[name].size] if chance.random() < 0.5 else None
    return _of_noun(chance, name, name, scale, size)


def _of_noun(
    chance: random.Random, noun: str, called: str, scale: float, size: Sequence[float] | None = None
) -> Item:
    kind = CLASSES[noun]
    scale *= chance.uniform(*SPREAD)
    w, h, t = (round(scale * side, 3) for side in size or (kind.width, kind.height, kind.tall))
    colors = [*kind.colors, *(KINDS[noun].colors if noun in KINDS else ())]
    color = chance.choice(colors) if colors and chance.random() < 0.9 else None
    return Item(noun, called, (w, h, t), color)


def _invented(chance: random.Random) -> Item:
    """A box or a flat pot of no kind, of any size that is not nearly a kind's, in any colour."""
    color = chance.choice((None, *COLOR_VALUES))
    if chance.random() < 0.3:
        side = math.exp(chance.uniform(math.log(0.2), math.log(0.75)))
        other = side * (chance.uniform(0.6, 1.0) if chance.random() < 0.3 else 1.0)
        tall = chance.uniform(0.1, 0.5) * side
        return Item(chance.choice(("bowl", "tray", "box")), OTHER, (side, other, tall), color)
    while True:
        long = math.exp(chance.uniform(math.log(0.12), math.log(0.85)))
        broad = long * math.exp(chance.uniform(math.log(0.1), 0))
        tall = math.exp(chance.uniform(math.log(0.05), math.log(0.5)))
        size = (long, max(0.06, broad), tall)
        if not any(_near(size, name) for name in ANGULAR):
            return Item("thing", OTHER, size, color)


def _near(size: Sequence[float], name: str) -> bool:
    """Whether a box is within a quarter of a kind's sizes."""
    kind = CLASSES[name]
    made = ((kind.width, kind.height, kind.tall), tuple(side * MM for side in KINDS[name].size))
    return any(
        all(abs(math.log(a / b)) < 0.25 for a, b in zip(size, one, strict=True)) for one in made
    )


def _placed(chance: random.Random, items: Sequence[Item]) -> list[Place]:
    found = list[Place]()
    turned, gap = chance.random() < 0.7, chance.choice((0.0, 0.03, 0.1))
    for item in items:
        r = chance.uniform(-math.pi, math.pi) if turned else 0.0
        reach = math.hypot(*item.size[:2]) / 2
        for _ in range(20):
            x, y = chance.uniform(-0.95, 0.95), chance.uniform(-0.95, 0.95)
            if all(math.dist((x, y), (a, b)) > reach + gap + math.hypot(*o.size[:2]) / 2
                   for o, a, b, *_ in found):  # fmt: skip
                found.append(Place(item, x, y, r))
                break
    return found


def _stacked(chance: random.Random, places: Sequence[Place]) -> list[Place]:
    """The same, and now and then one more thing on, or in, one of them."""
    found = list(places)
    for under in places:
        if under.item.noun not in BEARING or chance.random() > 0.3:
            continue
        width, height, tall = under.item.size
        room = 0.85 * min(width, height)
        item = _item(chance, 1.0)
        if math.hypot(*item.size[:2]) > room:
            continue
        inside = is_container(under.item.noun)
        slack = 0.5 * (room - math.hypot(*item.size[:2]))
        x, y = under.x + chance.uniform(-slack, slack), under.y + chance.uniform(-slack, slack)
        r = chance.uniform(-math.pi, math.pi)
        found.append(Place(item, x, y, r, min(0.03, 0.1 * tall) if inside else tall))
    return found


def _label(place: Place, share: float, box: Array) -> Label:
    """What is true of a thing; of one that stands higher, as if the table were as high there.

    So it is seen, and so it is told: who knows on what it stands puts it where it is.
    """
    item, (width, height, tall) = place.item, place.item.size
    even = abs(width - height) < 1e-3 and (item.noun in ROUND or item.noun in ALIKE[:12])
    color = item.color if item.color in SEEN_COLORS else None
    left, top, right, bottom = ((float(edge) + 0.5) / 2 - 0.5 for edge in box)
    x, y = seen_at((place.x, place.y), place.z, (0.0, 0.0, CAMERA_HEIGHT))
    nearer = CAMERA_HEIGHT / (CAMERA_HEIGHT - place.z)
    sides = folded(nearer * width, nearer * height, 0.0 if even else place.r)
    return Label(
        item.called, color, x, y, sides[0], sides[1], nearer * tall, sides[2], even, share,
        f"{item.noun} {item.color}", (left, top, right, bottom), item.noun,
    )  # fmt: skip


# --- how they look ----------------------------------------------------------------------------


def _paint(color: RGB) -> Paint:
    red, green, blue = (part ** (1 / 2.2) for part in color)
    return Paint((red, green, blue), (red, green, blue), shine=0.0)


def _standing(place: Place) -> Standing:
    item, x, y, r, z = place
    solids = tuple(
        moved(one._replace(at=(one.at[0], one.at[1], one.at[2] + z)), x, y, r)
        for one in _solids(model(item.noun, *item.size), item.size)
    )
    color = COLOR_VALUES.get(item.color or "", PALE)
    return Standing(solids, (_paint(color),), x, y, r, item.size)


def _solids(made: Model, size: tuple[float, float, float]) -> list[Solid]:
    """A model's parts, or its rings as pieces of cones, standing on the table."""
    middle = size[2] / 2
    parts = [
        Solid("box", one.half, (one.at[0], one.at[1], one.at[2] + middle), upright(one.yaw))
        for one in made.parts
    ]
    for low, high in zip(made.rings, made.rings[1:], strict=False):
        bottom, top = low[0][2], high[0][2]
        half = (size[0] / 2, size[1] / 2, (top - bottom) / 2)
        shares = (2 * low[0][0] / size[0], 2 * high[0][0] / size[0])
        at = (bottom + top) / 2
        parts.append(Solid("cone", half, (0.0, 0.0, at + middle), FLAT, *shares, bulge=at))
    return parts


def _arm(tip: Pose) -> list[Standing]:
    """The drawn arm, and its tool, above a pose."""
    bars = [Solid("box", *_bar(link.start, link.end, link.thick)) for link in arm_links(tip)]
    tool = Solid("cone", (0.04, 0.04, 0.25), (tip.x, tip.y, tip.z + 0.25), FLAT)
    one = (1.0, 1.0, 1.0)
    return [
        Standing(tuple(bars), (_paint(ARM),), 0.0, 0.0, 0.0, one),
        Standing((tool,), (_paint(TOOL),), 0.0, 0.0, 0.0, one),
    ]


def _bar(
    start: tuple[float, float, float], end: tuple[float, float, float], thick: float
) -> tuple[tuple[float, float, float], tuple[float, float, float], Array]:
    """Half sides, middle and turn of a bar from end to end."""
    span = np.array(end) - np.array(start)
    long = float(np.linalg.norm(span))
    pitch, yaw = math.acos(max(-1.0, min(1.0, span[2] / long))), math.atan2(span[1], span[0])
    cos, sin = math.cos(pitch), math.sin(pitch)
    tilt = np.array([[cos, 0, sin], [0, 1, 0], [-sin, 0, cos]], np.float32)
    x, y, z = ((np.array(start) + np.array(end)) / 2).tolist()
    turn: Array = (upright(yaw) @ tilt).astype(np.float32)
    return (thick / 2, thick / 2, long / 2), (x, y, z), turn

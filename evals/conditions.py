"""What may hold before a program runs: conditions of a sentence, and room to carry it out.

These are words of `evals.postconditions` too: ``given`` says of which scenes a pair speaks,
``if CONDITION then LINE`` states the outcome of a sentence with a condition. They look at the
scene before; `room` also at the path, so that it knows where things are let go.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise

import msgspec

from evals.world import World
from robot_bridge.contact import FRICTION
from scene.relations import ALONG, extents
from scene.types import EDGE, SceneObject

MARGIN = 0.05
"""Least clearance beside the lane of a push (table units)."""


def _taller(world: World, one: str, other: str) -> bool:
    return world.was(one).tall > world.was(other).tall


def _wider(world: World, one: str, other: str) -> bool:
    return world.was(one).width > world.was(other).width


def _x_less(world: World, one: str, other: str) -> bool:
    return world.was(one).position[0] < world.was(other).position[0]


def _y_less(world: World, one: str, other: str) -> bool:
    return world.was(one).position[1] < world.was(other).position[1]


def _x_negative(world: World, one: str) -> bool:
    return world.was(one).position[0] < 0


def _lane(world: World, one: str, direction: str) -> bool:
    """Nothing else stands in the strip that the object would sweep from here to the edge."""
    (dx, dy), item = ALONG[direction], world.was(one)
    x, y = item.position
    half_x, half_y = extents(item)
    for other in world.before.objects:
        (x2, y2), (w2, h2) = other.position, extents(other)
        across = abs((x2 - x) * dy + (y2 - y) * dx)
        wide = (half_y + h2 if dx else half_x + w2) + MARGIN
        ahead = (x2 - x) * dx + (y2 - y) * dy > 0
        if other.id != item.id and ahead and across < wide:
            return False
    return True


def _free_by(world: World, one: str, dx: str, dy: str) -> bool:
    """Shifted by this (table units), the object would stand on the table and meet nothing."""
    item = world.was(one)
    x, y = item.position
    there = msgspec.structs.replace(item, x=x + float(dx), y=y + float(dy))
    return _fits(there, [other for other in world.before.objects if other.id != item.id])


def _abut(world: World, one: str, other: str) -> bool:
    """They stand side by side, the other to the right, a finger apart, and are as tall."""
    a, b = world.was(one), world.was(other)
    apart = b.position[0] - a.position[0] - (a.width + b.width) / 2
    level = abs(a.tall - b.tall) < 1e-6 and abs(a.position[1] - b.position[1]) < 1e-6
    clear = all(
        max(abs(b.position[0] - o.position[0]) - (b.width + o.width) / 2,
            abs(b.position[1] - o.position[1]) - (b.height + o.height) / 2) > 0
        for o in world.before.objects if o.id not in (a.id, b.id)
    )  # fmt: skip
    return level and 0 < apart < 0.05 and clear and abs(b.position[0]) < 0.85


def _room(world: World) -> bool:
    """Wherever the program lets something go, the table is there and nothing else stands there.

    A program that came to no path has no room.
    """
    if not world.path:
        return False
    standing = {item.id: item for item in world.before.objects}
    held: SceneObject | None = None
    for command in world.path:
        if command.op != "grip":
            continue
        if command.grip:
            held = next((i for i in standing.values() if _covers(i, command.x, command.y)), None)
        elif held is not None:
            base = command.z - held.tall
            held = msgspec.structs.replace(held, x=command.x, y=command.y, z=base)
            if not _fits(held, [i for i in standing.values() if i.id != held.id]):
                return False
            standing[held.id] = held
            held = None
    return True


def _covers(item: SceneObject, x: float, y: float) -> bool:
    half_x, half_y = extents(item)
    return abs(item.position[0] - x) <= half_x and abs(item.position[1] - y) <= half_y


def _fits(item: SceneObject, others: list[SceneObject]) -> bool:
    """Whether the whole footprint is over the table and free down to the item's base."""
    (x, y), (half_x, half_y) = item.position, extents(item)
    if abs(x) + half_x > EDGE or abs(y) + half_y > EDGE:
        return False
    for other in others:
        (x2, y2), (w2, h2) = other.position, extents(other)
        if abs(x - x2) < half_x + w2 and abs(y - y2) < half_y + h2 and other.top > item.z + 1e-6:
            return False
    return True


def _slender(world: World, one: str) -> bool:
    """It is tall enough to fall over when its top is pushed along x or y."""
    item = world.was(one)
    return 0.95 * item.tall > max(item.width, item.height) / (2 * FRICTION) + 1e-6


def _clear(world: World, *nouns: str) -> bool:
    """Beside the tool's low ways there is room for the largest of these, and nothing stands."""
    named = [world.was(noun) for noun in nouns]
    reach = max((max(extents(item)) for item in named), default=0.0) + MARGIN
    ids = {item.id for item in named}
    moves = world.moves()
    for one, other in pairwise(moves):
        for item in world.before.objects:
            if item.id in ids or min(one.z, other.z) >= item.top:
                continue
            (x, y), (half_x, half_y) = item.position, extents(item)
            steps = max(1, math.ceil(math.dist((one.x, one.y), (other.x, other.y)) / 0.02))
            for step in range(steps + 1):
                at_x = one.x + (other.x - one.x) * step / steps
                at_y = one.y + (other.y - one.y) * step / steps
                if abs(at_x - x) < half_x + 2 * reach and abs(at_y - y) < half_y + 2 * reach:
                    return False
    return True


CONDITIONS: dict[str, Callable[..., bool]] = {
    "slender": _slender,
    "clear": _clear,
    "taller": _taller,
    "wider": _wider,
    "x_less": _x_less,
    "y_less": _y_less,
    "x_negative": _x_negative,
    "lane": _lane,
    "free_by": _free_by,
    "room": _room,
    "abut": _abut,
}
"""Every condition by the word that names it."""

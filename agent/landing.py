"""What letting a thing go comes to: where it lands, on what, and what that moves besides (pure).

``before`` and ``after`` are the predicted scenes on both sides of a release. Answers are what would
go wrong, as words behind "the apple would ...", or None.
"""

from __future__ import annotations

import math
from collections.abc import Collection

from agent.messages import Command, Kind
from agent.report import title
from scene.kinds import is_container
from scene.relations import extents, moved, upon
from scene.types import Scene, SceneObject

HEAP = 0.06
"""How far above a container's rim the base of what is heaped up in it may come to lie."""
SLIDE = 0.015
"""A released object that ends farther than this from where it was let go has slid off something."""
SINK = 0.03
"""How far below another object's top a release may aim and still mean "on it" (table units)."""
SUPPORT = 0.4
"""Least share of an object's width, along x and along y, that must be supported."""
LEVEL = 0.01
"""Tops that differ by no more carry a thing together."""
LEDGE = 0.03
"""With less of its width than this a thing carries nothing."""
TOUCH = 1e-3
"""Footprints that share less than this only touch."""


def landing(
    held: SceneObject, command: Command, before: Scene, after: Scene, kind: Kind
) -> str | None:
    """What is wrong with letting go here; None if it comes to rest where it is let go."""
    landed = after.get(held.id)
    if landed.on == "floor":
        return "be dropped off the table"
    carrier = next((item for item in after.objects if item.id == landed.on), None)
    heap = HEAP if carrier is not None and is_container(carrier.name) else -TOUCH
    if carrier is not None and landed.z < carrier.top + heap and _middle_over(landed, carrier):
        return None  # it lies in a container, or on what heaps up in one
    blocked = _in_the_way(held, command, before)
    if blocked is not None:
        return f"be put where {title(blocked, before)} stands"
    if math.dist(held.position, landed.position) > SLIDE:
        return f"slide off {_obstacle(held, before)}"
    if carrier is not None and not supported(landed, carrier, after, kind):
        return f"not stand safely on {title(carrier, before)}"
    return None


def unasked(held: SceneObject, after: Scene, expected: Collection[str] | None) -> str | None:
    """What is wrong with what carries the object now: nobody named it, nor did it stand there."""
    landed = after.get(held.id)
    carrier = next((item for item in after.objects if item.id == landed.on), None)
    if expected is None or carrier is None or carrier.id in expected:
        return None
    where = "in" if is_container(carrier.name) else "on"
    return f"end up {where} {title(carrier, after)}, and nobody asked for that"


def shoved(held: SceneObject, before: Scene, after: Scene) -> str | None:
    """What else letting go would move, by more than a hair (2 mm, as in `moved`): setting a thing
    down moves that thing alone, and what stands on it."""
    other = next((one for one in _others(held, before) if disturbed(one, after) is not None), None)
    return None if other is None else f"shove {title(other, before)} away where it is let go"


def knocked_off(load: SceneObject, before: Scene, after: Scene) -> SceneObject | None:
    """What a carry would knock off the thing that it stands on. What stands on the table itself may
    be pushed with a load (``push_with``)."""
    ids = {item.id for item in before.objects}
    stacked = (one for one in _others(load, before) if one.on in ids)
    return next((one for one in stacked if after.get(one.id).on != one.on), None)


def run_into(load: SceneObject, before: Scene, after: Scene) -> SceneObject | None:
    """What a carry moves or fells on its way."""
    end = {item.id: item for item in after.objects}
    return next(
        (one for one in _others(load, before)
         if one.id in end and (moved(one, end[one.id]) > 0 or end[one.id].upright != one.upright)),
        None,
    )  # fmt: skip


def _others(load: SceneObject, scene: Scene) -> list[SceneObject]:
    """All that is neither the load of the gripper nor stands on it."""
    own = {load.id} | upon(scene, load.id)
    return [item for item in scene.objects if item.id not in own]


def disturbed(item: SceneObject, scene: Scene) -> str | None:
    """What would happen to an object by then; None if nothing."""
    now = next((other for other in scene if other.id == item.id), None)
    if now is None:
        return "would be lost"
    if now.held != item.held:
        return "would be picked up" if now.held else "would be let go"
    if now.on == "floor" and item.on != "floor":
        return "would fall off the table"
    if now.upright != item.upright:
        return "would topple"
    if moved(item, now) > 0 or now.on != item.on:
        return "would be moved"
    return None


def _in_the_way(held: SceneObject, command: Command, scene: Scene) -> SceneObject | None:
    """What stands where the release aims: overlapping the footprint, higher than its base."""
    base = command.z - held.tall
    for other in standing(scene, held):
        if min(_shared(held, other)) > TOUCH and other.z < command.z and base < other.top - SINK:
            return other
    return None


def _obstacle(held: SceneObject, scene: Scene) -> str:
    below = [other for other in standing(scene, held) if min(_shared(held, other)) > 0]
    highest = max(below, key=lambda other: other.top, default=None)
    return "what is below" if highest is None else title(highest, scene)


def standing(scene: Scene, held: SceneObject | None) -> list[SceneObject]:
    """Objects that can be in the way of the held one: not it, not on it, not on the floor."""
    own = held.id if held is not None else "gripper"
    return [
        other
        for other in scene.objects
        if other.id != own and other.on not in ("floor", own) and not other.held
    ]


def supported(item: SceneObject, carrier: SceneObject, scene: Scene, kind: Kind) -> bool:
    """Whether its middle, and enough of it from one end of its supports to the other, rests on the
    carrier and on what is as high beside it; an arrange program knows no heights, so all."""
    share = 1.0 if kind == "arrange" else SUPPORT
    level = [
        other
        for other in standing(scene, item)
        if abs(other.top - carrier.top) <= LEVEL and min(_shared(item, other)) > LEDGE
    ]
    for axis, half in enumerate(extents(item)):
        middle = item.position[axis]
        ends = [
            (max(middle - half, other.position[axis] - extents(other)[axis]),
             min(middle + half, other.position[axis] + extents(other)[axis]))
            for other in (carrier, *level)
        ]  # fmt: skip
        low, high = min(low for low, _ in ends), max(high for _, high in ends)
        if high - low < share * 2 * half - TOUCH or not low - TOUCH <= middle <= high + TOUCH:
            return False
    return True


def _middle_over(item: SceneObject, carrier: SceneObject) -> bool:
    """Whether its middle is above the carrier's footprint."""
    (x, y), (at_x, at_y), (wide, deep) = item.position, carrier.position, extents(carrier)
    return abs(x - at_x) <= wide + TOUCH and abs(y - at_y) <= deep + TOUCH


def _shared(one: SceneObject, other: SceneObject) -> tuple[float, float]:
    """Overlap of two footprints along x and along y (negative: apart)."""
    (x1, y1), (x2, y2) = one.position, other.position
    (w1, h1), (w2, h2) = extents(one), extents(other)
    across = min(x1 + w1, x2 + w2) - max(x1 - w1, x2 - w2)
    return across, min(y1 + h1, y2 + h2) - max(y1 - h1, y2 - h2)

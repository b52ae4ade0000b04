"""What happened, in words: from the scenes before and after, never from the intention."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence

from agent.doubt import SURE, Doubt, slack
from agent.messages import Command
from scene.kinds import is_container
from scene.relations import ALONG, NEAR_M, at_edge, beside, centred, gap, moved, off_side
from scene.types import Scene, SceneObject

TOLERANCE = 0.02
"""How far an object may stand from where it was predicted (table units; 4 mm)."""

NEARLY = 0.012
"""From how far on what was moved is brought nearer while tries are left (table units; 2.4 mm): an
eye that errs a little may see within `TOLERANCE` what is not."""

LOOSE = 0.3
"""The same where it finds its own place: fallen over, in a container, in the gripper."""

MOVED = 0.01
"""From how far an object counts as moved (table units; 2 mm)."""

TURNED = 0.05
"""From how far an object counts as turned (radians)."""

_SIDES = {"left": "left", "right": "right", "above": "far", "below": "near"}
_WORDS = {
    "left": "left of", "right": "right of", "above": "behind", "below": "in front of",
}  # fmt: skip


def title(item: SceneObject, scene: Scene) -> str:
    """The object's name with the article; where names repeat, with its colour or id."""
    same = [other for other in scene if other.name == item.name]
    if len(same) == 1:
        return f"the {item.name}"
    if item.color and sum(other.color == item.color for other in same) == 1:
        return f"the {item.color} {item.name}"
    return f"the {item.name} ({item.id})"


def changed(
    before: Scene, after: Scene, doubt: Doubt = SURE
) -> list[tuple[SceneObject, SceneObject]]:
    """Objects that moved, turned, left the tray, were gripped, released or toppled: then, now.

    ``doubt``: of a place in one scene beside the other (`agent.doubt`).
    """
    now = {item.id: item for item in after}
    pairs = [(item, now[item.id]) for item in before if item.id in now]
    return [
        (old, new)
        for old, new in pairs
        if moved(old, new, max(MOVED, slack(doubt, new.id))) > 0
        or abs(turned(old, new)) > TURNED
        or (old.on, old.held, old.upright) != (new.on, new.held, new.upright)
    ]


def turned(before: SceneObject, after: SceneObject) -> float:
    """By how much an object was turned about z (radians, anticlockwise, the shorter way)."""
    return math.remainder(after.r - before.r, math.tau)


def describe(
    before: Scene, after: Scene, commands: Sequence[Command], named: Collection[str] = (),
    doubt: Doubt = SURE,
) -> str:  # fmt: skip
    """One or two plain sentences on what is different now; places by what the person ``named``."""
    sentences = [
        _turn(old, new, after) if _only_turned(old, new) else _sentence(new, after, named)
        for old, new in changed(before, after, doubt)
    ]
    if sentences:
        return " ".join(sentences)
    if any(command.op == "move" for command in commands):
        return "I made the motion; nothing on the table changed its place."
    return "There was nothing to move."


def _only_turned(old: SceneObject, new: SceneObject) -> bool:
    same = (old.on, old.held, old.upright) == (new.on, new.held, new.upright)
    return same and moved(old, new) == 0


def _turn(old: SceneObject, new: SceneObject, scene: Scene) -> str:
    angle = math.degrees(turned(old, new))
    way = "anticlockwise" if angle > 0 else "clockwise"
    name = title(new, scene)
    return f"{name[0].upper()}{name[1:]} is turned by {abs(angle):.0f}° {way} now."


def _sentence(item: SceneObject, scene: Scene, named: Collection[str] = ()) -> str:
    name = title(item, scene)
    name = name[0].upper() + name[1:]
    if item.held:
        return f"I hold {title(item, scene)}."
    if item.on == "floor":
        side = next((word for way, word in _SIDES.items() if off_side(item, way)), None)
        return f"{name} went off the {side} edge." if side else f"{name} is on the floor."
    if item.on == "tray":
        return f"{name} is in the tray."
    lying = "" if item.upright else ", lying on its side"
    if item.on not in ("table", "tray", "gripper"):
        carrier = scene.get(item.on)
        where = "in" if is_container(carrier.name) else "on"
        return f"{name} is {where} {title(carrier, scene)}{lying}."
    return f"{name} is {place(item, scene, named)} now{lying}."


def place(item: SceneObject, scene: Scene, named: Collection[str] = ()) -> str:
    """Where an object stands: by a near thing that was ``named``, a marked place of the table,
    another near thing, or a side of the table."""
    others = [one for one in scene.objects if one.id != item.id and one.on == "table"]
    edges = [_SIDES[side] for side in ALONG if at_edge(scene, item, side)]
    by_named = _beside(item, [one for one in others if one.id in named], scene)
    if by_named is not None:
        return by_named
    if centred(scene, item):
        return "in the middle of the table"
    if len(edges) == 2:
        return f"in the {edges[1]} {edges[0]} corner"
    if edges:
        return f"at the {edges[0]} edge"
    return _beside(item, others, scene) or _part_of_table(*item.position)


def _beside(item: SceneObject, others: Sequence[SceneObject], scene: Scene) -> str | None:
    """On which side of the nearest of ``others`` the object stands, if that one is near."""
    nearest = min(others, key=lambda one: gap(item, one), default=None)
    if nearest is None or gap(item, nearest) > scene.units(NEAR_M):
        return None
    directions = (way for way in ALONG if beside(scene, item, nearest, way))
    return f"{_WORDS[next(directions, 'right')]} {title(nearest, scene)}"


def _part_of_table(x: float, y: float) -> str:
    if abs(x) < 0.2 and abs(y) < 0.2:
        return "near the middle of the table"
    across = "left" if x < -0.2 else "right" if x > 0.2 else ""
    away = "far" if y > 0.2 else "near" if y < -0.2 else ""
    return f"on the {' '.join(word for word in (away, across) if word)} side of the table"


def strays(
    predicted: Scene, observed: Scene, doubt: Doubt = SURE, still: Collection[str] = ()
) -> list[tuple[SceneObject, SceneObject | None]]:
    """What is seen not to be as predicted: what was wanted, and what is seen (None: nothing).

    Held or not, by what it is carried, upright or lying, and its place: within `TOLERANCE`, within
    `MOVED` for ``still``, what must stay where it is, or within `LOOSE` where it finds its own; and
    farther off than the eye may err. On the floor any place is right, in a container also
    lying and on other things there.
    """
    seen = {item.id: item for item in observed}
    pairs = ((want, seen.get(want.id)) for want in predicted)
    return [
        (want, got)
        for want, got in pairs
        if got is None
        or not _alike(want, got, predicted, observed)
        or off_place(want, got) > max(limit(want, predicted, still), slack(doubt, want.id))
    ]


def limit(want: SceneObject, predicted: Scene, still: Collection[str] = ()) -> float:
    """How far a thing may be from where it should be (table units)."""
    if want.on in ("floor", "tray"):
        return math.inf
    if _container(want, predicted) or want.held or not want.upright:
        return LOOSE
    return MOVED if want.id in still else TOLERANCE


def off_place(want: SceneObject, got: SceneObject) -> float:
    """How far a thing is beside its place (table units); 0 where it waits in the tray."""
    if want.x is None or got.x is None:
        return 0.0
    return math.dist(want.position, got.position)


def _alike(want: SceneObject, got: SceneObject, predicted: Scene, observed: Scene) -> bool:
    """Whether all but its place is as predicted."""
    inside, inside_now = _container(want, predicted), _container(got, observed)
    if want.held != got.held or (inside or want.on) != (inside_now or got.on):
        return False
    return bool(inside) or want.on in ("floor", "tray") or want.upright == got.upright


def _container(item: SceneObject, scene: Scene) -> str:
    """What the object lies in, be it on other things there; empty if in nothing."""
    known = {one.id: one for one in scene.objects}
    carrier = known.get(item.on)
    while carrier is not None and not is_container(carrier.name):
        carrier = known.get(carrier.on)
    return "" if carrier is None else carrier.id


def differences(
    predicted: Scene, observed: Scene, doubt: Doubt = SURE, still: Collection[str] = ()
) -> str:
    """What is not as it was predicted, object by object, and what was meant; empty when all is."""
    found = strays(predicted, observed, doubt, still)
    return " ".join(_difference(want, got, predicted, observed) for want, got in found)


def _difference(
    want: SceneObject, got: SceneObject | None, predicted: Scene, observed: Scene
) -> str:
    name = title(want, predicted)
    if got is None:
        return f"I cannot see {name} any more."
    if want.held != got.held:
        return f"I should hold {name} but do not." if want.held else f"I still hold {name}."
    is_now, meant = _sentence(got, observed).rstrip("."), _meant(want, predicted)
    if is_now == _sentence(want, predicted).rstrip("."):
        off = 50 * predicted.table_m * math.dist(want.position, got.position)
        return f"{is_now}, but {off:.1f} cm from where I meant it to be."
    return f"{is_now}; I meant it {meant}."


def _meant(want: SceneObject, scene: Scene) -> str:
    if want.on == "floor":
        side = next((word for way, word in _SIDES.items() if off_side(want, way)), None)
        return f"to go off the {side} edge" if side else "to go to the floor"
    lying = "" if want.upright else ", lying on its side"
    carrier = next((item for item in scene.objects if item.id == want.on), None)
    if carrier is not None:
        where = "in" if is_container(carrier.name) else "on"
        return f"to be {where} {title(carrier, scene)}{lying}"
    return f"to be {place(want, scene) if want.on == 'table' else 'in the tray'}{lying}"

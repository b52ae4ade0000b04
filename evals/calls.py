"""What every call of a goal has in common (`evals.goals`)."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from agent.errors import SceneError
from agent.messages import Status
from evals.world import World
from scene import relations
from scene.types import Scene, SceneObject

EXACT = 1e-6
TOLERANCE = 0.02
"""What does not count: so little the one way or the other, or over another's ground."""


class Call(msgspec.Struct, frozen=True, kw_only=True, tag_field="p", forbid_unknown_fields=True):
    """A call; with ``when`` it binds only if that turn (from 0) ended in one of these statuses."""

    when: tuple[int, tuple[Status, ...]] | None = None

    def met(self, world: World) -> bool:
        """Whether it holds. Raises SceneError where something it needs has no place."""
        raise NotImplementedError


def holds(call: Call, world: World) -> bool:
    """Whether the call holds, or does not bind; what has no place on the table fulfils nothing."""
    if call.when is not None:
        turn, statuses = call.when
        if not set(world.statuses[turn : turn + 1]) & set(statuses):
            return True
    try:
        return call.met(world)
    except SceneError:
        return False


def carriers(scene: Scene, item: SceneObject) -> Iterator[str]:
    """What carries the object, from what it stands on down to the table, the floor or the tool."""
    on = item.on
    while True:
        yield on
        carrier = next((one for one in scene if one.id == on), None)
        if carrier is None:
            return
        on = carrier.on


def placed(world: World, name: str) -> SceneObject:
    """The object as it is now, if the table carries it. Raises SceneError otherwise."""
    item = world.after.get(name)
    if "table" not in carriers(world.after, item):
        raise SceneError(f"{name} is not on the table")
    return item


def share_ground(one: SceneObject, other: SceneObject) -> bool:
    """Whether the footprints reach into each other by more than does not count."""
    (x1, y1), (x2, y2) = one.position, other.position
    (w1, h1), (w2, h2) = relations.extents(one), relations.extents(other)
    across, along = w1 + w2 - abs(x1 - x2), h1 + h2 - abs(y1 - y2)
    return min(across, along) >= TOLERANCE - EXACT

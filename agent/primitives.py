"""What a draft asks of the arm: its own primitives, or a pick and place for each placement."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

from agent.errors import ProgramError
from agent.messages import Command, Draft, Placement
from scene.relations import extents
from scene.tray import tray_positions
from scene.types import Scene, SceneObject

TRAVEL = 0.9
"""Height of the tool between pick and place (table units); more over tall things: those that
still wait in the tray are in the way too."""
CLEARANCE = 0.05
"""Room between the lowest point of what is carried and the tallest thing below it."""


def primitives(draft: Draft, scene: Scene) -> tuple[Command, ...]:
    """The motions of a draft: its own commands, or a pick and place for each placement.

    Objects are picked from `tray_positions`, and set down on the table or on the highest thing
    under their footprint. Raises ProgramError for an object that has no place in the tray.
    """
    if not draft.placements:
        return draft.commands
    places = tray_positions(scene)
    standing = [item for item in scene.objects if item.on not in ("floor", "gripper")]
    motions: list[Command] = []
    for placement in _bottom_up(draft.placements, scene):
        item = scene.get(placement.object)
        if placement.object not in places:
            text = f"the tray has no room for {item.name}: it cannot be picked up"
            raise ProgramError(text, placement.line)
        base = max((other.top for other in standing if _under(other, item, placement)), default=0.0)
        placed = msgspec.structs.replace(item, x=placement.x, y=placement.y, z=base, on="table")
        met = [*standing, *scene.tray]
        motions += _pick_and_place(item, places[item.id], placed, placement.line, met)
        standing.append(placed)
    return tuple(motions)


def _bottom_up(placements: Sequence[Placement], scene: Scene) -> list[Placement]:
    """In the program's order, but what carries another comes before it."""

    def carriers(placement: Placement) -> int:
        item = scene.get(placement.object)
        return sum(_carries(scene.get(p.object), p, item, placement) for p in placements)

    return sorted(placements, key=carriers)


def _carries(carrier: SceneObject, below: Placement, item: SceneObject, above: Placement) -> bool:
    """Whether one placed footprint lies inside another, larger one."""
    room_x, room_y = (a - b for a, b in zip(extents(carrier), extents(item), strict=True))
    inside = abs(below.x - above.x) <= room_x + 1e-9 and abs(below.y - above.y) <= room_y + 1e-9
    return inside and room_x + room_y > 0


def _under(other: SceneObject, item: SceneObject, placement: Placement) -> bool:
    """Whether the footprints overlap by more than a touch."""
    half_x, half_y = (a + b for a, b in zip(extents(other), extents(item), strict=True))
    x, y = other.position
    return abs(x - placement.x) < half_x - 1e-4 and abs(y - placement.y) < half_y - 1e-4


def _pick_and_place(
    item: SceneObject,
    start: tuple[float, float],
    placed: SceneObject,
    line: int,
    met: Sequence[SceneObject],
) -> list[Command]:
    """Above all that may be met on the way, on the table and in the tray."""
    tallest = max((other.top for other in met), default=0.0)
    travel = max(TRAVEL, tallest + item.tall + CLEARANCE)
    end = placed.position
    heights = ((start, travel), (start, item.top), (start, travel), (end, travel))
    path = [*heights, (end, placed.top), (end, travel)]
    moves = [
        Command("move", x, y, z, 0.0, 2 <= number <= 4, line)
        for number, ((x, y), z) in enumerate(path)
    ]
    grip = Command("grip", *start, item.top, 0.0, True, line)
    release = Command("grip", *end, placed.top, 0.0, False, line)
    return [*moves[:2], grip, *moves[2:5], release, *moves[5:]]

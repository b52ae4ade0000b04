"""What the tool did: predicates over its path, as words of `evals.postconditions`."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from itertools import accumulate, pairwise

from agent.messages import Command
from evals.world import World
from robot_bridge.api import PARK
from scene import relations
from scene.relations import ALONG
from scene.types import EDGE, Pose, SceneObject

DEVIATES = 0.005
"""A motion counts as done where the tool is no farther from its target: 1 mm (table units)."""
TOLERANCE = 0.02
"""How exact a place of the tool must be (table units)."""


def _over(item: SceneObject, pose: Command | Pose) -> bool:
    (x, y), (half_x, half_y) = item.position, relations.extents(item)
    return abs(pose.x - x) <= half_x and abs(pose.y - y) <= half_y


def _visits_above(world: World, one: str) -> bool:
    """The tool stops over the object, clear of it."""
    item = world.was(one)
    return any(_over(item, move) and move.z >= item.top + 0.02 for move in world.moves())


def _touches(world: World, one: str, times: str = "1") -> bool:
    """The tool stops on the object's upper side, at least as often as said."""
    item = world.was(one)
    stops = [m for m in world.moves() if _over(item, m) and abs(m.z - item.top) <= 0.02]
    return len(stops) >= int(times)


def _touches_side(world: World, one: str, side: str) -> bool:
    """The tool's rim (radius 0.04) stops against that side, lower than the object's top."""
    (dx, dy), item = ALONG[side], world.was(one)
    (x, y), (half_x, half_y) = item.position, relations.extents(item)
    out = half_x * abs(dx) + half_y * abs(dy) + 0.04
    spot = (x + out * dx, y + out * dy)
    return any(math.dist(spot, (m.x, m.y)) <= 0.01 and m.z < item.top for m in world.moves())


def _lifted(world: World, one: str) -> bool:
    """Suction came on upon the object, and the tool rose with it."""
    item, held = world.was(one), False
    for command in world.path:
        if command.op == "grip":
            held = command.grip and _over(item, command)
        elif held and command.z >= item.top + 0.1:
            return True
    return False


def _tool_ends_at(world: World, x: str, y: str) -> bool:
    end = world.moves()[-1]
    return math.dist((end.x, end.y), (float(x), float(y))) <= TOLERANCE


def _tool_ends_above(world: World, one: str) -> bool:
    end = world.moves()[-1]
    return _over(world.now(one), end) and end.z >= world.now(one).top + 0.02


def _tool_ends_between(world: World, one: str, other: str) -> bool:
    """The tool ends above the middle of the line joining two objects."""
    (x1, y1), (x2, y2) = world.now(one).position, world.now(other).position
    return _tool_ends_at(world, str((x1 + x2) / 2), str((y1 + y2) / 2))


def _angles(world: World, x: float, y: float) -> Iterator[float]:
    for one, other in pairwise(world.moves()):
        turn = math.atan2(other.y - y, other.x - x) - math.atan2(one.y - y, one.x - x)
        yield math.remainder(turn, math.tau)


def _circles(world: World, one: str, turns: str = "1") -> bool:
    """The tool goes round the object on some stretch of its way, as often as said, without passing
    over it."""
    x, y = world.was(one).position
    outside = [move for move in world.moves() if not _over(world.was(one), move)]
    inside = len(world.moves()) - len(outside)
    turned = list(accumulate(_angles(world, x, y), initial=0.0))
    round_it = max(turned) - min(turned)
    return inside == 0 and round_it >= (float(turns) - 0.05) * math.tau


def _traces(world: World, corners: str) -> bool:
    """The tool's low stops (below 0.2) form a closed polygon with that many corners."""
    low = [(move.x, move.y) for move in world.moves() if move.z < 0.2]
    distinct: list[tuple[float, float]] = []
    for place in low:
        if all(math.dist(place, other) > DEVIATES for other in distinct):
            distinct.append(place)
    closed = len(low) > 1 and math.dist(low[0], low[-1]) <= TOLERANCE
    return closed and len(distinct) == int(corners)


def _stays_on_table(world: World) -> bool:
    """The tool never leaves the square above the table, by more than an arm deviates, but for where
    it waits: there it goes by itself where it hides what it did."""
    return all(
        max(abs(move.x), abs(move.y)) <= EDGE + DEVIATES
        or math.dist((move.x, move.y), (PARK.x, PARK.y)) <= DEVIATES
        for move in world.moves()
    )


MOTIONS: dict[str, Callable[..., bool]] = {
    "visits_above": _visits_above,
    "touches": _touches,
    "touches_side": _touches_side,
    "lifted": _lifted,
    "tool_ends_at": _tool_ends_at,
    "tool_ends_above": _tool_ends_above,
    "tool_ends_between": _tool_ends_between,
    "circles": _circles,
    "traces": _traces,
    "stays_on_table": _stays_on_table,
}
"""Every predicate of the path by the word that names it."""

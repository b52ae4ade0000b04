"""What must hold after a program: predicates over the scene before, the scene after, the path.

A postcondition is a line of words: a predicate, then nouns, directions (left right above below),
sides (the same words) or numbers (table units): ``left_of apple orange``, ``gap cup box 0 0.3``.
``not`` in front negates it. The meanings of the spatial words are those of `scene.relations`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from itertools import pairwise

import msgspec

from agent.messages import Command
from scene import relations
from scene.relations import ALONG
from scene.types import EDGE, Pose, Scene, SceneObject, identifiers

TOLERANCE = 0.02
"""How exact a place, a distance or a gap must be (table units), unless the line says."""


class World(msgspec.Struct, frozen=True):
    """What a program did: the scene before and after, the primitives in between."""

    before: Scene
    after: Scene
    path: tuple[Command, ...]

    def was(self, noun: str) -> SceneObject:
        """The object as it was. Raises KeyError if the scene has none of that name."""
        return identifiers(self.before)[noun]

    def now(self, noun: str) -> SceneObject:
        """The object as it is. Raises KeyError if the scene had none of that name."""
        return self.after.get(self.was(noun).id)

    def moves(self) -> list[Command]:
        """The ``move`` primitives of the path."""
        return [command for command in self.path if command.op == "move"]


class Malformed(ValueError):
    """A postcondition that says nothing: unknown predicate, noun or number of words."""


def holds(line: str, world: World) -> bool:
    """Whether the postcondition is true. Raises Malformed when it cannot be understood."""
    name, *arguments = line.split() or [""]
    if name == "not":
        return not holds(" ".join(arguments), world)
    if name not in PREDICATES:
        raise Malformed(f"{line!r}: no predicate {name!r}")
    try:
        return PREDICATES[name](world, *arguments)
    except (TypeError, KeyError, ValueError) as error:
        raise Malformed(f"{line!r}: {error}") from error


# --- where things are ------------------------------------------------------------------------


def _beside(direction: str) -> Callable[..., bool]:
    def predicate(world: World, one: str, other: str) -> bool:
        return relations.beside(world.after, world.now(one), world.now(other), direction)

    return predicate


def _next_to(world: World, one: str, other: str) -> bool:
    return relations.next_to(world.after, world.now(one), world.now(other))


def _between(world: World, one: str, first: str, second: str) -> bool:
    return relations.between(world.now(one), world.now(first), world.now(second))


def _midway(world: World, one: str, first: str, second: str) -> bool:
    """The centre of ``one`` is the middle of the line joining two others."""
    (x, y), (x1, y1), (x2, y2) = (world.now(noun).position for noun in (one, first, second))
    return math.dist((x, y), ((x1 + x2) / 2, (y1 + y2) / 2)) <= TOLERANCE


def _on(world: World, one: str, other: str) -> bool:
    return world.now(one).on == world.now(other).id


def _on_table(world: World, one: str) -> bool:
    return relations.on_table(world.now(one))


def _off_table(world: World, one: str) -> bool:
    return relations.off_table(world.now(one))


def _off_side(world: World, one: str, side: str) -> bool:
    return relations.off_side(world.now(one), side)


def _at_edge(world: World, one: str, side: str) -> bool:
    return relations.at_edge(world.after, world.now(one), side)


def _in_corner(world: World, one: str, first: str, second: str) -> bool:
    return relations.in_corner(world.after, world.now(one), first, second)


def _in_half(world: World, one: str, side: str) -> bool:
    """The whole footprint lies in that half of the table."""
    (dx, dy), (x, y) = ALONG[side], world.now(one).position
    half_x, half_y = relations.extents(world.now(one))
    return x * dx + y * dy - abs(half_x * dx + half_y * dy) >= -1e-6 and _on_table(world, one)


def _centred(world: World, one: str) -> bool:
    return relations.centred(world.after, world.now(one))


def _near_point(world: World, one: str, x: str, y: str, within: str = str(TOLERANCE)) -> bool:
    return math.dist(world.now(one).position, (float(x), float(y))) <= float(within)


def _row(world: World, *nouns: str) -> bool:
    return relations.in_row([world.now(noun) for noun in nouns])


def _column(world: World, *nouns: str) -> bool:
    return relations.in_column([world.now(noun) for noun in nouns])


def _ordered(world: World, direction: str, *nouns: str) -> bool:
    """Each noun lies further in the direction than the one before it."""
    dx, dy = ALONG[direction]
    along = [world.now(noun).position[0] * dx + world.now(noun).position[1] * dy for noun in nouns]
    return all(one < other - 1e-6 for one, other in pairwise(along))


# --- distances -------------------------------------------------------------------------------


def _equal_gaps(world: World, *nouns: str) -> bool:
    """The gaps between neighbours, in the order named, are equal and not zero."""
    things = [world.now(noun) for noun in nouns]
    gaps = [relations.gap(one, other) for one, other in pairwise(things)]
    return min(gaps) > 0 and max(gaps) - min(gaps) <= TOLERANCE


def _gap(world: World, one: str, other: str, least: str, most: str) -> bool:
    """The gap, edge to edge, lies between two numbers."""
    wide = relations.gap(world.now(one), world.now(other))
    return float(least) - 1e-6 <= wide <= float(most) + 1e-6


def _distance(world: World, one: str, other: str, wanted: str) -> bool:
    far = math.dist(world.now(one).position, world.now(other).position)
    return abs(far - float(wanted)) <= TOLERANCE


def _closer(world: World, one: str, other: str, third: str) -> bool:
    """``one`` is closer to ``other`` than to ``third``, centre to centre."""
    place = world.now(one).position
    return math.dist(place, world.now(other).position) < math.dist(place, world.now(third).position)


def _mirrored(world: World, one: str, other: str) -> bool:
    """The two lie on opposite sides of the middle of the table, or of one of its axes."""
    (x1, y1), (x2, y2) = world.now(one).position, world.now(other).position
    images = ((-x2, y2), (x2, -y2), (-x2, -y2))
    return any(math.dist((x1, y1), image) <= TOLERANCE for image in images)


def _opposite(world: World, one: str, other: str, middle: str) -> bool:
    """The two lie on opposite sides of the third object, equally far from it."""
    return _midway(world, middle, one, other)


# --- what happened to them -------------------------------------------------------------------


def _shift(world: World, one: str) -> tuple[float, float]:
    (x1, y1), (x2, y2) = world.was(one).position, world.now(one).position
    return x2 - x1, y2 - y1


def _moved_by(world: World, one: str, dx: str, dy: str) -> bool:
    return math.dist(_shift(world, one), (float(dx), float(dy))) <= TOLERANCE


def _moved(world: World, one: str, direction: str) -> bool:
    """It moved in that direction and hardly across it."""
    (dx, dy), (x, y) = ALONG[direction], _shift(world, one)
    along = x * dx + y * dy
    return along > TOLERANCE and abs(x * dy + y * dx) <= TOLERANCE + along / 10


def _took_place_of(world: World, one: str, other: str) -> bool:
    return math.dist(world.now(one).position, world.was(other).position) <= TOLERANCE


def _still(world: World, *nouns: str) -> bool:
    return all(relations.moved(world.was(noun), world.now(noun)) == 0 for noun in nouns)


def _only(world: World, *nouns: str) -> bool:
    """Nothing but these moved."""
    return _still(world, *(noun for noun in identifiers(world.before) if noun not in nouns))


def _toppled(world: World, one: str) -> bool:
    return not world.now(one).upright


def _upright(world: World, one: str) -> bool:
    return world.now(one).upright


def _held(world: World, one: str) -> bool:
    return world.now(one).held


def _nothing_held(world: World) -> bool:
    return not any(item.held for item in world.after.objects)


def _turned(world: World, one: str, angle: str) -> bool:
    turn = world.now(one).r - world.was(one).r - float(angle)
    return abs(math.remainder(turn, math.tau)) <= TOLERANCE


# --- the path of the tool ----------------------------------------------------------------------


def _over(item: SceneObject, pose: Command | Pose) -> bool:
    (x, y), (half_x, half_y) = item.position, relations.extents(item)
    return abs(pose.x - x) <= half_x and abs(pose.y - y) <= half_y


def _visits_above(world: World, one: str) -> bool:
    """The tool stops over the object, clear of it."""
    item = world.was(one)
    return any(_over(item, move) and move.z >= item.top + 0.02 for move in world.moves())


def _touches(world: World, one: str) -> bool:
    """The tool stops on the object's upper side."""
    item = world.was(one)
    return any(_over(item, move) and abs(move.z - item.top) <= 0.02 for move in world.moves())


def _tool_ends_at(world: World, x: str, y: str) -> bool:
    end = world.moves()[-1]
    return math.dist((end.x, end.y), (float(x), float(y))) <= TOLERANCE


def _tool_ends_above(world: World, one: str) -> bool:
    end = world.moves()[-1]
    return _over(world.now(one), end) and end.z >= world.now(one).top + 0.02


def _angles(world: World, x: float, y: float) -> Iterator[float]:
    for one, other in pairwise(world.moves()):
        turn = math.atan2(other.y - y, other.x - x) - math.atan2(one.y - y, one.x - x)
        yield math.remainder(turn, math.tau)


def _circles(world: World, one: str, turns: str = "1") -> bool:
    """The tool goes round the object, as often as said, without passing over it."""
    x, y = world.was(one).position
    outside = [move for move in world.moves() if not _over(world.was(one), move)]
    inside = len(world.moves()) - len(outside)
    round_it = abs(sum(_angles(world, x, y)))
    return inside == 0 and round_it >= (float(turns) - 0.05) * math.tau


def _traces(world: World, corners: str) -> bool:
    """The tool's low stops (below 0.2) form a closed polygon with that many corners."""
    low = [(move.x, move.y) for move in world.moves() if move.z < 0.2]
    distinct = {(round(x, 3), round(y, 3)) for x, y in low}
    closed = len(low) > 1 and math.dist(low[0], low[-1]) <= TOLERANCE
    return closed and len(distinct) == int(corners)


def _stays_on_table(world: World) -> bool:
    """The tool never leaves the square above the table."""
    return all(max(abs(move.x), abs(move.y)) <= EDGE + 1e-6 for move in world.moves())


PREDICATES: dict[str, Callable[..., bool]] = {
    "left_of": _beside("left"),
    "right_of": _beside("right"),
    "above": _beside("above"),
    "below": _beside("below"),
    "next_to": _next_to,
    "between": _between,
    "midway": _midway,
    "opposite": _opposite,
    "on": _on,
    "in": _on,
    "on_table": _on_table,
    "off_table": _off_table,
    "off_side": _off_side,
    "at_edge": _at_edge,
    "in_corner": _in_corner,
    "in_half": _in_half,
    "centred": _centred,
    "near_point": _near_point,
    "row": _row,
    "column": _column,
    "ordered": _ordered,
    "equal_gaps": _equal_gaps,
    "gap": _gap,
    "distance": _distance,
    "closer": _closer,
    "mirrored": _mirrored,
    "moved_by": _moved_by,
    "moved": _moved,
    "took_place_of": _took_place_of,
    "still": _still,
    "only": _only,
    "turned": _turned,
    "toppled": _toppled,
    "upright": _upright,
    "held": _held,
    "nothing_held": _nothing_held,
    "visits_above": _visits_above,
    "touches": _touches,
    "circles": _circles,
    "traces": _traces,
    "tool_ends_at": _tool_ends_at,
    "tool_ends_above": _tool_ends_above,
    "stays_on_table": _stays_on_table,
}
"""Every predicate by the word that names it."""

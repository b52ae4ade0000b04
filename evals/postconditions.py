"""What must hold after a program: predicates over the scene before, the scene after, the path.

A postcondition is a line of words: a predicate, then nouns, directions (left right above below),
sides (the same words) or numbers (table units): ``left_of apple orange``, ``gap cup box 0 0.3``.
``not`` in front negates it; ``if CONDITION then LINE`` holds the line only where the condition
was true before; ``some N LINE : a b c`` holds where at least so many of the nouns, for ``it``, make
the line true, ``but N LINE : a b c`` where all but so many do. The meanings of the spatial words
are those of `scene.relations`; the words about the tool's path are in `evals.motions`, those about
the scene before in `evals.conditions`, more about several things in `evals.groupings`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from itertools import pairwise

from evals.conditions import CONDITIONS
from evals.groupings import GROUPINGS
from evals.motions import MOTIONS
from evals.world import World, unmoved
from scene import relations
from scene.relations import ALONG
from scene.types import EDGE, Scene, SceneObject, identifiers

TOLERANCE = 0.02
"""How exact a place, a distance or a gap must be (table units), unless the line says."""


class Malformed(ValueError):
    """A postcondition that says nothing: unknown predicate, noun or number of words."""


def holds(line: str, world: World) -> bool:
    """Whether the postcondition is true. Raises Malformed when it cannot be understood."""
    name, *arguments = line.split() or [""]
    if name == "not":
        return not holds(" ".join(arguments), world)
    if name == "if":
        condition, _, then = " ".join(arguments).partition(" then ")
        return not holds(condition, unmoved(world)) or holds(then, world)
    if name in ("some", "but"):
        return _so_many(name, arguments, world)
    if name not in PREDICATES:
        raise Malformed(f"{line!r}: no predicate {name!r}")
    try:
        return PREDICATES[name](world, *arguments)
    except (TypeError, KeyError, ValueError) as error:
        raise Malformed(f"{line!r}: {error}") from error


def _so_many(name: str, arguments: list[str], world: World) -> bool:
    """Whether enough of the nouns behind the last colon make the line true."""
    cut = len(arguments) - 1 - arguments[::-1].index(":")
    count, line, nouns = int(float(arguments[0])), arguments[1:cut], arguments[cut + 1 :]
    true = sum(
        holds(" ".join(noun if word == "it" else word for word in line), world) for noun in nouns
    )
    return true >= (count if name == "some" else len(nouns) - count)


# --- where things are ------------------------------------------------------------------------


def _beside(direction: str) -> Callable[..., bool]:
    def predicate(world: World, one: str, other: str) -> bool:
        return relations.beside(world.after, world.now(one), world.now(other), direction)

    return predicate


def _next_to(world: World, one: str, other: str) -> bool:
    return relations.next_to(world.after, world.now(one), world.now(other))


def _next_to_any(world: World, one: str, *others: str) -> bool:
    return any(_next_to(world, one, other) for other in others)


def _diagonal_of(world: World, one: str, other: str, across: str, along: str) -> bool:
    """``one`` lies between two directions from ``other``, 18 to 72 degrees from each."""
    (x1, y1), (x2, y2) = world.now(one).position, world.now(other).position
    x, y = (x1 - x2) * ALONG[across][0], (y1 - y2) * ALONG[along][1]
    return x > 0 and y > 0 and math.radians(18) <= math.atan2(y, x) <= math.radians(72)


def _between(world: World, one: str, first: str, second: str) -> bool:
    return relations.between(world.now(one), world.now(first), world.now(second))


def _midway(world: World, one: str, first: str, second: str) -> bool:
    """The centre of ``one`` is the middle of the line joining two others."""
    (x, y), (x1, y1), (x2, y2) = (world.now(noun).position for noun in (one, first, second))
    return math.dist((x, y), ((x1 + x2) / 2, (y1 + y2) / 2)) <= TOLERANCE


def _on(world: World, one: str, other: str) -> bool:
    return world.now(one).on == world.now(other).id


def _on_any(world: World, one: str, *others: str) -> bool:
    return any(_on(world, one, other) for other in others)


def _on_table(world: World, one: str) -> bool:
    return relations.on_table(world.now(one))


def _off_table(world: World, one: str) -> bool:
    return relations.off_table(world.now(one))


def _off_side(world: World, one: str, side: str) -> bool:
    return relations.off_side(world.now(one), side)


def _off_nearest(world: World, one: str) -> bool:
    """It fell over the edge to which its centre was nearest."""
    x, y = world.was(one).position
    across = "right" if x > 0 else "left"
    along = "above" if y > 0 else "below"
    return relations.off_side(world.now(one), across if abs(x) > abs(y) else along)


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
    """The gap, edge to edge, lies between two numbers; is about the one where they are the same."""
    wide = relations.gap(world.now(one), world.now(other))
    slack = TOLERANCE if least == most else 1e-6
    return float(least) - slack <= wide <= float(most) + slack


def _distance(world: World, one: str, other: str, wanted: str) -> bool:
    far = math.dist(world.now(one).position, world.now(other).position)
    return abs(far - float(wanted)) <= TOLERANCE


def _closer(world: World, one: str, other: str, third: str) -> bool:
    """``one`` is closer to ``other`` than to ``third``, centre to centre."""
    place = world.now(one).position
    return math.dist(place, world.now(other).position) < math.dist(place, world.now(third).position)


def _centres(scene: Scene, one: SceneObject, other: SceneObject) -> float:
    return math.dist(scene.get(one.id).position, scene.get(other.id).position)


def _nearer(world: World, one: str, other: str) -> bool:
    """The two are nearer to each other than they were."""
    things = (world.was(one), world.was(other))
    return _centres(world.after, *things) < _centres(world.before, *things) - TOLERANCE


def _times_as_far(world: World, one: str, other: str, factor: str) -> bool:
    """The two are that many times as far from each other as they were."""
    things = (world.was(one), world.was(other))
    wanted = float(factor) * _centres(world.before, *things)
    return abs(_centres(world.after, *things) - wanted) <= TOLERANCE


def _parted(world: World, one: str, other: str) -> bool:
    """The two are further from each other than they were."""
    things = (world.was(one), world.was(other))
    return _centres(world.after, *things) > _centres(world.before, *things) + TOLERANCE


def _halfway(world: World, one: str, other: str, within: str = str(TOLERANCE)) -> bool:
    """It is halfway between its old place and the other object's."""
    (x1, y1), (x2, y2) = world.was(one).position, world.was(other).position
    return math.dist(world.now(one).position, ((x1 + x2) / 2, (y1 + y2) / 2)) <= float(within)


def _halfway_to_side(world: World, one: str, side: str) -> bool:
    """Its centre halved its distance from the table's edge and moved straight."""
    (dx, dy), (x, y), (sx, sy) = ALONG[side], world.was(one).position, _shift(world, one)
    half = (EDGE - x * dx - y * dy) / 2
    return math.dist((sx, sy), (half * dx, half * dy)) <= TOLERANCE


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
    """It moved in that direction and hardly across it; what fell over may have rolled a little."""
    (dx, dy), (x, y) = ALONG[direction], _shift(world, one)
    along = x * dx + y * dy
    fell = world.was(one).upright and not world.now(one).upright
    return along > TOLERANCE and abs(x * dy + y * dx) <= TOLERANCE + along / (4 if fell else 10)


def _took_place_of(world: World, one: str, other: str) -> bool:
    return math.dist(world.now(one).position, world.was(other).position) <= TOLERANCE


def _still(world: World, *nouns: str) -> bool:
    return all(relations.moved(world.was(noun), world.now(noun)) == 0 for noun in nouns)


def _outlined(world: World, corners: str, *nouns: str) -> bool:
    """They stand along a polygon, at its corners first and evenly between them, the first at its
    far corner (4: the far right one of a level square); ``ring``: a circle; ``diamond``."""
    sides = len(nouns) if corners == "ring" else 4 if corners == "diamond" else int(corners)
    first = math.pi / 4 if sides == 4 and corners != "diamond" else math.pi / 2
    unit = list(_on_polygon(sides, first, len(nouns)))
    places = [world.now(noun).position for noun in nouns]
    radius = math.dist(places[0], places[1]) / math.dist(unit[0], unit[1])
    x, y = places[0][0] - radius * unit[0][0], places[0][1] - radius * unit[0][1]
    return all(
        math.dist(place, (x + radius * u, y + radius * v)) <= TOLERANCE
        for place, (u, v) in zip(places, unit, strict=True)
    )


def _on_polygon(sides: int, first: float, count: int) -> Iterator[tuple[float, float]]:
    """So many places on the polygon of radius 1 around 0, anticlockwise from its ``first`` corner
    (radians), each side with its share of them, rounded down so far."""
    for side in range(sides):
        share = (side + 1) * count // sides - side * count // sides
        (x1, y1), (x2, y2) = (
            (math.cos(first + end * math.tau / sides), math.sin(first + end * math.tau / sides))
            for end in (side, side + 1)
        )
        for number in range(share):
            part = number / share
            yield x1 + part * (x2 - x1), y1 + part * (y2 - y1)


def _together_by_color(world: World, *nouns: str) -> bool:
    """Each thing is nearer to all of its own colour than to any of another, or they share none."""
    things = [world.now(noun) for noun in nouns]
    for one in things:
        own = [math.dist(one.position, o.position) for o in things if o.color == one.color]
        others = [math.dist(one.position, o.position) for o in things if o.color != one.color]
        if others and max(own) >= min(others):
            return False
    return True


def _in_groups(world: World, *words: str) -> bool:
    """``a b c : d e``: each thing is nearer to the middle of its own group than to another's."""
    groups = [[world.now(noun).position for noun in part.split()]
              for part in " ".join(words).split(" : ")]  # fmt: skip
    middles = [
        tuple(sum(axis) / len(group) for axis in zip(*group, strict=True)) for group in groups
    ]
    return all(
        min(middles, key=lambda middle: math.dist(place, middle)) == own
        for group, own in zip(groups, middles, strict=True)
        for place in group
    )


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


PREDICATES: dict[str, Callable[..., bool]] = {
    **CONDITIONS,
    **MOTIONS,
    **GROUPINGS,
    "left_of": _beside("left"),
    "right_of": _beside("right"),
    "above": _beside("above"),
    "below": _beside("below"),
    "next_to": _next_to,
    "next_to_any": _next_to_any,
    "diagonal_of": _diagonal_of,
    "between": _between,
    "midway": _midway,
    "opposite": _opposite,
    "on": _on,
    "in": _on,
    "on_any": _on_any,
    "on_table": _on_table,
    "off_table": _off_table,
    "off_side": _off_side,
    "off_nearest": _off_nearest,
    "at_edge": _at_edge,
    "in_corner": _in_corner,
    "in_half": _in_half,
    "centred": _centred,
    "near_point": _near_point,
    "row": _row,
    "column": _column,
    "ordered": _ordered,
    "equal_gaps": _equal_gaps,
    "outlined": _outlined,
    "together_by_color": _together_by_color,
    "in_groups": _in_groups,
    "gap": _gap,
    "distance": _distance,
    "closer": _closer,
    "nearer": _nearer,
    "parted": _parted,
    "times_as_far": _times_as_far,
    "halfway": _halfway,
    "halfway_to_side": _halfway_to_side,
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
}
"""Every predicate by the word that names it."""

"""How several things stand to each other: words of `evals.postconditions` about groups.

``matched WAY COLOUR a b : c d``: each of the first that has a partner among the others (of ``same``
or ``other`` colour) is ``on`` or ``by`` one; those without stay. ``at_least N a b …`` is for
``given``: that so many things are spoken of. Lengths are table units.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable
from itertools import pairwise, takewhile

from evals.world import World
from scene import relations
from scene.kinds import is_container
from scene.relations import ALONG, extents
from scene.types import SceneObject

TOLERANCE = 0.02
SIZES: dict[str, Callable[[SceneObject], float]] = {
    "size": lambda one: one.width * one.height * one.tall,
    "tall": lambda one: one.tall,
    "width": lambda one: one.width,
}


def _at_least(world: World, count: str, *nouns: str) -> bool:
    return len(nouns) >= int(float(count))


def _level(world: World, *nouns: str) -> bool:
    """They are all as tall."""
    return len({world.was(noun).tall for noun in nouns}) == 1


def _broader(world: World, one: str, other: str) -> bool:
    """It is wider and deeper than the other."""
    a, b = world.was(one), world.was(other)
    return a.width > b.width and a.height > b.height


def _solid(world: World, *nouns: str) -> bool:
    """None of them is hollow."""
    return not any(is_container(world.was(noun).name) for noun in nouns)


def _look(one: SceneObject) -> str:
    """What `same_color` compares."""
    return one.color or one.name


def _matched(world: World, way: str, color: str, *words: str) -> bool:
    cut = words.index(":")
    for noun in words[:cut]:
        one = world.was(noun)
        fitting = [
            world.now(other) for other in words[cut + 1 :]
            if (_look(one) == _look(world.was(other))) == (color == "same")
        ]  # fmt: skip
        now = world.now(noun)
        reached = [
            now.on == other.id if way == "on" else relations.next_to(world.after, now, other)
            for other in fitting
        ]
        if not (any(reached) if fitting else relations.moved(one, now) == 0):
            return False
    return True


def _spans(world: World, one: str, *carriers: str) -> bool:
    """It lies over each of the others, its base on the top of the tallest."""
    top = world.now(one)
    below = [world.now(noun) for noun in carriers]
    over = all(
        abs(top.position[axis] - other.position[axis]) < extents(top)[axis] + extents(other)[axis]
        for other in below
        for axis in (0, 1)
    )
    return over and abs(top.z - max(other.top for other in below)) < 1e-3


def _towers(world: World, count: str, *nouns: str) -> bool:
    """They stand in so many stacks, of which none is higher than another by more than one thing."""
    ids = {world.now(noun).id for noun in nouns}
    bases: Counter[str] = Counter()
    for noun in nouns:
        item = world.now(noun)
        below = takewhile(ids.__contains__, relations.beneath(world.after, item))
        *_, base = (item.id, *below)
        bases[base] += 1
    return len(bases) == int(float(count)) and max(bases.values()) - min(bases.values()) <= 1


def _gaps(world: World, wanted: str, *nouns: str) -> bool:
    """The gap from each to the next is that wide."""
    things = [world.now(noun) for noun in nouns]
    return all(
        abs(relations.gap(one, other) - float(wanted)) <= TOLERANCE
        for one, other in pairwise(things)
    )


def _drawn_apart(world: World, one: str, other: str, length: str) -> bool:
    """Their centres are so much farther from each other than they were."""
    was = math.dist(world.was(one).position, world.was(other).position)
    now = math.dist(world.now(one).position, world.now(other).position)
    return abs(now - was - float(length)) <= TOLERANCE


def _sorted_along(world: World, direction: str, size: str, *nouns: str) -> bool:
    """The larger (``size``, ``tall``, ``width``) stand further in the direction."""
    (dx, dy), measure = ALONG[direction], SIZES[size]
    order = sorted((world.now(noun) for noun in nouns), key=measure)
    along = [one.position[0] * dx + one.position[1] * dy for one in order]
    return all(
        here < there or measure(one) == measure(other)
        for (one, here), (other, there) in pairwise(zip(order, along, strict=True))
    )


def _past_middle(world: World, one: str, side: str) -> bool:
    """Its centre is in that half of the table."""
    (dx, dy), (x, y) = ALONG[side], world.now(one).position
    return x * dx + y * dy >= 0


def _figure(world: World, name: str, *nouns: str) -> bool:
    """They form that figure: ``v`` from its tip, ``l`` from its top, ``cross`` from its middle."""
    places = [world.now(noun).position for noun in nouns]
    steps = [_STEPS[name](number, len(nouns)) for number in range(len(nouns))]
    scale = math.dist(places[0], places[1]) / math.dist(steps[0], steps[1])
    moved = [(x - scale * u, y - scale * v) for (x, y), (u, v) in zip(places, steps, strict=True)]
    return scale > 0.05 and all(math.dist(place, moved[0]) <= TOLERANCE for place in moved)


def _on_cross(number: int, _: int) -> tuple[int, int]:
    x, y = ((-1, 0), (1, 0), (0, 1), (0, -1))[(number - 1) % 4]
    arm = (number + 3) // 4
    return x * arm, y * arm


_STEPS: dict[str, Callable[[int, int], tuple[int, int]]] = {
    "v": lambda number, _: ((number + 1) // 2 * (-1 if number % 2 else 1), (number + 1) // 2),
    "l": lambda number, count: (max(number - count // 2, 0), -min(number, count // 2)),
    "cross": _on_cross,
}


def _encircled(world: World, one: str, *nouns: str) -> bool:
    """The others are around it, one at least on either side of it in both directions or, of two
    or three, on opposite sides: it lies within their bounds, and none is farther than 0.7."""
    x, y = world.now(one).position
    places = [world.now(noun).position for noun in nouns]
    angles = sorted(math.atan2(v - y, u - x) for u, v in places)
    turns = [b - a for a, b in pairwise([*angles, angles[0] + math.tau])]
    return max(turns) <= math.pi + 0.05 and all(math.dist((x, y), p) <= 0.7 for p in places)


GROUPINGS: dict[str, Callable[..., bool]] = {
    "at_least": _at_least,
    "level": _level,
    "broader": _broader,
    "solid": _solid,
    "matched": _matched,
    "spans": _spans,
    "towers": _towers,
    "gaps": _gaps,
    "drawn_apart": _drawn_apart,
    "sorted_along": _sorted_along,
    "past_middle": _past_middle,
    "figure": _figure,
    "encircled": _encircled,
}
"""Every word about several things."""

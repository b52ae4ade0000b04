"""A table on which things are pushed, carried and taken away, and a detector that errs: for figures
and tests of the tracker, without physics and without pictures. Everything is seeded.
"""

from __future__ import annotations

import itertools
import math
import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from robot_bridge.drawing import arm_links
from scene.generate import CLASSES
from scene.lean import Bar, Shade, seen_at, shade
from scene.sight import Detection
from scene.tracks import Hint
from scene.types import EDGE, Pose

EYE = (0.0, 0.0, 6.0)
"""The camera over the table (table units)."""
RATE = 10.0
"""Pictures a second."""
ABOVE, AWAY = 0.9, Pose(0.0, -1.2, 0.9)
"""Height at which the tool travels, and where it waits (table units)."""
TOOL = 0.04
"""Radius of the tool (table units)."""
ROUNDS = 4
"""How often things that touch are moved apart in the time between two pictures."""
KINDS = ("apple", "apple", "orange", "cup", "can", "block", "block", "banana")
"""What stands there: two pairs of things alike."""
PLAIN = np.zeros(0, dtype=np.float32)


@dataclass(frozen=True)
class Thing:
    """What really stands there; ``number`` tells things alike apart, to the judge alone."""

    number: int
    name: str
    color: str
    width: float
    height: float
    tall: float
    x: float
    y: float
    z: float = 0.0
    there: bool = True

    @property
    def radius(self) -> float:
        """Half the mean side (table units)."""
        return (self.width + self.height) / 4


class Errors(NamedTuple):
    """What a detector does wrong: standard deviation of a place (table units), chances of a miss,
    of another class and of another colour, false alarms a picture, spread of sizes."""

    sd: float = 0.01
    miss: float = 0.05
    flicker: float = 0.05
    recolor: float = 0.03
    false: float = 0.05
    size: float = 0.05


PERFECT = Errors(1e-4, 0, 0, 0, 0, 0)


class Moment(NamedTuple):
    """The table at one picture: things, tool, and which of them a hand hides."""

    things: tuple[Thing, ...]
    tip: Pose
    grip: bool = False
    hand: frozenset[int] = frozenset()


def thing(number: int, name: str, x: float, y: float, color: str | None = None) -> Thing:
    """A thing of mean size."""
    kind = CLASSES[name]
    color = color or (kind.colors[0] if kind.colors else "white")
    return Thing(number, name, color, kind.width, kind.height, kind.tall, x, y)


def table(rng: random.Random, names: Sequence[str] = KINDS) -> tuple[Thing, ...]:
    """Things at random places, apart."""
    placed: list[Thing] = []
    for number, name in enumerate(names):
        placed.append(_free(thing(number, name, 0.0, 0.0), placed, rng))
    return tuple(placed)


def _free(one: Thing, others: Sequence[Thing], rng: random.Random) -> Thing:
    """The thing at a random place where nothing stands."""
    for _ in range(1000):
        moved = replace(one, x=rng.uniform(-0.8, 0.8), y=rng.uniform(-0.8, 0.8), z=0.0, there=True)
        if all(_gap(moved, other) > 0.03 for other in others if other.number != one.number):
            return moved
    return moved


def _gap(one: Thing, other: Thing) -> float:
    if not other.there:
        return math.inf
    return math.dist((one.x, one.y), (other.x, other.y)) - one.radius - other.radius


# --- what the camera makes of it --------------------------------------------------------------


def shades(tip: Pose) -> tuple[Shade, ...]:
    """What the arm hides when its tool is there."""
    return tuple(shade(Bar(*link), EYE) for link in arm_links(tip))


def hint(moment: Moment) -> Hint:
    """What the robot tells at that moment."""
    return Hint(tip=moment.tip, grip=moment.grip, eye=EYE, shades=shades(moment.tip))


def sightings(moment: Moment, errors: Errors, rng: random.Random) -> tuple[Detection, ...]:
    """What a detector that errs reports, in no order."""
    hidden = shades(moment.tip)
    found = [
        _sighting(one, errors, rng)
        for one in moment.things
        if one.there and one.number not in moment.hand and not _covered(one, hidden)
        and rng.random() >= errors.miss
    ]  # fmt: skip
    if rng.random() < errors.false:
        ghost = thing(-1, rng.choice(KINDS), rng.uniform(-0.95, 0.95), rng.uniform(-0.95, 0.95))
        found.append(_sighting(ghost, errors, rng))
    rng.shuffle(found)
    return tuple(found)


def _covered(one: Thing, hidden: Sequence[Shade]) -> bool:
    point = seen_at((one.x, one.y), one.z, EYE)
    return any(strip.distance(point) < strip.half + 0.3 * one.radius for strip in hidden)


def _sighting(one: Thing, errors: Errors, rng: random.Random) -> Detection:
    x, y = seen_at((one.x, one.y), one.z, EYE)
    name = rng.choice(KINDS) if rng.random() < errors.flicker else one.name
    color = rng.choice(("red", "green", "white")) if rng.random() < errors.recolor else one.color

    def side(length: float) -> float:
        return length * math.exp(rng.gauss(0, errors.size))

    return Detection(
        name, rng.uniform(0.6, 1.0), x + rng.gauss(0, errors.sd), y + rng.gauss(0, errors.sd),
        errors.sd, side(one.width), side(one.height), side(one.tall), 0.0, color, PLAIN,
    )  # fmt: skip


# --- what is done -----------------------------------------------------------------------------


def manipulations(rng: random.Random, count: int) -> Iterator[tuple[Moment, bool]]:
    """So many things done, picture by picture; with each whether one of them has just ended."""
    things = table(rng)
    for _ in range(count):
        act = rng.choice((_push, _push, _carry, _carry, _by_hand, _off))
        for moment in act(things, rng):
            yield moment, False
            things = moment.things
        rest = Moment(things, AWAY)
        for _ in range(4):
            yield rest, False
        yield rest, True


def _line(start: Pose, end: Pose, speed: float) -> Iterator[Pose]:
    """The tool's poses from one to another, picture by picture."""
    far = math.dist((start.x, start.y, start.z), (end.x, end.y, end.z))
    steps = max(1, math.ceil(far / speed * RATE))
    for step in range(1, steps + 1):
        share = step / steps
        yield Pose(
            start.x + share * (end.x - start.x), start.y + share * (end.y - start.y),
            start.z + share * (end.z - start.z),
        )  # fmt: skip


def _way(*points: Pose, speed: float = 1.2) -> Iterator[Pose]:
    for start, end in itertools.pairwise(points):
        yield from _line(start, end, speed)


def _swap(things: Sequence[Thing], *changed: Thing) -> tuple[Thing, ...]:
    new = {one.number: one for one in changed}
    return tuple(new.get(one.number, one) for one in things)


def _present(things: Sequence[Thing], rng: random.Random) -> Thing:
    return rng.choice([one for one in things if one.there])


def _push(things: tuple[Thing, ...], rng: random.Random) -> Iterator[Moment]:
    """A thing is pushed over the table, and whatever it meets with it."""
    one = _present(things, rng)
    angle, far = rng.uniform(0, math.tau), rng.uniform(0.2, 0.7)
    goal = (one.x + far * math.cos(angle), one.y + far * math.sin(angle))
    if max(map(abs, goal)) > 0.85:
        goal = (0.3 * one.x, 0.3 * one.y)
    yield from _pushing(things, one, goal)


def _off(things: tuple[Thing, ...], rng: random.Random) -> Iterator[Moment]:
    """A thing is pushed off the table's nearest edge, and a hand brings it back."""
    one = _present(things, rng)
    x, y = one.x, one.y
    goal = (math.copysign(1.3, x), y) if abs(x) > abs(y) else (x, math.copysign(1.3, y))
    moment = Moment(things, AWAY)
    for moment in _pushing(things, one, goal):
        yield moment
    for _ in range(30):
        yield moment
    fallen = [thing for thing in moment.things if not thing.there]
    things = moment.things
    for one in fallen:
        things = _swap(things, _free(one, [t for t in things if t.there], rng))
    yield Moment(things, AWAY)


def _pushing(things: tuple[Thing, ...], one: Thing, goal: tuple[float, float]) -> Iterator[Moment]:
    """The tool comes down behind a thing, pushes it to the goal and goes up."""
    dx, dy = goal[0] - one.x, goal[1] - one.y
    far = math.hypot(dx, dy) or 1.0
    ux, uy = dx / far, dy / far
    back = one.radius + TOOL + 0.02
    low = min(0.04, one.tall / 2)
    behind = Pose(one.x - ux * back, one.y - uy * back, low)
    end = Pose(goal[0] - ux * (one.radius + TOOL), goal[1] - uy * (one.radius + TOOL), low)
    above, up = Pose(behind.x, behind.y, ABOVE), Pose(end.x, end.y, ABOVE)
    for tip in _way(AWAY, above, behind):
        yield Moment(things, tip)
    for tip in _way(behind, end, speed=0.5):
        things = _shoved(things, one.number, (tip.x, tip.y), (ux, uy))
        yield Moment(things, tip)
    for tip in _way(end, up, AWAY):
        yield Moment(things, tip)


def _shoved(
    things: tuple[Thing, ...], number: int, tip: tuple[float, float], way: tuple[float, float]
) -> tuple[Thing, ...]:
    """The pushed thing before the tool, others out of its way; what passes the edge falls."""
    one = things[number]
    reach = one.radius + TOOL
    ahead = (one.x - tip[0]) * way[0] + (one.y - tip[1]) * way[1]
    if ahead < reach:
        one = replace(one, x=one.x + (reach - ahead) * way[0], y=one.y + (reach - ahead) * way[1])
    things = _swap(things, one)
    for _ in range(ROUNDS):
        things = _apart(things, number)
    over = (replace(t, there=False) for t in things if t.there and max(abs(t.x), abs(t.y)) > EDGE)
    return _swap(things, *over)


def _apart(things: tuple[Thing, ...], fixed: int) -> tuple[Thing, ...]:
    """Things that overlap moved apart, but for the one that is pushed."""
    for one, other in itertools.permutations([t.number for t in things if t.there], 2):
        gap = _gap(things[one], things[other])
        if gap < 0 and other != fixed:
            dx, dy = things[other].x - things[one].x, things[other].y - things[one].y
            far = math.hypot(dx, dy) or 1.0
            x, y = things[other].x - gap * dx / far, things[other].y - gap * dy / far
            things = _swap(things, replace(things[other], x=x, y=y))
    return things


def _carry(things: tuple[Thing, ...], rng: random.Random) -> Iterator[Moment]:
    """A thing is taken, carried to a free place, and let go."""
    one = _present(things, rng)
    to = _free(one, [thing for thing in things if thing.there], rng)
    up, down = Pose(one.x, one.y, ABOVE), Pose(one.x, one.y, one.tall)
    over, land = Pose(to.x, to.y, ABOVE), Pose(to.x, to.y, one.tall)
    for tip in _way(AWAY, up, down):
        yield Moment(things, tip)
    for tip in (down, *_way(down, up, over, land)):
        held = replace(one, x=tip.x, y=tip.y, z=tip.z - one.tall)
        things = _swap(things, held)
        yield Moment(things, tip, True)
    for tip in (land, *_way(land, over, AWAY)):
        yield Moment(things, tip)


def _by_hand(things: tuple[Thing, ...], rng: random.Random) -> Iterator[Moment]:
    """A hand comes, hides a thing and what is near it, and puts it elsewhere."""
    one = _present(things, rng)
    near = frozenset(t.number for t in things if math.dist((t.x, t.y), (one.x, one.y)) < 0.35)
    for _ in range(5):
        yield Moment(things, AWAY, hand=near)
    to = _free(one, [thing for thing in things if thing.there], rng)
    things = _swap(things, to)
    for _ in range(5):
        yield Moment(things, AWAY, hand=frozenset({one.number}))

"""What it costs to take a sighting for a thing: how unlikely its place and its look are (pure).

In nats. What the arm hides, or what stands on it, is rather something else; what is seen as one
with another thing, or beside the arm, shows neither its place nor its sides so well.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from scene import look as looks
from scene.assign import Costs
from scene.estimate import AT_REST, LONGEST, STIRRED, Sighting, surprise
from scene.lean import Bar, Shade, shade, shaded
from scene.sight import Detection
from scene.support import Blend, Carriers, covered
from scene.tracks import Hint, Track, Tracks

NEW = 2.0
"""Cost by which what is known goes before what is not yet believed (nats)."""
UNDER = 5.0
"""Cost by which what lies on top goes before what it hides (nats)."""
BEHIND = 2.5
"""Cost of seeing a thing that the arm hides, or partly hides (nats)."""
BLENDED = 2.0
"""Most that the look of two things seen as one says against either (nats)."""
PARTLY = 0.5
"""Standard deviation of the place of what the arm hides in part, or is seen as one with another, as
a share of half the side: what is in the picture is taken for all of the thing."""
ABUTS = 0.03
"""What is seen to end so near to the arm may be cut off by it (table units)."""
OTHER = 4.0
"""Cost of look above which what is seen elsewhere is not the thing (nats)."""
SWING = 0.05
"""Standard deviation of a carried thing about where the tool should have it (table units)."""
FASTEST = 2.0
"""Speed above which nothing is followed from one picture to the next (units per second)."""
STANDS = -5.0
"""Cost of a sighting that is known to be of the thing, which has not moved (nats)."""
SHARPEST = 1e-3
"""No sighting is more exact than this (table units)."""


class Passed(NamedTuple):
    """Seconds since the picture before, when this one was taken, what stood on what, what each is
    seen as one with, the arm, the id of what it holds, and what that hides."""

    dt: float
    t: float
    on: Carriers
    one_with: Mapping[str, Blend]
    hint: Hint
    held: str | None
    load: tuple[Shade, ...]


def costs(tracks: Tracks, seen: Sequence[Detection], passed: Passed) -> Costs:
    """Cost of each pair of a thing (known, then budding) and a sighting (nats)."""
    rows = (*tracks.known, *tracks.budding)
    under = covered(tracks.known, passed.on, passed.hint.eye)
    found = np.full((len(rows), len(seen)), np.inf)
    for i, one in enumerate(rows):
        late = _late(one, under, passed)
        for j, other in enumerate(seen):
            found[i, j] = late + _cost(one, other, passed, one.id == tracks.held)
    return found


def _late(one: Track, under: Collection[str], passed: Passed) -> float:
    """By how much a sighting is less likely of this one: it is new, covered, or behind the arm."""
    late = 0.0 if one.id else NEW
    late += UNDER if one.id in under else 0.0
    return late + (BEHIND if one.id and is_behind(one, passed) else 0.0)


def _cost(one: Track, seen: Detection, passed: Passed, held: bool) -> float:
    if seen.stand and seen.stand == one.stand:
        return STANDS
    t = passed.t
    at = one.at._replace(var=one.at.var + SWING**2) if held else one.at
    sighting = sighting_of(seen, hidden_by(one, seen, passed))
    place = surprise(at, sighting, t - one.seen, chance_moved(one, t))
    alone = looks.unlike(one.look, seen)
    unlike = min(alone, BLENDED) if one.id in passed.one_with else alone
    far = math.dist((at.x, at.y), (seen.x, seen.y)) - one.look.radius
    # what fell, or went too fast to be followed, comes back as what is new does; and what is
    # behind the arm is not the arm
    other = (alone if _of_arm(seen, passed.hint) else unlike) > OTHER
    away = one.over or other or far > FASTEST * min(t - one.seen, LONGEST)
    # a false alarm that is not yet believed does not become what turns up at its place
    if (far > 0 and away) or (not one.id and unlike > OTHER):
        return math.inf
    return place + unlike


def sighting_of(seen: Detection, hidden: float = 0.0) -> Sighting:
    """The place of a sighting; ``hidden``: more uncertain by so much (table units)."""
    return Sighting(seen.x, seen.y, math.hypot(max(seen.sd, SHARPEST), hidden))


def hidden_by(one: Track, seen: Detection, passed: Passed) -> float:
    """By how much the arm, or what it is seen as one with, makes a sighting of the thing less
    certain (table units). What is told to lie on something was seen apart from that."""
    if is_behind(one, passed):
        return PARTLY * one.look.radius
    others = None if seen.base else passed.one_with.get(one.id)
    return 0.0 if others is None else PARTLY * min(one.look.radius, others.radius)


def chance_moved(one: Track, t: float) -> float:
    """How likely it is that the thing moved since the picture before."""
    return STIRRED if one.restless(t) else AT_REST


def _of_arm(seen: Detection, hint: Hint) -> bool:
    """Whether a sighting may be of the arm itself."""
    return any(strip.distance((seen.x, seen.y)) < strip.half for strip in hint.shades)


def is_behind(one: Track, passed: Passed) -> bool:
    """Whether the arm, or what it holds, hides the thing or a part of it, be it of its top: what is
    seen of a thing that is cut off by the arm ends beside that."""
    eye, radius = passed.hint.eye, one.look.radius + ABUTS
    strips = shades_of(passed, one.id)
    return shaded(one.place(eye), one.base, one.tall, radius, eye, strips)


def shades_of(passed: Passed, id_: str) -> tuple[Shade, ...]:
    """What may hide the thing with this id: the arm, and what it holds."""
    return passed.hint.shades + (passed.load if id_ != passed.held else ())


def load(tracks: Tracks, hint: Hint) -> tuple[Shade, ...]:
    """What the held thing hides."""
    held = next((one for one in tracks.known if one.id == tracks.held), None)
    if held is None or hint.eye is None:
        return ()
    x, y = held.place(hint.eye)
    bar = Bar((x, y, held.base), (x, y, held.base + held.tall), 2 * held.look.radius)
    return (shade(bar, hint.eye),)

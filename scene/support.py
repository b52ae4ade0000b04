"""What stands on or in what, as far as it can be known from above (pure).

The robot knows at what height it let a thing go; else a smaller footprint whose middle lies within
a larger one is on it, or in it where that is an open container.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from typing import NamedTuple

from scene.kinds import is_container
from scene.lean import Eye
from scene.tracks import Track, Tracks

LARGER = 1.3
"""By how much a footprint must be larger to carry what is seen within it."""
HIDING = 0.6
"""How large, beside its own, the footprint must be of what hides a thing from above."""
FLOOR_OF = 0.02
"""Height of what lies in a container above the container's own base (table units)."""
STEP = 0.12
"""How far from a top the base of what stands on it may seem to be (table units)."""

LEDGE = 0.03
"""How much higher than the base of what hides it a thing may be (table units)."""

Carriers = Mapping[str, str]
"""Id of a thing on another -> id of that other."""


def carriers(tracks: Tracks, eye: Eye | None) -> Carriers:
    """What stands on or in what; the held thing is on nothing and carries what it was taken with:
    what is under it now only seems to be on it."""
    found: dict[str, str] = {}
    known, hold = tracks.known, tracks.hold
    for one in known:
        if hold is None or one.id != hold.id:
            below = [
                other for other in known
                if other is not one and _carries(other, one, eye)
                and (hold is None or other.id != hold.id or one.id in hold.bears)
            ]  # fmt: skip
            if below:
                found[one.id] = min(below, key=lambda other: _area(other)).id
    return {one: other for one, other in found.items() if found.get(other) != one}


def covered(known: Sequence[Track], on: Carriers, eye: Eye | None) -> frozenset[str]:
    """The ids of what cannot be seen for what stands over its middle."""
    return frozenset(
        below.id
        for above in known
        if above.id in on
        for below in known
        if below is not above
        and (on[above.id] == below.id or below.base + below.tall < above.base + LEDGE)
        and _area(above) > HIDING * _area(below)
        and covers(above, below.place(eye), eye)
    )


class Blend(NamedTuple):
    """What a thing is seen as one with, and half the mean side of the smallest (table units)."""

    ids: frozenset[str] = frozenset()
    radius: float = math.inf

    def joined(self, other: Track) -> Blend:
        """With one more."""
        return Blend(self.ids | {other.id}, min(self.radius, other.look.radius))


def merged(known: Sequence[Track], on: Carriers, eye: Eye | None) -> Mapping[str, Blend]:
    """By id what a thing is seen as one with: what stands over another's middle, and that other.

    A container shows its walls around what lies in it.
    """
    found: dict[str, Blend] = {}
    for one in known:
        below = next((other for other in known if other.id == on.get(one.id)), None)
        if below is None or is_container(below.name):
            continue
        if covers(one, below.place(eye), eye):
            found[one.id] = found.get(one.id, Blend()).joined(below)
            found[below.id] = found.get(below.id, Blend()).joined(one)
    return found


def told_apart(blends: Mapping[str, Blend], apart: Collection[str]) -> Mapping[str, Blend]:
    """The same where these are seen apart from what is below them."""
    left = {
        id_: one._replace(ids=one.ids - set(apart)) for id_, one in blends.items()
        if id_ not in apart
    }  # fmt: skip
    return {id_: one for id_, one in left.items() if one.ids}


def base(track: Track, known: Mapping[str, Track], on: Carriers) -> float:
    """Height of the thing's base above the table (table units)."""
    below = (known[id_] for id_ in beneath(track.id, on))
    return sum((FLOOR_OF if is_container(one.name) else one.tall for one in below), 0.0)


def beneath(id_: str, on: Carriers) -> list[str]:
    """The ids of what bears a thing, and bears that, down to the table."""
    below = [id_]
    while (next_ := on.get(below[-1])) is not None and next_ not in below:
        below.append(next_)
    return below[1:]


def landed(track: Track, z: float, known: Sequence[Track], eye: Eye | None) -> tuple[str, float]:
    """What a thing let go at base height ``z`` (table units) comes to stand on, and how high."""
    under = [
        one for one in known
        if one.id != track.id and covers(one, track.place(eye, z), eye)
        and (is_container(one.name) or abs(one.base + one.tall - z) < STEP)
    ]  # fmt: skip
    if not under:
        return "table", 0.0
    carrier = max(under, key=lambda one: one.base + one.tall)
    if is_container(carrier.name):
        return carrier.id, carrier.base + FLOOR_OF
    return carrier.id, carrier.base + carrier.tall


def covers(track: Track, point: tuple[float, float], eye: Eye | None, slack: float = 0.0) -> bool:
    """Whether a point lies within the thing's footprint, or ``slack`` beside it."""
    x, y = track.place(eye)
    cos, sin = math.cos(track.look.r), math.sin(track.look.r)
    dx, dy = point[0] - x, point[1] - y
    across, along = abs(dx * cos + dy * sin), abs(dy * cos - dx * sin)
    return across <= track.look.width / 2 + slack and along <= track.look.height / 2 + slack


def _carries(carrier: Track, one: Track, eye: Eye | None) -> bool:
    if one.on:  # the robot knows
        return one.on == carrier.id and covers(carrier, one.place(eye), eye)
    return _area(carrier) > LARGER * _area(one) and covers(carrier, one.place(eye), eye)


def _area(track: Track) -> float:
    return track.look.width * track.look.height

"""What the robot tells the tracker: what the tool takes, carries, lets go and pushes (pure)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

from scene.estimate import shifted
from scene.kinds import is_container
from scene.lean import Point, seen_at
from scene.support import beneath, carriers, covers, landed
from scene.tracks import Hint, Hold, Track, Tracks
from scene.types import Pose

TOOL = 0.04
"""Radius of the tool (table units)."""
UNDER = 0.03
"""How far beside a footprint the tool may take hold of a thing, by the camera's error."""
LEVEL = 0.15
"""How far from the tool's tip the top of what it takes hold of may seem to be (table units)."""
FLAT = 3.0
"""What goes lower over a thing than by this part of its height below its top pushes it."""
SIDEWAYS = 0.01
"""What goes up or down moves no further sideways, and pushes nothing (table units)."""
NEAR = 0.3
"""Distance of the tool within which a thing may be moved by it (table units)."""
JOSTLED, TOUCHING = 0.25, 0.15
"""For so many seconds after it moved a thing may move others, so near to it (table units)."""
ASIDE = 0.3
"""Uncertainty of a push, as a share of the way that the thing was pushed."""
RELEASED = 0.02
"""Standard deviation by which a thing shifts as it is let go (table units)."""


def obeyed(tracks: Tracks, hint: Hint, t: float) -> Tracks:
    """The tracks after what the robot did since the last picture."""
    moved = _mover(tracks, hint)
    if moved is None:
        known = list(tracks.known)
    else:
        pushed = [_pushed(one, moved, tracks.held, hint, t) for one in tracks.known]
        known = [_stirred(one, moved, hint, t) for one in _along(pushed, tracks, hint, t)]
    near = tuple(_jostled(one, known, t) for one in known)
    taken = _gripped(replace(tracks, known=near), hint, t)
    return replace(_carried(taken, hint, t), tip=hint.tip or tracks.tip)


def swap(tracks: Tracks, changed: Track) -> Tracks:
    """The tracks with the known one of the same id changed."""
    known = tuple(changed if one.id == changed.id else one for one in tracks.known)
    return replace(tracks, known=known)


# --- pushing ----------------------------------------------------------------------------------


class Mover(NamedTuple):
    """What goes over the table: the tool's tip or, where that holds something, the held thing.

    From where to where, the heights of its base there, and its radius (table units).
    """

    start: Point
    end: Point
    start_low: float
    end_low: float
    radius: float


def _mover(tracks: Tracks, hint: Hint) -> Mover | None:
    """What the robot moved since the last picture; None where it tells nothing of its tool."""
    end = hint.tip
    if end is None:
        return None
    start = tracks.tip or end
    if tracks.hold is None:
        return Mover((start.x, start.y), (end.x, end.y), start.z, end.z, TOOL)
    held = next(one for one in tracks.known if one.id == tracks.held)
    low, end_low = (max(0.0, tip.z - held.tall) for tip in (start, end))
    at = _hangs(tracks.hold, start), _hangs(tracks.hold, end)
    return Mover(*at, low, end_low, held.look.radius)


def _stirred(one: Track, mover: Mover, hint: Hint, t: float) -> Track:
    """Marked as restless where the tool, or what it holds, is at it."""
    if mover.end_low > one.base + one.tall + LEVEL:
        return one
    if math.dist(mover.end, one.place(hint.eye)) > one.look.radius + mover.radius - TOOL + NEAR:
        return one
    aside = math.dist(mover.start, mover.end) > SIDEWAYS
    return replace(one, stirred=t, shoved=t if aside else one.shoved)


def _jostled(one: Track, known: Sequence[Track], t: float) -> Track:
    """Marked as restless where something that was moved is near enough to move it."""
    if one.restless(t):
        return one
    for other in known:
        far = math.dist((one.at.x, one.at.y), (other.at.x, other.at.y))
        if other.shoved > t - JOSTLED and far < one.look.radius + other.look.radius + TOUCHING:
            return replace(one, stirred=t, shoved=t)
    return one


def _pushed(one: Track, mover: Mover, held: str | None, hint: Hint, t: float) -> Track:
    """Moved on before the tool, or what it holds, where that went through where it stands."""
    (x1, y1), (x2, y2) = mover.start, mover.end
    way, top = math.hypot(x2 - x1, y2 - y1), one.base + one.tall
    if one.id == held or way < SIDEWAYS:
        return one
    ux, uy = (x2 - x1) / way, (y2 - y1) / way
    x, y = one.place(hint.eye)
    ahead = (x - x2) * ux + (y - y2) * uy
    across = abs((x - x2) * uy - (y - y2) * ux)
    reach = one.look.radius + mover.radius
    passed = min(max(1 + ahead / way, 0.0), 1.0)
    low = mover.start_low + passed * (mover.end_low - mover.start_low)
    if low > top - min(TOOL, one.tall / FLAT) or across >= reach:
        return one
    far = math.sqrt(reach**2 - across**2) - ahead
    if not 0 < far <= way + math.sqrt(reach**2 - across**2):
        return one
    moved = shifted(one.at, ux * far, uy * far, ASIDE * far)
    return replace(one, at=moved, stirred=t, shoved=t, on="", base=0.0, stand=0)


def _along(pushed: Sequence[Track], tracks: Tracks, hint: Hint, t: float) -> list[Track]:
    """With what is on or in a thing that was pushed going along with that: it is not pushed by
    itself, be the tool beside it as well."""
    pairs = [*zip(tracks.known, pushed, strict=True)]
    ways = {
        old.id: (new.at.x - old.at.x, new.at.y - old.at.y)
        for old, new in pairs if new.at is not old.at
    }  # fmt: skip
    on = carriers(tracks, hint.eye) if ways else {}

    def after(old: Track, new: Track) -> Track:
        below = beneath(old.id, on)
        way = ways.get(below[-1]) if below else None
        if way is None:
            return new
        moved = shifted(old.at, *way, ASIDE * math.hypot(*way))
        return replace(old, at=moved, stirred=t, shoved=t, stand=0)

    return [after(old, new) for old, new in pairs]


# --- carrying ---------------------------------------------------------------------------------


def _gripped(tracks: Tracks, hint: Hint, t: float) -> Tracks:
    """After suction went on or off, or what was held was lost."""
    grip = tracks.gripping if hint.grip is None else hint.grip
    where = hint.at or hint.tip
    holds = grip and hint.felt is not False
    changed = replace(tracks, gripping=grip)
    if where is None:
        return changed
    if tracks.hold is not None and not holds:
        return _released(changed, (hint.tip or where) if grip else where, hint, t)
    if tracks.hold is None and holds and (hint.felt or not tracks.gripping):
        return _taken(changed, where, hint)
    if grip and not tracks.gripping and hint.felt is False:
        return _missed(changed, where, hint)
    return changed


def _missed(tracks: Tracks, tip: Pose, hint: Hint) -> Tracks:
    """After suction found no rim of a container where it was to be: it is higher or lower. The top
    of anything else is met on the way down, wherever it is."""
    one = _below(tracks.known, tip, hint)
    if one is None or not is_container(one.name):
        return tracks
    return swap(tracks, replace(one, misses=one.misses + 1, felt=None))


def _taken(tracks: Tracks, tip: Pose, hint: Hint) -> Tracks:
    one = _below(tracks.known, tip, hint)
    if one is None:
        return tracks
    x, y = one.place(hint.eye)
    if hint.felt and one.look.upright and tip.z - one.base > TOOL:
        tracks = swap(tracks, replace(one, felt=tip.z - one.base, misses=0))
    on = carriers(tracks, hint.eye)
    bears = frozenset(id_ for id_ in on if beneath(id_, on)[-1] == one.id)
    hold = Hold(one.id, x - tip.x, y - tip.y, tip.r, one.look.r, bears)
    return replace(tracks, hold=hold)


def _below(known: Sequence[Track], tip: Pose, hint: Hint) -> Track | None:
    """What the tool takes hold of: a thing under it whose top is at its tip, the best such."""
    under = [
        one for one in known
        if covers(one, (tip.x, tip.y), hint.eye, UNDER + 3 * one.at.sd)
    ]  # fmt: skip
    level = [one for one in under if abs(one.base + one.tall - tip.z) < LEVEL]
    if not level and hint.felt:
        level = under

    def off(one: Track) -> float:
        beside = math.dist(one.place(hint.eye), (tip.x, tip.y))
        return abs(one.base + one.tall - tip.z) / LEVEL + beside / one.look.radius

    return min(level, key=off, default=None)


def _released(tracks: Tracks, tip: Pose, hint: Hint, t: float) -> Tracks:
    """Let go where the tool was: on the table, on something, or into something."""
    hold = tracks.hold
    assert hold is not None
    one = _at_tip(tracks, tip, hint, t)
    low = max(0.0, tip.z - one.tall)
    others = [it for it in tracks.known if it.id not in hold.bears]
    on, height = landed(one, low, others, hint.eye)
    x, y = seen_at(one.place(hint.eye, low), height, hint.eye)
    at = shifted(one.at, x - one.at.x, y - one.at.y, RELEASED)
    lying = _moved(tracks, replace(one, at=at, on=on, base=height, stirred=t), t)
    return replace(lying, hold=None)


def _carried(tracks: Tracks, hint: Hint, t: float) -> Tracks:
    """The held thing goes with the tool."""
    if tracks.hold is None or hint.tip is None:
        return tracks
    return _moved(tracks, _at_tip(tracks, hint.tip, hint, t), t)


def _moved(tracks: Tracks, held: Track, t: float) -> Tracks:
    """With the held thing as it is now, and what it bears gone along."""
    bears = frozenset[str]() if tracks.hold is None else tracks.hold.bears
    old = next(one for one in tracks.known if one.id == held.id)
    dx, dy = held.at.x - old.at.x, held.at.y - old.at.y

    def after(one: Track) -> Track:
        if one.id == held.id:
            return held
        if one.id not in bears:
            return one
        return replace(one, at=shifted(one.at, dx, dy), stirred=t, stand=0)

    return replace(tracks, known=tuple(map(after, tracks.known)))


def _at_tip(tracks: Tracks, tip: Pose, hint: Hint, t: float) -> Track:
    """The held thing as it hangs from the tool at ``tip``."""
    hold = tracks.hold
    assert hold is not None
    one = next(one for one in tracks.known if one.id == hold.id)
    low = max(0.0, tip.z - one.tall)
    x, y = seen_at(_hangs(hold, tip), low, hint.eye)
    look = replace(one.look, r=hold.angle + tip.r - hold.r)
    at = one.at._replace(x=x, y=y)
    return replace(one, at=at, look=look, base=low, on="", stirred=t, stand=0)


def _hangs(hold: Hold, tip: Pose) -> Point:
    """Where the middle of the held thing is, with the tool at ``tip``."""
    cos, sin = math.cos(tip.r - hold.r), math.sin(tip.r - hold.r)
    return tip.x + hold.dx * cos - hold.dy * sin, tip.y + hold.dx * sin + hold.dy * cos

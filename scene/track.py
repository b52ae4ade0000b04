"""Identities over pictures: (Tracks, detections, t) -> (Tracks, events), pure.

A thing keeps its id while it is pushed, carried, hidden by the arm or by what stands on it, and
after it was away. Sightings are given to things all at once, at the least total cost: how unlikely
place and look are, in nats.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from agent.errors import SceneError
from scene import look as looks
from scene.assign import assign
from scene.costs import (
    SWING,
    Passed,
    chance_moved,
    costs,
    hidden_by,
    is_behind,
    load,
    shades_of,
    sighting_of,
)
from scene.estimate import first, jumped, rested, shifted, updated
from scene.estimate import waited as later
from scene.kinds import is_container
from scene.sight import Detection
from scene.support import carriers, covered, merged, told_apart
from scene.told import obeyed
from scene.tracks import Event, Hint, Track, Tracks
from scene.types import EDGE, slug

ALONE = 8.0
"""Cost of a thing that is not seen together with a sighting of nothing known (nats)."""
ALIKE = 3.0
"""Cost above which something new is not taken for a thing that went out of sight (nats)."""
LONG_GONE = 1.0
"""Cost by which what is missing goes before what left (nats)."""
STALE, FORGETTING = 0.6, 30.0
"""Cost by which what left last goes before what left long ago, and in how many seconds it grows."""
BRIEF = 6.0
"""Cost by which what was seen often goes before what was hardly ever seen, a sighting (nats)."""
DOUBLE = 2.0
"""Cost of look below which a sighting on a known thing is that thing seen twice (nats)."""
REMEMBERED = 50
"""Things that are gone and would be known again."""
MOVING = 1.0
"""Seconds before it was seen last in which a thing moved that went over the edge."""
OUTSIDE = 0.05
"""How far beyond the edge a thing may first be seen and still be on the table (table units)."""


class Rules(NamedTuple):
    """``confirm``: sightings until a thing is believed; ``leave``: seconds that it may be missing
    where it should be seen; ``doubt``: seconds after which what is not yet believed is forgotten.
    """

    confirm: int = 3
    leave: float = 2.0
    doubt: float = 0.35


LIVE, ONCE = Rules(), Rules(confirm=1)
"""For a stream of pictures; for a single one."""
NOTHING = Hint()
"""The robot says nothing."""


def track(
    tracks: Tracks,
    detections: Sequence[Detection],
    t: float,
    hint: Hint = NOTHING,
    rules: Rules = LIVE,
) -> tuple[Tracks, tuple[Event, ...]]:
    """The tracks after a picture taken at ``t`` (seconds), and what happened.

    The order of the detections does not matter.
    """
    dt = 0.0 if tracks.t is None else max(0.0, t - tracks.t)
    told = _waited(obeyed(tracks, hint, t), dt, t)
    on = carriers(told, hint.eye)
    seen = sorted(detections, key=_order)
    passed = Passed(dt, t, on, merged(told.known, on, hint.eye), hint, told.held, load(told, hint))
    pairs = assign(costs(told, seen, passed), ALONE)
    both = [*zip((*told.known, *told.budding), pairs, strict=True)]
    apart = {one.id for one, j in both if j is not None and seen[j].base}
    passed = passed._replace(one_with=told_apart(passed.one_with, apart))
    met = [one if j is None else _met(one, seen[j], told, passed) for one, j in both]
    known = _unseen(told, met[: len(told.known)], passed)
    fresh = [
        _bud(one, t) for j, one in enumerate(seen) if j not in pairs and _is_new(one, known, passed)
    ]
    pause = _pause(told, t, rules)
    buds = (one for one in met[len(told.known) :] if t - one.seen <= pause)
    after = replace(told, known=tuple(known), budding=(*buds, *fresh), t=t)
    believed, came = _believed(after, rules, t)
    kept, went = _left(believed, rules, t)
    return kept, (*came, *_renamed(told, kept), *went)


def call(tracks: Tracks, id: str, name: str) -> Tracks:
    """The tracks with a name that a person gave the thing with this id; it keeps it for good.

    Raises SceneError where there is no such thing.
    """
    if all(one.id != id for one in (*tracks.known, *tracks.gone)):
        raise SceneError(f"no object {id!r} in the scene")
    known = (replace(one, called=name) if one.id == id else one for one in tracks.known)
    gone = (replace(one, called=name) if one.id == id else one for one in tracks.gone)
    return replace(tracks, known=tuple(known), gone=tuple(gone))


# --- what is seen -------------------------------------------------------------------------------


def _order(seen: Detection) -> tuple[float, ...]:
    return seen.x, seen.y, seen.width, seen.height, seen.tall


def _waited(tracks: Tracks, dt: float, t: float) -> Tracks:
    """All places a while later."""

    def waited(one: Track) -> Track:
        pushed = one.sliding(t) and one.id != tracks.held
        return replace(one, at=later(one.at, dt, pushed))

    return replace(
        tracks, known=tuple(map(waited, tracks.known)), budding=tuple(map(waited, tracks.budding))
    )


def _met(one: Track, seen: Detection, tracks: Tracks, passed: Passed) -> Track:
    """A thing after a sighting of it. Where the tool has it, the tool knows better; what is hidden
    in part, or seen as one with another, shows neither its sides nor its kind."""
    hidden, t = hidden_by(one, seen, passed), passed.t
    look = looks.settled(looks.blended(one.look, seen), sure=bool(one.id))
    met = _counted(replace(one, look=one.look if hidden else look), t, tracks)
    if seen.stand and seen.stand == one.stand and one.stood is not None:
        at = rested(one.stood, sighting_of(seen))
        return replace(met, at=at, stood=at, rested=t, clear=t)
    met = met if is_behind(one, passed) else replace(met, clear=t)
    if one.id and one.id == tracks.held:
        return replace(met, look=replace(met.look, r=one.look.r))
    sighting, age, moved = sighting_of(seen, hidden), t - one.seen, chance_moved(one, t)
    if hidden and hidden**2 > one.at.var and not jumped(one.at, sighting, age, moved):
        return met  # what is in the way errs alike in all pictures: it tells no more than that
    at = updated(one.at, sighting, age, moved)
    if seen.stand and not hidden:
        met = replace(met, stand=seen.stand, stood=at, rested=t)
    if jumped(one.at, sighting, age, moved):
        return replace(
            met, at=at, stirred=t, shoved=t, on="", base=0.0, steady=1, calm=one.calm
        )  # fmt: skip
    return replace(met, at=at)


def _counted(one: Track, t: float, before: Tracks) -> Track:
    """With one more sighting."""
    steady = 1 if t - one.seen > _pause(before, t, LIVE) else one.steady + 1
    calm = t if steady >= LIVE.confirm else one.calm
    return replace(one, seen=t, missing=0.0, hits=one.hits + 1, steady=steady, calm=calm)


def _pause(before: Tracks, t: float, rules: Rules) -> float:
    """Seconds unseen after which a thing may be another: a picture more, at whatever rate."""
    return max(rules.doubt, 1.5 * (t - (before.t or t)))


# --- what is not seen -------------------------------------------------------------------------


def _unseen(before: Tracks, met: Sequence[Track], passed: Passed) -> list[Track]:
    """The known things after a picture: what it does not show, though it should, is missing."""
    then, now = {one.id: one for one in before.known}, {one.id: one for one in met}
    under = covered(before.known, passed.on, passed.hint.eye)
    # what the robot set something down in is still there if that is
    bearing = {other.on for other in met if other.on and other.seen == passed.t}

    def after(one: Track) -> Track:
        if one.seen == passed.t:
            return one
        carrier = passed.on.get(one.id)
        if carrier is not None:
            old, new = then[carrier].at, now[carrier].at
            one = replace(one, at=shifted(one.at, new.x - old.x, new.y - old.y))
        others = passed.one_with.get(one.id)
        if others is not None and any(now[other].seen == passed.t for other in others.ids):
            # what bears others is hidden by them; a top is in full view, or somewhere else
            seen = one.id in passed.on.values() and not is_behind(one, passed)
            return replace(one, clear=passed.t) if seen else one
        settled = one.on == carrier or one.steady >= LIVE.confirm
        if one.over:
            return replace(one, missing=one.missing + passed.dt)
        inside = carrier is not None and settled and is_container(now[carrier].name)
        hidden = one.id in under or one.id in bearing or is_behind(one, passed)
        if inside or hidden or one.id == before.held:
            return one
        return replace(one, missing=one.missing + passed.dt)

    return [after(one) for one in met]


def _left(tracks: Tracks, rules: Rules, t: float) -> tuple[Tracks, tuple[Event, ...]]:
    """Without what has been missing for too long."""
    went = [
        replace(one, on="floor" if _over_edge(one, t) else "")
        for one in tracks.known if one.missing >= rules.leave
    ]  # fmt: skip
    if not went:
        return tracks, ()
    ids = {one.id for one in went}
    known = tuple(one for one in tracks.known if one.id not in ids)
    gone = (*tracks.gone, *went)[-REMEMBERED:]
    events = (Event("fell" if one.on == "floor" else "left", one.id, one.name) for one in went)
    return replace(tracks, known=known, gone=gone), tuple(events)


def _over_edge(one: Track, t: float) -> bool:
    """Whether it went over the edge: it was last beyond it, or moved while it stood over it."""
    middle = max(abs(one.at.x), abs(one.at.y))
    moved = one.stirred > one.seen - MOVING
    return middle > EDGE or (moved and middle + one.look.radius > EDGE)


# --- what is new ------------------------------------------------------------------------------


def _bud(seen: Detection, t: float) -> Track:
    return Track("", looks.first(seen), first(sighting_of(seen)), t, clear=t, born=t)


def _is_new(seen: Detection, known: Sequence[Track], passed: Passed) -> bool:
    """Whether a sighting may be of something new: on the table, not of the arm, of what that holds
    or of what it half hides, and no known thing seen twice."""
    if max(abs(seen.x), abs(seen.y)) > EDGE + OUTSIDE:
        return False
    radius = (seen.width + seen.height) / 4
    place = seen.x, seen.y
    if any(strip.distance(place) < strip.half + radius for strip in shades_of(passed, "")):
        return False
    return not any(
        one.seen == passed.t
        and math.dist((one.at.x, one.at.y), (seen.x, seen.y)) < one.look.radius
        and looks.unlike(one.look, seen) < DOUBLE
        for one in known
    )


def _believed(tracks: Tracks, rules: Rules, t: float) -> tuple[Tracks, tuple[Event, ...]]:
    """With what was seen often enough: as a thing that was out of sight, or as a new one."""
    ready = [one for one in tracks.budding if one.hits >= rules.confirm]
    if not ready:
        return tracks, ()
    missing = [one for one in tracks.known if _unsettled(one, t) and one.id != tracks.held]
    lost = (*missing, *tracks.gone)
    costs = np.array([[_unlike(old, new, t) for old in lost] for new in ready]).reshape(
        len(ready), len(lost)
    )
    budding = tuple(one for one in tracks.budding if one.hits < rules.confirm)
    after, events = replace(tracks, budding=budding), list[Event]()
    for new, place in zip(ready, assign(costs, ALIKE), strict=True):
        if place is None:
            after, one = _added(after, new)
            events.append(Event("entered", one.id, one.name))
            continue
        old = lost[place]
        after = _back(after, old, new)
        if place >= len(missing):
            events.append(Event("entered", old.id, old.name))
    return after, tuple(events)


def _unsettled(one: Track, t: float) -> bool:
    """Whether what bears this id now may be something else: it is away, or came only just now."""
    return one.seen < t or one.steady < LIVE.confirm


def _unlike(old: Track, new: Track, t: float) -> float:
    """How little something new is like a thing that is out of sight (nats)."""
    far = math.dist((old.at.x, old.at.y), (new.at.x, new.at.y))
    look = looks.unlike_looks(old.look, new.look)
    if old.calm >= new.born:
        return math.inf  # both were seen at once
    if old.missing >= LIVE.leave:
        stale = STALE * (1 - math.exp((old.seen - new.born) / FORGETTING))
        return look + far / 5 + LONG_GONE + stale + BRIEF / old.hits
    free = old.missing > 0 or old.restless(t) or old.seen == t or old.over
    way = max(t - old.calm, 0.5) if free else 0.0
    return look + far**2 / 2 / (old.at.var + new.at.var + SWING**2 + way**2)


def _added(tracks: Tracks, new: Track) -> tuple[Tracks, Track]:
    """With a thing that was never seen before, under an id of its own."""
    stem = slug(new.name)
    number = tracks.counts.get(stem, 0) + 1
    one = replace(new, id=f"{stem}_{number}", calm=new.seen)
    counts = {**tracks.counts, stem: number}
    return replace(tracks, known=(*tracks.known, one), counts=counts), one


def _back(tracks: Tracks, old: Track, new: Track) -> Tracks:
    """With a thing where the new one is; what bore its id by mistake is on trial again."""
    one = replace(
        old, at=new.at, seen=new.seen, clear=new.clear, missing=0.0, hits=old.hits + new.hits,
        on="", base=0.0, steady=new.steady, calm=new.seen,
    )  # fmt: skip
    known = tuple(other for other in tracks.known if other.id != old.id)
    gone = tuple(other for other in tracks.gone if other.id != old.id)
    there = (
        (replace(old, id="", called=None, hits=old.steady, born=new.seen),)
        if old.seen == tracks.t
        else ()
    )
    return replace(tracks, known=(*known, one), gone=gone, budding=(*tracks.budding, *there))


def _renamed(before: Tracks, after: Tracks) -> tuple[Event, ...]:
    names = {one.id: one.name for one in before.known}
    changed = (one for one in after.known if names.get(one.id, one.name) != one.name)
    return tuple(Event("renamed", one.id, one.name) for one in changed)

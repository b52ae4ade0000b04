"""From a picture to the live scene, with how sure it is: undistort, detect, track, stand (pure).

What the camera sees is on the table, on another thing or on the floor; what waits in the tray was
told, and what the tool holds is known to the robot (`scene.tracks.Hint`).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import NamedTuple

import msgspec
import numpy as np

from scene import estimate, look
from scene.expected import expected
from scene.sight import Detection, Detector, Picture, View
from scene.support import base, carriers
from scene.track import LIVE, Rules, track
from scene.tracks import Event, Hint, Track, Tracks
from scene.tray import tray_positions
from scene.types import EDGE, Scene, SceneObject

Undistort = Callable[[Picture], Picture]
"""A picture without its lens's distortion; the same size."""
FLOOR_GAP = 0.05
"""How far beside the edge a thing is said to lie that fell out of sight (table units)."""
FROM_TRAY = 0.03
"""Uncertainty of where a thing waits in the tray (table units)."""


@dataclass(frozen=True, eq=False)
class Seen:
    """What an eye knows: tracks, what waits in the tray, and the table's side (metres).

    ``rows``: what waited when the tray closed up last; its places are those of then.
    """

    tracks: Tracks = Tracks()  # noqa: RUF009 - an immutable value
    tray: tuple[SceneObject, ...] = ()
    rows: tuple[SceneObject, ...] = ()
    table_m: float = 0.40


class Sight(NamedTuple):
    """The scene, and by id the standard deviation of x and of y (table units) and, of what is not
    seen now, or only beside the arm, for how long it has not been (seconds); what happened since
    the picture before. ``tall_sd``: the standard deviation of heights, by id. ``stands``: by id a
    number that stays the same as long as a thing is seen not to have moved."""

    scene: Scene
    sd: Mapping[str, float]
    unseen: Mapping[str, float]
    events: tuple[Event, ...] = ()
    tall_sd: Mapping[str, float] = MappingProxyType({})
    stands: Mapping[str, int] = MappingProxyType({})


class Eye(NamedTuple):
    """A detector behind a calibrated lens. ``settle``: what is left to be done of a picture when
    its scene is told."""

    detector: Detector
    view: View
    undistort: Undistort = lambda picture: picture
    settle: Callable[[], None] = lambda: None

    def detect(self, picture: Picture, expected: Sequence[Detection] = ()) -> tuple[Detection, ...]:
        """What is seen in a picture as the camera took it; ``expected``: see `Detector`."""
        return self.detector.detect(self.undistort(picture), self.view, expected)


def look_at(
    seen: Seen, picture: Picture, eye: Eye, hint: Hint, rules: Rules = LIVE
) -> tuple[Seen, Sight]:
    """What is known after one more picture, and the scene of it."""
    hint = hint._replace(eye=eye.view.camera)
    found = eye.detect(picture, expected(seen.tracks, hint))
    return noticed(seen, found, picture.t, hint, rules)


def noticed(
    seen: Seen, detections: tuple[Detection, ...], t: float, hint: Hint, rules: Rules = LIVE
) -> tuple[Seen, Sight]:
    """The same from what a detector found in a picture taken at ``t``."""
    ready = _from_tray(seen, hint, t)
    tracks, events = track(ready.tracks, detections, t, hint, rules)
    after = replace(ready, tracks=tracks)
    return after, sight(after, t, hint)._replace(events=events)


def sight(seen: Seen, t: float, hint: Hint) -> Sight:
    """The scene of what is known at ``t``."""
    tracks = seen.tracks
    known = {one.id: one for one in tracks.known}
    on = carriers(tracks, hint.eye)
    objects = [_object(one, tracks, known, on, hint) for one in tracks.known]
    objects += [_on_floor(one) for one in tracks.gone if one.on == "floor"]
    sd = {one.id: one.at.sd for one in (*tracks.known, *_fallen(tracks))}
    last = {one.id: _last(one, tracks) for one in (*tracks.known, *_fallen(tracks))}
    unseen = {id_: t - seen for id_, seen in last.items() if seen < t}
    scene = Scene(objects=tuple(objects), tray=seen.tray, table_m=seen.table_m)
    tall_sd = {one.id: one.tall_sd for one in tracks.known}
    stands = {one.id: one.stand for one in tracks.known if one.stand and one.rested == t}
    return Sight(scene, sd, unseen, tall_sd=tall_sd, stands=stands)


def _last(one: Track, tracks: Tracks) -> float:
    """When a thing was last seen with nothing of the arm before it; what is held, when seen."""
    return one.seen if one.id == tracks.held else max(one.clear, one.born)


def _fallen(tracks: Tracks) -> tuple[Track, ...]:
    return tuple(one for one in tracks.gone if one.on == "floor")


def _object(
    one: Track, tracks: Tracks, known: Mapping[str, Track], on: Mapping[str, str], hint: Hint
) -> SceneObject:
    """A thing as the scene has it: where it stands and on what."""
    held = one.id == tracks.held
    z = one.base if held else base(one, known, on)
    x, y = one.place(hint.eye, z)
    where = "gripper" if held else on.get(one.id, "table")
    if where == "table" and max(abs(x), abs(y)) > EDGE:
        where = "floor"
    return msgspec.structs.replace(_plain(one, x, y), z=z, on=where, held=held)


def _plain(one: Track, x: float, y: float) -> SceneObject:
    shape = one.look
    return SceneObject(
        id=one.id, name=one.name, x=x, y=y, width=shape.width, height=shape.height,
        tall=one.tall, r=shape.r, color=shape.color, upright=shape.upright,
    )  # fmt: skip


def _on_floor(one: Track) -> SceneObject:
    """What went over the edge lies beside it, nobody sees where."""
    x, y = one.at.x, one.at.y
    far = EDGE + one.look.radius + FLOOR_GAP
    if abs(x) >= abs(y):
        x = float(np.copysign(max(abs(x), far), x))
    else:
        y = float(np.copysign(max(abs(y), far), y))
    return msgspec.structs.replace(_plain(one, x, y), on="floor")


# --- the tray ---------------------------------------------------------------------------------


def _from_tray(seen: Seen, hint: Hint, t: float) -> Seen:
    """What the tool takes hold of in the tray becomes a thing that is seen from then on."""
    where = hint.at or hint.tip
    seen = seen if seen.rows and not hint.idle else replace(seen, rows=seen.tray)
    if not seen.tray or where is None or not hint.grip or hint.felt is False:
        return seen
    if (seen.tracks.gripping and not hint.felt) or seen.tracks.hold is not None:
        return seen
    places = tray_positions(Scene(tray=seen.rows))
    for item in seen.tray:
        x, y = places.get(item.id, (np.inf, np.inf))
        if abs(x - where.x) < item.width / 2 and abs(y - where.y) < item.height / 2:
            tracks = seen.tracks
            one = _waiting(item, x, y, t)
            stem, _, number = item.id.rpartition("_")
            counts = dict(tracks.counts)
            if number.isdigit():
                counts[stem] = max(counts.get(stem, 0), int(number))
            known = replace(tracks, known=(*tracks.known, one), counts=counts)
            rest = tuple(other for other in seen.tray if other.id != item.id)
            return replace(seen, tracks=known, tray=rest)
    return seen


def _waiting(item: SceneObject, x: float, y: float, t: float) -> Track:
    """A thing of the tray as a track; its name was told, so it stays, and so were its sizes."""
    found = Detection(
        item.name, 1.0, x, y, FROM_TRAY, item.width, item.height, item.tall, 0.0, item.color,
        np.zeros(0, dtype=np.float32),
    )  # fmt: skip
    at = estimate.first(estimate.Sighting(x, y, FROM_TRAY))
    look_ = look.first(found, look.MEMORY)
    return Track(item.id, look_, at, t, clear=t, called=item.name, felt=item.tall)

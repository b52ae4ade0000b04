"""Figures of the tracker: do names stay with things, and how long does a picture take to the bus.

python -m evals.track_bench [--manipulations N] [--seed S]
"""

from __future__ import annotations

import argparse
import random
import sys
import threading
import time
from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from agent.bus import MemoryBus
from agent.messages import SceneSnapshot
from agent.wire import Message
from evals.figures import Figure, at_most, median
from evals.moving_table import (
    AWAY,
    EYE,
    RATE,
    Errors,
    Moment,
    hint,
    manipulations,
    sightings,
    table,
)
from scene.eye import Eye
from scene.lean import seen_at
from scene.live import EyeService, Pace
from scene.sight import Detection, Picture, View
from scene.track import track
from scene.tracks import Tracks

MANIPULATIONS, FRAMES = 1000, 200
NEAR = 0.12
"""How near to where a thing really is the track that bears its name must be (table units)."""


class Judged(NamedTuple):
    """How often a thing bore another id than before, or none, at the end of a manipulation.

    Of things alike that went over the edge together nobody can tell which comes back: their ids
    begin anew.
    """

    switches: int
    lost: int
    renamed: int
    seen: int


def judged(count: int, seed: int = 0, errors: Errors = Errors()) -> Judged:  # noqa: B008 - a value
    """Track so many manipulations and compare the ids of things with those they had before."""
    rng = random.Random(f"track {seed}")
    tracks, t = Tracks(), 0.0
    ids: dict[int, str] = {}
    away: set[int] = set()
    switches = lost = renamed = seen = 0
    for moment, ended in manipulations(rng, count):
        t += 1 / RATE
        tracks, events = track(tracks, sightings(moment, errors, rng), t, hint(moment))
        renamed += sum(event.kind == "renamed" for event in events)
        away |= {one.number for one in moment.things if not one.there}
        if not ended:
            continue
        now = identities(moment, tracks)
        for number in _confused(moment, away):
            ids.pop(number, None)
        away = set()
        switches += sum(ids[number] != id for number, id in now.items() if number in ids)
        there = [one.number for one in moment.things if one.there]
        lost += sum(number not in now for number in there)
        seen += len(there)
        ids.update(now)
    return Judged(switches, lost, renamed, seen)


def _confused(moment: Moment, away: Collection[int]) -> list[int]:
    """Things that were away together with another like them."""
    names = Counter(one.name for one in moment.things if one.number in away)
    return [one.number for one in moment.things if one.number in away and names[one.name] > 1]


def identities(moment: Moment, tracks: Tracks) -> dict[int, str]:
    """The id that each thing bears: that of the nearest track, if it is near enough."""
    found: dict[int, str] = {}
    for one in moment.things:
        if not one.there or not tracks.known:
            continue
        x, y = seen_at((one.x, one.y), one.z, EYE)
        best = min(tracks.known, key=lambda other: (other.at.x - x) ** 2 + (other.at.y - y) ** 2)
        if (best.at.x - x) ** 2 + (best.at.y - y) ** 2 < NEAR**2:
            found[one.number] = best.id
    return found


def frame_times(frames: int = FRAMES) -> list[float]:
    """Milliseconds from a picture being taken to its scene having arrived over the bus, with the
    detections at hand: tracking, encoding, the bus."""
    chance, moment = random.Random("frames"), Moment(table(random.Random("frames")), AWAY)
    bus, took, over = MemoryBus(), list[float](), threading.Event()

    taken: list[float] = []

    class Camera:
        def look(self) -> Picture:
            return Picture(np.zeros((4, 4, 3), np.uint8), time.time())

        def close(self) -> None: ...

        def detect(
            self, picture: Picture, view: View, expected: Sequence[Detection] = ()
        ) -> tuple[Detection, ...]:
            found = sightings(moment, Errors(), chance)
            taken.append(time.time())  # what the detector takes is no matter here
            return found

    def arrived(key: str, message: Message) -> None:
        if isinstance(message, SceneSnapshot) and len(message.scene.objects) == len(moment.things):
            took.append(1000 * (time.time() - taken[-1]))
            if len(took) >= frames:
                over.set()

    camera = Camera()
    eye = Eye(camera, View(np.eye(3), EYE))
    service = EyeService(bus, camera, eye, lambda pixels: b"", pace=Pace(looks=50.0))
    with bus.subscribe(bus.keys.objects(), arrived):
        service.start()
        over.wait(60.0)
        service.close()
    bus.close()
    return took


def figures(count: int = MANIPULATIONS) -> Mapping[str, Figure]:
    """Identity switches in so many simulated manipulations; things without a track; renamings."""
    result = judged(count)
    return {
        "track_identity_switches": at_most(result.switches, 2, "", count),
        "track_things_lost": at_most(result.lost, None, "", result.seen),
        "track_renamings": at_most(result.renamed, None, "", count),
        "track_frame_to_bus": median(frame_times()),
    }


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the counts."""
    parser = argparse.ArgumentParser(prog="python -m evals.track_bench", description=__doc__)
    parser.add_argument("--manipulations", type=int, default=MANIPULATIONS)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args(arguments)
    print(judged(options.manipulations, options.seed))
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""A tracker watched over pictures, as tests of it need it."""

import math

import numpy as np

from scene.sight import Detection
from scene.track import LIVE, track
from scene.tracks import Hint, Tracks
from scene.types import Pose

UP = 0.9
DT = 0.1
PLAIN = np.zeros(0, dtype=np.float32)


def seen(name, x, y, *, sd=0.01, color="red", size=0.36, tall=0.36, feature=PLAIN, stand=0):
    return Detection(name, 0.9, x, y, sd, size, size, tall, 0.0, color, feature, stand)


class Watch:
    """Pictures one after the other: ``look(detections)`` for a number of them."""

    def __init__(self, tracks=None, rules=LIVE):
        self.tracks, self.rules, self.t = tracks or Tracks(), rules, 100.0
        self.events = []

    def look(self, *detections, frames=1, hint=None):
        for _ in range(frames):
            self.t += DT
            arguments = (self.tracks, detections, self.t, hint or Hint(), self.rules)
            self.tracks, events = track(*arguments)
            self.events += [(event.kind, event.id) for event in events]
        return self

    def __getitem__(self, id):
        return next(one for one in self.tracks.known if one.id == id)

    @property
    def ids(self):
        return {one.id for one in self.tracks.known}

    def at(self, id):
        return self[id].at.x, self[id].at.y


def near(one, other, within=0.02):
    return math.dist(one, other) < within


def tip(x, y, z, *, grip=False, felt=None, eye=None, shades=()):
    return Hint(Pose(x, y, z), grip, felt, None, eye, shades)

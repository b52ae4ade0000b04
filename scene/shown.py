"""Things that a person has shown the camera: their features, kept under the name they were given.

A `Detection`'s feature is alike for things that look alike; a taught name is the nearest of what
was shown, unless nothing shown is near enough. Pure functions, and a small store in the user's
data folder (one JSON file; design: robot.md section 6, the `Detection` of `scene.sight`).
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import msgspec
import numpy as np
from numpy.typing import NDArray
from platformdirs import user_data_path

from agent.errors import ConfigError, SceneError
from scene.sight import Detection

NEAR = 0.55
"""Features further apart than this (Euclidean, both of length 1) are of different things. Of ten
things never learnt, shown 4 times, 85 % of 39 later looks were nearer, and 5 % of 107 at others."""
MOST = 40
"""So many views of one thing are kept, the newest."""
FILE = "shown.json"


class Shown(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What a person showed under one name: ``features`` (views, n), each of length 1."""

    name: str
    features: tuple[tuple[float, ...], ...]


def learnt(known: Sequence[Shown], name: str, views: Sequence[Detection]) -> tuple[Shown, ...]:
    """``known`` with these views of one thing added under a name.

    Raises SceneError without a name, without a view, or where features are of another length than
    those known (they come from other weights).
    """
    if not name.strip() or not views:
        raise SceneError("to learn a thing, its name and at least one view of it are needed")
    fresh = tuple(tuple(float(part) for part in view.feature) for view in views)
    lengths = {len(one) for shown in known for one in shown.features} | {len(f) for f in fresh}
    if len(lengths) > 1:
        raise SceneError("what was shown before was seen with other weights: forget it first")
    before = next((one.features for one in known if one.name == name), ())
    others = tuple(one for one in known if one.name != name)
    return (*others, Shown(name, (*before, *fresh)[-MOST:]))


def forgotten(known: Sequence[Shown], name: str) -> tuple[Shown, ...]:
    """``known`` without a name. Raises SceneError where nothing was shown under it."""
    if all(one.name != name for one in known):
        raise SceneError(f"no thing was shown under the name {name!r}")
    return tuple(one for one in known if one.name != name)


def nearest(
    known: Sequence[Shown], feature: NDArray[np.float32], near: float = NEAR
) -> tuple[str, float] | None:
    """The name of what looks most like a feature (n,), and how far that is; None: nothing near."""
    best: tuple[str, float] | None = None
    for shown in known:
        views = np.array(shown.features, np.float32)
        if views.shape[1] != len(feature):
            continue
        away = float(np.linalg.norm(views - feature, axis=1).min())
        if away <= near and (best is None or away < best[1]):
            best = shown.name, away
    return best


def named(known: Sequence[Shown], seen: Sequence[Detection]) -> tuple[Detection, ...]:
    """Detections under the names that a person gave to things like them."""
    result = []
    for one in seen:
        found = nearest(known, one.feature)
        result.append(one if found is None else replace(one, name=found[0]))
    return tuple(result)


class ShownStore:
    """The file of what was shown; by default in the user's data folder."""

    def __init__(self, folder: Path | None = None) -> None:
        self.path = (folder or user_data_path("armchat")) / FILE

    def load(self) -> tuple[Shown, ...]:
        """All that was shown; empty without a file. Raises ConfigError where it is damaged."""
        try:
            return msgspec.json.decode(self.path.read_bytes(), type=tuple[Shown, ...])
        except FileNotFoundError:
            return ()
        except (msgspec.DecodeError, OSError) as error:
            raise ConfigError(f"{self.path}: {error}") from error

    def learn(self, name: str, views: Sequence[Detection]) -> None:
        """Keep views of one thing under a name; the errors of `learnt` and `load`."""
        self._write(learnt(self.load(), name, views))

    def forget(self, name: str) -> None:
        """Forget a name and all that was shown under it; the errors of `forgotten` and `load`."""
        self._write(forgotten(self.load(), name))

    def _write(self, known: Sequence[Shown]) -> None:
        self.path.parent.mkdir(parents=True, exist_ok=True)
        unfinished = self.path.with_suffix(f".{os.getpid()}.part")
        unfinished.write_bytes(msgspec.json.format(msgspec.json.encode(known)))
        unfinished.replace(self.path)

"""The pictures that the detector learns from: drawn once, kept in shards, gone on with if cut off.

Four in five are of `scene.pictured`, one is PyBullet's. A shard is a file of 100 pictures
rectified to the table, with where they were seen from and what is true of them.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import msgspec
import numpy as np

from evals.bullet_sights import bullet_sight
from robot_bridge.bullet import BulletRobot
from scene.pictured import Label, Sight, Terms, level_sight
from scene.rectify import Grid, rectified
from scene.train_detector import GRID, Lessons

SHARD = 100
BULLET_SHARE = 5
"""One picture in so many is the simulator's."""
AGAIN = 3
"""How often each of those is shown for once that another is."""


def lessons(folder: Path, pictures: int, seed: int) -> Lessons:
    """The pictures with this seed, read from ``folder``; those that it lacks are drawn first."""
    folder.mkdir(parents=True, exist_ok=True)
    for number in range(-(-pictures // SHARD)):
        path = folder / f"seed{seed}_{number:04}.npz"
        if not path.exists():
            _write(path, seed, number)
            print(f"pictures: {(number + 1) * SHARD} of {pictures}", flush=True)
    return _read([folder / f"seed{seed}_{n:04}.npz" for n in range(-(-pictures // SHARD))])


def _write(path: Path, seed: int, shard: int) -> None:
    sights = list(_sights(seed, shard))
    levels = np.stack([level for level, _ in sights])
    cameras = np.array([sight.view.camera for _, sight in sights])
    labels = msgspec.json.encode([sight.labels for _, sight in sights])
    unfinished = path.with_suffix(".part.npz")
    np.savez(unfinished, levels=levels, cameras=cameras, labels=np.frombuffer(labels, np.uint8))
    unfinished.rename(path)


def _sights(
    seed: int, shard: int
) -> Iterator[tuple[np.ndarray[tuple[int, ...], np.dtype[np.uint8]], Sight]]:
    robot = BulletRobot()
    try:
        for number in range(shard * SHARD, (shard + 1) * SHARD):
            if number % BULLET_SHARE == 0:
                sight = bullet_sight(robot, f"lesson {seed} {number}")
                yield rectified(sight.picture.pixels, sight.view, GRID), sight
            else:
                sight = level_sight(f"lesson {seed} {number}", Terms(), _half(GRID), GRID.size)
                yield sight.picture.pixels, sight
    finally:
        robot.close()


def _half(grid: Grid) -> float:
    return grid.size * grid.pixel / 2


def _read(paths: list[Path]) -> Lessons:
    levels, cameras, labels = [], [], list[tuple[Label, ...]]()
    for path in paths:
        with np.load(path) as shard:
            levels.append(shard["levels"])
            cameras.append(shard["cameras"])
            labels += msgspec.json.decode(shard["labels"].tobytes(), type=list[tuple[Label, ...]])
    order = [n for n in range(len(labels)) for _ in range(1 if n % BULLET_SHARE else AGAIN)]
    return Lessons(
        np.concatenate(levels)[order],
        np.concatenate(cameras)[order],
        tuple(labels[n] for n in order),
    )

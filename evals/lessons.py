"""The pictures that the detector learns from, drawn by processes while it learns. Seeded.

    python -m evals.lessons FOLDER --seed S --worker W --of N [--shards K]

Half are tables of `scene.pictured` as a camera shows them, a quarter such tables straight from
above, a quarter look like PyBullet's (`evals.bullet_like`). A shard is a file of a few pictures
rectified to the table, with where they were seen from and what is true of them; and, of those a
camera showed, the picture and the boxes of things in it.
"""

from __future__ import annotations

import argparse
import os
import random
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from agent.errors import ConfigError
from evals.bullet_like import bullet_like
from scene.pictured import Sight, Terms, camera_sight, level_sight, thirds
from scene.rectify import rectified
from scene.sight import Pixels
from scene.strange import ANY, SEEN
from scene.truth import COLUMNS, GRID, MOST, Lessons, truth

SHARD = 10
FRAME = (320, 240)
"""Pixels of the pictures that are kept as a camera showed them."""
ROOM = (*SEEN, *ANY, *ANY, *ANY)
SIZES = ((640, 480), (640, 480), (480, 360))


class Lesson(NamedTuple):
    """A picture rectified, its sight, and the picture itself where a camera showed it."""

    level: Pixels
    sight: Sight
    frame: Pixels | None


def lesson(seed: int, number: int) -> Lesson:
    """The picture of this number."""
    name, chance = f"lesson {seed} {number}", random.Random(f"which {seed} {number}")
    what, usual = chance.random(), chance.random() < 0.4
    terms = Terms(families=ROOM, strange=0.33)
    if usual:  # as cameras mostly are: upright, in fair light, the things of their own sizes
        terms = terms._replace(height=(2.3, 5.0), tilt=(0.0, 11.0), wide=0.0)
    if what < 0.5:
        sight = camera_sight(name, terms, *chance.choice(SIZES))
    elif what < 0.75:
        sight = bullet_like(name)
    else:
        sight = level_sight(name, terms, GRID.size * GRID.pixel / 2, GRID.size)
        return Lesson(sight.picture.pixels, sight, None)
    level = rectified(sight.picture.pixels, sight.view, GRID)
    return Lesson(level, sight, _shrunk(sight.picture.pixels))


def _shrunk(pixels: Pixels) -> Pixels:
    """A picture at `FRAME`: as it is, two thirds or half of it."""
    width = pixels.shape[1]
    if width == FRAME[0]:
        return pixels
    plane = pixels.astype(np.float32)
    if width == 3 * FRAME[0] // 2:
        return np.rint(thirds(plane)).astype(np.uint8)
    halved: Pixels = np.rint(plane.reshape(FRAME[1], 2, FRAME[0], 2, 3).mean((1, 3))).astype(
        np.uint8
    )
    return halved


def _boxes(sight: Sight) -> NDArray[np.float32]:
    """Left, top, right, bottom as shares of the picture's sides (`MOST`, 4), as `truth`'s rows."""
    boxes = np.zeros((MOST, 4), np.float32)
    high, wide = sight.picture.pixels.shape[:2]
    for row, one in zip(boxes, sight.labels, strict=False):
        row[:] = (np.array(one.box) + 0.5) / (wide, high, wide, high)
    return boxes


def write_shard(path: Path, seed: int, numbers: Sequence[int]) -> None:
    """Draw these pictures and write them, aside first."""
    made = [lesson(seed, number) for number in numbers]
    framed = [one for one in made if one.frame is not None]
    unfinished = path.with_suffix(".part.npz")
    np.savez(
        unfinished,
        levels=np.stack([one.level for one in made]),
        cameras=np.array([one.sight.view.camera for one in made], np.float32),
        rows=np.stack([truth(one.sight.labels) for one in made]),
        frames=np.stack([one.frame for one in framed if one.frame is not None])
        if framed else np.zeros((0, FRAME[1], FRAME[0], 3), np.uint8),
        boxes=np.stack([_boxes(one.sight) for one in framed])
        if framed else np.zeros((0, MOST, 4), np.float32),
        named=np.stack([truth(one.sight.labels) for one in framed])
        if framed else np.zeros((0, MOST, len(COLUMNS)), np.float32),
    )  # fmt: skip
    unfinished.rename(path)


def shard_path(folder: Path, seed: int, number: int) -> Path:
    """Where the shard of this number is."""
    return folder / f"seed{seed}_{number:05}.npz"


def draw(folder: Path, seed: int, worker: int, of: int, shards: int) -> None:
    """Every ``of``-th shard from number ``worker`` on, those that are there left as they are."""
    folder.mkdir(parents=True, exist_ok=True)
    for number in range(worker, shards, of):
        path = shard_path(folder, seed, number)
        if not path.exists():
            write_shard(path, seed, range(number * SHARD, (number + 1) * SHARD))


class Drawing:
    """Processes that draw into a folder until they are done, or left; `fresh` is what is new.

    What was drawn by the time it was left is told as before: to be ended then is no failure.
    """

    def __init__(self, folder: Path, pictures: int, seed: int, workers: int) -> None:
        self._folder, self._seed, self._next = folder, seed, list(range(workers))
        alone = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
        command = [sys.executable, "-m", "evals.lessons", str(folder), "--seed", str(seed),
                   "--of", str(workers), "--shards", str(-(-pictures // SHARD))]  # fmt: skip
        self._processes = [
            subprocess.Popen([*command, "--worker", str(worker)], env={**os.environ, **alone})
            for worker in range(workers)
        ]

    def __enter__(self) -> Drawing:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        for process in self._processes:
            process.terminate()
        while self._processes:
            self._processes.pop().wait()

    def fresh(self, most: int = 4) -> list[Lessons]:
        """Shards that were finished since, each process's own in order, so many of each at most.

        Raises ConfigError where every process has failed.
        """
        failed = [process.poll() not in (None, 0) for process in self._processes]
        if failed and all(failed):
            raise ConfigError(f"all {len(self._processes)} drawing processes ended with an error")
        new = list[Lessons]()
        for worker in range(len(self._next)):
            for _ in range(most):
                path = shard_path(self._folder, self._seed, self._next[worker])
                if not path.exists():
                    break
                new.append(_lessons(path))
                self._next[worker] += len(self._next)
        return new


def _lessons(path: Path) -> Lessons:
    with np.load(path) as shard:
        return Lessons(shard["levels"], shard["cameras"], shard["rows"])


def main(arguments: Sequence[str] | None = None) -> int:
    """Draw one worker's shards."""
    parser = argparse.ArgumentParser(prog="python -m evals.lessons", description=__doc__)
    parser.add_argument("folder", type=Path)
    for name, default in (("seed", 0), ("worker", 0), ("of", 1), ("shards", 1)):
        parser.add_argument(f"--{name}", type=int, default=default)
    options = parser.parse_args(arguments)
    draw(options.folder, options.seed, options.worker, options.of, options.shards)
    return 0


if __name__ == "__main__":
    sys.exit(main())

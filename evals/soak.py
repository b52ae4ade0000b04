"""Work for a while on the simulated table, and say by how much memory grew.

    python -m evals.soak --minutes N

Random scenes are loaded, a thing is picked up, put elsewhere and pictured, again and again.
"""

from __future__ import annotations

import argparse
import random
import resource
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from agent.messages import Command
from robot_bridge.api import approve
from robot_bridge.bullet import BulletRobot
from scene.generate import CLASSES, random_scene
from scene.types import Scene

WARM_UP = 50
"""Rounds before the memory is taken down: pools fill at first."""
THINGS = 5


class Soaked(NamedTuple):
    """Rounds after the warm-up, megabytes then and at the end."""

    rounds: int
    before: float
    after: float

    @property
    def growth(self) -> float:
        """Megabytes a thousand rounds."""
        return 1000 * (self.after - self.before) / max(1, self.rounds)


def resident() -> float:
    """Megabytes of this process in memory."""
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * resource.getpagesize() / 2**20


def soak(seconds: float) -> Soaked:
    """Rounds for so many seconds after the warm-up."""
    robot, rounds, before, until = BulletRobot(), 0, 0.0, 0.0
    try:
        while rounds < WARM_UP or time.monotonic() < until:
            _round(robot, rounds)
            rounds += 1
            if rounds == WARM_UP:
                before, until = resident(), time.monotonic() + seconds
    finally:
        robot.close()
    return Soaked(rounds - WARM_UP, before, resident())


def _round(robot: BulletRobot, number: int) -> None:
    chance = random.Random(number)
    scene = random_scene(chance, chance.sample(sorted(CLASSES), THINGS))
    robot.load(scene)
    list(robot.run(approve(_moves(scene), robot.pose(), robot)))
    robot.picture(64, 48)


def _moves(scene: Scene) -> list[Command]:
    item = scene.objects[0]
    (x, y), top = item.position, item.top
    path = [(x, y, 1.2), (x, y, top), (x, y, 1.2), (-x, y, 1.2)]
    moves = [Command("move", *at, 0.0, False) for at in path]
    return [*moves[:2], Command("grip", x, y, top, 0.0, True), *moves[2:]]


def main(arguments: Sequence[str] | None = None) -> int:
    """Soak and print; 1 if memory grew by more than 5 MB a thousand rounds."""
    parser = argparse.ArgumentParser(prog="python -m evals.soak", description=__doc__)
    parser.add_argument("--minutes", type=float, default=1.0)
    result = soak(60 * parser.parse_args(arguments).minutes)
    print(
        f"{result.rounds} rounds: {result.before:.1f} MB, then {result.after:.1f} MB "
        f"({result.growth:+.2f} MB a thousand rounds)"
    )
    return int(result.growth > 5.0)


if __name__ == "__main__":
    sys.exit(main())

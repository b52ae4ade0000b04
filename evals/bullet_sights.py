"""PyBullet's tables as its overhead camera shows them, with what is true of them. Seeded."""

from __future__ import annotations

import math
import random
from collections.abc import Iterator, Sequence

from evals.bullet_like import ANGULAR, KNOWN, ROUND, STRANGE
from robot_bridge.bullet import BulletRobot, overhead
from scene.generate import CLASSES, SPREAD
from scene.peaks import OTHER, folded
from scene.pictured import Label, Sight
from scene.shapes import KINDS, MM
from scene.sight import Picture
from scene.types import Scene, SceneObject

UNSEEN = ("basket", "pan", "phone", "knife", "fork", "pencil", "brick", "car")
"""Nouns of no kind kept for tests. In neither: what the simulator makes look like a kind (a mug
like a cup, a tomato like an apple, a cube like a block)."""
SIZES = ((320, 240), (320, 240), (480, 360), (640, 480))


def simulated(
    seed: str, pictures: int, strange: Sequence[str] = STRANGE, wide: float = 0.5
) -> Iterator[Sight]:
    """So many random tables of the simulator."""
    robot = BulletRobot()
    try:
        for number in range(pictures):
            yield bullet_sight(robot, f"{seed} {number}", strange, wide, SIZES[0])
    finally:
        robot.close()


def bullet_sight(
    robot: BulletRobot,
    seed: str,
    strange: Sequence[str] = STRANGE,
    wide: float = 0.5,
    size: tuple[int, int] | None = None,
) -> Sight:
    """A random table of the simulator; ``wide``: how often things are of any size."""
    chance = random.Random(seed)
    robot.load(Scene(objects=tuple(_things(chance, strange, wide))))
    scene = robot.scene()
    width, height = size or chance.choice(SIZES)
    labels = tuple(_label(item) for item in scene.objects)
    return Sight(Picture(robot.picture(width, height), 0.0), overhead(width, height), labels)


def _things(chance: random.Random, strange: Sequence[str], wide: float) -> list[SceneObject]:
    overall = math.exp(chance.uniform(-1.2, 0.35)) if chance.random() < wide else 1.0
    found: list[SceneObject] = []
    for number in range(chance.randint(1, 9)):
        name = chance.choice(KNOWN if chance.random() < 0.75 else strange)
        kind = CLASSES[name]
        scale = chance.uniform(*SPREAD)
        if name in KINDS and name not in ANGULAR:
            scale *= overall
        size = [kind.width, kind.height, kind.tall]
        if name in KINDS and chance.random() < 0.5:
            size = [side * MM for side in KINDS[name].size]
        w, h, t = (round(side * scale, 3) for side in size)
        colors = [*kind.colors, *(KINDS[name].colors if name in KINDS else ())]
        r = chance.uniform(-math.pi, math.pi) if chance.random() < 0.6 else 0.0
        for _ in range(20):
            x, y = chance.uniform(-0.9, 0.9), chance.uniform(-0.9, 0.9)
            reach = math.hypot(w, h) / 2
            if all(math.dist((x, y), (o.x or 0, o.y or 0)) > reach + 0.03
                   + math.hypot(o.width, o.height) / 2 for o in found):  # fmt: skip
                found.append(SceneObject(
                    id=f"{name}_{number}", name=name, x=x, y=y, width=w, height=h, tall=t, r=r,
                    color=chance.choice(colors) if colors and chance.random() < 0.9 else None,
                ))  # fmt: skip
                break
    return found


def _label(item: SceneObject) -> Label:
    """What is true of a thing; of one that toppled or fell, only that it is no fault to miss it."""
    even = item.name in ROUND and abs(item.width - item.height) < 1e-3
    width, height, r = folded(item.width, item.height, 0.0 if even else item.r)
    stands = item.on == "table" and item.upright
    name = item.name if item.name in KINDS else OTHER
    x, y = item.position
    return Label(name, item.color, x, y, width, height, item.tall, r, even, float(stands),
                 f"{item.name} {item.color}", None, item.name)  # fmt: skip

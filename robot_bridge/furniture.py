"""The simulated world's bodies: table, floor, tool and things (needs a physics client passed in).

Lengths are table units. Groups decide what meets what: things meet things and the tool; things
that wait in the tray meet the tool only; what fell meets nothing but the floor.
"""

from __future__ import annotations

import random
import threading
from collections.abc import Sequence
from typing import Any, TypeAlias

from robot_bridge import objects
from robot_bridge.drawing import PALE, RGBA
from scene.colors import COLOR_VALUES
from scene.types import EDGE, Pose, SceneObject

Physics: TypeAlias = Any
"""A client of the physics engine: pybullet's functions, which have no types."""
FLOOR = -0.7
"""Height of the room's floor."""
FRICTION = 0.55
"""Of every surface; the engine multiplies two of them to 0.3."""
LIGHTEST, HEAVIEST = 0.03, 5.0
"""Bounds of a thing's mass (kg): the solver does not like large ratios."""
TOOL_RADIUS, TOOL_LENGTH, TOOL_KG = 0.04, 0.5, 0.3
THING, TOOL, TRAY, GROUND = 1, 2, 4, 8
"""Collision groups."""


class Thing:
    """A simulated object: what the scene says of it, and its body in the engine.

    ``low``: height of its centre of mass above its middle; ``hook``: the constraint that holds
    it in the tray; ``fallen``: it lies on the floor.
    """

    def __init__(self, item: SceneObject, low: float, body: int) -> None:
        self.item, self.body, self.low = item, body, low
        self.size = (item.width, item.height, item.tall)
        self.hook: int | None = None
        self.fallen = item.on == "floor"


def make_ground(p: Physics) -> None:
    """The table and the floor below it."""
    _slab(p, (EDGE, EDGE, 0.05), -0.05, THING, (0.80, 0.76, 0.70, 1.0))
    _slab(p, (6.0, 6.0, 0.05), FLOOR - 0.05, GROUND, (0.45, 0.45, 0.48, 1.0))


def _slab(p: Physics, half: Sequence[float], z: float, group: int, rgba: RGBA) -> None:
    shape = p.createCollisionShape(p.GEOM_BOX, halfExtents=half)
    look = p.createVisualShape(p.GEOM_BOX, halfExtents=half, rgbaColor=rgba)
    body = p.createMultiBody(0, shape, look, (0, 0, z))
    p.changeDynamics(body, -1, lateralFriction=FRICTION, rollingFriction=0.02)
    p.setCollisionFilterGroupMask(body, -1, group, THING | TOOL if group == THING else group)


def make_tool(p: Physics, tip: Pose) -> tuple[int, int]:
    """The tool with its tip at a pose: its body, and the constraint that drives it."""
    shape = p.createCollisionShape(p.GEOM_CYLINDER, radius=TOOL_RADIUS, height=TOOL_LENGTH)
    rgba = (0.2, 0.2, 0.25, 1.0)
    look = p.createVisualShape(
        p.GEOM_CYLINDER, radius=TOOL_RADIUS, length=TOOL_LENGTH, rgbaColor=rgba
    )
    centre = (tip.x, tip.y, tip.z + TOOL_LENGTH / 2)
    tool = p.createMultiBody(TOOL_KG, shape, look, centre)
    p.changeDynamics(tool, -1, lateralFriction=FRICTION, angularDamping=1.0)
    p.setCollisionFilterGroupMask(tool, -1, TOOL, THING | TRAY)
    zero = (0, 0, 0)
    return tool, p.createConstraint(tool, -1, -1, -1, p.JOINT_FIXED, zero, zero, centre)


def make_thing(
    p: Physics, item: SceneObject, x: float, y: float, per_metre: float, rng: random.Random
) -> Thing:
    """A thing at its place; its mass follows from its noun and size, give or take 5 %."""
    model = objects.model(item.name, item.width, item.height, item.tall)
    volume = item.width * item.height * item.tall / per_metre**3
    mass = min(max(model.density * volume * rng.uniform(0.95, 1.05), LIGHTEST), HEAVIEST)
    low = (model.centre - 0.5) * item.tall
    base = FLOOR if item.on == "floor" else item.z
    body = p.createMultiBody(
        mass,
        *_shapes(p, model, (*COLOR_VALUES.get(item.color or "", PALE), 1.0)),
        basePosition=(x, y, base + item.tall / 2),
        baseOrientation=p.getQuaternionFromEuler((0, 0, item.r)),
        baseInertialFramePosition=(0, 0, low),
    )
    p.changeDynamics(
        body,
        -1,
        lateralFriction=FRICTION,
        rollingFriction=0.02,
        spinningFriction=0.01,
        restitution=0.0,
        angularDamping=0.2,
    )
    thing = Thing(item, low, body)
    set_group(p, thing, GROUND if thing.fallen else THING)
    return thing


def hang(p: Physics, thing: Thing) -> None:
    """Fix a thing where it is, out of everything's way but the tool's."""
    set_group(p, thing, TRAY)
    at, turn = p.getBasePositionAndOrientation(thing.body)
    zero = (0, 0, 0)
    thing.hook = p.createConstraint(
        thing.body, -1, -1, -1, p.JOINT_FIXED, zero, zero, at, (0, 0, 0, 1), turn
    )


def set_group(p: Physics, thing: Thing, group: int) -> None:
    """Say what a thing meets from now on.

    A meeting needs the consent of both sides. Rays belong to the group of things, which is why
    those in the tray consent to it.
    """
    meets = {THING: THING | TOOL, TRAY: TOOL | THING, GROUND: GROUND}[group]
    p.setCollisionFilterGroupMask(thing.body, -1, group, meets)


def _shapes(p: Physics, model: objects.Model, rgba: RGBA) -> tuple[int, int]:
    """Collision and visual shape of a model."""
    if model.rings:
        with _LENDING:
            points, indices = _lent(*objects.triangles(model.rings))
            return (
                p.createCollisionShape(p.GEOM_MESH, vertices=points),
                p.createVisualShape(p.GEOM_MESH, vertices=points, indices=indices, rgbaColor=rgba),
            )
    kinds = [p.GEOM_BOX] * len(model.parts)
    halves = [part.half for part in model.parts]
    places = [part.at for part in model.parts]
    turns = [p.getQuaternionFromEuler((0, 0, part.yaw)) for part in model.parts]
    shape = p.createCollisionShapeArray(
        shapeTypes=kinds,
        halfExtents=halves,
        collisionFramePositions=places,
        collisionFrameOrientations=turns,
    )
    look = p.createVisualShapeArray(
        shapeTypes=kinds,
        halfExtents=halves,
        visualFramePositions=places,
        visualFrameOrientations=turns,
        rgbaColors=[rgba] * len(kinds),
    )
    return shape, look


_LENDING = threading.Lock()
_ROWS: dict[int, list[list[float]]] = {}
_INDICES: dict[tuple[int, ...], list[int]] = {}


def _lent(
    points: Sequence[objects.Vector], indices: Sequence[int]
) -> tuple[list[list[float]], list[int]]:
    """The same values in lists that are used again and again, under `_LENDING`.

    The engine never gives back a sequence of vertices or indices that it was handed: fresh ones
    would be 8 kB lost with each shape.
    """
    rows = _ROWS.setdefault(len(points), [[0.0, 0.0, 0.0] for _ in points])
    for row, point in zip(rows, points, strict=True):
        row[:] = point
    return rows, _INDICES.setdefault(tuple(indices), list(indices))

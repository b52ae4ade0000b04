"""What stands on the table: frame, units and the values every part shares.

Frame (table frame, everywhere but inside a robot's or a camera's own module): the table is
the square ``-1 <= x <= 1``, ``-1 <= y <= 1``; x points right, y away from the person, z up,
``z = 0`` is the table's surface. One unit is half a table side (0.20 m by default). ``r`` is a
rotation about z in radians, counter-clockwise seen from above.
"""

from __future__ import annotations

import keyword
import math
import re
from collections.abc import Iterator

import msgspec

from agent.errors import SceneError

EDGE = 1.0
"""Half the table's side, in table units: the table's edges are at -EDGE and +EDGE."""

RESERVED_NAMES = frozenset(
    {"robot", "solver", "math", "Variable", "range", "len", "abs", "min", "max", "sum", "round"}
    | {"sorted", "list", "tuple", "int", "float", "bool", "True", "False", "None"}
    | set(keyword.kwlist)
    | set(keyword.softkwlist)
)
"""Names that a program already gives a meaning, so no object may be called by them."""


class Pose(msgspec.Struct, frozen=True):
    """Pose of the end effector: tip position (table units) and rotation about z (radians)."""

    x: float
    y: float
    z: float
    r: float = 0.0


class SceneObject(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One thing on the table, on the floor, in the gripper or waiting in the tray.

    ``x, y`` is the centre of the footprint (None in the tray), ``z`` the height of its base,
    ``width`` its extent along x, ``height`` along y, ``tall`` its height above its base; all in
    table units. ``on`` is ``table``, ``floor``, ``tray``, ``gripper`` or the id of the object
    that carries it.
    """

    id: str
    name: str
    x: float | None = None
    y: float | None = None
    z: float = 0.0
    width: float
    height: float
    tall: float
    r: float = 0.0
    color: str | None = None
    on: str = "table"
    upright: bool = True
    held: bool = False

    @property
    def position(self) -> tuple[float, float]:
        """Centre of the footprint (table units). Raises SceneError for an object in the tray."""
        if self.x is None or self.y is None:
            raise SceneError(f"{self.id} has no position: it waits in the tray")
        return self.x, self.y

    @property
    def top(self) -> float:
        """Height of the object's upper side above the table (table units)."""
        return self.z + self.tall


class Scene(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """All objects at one moment. ``table_m`` is the physical side of the table in metres."""

    objects: tuple[SceneObject, ...] = ()
    tray: tuple[SceneObject, ...] = ()
    table_m: float = 0.40

    def __iter__(self) -> Iterator[SceneObject]:
        yield from self.objects
        yield from self.tray

    def get(self, object_id: str) -> SceneObject:
        """The object with this id. Raises SceneError when there is none."""
        for item in self:
            if item.id == object_id:
                return item
        raise SceneError(f"no object {object_id!r} in the scene")

    def replace(self, changed: SceneObject) -> Scene:
        """A copy in which the object of the same id on the table is ``changed``."""
        swap = tuple(changed if item.id == changed.id else item for item in self.objects)
        return msgspec.structs.replace(self, objects=swap)

    def units(self, metres: float) -> float:
        """Metres in the world as table units."""
        return metres / (self.table_m / 2)


def read_scene(data: object) -> Scene:
    """Turn decoded JSON (the ``scene`` object of the machine interface) into a Scene.

    Raises SceneError that names the object, the field and what is wrong with it.
    """
    try:
        scene = msgspec.convert(data, Scene)
    except msgspec.ValidationError as error:
        raise SceneError(f"scene: {error}") from error
    tray = tuple(msgspec.structs.replace(item, on="tray", x=None, y=None) for item in scene.tray)
    scene = msgspec.structs.replace(scene, tray=tray)
    _validate(scene)
    return scene


def _validate(scene: Scene) -> None:
    seen: set[str] = set()
    if not (math.isfinite(scene.table_m) and scene.table_m > 0):
        raise SceneError(f"scene.table_m must be a positive number, not {scene.table_m}")
    for item in scene:
        where = f"scene object {item.id!r}"
        if not item.id or not item.name.strip():
            raise SceneError(f"{where}: id and name must not be empty")
        if item.id in seen:
            raise SceneError(f"{where}: the id is used twice")
        seen.add(item.id)
        for field in ("width", "height", "tall"):
            size = getattr(item, field)
            if not (math.isfinite(size) and 0 < size <= 4):
                raise SceneError(f"{where}: {field} must be in (0, 4] table units, not {size}")
        for field in ("x", "y", "z", "r"):
            value = getattr(item, field)
            if value is not None and not (math.isfinite(value) and abs(value) <= 100):
                raise SceneError(f"{where}: {field} must be a finite number, not {value}")
    for item in scene.objects:
        if item.x is None or item.y is None:
            raise SceneError(f"scene object {item.id!r}: x and y are needed on the table")


def slug(text: str) -> str:
    """An identifier made of a name: lower case, words joined by underscores, at most 40 long."""
    word = re.sub(r"[^a-z0-9]+", "_", text.lower()).strip("_")[:36]
    if not word or word[0].isdigit():
        word = f"item_{word}".rstrip("_")
    return f"{word}_object" if word in RESERVED_NAMES else word


def identifiers(scene: Scene) -> dict[str, SceneObject]:
    """The name by which a program knows each object, in scene order.

    A name borne by one object only is that object's identifier ("red cube" -> ``red_cube``);
    objects that share a name are told apart by their ids.
    """
    names = [slug(item.name) for item in scene]
    result: dict[str, SceneObject] = {}
    for item, name in zip(scene, names, strict=True):
        stem = name if names.count(name) == 1 else slug(item.id)
        identifier, count = stem, 2
        while identifier in result or (identifier in names and identifier != name):
            identifier, count = f"{stem}_{count}", count + 1
        result[identifier] = item
    return result

"""What spatial words mean, once, for corpus, clarifier, scorer and questions about the scene.

Each relation is a predicate over objects of one scene. Distances are table units, edges are
those of the axis-aligned footprints, directions are the person's.
"""

from __future__ import annotations

import math

from scene.types import EDGE, Scene, SceneObject

NEAR_M = 0.06
"""Largest gap, edge to edge, that is "next to" (metres)."""
CORNER_M = 0.08
"""Largest distance of an object's own edge from the table's for "in the corner", "at the edge"."""
ALONG = {"left": (-1, 0), "right": (1, 0), "above": (0, 1), "below": (0, -1)}
"""Unit vector of each direction word, in the table frame."""


def extents(item: SceneObject) -> tuple[float, float]:
    """Half extents of the axis-aligned footprint along x and y, rotation included."""
    cos, sin = abs(math.cos(item.r)), abs(math.sin(item.r))
    return (
        (item.width * cos + item.height * sin) / 2,
        (item.width * sin + item.height * cos) / 2,
    )


def upon(scene: Scene, carrier: str) -> set[str]:
    """The ids of all that stands on a thing or in it, directly or on what stands there."""
    found, grown = {carrier}, -1
    while grown != len(found):
        grown = len(found)
        found |= {other.id for other in scene.objects if other.on in found}
    return found - {carrier}


def beneath(scene: Scene, item: SceneObject) -> tuple[str, ...]:
    """The ids of what a thing stands on or in, and what that stands on, the nearest first."""
    things, found = {other.id: other for other in scene.objects}, list[str]()
    while item.on in things and item.on not in found:
        item = things[item.on]
        found.append(item.id)
    return tuple(found)


def gap(one: SceneObject, other: SceneObject) -> float:
    """Distance between two footprints, edge to edge (table units; 0 when they overlap)."""
    (x1, y1), (x2, y2) = one.position, other.position
    (w1, h1), (w2, h2) = extents(one), extents(other)
    return math.hypot(max(0.0, abs(x1 - x2) - w1 - w2), max(0.0, abs(y1 - y2) - h1 - h2))


def beside(scene: Scene, one: SceneObject, other: SceneObject, direction: str) -> bool:
    """Whether ``one`` lies in ``direction`` of ``other``, within 45 degrees of that axis."""
    dx, dy = ALONG[direction]
    (x1, y1), (x2, y2) = one.position, other.position
    along = (x1 - x2) * dx + (y1 - y2) * dy
    across = abs((x1 - x2) * dy + (y1 - y2) * dx)
    return along > 0 and along >= across - 1e-6


def next_to(scene: Scene, one: SceneObject, other: SceneObject) -> bool:
    """Whether the gap is at most 6 cm and neither stands on the other."""
    apart = one.on != other.id and other.on != one.id
    return apart and gap(one, other) <= scene.units(NEAR_M) + 1e-6


def between(one: SceneObject, first: SceneObject, second: SceneObject) -> bool:
    """Whether ``one`` lies well between two others: in the middle half of the line joining them."""
    (x, y), (x1, y1), (x2, y2) = one.position, first.position, second.position
    length = math.hypot(x2 - x1, y2 - y1)
    if length < 1e-9:
        return False
    share = ((x - x1) * (x2 - x1) + (y - y1) * (y2 - y1)) / length**2
    away = abs((x - x1) * (y2 - y1) - (y - y1) * (x2 - x1)) / length
    return 0.25 <= share <= 0.75 and away <= max(extents(one)) + 1e-6


def edge_distance(item: SceneObject, side: str) -> float:
    """Distance of the object's own edge from the table's edge on that side (table units)."""
    dx, dy = ALONG[side]
    x, y = item.position
    half_x, half_y = extents(item)
    return EDGE - (x * dx + y * dy + (half_x if dx else half_y))


def at_edge(scene: Scene, item: SceneObject, side: str) -> bool:
    """Whether the object is on the table with its own edge within 8 cm of the table's ``side``."""
    return on_table(item) and edge_distance(item, side) <= scene.units(CORNER_M) + 1e-6


def in_corner(scene: Scene, item: SceneObject, *sides: str) -> bool:
    """Whether the object's edges are within 8 cm of both sides ("above", "left": the far left)."""
    return all(at_edge(scene, item, side) for side in sides)


def centred(scene: Scene, item: SceneObject) -> bool:
    """Whether the object's centre is within 8 cm of the table's middle."""
    return on_table(item) and math.hypot(*item.position) <= scene.units(CORNER_M) + 1e-6


def on_table(item: SceneObject) -> bool:
    """Whether the object stands on the table itself."""
    return item.on == "table"


def off_table(item: SceneObject) -> bool:
    """Whether the object lies on the floor."""
    return item.on == "floor"


def off_side(item: SceneObject, side: str) -> bool:
    """Whether the object fell over that side of the table."""
    dx, dy = ALONG[side]
    x, y = item.position
    return off_table(item) and x * dx + y * dy > EDGE - 1e-6


def in_row(items: list[SceneObject], tolerance: float = 0.05) -> bool:
    """Whether the objects share one y (table units)."""
    ys = [item.position[1] for item in items]
    return max(ys) - min(ys) <= tolerance


def in_column(items: list[SceneObject], tolerance: float = 0.05) -> bool:
    """Whether the objects share one x (table units)."""
    xs = [item.position[0] for item in items]
    return max(xs) - min(xs) <= tolerance


def moved(before: SceneObject, after: SceneObject, tolerance: float = 0.01) -> float:
    """How far an object moved between two scenes (table units); 0 within the tolerance."""
    if before.x is None or after.x is None:
        return 0.0 if before.x is after.x else math.inf
    (x1, y1), (x2, y2) = before.position, after.position
    far = math.dist((x1, y1, before.z), (x2, y2, after.z))
    return far if far > tolerance or before.upright != after.upright else 0.0

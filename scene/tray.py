"""Where objects of the tray physically wait: a shelf beside the table's right edge.

The paper's arrange task gives tray objects sizes but no position; an arm needs one to pick from.
"""

from __future__ import annotations

from scene.types import EDGE, Scene

GAP = 0.06
"""Clearance between neighbours and to the table's edge (table units)."""
DEPTH = 0.60
"""How far beyond the table an object's centre may wait (table units): the arm reaches no more."""


def tray_positions(scene: Scene) -> dict[str, tuple[float, float]]:
    """Centre of each tray object's waiting place (table frame), filled in columns near to far.

    Objects that find no room are left out: they cannot be picked up.
    """
    places: dict[str, tuple[float, float]] = {}
    left, near, column = EDGE + GAP, -1.6, 0.0
    for item in scene.tray:
        if near + item.height > 1.6 and column > 0.0:
            left, near, column = left + column + GAP, -1.6, 0.0
        if near + item.height > 1.6 or left + item.width / 2 > EDGE + DEPTH:
            continue
        places[item.id] = (left + item.width / 2, near + item.height / 2)
        near += item.height + GAP
        column = max(column, item.width)
    return places

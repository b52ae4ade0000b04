"""What a plan handles, or comes so near to that it may move it though it should not (pure).

Two witnesses say that a thing stayed where it was: the eye, and the arm's own way. What no motion
comes near cannot have been moved; of everything else the eye alone can tell.
"""

from __future__ import annotations

from collections.abc import Iterator

from agent.forecast import Forecast
from agent.messages import KeepOut
from robot_bridge.api import TOOL_RADIUS, crosses
from scene.relations import extents
from scene.types import Pose, Scene, SceneObject

CLOSE = 0.05
"""What moves, and comes no nearer to a thing's sides, does not move it (table units; 10 mm)."""
OVER = 0.03
"""The same above its top (table units)."""
DEEP = -10.0

_Motion = tuple[str, Pose, Pose, tuple[float, float]]
"""What moves (an id, or empty: the tool): its base from where to where, its half extents."""


def stirred(forecast: Forecast) -> frozenset[str]:
    """Ids of what is gripped or moved by a plan, and of what anything moving comes close to."""
    found: set[str] = set()
    before = forecast.after(0)
    for number, (start, command) in enumerate(forecast.ways()):
        goal = Pose(command.x, command.y, command.z, command.r) if command.op == "move" else start
        if command.op == "move" and _high(start, goal, before):
            continue  # what is there stays as it is
        before, after = forecast.after(number), forecast.after(number + 1)
        found |= {one.id for one in after.objects} - {one.id for one in before.objects}
        for motion in (("", start, goal, (TOOL_RADIUS, TOOL_RADIUS)), *_moving(before, after)):
            found |= {motion[0]} if motion[0] else set()
            found |= {one.id for one in before.objects if _close(motion, one)}
    return frozenset(found)


def _high(start: Pose, goal: Pose, scene: Scene) -> bool:
    """Whether tool and load go above everything."""
    load = max((one.tall for one in scene.objects if one.held), default=0.0)
    tops = [one.top for one in scene.objects if not one.held and one.on != "floor"]
    return min(start.z, goal.z) - load > max(tops, default=0.0) + OVER


def _moving(before: Scene, after: Scene) -> Iterator[_Motion]:
    """What one command moves, takes or lets go."""
    now = {one.id: one for one in after.objects}
    for old in before.objects:
        new = now.get(old.id)
        if new is not None and _state(old) != _state(new):
            wide, deep = (max(pair) for pair in zip(extents(old), extents(new), strict=True))
            yield old.id, _base(old), _base(new), (wide, deep)


def _state(item: SceneObject) -> tuple[float, float, float, float, bool, bool]:
    return *item.position, item.z, item.r, item.held, item.upright


def _base(item: SceneObject) -> Pose:
    return Pose(*item.position, item.z, item.r)


def _close(motion: _Motion, item: SceneObject) -> bool:
    id_, start, goal, (wide, deep) = motion
    if item.id == id_ or item.held or item.on == "floor":
        return False
    (x, y), (half_x, half_y) = item.position, extents(item)
    across, along = half_x + wide + CLOSE, half_y + deep + CLOSE
    zone = KeepOut(
        item.id, (x - across, x + across), (y - along, y + along), (DEEP, item.top + OVER)
    )
    return crosses(start, goal, zone, 0.0)

"""What of a plan may go wrong only because things may stand a little elsewhere (`agent.doubt`)."""

from __future__ import annotations

from collections.abc import Iterator

from msgspec.structs import replace

from agent.doubt import Doubt, slack
from agent.forecast import Forecast
from agent.messages import Command, Problem
from agent.report import title
from robot_bridge.api import Workspace
from scene.relations import extents
from scene.types import EDGE, Pose, Scene, SceneObject


def unsure(forecast: Forecast, workspace: Workspace, doubt: Doubt) -> Iterator[tuple[int, Problem]]:
    """The problems of a plan by the number of the command at which each would occur."""
    if not doubt:
        return
    for at, command in enumerate(forecast.commands):
        if command.op != "grip":
            continue
        scene = forecast.after(at + command.grip)
        held = next((item for item in scene.objects if item.held), None)
        off = 0.0 if held is None else slack(doubt, held.id)
        if held is None or off == 0.0:
            continue
        if command.grip:
            found = _taking(forecast.scene, held, command, workspace, off)
        else:
            found = _letting_go(forecast.after(at + 1), held.id, doubt)
        if found is not None:
            yield at, replace(found, line=command.line, object=held.id)


def _taking(
    scene: Scene, held: SceneObject, command: Command, workspace: Workspace, off: float
) -> Problem | None:
    """A thing that may be beyond the edge, or out of reach."""
    item = scene.get(held.id)
    known = f"its place is known to {1000 * off * scene.table_m / 2:.0f} mm only"
    if item.on == "table" and max(map(abs, item.position)) + off > EDGE:
        text = f"{title(item, scene)} may not be on the table any more: {known}"
        return Problem("unreachable", text)
    for dx, dy in ((off, 0.0), (-off, 0.0), (0.0, off), (0.0, -off)):
        if not _within(Pose(command.x + dx, command.y + dy, command.z, command.r), workspace):
            return Problem("unreachable", f"{title(item, scene)} may be out of reach: {known}")
    return None


def _within(pose: Pose, workspace: Workspace) -> bool:
    limits = workspace.limits
    inside = all(
        low <= value <= high
        for value, (low, high) in ((pose.x, limits.x), (pose.y, limits.y), (pose.z, limits.z))
    )
    return inside and workspace.reach(pose) is None


def _letting_go(after: Scene, held: str, doubt: Doubt) -> Problem | None:
    """A thing that may fall off the edge, or off what it is put on."""
    item = after.get(held)
    if item.on == "table" and max(map(abs, item.position)) + slack(doubt, held) > EDGE:
        return Problem("unsafe", f"{title(item, after)} may fall off the edge")
    carrier = next((one for one in after.objects if one.id == item.on), None)
    if carrier is None:
        return None
    off = slack(doubt, held, carrier.id)
    for one, other, half in zip(item.position, carrier.position, extents(carrier), strict=True):
        if abs(one - other) + off > half:
            text = f"{title(item, after)} may not come to rest on {title(carrier, after)}"
            return Problem("unsafe", text)
    return None

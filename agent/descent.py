"""Going down until the tool, or what it carries, meets something: heights are uncertain (pure).

From above, heights can hardly be seen. Where an arm ends a motion down at what it meets, and tells
where (`Limits.yields`), a motion to a top whose height is uncertain is told to go on down to the
least height that the top may have; so is one that sets a thing down. That the tool was held up on
the way is then what was felt of the top. An arm that feels nothing goes where the top was seen, and
whether it touched it nobody knows.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from msgspec.structs import replace

from agent.doubt import Doubt, slack
from agent.forecast import Forecast
from agent.landing import SINK, TOUCH, standing
from agent.messages import Command, StepReport
from robot_bridge.api import TOOL_RADIUS
from scene.kinds import is_container
from scene.relations import extents
from scene.types import Scene, SceneObject

KNOWN = 0.02
"""A height known to within so much needs no feeling (table units; 4 mm)."""
LEAST = 0.02
"""The tool goes no nearer than this to what a thing stands on (table units)."""
BESIDE = 0.01
"""A tool that ends so near to a thing's side touches it (table units; 2 mm)."""
HELD_UP = 0.01
"""A tool that ends so far above where it was told to go met something (table units)."""


class Descent(NamedTuple):
    """A motion down to the top of a thing, or with a thing to its place; ``at``: its number.

    ``low`` to ``high``: where it may come to its end (table units); ``touch``: the tool is to meet
    the thing's top and leave it there; ``x, y``: where the tool comes down.
    """

    at: int
    id: str
    low: float
    high: float
    touch: bool
    x: float
    y: float


def descents(forecast: Forecast, heights: Doubt) -> Iterator[Descent]:
    """The motions of a plan that end at a height which is not known well enough."""
    if not heights:
        return
    commands = forecast.commands
    for at, (here, command) in enumerate(forecast.ways()):
        straight = math.dist((here.x, here.y), (command.x, command.y)) <= TOUCH
        if command.op != "move" or not straight or command.z >= here.z - TOUCH:
            continue
        after = commands[at + 1] if at + 1 < len(commands) else None
        before = forecast.after(at)
        held = next((item for item in before.objects if item.held), None)
        if held is None:
            found = _upon(at, command, after, before, heights)
        else:
            found = _set_down(at, command, after, held, forecast, heights)
        if found is not None:
            yield found


def lowered(forecast: Forecast, heights: Doubt) -> tuple[Command, ...]:
    """The plan's commands with such motions going on down, as far as the thing may be lower."""
    commands = list(forecast.commands)
    for one in descents(forecast, heights):
        spot = commands[one.at].x, commands[one.at].y
        for number in _same_spot(forecast.commands, one.at) if one.touch else (one.at,):
            if (commands[number].x, commands[number].y) == spot:
                commands[number] = replace(commands[number], x=one.x, y=one.y)
        commands[one.at] = replace(commands[one.at], z=min(commands[one.at].z, one.low))
    return tuple(commands)


def unfelt(
    forecast: Forecast, doubt: Doubt, heights: Doubt, steps: Mapping[int, StepReport], yields: bool
) -> tuple[str, ...]:
    """Ids of what a plan was to touch, where that was neither felt nor sure."""
    above = (
        one.id
        for one in descents(forecast, heights)
        if one.touch and not (yields and one.at in steps and _felt(one, steps[one.at]))
    )
    return tuple(dict.fromkeys((*above, *_brushes(forecast, doubt))))


def _brushes(forecast: Forecast, doubt: Doubt) -> Iterator[str]:
    """Ids of what the tool is to meet from the side without moving it, where nobody can see whether
    it does: sliding, a thing holds nothing up."""
    for at, (_, command) in enumerate(forecast.ways() if doubt else ()):
        before, after = forecast.after(at), forecast.after(at + 1)
        if command.op != "move" or any(item.held for item in before.objects):
            continue
        for item in standing(before, None):
            low = item.z < command.z < item.top - SINK or command.z < min(item.top, SINK)
            met = low and abs(_beside(item, command) - TOOL_RADIUS) <= BESIDE
            if met and after.get(item.id) == item and slack(doubt, item.id) > BESIDE:
                yield item.id


def _beside(item: SceneObject, command: Command) -> float:
    """How far the tool's middle is from a thing's footprint (table units)."""
    dx, dy = command.x - item.position[0], command.y - item.position[1]
    cos, sin = math.cos(item.r), math.sin(item.r)
    across = abs(dx * cos + dy * sin) - item.width / 2
    along = abs(dy * cos - dx * sin) - item.height / 2
    return math.hypot(max(across, 0.0), max(along, 0.0))


def arrived(step: StepReport, commands: Sequence[Command]) -> bool:
    """Whether a load lost at this step is where it was to be let go: pressed on what is below."""
    following = commands[step.index + 1] if step.index + 1 < len(commands) else None
    lets_go = following is not None and following.op == "grip" and not following.grip
    return lets_go and step.reached.z > step.told.z + HELD_UP


def _felt(one: Descent, step: StepReport) -> bool:
    return step.told.z + HELD_UP < step.reached.z <= one.high + HELD_UP


def _upon(
    at: int, command: Command, after: Command | None, scene: Scene, heights: Doubt
) -> Descent | None:
    """A motion that ends at a top."""
    under = [item for item in standing(scene, None) if _over(item, command.x, command.y)]
    item = max(under, key=lambda one: one.top, default=None)
    if item is None or abs(command.z - item.top) > SINK:
        return None
    off = slack(heights, *_pile(item, scene))
    touch = after is None or after.op == "move"
    x, y = command.x, command.y
    if off <= KNOWN or (is_container(item.name) and not touch):
        return None  # suction takes a container by its rim, from inside: there is nothing to meet
    if is_container(item.name):
        x, y = _rim(item)
    low = max(item.top - off, item.z + LEAST)
    return Descent(at, item.id, low, item.top + off, touch, x, y)


def _set_down(
    at: int, command: Command, after: Command | None, held: SceneObject, forecast: Forecast,
    heights: Doubt,
) -> Descent | None:  # fmt: skip
    """A motion that ends where the load stands."""
    if after is None or after.op != "grip" or after.grip:
        return None
    hung, landed = forecast.after(at + 1).get(held.id), forecast.after(at + 2).get(held.id)
    if landed.on in ("floor", "gripper") or abs(hung.z - landed.z) > SINK:
        return None  # it is dropped from a height
    off = slack(heights, *_pile(landed, forecast.after(at + 2)))
    if off <= KNOWN:
        return None
    low = max(command.z - off, landed.z + LEAST)
    return Descent(at, held.id, low, command.z + off, False, command.x, command.y)


def _pile(item: SceneObject, scene: Scene) -> tuple[str, ...]:
    """A thing and what it stands upon, down to the table, or to the bottom of a container."""
    found, here = [item.id], item
    while True:
        below = next((one for one in scene.objects if one.id == here.on), None)
        if below is None or is_container(below.name) or below.id in found:
            return tuple(found)
        found.append(below.id)
        here = below


def _over(item: SceneObject, x: float, y: float) -> bool:
    (at_x, at_y), (half_x, half_y) = item.position, extents(item)
    return abs(x - at_x) <= half_x and abs(y - at_y) <= half_y


def _rim(item: SceneObject) -> tuple[float, float]:
    """Where the tool meets a container's rim and no more of it than need be."""
    reach, (x, y) = max(0.0, item.width / 2 - TOOL_RADIUS), item.position
    return x + reach * math.cos(item.r), y + reach * math.sin(item.r)


def _same_spot(commands: Sequence[Command], at: int) -> range:
    """The numbers of the moves around this one that go straight up and down at its place."""
    first = last = at
    while first and _alike(commands[first - 1], commands[at]):
        first -= 1
    while last + 1 < len(commands) and _alike(commands[last + 1], commands[at]):
        last += 1
    return range(first, last + 1)


def _alike(one: Command, other: Command) -> bool:
    return one.op == "move" and (one.x, one.y) == (other.x, other.y)

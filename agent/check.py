"""Would this program do only what it may? Program x Scene -> Checked; moves nothing.

The program runs in the worker, its whole trajectory is held against the arm's limits and reach,
and the ideal table predicts what would happen. What comes out is a list of problems, in the order
in which they would occur; a program without any may run. The check knows neither physics nor
people: it protects what stands in the scene it is given, as far as the prediction goes.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import msgspec

from agent.descent import lowered
from agent.doubt import SURE, Doubt
from agent.errors import ProgramError, Unreachable, Unsatisfiable
from agent.execute import Executor
from agent.forecast import Forecast
from agent.forecast import Predict as Predict
from agent.landing import (
    SINK,
    TOUCH,
    disturbed,
    knocked_off,
    landing,
    run_into,
    shoved,
    standing,
    unasked,
)
from agent.messages import Command, KeepOut, Kind, Problem, Reason
from agent.primitives import primitives
from agent.report import title
from agent.unsure import unsure
from robot_bridge.api import ApprovedPlan, approve, crosses
from robot_bridge.api import Workspace as Workspace
from scene.kinds import is_container
from scene.relations import extents, moved
from scene.types import Pose, Scene, SceneObject

ALOFT = 0.2
"""What is carried higher than this above the table pushes nothing on purpose (table units)."""
TIP, RIM = 0.03, 0.07
"""A tool that comes down no farther from a thing's side, or inside a container's, meets it."""


class Checked(NamedTuple):
    """A program, what it would tell the robot, the scene after that, and why it may not run.

    ``plan`` is what a robot accepts: there only if there are no ``problems``. ``meant`` is the same
    without what goes on down to where something is met (`agent.descent`).
    """

    program: str
    kind: Kind
    commands: tuple[Command, ...] = ()
    after: Scene | None = None
    problems: tuple[Problem, ...] = ()
    plan: ApprovedPlan | None = None
    meant: ApprovedPlan | None = None

    @property
    def ok(self) -> bool:
        """Whether it may run."""
        return self.plan is not None


def check(
    program: str,
    kind: Kind,
    scene: Scene,
    *,
    executor: Executor,
    predict: Predict,
    workspace: Workspace,
    start: Pose,
    touched: Sequence[str] | None,
    doubt: Doubt = SURE,
    heights: Doubt = SURE,
) -> Checked:
    """Run a program without moving anything and say what is wrong with it.

    ``touched`` are the ids of the objects that it may move (None: all). Objects that stand on
    those may go along. ``doubt``: of places, ``heights``: of heights. Never raises for a bad
    program, it is a Problem.
    """
    (result,) = executor.run(program, kind, [scene])
    if isinstance(result, ProgramError):
        return Checked(program, kind, problems=(_problem(result),))
    if not (workspace.limits.simulated or executor.hardened):
        return Checked(program, kind, problems=(_UNFILTERED,))
    try:
        commands = primitives(result, scene)
    except ProgramError as error:
        problem = Problem("unreachable", error.reason, error.line)
        return Checked(program, kind, problems=(problem,))
    return check_commands(
        rising_first(commands, start, scene), program, kind, scene,
        predict=predict, workspace=workspace, start=start, touched=touched, doubt=doubt,
        heights=heights,
    )  # fmt: skip


def rising_first(commands: Sequence[Command], start: Pose, scene: Scene) -> list[Command]:
    """The commands, the first way up straight up before it goes anywhere, where something reaches
    as high as the tool is: on a slope it would meet a bottle that stands in between."""
    first = next(iter(commands), None)
    tops = [item.z + item.tall for item in scene if item.x is not None and not item.held]
    if first is None or first.op != "move" or first.z <= start.z or start.z > max(tops, default=0):
        return list(commands)
    up = msgspec.structs.replace(first, x=start.x, y=start.y, r=start.r)
    return [up, *commands]


def check_commands(
    commands: Sequence[Command],
    program: str,
    kind: Kind,
    scene: Scene,
    *,
    predict: Predict,
    workspace: Workspace,
    start: Pose,
    touched: Sequence[str] | None,
    doubt: Doubt = SURE,
    heights: Doubt = SURE,
) -> Checked:
    """Like `check`, of the motions that a program came to: of all, or of those that are left."""
    try:
        plan = approve(commands, start, workspace, program, scene)
    except Unreachable as error:
        problem = Problem("unreachable", str(error), error.line)
        return Checked(program, kind, problems=(problem,))
    forecast = Forecast(plan, scene, predict)
    findings = [
        *_releases(forecast, kind, touched),
        *_bystanders(forecast, touched),
        *_already_held(forecast, touched),
        *_descents(forecast),
        *_knocks(forecast),
        *_carried(forecast, workspace.limits.keep_outs),
        *(Finding(*found) for found in unsure(forecast, workspace, doubt)),
    ]
    problems = tuple(found.problem for found in sorted(findings, key=lambda found: found.at))
    after = forecast.after(len(plan.told))
    if problems:
        return Checked(program, kind, plan.told, after, problems)
    commands, runs = plan.told, plan
    if workspace.limits.yields and (going_on := lowered(forecast, heights)) != commands:
        try:
            runs = approve(going_on, start, workspace, program, scene)
        except Unreachable as error:
            problem = Problem("unreachable", str(error), error.line)
            return Checked(program, kind, problems=(problem,))
    return Checked(program, kind, commands, after, plan=runs, meant=plan)


_UNFILTERED = Problem(
    "unsafe",
    "programs run without a system-call filter on this machine, so they may move simulated arms "
    "only: use Linux on x86-64 or aarch64 for a real one",
)


def _problem(error: ProgramError) -> Problem:
    impossible = isinstance(error, Unsatisfiable)
    reason: Reason = "impossible" if impossible else "bad_program"
    return Problem(reason, error.reason, error.line, column=error.column)


class Finding(NamedTuple):
    """A problem and the number of the command at which it would occur."""

    at: int
    problem: Problem


# --- what is not to move ----------------------------------------------------------------------


def _bystanders(forecast: Forecast, touched: Sequence[str] | None) -> list[Finding]:
    if touched is None:
        return []
    end = forecast.after(len(forecast.commands))
    found = []
    for item in forecast.scene:
        if item.id in touched or _goes_along(item, forecast.scene, end, touched):
            continue
        what = disturbed(item, end)
        if what is not None:
            found.append(_disturbance(forecast, item, what))
    return found


def _disturbance(forecast: Forecast, item: SceneObject, what: str) -> Finding:
    at = forecast.first(lambda scene: disturbed(item, scene) is not None)
    text = f"{title(item, forecast.scene)} {what}, and nobody asked for that"
    return Finding(at, Problem("unsafe", text, forecast.commands[at].line, item.id))


def _goes_along(item: SceneObject, before: Scene, end: Scene, touched: Sequence[str]) -> bool:
    """Whether the object stands on something that may move, and still does at the end."""
    ids = {other.id: other for other in before}
    now = {other.id: other for other in end}
    carrier = ids.get(item.on)
    if carrier is None or item.id not in now or now[item.id].on != item.on:
        return False
    return carrier.id in touched or _goes_along(carrier, before, end, touched)


# --- what is let go -----------------------------------------------------------------------------


def _releases(forecast: Forecast, kind: Kind, touched: Sequence[str] | None) -> list[Finding]:
    found = []
    for at, command in enumerate(forecast.commands):
        if command.op != "grip":
            continue
        before = forecast.after(at)
        if command.grip:
            found += _grasps_nothing(at, command, before, forecast.after(at + 1), touched)
            continue
        held = next((item for item in before.objects if item.held), None)
        if held is None:
            continue
        after = forecast.after(at + 1)
        expected = None if touched is None else {*touched, forecast.scene.get(held.id).on}
        wrong = (
            landing(held, command, before, after, kind)
            or unasked(held, after, expected)
            or shoved(held, before, after)
        )
        if wrong is not None:
            text = f"{title(held, forecast.scene)} would {wrong}"
            found.append(Finding(at, Problem("unsafe", text, command.line, held.id)))
    return found


def _grasps_nothing(
    at: int, command: Command, before: Scene, after: Scene, touched: Sequence[str] | None
) -> list[Finding]:
    """A grip that would hold nothing: what was named lies out of the gripper's reach."""
    if touched is None or any(item.held for item in (*before.objects, *after.objects)):
        return []
    fallen = next((item for item in before if item.id in touched and item.on == "floor"), None)
    where = "" if fallen is None else f"{title(fallen, before)} lies on the floor, where I can't"
    text = f"{where} reach" if where else "there would be nothing under the gripper"
    return [Finding(at, Problem("unreachable", text, command.line))]


def _already_held(forecast: Forecast, touched: Sequence[str] | None) -> list[Finding]:
    """Gripping what is held already and keeping it: whatever was meant, it was not that."""
    grip = next((at for at, one in enumerate(forecast.commands) if one.op == "grip"), None)
    held = next((item for item in forecast.scene if item.held), None)
    if touched is None or grip is None or held is None:
        return []
    end = forecast.after(len(forecast.commands))
    if not end.get(held.id).held:
        return []
    text = f"the gripper holds {title(held, forecast.scene)} already, and would go on holding it"
    return [Finding(grip, Problem("impossible", text, forecast.commands[grip].line, held.id))]


# --- what is come down upon, and carried through ------------------------------------------------


def _descents(forecast: Forecast) -> list[Finding]:
    """Where the tool, or what it carries, would be pressed down onto something."""
    found = []
    for at, (here, command) in enumerate(forecast.ways()):
        if command.z > here.z - SINK or math.dist((here.x, here.y), (command.x, command.y)) > TOUCH:
            continue
        before = forecast.after(at)
        held = next((item for item in before.objects if item.held), None)
        pressed = _below(command, here, before) if held is None else None
        if held is not None:
            landed = forecast.after(at + 1).get(held.id)
            if landed.held and landed.top > command.z + SINK:
                pressed = held
        if pressed is not None:
            text = (
                f"{title(pressed, forecast.scene)} would be pressed down "
                f"{'upon' if held is None else 'onto what is below'}"
            )
            found.append(Finding(at, Problem("unsafe", text, command.line, pressed.id)))
    return found


def _below(command: Command, here: Pose, scene: Scene) -> SceneObject | None:
    """What stands under the tool where it goes down too far; a container it may go down into."""
    for item in standing(scene, None):
        x, y = extents(item)
        beyond = max(abs(command.x - item.position[0]) - x, abs(command.y - item.position[1]) - y)
        inside = is_container(item.name) and beyond < -min(RIM, 0.6 * min(x, y))
        if beyond < TIP and command.z + SINK < item.top < here.z + TOUCH and not inside:
            return item
    return None


def _knocks(forecast: Forecast) -> list[Finding]:
    """Where what is carried would knock something off what it stands on."""
    found, taken = [], forecast.scene
    for at, command in enumerate([*forecast.commands, None]):
        if command is not None and command.op != "grip":
            continue
        here = forecast.after(at)
        load = next((item for item in taken.objects if item.held), None)
        what = None if load is None else _met(load, taken, forecast, at)
        if load is not None and what is not None:
            last = min(at, len(forecast.commands) - 1)
            text = f"{title(load, forecast.scene)} would {what}"
            line = forecast.commands[last].line
            found.append(Finding(last, Problem("unsafe", text, line, load.id)))
        taken = here if command is None else forecast.after(at + 1)
    return found


def _met(load: SceneObject, taken: Scene, forecast: Forecast, at: int) -> str | None:
    """What a carry, from the scene where it was taken up to the ``at``-th command, meets."""
    here = forecast.after(at)
    hit = knocked_off(load, taken, here)
    if hit is not None:
        return f"knock {title(hit, here)} off"
    met = run_into(load, taken, here)
    if met is not None and _aloft(forecast, load.id, met, at):
        return f"be carried into {title(met, here)}"
    return None


def _aloft(forecast: Forecast, load: str, met: SceneObject, until: int) -> bool:
    """Whether the load is off the table where it meets a thing: low down it may push it."""
    at = until
    while at > 0 and moved(met, forecast.after(at - 1).get(met.id)) > 0:
        at -= 1
    return min(forecast.after(one).get(load).z for one in (max(at - 1, 0), at)) > ALOFT


def _carried(forecast: Forecast, zones: Sequence[KeepOut]) -> list[Finding]:
    """Where what the tool carries would be taken through a keep-out."""
    if not zones:
        return []
    for at, (here, command) in enumerate(forecast.ways()):
        held = next((item for item in forecast.after(at).objects if item.held), None)
        if command.op == "grip" or held is None:
            continue
        goal = Pose(command.x, command.y, command.z, command.r)
        for zone in zones:
            if crosses(here, goal, _grown(zone, held), 0.0):
                text = f"{title(held, forecast.scene)} would be carried through {zone.name}"
                return [Finding(at, Problem("unsafe", text, command.line, held.id))]
    return []


def _grown(zone: KeepOut, held: SceneObject) -> KeepOut:
    """The keep-out for the tip of a tool that carries something, however it is turned."""
    reach = math.hypot(held.width, held.height) / 2
    (x1, x2), (y1, y2), (z1, z2) = zone.x, zone.y, zone.z
    return KeepOut(
        zone.name, (x1 - reach, x2 + reach), (y1 - reach, y2 + reach), (z1, z2 + held.tall)
    )

"""A look with the arm out of the way: what it has just put down stands right under it.

From above, the arm hides what its tool was at last, or shows a part of it that is taken for all. So
the tool goes up and to where the arm waits, straight and above everything, for one more look, and
back to where the plan left it. These motions pass the check like any others.
"""

from __future__ import annotations

from collections.abc import Collection

from agent.arm import Arm
from agent.check import Checked, check_commands
from agent.forecast import Predict
from agent.messages import Command, StepReport
from agent.recover import HIGH, freed
from robot_bridge.api import PARK
from scene.types import Pose, Scene


def hides(arm: Arm, ids: Collection[str], last: StepReport | None) -> bool:
    """Whether the arm may hide one of these things, and could go away: it holds nothing."""
    holds = last is None or last.held or (last.held is None and last.reached.grip)
    return not holds and not set(ids).isdisjoint(arm.unseen())


def aside(checked: Checked, seen: Scene, predict: Predict, arm: Arm) -> Checked:
    """Suction off, straight up and to where the arm waits, checked."""
    here = arm.start()
    up = freed((), here)
    over = Command("move", PARK.x, PARK.y, max(HIGH, here.z), here.r, False)
    return _checked((*up, over), checked, seen, predict, arm)


def back(end: Pose, checked: Checked, seen: Scene, predict: Predict, arm: Arm) -> Checked:
    """From there to where a plan had left the tool, checked."""
    high = max(HIGH, end.z)
    over = Command("move", end.x, end.y, high, end.r, False)
    down = Command("move", end.x, end.y, end.z, end.r, False)
    return _checked((over, down) if end.z < high else (over,), checked, seen, predict, arm)


def _checked(
    motions: tuple[Command, ...], checked: Checked, seen: Scene, predict: Predict, arm: Arm
) -> Checked:
    return check_commands(
        motions, checked.program, checked.kind, seen, predict=predict, workspace=arm.workspace,
        start=arm.start(), touched=(), doubt=arm.doubt(),
    )  # fmt: skip

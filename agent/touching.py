"""Touching points of the table with a real arm's tip: a person moves it, by hand or by small steps.

Every step goes through the check like any motion (`robot_bridge.moves`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, TextIO

from agent.errors import CalibrationError, LinkDown, RobotError
from robot_bridge.moves import Axis, step
from scene import touched

if TYPE_CHECKING:
    from robot_bridge.dobot_arm import DobotRobot

READINGS, BETWEEN_S = 10, 0.02
FARTHEST_MM = 50.0
"""Longest step at a time."""
HELP = (
    "hold the arm's unlock button and bring the tip there, touching the table; or type a step in "
    "mm, e.g. `x -5`, `z -2`; Enter reads, s skips, q ends"
)


def touch_all(
    points: Mapping[str, tuple[float, ...]], robot: DobotRobot, lines: TextIO,
    say: Callable[[str], None], wait: Callable[[float], object],
) -> list[touched.Touch]:  # fmt: skip
    """The points (by name; table units) that the person touched, as the arm read them.

    ``lines``: what the person types. Raises LinkDown where the arm is lost.
    """
    found: list[touched.Touch] = []
    say(HELP)
    for number, (name, (x, y)) in enumerate(points.items(), 1):
        say(f"point {number} of {len(points)}: {name} (x {x:.2f}, y {y:.2f})")
        while (line := lines.readline()) != "":
            words = line.split()
            if words in (["q"], ["s"]):
                break
            try:
                if words:
                    _step(words, robot, say)
                    continue
                at = touched.mean([_read(robot, wait) for _ in range(READINGS)])
            except LinkDown:
                raise
            except (RobotError, CalibrationError, ValueError) as error:
                say(str(error))
                continue
            say(f"read ({', '.join(f'{value:.1f}' for value in at)}) mm")
            found.append(touched.Touch((float(x), float(y)), at))
            break
        if line == "" or line.strip() == "q":
            break
    return found


def _read(robot: DobotRobot, wait: Callable[[float], object]) -> tuple[float, float, float]:
    wait(BETWEEN_S)
    x, y, z, _ = robot.reading()
    return x, y, z


def _step(words: list[str], robot: DobotRobot, say: Callable[[str], None]) -> None:
    """One step along an axis of the table. Raises RobotError, ValueError for what is no step."""
    axes: dict[str, Axis] = {"x": "x", "y": "y", "z": "z"}
    axis, amount = axes.get(words[0]), _number(words[1:])
    if axis is None or not abs(amount) <= FARTHEST_MM:
        raise ValueError(f"a step is x, y or z and at most {FARTHEST_MM:g} mm: `x -5`")
    for done in robot.run(step(robot.pose(), robot, axis, amount / robot.scale)):
        say(f"{axis} {getattr(done.reached, axis) * robot.scale:.1f} mm")


def _number(words: list[str]) -> float:
    try:
        return float(*words) if words else math.nan
    except (TypeError, ValueError):
        return math.nan

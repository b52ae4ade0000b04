"""Which programs are the same to the person: those after which all stands alike, and motions of
the tool that leave everything where it is and go the same way; and how high such motions go.

Once around the tin is once around the tin, whichever way round and at whatever distance, unless the
sentence says so; and what is drawn in the air is drawn above what stands there.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from itertools import pairwise

from agent.check import Checked
from agent.messages import Command
from scene.relations import moved
from scene.types import Scene

ALIKE = 0.02
"""Places and points that differ by no more are the same (table units)."""
CLEARANCE = 0.1
"""How far above everything a motion in the air goes (table units)."""
_WAY = re.compile(
    r"\b(?:(?:anti|counter)?-?clockwise|c?cw|ccw|left|right|backwards?|forwards?|revers\w*|other "
    r"way|from|towards?|then)\b",
    re.IGNORECASE,
)
"""Words that may say which way round."""
_FIGURE = re.compile(
    r"\b(?:outlines?|edges?|contours?|rims?|sides?|perimeter|square|rectang\w+|triang\w+|oval|"
    r"figures?|shapes?|spiral\w*|low|high|close|tight\w*|wide|big|small|large|near\w*|diameter|"
    r"radius|cm|mm|inch\w*)\b",
    re.IGNORECASE,
)
"""Words that say more of a way than what it goes round."""
_TRACE = re.compile(r"^(?P<way>\s*trace\(.*, )(?P<high>\d+(?:\.\d+)?)\)$")
_HARMLESS = re.compile(r"^\s*(?:trace\(|for \w+ in range\(|\w+ = |robot\.move\()")


def does_the_same(one: Checked, other: Checked, scene: Scene) -> bool:
    """Whether two programs lead to the same: things end alike, or, where none moves, the tool goes
    the same way."""
    if one.after is None or other.after is None:
        return False
    if one.after == scene:
        pairs = zip(one.commands, other.commands, strict=False)
        return len(one.commands) == len(other.commands) and all(
            math.dist((a.x, a.y, a.z), (b.x, b.y, b.z)) < ALIKE for a, b in pairs
        )
    return ends_alike(one.after, other.after)


def ends_alike(one: Scene, other: Scene) -> bool:
    """Whether everything stands alike on two scenes of the same things."""
    ends = {item.id: item for item in other}
    return all(
        moved(item, ends[item.id], ALIKE) == 0
        and (item.on, item.held, item.upright) == (ends[item.id].on, ends[item.id].held,
                                                   ends[item.id].upright)
        for item in one
    )  # fmt: skip


def same_way(one: Checked, other: Checked, scene: Scene, text: str) -> bool:
    """Whether two programs that move nothing take the tool the same way, as far as the sentence
    ``text`` says which: there and back alike, or as often around the same things."""
    if one.after != scene or other.after != scene or _WAY.search(text):
        return False
    ways = [_way(checked.commands) for checked in (one, other)]
    if any(way is None or len(way) < 3 for way in ways):
        return False
    a, b = (way for way in ways if way is not None)
    if len(a) == len(b) and all(
        math.dist(p, q) < ALIKE for p, q in zip(a, reversed(b), strict=True)
    ):
        return True
    rounds = _rounds(a, scene)
    return bool(rounds) and _FIGURE.search(text) is None and rounds == _rounds(b, scene)


def raised(body: str, scene: Scene) -> str | None:
    """A program that only traces, traced above everything that stands; None where it does more, or
    is as high."""
    top = max((item.z + item.tall for item in scene if item.x is not None), default=0.0)
    lines = body.split("\n")
    if not all(_HARMLESS.match(line) for line in lines) or "robot.move" in body:
        return None
    higher = [_higher(line, top + CLEARANCE) for line in lines]
    return "\n".join(higher) if higher != lines else None


def _higher(line: str, least: float) -> str:
    said = _TRACE.match(line)
    if said is None or float(said["high"]) >= least:
        return line
    return f"{said['way']}{least:.6g})"


def _way(commands: Sequence[Command]) -> list[tuple[float, float, float]] | None:
    """The points of a motion, those above all others left out: there the tool only comes and goes.
    None for one that grips."""
    if any(command.op == "grip" for command in commands):
        return None
    points = [(one.x, one.y, one.z) for one in commands]
    top = max((z for _, _, z in points), default=0.0)
    low = [point for point in points if point[2] < top - ALIKE]
    return low or points


def _rounds(way: Sequence[tuple[float, float, float]], scene: Scene) -> dict[str, int]:
    """How often a way goes round each thing that it goes round, either way."""
    found = {}
    for item in scene:
        if item.x is None:
            continue
        x, y = item.position
        turned = 0.0
        for (ax, ay, _), (bx, by, _) in pairwise(way):
            step = math.atan2(by - y, bx - x) - math.atan2(ay - y, ax - x)
            turned += math.remainder(step, math.tau)
        if count := abs(round(turned / math.tau)):
            found[item.id] = count
    return found

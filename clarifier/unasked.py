"""What a program does that its sentence does not ask for, however sure the translator is.

Vetoes only: a direction that is dropped ("up and to the left"), a thing that falls off the table
where nobody spoke of an edge.
"""

from __future__ import annotations

import re

from agent.messages import Problem
from scene.relations import off_table
from scene.types import Scene

STILL = 0.02
"""Less than this along an axis is no motion along it (table units)."""

_SIDE = r"(?:left|right|leftwards?|rightwards?)"
_DEPTH = (
    r"(?:up|upwards?|down|downwards?|forwards?|back|backwards?|away(?: from me)?"
    r"|(?:towards?|closer to|nearer to) me|nearer|closer|farther|further)"
)
_JOINT = r"(?: a bit| a little| some)?,? and (?:then )?(?:also )?"
_LEAD = r"(?:(?:slightly|just|a bit|a little) )?(?:(?:to|towards) (?:the|my|your) )?"
_BOTH = re.compile(rf"\b(?:{_SIDE}{_JOINT}{_LEAD}{_DEPTH}|{_DEPTH}{_JOINT}{_LEAD}{_SIDE})\b", re.I)

_OVER = re.compile(r"\b(?:off|over|edge|border|floor|ground|falls?|drops?|overboard)\b", re.I)


def unasked_fall(text: str, before: Scene, after: Scene) -> Problem | None:
    """The first thing that a program sends off the table although the sentence names no edge."""
    if _OVER.search(text):
        return None
    stood = {item.id for item in before if not off_table(item)}
    fallen = next((item for item in after if item.id in stood and off_table(item)), None)
    if fallen is None:
        return None
    text = f"the {fallen.name} would go off the table. Say how far, or where it is to end"
    return Problem("unsafe", text, object=fallen.id)


def names_two_axes(text: str) -> bool:
    """Whether a sentence joins a direction to the side with one away from or towards the person."""
    return _BOTH.search(" ".join(text.split())) is not None


def keeps_to_one_axis(before: Scene, after: Scene) -> bool:
    """Whether what moves on the table moves along one of its axes only. What waits in the tray has
    no place to come from and does not count."""
    ends = {item.id: item.position for item in after if item.x is not None}
    shifts = [
        (abs(ends[item.id][0] - item.position[0]), abs(ends[item.id][1] - item.position[1]))
        for item in before
        if item.x is not None and item.id in ends
    ]
    far = [shift for shift in shifts if max(shift) >= STILL]
    return bool(far) and all(min(shift) < STILL for shift in far)

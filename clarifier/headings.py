"""Directions named two at a time ("up and to the left"), and whether a program follows both.

A veto only: a translation that drops one of two directions does something that was not asked, and
the translator's confidence does not tell.
"""

from __future__ import annotations

import re

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

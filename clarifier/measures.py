"""Measures of a sentence that stand outside its mentions, each with the slot that stands for it.

The translator never reads them, and a program that drops one is not acted on. Words without a
number ("a bit", "twice", "halfway") are left to the translator.
"""

from __future__ import annotations

from agent.messages import Quantity
from clarifier.amounts import amounts
from clarifier.spoken import Linked
from scene.types import Scene


def quantities(linked: Linked, scene: Scene) -> tuple[Quantity, ...]:
    """Every measure outside the mentions, in order: table units, radians (never negative) or the
    number as it was said. "Two" of "two blocks" and "5 cm" of "the 5 cm block" are no measures."""
    counts = {"d": 0, "t": 0, "n": 0}
    inside = [
        (linked.tokens[one.opened].start, linked.tokens[one.last - 1].end) for one in linked.spoken
    ]
    result = []
    for found in amounts(linked.text):
        if any(found.start < end and start < found.end for start, end in inside):
            continue
        counts[found.sort] += 1
        value = scene.units(found.value) if found.sort == "d" else found.value
        text = linked.text[found.start : found.end]
        result.append(
            Quantity(f"{found.sort}{counts[found.sort]}", found.start, found.end, text, value)
        )
    return tuple(result)

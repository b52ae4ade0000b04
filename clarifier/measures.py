"""Numbers and measures of a sentence, and whether a program can possibly mean them.

The translator may never have seen "7 cm"; a program that drops the measure would act on half of
what was said. So every number outside the mentions must turn up in the program.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from clarifier.mentions import Linked
from clarifier.words import Token, number
from scene.types import Scene

_METRES = {
    "cm": 0.01, "centimetre": 0.01, "centimeter": 0.01, "centimetres": 0.01, "centimeters": 0.01,
    "mm": 0.001, "millimetre": 0.001, "millimeter": 0.001, "millimetres": 0.001,
    "millimeters": 0.001, "m": 1.0, "metre": 1.0, "meter": 1.0, "metres": 1.0, "meters": 1.0,
    "inch": 0.0254, "inches": 0.0254, "foot": 0.3048, "feet": 0.3048, "dm": 0.1, "cms": 0.01,
}  # fmt: skip
_DEGREES = frozenset({"degree", "degrees", "deg", "°"})
_TIMES = {"twice": 2.0, "thrice": 3.0, "double": 2.0, "halfway": 0.5, "half": 0.5, "quarter": 0.25}
_GLUED = re.compile(r"(\d+(?:\.\d+)?)(cm|mm|m|cms|deg|inch|in|ft)$")
_LITERAL = re.compile(r"(?<![\w.])(?:\d+\.\d*|\.\d+|\d+)(?![\w])")
_TOLERANCE = 0.005


@dataclass(frozen=True)
class Measure:
    """A number as it was said, and the numbers by which a program may express it."""

    said: str
    values: tuple[float, ...]
    angle: bool = False


def measures_of(linked: Linked, scene: Scene) -> tuple[Measure, ...]:
    """The numbers of a sentence that are not part of a mention, with their units."""
    inside = set()
    for one in linked.spoken:
        opened = one.phrase.opened if one.phrase is not None else one.first
        inside |= set(range(opened, one.last))
    found = []
    for at, _token in enumerate(linked.tokens):
        if at not in inside:
            measure = _measure(linked.tokens, at, scene)
            found += [measure] if measure is not None else []
    return tuple(found)


def _measure(tokens: tuple[Token, ...], at: int, scene: Scene) -> Measure | None:
    word = tokens[at].text
    after = tokens[at + 1].text if at + 1 < len(tokens) else ""
    glued = _GLUED.match(word)
    if glued is not None:
        unit = {"in": "inch", "ft": "foot", "deg": "degrees"}.get(glued.group(2), glued.group(2))
        return _with_unit(float(glued.group(1)), unit, word, scene)
    if word in _TIMES:
        return None if word == "half" and after == "of" else Measure(word, (_TIMES[word],))
    value = number(word)
    if value is None or (word == "one" and after not in _METRES):
        return None
    if after in _METRES or after in _DEGREES:
        return _with_unit(value, after, f"{word} {after}", scene)
    return Measure(word, (value,))


def _with_unit(value: float, unit: str, said: str, scene: Scene) -> Measure:
    if unit in _DEGREES:
        return Measure(said, (value, math.radians(value), 180.0 / value if value else 0.0), True)
    metres = value * _METRES[unit]
    return Measure(said, (scene.units(metres), metres))


def expresses(program: str, measure: Measure) -> bool:
    """Whether the program holds a number that can stand for the measure."""
    numbers = [float(literal) for literal in _LITERAL.findall(program)]
    if measure.angle and measure.values[0] == 180.0 and "math.pi" in program:
        return True
    near = (abs(n - v) <= _TOLERANCE * max(1.0, abs(v)) for n in numbers for v in measure.values)
    if any(near):
        return True
    divided = re.findall(r"/\s*(\d+(?:\.\d+)?)", program)
    return any(abs(1 / float(d) - measure.values[0]) < 1e-6 for d in divided if float(d))

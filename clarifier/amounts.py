"""Lengths, angles and numbers as people write them: where they stand and what they are worth."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator
from typing import Literal, NamedTuple

from clarifier.words import number

_METRES = {
    "mm": 0.001, "millimetre": 0.001, "millimeter": 0.001, "cm": 0.01, "centimetre": 0.01,
    "centimeter": 0.01, "centi": 0.01, "dm": 0.1, "decimetre": 0.1, "decimeter": 0.1, "m": 1.0,
    "metre": 1.0, "meter": 1.0, "inch": 0.0254, "inche": 0.0254, "in": 0.0254, "foot": 0.3048,
    "feet": 0.3048, "ft": 0.3048, "yard": 0.9144, '"': 0.0254,
}  # fmt: skip
_PART = {"half": 0.5, "quarter": 0.25, "third": 1 / 3, "tenth": 0.1}
_SMALL = (
    r"(?:zero|one|two|three|four|five|six|seven|eight|nine|ten|eleven|twelve|thirteen|fourteen|"
    r"fifteen|sixteen|seventeen|eighteen|nineteen)"
)
_TEN = r"(?:twenty|thirty|forty|fourty|fifty|sixty|seventy|eighty|ninety)"
_WORDS = (
    rf"(?:(?:(?:an?|{_SMALL})[ -])?hundred(?:[ -](?:and[ -])?(?:{_TEN}(?:[ -]{_SMALL})?|{_SMALL}))?"
    rf"|{_TEN}(?:[ -]{_SMALL})?|{_SMALL})"
)
_DIGITS = r"(?:\d+\s*/\s*\d+|\d+[.,]\d+|\.\d+|\d+\s?[½¼¾]|[½¼¾]|\d+)"
_NUMBER = rf"(?:{_DIGITS}|{_WORDS})(?:\s+and\s+a\s+half|\s+(?:point|dot)\s+{_SMALL})?"
_PARTS = r"(?:(?:a|one)\s+)?(?:half|quarter|third|tenth)(?:\s+of)?\s+an?"
_SOME = r"(?:(?:an?\s+)?(?:single\s+|couple\s+of\s+|couple\s+)|an?\s+|another\s+)"
_UNIT = (
    r"(?:mm|millimet(?:re|er)s?|cms?|centimet(?:re|er)s?|centis?|dm|decimet(?:re|er)s?|"
    r"met(?:re|er)s?|inch(?:es)?|foot|feet|ft|yards?|m)"
)
_LENGTH = re.compile(
    rf"(?<![\w.])(?P<number>{_NUMBER}|{_PARTS}|{_SOME})"
    rf"(?:\s*-?\s*(?P<unit>{_UNIT})(?![\w'’])|(?P<glued>in|\")(?!\w))",
    re.IGNORECASE,
)
_ANGLE = re.compile(
    rf"(?<![\w.])(?P<number>{_NUMBER}|an?\s+right)\s*-?\s*"
    r"(?P<unit>degrees?|degs?(?!\w)|°|º|radians?|rads?(?!\w)|angles?)(?![\w'’])",
    re.IGNORECASE,
)
_TURN = re.compile(
    r"(?<![\w-])(?P<article>an?\s+)?(?P<part>three[ -]quarters?(?:\s+of)?(?:\s+an?)?|"
    r"(?:half|quarter)(?:\s+of)?\s+an?|(?:one[ -])?(?:half|quarter)|"
    rf"(?:(?:{_NUMBER})\s+)?(?:full|complete|whole|entire)|{_NUMBER})"
    r"[ -]+(?P<noun>turns?|rotations?|circles?|revolutions?|spins?|twists?)(?![\w'’])",
    re.IGNORECASE,
)
_PLAIN = re.compile(rf"(?<![\w.,/'’])(?:(?<!\S)-)?(?:{_NUMBER})(?![\w'’%])", re.IGNORECASE)
_TURNING = re.compile(r"\b(?:turn|rotat|spin|twist|swivel|pivot)(?:e|s|es|ed|ing|n|ning)?\b", re.I)
_FORMING = re.compile(
    r"\b(?:make|form|build|create|arrang\w+|lay|set|put|place|stand)\b[^,.;]*$", re.IGNORECASE
)
"""Behind these "one circle" is what is made, and no turn."""
_LABELLED = re.compile(
    r"(?:\b(?:number|no|nr|step|point|option|item|part|phase|task|the|these|those|all|other)|#)[.\s#]*$",
    re.I,
)
"""Before a number that counts nothing: "step 2", "the two", "all three"."""
_PAIRED = re.compile(r"\s*(?:of|by)\s+(?:them|the|these|those|two|three|four)\b", re.I)
_HALVED = re.compile(
    r"\s*(?:sides|halves|rows|pairs|places|columns|groups|teams|lines|corners|edges|ends|by)\b",
    re.I,
)
_OUTER = re.compile(r"\b(?:of|in|into|by|for|outer|outermost|inner|middle)\s+$", re.I)
_LEFT_OUT = re.compile(r"\b(?:all|every\w*)\b[^,.;]*\b(?:but|except(?: for)?|bar|save)\s+$", re.I)
"""Before how many of a group are left out: "all the pegs but two"."""
_TEXTED = re.compile(r"\s*(?:the|me|my|us|u|b|be|left|right|you)\b", re.I)

Sort = Literal["d", "t", "n"]


class Found(NamedTuple):
    """A measure's place in the sentence; ``value`` in metres, radians or as said."""

    start: int
    end: int
    sort: Sort
    value: float


def with_units(text: str) -> tuple[Found, ...]:
    """Every length and angle of a text, in order; one place is never two measures."""
    return _apart(text, (turns, angles, lengths))


def amounts(text: str) -> tuple[Found, ...]:
    """Every length, angle and number of a text, in order."""
    return _apart(text, (turns, angles, lengths, numbers))


def _apart(text: str, searches: Iterable[Callable[[str], Iterator[Found]]]) -> tuple[Found, ...]:
    result: list[Found] = []
    for search in searches:
        for found in search(text):
            if not any(found.start < one.end and one.start < found.end for one in result):
                result.append(found)
    return tuple(sorted(result))


def turns(text: str) -> Iterator[Found]:
    """ "a quarter turn", "half a turn": as a whole behind "rotate", else without "a ... turn"."""
    for match in _TURN.finditer(text):
        part = match["part"].lower()
        if re.match(r"\s+(?:a)?round\s+\w", text[match.end() :]):
            continue
        if match["noun"].lower() == "circle" and _FORMING.search(text[: match.start()]):
            continue
        value = 2 * math.pi * _share(part)
        whole = _TURNING.search(text[: match.start()]) or part.endswith((" a", " an"))
        start, end = match.span() if whole else match.span("part")
        yield Found(start, end, "t", value)


def _share(part: str) -> float:
    """The part of a full turn that was said."""
    if part.startswith("three"):
        return 0.75
    if "quarter" in part or "half" in part:
        return 0.25 if "quarter" in part else 0.5
    said = re.match(_NUMBER, part, re.IGNORECASE)
    return _value(said.group()) if said is not None else 1.0


def angles(text: str) -> Iterator[Found]:
    for match in _ANGLE.finditer(text):
        unit, said = match["unit"].lower(), match["number"].lower()
        right = said.endswith("right")
        if right != unit.startswith("angle"):
            continue
        value = 90.0 if right else _value(said)
        yield Found(*match.span(), "t", value if unit.startswith("rad") else math.radians(value))
    turning = _TURNING.search(text)
    for match in _PLAIN.finditer(text, turning.end() if turning else len(text)):
        if _value(match.group()) >= 10 and not _lengthy(text, match.start()):
            yield Found(*match.span(), "t", math.radians(_value(match.group())))


def _lengthy(text: str, at: int) -> bool:
    return _LENGTH.match(text, at) is not None


def lengths(text: str) -> Iterator[Found]:
    for match in _LENGTH.finditer(text):
        said = match["number"].lower()
        unit = (match["unit"] or match["glued"]).lower()
        if match["glued"] and not said[-1].isdigit():
            continue
        metres = _METRES.get(unit) or _METRES[unit.rstrip("s")]
        yield Found(match.start(), match.end(), "d", _amount(said) * metres)


def _amount(said: str) -> float:
    """The number before a unit: "5", "half a", "a couple of", "an"."""
    if "couple" in said:
        return 2.0
    part = next((share for word, share in _PART.items() if said.split()[0] == word), None)
    if part is None and re.match(r"(?:a|one)\s+(?:half|quarter|third|tenth)\b", said):
        part = _PART[said.split()[1]]
    if part is not None:
        return part
    return 1.0 if re.fullmatch(_SOME, said) else _value(said)


def numbers(text: str) -> Iterator[Found]:
    """Bare numbers: not "one", not the numbers of a list, not "2 the left" for "to the left"."""
    for match in _PLAIN.finditer(text):
        said, before, after = match.group().lower(), text[: match.start()], text[match.end() :]
        if said == "one" or _LABELLED.search(before) or _PAIRED.match(after):
            continue
        if _LEFT_OUT.search(before):
            continue
        if _value(said) == 2 and (_HALVED.match(after) or _OUTER.search(before)):
            continue
        if said in ("2", "4") and _TEXTED.match(after):
            continue
        starts = not before.strip() or before.rstrip()[-1] in ".;:,("
        if starts and re.match(r"\s*[.):](?:\s|$)", after):
            continue
        yield Found(*match.span(), "n", _value(said))


_TENS = {"twenty": 20, "thirty": 30, "forty": 40, "fourty": 40, "fifty": 50, "sixty": 60,
         "seventy": 70, "eighty": 80, "ninety": 90}  # fmt: skip
_TEENS = {"thirteen": 13, "fourteen": 14, "fifteen": 15, "sixteen": 16, "seventeen": 17,
          "eighteen": 18, "nineteen": 19}  # fmt: skip
_GLYPHS = {"½": 0.5, "¼": 0.25, "¾": 0.75}


def _value(said: str) -> float:
    """The value of a number in digits or words ("twenty-five", "one and a half", "1/2", "2½")."""
    text = said.lower().strip()
    if text.startswith("-"):
        return -_value(text[1:])
    if re.search(r"\s+and\s+a\s+half$", text):
        return _value(re.sub(r"\s+and\s+a\s+half$", "", text)) + 0.5
    point = re.fullmatch(r"(.+?)\s+(?:point|dot)\s+(\w+)", text)
    if point is not None:
        return _value(point.group(1)) + _value(point.group(2)) / 10
    if text[-1] in _GLYPHS:
        return (_value(text[:-1]) if text[:-1].strip() else 0.0) + _GLYPHS[text[-1]]
    if "/" in text:
        above, below = (float(part) for part in text.split("/"))
        return above / below if below else 0.0
    if text[0].isdigit() or text[0] == ".":
        return float(text.replace(",", "."))
    return _of_words(re.split(r"[ -]+", text))


def _of_words(said: list[str]) -> float:
    total = 0.0
    for word in said:
        if word == "hundred":
            total = 100 * (total or 1)
        elif word not in ("and", "a", "an"):
            total += _TENS.get(word) or _TEENS.get(word) or number(word) or 0.0
    return total

"""What the tool is to do in the air, as people say it: laps, passes and loops around a thing, and
that it touches nothing on the way. Put as "go around ..., twice" and "without touching ...".
"""

from __future__ import annotations

import re
from collections.abc import Callable

_TIMES = {"a": "", "an": "", "one": "once", "two": "twice", "2": "twice", "a single": "once",
          "a full": "", "one full": "once", "one complete": "once", "a complete": ""}  # fmt: skip
_LAP = r"(?:laps?|loops?|circuits?|orbits?|rounds?|passes|pass|circles?|rings?)"
_ROUND = r"(?:all the way |right |in a circle )?(?:a?round|about|of|over|above)"
_THING = r"(?=(?:the|my|that|this|it|them|both|each)\b)(?!the (?:table|room|desk)\b)"
_ONCE = r"(?:once|twice|\w+ times)"


def _laps(said: re.Match[str]) -> str:
    """ "Do two laps of the tin": go around the tin twice."""
    much = said["many"].lower()
    often = _TIMES.get(much, f"{much} times")
    return f"go around {said['what']}" + (f" {often}" if often else "")


_LAPS: tuple[tuple[str, str | Callable[[re.Match[str]], str]], ...] = (
    # "without to touch it", "without touch in nothing", "zero contact"
    (r"\bwithout to (touch|move|push|lift|hit|bump)\b", r"without \1ing"),
    (r"\bwithout (?:touch|touching) (?:in |to |on )?(?:nothing|no thing)\b",
     "without touching anything"),
    (r"\b(?:with )?(?:zero|no) contact(?: with (?:it|anything))?(?=\s*(?:[.,;!]|$))",
     "without touching it"),
    # "do two laps of the tin"
    (rf"^(?P<lead>(?:please |now |just |can you |could you )*)(?:do|make|run|fly|take|perform|"
     rf"complete|give me) (?P<many>a single|an? (?:full|complete)|one (?:full|complete)|an?|one|"
     rf"two|"
     rf"three|four|five|\d) (?:(?:dry|slow|quick|little|big|nice|lovely|careful) )*{_LAP} "
     rf"(?:in the air )?{_ROUND} {_THING}(?P<what>[^,.;!?]+?)"
     r"(?= (?:without|but|and|with|then|in|at)\b|\s*(?:[,.;!?]|$))", _laps),
    # "drive once around the tin", "fly round and round the castle"
    (rf"\b(?:drive|fly|travel|sail|cruise|whizz|zoom|walk|wander|swoop|lap|skate|march|dance)"
     rf"(?P<often> {_ONCE})? (?:a?round and )?a?round {_THING}", 
     lambda said: f"go{said['often'] or ''} around "),
    (rf"\bgo (?:(?P<often>{_ONCE}) )?round and round {_THING}", "go around "),
    # "around the tin in the round", "once around the tin, one lap"
    (r"(?<=\w) (?:in the round|all the way round)(?=\s*(?:[,.;!?]|$))", ""),
    (rf"(\ba?round [^,.;!?]+?)[,.;]+ (?:one|a|a single|just one|only one) (?:full |complete |whole "
     rf"|single )*(?:{_LAP}|sweep|turn|time|go)(?: only)?(?=\s*(?:[,.;!]|$))", r"\1"),
)  # fmt: skip
_RULES = tuple((re.compile(turn, re.IGNORECASE), plain) for turn, plain in _LAPS)


def round_and_round(text: str) -> str:
    """The sentence with laps around things told in plain words."""
    for turn, plain in _RULES:
        text = turn.sub(plain, text)
    return text

"""An answer among other words: "oh, how silly of me! The gold one, if you would", "ah, forgot: in
the tray". What is said around it asks for nothing, so that the part which answers is the answer.

Where two parts answer differently, or one of them is a command of its own, none is taken.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from clarifier.asked import Answer, AnswerKind
from clarifier.lexicon import Lexicon
from clarifier.words import words

_PARTING = re.compile(r"\s*(?:[,.;:!?…]+(?=\s|$)|(?<=\s)[-–—]+(?=\s)|[–—()])\s*")
_LIKE = re.compile(r"(?<=\w)(?: as| like) (?:an?|the|my) [^,.;:!?]+$", re.IGNORECASE)
"""What something is compared to: "red as a rooster's comb"."""
_CHATTER = re.compile(
    r"(?:[\s,]+(?:naturally|of course|obviously|obv|surely|clearly|duh|what then|what else|then|"
    r"where else|if you(?:'d| would| will)? (?:please|be so kind|don't mind)|dear|love|"
    r"i (?:mean|meant|think|suppose|guess)|was i meaning|is better|it is|would be better))+\W*$",
    re.IGNORECASE,
)
"""What may close a place that answers."""
_POINTS = re.compile(
    r"^(?:(?:just|right|directly|straight) )*"
    r"(?P<side>[\w ]*?\b(?:of|to|behind|beside|by|on|in|near)) (?:it|them)$",
    re.IGNORECASE,
)
"""A place told by what the part before it names: "to the box, right in front of it"."""
_NAMES = re.compile(
    r"^(?:over |down |up )?(?:to|at|by|near|towards?|with|beside) (?=(?:the|my|that|this) )", re.I
)
_ANSWERS: frozenset[AnswerKind] = frozenset({"pick", "words", "thing"})
Read = Callable[[str], Answer]


def parts_of(text: str) -> tuple[str, ...]:
    """The parts of an answer between its stops, without what they are compared to."""
    found: list[str] = []
    for part in (_LIKE.sub("", one) for one in _PARTING.split(text)):
        points = _POINTS.match(part)
        if points is not None and found and _NAMES.match(found[-1]):
            found[-1] = f"{points['side']} {_NAMES.sub('', found[-1])}"
        elif words(part):
            found.append(part)
    return tuple(found)


def without_chatter(text: str) -> str:
    """The answer without what closes it and says nothing: "beside the pot naturally, what then"."""
    return _CHATTER.sub("", text).strip()


def answering_part(text: str, read: Read, commands: Read, lexicon: Lexicon) -> Answer | None:
    """The one answer that the parts of a text give, None for none or several. ``read`` reads a
    part; ``commands`` is asked for every other part, and "other" tells that it asks for a deed."""
    parts = [part for part in parts_of(text) if not _is_light(part, lexicon)]
    if parts_of(text) == (text.strip(" .!?"),):
        return None
    read_parts = [(part, read(part)) for part in parts]
    answers = [answer for _, answer in read_parts if answer.kind in _ANSWERS]
    if not answers or any(answer.kind in ("none", "any", "both") for _, answer in read_parts):
        return None
    rest = [part for part, answer in read_parts if answer.kind not in _ANSWERS]
    if any(commands(part).kind == "other" for part in rest):
        return None
    return _one(answers)


def _one(answers: Sequence[Answer]) -> Answer | None:
    """What several parts agree on: one option, or one place, the fullest where one says the other
    again ("the tray! Of course, in the tray")."""
    if len(set(answers)) == 1:
        return answers[0]
    if any(answer.kind != "words" for answer in answers):
        return None
    last = answers[-1]
    nouns = [set(words(answer.text)[-1:]) for answer in answers]
    return last if len({frozenset(noun) for noun in nouns}) == 1 else None


def _is_light(part: str, lexicon: Lexicon) -> bool:
    """Whether a part says nothing at all: "sorry", "of course", "right"."""
    light = lexicon.words("polite") | lexicon.words("hesitating") | lexicon.words("choosing")
    said = set(words(part)) - {"one"}
    return said <= light and "one" not in words(part)

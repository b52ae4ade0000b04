"""What an answer comes to when it is said in a whole sentence: "honestly I don't mind, you choose".

Only what cannot be the description of a thing is looked for; the rest is for `clarifier.answer`.
"""

from __future__ import annotations

import re
from typing import Literal

Gist = Literal["none", "any", "both", "again"]

_GISTS: tuple[tuple[Gist, re.Pattern[str]], ...] = (
    ("none", re.compile(
        r"\bneither\b|\bnone of\b|\bnot (?:\w+ )?(?:this|that|one)\b.*\b(?:not|nor)\b")),
    ("again", re.compile(
        r"\b(?:my|the) (?:options|choices)\b|\bwhich (?:ones )?are there\b|"
        r"\bsay (?:that|it) again\b|\brepeat (?:that|it|the)\b|\bwhat can i choose\b")),
    ("any", re.compile(
        r"\beither (?:one|of (?:them|the two|those)|is|will)\b|\bwhichever\b|"
        r"\bany ?(?:one|of (?:them|those))\b|\b(?:don't|do not) (?:mind|care)\b|"
        r"\byou (?:choose|pick|decide)\b|\b(?:no matter|doesn't matter)\b|"
        r"\b(?:the|all the) same (?:for|to) me\b|\bup to you\b")),
    ("both", re.compile(
        r"\bboth\b|\bthe two of them\b|\ball (?:of them|of those|three|four|the \w+s)\b")),
)  # fmt: skip
_CALLS_OFF = re.compile(
    r"\b(?:forget (?:about )?(?:it|that)|(?:don't|do not) (?:bother|want (?:it|that|to))|"
    r"never ?mind|(?:leave|skip|drop|scrap|cancel) (?:it|that)|call it off|changed my mind)\b"
    r"(?: (?:now|then|any more|anymore|please|after all))*[\s,.!;]*(?P<rest>.*)$",
    re.IGNORECASE,
)
_NUMBERED = re.compile(r"\b(?:option|number|choice|answer) (\w+)\b")


def gist_of(plain: str) -> Gist | None:
    """The gist of an answer's words; None where it describes something."""
    return next((gist for gist, pattern in _GISTS if pattern.search(plain)), None)


def called_off(text: str) -> str | None:
    """What follows where an answer calls the whole thing off ("" for nothing), else None."""
    found = _CALLS_OFF.search(text)
    return None if found is None else found["rest"].strip()


def number_in(plain: str) -> str | None:
    """The word behind "option" or "number", wherever in the answer it is."""
    found = _NUMBERED.search(plain)
    return None if found is None else found[1]

"""What an answer comes to when it is said in a whole sentence: "honestly I don't mind, you choose".

Only what cannot be the description of a thing is looked for; the rest is for `clarifier.answer`.
"""

from __future__ import annotations

import re
from functools import lru_cache
from typing import Literal

from clarifier.lexicon import load_lexicon

Gist = Literal["none", "any", "both", "again"]

_FORMS: tuple[tuple[Gist, str], ...] = (
    ("none", r"not (?:\w+ )?(?:this|that|one)\b.*\b(?:not|nor)"),
    ("again", ""),
    ("any", ""),
    ("both", r"all the \w+s"),
)
"""What each gist looks like besides the words that the lexicon has for it."""
_CALLS_OFF = re.compile(
    r"\b(?:forget (?:about )?(?:it|that)|(?:don't|do not) (?:bother|(?:want|need) (?:it|that|to))|"
    r"never ?mind|(?:leave|skip|drop|scrap|cancel) (?:it|that)|call it off|changed my mind)\b"
    r"(?: (?:now|then|any more|anymore|please|after all))*[\s,.!;]*(?P<rest>.*)$",
    re.IGNORECASE,
)
_NUMBERED = re.compile(r"\b(?:option|number|choice|answer) (\w+)\b")


def gist_of(plain: str) -> Gist | None:
    """The gist of an answer's words; None where it describes something."""
    return next((gist for gist, pattern in _patterns() if pattern.search(plain)), None)


@lru_cache(maxsize=1)
def _patterns() -> tuple[tuple[Gist, re.Pattern[str]], ...]:
    found = []
    for gist, form in _FORMS:
        said = load_lexicon().either(f"gist_{gist}")
        found.append((gist, re.compile(rf"\b(?:{said}{form and '|'}{form})\b")))
    return tuple(found)


def called_off(text: str) -> str | None:
    """What follows where an answer calls the whole thing off ("" for nothing), else None."""
    found = _CALLS_OFF.search(text)
    if found is None:
        return None
    rest = found["rest"].strip()
    again = called_off(rest)
    return rest if again is None else again


def number_in(plain: str) -> str | None:
    """The word behind "option" or "number", wherever in the answer it is."""
    found = _NUMBERED.search(plain)
    return None if found is None else found[1]

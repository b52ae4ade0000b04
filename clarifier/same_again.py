"""What is said once and meant again: "by the same amount", "as far to the right", "the same again".

The measure, or the whole command, is the one said before, in this sentence or in the last one.
"""

from __future__ import annotations

import re

from agent.messages import Dialog
from clarifier.amounts import Found, with_units
from clarifier.lexicon import Lexicon
from scene.types import Scene

_WAY = (
    r"(?:left|right|up|down|back(?:wards?)?|forwards?|away|sideways|further|farther|clockwise|"
    r"anticlockwise|counterclockwise|(?:to|towards?) (?:the |my |your )?(?:left|right|back|front|"
    r"side|me|you|far|near|other)|in (?:the|that))"
)
_ENDS = rf"(?=\s*(?:[,.;!?]|$)|\s+(?:and|then|but|please|again|too|as well|{_WAY})\b)"
_SAME = re.compile(
    r"\b(?<!half )(?<!twice )(?<!double )(?:"
    r"(?:just |exactly )?(?P<by>by )?(?:the|that|an?) (?:very )?(?:same|equal|identical) "
    r"(?:amount|distance|length|angle|measure|much)|"
    r"(?:just |exactly |equally )?(?:as far|equally far|by as much|just as much)(?: again)?"
    r"(?![^,.;]*\bas\b)|"
    rf"(?P<that>by that much|by that amount|(?<!not )that far)){_ENDS}",
    re.IGNORECASE,
)
_AGAIN = re.compile(
    r"^\W*(?:(?:and|now|then|ok|okay|please|yes|great|good|just)[\s,]+)*(?:(?:do|repeat|try|make|say)"
    r" )?(?:(?:that|it|this|so|the same(?: thing| move| one)?|same(?: thing)?)[\s,]*)?"
    r"(?:(?:all |yet |over )?(?:again|once more|once again|one more time|another time)|"
    r"(?<=repeat )(?:that|it|this)|(?:again|once more)[\s,]+(?:the )?same(?: thing)?)"
    r"(?:[\s,]+(?:please|thanks|now|then|robot))*\W*$",
    re.IGNORECASE,
)


def with_same_measure(text: str, dialog: Dialog) -> str:
    """The sentence with "the same amount" and its like as the measure that was said before."""
    said = _SAME.search(text)
    while said is not None:
        found = _said_before(text[: said.start()], said[0]) or _said_before(
            dialog.last_text or "", said[0]
        )
        if found is None:
            return text
        by = "by " if (said["by"] or said["that"] or "by " in said[0].lower()) else ""
        text = f"{text[: said.start()]}{by}{found}{text[said.end() :]}"
        said = _SAME.search(text, said.start() + len(by) + len(found))
    return text


_ELIDED = re.compile(
    r"\b(?:left|right|forwards?|backwards?|back|up|down|by) (?:\d+(?:\.\d+)?|two|three|four|"
    r"five|six|seven|eight|nine|ten|twelve|fifteen|twenty)"
    r"(?=\s*(?:[,.;!?]|$)|\s+(?:and|then|to the|towards?)\b)",
    re.IGNORECASE,
)
_NUMBER = re.compile(r"^(?:an?|half an?|[\d.,/½¼¾]+|[a-z]+(?:-[a-z]+)?)\s*(?=[a-z])", re.IGNORECASE)


def with_unit(text: str) -> str:
    """ "Slide the red one left 5 cm and the blue one right ten": ten of what was said before."""
    said = _ELIDED.search(text)
    while said is not None:
        before = [one for one in with_units(text[: said.start()]) if one.sort == "d"]
        if not before:
            return text
        unit = _NUMBER.sub("", text[before[-1].start : before[-1].end].strip())
        text = f"{text[: said.end()]} {unit}{text[said.end() :]}"
        said = _ELIDED.search(text, said.end())
    return text


def unit_before(text: str) -> str:
    """The unit of the last length that a text says, "" for none."""
    found = [one for one in with_units(text) if one.sort == "d"]
    return _NUMBER.sub("", text[found[-1].start : found[-1].end].strip()) if found else ""


def lacks_measure(text: str) -> bool:
    """Whether the same amount is still spoken of, and no amount was ever said."""
    said = _SAME.search(text)
    return said is not None and said["by"] is not None


def _said_before(text: str, phrase: str) -> str | None:
    """The last measure of a text, an angle where the phrase says so, as it was said."""
    found = [one for one in with_units(text) if _fits(one, phrase)]
    return text[found[-1].start : found[-1].end].strip() if found else None


def _fits(one: Found, phrase: str) -> bool:
    words = phrase.lower()
    if "angle" in words:
        return one.sort == "t"
    return one.sort == "d" or not re.search(r"far|distance|length", words)


def once_more(text: str, dialog: Dialog, scene: Scene, lexicon: Lexicon) -> str | None:
    """ "And the same again", "once more, please": the last command; else None."""
    return dialog.last_text if _AGAIN.match(text) else None

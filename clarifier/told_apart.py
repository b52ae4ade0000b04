"""Programs that the translator was taught for two meanings; the sentence tells which.

A square stands level, a diamond on its tip; things that are gathered come close together wherever
they are, what goes "in the middle" goes there; the tool that hovers left of a thing is not above
it; what is spread "over the table" fills it, what is
spread out makes a row; the middle of a half of the table is a point. The program stays the
translator's, one word of it is another.
"""

from __future__ import annotations

import re

_TIPPED = re.compile(
    r"\b(?:diamond|rhombus|rhomb|lozenge)\b|\b(?:square|standing)\b.* on (?:its|a|one) "
    r"(?:tip|point|corner)\b",
    re.IGNORECASE,
)
_SQUARE = re.compile(r"\bin_shape\((?P<things>\w+), 4\)")
_MIDDLE = re.compile(
    r"\b(?:middle|midst|mid|cent(?:re|er|ral)\w*|heart of the|core|hub)\b", re.IGNORECASE
)
_GATHERED = re.compile(r'\bput_all\((?P<things>[^"]*), "middle"\)')
_ALL_OVER = re.compile(
    r"\b(?:over|across|around|about|throughout|on|all over) (?:the |my )?(?:whole |entire |full |"
    r"complete )?(?:of the )?(?:table|desk|board|surface|tabletop|area)\b",
    re.IGNORECASE,
)
_ROW = re.compile(r"\b(?:row|line|lines|column|edge|side|left|right|diagonal\w*)\b", re.IGNORECASE)
_SPREAD = re.compile(
    r"\bput_in_line\(from_left\((?P<things>\w+)\), 1\.4 / \(len\((?P=things)\) - 1\), 0\)"
)
_MID_HALF = re.compile(r"\bmiddle of the \w+ half\b", re.IGNORECASE)
_ON_ITS_LEVEL = re.compile(r"\[(?P<x>-?0\.5), \w+\.y\]|\[\w+\.x, (?P<y>-?0\.5)\]")
_HOVERS = re.compile(r"hover\((?P<thing>m1)\)")
_ASIDE = re.compile(
    r"\bhover\w* (?:just |right |directly )?(?:(?:to|on) the (?P<side>left|right) of|"
    r"(?P<depth>in front of|behind)) ",
    re.IGNORECASE,
)
_DEPTHS = {"in front of": "near", "behind": "far"}


def told_apart(body: str, text: str) -> str:
    """The program with what the sentence means of its two meanings."""
    if _TIPPED.search(text):
        body = _SQUARE.sub(r"in_diamond(\g<things>)", body)
    if not _MIDDLE.search(text):
        body = _GATHERED.sub(r"gather(\g<things>)", body)
    if _ALL_OVER.search(text) and not _ROW.search(text):
        body = _SPREAD.sub(r"put_each(\g<things>, all_over(\g<things>))", body)
    aside = _ASIDE.search(text)
    if aside is not None and (over := _HOVERS.fullmatch(body)) is not None:
        side = aside["side"] or _DEPTHS[aside["depth"].lower()]
        body = f'hover(just_beside({over["thing"]}, "{side.lower()}"))'
    if _MID_HALF.search(text):
        body = _ON_ITS_LEVEL.sub(
            lambda said: f"[{said['x']}, 0]" if said["x"] else f"[0, {said['y']}]", body
        )
    return body

"""Corners and sides as people describe them: "the corner nearest me on the left", "the right
corner, the one away from me", "your side of the box". They are put as "the near left corner",
"behind the box".
"""

from __future__ import annotations

import re

_HAND = r"(?:[ -]?hand)?(?: side)?"
_LEFT_RIGHT = r"left|right"
_PRE = r"(?:(?:far|near|back|front|rear|top|bottom|upper|lower|left|right)(?:[ -]?hand)?)"
_NEAR_ME = (
    r"(?:right )?(?:nearest|closest|next|near|close|nearer|closer|right in front)(?: by| of| up)?"
    r"(?: to)? (?P<{0}>me|us|you|myself|yourself|where (?:i|we)(?:'m| am| are| sit)"
    r"(?: sitting)?)"
)
_FAR_FROM_ME = (
    r"(?:furthest|farthest|far|away|further|farther|most distant|opposite)(?: away)?(?: from)? "
    r"(?P<{0}>me|us|you|myself|yourself|where (?:i|we)(?:'m| am| are| sit)(?: sitting)?)"
)
_SIDED = rf"(?:over |up )?(?:on|at) (?:the |my )?(?P<{{0}}>{_LEFT_RIGHT}|back|front){_HAND}"
_BARE = rf"(?P<{{0}}>{_LEFT_RIGHT})(?:[ -]?hand)? (?:side|one)"
_LINK = (
    r"(?:,| -)?(?: so| i\.?e\.?| meaning| namely| that is to say,?)?"
    r"(?: the one| the corner| one)?(?: (?:that|which)(?:'s| is| lies)|that's| which)?,?"
)
_ONE_PART = re.compile(
    rf"{_LINK} (?:and )?(?:(?:the one )?{_NEAR_ME.format('near')}|{_FAR_FROM_ME.format('far')}|"
    rf"{_SIDED.format('side')}|{_BARE.format('bare')})(?! of\b)(?=\W|$)",
    re.IGNORECASE,
)
_CORNER = re.compile(
    rf"\b(?:the|a|that|my) (?P<pre>(?:{_PRE} )*)corner(?: of (?:the|my) (?:table|desk|board))?",
    re.IGNORECASE,
)
_SIDES = {"far": "far", "back": "far", "rear": "far", "top": "far", "upper": "far", "near": "near",
          "front": "near", "bottom": "near", "lower": "near", "left": "left",
          "right": "right"}  # fmt: skip
_OTHER = {"near": "far", "far": "near"}
_YOUR_SIDE = re.compile(
    r"\b(?:(?:on|to|at) )?your side of "
    r"(?=(?:the|that|this|my|a) (?!table|desk|board|worktop))",
    re.IGNORECASE,
)
_DEEP = re.compile(
    r"\b(?P<lead>to) the (?:very )?(?P<side>top|bottom)(?: of the (?:table|desk|board|tabletop))?"
    r"(?=\s*(?:[.,;!?]|$)|(?: please| and| then| but| while)\b)",
    re.IGNORECASE,
)
"""A side of the table that is named as on a picture."""
_HIGH = re.compile(r"\b(?:stack|pile|tower|heap|pil|climb|on top|upon|shelf|ladder)", re.IGNORECASE)
"""Words of what has a top and a bottom of its own."""


def corners_named(text: str) -> str:
    """The sentence with each corner that is told by where the person is named by its two sides."""
    text = _YOUR_SIDE.sub("behind ", text)
    if _HIGH.search(text) is None:
        text = _DEEP.sub(
            lambda said: f"{said['lead']} the {_SIDES[said['side'].lower()]} edge", text
        )
    at = 0
    while (corner := _CORNER.search(text, at)) is not None:
        named, end = _read(text, corner)
        if named is not None:
            text = f"{text[: corner.start()]}{named}{text[end:]}"
            at = corner.start() + len(named)
        else:
            at = corner.end()
    return text


def _read(text: str, corner: re.Match[str]) -> tuple[str | None, int]:
    """The corner's name and where its description ends; None where it is not told, or is told
    twice and differently."""
    sides = {_SIDES[word[:-5] if word.endswith("-hand") else word]
             for word in corner["pre"].lower().replace(" hand", "").split()}  # fmt: skip
    end, parts = corner.end(), 0
    while (part := _ONE_PART.match(text, end)) is not None:
        said = _side(part)
        if said == _OTHER.get(next(iter(sides & {"near", "far"}), ""), ""):
            return None, end
        if {said, *sides} >= {"left", "right"}:
            return None, end
        sides.add(said)
        end, parts = part.end(), parts + 1
    depth, width = sides & {"near", "far"}, sides & {"left", "right"}
    if not parts or len(depth) != 1 or len(width) != 1:
        return None, end
    return f"the {depth.pop()} {width.pop()} corner", end


def _side(part: re.Match[str]) -> str:
    """Which side a part of a description tells; the arm sits opposite the person."""
    for depth in ("near", "far"):
        if part[depth] is not None:
            return _OTHER[depth] if part[depth].lower().startswith("you") else depth
    return _SIDES[(part["side"] or part["bare"]).lower()]

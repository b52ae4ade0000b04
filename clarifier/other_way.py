"""The last command in the opposite direction: "no, the other way"."""

from __future__ import annotations

import re

OTHER_WAY = re.compile(
    r"^\W*(?:(?:no|nope|oh|not that way|wrong way|wrong direction|sorry|i meant?)[\s,.!]+)*"
    r"(?:in |to |on )?"
    r"(?:the )?(?:other|opposite|wrong) (?:way|direction|side)(?: a?round)?(?:[\s,]+please)?\W*$",
    re.IGNORECASE,
)
_PAIRS = (
    ("left", "right"), ("clockwise", "anticlockwise"), ("towards me", "away from me"),
    ("behind", "in front of"), ("forwards", "backwards"), ("forward", "backward"),
    ("far", "near"), ("up", "down"),
)  # fmt: skip
_OPPOSITE = {one: other for pair in _PAIRS for one, other in (pair, pair[::-1])} | {
    "counterclockwise": "clockwise", "leftwards": "rightwards", "rightwards": "leftwards",
}  # fmt: skip
_WAY = re.compile(rf"\b(?:{'|'.join(sorted(_OPPOSITE, key=len, reverse=True))})\b", re.IGNORECASE)
_TURN = re.compile(r"\b(?:turn|rotate|spin|twist|swivel|pivot)\b", re.IGNORECASE)


def reversed_way(command: str) -> str | None:
    """The command with its one direction turned into the opposite; a turn for which no sense was
    said (it is anticlockwise) becomes clockwise. None where there is no one direction."""
    ways = list(_WAY.finditer(command))
    if len(ways) == 1:
        way = ways[0]
        return f"{command[: way.start()]}{_OPPOSITE[way[0].lower()]}{command[way.end() :]}"
    turns = not ways and _TURN.search(command) is not None
    return f"{command.rstrip(' .!')} clockwise" if turns else None

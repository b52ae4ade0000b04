"""The object in front of its verb: "screwdriver put on the right", "the third screw pick up".
The verb is put first.
"""

from __future__ import annotations

import re

from clarifier.lexicon import Lexicon
from clarifier.mentions import link
from clarifier.spoken import Linked
from scene.types import Scene

_TAKES = frozenset(
    {"put", "place", "set", "lay", "move", "bring", "carry", "take", "push", "pull", "slide"}
    | {"shove", "lift", "pick", "grab", "turn", "rotate", "knock", "touch", "tap", "hold", "drag"}
    | {"shift", "raise", "poke"}
)
"""Verbs that want an object behind them; "the cups stand in a row" has none of these."""
_BETWEEN = frozenset({"please", "you", "kindly", "now", "just", ",", "must", "should"})
_PARTICLES = frozenset({"up", "down", "over"})
_CLOSE = re.compile(
    r"(?P<where>\b(?:left|right|front|behind|side)\b[^,.;]*),? (?:very |quite |and )?close(?: by)?"
    r"(?=\s*[.!]*$)",
    re.IGNORECASE,
)


def verb_in_front(text: str, scene: Scene, lexicon: Lexicon) -> str | None:
    """The sentence with its verb before the object that opens it; None for any other order."""
    linked = link(text, scene, (), lexicon)
    if not linked.spoken or linked.spoken[0].phrase is None or linked.spoken[0].opened:
        return None
    thing = linked.spoken[0]
    at = thing.last
    while _text(at, linked) in _BETWEEN:
        at += 1
    verb = _text(at, linked)
    end = at + 1 + (_text(at + 1, linked) in _PARTICLES)
    if verb not in _TAKES or not _has_no_object(end, linked):
        return None
    if thing.mention.plural and lexicon.verb(verb) == "touch":
        return None  # "the cups touch": each other
    tokens = linked.tokens
    does = text[tokens[at].start : tokens[end - 1].end]
    what = text[: tokens[thing.last - 1].end]
    return _CLOSE.sub(r"\g<where>", f"{does} {what}{text[tokens[end - 1].end :]}")


def _has_no_object(at: int, linked: Linked) -> bool:
    """Whether what stands behind a verb is where to, another clause or nothing."""
    behind = next((chunk for chunk in linked.chunks if chunk.first >= at), None)
    return behind is None or behind.kind in ("relation", "place", "joint", "measure")


def _text(at: int, linked: Linked) -> str:
    return linked.tokens[at].text if at < len(linked.tokens) else ""

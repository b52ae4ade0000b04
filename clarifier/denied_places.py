"""Places that a sentence denies beside the one it wants: "by the lamp, but not next to the box".

The denial is cut from what is translated and becomes a fact that the end is held against: what was
moved there is asked for again in another way, or refused (`stands_there`).
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from agent.messages import Problem
from clarifier.located import related
from clarifier.pieces import DeniedPlace
from clarifier.spoken import Linked
from scene.relations import moved
from scene.types import Scene

_JOINING = frozenset(
    {",", ".", ";", "!", "-", ":", "but", "rather", "instead", "and", "just", "no"}
)
_DENIAL = re.compile(
    r",? (?:(?:but|and|just|only|though|yet)[ ,]+)+(?:(?:please|certainly|definitely|ever) )*"
    r"(?:not|never) (?=(?:right |directly |too |so )?(?:next to|beside|by|near|close to|on|onto|"
    r"in|into|inside|to the|at the|left of|right of|behind|in front of|under|over|between|above)"
    r"\b)",
    re.IGNORECASE,
)
_WORDS = {"beside": "next to", "on": "on", "in": "in", "left": "to the left of", "above": "behind",
          "right": "to the right of", "below": "in front of"}  # fmt: skip
_SIDES = tuple(_WORDS[side] for side in ("left", "right", "below", "above"))


def marked(text: str) -> str:
    """The sentence with every "but not next to ..." as ", not next to ..."."""
    return _DENIAL.sub(", not ", text)


def put_last(linked: Linked) -> str | None:
    """The sentence with a denied place behind everything else; None where it has none there."""
    for i, chunk in enumerate(linked.chunks):
        place = _place(i + 1, linked)
        if linked.tokens[chunk.first].text != "not" or place is None or not i:
            continue
        begins = _before_joints(i, linked)
        ends = place
        while ends < len(linked.chunks) and _word(ends, linked) in _JOINING:
            ends += 1
        start = linked.tokens[linked.chunks[begins - 1].last - 1].end
        denied = linked.text[linked.tokens[chunk.first].start : _end(place, linked)]
        denied = f"not{denied[3:]}"
        other = _place(ends, linked)
        if other is not None and linked.chunks[begins - 1].kind in ("np", "pronoun"):
            rest = linked.text[linked.tokens[linked.chunks[ends].first].start :].rstrip(" .,;!")
            return f"{linked.text[:start]} {rest[:1].lower()}{rest[1:]}, {denied}"
        if _led(begins, place, linked) and begins < i:
            rest = linked.text[_end(place, linked) :].rstrip(" .,;!")
            return f"{linked.text[:start]}{rest}, {denied}"
    return None


def without_denied(linked: Linked) -> tuple[str, str, tuple[DeniedPlace, ...]] | None:
    """The sentence without a denied place behind everything else, the words of the denial, and
    what it denies; None where there is none."""
    for i, chunk in enumerate(linked.chunks):
        if linked.tokens[chunk.first].text != "not" or not i:
            continue
        place, begins = _place(i + 1, linked), _before_joints(i, linked)
        if place is None or not _led(begins, place, linked) or begins == i:
            continue
        if any(_word(k, linked) not in _JOINING for k in range(place, len(linked.chunks))):
            continue
        relation = linked.chunks[i + 1]
        named = [s for s in linked.spoken if relation.last <= s.first and s.relation]
        anchors = tuple(dict.fromkeys(o for one in named for o in one.mention.objects))
        start = linked.tokens[linked.chunks[begins - 1].last - 1].end
        said = linked.text[linked.tokens[chunk.first].start : _end(place, linked)]
        known = _relation(linked, i + 1)
        denied = (DeniedPlace(known, anchors),) if known and anchors else ()
        return linked.text[:start], f", {said}", denied
    return None


def by_side(linked: Linked) -> tuple[str, ...]:
    """ "Next to the lamp" said for each side of the lamp; nothing where no such place is said once
    beside a denied one."""
    beside = [chunk for chunk in linked.chunks if chunk.kind == "relation"]
    if not linked.denied or len(beside) != 1 or beside[0].value != "beside":
        return ()
    start, end = linked.tokens[beside[0].first].start, linked.tokens[beside[0].last - 1].end
    text = linked.text
    return tuple(f"{text[:start]}{side}{text[end:]}{linked.caution}" for side in _SIDES)


def stands_there(denied: Sequence[DeniedPlace], before: Scene, after: Scene) -> Problem | None:
    """The first thing that a program moves to where the sentence says that it is not to be."""
    ends = {item.id: item for item in after}
    for place in denied:
        for item in before:
            end = ends.get(item.id)
            if end is None or end.x is None or item.id in place.anchors:
                continue
            if moved(item, end) == 0 and (end.on, end.held) == (item.on, item.held):
                continue
            there = [ends[o] for o in place.anchors if ends[o].x is not None]
            bad = next((o for o in there if related(place.relation, end, o, after)), None)
            if bad is not None:
                text = f"the {item.name} would be {_WORDS[place.relation]} the {bad.name}"
                return Problem("unsafe", text, object=item.id)
    return None


def _relation(linked: Linked, at: int) -> str:
    """The relation of a chunk as the scene knows it, "" for any other."""
    value = linked.chunks[at].value
    if value in _WORDS:
        return value
    goal = {"into": "in", "onto": "on", "in": "in", "on": "on", "inside": "in"}
    return goal.get(linked.tokens[linked.chunks[at].first].text, "")


def _place(at: int, linked: Linked) -> int | None:
    """The chunk behind a relation, at a chunk, and what it leads to."""
    chunks = linked.chunks[at : at + 2]
    if (
        len(chunks) < 2
        or chunks[0].kind != "relation"
        or chunks[1].kind not in ("np", "place", "pronoun")
    ):
        return None
    last = chunks[1].last
    named = next((s.last for s in linked.spoken if s.opened == chunks[1].first), last)
    return next((k for k, c in enumerate(linked.chunks) if c.first >= max(named, last)),
                len(linked.chunks))  # fmt: skip


def _led(begins: int, place: int, linked: Linked) -> bool:
    """Whether another place is said right before, and nothing more behind."""
    led = any(_place(k, linked) == begins for k in range(begins))
    return led and (place == len(linked.chunks) or linked.chunks[place].kind == "joint")


def _end(place: int, linked: Linked) -> int:
    return linked.tokens[linked.chunks[place - 1].last - 1].end


def _before_joints(at: int, linked: Linked) -> int:
    """The first of the chunks that only join what comes at a chunk to what is before."""
    while at > 0 and _word(at - 1, linked) in _JOINING:
        at -= 1
    return at


def _word(at: int, linked: Linked) -> str:
    chunk = linked.chunks[at]
    return " ".join(token.text for token in linked.tokens[chunk.first : chunk.last])

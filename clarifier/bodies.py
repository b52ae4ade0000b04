"""What the text of a candidate alone rules out: slots left out, things set upon themselves.

Ladder rules 4 and 6 (clarifier design): the veto that needs no scene.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from clarifier.spoken import Linked

_SLOT = re.compile(r"\b[mdtn]\d+\b")
_ITSELF = re.compile(
    r"\b(?:left_of|right_of|behind|in_front_of|next_to|side_of|beside|up_to|put_on)"
    r"\([mw](\d+), [mw]\1[,)]"
)


_TURN = re.compile(r"^turn\([^\n]*\)$", re.MULTILINE)
_COUNTS = re.compile(
    r"\b(?:twice|thrice|two|three|four|times|again|double|more|another|each|both|then|back|after|"
    r"\d+|next|and (?:now|turn|spin|rotate))\b",
    re.IGNORECASE,
)
"""Words by which a turn may be meant more than once."""
_BANS = frozenset({"don't", "dont", "not", "never", "doesn't"})
_PLACED = re.compile(
    r"^(?:put_all\w*|put_each|row|column|put_in_line|stack|sort_by_color)\((m\d+)[,)]", re.MULTILINE
)


def slots_in(body: str) -> set[str]:
    """The slots that a program speaks of."""
    return set(_SLOT.findall(body))


def may_stand(body: str, linked: Linked, slots: Sequence[str], sure: bool) -> bool:
    """Whether a program uses every slot and sets nothing upon itself; one that leaves things out
    may if it is ``sure``, or if they were only denied."""
    if relates_to_itself(body) or places_twice(body):
        return False
    left_out = set(linked.slots) - slots_in(body)
    spared = spares(body, spared_slots(linked), slots) and (sure or left_out <= denied(linked))
    return uses_exactly(body, slots) or spared


def turned_once(body: str, text: str) -> str:
    """The program without a turn that only says the one before again, where the sentence counts
    nothing: "a quarter turn, so that it lies across" is one turn."""
    lines = body.split("\n")
    if not _TURN.search(body) or _COUNTS.search(text):
        return body
    kept = [line for at, line in enumerate(lines)
            if at == 0 or line != lines[at - 1] or not _TURN.match(line)]  # fmt: skip
    return "\n".join(kept)


def uses_exactly(body: str, slots: Sequence[str]) -> bool:
    """Whether a program uses every slot, of mentions and of measures, and no other."""
    return slots_in(body) == set(slots)


def relates_to_itself(body: str) -> bool:
    """Whether a program puts a thing beside or upon itself: "it" was taken for the wrong one."""
    return _ITSELF.search(body) is not None


def places_twice(body: str) -> bool:
    """Whether a program gives one group two places: what the first made, the second undoes."""
    placed = _PLACED.findall(body)
    return len(set(placed)) < len(placed)


_DENIALS = frozenset(
    {"not", "without", "except", "leave", "leaving", "never", "avoid", "than", "but"}
)
"""Behind these a thing is named that has no part in the deed."""


def spared_slots(linked: Linked) -> tuple[str, ...]:
    """The slots that a program may leave out: of things that lead to others or are denied, never of
    what something is to be done with."""
    themes = set()
    for at, one in enumerate(linked.spoken):
        start = linked.spoken[at - 1].last if at else 0
        led = {token.text for token in linked.tokens[start : one.opened]}
        denied = led & _DENIALS or any(text.endswith("n't") for text in led)
        if one.theme and one.phrase is not None and not denied:
            themes.add(one.mention.slot)
    return tuple(slot for slot in linked.slots if slot not in themes)


def spares(body: str, things: Sequence[str], slots: Sequence[str]) -> bool:
    """Whether a program leaves out only things ("take it off {b}", "not {c}"), and not all of them.

    A measure that was said is never left out.
    """
    named = slots_in(body)
    return named < set(slots) and bool(named) and set(slots) - named <= set(things)


def denied(linked: Linked) -> set[str]:
    """Slots of things that are named in a clause which says what not to do, and nowhere else:
    "don't put it on {b}, put it on {c}". A program need not speak of them."""
    joints = [chunk.first for chunk in linked.chunks if chunk.kind == "joint"]
    no, yes = set[str](), set[str]()
    for one in linked.spoken:
        begins = max((at for at in joints if at < one.opened), default=0)
        said = {token.text for token in linked.tokens[begins : one.opened]}
        (no if said & _BANS else yes).add(one.mention.slot)
    return no - yes

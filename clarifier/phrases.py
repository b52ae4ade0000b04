"""The phrases of a sentence: what each asks for can be understood, and translated, alone."""

from __future__ import annotations

import re

from clarifier.pieces import Chunk
from clarifier.spoken import Linked

_LEADING = frozenset({"then", "now", "also", "please", "finally", "just", "next", "afterwards"})
_AFTER = ["after", "that"]
_JOINTS = frozenset({"and", "then", "but", ",", ".", ";", ":", "!", "?"})
_CONDITIONS = frozenset({"if", "unless", "otherwise", "else", "when", "whether", "until", "while"}
                        | {"not", "never", "dont"})  # fmt: skip
"""Words that make one phrase depend on another."""
_POINTING = frozenset(
    {"it", "its", "them", "their", "they", "there", "same", "that", "this", "one", "ones", "too"}
    | {"again", "back", "other", "others", "both", "each", "rest", "where", "instead", "likewise"}
    | {"vice", "former", "latter", "so"}
)
"""Words outside the mentions that mean what another phrase says."""
_TAIL = re.compile(r"(?:[\s,.;:!?]+|\b(?:and|then|but)\b|\bafter that\b)$", re.IGNORECASE)


def phrases_of(linked: Linked) -> tuple[str, ...]:
    """The phrases of a sentence that each ask for something: they begin with a verb, or, where no
    verb is said, say of a thing where it goes. One where a condition or a denial joins them."""
    return tuple(linked.text[start:end] for start, end in spans(linked))


def alone(linked: Linked) -> tuple[tuple[int, int], ...]:
    """Where the phrases are if each can be translated alone: every one names a thing, and none
    points at what another one says. Empty where they cannot."""
    found = _with_what_is_held(spans(linked), linked)
    if len(found) < 2:
        return ()
    inside = {i for one in linked.spoken for i in range(one.opened, one.last)}
    free = [token for i, token in enumerate(linked.tokens) if i not in inside]
    said = {t.text for t in free if any(start <= t.start < end for start, end in found)}
    if said & _POINTING:
        return ()
    named = [(one.mention.start, one.mention.end) for one in linked.spoken]
    each = all(any(a <= start and end <= b for start, end in named) for a, b in found)
    whole = all(any(a <= start and end <= b for a, b in found) for start, end in named)
    return found if each and whole else ()


def _with_what_is_held(
    found: tuple[tuple[int, int], ...], linked: Linked
) -> tuple[tuple[int, int], ...]:
    """The phrases, one that ends with something in the gripper ("grab the cup") together with the
    next one, which is done with it."""
    joined: list[tuple[int, int]] = []
    for start, end in found:
        if joined and _keeps_hold(linked, *joined[-1]):
            joined[-1] = (joined[-1][0], end)
        else:
            joined.append((start, end))
    return tuple(joined)


def _keeps_hold(linked: Linked, start: int, end: int) -> bool:
    """Whether a phrase takes something and says nothing of where to."""
    kinds = {
        chunk.value if chunk.kind == "verb" else chunk.kind
        for chunk in linked.chunks
        if start <= linked.tokens[chunk.first].start < end
    }
    return "pick" in kinds and not kinds & {"relation", "place"}


def spans(linked: Linked) -> tuple[tuple[int, int], ...]:
    """Where the phrases of `phrases_of` begin and end in the sentence."""
    texts = [token.text for token in linked.tokens]
    if any(text in _CONDITIONS or text.endswith("n't") for text in texts):
        return ((0, len(linked.text)),)
    inside = {i for one in linked.spoken for i in range(one.opened, one.last)}
    starts = [0]
    for chunk in linked.chunks:
        joint = chunk.kind == "joint" and chunk.first not in inside
        if joint and linked.tokens[chunk.first].text in _JOINTS:
            at = _past_joints(chunk.first, linked)
            if at > starts[-1] and _asks(at, starts[-1], linked):
                starts.append(at)
        elif _runs_on(chunk, starts[-1], linked):
            starts.append(chunk.first)
    ends = [*(linked.tokens[at].start for at in starts[1:]), len(linked.text)]
    first = [0, *(linked.tokens[at].start for at in starts[1:])]
    return tuple(
        (start, _end(linked.text, start, end)) for start, end in zip(first, ends, strict=True)
    )


def _past_joints(at: int, linked: Linked) -> int:
    texts = [token.text for token in linked.tokens]
    while at < len(texts) and (texts[at] in _JOINTS | _LEADING or texts[at : at + 2] == _AFTER):
        at += 1 + (texts[at] == "after")
    return at


def _asks(at: int, before: int, linked: Linked) -> bool:
    """Whether the words from a token on ask for something of their own."""
    chunks = [c for c in linked.chunks if c.first >= at]
    ends = (i for i, c in enumerate(chunks) if c.kind == "joint")
    part = chunks[: next(ends, len(chunks))]
    if not part:
        return False
    unknown = part[0].kind == "other" and [c.kind for c in part[1:2]] == ["np"]
    if part[0].kind == "verb" or unknown:
        return True
    led = [c for c in linked.chunks if before <= c.first < at and c.kind in ("relation", "place")]
    says = any(c.kind in ("relation", "place", "verb") for c in part[1:])
    return bool(led) and part[0].kind == "np" and says


def _runs_on(chunk: Chunk, before: int, linked: Linked) -> bool:
    """Whether a thing's place is said and the next thing named without a joint: "the cup left of
    the box the pen on the pad"."""
    own = [c for c in linked.chunks if c.first >= before]
    number = own.index(chunk) if chunk in own else 0
    if chunk.kind != "np" or number < 2 or number + 1 >= len(own):
        return False
    theme = any(one.theme and one.opened == chunk.first for one in linked.spoken)
    placed = any(c.kind in ("relation", "place") for c in own[:number])
    ended = own[number - 1].kind in ("np", "place")
    return theme and placed and ended and own[number + 1].kind in ("relation", "place")


def _end(text: str, start: int, end: int) -> int:
    """The end of a phrase without what joins it to the next."""
    while (match := _TAIL.search(text, start, end)) is not None and match.start() > start:
        end = match.start()
    return end

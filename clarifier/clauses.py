"""A command's clauses, one for each verb, and what in them says where, which way or how far."""

from __future__ import annotations

from dataclasses import dataclass

from clarifier.lexicon import Lexicon
from clarifier.pieces import JOINTS, Chunk
from clarifier.spoken import Linked, Spoken
from clarifier.words import number

VAGUE = frozenset({"bit", "little", "slightly", "somewhat", "touch", "tad", "smidgen", "halfway"})
"""Words for a short way."""
COMPLETE = frozenset({"so", "such", "until", "where", "wherever", "as", "flat", "aside", "apart"}
                     | {"together", "back", "home", "me", "upside", "twice", "far", "straight"}
                     | {"end", "way", "sideways", "loose", "free", "level"})  # fmt: skip
"""Words that say where or how, or open a clause that does."""
_PARTICLES = frozenset({"over", "across", "along", "through", "past", "around", "off", "nearby"}
                       | {"nearer", "closer", "opposite", "alongside", "until"})  # fmt: skip
"""Relations that may stand alone: "push it over"."""
_LEADING = frozenset({"down", "right", "just", "somewhere", "back", "it", "them"})
"""Words between a verb, or what it acts on, and the place."""
_LOOSE = frozenset({"down", "over", "right", "just"})
"""Words between a verb's object and "there"."""
_SLIGHT = frozenset({"the", "a", "an", "my", "your", "its", "please", "and", "of"})
"""Words that say nothing behind a relation that they end with."""
_AMONG = frozenset({"or", "rather", "instead", "if", "whichever", "than", "unless", "not"})
"""Where one of these is said, a side is chosen by it."""


@dataclass(frozen=True)
class Clause:
    """A verb of class ``verb`` at token ``first`` and its clause, tokens ``start:last``."""

    verb: str
    start: int
    first: int
    last: int


@dataclass(frozen=True)
class Unsaid:
    """A place that is begun and not said: characters ``cut:end`` of the sentence.

    ``lead`` is what the place begins with ("next to"); ``anchor`` the thing beside which it is.
    """

    cut: int
    end: int
    lead: str = ""
    anchor: Spoken | None = None


def clauses(linked: Linked) -> list[Clause]:
    """The clauses of a sentence, in order."""
    free = outside(linked)
    verbs = [c for c in linked.chunks if c.kind == "verb" and c.first in free]
    verbs = [c for c in verbs if not _is_unit(c, linked) and not _tells_how(c, linked)]
    ends = [c.first for c in verbs[1:]] + [len(linked.tokens)] * bool(verbs)
    found = []
    for nth, (chunk, end) in enumerate(zip(verbs, ends, strict=True)):
        joints = [c.last for c in linked.chunks if c.kind == "joint" and c.last <= chunk.first]
        start = max([verbs[nth - 1].last, *joints]) if nth else 0
        found.append(Clause(chunk.value, start, chunk.first, end))
    return found


def _tells_how(chunk: Chunk, linked: Linked) -> bool:
    """ "Push the cup, leaving 5 cm to the edge": part of what is to be done with the cup."""
    behind = [c for c in linked.chunks if c.first >= chunk.last][:1]
    leaves = linked.tokens[chunk.first].text in ("leaving", "keeping") and chunk.first > 0
    return leaves and bool(behind) and behind[0].kind == "measure"


def _is_unit(chunk: Chunk, linked: Linked) -> bool:
    """ "by one space": a verb's form that is counted is no verb."""
    before = linked.tokens[chunk.first - 1].text if chunk.first else ""
    return chunk.first > 1 and number(before) is not None


def outside(linked: Linked) -> set[int]:
    """Tokens that are in no mention."""
    inside = {i for one in linked.spoken for i in range(one.first, one.last)}
    return set(range(len(linked.tokens))) - inside


def words_of(clause: Clause, linked: Linked) -> list[int]:
    """The clause's tokens outside the mentions, the verb left out."""
    free = outside(linked)
    return [i for i in range(clause.start, clause.last) if i in free and i != clause.first]


def amount(clause: Clause, linked: Linked) -> tuple[int, ...]:
    """The ends of the words that say how far, or how many: "6 cm", "a bit", "by one space"."""
    ends = [
        linked.tokens[c.last - 1].end
        for c in linked.chunks
        if c.kind == "measure" and clause.start <= c.first < clause.last
    ]
    for i in words_of(clause, linked):
        text, before = linked.tokens[i].text, linked.tokens[i - 1].text if i else ""
        counted = number(text) is not None and (text != "one" or before == "by")
        if counted or text in VAGUE:
            more = before == "by" and i + 1 < clause.last and linked.tokens[i + 1].text.isalpha()
            ends.append(linked.tokens[i + 1 if more else i].end)
    return tuple(ends)


def goal(clause: Clause, linked: Linked, lexicon: Lexicon) -> bool:
    """Whether a place, a relation with something behind it, or a direction stands outside the
    mentions; "there" alone says nothing that can be acted on."""
    free = outside(linked)
    pointing = lexicon.words("pointing")
    for i, chunk in enumerate(linked.chunks):
        if not clause.start <= chunk.first < clause.last or chunk.first not in free:
            continue
        following = linked.chunks[i + 1] if i + 1 < len(linked.chunks) else None
        after = linked.tokens[following.first].text if following is not None else ""
        word = linked.tokens[chunk.first].text
        if _only_points(i, linked):
            continue
        if word in pointing - {"here", "there"} or (word in pointing and _place_before(i, linked)):
            return True
        if chunk.kind == "place" or chunk.value == "idiom" or word in COMPLETE:
            return True
        if _only_spans(i, clause, linked):
            continue
        if word == "to" and after == "be":
            continue
        leads = chunk.kind == "relation" and word not in ("with", "for")
        if (leads or word in lexicon.words("directions")) and after not in pointing:
            return True
    return False


def _only_spans(at: int, clause: Clause, linked: Linked) -> bool:
    """ "by 6 cm", "over" in "move it over a bit": how far, not where."""
    chunk = linked.chunks[at]
    word = linked.tokens[chunk.first].text
    following = linked.chunks[at + 1] if at + 1 < len(linked.chunks) else None
    behind = linked.tokens[following.first].text if following is not None else ""
    if word == "by" and chunk.kind == "relation":
        counted = following is not None and following.kind == "measure"
        return counted or number(behind) is not None or behind in VAGUE | {"a", "an"}
    if word != "over" or chunk.kind != "relation":
        return False
    alone = following is None or following.kind in ("joint", "relation", "measure")
    alone = alone or behind in VAGUE | {"by"} or following is None
    if not alone and behind == "a":
        alone = bool({t.text for t in linked.tokens[chunk.last + 1 : chunk.last + 3]} & VAGUE)
    if amount(clause, linked):  # "it is too far off, nudge it over a bit" says which way before
        return alone and len({one.mention.slot for one in linked.spoken}) == 1
    return alone and clause.verb == "place" and clause.last == len(linked.tokens)


def _only_points(at: int, linked: Linked) -> bool:
    """ "down over there", "down here": a hand that nobody sees."""
    texts = [token.text for token in linked.tokens[linked.chunks[at].first :]]
    end = next((i for i, text in enumerate(texts) if text not in _LOOSE), len(texts))
    return 0 < end < len(texts) and texts[end] in ("here", "there")


def _place_before(at: int, linked: Linked) -> bool:
    """Whether "there" can mean a place said earlier in the sentence."""
    led = {one.opened for one in linked.spoken if one.relation}
    verbs = [chunk.first for chunk in linked.chunks[:at] if chunk.kind == "verb"]
    if len(verbs) > 1:
        now = {one.mention.slot for one in linked.spoken if one.first > verbs[-1]}
        before = {one.mention.slot for one in linked.spoken if verbs[0] < one.first < verbs[-1]}
        if before - now:
            return True
    return any(
        (chunk.kind == "place" and linked.tokens[chunk.last - 1].text not in _LOOSE)
        or (chunk.kind == "relation" and chunk.last in led)
        for chunk in linked.chunks[:at]
    )


# --- places that are begun and not said ---------------------------------------------------------


def unsaid(clause: Clause, linked: Linked, lexicon: Lexicon) -> Unsaid | None:
    """A place of the clause that breaks off, is only pointed at, or has no side."""
    free = outside(linked)
    for i, chunk in enumerate(linked.chunks):
        if not clause.first < chunk.first < clause.last:
            continue
        found = None
        if chunk.first in free and chunk.kind == "relation":
            found = _broken_off(i, clause, linked, lexicon)
        elif chunk.first in free and chunk.kind == "place":
            found = _without_side(i, linked, lexicon)
        if found is not None:
            return found
    return None


def _broken_off(at: int, clause: Clause, linked: Linked, lexicon: Lexicon) -> Unsaid | None:
    """ "put it next to", "put it on top", "put it between the cup and": to what is not said."""
    chunk, rest = linked.chunks[at], linked.chunks[at + 1 :]
    text = linked.text[linked.tokens[chunk.first].start : linked.tokens[chunk.last - 1].end]
    words = [token.text for token in linked.tokens[chunk.last : clause.last]]
    words = words[: next((i for i, word in enumerate(words) if word in JOINTS), len(words))]
    start = linked.tokens[chunk.first].start
    if not _right_behind(at, linked):
        return None
    if chunk.value == "between":
        return _one_of_two(at, clause, linked)
    if len({one.mention.slot for one in linked.spoken if one.first < clause.last}) > 1:
        return None  # the thing can be one that was named before
    if text.lower() == "on" and words[:1] == ["top"] and set(words[1:]) <= _SLIGHT:
        return Unsaid(start, linked.tokens[rest[0].last - 1].end, f"{text} top of")
    alone = set(text.lower().split()) <= _PARTICLES | lexicon.words("directions")
    if alone or not set(words) <= _SLIGHT or clause.last < len(linked.tokens):
        return None
    return Unsaid(start, linked.tokens[chunk.last - 1 + len(words)].end, text)


def _right_behind(at: int, linked: Linked) -> bool:
    """Whether a relation stands behind the verb or a thing; "the edge it is nearest to", "where it
    came from" and "push it from behind" are whole."""
    first = linked.chunks[at].first
    before = linked.tokens[first - 1]
    texts = {token.text for token in linked.tokens[:first]}
    thing = any(one.last == first for one in linked.spoken)
    verb = linked.chunks[at - 1].kind == "verb"
    led = thing or verb or before.text in _LEADING
    return led and not texts & {"where", "which", "whichever", "what", "whatever", "that"}


def _one_of_two(at: int, clause: Clause, linked: Linked) -> Unsaid | None:
    """ "between the cup and": one thing, a joint, and the sentence's end."""
    chunk = linked.chunks[at]
    over = clause.last == len(linked.tokens)
    led = [one for one in linked.spoken if one.first >= chunk.last and one.relation == "between"]
    behind = {token.text for one in led[:1] for token in linked.tokens[one.last : clause.last]}
    start, end = linked.tokens[chunk.first].start, linked.tokens[-1].end
    if not over or len(led) > 1 or (led and (led[0].mention.plural or "and" not in behind)):
        return None
    if not led and (chunk.last < clause.last or len({s.mention.slot for s in linked.spoken}) > 1):
        return None
    if not led:
        return Unsaid(start, end, linked.text[start:end])
    if not behind <= _SLIGHT:
        return None
    return Unsaid(start, end, f"{linked.text[start : led[0].mention.end]} and")


def _without_side(at: int, linked: Linked, lexicon: Lexicon) -> Unsaid | None:
    """ "on that side", "at the side of the box": a side, and not which."""
    chunk = linked.chunks[at]
    texts = [token.text for token in linked.tokens[chunk.first : chunk.last]]
    led = at > 0 and linked.chunks[at - 1].kind == "relation"
    first = linked.chunks[at - 1 if led else at].first
    anchor = _owner(chunk.last, linked)
    start, end = linked.tokens[first].start, linked.tokens[chunk.last - 1].end
    if anchor is None:
        pointed = texts[0] == "that" or (texts[0] in ("this", "the") and texts[1:2] == ["other"])
        vague = pointed and _bare_side(texts, lexicon) and not _said_otherwise(at, linked, lexicon)
        return Unsaid(start, end) if vague else None
    over = anchor.last == len(linked.tokens) or linked.tokens[anchor.last].text in JOINTS
    relation = linked.tokens[first].text if led else ""
    said = {token.text for token in linked.tokens}
    bare = texts in (["the", "side"], ["that", "side"], ["side"])
    sides = bare and relation in ("at", "on", "to")
    if not (sides and over) or said & _AMONG:
        return None
    return Unsaid(start, anchor.mention.end, anchor=anchor)


def _said_otherwise(at: int, linked: Linked, lexicon: Lexicon) -> bool:
    """Whether the sentence says elsewhere which side is meant: a place, a direction, a thing."""
    free = outside(linked)
    others = [c for i, c in enumerate(linked.chunks) if i != at and c.first in free]
    ways = lexicon.words("directions") - {"over"}
    places = any(c.kind == "place" or linked.tokens[c.first].text in ways for c in others)
    return places or len({one.mention.slot for one in linked.spoken}) > 1


def _bare_side(texts: list[str], lexicon: Lexicon) -> bool:
    """Whether a place names no side: nothing but "side" or "end" and "of the table"."""
    telling = lexicon.place_adjectives - {"other", "same", "very", "table"}
    kinds = {"side", "end", "edge", "corner", "half"}
    return bool(kinds & set(texts)) and not (set(texts) - kinds) & telling


def _owner(at: int, linked: Linked) -> Spoken | None:
    """The thing behind "of" at a token."""
    if at >= len(linked.tokens) or linked.tokens[at].text != "of":
        return None
    return next((s for s in linked.spoken if s.opened == at + 1 and s.phrase is not None), None)

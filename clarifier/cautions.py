"""Cautions: what a sentence asks to be spared, beside what it asks to be done.

"... without touching the box", "... but don't hit it", "mind the glass": no deed. A caution is cut
from what is translated, and the things that it spares must stay where they are, which the forecast
shows (`unasked.disturbed`). "Don't put it on the plate, put it on the box" is no caution: it says
where something goes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from clarifier.forbidden import DISTURBING
from clarifier.lexicon import Lexicon
from clarifier.pieces import Chunk
from clarifier.spoken import Linked, Spoken, settles
from clarifier.words import stems

_SO_NOT = frozenset({"doesn't", "won't", "can't"})
_NOT = frozenset({"don't", "dont", "not", "never", "without", "avoid", "avoiding"}) | _SO_NOT
_CARE = frozenset({"careful", "mind", "beware", "watch"})
_STAYS = frozenset({"alone", "be", "where", "as", "untouched", "undisturbed", "still"})
"""Behind "leave the box": it is to stay."""
_ADVERBS = frozenset({"exactly", "precisely", "just", "right", "there", "all", "well"})
_OVER = frozenset({"", ",", ".", ";", "!", "?", "please", "belongs", "goes", "should", "thanks"})
_AGAINST = frozenset({"into", "against", "off", "over", "with", "on", "down"})
"""Relations that belong to such a verb: "bump into", "knock over", "with the gripper"."""
_LIGHT = frozenset({"ever", "please", "even", "accidentally", "actually", "you", "to", "do", "be"})
JOINING = frozenset({",", ".", ";", "and", "but", "while", "please", "be", "very", "taking"}
                     | {"take", "care", "make", "sure", "try", "trying", "just", "careful", "do"}
                     | {"also", "then", "-", "never"})  # fmt: skip
BEHIND = frozenset({",", ".", ";", "and", "then", "but", "please", "just", "only", "instead"})
_EVERY = frozenset({"everything", "anything", "all", "nothing", "something"})
CHOICES = frozenset({"if", "otherwise", "else", "unless", "when", "should", "whether"})


@dataclass(frozen=True)
class Caution:
    """Tokens ``first:last``; ``verb`` is what is not to happen, "" where that was not said."""

    first: int
    last: int
    verb: str


def cautions(linked: Linked, lexicon: Lexicon) -> tuple[Caution, ...]:
    """The cautions of a sentence, in order."""
    inside = {i for one in linked.spoken for i in range(one.first, one.last)}
    chosen = any(
        token.text in CHOICES and not (token.text == "else" and word_at(i - 1, linked) in _EVERY)
        for i, token in enumerate(linked.tokens)
    )
    found: list[Caution] = []
    for i, token in enumerate(linked.tokens):
        if i in inside or (found and i < found[-1].last):
            continue
        if chosen and token.text not in ("without", "avoiding"):
            continue
        caution = _caution_at(i, linked, lexicon)
        if caution is not None:
            least = found[-1].last if found else 0
            first = _widened(i, least, linked, inside)
            led = {t.text for t in linked.tokens[first:i]}
            if token.text in _SO_NOT and "so" not in led:
                continue  # "it won't fall" is no request
            found.append(replace(caution, first=first))
    return tuple(found)


def _caution_at(at: int, linked: Linked, lexicon: Lexicon) -> Caution | None:
    word = linked.tokens[at].text
    if word == "not" and (contrast := _contrasted(at, linked)) is not None:
        return contrast
    if word == "not" and at and word_at(at - 1, linked) not in JOINING | {"to", "as"}:
        return None  # "the box must not move" has its own subject
    if word in _NOT:
        verb = past_light(at + 1, linked)
        stem = next((s for s in stems(word_at(verb, linked)) if s in DISTURBING), None)
        avoids = word.startswith("avoid") and _named_at(verb, linked) is not None
        if not avoids and (stem is None or _is_no_caution(at, verb, stem, linked)):
            return None
        last = _end(verb if avoids else verb + 1, linked, lexicon)
        return None if last is None else Caution(at, last, stem or "")
    if word in _CARE:
        after = at + 1 + (word_at(at + 1, linked) == "out")
        after += word_at(after, linked) in ("with", "of", "for", "about", "around")
        if _named_at(after, linked) is None:
            return None
        last = _end(after, linked, lexicon)
        return None if last is None else Caution(at, last, "")
    return _left_alone(at, linked) if word in ("leave", "leaving") else None


def _contrasted(at: int, linked: Linked) -> Caution | None:
    """ "the tall candle, not the stubby one": says again which one is not meant."""
    named = _named_at(at + 1, linked)
    if named is None or named.phrase is None or named.mention.plural or not at:
        return None
    before = [s for s in linked.spoken if s.last <= at and settles(s.mention)]
    kin = [s for s in before if set(s.mention.objects) & set(named.same_type)]
    told = kin and set(kin[-1].mention.objects) != set(named.mention.objects)
    over = word_at(named.last, linked) in _OVER and word_at(at - 1, linked) in (",", "and", "but")
    return Caution(at, named.last, "") if told and over else None


def _is_no_caution(at: int, verb: int, stem: str, linked: Linked) -> bool:
    """ "In a row, not touching", "the box don't move", "hold it there and don't drop it": how
    things are to stand, whose subject was said, or what is to be kept hold of."""
    word = word_at(at, linked)
    if word == "not" and word_at(verb, linked).endswith("ing"):
        return True
    if stem == "drop" and word not in ("without", "avoiding"):
        return True
    subject = any(one.last == at for one in linked.spoken)
    return subject and word != "without" and _named_at(verb + 1, linked) is None


def _left_alone(at: int, linked: Linked) -> Caution | None:
    """ "leave the box where it is"."""
    named = _named_at(at + 1, linked)
    if named is None or named.phrase is None:
        return None
    last = named.last
    while word_at(last, linked) in _ADVERBS:
        last += 1
    if word_at(last, linked) not in _STAYS:
        bare = last == named.last and at > 0 and _is_over(last, linked)
        return Caution(at, last, "") if bare else None
    last += 1
    if word_at(last - 1, linked) in ("where", "as"):
        while word_at(last, linked) in ("it", "they", "is", "are", "stands", "stand", "it's"):
            last += 1
    return Caution(at, last, "")


def _is_over(at: int, linked: Linked) -> bool:
    """Whether nothing more is said: "put the nuts in the jar, leave the bolts"."""
    word, after = word_at(at, linked), word_at(at + 1, linked)
    verbs = {c.first for c in linked.chunks if c.kind == "verb"}
    return word in _OVER or (
        word in ("and", "but", "then") and (after == "then" or at + 1 in verbs)
    )


def _end(at: int, linked: Linked, lexicon: Lexicon) -> int | None:
    """Where a caution that goes on at a token ends; None if it says where something goes."""
    chunks = [c for c in linked.chunks if c.first >= at]
    inside = {i for one in linked.spoken for i in range(one.first, one.last)}
    for nth, chunk in enumerate(chunks):
        text = linked.tokens[chunk.first].text
        if chunk.first in inside:
            continue
        if chunk.kind == "relation" and text not in _AGAINST:
            return None
        if chunk.kind == "joint" and text != "else" and _starts_clause(nth, chunks, linked):
            return chunk.first
        gerund = text.endswith("ing")
        if chunk.kind == "verb" and nth and not gerund and lexicon.verb(text) is not None:
            return chunk.first
    return len(linked.tokens)


def _starts_clause(at: int, chunks: Sequence[Chunk], linked: Linked) -> bool:
    """Whether something else begins behind a joint, no other thing to be spared."""
    text = linked.tokens[chunks[at].first].text
    if text in (".", ";", "!", "?", "then", "but", "instead"):
        return True
    rest = list(chunks[at + 1 :])
    while rest and linked.tokens[rest[0].first].text in BEHIND:
        rest.pop(0)
    if not rest or rest[0].kind not in ("np", "pronoun"):
        return text != "or" or not rest
    ends = (i for i, c in enumerate(rest) if c.kind == "joint")
    return any(c.kind in ("relation", "place") for c in rest[: next(ends, len(rest))])


def _widened(at: int, least: int, linked: Linked, inside: set[int]) -> int:
    """The first of the words that lead to a caution: "but please", "and be"."""
    first = next((i for i in range(at - 1, max(at - 4, least) - 1, -1)
                  if word_at(i, linked) == "so"), at)  # fmt: skip
    while first > least and first - 1 not in inside and word_at(first - 1, linked) in JOINING:
        first -= 1
    return first


def past_light(at: int, linked: Linked) -> int:
    while word_at(at, linked) in _LIGHT:
        at += 1
    return at


def word_at(at: int, linked: Linked) -> str:
    return linked.tokens[at].text if at < len(linked.tokens) else ""


def _named_at(at: int, linked: Linked) -> Spoken | None:
    return next((s for s in linked.spoken if s.opened == at), None)

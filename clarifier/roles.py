"""What a command leaves out: a destination, a direction, an angle, or the thing itself.

Only what each verb class needs is known here (`lexicon.toml`); what the words mean is not. A role
is missing where the verb clearly needs it and nothing in its clause can fill it: what is unusual
but complete ("the apple would look better on the plate") is left to the translator.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from clarifier.lexicon import Lexicon
from clarifier.pieces import JOINTS
from clarifier.spoken import Linked, Spoken
from clarifier.words import number, stems

Role = Literal["where", "direction", "angle", "theme"]
_ACTIONS = frozenset({"place", "push", "turn", "pick", "touch", "topple"})
_ARM = frozenset(
    {"go", "move", "point", "stay", "reach", "hover", "show", "aim", "come", "approach"}
)
"""Verbs that may speak of the arm itself."""
_PILING = frozenset({"stack", "pile"})
"""Several things that are stacked go onto one another."""
_NOT = frozenset({"not", "never", "without", "dont", "no", "avoid"})
_VAGUE = frozenset({"bit", "little", "slightly", "somewhat", "touch", "tad", "smidgen", "halfway"})
_COMPLETE = frozenset({"so", "such", "until", "where", "wherever", "as", "flat", "aside", "apart"}
                      | {"together", "back", "home", "me", "upside", "twice", "far", "straight"}
                      | {"end", "way", "sideways", "loose", "free", "level"})  # fmt: skip
"""Words that say where or how, or open a clause that does."""


@dataclass(frozen=True)
class Gap:
    """A role that nothing fills. ``cut:end`` is the text that an answer replaces."""

    role: Role
    verb: str
    theme: Spoken | None
    cut: int
    end: int


@dataclass(frozen=True)
class _Region:
    """A verb at token ``first`` and its clause, tokens ``start:last``."""

    verb: str
    start: int
    first: int
    last: int


def find_gap(linked: Linked, lexicon: Lexicon) -> Gap | None:
    """The first role that is missing, or None."""
    for region in _regions(linked):
        gap = _gap(region, linked, lexicon)
        if gap is not None:
            return gap
    return None


def _regions(linked: Linked) -> list[_Region]:
    outside = _outside(linked)
    verbs = [c for c in linked.chunks if c.kind == "verb" and c.first in outside]
    ends = [c.first for c in verbs[1:]] + [len(linked.tokens)] * bool(verbs)
    regions = []
    for nth, (chunk, end) in enumerate(zip(verbs, ends, strict=True)):
        joints = [c.last for c in linked.chunks if c.kind == "joint" and c.last <= chunk.first]
        start = max([verbs[nth - 1].last, *joints]) if nth else 0
        regions.append(_Region(chunk.value, start, chunk.first, end))
    return regions


def _outside(linked: Linked) -> set[int]:
    """Tokens that are in no mention."""
    inside = {i for one in linked.spoken for i in range(one.first, one.last)}
    return set(range(len(linked.tokens))) - inside


def _gap(region: _Region, linked: Linked, lexicon: Lexicon) -> Gap | None:
    verb = linked.tokens[region.first].text
    if _lacks_object(region, linked, lexicon):
        at = _behind_verb(region, linked)
        return Gap("theme", verb, None, at, at)
    themes = [s for s in linked.spoken if region.first < s.first < region.last and s.theme]
    if not themes or region.verb not in ("place", "push", "turn") or _denied(region, linked):
        return None
    if _has_subject(region, linked):
        return None
    said = {linked.tokens[i].text for i in _words_of(region, linked)}
    if region.verb == "turn":
        filled = said & (lexicon.words("angles") | _VAGUE | _COMPLETE) or _number(region, linked)
        filled = filled or _goal(region, linked, lexicon)
        return None if filled else Gap("angle", verb, themes[-1], *_tail(region, linked))
    piled = {s.mention.slot for s in themes}, any(s.mention.plural for s in themes)
    if any(stem in _PILING for stem in stems(verb)) and (len(piled[0]) > 1 or piled[1]):
        return None
    if _goal(region, linked, lexicon):
        return None
    some_way = _number(region, linked) or said & _VAGUE
    role: Role = "direction" if region.verb == "push" or some_way else "where"
    return Gap(role, verb, themes[-1], *_cut(region, linked, themes[-1], lexicon))


def _has_subject(region: _Region, linked: Linked) -> bool:
    """ "the plate should carry the cup": a thing does it, nobody is told where to put anything."""
    before = [s for s in linked.spoken if region.start <= s.first and s.last <= region.first]
    if not before or before[-1].relation or before[-1].mention.text.lower() == "it":
        return False
    between = {t.text for t in linked.tokens[before[-1].last : region.first]}
    return not between & (JOINTS | {"to", "please", "just", "you"})


def _denied(region: _Region, linked: Linked) -> bool:
    """ "don't move it", "without moving it": nothing more needs to be said."""
    before = {t.text for t in linked.tokens[max(region.first - 2, 0) : region.first]}
    return bool(before & _NOT) or any(text.endswith("n't") for text in before)


def _lacks_object(region: _Region, linked: Linked, lexicon: Lexicon) -> bool:
    """ "put", "pick up": nothing in the whole sentence that could be meant."""
    if region.verb not in _ACTIONS or linked.spoken or _has_them(region, linked):
        return False
    goal = _goal(region, linked, lexicon) or _number(region, linked)
    arm = any(stem in _ARM for stem in stems(linked.tokens[region.first].text))
    return not (arm and goal)


def _has_them(region: _Region, linked: Linked) -> bool:
    """Whether the verb has an object of some kind, were it only "the arm"."""
    particles = ("up", "down", "over")
    behind = [c for c in linked.chunks if c.first > region.first]
    behind = [c for c in behind if linked.tokens[c.first].text not in particles]
    if any(c.kind in ("pronoun", "np") for c in behind):
        return True
    return bool(behind) and behind[0].kind == "other"


def _words_of(region: _Region, linked: Linked) -> list[int]:
    """The clause's tokens outside the mentions, the verb left out."""
    outside = _outside(linked)
    return [i for i in range(region.start, region.last) if i in outside and i != region.first]


def _goal(region: _Region, linked: Linked, lexicon: Lexicon) -> bool:
    """Whether a place, a relation with something behind it, or a direction stands outside the
    mentions; "there" alone says nothing that can be acted on."""
    outside = _outside(linked)
    pointing = lexicon.words("pointing")
    for i, chunk in enumerate(linked.chunks):
        if not region.start <= chunk.first < region.last or chunk.first not in outside:
            continue
        following = linked.chunks[i + 1] if i + 1 < len(linked.chunks) else None
        after = linked.tokens[following.first].text if following is not None else ""
        word = linked.tokens[chunk.first].text
        if word in pointing - {"here", "there"} or (word in pointing and _place_before(i, linked)):
            return True
        if chunk.kind == "place" or chunk.value == "idiom" or word in _COMPLETE:
            return True
        leads = chunk.kind == "relation" and word not in ("with", "for")
        if (leads or word in lexicon.words("directions")) and after not in pointing:
            return True
    return False


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
        chunk.kind == "place" or (chunk.kind == "relation" and chunk.last in led)
        for chunk in linked.chunks[:at]
    )


def _number(region: _Region, linked: Linked) -> bool:
    """Whether the clause holds a measure or a number."""
    if any(c.kind == "measure" and region.start <= c.first < region.last for c in linked.chunks):
        return True
    texts = [linked.tokens[i].text for i in _words_of(region, linked)]
    return any(number(text) is not None for text in texts if text != "one")


def _behind_verb(region: _Region, linked: Linked) -> int:
    at = region.first
    if at + 1 < len(linked.tokens) and linked.tokens[at + 1].text in ("up", "down", "over"):
        at += 1
    return linked.tokens[at].end


def _cut(region: _Region, linked: Linked, theme: Spoken, lexicon: Lexicon) -> tuple[int, int]:
    """The text that the answer replaces: "there" and its like, or nothing, behind the theme."""
    start, end = _tail(region, linked)
    pointing = lexicon.words("pointing")
    rest = list(linked.tokens[theme.last : region.last])
    if any(token.text in pointing for token in rest):
        last = max(t.end for t in rest if t.text in pointing)
        return theme.mention.end, last
    return start, end


def _tail(region: _Region, linked: Linked) -> tuple[int, int]:
    """The place behind the region's last mention or number."""
    ends = [s.mention.end for s in linked.spoken if region.first < s.first < region.last]
    texts = linked.tokens[region.first + 1 : region.last]
    ends += [token.end for token in texts if token.text in _VAGUE or number(token.text) is not None]
    ends += [
        linked.tokens[c.last - 1].end
        for c in linked.chunks
        if c.kind == "measure" and region.first < c.first < region.last
    ]
    return max(ends), max(ends)


def complete(text: str, gap: Gap, words: str) -> str:
    """The sentence with the missing words said."""
    return f"{text[: gap.cut].rstrip()} {words.strip()}{text[gap.end :]}"

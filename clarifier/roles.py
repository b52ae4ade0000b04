"""What a command leaves out: a destination, a direction, an angle, or the thing itself.

Only what each verb class needs is known here (`lexicon.toml`); what the words mean is not.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from clarifier.lexicon import Lexicon
from clarifier.mentions import Linked, Spoken
from clarifier.words import number

Role = Literal["where", "direction", "angle", "theme"]
_ACTIONS = frozenset({"place", "push", "turn", "pick", "touch", "topple"})


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
    """A verb and the tokens ``first:last`` up to the next verb."""

    verb: str
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
    return [_Region(c.value, c.first, end) for c, end in zip(verbs, ends, strict=True)]


def _outside(linked: Linked) -> set[int]:
    """Tokens that are in no mention."""
    inside = {i for one in linked.spoken for i in range(one.first, one.last)}
    return set(range(len(linked.tokens))) - inside


def _gap(region: _Region, linked: Linked, lexicon: Lexicon) -> Gap | None:
    themes = [s for s in linked.spoken if region.first < s.first < region.last and s.theme]
    if region.verb in _ACTIONS and not linked.spoken and not _has_them(region, linked):
        at = _behind_verb(region, linked)
        return Gap("theme", linked.tokens[region.first].text, None, at, at)
    if not themes or region.verb not in ("place", "push", "turn"):
        return None
    verb = linked.tokens[region.first].text
    if region.verb == "turn":
        filled = _says(region, linked, lexicon.words("angles")) or _number(region, linked)
        return None if filled else Gap("angle", verb, themes[-1], *_tail(region, linked))
    if _goal(region, linked, lexicon):
        return None
    role: Role = "direction" if region.verb == "push" or _number(region, linked) else "where"
    return Gap(role, verb, themes[-1], *_cut(region, linked, themes[-1], lexicon))


def _has_them(region: _Region, linked: Linked) -> bool:
    """Whether the verb has an object of some kind, were it only "the arm"."""
    particles = ("up", "down", "over")
    behind = [c for c in linked.chunks if c.first > region.first]
    behind = [c for c in behind if linked.tokens[c.first].text not in particles]
    if any(c.kind in ("pronoun", "np") for c in behind):
        return True
    return bool(behind) and behind[0].kind == "other"


def _goal(region: _Region, linked: Linked, lexicon: Lexicon) -> bool:
    """Whether a place, a relation with something behind it, or a direction stands outside the
    mentions; "there" says nothing that can be acted on."""
    outside = _outside(linked)
    pointing = lexicon.words("pointing")
    for i, chunk in enumerate(linked.chunks):
        if not region.first < chunk.first < region.last or chunk.first not in outside:
            continue
        following = linked.chunks[i + 1] if i + 1 < len(linked.chunks) else None
        after = linked.tokens[following.first].text if following is not None else ""
        if chunk.kind == "relation" and after not in pointing:
            return True
        if chunk.kind == "place":
            return True
        word = linked.tokens[chunk.first].text
        if word in ("so", "such", "until", "where", "wherever", "as"):
            return True
        if word in lexicon.words("directions") and after not in pointing:
            return True
    return False


def _says(region: _Region, linked: Linked, wanted: frozenset[str]) -> bool:
    outside = _outside(linked)
    return any(
        linked.tokens[i].text in wanted
        for i in range(region.first + 1, region.last)
        if i in outside
    )


def _number(region: _Region, linked: Linked) -> bool:
    outside = _outside(linked)
    texts = [linked.tokens[i].text for i in range(region.first, region.last) if i in outside]
    return any(number(text) is not None or text[0].isdigit() for text in texts if text != "one")


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
    for i, token in enumerate(texts):
        if number(token.text) is not None or token.text[0].isdigit():
            unit = texts[i + 1].end if i + 1 < len(texts) and texts[i + 1].text.isalpha() else 0
            ends.append(max(token.end, unit))
    return max(ends), max(ends)


def complete(text: str, gap: Gap, words: str) -> str:
    """The sentence with the missing words said."""
    return f"{text[: gap.cut].rstrip()} {words.strip()}{text[gap.end :]}"

"""A group of which some go to one place and the others elsewhere: "two mugs on the tray, the other
two on the book", "one nut left, one right", "half the pegs in the tin and the rest in the box".

What is left of the group is put as "the others", which are its own things and no more (`reading`),
and what is taken of it without its noun as some "of the mugs".
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from agent.messages import Focus
from clarifier.lexicon import Lexicon
from clarifier.mentions import link
from clarifier.placed import makes_a_figure
from clarifier.reading import counted_off
from clarifier.spoken import Linked, Spoken
from clarifier.words import number, number_word, plural, singular
from scene.types import Scene

_COUNT = r"(?:one|two|three|four|five|six|seven|eight|\d)"
_ORDINALS = ("first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth")
_GOING = (
    r"(?:(?:should |must |can |may |to |will |shall |could )?(?:go(?:es)?|be|belongs?|moves?|"
    r"comes?|"
    r"gets?|sits?|stands?|waits?|lives?|lies?)(?: put| placed| moved)? )?"
)
_PLACE = (
    r"(?:in|on|onto|into|at|to|by|near|next|beside|behind|under|left|right|along|inside|over|upon|"
    r"towards?|atop|up|down)\b"
)
_NO_NOUN = (
    r"(?:in|on|onto|into|at|to|by|and|over|next|near|goe?s?|should|must|can|be|belongs?|side|end|"
    r"left"
    r"|right|half|edge|corner|way|hand|ones?|of|along|behind|beside|are|is|stays?|remains?|moves?|"
    r"comes?|gets?|sits?|stands?|may|will|shall|please|then|under|inside)\b"
)
_MORE = re.compile(
    r"(?P<joint>[,;:.]\s*(?:(?:and|then|but|while) )?|\s(?:and|then|but|while|with) )"
    rf"(?:(?:put|place|set|move|take|stick|have) )?(?P<count>another (?:one)?|(?:another "
    rf")?{_COUNT})"
    rf"(?: more| others?)? (?=(?P<to>{_GOING}){_PLACE})(?!{_GOING}(?:on|in|at|to|by|onto|over|next "
    r"to|beside) (?:each|every|top of (?:the other|each|one another)|one\b|the other\b|it\b|"
    r"them\b))",
    re.IGNORECASE,
)
"""Some more of the group, without its noun."""
_REST = re.compile(
    r"\b(?:all (?:of )?)?(?:(?:the|my|those) )?(?:"
    rf"(?P<which>others?|remaining|last)(?: (?P<count>{_COUNT}|couple|pair))?"
    rf"(?: (?P<noun>ones?|(?!{_NO_NOUN})[a-z]+(?: (?!{_NO_NOUN})[a-z]+)?))?(?: of them)?"
    r"|(?:(?:whatever|what|which)(?: \w+s)?|everything|those|the ones|ones|the \w+s)"
    r"(?:'s| is|'re| are| that are| that is)?"
    r" (?:left|remains?|remaining)(?: over)?(?: of (?:them|it))?"
    r"|the remainder|the left-?overs?"
    rf"|the (?P<nth>{'|'.join(_ORDINALS)})(?: one)?)"
    rf"(?=,? {_GOING}{_PLACE}|\s*[,.;:!]|\s*$)",
    re.IGNORECASE,
)
_POINTS = re.compile(r"(?:all|the|my|those)\b", re.IGNORECASE)
_HALF = re.compile(r"\bhalf(?: of)? (?:the|my|these|those) (?=\w+s\b|\w+ \w+s\b)", re.IGNORECASE)
_OTHER_HALF = re.compile(
    r"\b(?:the )?(?:other|second|remaining) half(?: of (?:them|the \w+))?\b|"
    r"(?<=, )half (?=(?:in|on|to|at|next|by)\b)|(?<=and )half (?=(?:in|on|to|at|next|by)\b)",
    re.IGNORECASE,
)
_ANY_REST = re.compile(
    r"\b(?:rest|others?|remaining|remainder|left)\b(?! (?:of|hand|side))", re.IGNORECASE
)
_DEALT = re.compile(
    r"^(?P<lead>(?:(?:please|now|kindly|can you|could you),? )*)(?:split|divide|share|deal|part|"
    r"distribute|separate|sort)(?: (?:up|out))? (?:all (?:of )?)?(?P<det>the|my|these|those) "
    rf"(?P<noun>(?:\w+ ){{0,2}}?\w+s)(?: (?:up|out))?\s*[:;,.–-]+\s*(?P<count>{_COUNT}) (?={_GOING}"
    rf"{_PLACE})",
    re.IGNORECASE,
)
_LISTED = re.compile(
    rf"^(?:all |the |my )*(?P<noun>(?:\w+ )?\w+s)\s*[:–-]\s*(?P<count>{_COUNT}) "
    rf"(?={_GOING}{_PLACE})"
    rf"(?=[^.;]*[,;] (?:and )?(?:{_COUNT}|the (?:others?|rest|last|remaining)) )"
    r"(?!(?:to the |at the |on the )?(?:left|right|back|front) of\b)",
    re.IGNORECASE,
)
"""A list of what becomes of a group: "pegs: one in the tin, two on the mat"."""


class _Part(NamedTuple):
    """What is taken by now of ``whole`` things that are called ``noun``; ``counted``: not named."""

    noun: str
    taken: int
    whole: int
    counted: bool


def parted(text: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> str:
    """The sentence with what is left of a group, or taken of it next, named. Pure."""
    text = _DEALT.sub(r"\g<lead>put \g<count> of \g<det> \g<noun> ", text)
    text = _LISTED.sub(r"put \g<count> of the \g<noun> ", text)
    linked = link(text, scene, focus, lexicon)
    halves = _halved(linked)
    if halves is not None:
        linked = link(halves, scene, focus, lexicon)
    first = next((one for one in linked.spoken if (one.theme or makes_a_figure(one, linked))
                  and _may_be_parted(one)), None)  # fmt: skip
    if first is not None and first.phrase is not None and first.phrase.vague:
        return linked.text  # how many is asked first
    if first is None or linked.text not in (text, halves):
        return text
    part = _Part(_noun(first), _taken(first, linked), len(first.same_type), first.mention.plural)
    if counted_off(first):
        part = _Part(part.noun, max(1, first.count), len(first.mention.objects), True)
    found, behind = [linked.text[: first.mention.end]], first.mention.end
    while (said := _next(linked.text, behind, part)) is not None:
        match, instead, more = said
        found += [linked.text[behind : match.start()], instead]
        behind, part = match.end(), part._replace(taken=part.taken + more)
    return "".join((*found, linked.text[behind:]))


def _may_be_parted(one: Spoken) -> bool:
    """Whether a mention is some of a kind of which more are there."""
    named = one.phrase is not None and bool(one.phrase.head) and not one.phrase.group
    return named and (counted_off(one) or 0 < len(one.mention.objects) < len(one.same_type))


def _taken(first: Spoken, linked: Linked) -> int:
    """How many of the kind are spoken of by name."""
    kind = set(first.same_type)
    named = {o for one in linked.spoken if one.theme and one.phrase and not one.phrase.group
             and one.phrase.det not in ("other", "others") and not kind <= {*one.mention.objects}
             for o in one.mention.objects}  # fmt: skip
    return len(kind & named)


def _next(text: str, behind: int, part: _Part) -> tuple[re.Match[str], str, int] | None:
    """What is said next of the group behind a character, what stands for it, and how many."""
    left = part.whole - part.taken
    more, rest = _MORE.search(text, behind), _REST.search(text, behind)
    while rest is not None and not _fits(rest, part):
        rest = _REST.search(text, rest.end())
    if more is not None and (rest is None or more.start() < rest.start()):
        said = more["count"].lower().removeprefix("another").strip() or "one"
        count = int(number(said) or 0)
        if count == left:
            return more, f"{more['joint']}the others ", count
        return more, f"{more['joint']}{number_word(count)} of the {part.noun} ", count
    return None if rest is None else (rest, "the others", left)


def _fits(rest: re.Match[str], part: _Part) -> bool:
    """Whether what is said of a rest is what is left of the group."""
    left = part.whole - part.taken
    if rest["nth"] is not None:
        return left == 1 and _ORDINALS.index(rest["nth"].lower()) + 1 == part.whole
    if rest["which"] is None:
        return left > 0
    if not (rest["noun"] or rest["count"] or _POINTS.match(rest.group())):
        return False
    noun = (rest["noun"] or "").lower()
    known = noun in ("", "one", "ones") or set(map(singular, noun.split())) <= set(
        map(singular, part.noun.split())
    )
    count = {"couple": 2.0, "pair": 2.0}.get((rest["count"] or "").lower())
    count = count or (number(rest["count"].lower()) if rest["count"] else None)
    bare = not noun and rest["which"].lower() in ("other", "last")
    single = count is None and (bare or (noun != "" and singular(noun) == noun))
    if single and not part.counted:
        return False  # "the tallest here, the other one there": named one by one
    return known and left > 0 and left == (1 if single else count or left)


def _halved(linked: Linked) -> str | None:
    """ "Half of the pegs here, the rest there" of four: two of the pegs, and the others."""
    said = _HALF.search(linked.text)
    of = next((one for one in linked.spoken if said and one.mention.start >= said.start()), None)
    if said is None or of is None or not of.mention.plural or len(of.mention.objects) % 2:
        return None
    rest = linked.text[of.mention.end :]
    if not (_OTHER_HALF.search(rest) or _ANY_REST.search(rest)) or of.mention.start > said.end():
        return None
    part = number_word(len(of.mention.objects) // 2)
    rest = _OTHER_HALF.sub("the others ", rest, count=1).replace("the others  ", "the others ")
    some = f"{part} of the {linked.text[said.end() : of.mention.end]}"
    return f"{linked.text[: said.start()]}{some}{rest}"


def _noun(one: Spoken) -> str:
    """What the things of the group are called, as several."""
    assert one.phrase is not None
    words = [*one.phrase.modifiers, *one.phrase.head] if counted_off(one) else [*one.phrase.head]
    return " ".join((*words[:-1], plural(singular(words[-1]))))

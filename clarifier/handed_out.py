"""One for each: "a coin on every plate", "each plate gets one of the coins", "a coin per plate".

"A coin" is then no coin in particular but all of them, shared out, and the sentence is put so.
"""

from __future__ import annotations

import re

from clarifier.lexicon import Lexicon
from clarifier.spoken import Linked, Spoken
from clarifier.words import number, plural, singular

_WAYS = {"on": ("on", "on"), "in": ("into", "in"), "beside": ("next to", "next to")}
_EACH = re.compile(
    r"^(?:each|every)(?: (?:and every|single))?(?: one)?(?: of)?(?: all(?: of)?)?(?: the)?\b ?",
    re.IGNORECASE,
)
_ONE = re.compile(
    r"^(?:(?:exactly|just|only) )?(?:an?(?: single)?|one|any(?: one)?|another|some|either)(?: of)?"
    r"(?P<the> (?:the|my|your|these|those|our))?\b ?",
    re.IGNORECASE,
)
_LED = frozenset(
    {"down", "out", "over", "up", "top", "of", "the", "please", "and", "just", "in", "on", "each"}
    | {"onto", "into", "inside", "upon", "atop", "to", "next", "beside", "by", "lying", "sitting"}
    | {"is", "goes", "should", "go", "be", "standing", "per", "for"}
)
"""Words between what is handed out and each of those that get it."""
_STANDING = frozenset({"front", "behind", "left", "right", "side", "back", "at", "near", "under"}
                      | {"below", "above", "close", "towards", "around", "before", "hand"}
                      | {"from", "a", "bit", "far", "away"})  # fmt: skip
_GETS = frozenset(
    {"gets", "get", "should", "must", "has", "have", "to", "needs", "wants", "ought", "shall", "is"}
    | {
        "be",
        "given",
        "receives",
        "receive",
        "deserves",
        "carries",
        "carry",
        "holds",
        "hold",
        "wears",
    }
    | {"with", "topped", "filled", "please", "just", "exactly", "only", "can", "could", "may"}
    | {
        "might",
        "put",
        "place",
        "lay",
        "set",
        "drop",
        "i",
        "want",
        "i'd",
        "like",
        "would",
        ",",
        "there",
    }
    | {
        "goes",
        "comes",
        "belongs",
        "stands",
        "lies",
        "sits",
        "need",
        "want",
        "pop",
        "stick",
        "stand",
    }
    | {"wear", "contain", "contains", "you", "see", "find", "will", "end", "up"}
)
"""Words between those that get one each and what they get."""
_BEHIND = re.compile(
    r"^,?\s*(?:(?:laid|sitting|lying|standing|put|placed|to carry) )?(?:(?P<on>on top of it|on top|"
    r"on it|on them|on|to carry)|(?P<in>in it|inside it|inside|in them|within it)|"
    r"(?P<beside>next to it|beside it|by its side|at its side|by it))\b(?! (?:the|a|an|each)\b)",
    re.IGNORECASE,
)
_GIVES = re.compile(r"\b(?:give|hand|deal|allot|assign|provide|top|load|fill)\s+$", re.IGNORECASE)
_HANDED = re.compile(
    r"\bone (?:(?:on|in|inside|into|onto|next to|beside|for|to) )?(?:each|apiece)\b", re.IGNORECASE
)


def handed_out(linked: Linked, lexicon: Lexicon) -> str | None:
    """The sentence with what is handed out said as the group that it is ("the coins on the plates,
    one on each"); None where nothing is, or where its way is not known."""
    for each in linked.spoken:
        if not _is_each(each, linked):
            continue
        for one in linked.spoken:
            if not (one.mention.free and not one.mention.plural and one.phrase is not None):
                continue
            if set(one.mention.objects) & set(each.mention.objects):
                continue
            whole = _put(one, each, linked, lexicon)
            if whole is not None:
                return whole
    return None


def is_handed_out(linked: Linked) -> tuple[Spoken, Spoken] | None:
    """What is handed out, one for each, and what each gets one; None where that is not said."""
    said = _HANDED.search(linked.text)
    ahead = [s for s in linked.spoken if said is not None and s.mention.end <= said.start()]
    if len(ahead) < 2 or not all(s.mention.plural and s.mention.objects for s in ahead[-2:]):
        return None
    return ahead[-2], ahead[-1]


def not_handed_out(linked: Linked) -> str | None:
    """The way in which things are to be handed out that no program knows ("in front of each",
    "two on each"); None where nothing is to be."""
    for each in linked.spoken:
        before = [one for one in linked.spoken if one.last <= each.opened][-1:]
        if not before or not _is_each(each, linked) or not each.relation:
            continue
        one = before[0]
        between = {t.text for t in linked.tokens[one.last : each.opened]}
        counted = one.mention.plural and one.count > 1
        if (
            one.mention.free
            and one.theme
            and one.verb in ("place", "push", "")
            and (counted or between <= _STANDING | _LED)
        ):
            said = linked.text[one.mention.end : each.mention.end].strip()
            return f"{linked.text[_start(one, linked) : one.mention.end]} {said}"
    return None


def _is_each(spoken: Spoken, linked: Linked) -> bool:
    phrase = spoken.phrase
    if phrase is None or not spoken.mention.plural or not phrase.head or phrase.group:
        return False
    return _EACH.match(_words(spoken, linked)) is not None


def _put(one: Spoken, each: Spoken, linked: Linked, lexicon: Lexicon) -> str | None:
    """The sentence put plainly, if nothing but the handing out stands between the two."""
    first, second = (one, each) if one.opened < each.opened else (each, one)
    between = [t.text for t in linked.tokens[first.last : second.opened]]
    start, end = _start(first, linked), second.mention.end
    if first is one:
        if not between or not set(between) <= _LED:
            return None
        way = _way(between) or ("for" in between or "per" in between) * _kind(each, lexicon)
        lead = ""
    else:
        if not set(between) <= _GETS:
            return None
        start, way = _led(start, each, linked)
        behind = _BEHIND.match(linked.text[end:])
        if behind is not None:
            way, end = way or str(behind.lastgroup), end + behind.end()
        given = _GIVES.search(linked.text[:start])
        start = given.start() if given is not None else start
        way = way or ("" if not between and given is None else _kind(each, lexicon))
        lead = "put "
    if way not in _WAYS:
        return None
    over, on = _WAYS[way]
    said = f"{lead}{_group(one, linked)} {over} {_group(each, linked)}, one {on} each"
    return f"{linked.text[:start]}{said}{linked.text[end:]}"


def _led(start: int, each: Spoken, linked: Linked) -> tuple[int, str]:
    """Where "on each plate" begins, and the way it says."""
    before = re.search(
        r"\b(?:(on top of|onto|on)|(inside|into|in)|(next to|beside|by))\s+$",
        linked.text[:start], re.IGNORECASE,
    )  # fmt: skip
    if before is None:
        return start, ""
    return before.start(), "on" if before[1] else "in" if before[2] else "beside"


def _way(between: list[str]) -> str:
    """The relation that the words between say."""
    said = set(between)
    if {"next", "beside", "by"} & said:
        return "beside"
    if {"on", "onto", "upon", "atop", "top"} & said:
        return "on"
    return "in" if {"in", "into", "inside"} & said else ""


def _kind(each: Spoken, lexicon: Lexicon) -> str:
    """On what carries, into what holds."""
    head = each.phrase.head[-1] if each.phrase is not None else ""
    return lexicon.goes(singular(head)) or "on"


def _group(spoken: Spoken, linked: Linked) -> str:
    """The whole of a group, as a definite phrase: "a red coin" as "the red coins"."""
    said = _words(spoken, linked)
    rest = (_EACH if spoken.mention.plural else _ONE).sub("", said, count=1)
    many = _ONE.match(said)
    if spoken.mention.plural or not (many and many["the"]):
        assert spoken.phrase is not None
        head = spoken.phrase.head[-1]
        if number(rest.partition(" ")[0]) is None or spoken.mention.plural:
            form = plural(singular(head))
            rest = re.sub(rf"\b{re.escape(head)}\b", form, rest, count=1, flags=re.IGNORECASE)
    return f"the {rest}"


def _start(spoken: Spoken, linked: Linked) -> int:
    return linked.tokens[spoken.opened].start


def _words(spoken: Spoken, linked: Linked) -> str:
    return linked.text[_start(spoken, linked) : spoken.mention.end]

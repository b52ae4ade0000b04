"""Each thing to the one of a group that has its colour, or has not: "drop each bead into the tub
that matches it", "every peg onto a mat that is not its own colour".

What looks like one thing there, "the tub that matches", is a whole group of which each thing gets
its own: the sentence is put so, in words that the translator has learned.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import NamedTuple

from clarifier.lexicon import load_lexicon
from clarifier.spoken import Linked
from clarifier.words import plural, singular
from scene.relations import gap, moved
from scene.types import Scene, SceneObject

_COLOR = r"(?:colou?r|hue|shade)s?"
_ITS = r"(?:its|their|the|that|his|her)"
_AS_IT = (
    r"(?: (?:as|of|to|than|from) (?:it|its|itself|them|they|their|theirs)(?: own)?"
    r"(?: (?:is|are|has|have))?)?"
)
_OWN = rf"(?:{_ITS} )?(?:very )?(?:same |own |matching |equal |identical )?{_COLOR}{_AS_IT}"
_THAT = r"(?:that|which|what|who)"
_HAS = r"(?:has|have|shares?|bears?|wears?|is|are|is of|is in|are in|is painted|is painted in)"
_SAME = (
    rf"{_THAT}(?:'s| {_HAS})(?: of| in)? {_OWN}|"
    rf"{_THAT} (?:it )?(?:matches|match|fits|fit|goes with|agrees with)(?: (?:it|them))?"
    rf"(?: (?:in|by) {_COLOR}| {_ITS}(?: own)? {_COLOR})?|"
    rf"(?:of|with|in) (?:its|the same|their|the matching|a matching|an equal|that|matching)"
    rf"(?: own)? {_COLOR}{_AS_IT}|"
    rf"whose {_COLOR} (?:it|they) (?:shares?|has|have|matches|match)|"
    rf"whose {_COLOR} (?:matches|equals|agrees with|is the same as) (?:it|its own|its|theirs)|"
    rf"(?:colou?red|painted) (?:like|the same as|as) (?:it|itself)"
)
_NOT = r"(?:is not|isn't|isnt|'s not|has not|does not have|doesn't have|doesnt have|not)"
_OTHER = (
    rf"{_THAT} ?{_NOT}(?: of| in)? {_OWN}|"
    rf"{_THAT} (?:does not|doesn't|doesnt|don't) (?:match|share|fit)"
    rf"(?: (?:it|them))?(?: {_ITS}(?: own)? {_COLOR}| in {_COLOR})?|"
    rf"whose {_COLOR} (?:it|they) (?:does not|doesn't|doesnt|do not|don't) (?:share|have|match)|"
    rf"(?:of|with|in) (?:a|another|some|an)(?: (?:different|other|another))? {_COLOR}"
    rf"(?: (?:than|from|to|as) (?:its own|its|it|itself|their own))?|"
    rf"{_THAT}(?:'s| {_HAS}) (?:of |in )?(?:a |another |some )?(?:different|other|another)"
    rf"(?: {_COLOR})?(?: (?:than|from|to|as) (?:its own|its|it|itself))?"
)
_WHERE = r"(?:into|inside|in|onto|on top of|on|upon|next to|beside|by|to|near)"
_LED = (
    rf"\b(?P<where>{_WHERE}) (?:the one of the|one of the|the|its|their|a|an|any|some|whichever|"
    r"whatever) "
)
_NOUN = r"(?P<noun>(?!one\b)(?:\w+ )?\w+)"
_SEVERAL = re.compile(r"\b(?:each|every|all|both|everything|[a-z]{2,}s)\b", re.IGNORECASE)
_CLAUSES = tuple(
    (re.compile(rf"{_LED}{_NOUN} ?,? ?(?:{clause})(?![\w'])", re.IGNORECASE), said)
    for clause, said in ((_OTHER, "of a different colour"), (_SAME, "of the same colour"))
)
_LED_BY = re.compile(
    rf"{_LED[:-1]} (?:matching|same[- ]colou?red|like[- ]colou?red|correspondingly colou?red|"
    rf"equally colou?red) {_NOUN}(?= *(?:[.,;:!?]|$| please\b))", re.IGNORECASE,
)  # fmt: skip
_FOR_EACH = re.compile(
    r"^for (each|every)(?: one of the| of the| single)? ([\w ]+?), (?:please )?(\w+) (?:it|them)\b",
    re.IGNORECASE,
)
_PAIRED = re.compile(
    r"\s*[,;:]\s*(?:so )?(?P<a>[a-z]+) (?:with|to|on|in|into|onto|goes (?:in|on|to|with)) (?P=a)"
    r"(?:,? (?:and )?(?P<b>[a-z]+) (?:with|to|on|in|into|onto|goes (?:in|on|to|with)) (?P=b))*"
    r"(?=\s*[.!]*$)",
    re.IGNORECASE,
)
_TELLS_SAME = re.compile(
    rf"\b(?:of|with|in|has|have|by|to) (?:its|the same|their|matching|a matching|the matching)"
    rf"(?: own)? {_COLOR}|\bmatching {_COLOR}|\bsame {_COLOR}|\b{_COLOR} (?:match|matching)\b|"
    rf"\b(?:match|matches|matching)\b[^,.;]*? (?:in|by) {_COLOR}",
    re.IGNORECASE,
)
_TELLS_OTHER = re.compile(
    rf"\b(?:different|another|other|differing)(?: \w+)?[- ]{_COLOR}|\bdifferently colou?red|"
    rf"\b(?:not|never|isn't|no)\b[^.;]*?\b(?:{_COLOR}|match)",
    re.IGNORECASE,
)


_NEITHER = re.compile(
    r",? (?:so |such )?that (?:no colou?rs match|(?:the )?colou?rs (?:do not|don't|never) match)\b",
    re.IGNORECASE,
)
_NEVER = re.compile(
    r",? (?:but |and )?(?:never|not|no|avoiding|avoid)(?: (?:of|in|with|into|onto|on|to))? "
    r"(?:the )?same colou?rs?(?: together| twice)?(?=\s*[.!]*$)",
    re.IGNORECASE,
)


_HUE_TO_HUE = re.compile(
    r"(?P<mark>\b(?:on|onto|in|into|inside|next to|beside|to) (?:the |all the )?[^,.;:]*?s"
    r"(?: [^,.;:]*?)?)(?:,| -) ?(?:colou?r (?:to|on|by|for|with|in|into) colou?r|(?:with )?"
    r"(?:the )?colou?rs (?:matching|together)|matching (?:the )?colou?rs)(?=\s*[.!]*$)",
    re.IGNORECASE,
)
_STANDING_FIRST = re.compile(
    r"(?P<hue> of (?:the same|a different) colour) (?P<where>(?:(?:down|up|over) )?(?:there )?"
    r"(?:on|at|in|along) (?:the |my )?(?:left|right|top|bottom|front|back|far edge|near edge))\b",
    re.IGNORECASE,
)
_EACH_ONE = re.compile(
    r"^(?P<all>(?:every|each|all the|all|the) )(?P<noun>\w+)(?: (?!(?:not|never|but|except|without|"
    r"if|only|left|right|one|two|three|in|on|at|by|to|into|onto|next)\b)[^\s,.;:]+)*\s*[,;:–-]+ ?"
    r"each(?: one)?(?: goes)? (?=(?:on|onto|in|into|next to|beside) )",
    re.IGNORECASE,
)


_MATCHES = re.compile(
    r"^(?:please )?(?P<mis>mis)?match(?: up)? (?P<a>(?:the|my|all|both|these)\b[^,.;:]*?s) "
    r"(?:and|with|to) (?P<b>(?:the|my|both|all|these)\b[^,.;:]*?s)(?(mis)| (?:by|in) colou?r)"
    r"(?:\s*[,;:.] (?:each|every one|all)\b[^.;]*\bcolou?r)?(?=\s*[.!]*$)",
    re.IGNORECASE,
)
CLOSE_BY = 0.15
"""What stands no farther off may be with it already (table units)."""
_WAYS = ("of_its_color(", "of_another_color(")


class Matched(NamedTuple):
    """Each mover ends with a landmark of its own colour, or (``same`` false) of another."""

    movers: tuple[str, ...]
    landmarks: tuple[str, ...]
    same: bool


def in_matching_groups(text: str) -> str:
    """The sentence with what each thing is matched with said as the group that it is."""
    text = _MATCHES.sub(_put_together, text)
    text = _HUE_TO_HUE.sub(r"\g<mark> of the same colour", text)
    text = _EACH_ONE.sub(_each_of, text)
    text = _NEVER.sub(" of a different colour", _NEITHER.sub(", colours must not match", text))
    each = _FOR_EACH.sub(r"\3 \1 \2", text)
    for clause, said in _CLAUSES:
        whole = clause.sub(_as_group(each, said), each)
        if whole != each:
            return _STANDING_FIRST.sub(r" \g<where>\g<hue>", _PAIRED.sub("", whole))
    whole = _LED_BY.sub(_as_group(each, "of the same colour"), each)
    return text if whole == each else _PAIRED.sub("", whole)


def _each_of(said: re.Match[str]) -> str:
    """ "Every cube goes home now: each one onto ...": each cube onto it."""
    return f"each {singular(said['noun'])} goes "


def _put_together(said: re.Match[str]) -> str:
    """ "Mismatch the pegs and the mats": the pegs onto mats of a different colour."""
    way = load_lexicon().goes(singular(said["b"].lower().split()[-1])) or "next "
    hue = "a different" if said["mis"] else "the same"
    return f"put {said['a']} {way}to {said['b']} of {hue} colour"


def _as_group(text: str, said: str) -> Callable[[re.Match[str]], str]:
    """ "onto the mats of the same colour" for what was matched, where several things get one."""

    def put(found: re.Match[str]) -> str:
        several = _SEVERAL.search(text[: found.start()])
        if several is None:
            return found.group()
        *before, noun = found["noun"].split(" ")
        return " ".join((found["where"], "the", *before, plural(singular(noun)), said))

    return put


def twin(body: str) -> str | None:
    """The program that goes by the other of "the same colour" and "another colour"."""
    for one, other in (_WAYS, _WAYS[::-1]):
        if one in body:
            return body.replace(one, other)
    return None


def matched(linked: Linked, binding: Mapping[str, tuple[str, ...]]) -> tuple[Matched, ...]:
    """What the sentence says of the colours of two groups; nothing where it says none."""
    groups = [one for one in linked.spoken if one.mention.plural]
    same, other = _TELLS_SAME.search(linked.text), _TELLS_OTHER.search(linked.text)
    if len(groups) != 2 or len(linked.spoken) != 2 or not (same or other):
        return ()
    movers, marks = (binding.get(one.mention.slot, ()) for one in groups)
    if not groups[0].theme or groups[1].theme or not movers or set(movers) & set(marks):
        return ()
    return (Matched(movers, marks, other is None),)


def in_match(goal: Matched, before: Scene, after: Scene) -> bool:
    """Whether everything ends with what has its colour, or with what has not."""
    return all(_with(goal, after, before.get(one), after.get(one)) for one in goal.movers)


def _with(goal: Matched, after: Scene, was: SceneObject, item: SceneObject) -> bool:
    """Whether a thing ends as told, and was put there unless it stands close by; where nothing of
    the group is as told it may stay anywhere."""
    marks = [after.get(mark) for mark in goal.landmarks]
    fitting = [mark for mark in marks if (mark.color == item.color) is goal.same]
    if not fitting or item.x is None:
        return True
    held = [mark for mark in marks if mark.id == item.on]
    ends = held or sorted(
        (mark for mark in marks if mark.x is not None), key=lambda mark: gap(item, mark)
    )
    if not ends or ends[0] not in fitting:
        return False
    return bool(held) or moved(was, item) > 0 or gap(item, ends[0]) <= CLOSE_BY

"""Some of a group, and what becomes of the rest of it: "put two nuts in the jar and leave the
others where they are", "all but one", "one left of the lamp, the other right of it".

That the rest stays needs no saying, what nobody names stays anyway: it is cut off. How many of a
group must stay, or that none may, is held against what a program does.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import NamedTuple

from clarifier.spoken import Linked
from clarifier.words import number, number_word, plural, singular
from scene.relations import moved
from scene.types import Scene

_COUNT = r"(?:one|two|three|four|five|six|seven|eight|\d)"
_REST = (
    r"(?:(?:all )?(?:the |my )?(?:others?(?: ones)?|rest|remaining(?: ones| \w+)?|remainder|"
    r"other \w+)(?: of (?:them|the \w+))?|what(?:'s|s| is) left(?: of them)?|"
    r"whatever (?:is left|remains))"
)
_STILL = (
    r"(?:(?:right|exactly|just|all) )?(?:where (?:they|it)(?: all)?(?: are| is|'re|'s| stand| lie|"
    r" sit)(?: now)?|alone|be|lie|stay|stand|sit|rest|as (?:they|it) (?:are|is)|in place|put|"
    r"untouched|there|out|in peace|"
    r"in (?:their |its |the same )?(?:positions?|spots?))"
    r"(?: (?:where (?:they|it) (?:are|is)|put|there|in place))?"
)
_STAYS = (
    r"(?:(?:can|may|should|must|shall|will|have to|has to|are to|is to|just|all) )*"
    r"(?:stays?|remains?|keeps?(?: to)?|stands?|lies?|rests?)"
    r"(?: (?:put|there|in place|as they are|(?:in )?(?:its|their) places?|(?:right |just )?where "
    r"(?:they|it)(?: are| is|'re| stand| lie)(?: now)?))?"
)
_JOINT = r"\s*(?:[,;:.]\s*|\s)(?:(?:and|but|while|whereas|then|please) )*"
_WHY = r"(?:, (?:they(?:'re| are)|it's|that's|those are)\b[^.;]*)?"
_END = r"(?=\s*(?:[.;!]|$))"
_LEFT_OVER = tuple(
    re.compile(rf"{_JOINT}{said}{_WHY}{_END}", re.IGNORECASE)
    for said in (
        rf"(?:leave|let|keep) {_REST} {_STILL}", rf"{_REST} {_STAYS}",
        rf"(?:don't|dont|do not|never) (?:touch|move) {_REST}",
        rf"{_REST},? (?:you )?(?:don't|dont|do not|never) (?:touch|move)",
        r"(?:no|not) more(?: than that)?",
        r"(?:which ones?|it)(?: they are)? (?:is|are|does not|doesn't|do not|don't) "
        r"(?:immaterial|irrelevant|matter|all the same|up to you)",
    )
)  # fmt: skip
_NEXT_ONE = re.compile(
    rf"\b(?P<n>two|three|four) (?:of )?(?:the|my|these|those) .*?(?P<rest>{_JOINT}(?:leave|let|"
    rf"keep) the (?P<nth>third|fourth|fifth)(?: one)? {_STILL}){_END}", re.IGNORECASE,
)  # fmt: skip
_FOLLOWING = {"two": "third", "three": "fourth", "four": "fifth"}
_EXCEPTED = re.compile(
    r"(?P<but>\b(?:not|except(?: for)?|apart from|bar|save) (?:the|that|this|my) [^,.;]*?)"
    rf"[,;]\s*(?:and |because )?(?:that|this|it|those|they|these)(?: ones?)? {_STAYS}{_END}",
    re.IGNORECASE,
)
"""What is left out of a group "has to stay": said already."""
_PARTLY = re.compile(rf"\b(?:{_COUNT}|half|some|an?|only|just)\b", re.IGNORECASE)
_AT_LEAST = re.compile(rf"\bat least (?={_COUNT} of )", re.IGNORECASE)
_OF_SO_MANY = re.compile(
    rf"\b(?P<part>{_COUNT}) of (?:the|my|these|those) (?P<whole>{_COUNT}) (?=\w+)", re.IGNORECASE
)
_STAYING = re.compile(
    r"^the (?P<which>(?:\w+ )?)(?P<noun>\w+) (?:stays?|remains?) (?:right |exactly |just )?"
    r"(?:put|where it is|in place|there|as it is)(?:, \w+)?\s*[;,.] (?:and |but )?"
    r"(?:all )?(?:the )?(?:other|rest of the|remaining) (?P<many>\w+)\b",
    re.IGNORECASE,
)
_SIDE = (
    r"(?:(?:to|on|at) (?:the|its) (?:left|right|back|front)(?:[ -]hand)?(?: side)?|left|right|"
    r"behind|in front|at the back|at the front)"
)
_ONE_AND_OTHER = re.compile(
    r"\b(?:(?:put|place|set|pop|stand|lay|stick|move|keep) )?(?:one|an?|1) "
    r"(?:of (?:the|my|these|those) (?:two )?)?(?P<noun>(?:\w+ )?\w+?) "
    rf"(?P<way>{_SIDE})(?: of)? (?P<mark>(?:the|my|that|this) (?:\w+ )?\w+)\s*(?:,|;| and|, and) "
    rf"the (?:other|second)(?: one| (?P=noun)| \w+)? (?P<far>{_SIDE})"
    r"(?: of (?:it|the \w+)| it)?(?: so (?:that )?it[^.;]*)?" + _END,
    re.IGNORECASE,
)
_ALL_BUT = re.compile(
    rf"\b(?:all|every one)(?: of)?(?: (?:the|my|these|those|them))?(?: \w+){{0,2}}?,? "
    rf"(?:but|except|bar|save)(?: for)? (?P<n>{_COUNT})\b(?! of the other)",
    re.IGNORECASE,
)
_BUT_SOME_OF = re.compile(
    r"\ball (?:but|except|bar|save)(?: for)? (?P<n>one) of (?P<det>the|my|these|those) "
    r"(?P<noun>(?:\w+ )?\w+s)\b(?P<rest>[^.,;!]*)",
    re.IGNORECASE,
)
_SPARING = (
    rf"(?:leave|leaving|forget(?:ting)?|spare|sparing|skip(?:ping)?|keep(?:ing)?)(?: about| out)? "
    rf"(?P<n>{_COUNT})(?: of (?:them|those|these))?(?: ones?)?(?: (?:behind|out|alone|aside|be|"
    r"untouched|there|where (?:they are|it is|they stand)))?"
)
_WHOLE = r"(?:all (?:of )?(?P<some>the |my |these |those )?|(?P<det>the |my |these |those ))"
_MANY = rf"(?:{_COUNT} )?(?P<noun>(?:\w+ )?\w+s)\b"
_SPARED = re.compile(
    rf"^(?P<lead>(?:.*?\b)??){_WHOLE}{_MANY}(?P<rest>[^.;:]*?),? (?:(?:but|and|only|just|while) )+"
    rf"{_SPARING}{_END}",
    re.IGNORECASE,
)
"""Some of a group is left where it is: "the pegs into the tin, but leave two behind"."""
_EXCLUDED = re.compile(
    rf"^(?P<lead>(?:.*?\b)??)(?:all (?:of )?)+(?P<det>the|my|these|those) (?:{_COUNT} )?"
    rf"(?P<noun>(?:\w+ )?\w+s)\b(?P<rest>[^,.;:]+?),? (?:excluding|except(?: for)?|save|bar|minus|"
    rf"apart from|but|leaving out) (?P<n>{_COUNT})(?: of (?:them|those|these))?"
    rf"(?:,? (?:you (?:choose|pick|decide)|whichever|your choice|any)\b[^.;]*)?{_END}",
    re.IGNORECASE,
)
"""So many are left out, said behind what becomes of the rest."""
_MEANWHILE = re.compile(
    rf"^(?:let|have|leave|keep) (?P<n>{_COUNT}) of (?P<det>the|my|these|those) "
    rf"(?P<noun>(?:\w+ )?\w+s)\b[^,.;:]*?,? (?:while|whilst|and|but) (?:all )?(?:the )?"
    r"(?:others|rest|other ones|remaining ones)(?: of them)?,? (?:(?:are|get|is|gets) "
    r"\w*(?:ed|put|laid|set)|go(?:es)?|belongs?|should go) "
    r"(?P<rest>(?:in|on|at|to|by|next|behind|under|beside|left|right)\w*\b[^.;:]*)",
    re.IGNORECASE,
)
_NOT_ALL = re.compile(
    r"^(?:not all (?:of )?)?(?P<det>the|my|these|those) (?P<noun>(?:\w+ )?\w+s)\s*[:;,.-]+ "
    rf"{_SPARING}\s*[,;] (?:and )?(?:put )?(?:the )?(?:rest|others)(?: of them)?,? "
    r"(?:go(?:es)? |belongs? |should go )?"
    r"(?P<rest>(?:in|on|at|to|by|next|behind|under|beside|left|right)\w*\b[^.;:]*)",
    re.IGNORECASE,
)
_HALF = re.compile(
    r"\bhalf (?:of )?(?:the|my|these|those|them)\b(?! (?:table|desk))", re.IGNORECASE
)
_OTHER_HALF = re.compile(r"\b(?:other|second) half\b|\b(?:rest|remaining)\b", re.IGNORECASE)
_THE_OTHER = re.compile(
    r"\b(?:one|an?) .*\bthe other(?: one)?,? (?:goes |go )?(?:to|on|in|into|onto|at|behind|left|"
    r"right|under|beside|next|near|by)\b",
    re.IGNORECASE,
)


_TOWERS = re.compile(
    rf"\b(?P<n>{_COUNT}) (?P<what>towers|stacks|piles|columns),? (?:each )?(?:with|of|from|made of|"
    rf"holding|containing) (?:exactly |just )?(?P<m>{_COUNT}) ",
    re.IGNORECASE,
)
_IN_EACH = re.compile(
    r"^,?(?: (?:in|to|on))?(?: (?:each|every one|apiece)(?: one)?(?: of (?:them|those))?| per \w+)?"
    r"(?=\s*(?:[.,;!?]|$))",
    re.IGNORECASE,
)


_REST_OF = re.compile(
    r"\b(?:all )?the (?:rest|remainder) of (?:all )?(?:the|these|those|my) "
    r"(?P<many>(?:\w+ )?\w+s)\b|"
    r"\b(?:all )?the remaining (?:ones|(?P<noun>(?!one\b)(?:\w+ )?\w+s))\b",
    re.IGNORECASE,
)
_GO = re.compile(
    r"(?: (?:all|both|now|please|should|must|shall|can|may|will|have to|has to|need to|are to|"
    r"is to))* (?:go|goes|come|comes|belong|belongs)(?: all| both| over| up| down| back| away|"
    r" and (?:stand|lie|sit|stay))* "
    r"(?=(?:to|in|into|on|onto|at|along|next|beside|left|right|behind)\b)",
    re.IGNORECASE,
)
_TWO_WAYS = re.compile(
    r"^(?!if\b|when\b|where\b|which\b|what\b)(?P<some>[^.;:!?]*?)(?:,| and| then| but| while)+ "
    r"(?P<rest>(?:all )?the (?:others?|rest)\b(?: [\w'-]+){0,4}? (?:to|in|into|on|onto|at|along|"
    r"next|beside|left|right|behind)\b[^.;:!?]*)(?P<end>[.!]*)$",
    re.IGNORECASE,
)


class Left(NamedTuple):
    """Just ``stay`` of the things remain as they are."""

    things: tuple[str, ...]
    stay: int


def without_the_rest(text: str) -> str:
    """The sentence without what it says of a rest that stays, where some are counted off."""
    text = _OF_SO_MANY.sub(_part_of, _AT_LEAST.sub("", text))
    text = _EXCLUDED.sub(r"\g<lead>all but \g<n> of \g<det> \g<noun>\g<rest>", text)
    text = _MEANWHILE.sub(r"put all but \g<n> of \g<det> \g<noun> \g<rest>", text)
    text = _NOT_ALL.sub(r"put all but \g<n> of \g<det> \g<noun> \g<rest>", text)
    text = _SPARED.sub(_spared, text)
    text = _BUT_SOME_OF.sub(r"\g<det> \g<noun>\g<rest>, all but \g<n>", text)
    text = _STAYING.sub(_all_but_it, text)
    text = _ONE_AND_OTHER.sub(_on_two_sides, text)
    text = _EXCEPTED.sub(r"\g<but>", text)
    after = _NEXT_ONE.search(text)
    if after is not None and _FOLLOWING[after["n"].lower()] == after["nth"].lower():
        return text[: after.start("rest")] + text[after.end("rest") :]
    for left_over in _LEFT_OVER:
        said = left_over.search(text)
        if said is not None and _PARTLY.search(text[: said.start()]):
            return text[: said.start()].rstrip() + text[said.end() :]
    return _two_ways(text)


def _two_ways(text: str) -> str:
    """ "Three discs belong in the corner, the remaining ones go to the left": without the verbs."""
    text = _REST_OF.sub(_others, text)
    parts = _TWO_WAYS.match(text)
    if parts is None or not (_GO.search(parts["some"]) or _GO.search(parts["rest"])):
        return text
    some, rest = _GO.sub(" ", parts["some"], count=1), _GO.sub(" ", parts["rest"], count=1)
    return f"{some}, {rest}{parts['end']}"


def _others(said: re.Match[str]) -> str:
    """ "The rest of the cubes", once some were told of: the other cubes."""
    if not _PARTLY.search(said.string[: said.start()]):
        return said.group()
    noun = said["many"] or said["noun"]
    return f"the other {noun}" if noun else "the others"


def _spared(said: re.Match[str]) -> str:
    """ "All the pegs into the tin, but leave two": all but two of the pegs."""
    of = (said["some"] or said["det"] or "the ").strip()
    return f"{said['lead']}all but {said['n']} of {of} {said['noun']}{said['rest']}"


def _part_of(said: re.Match[str]) -> str:
    """ "Three of the five pegs": three of the pegs."""
    part, whole = number(said["part"].lower()), number(said["whole"].lower())
    fits = part is not None and whole is not None and part < whole
    return f"{said['part']} of the " if fits else said.group()


def _all_but_it(said: re.Match[str]) -> str:
    """ "The red cup stays put; the other cups": all the cups except the red cup."""
    if singular(said["many"].lower()) != singular(said["noun"].lower()):
        return said.group()
    return f"all the {said['many']} except the {said['which']}{said['noun']}"


def _on_two_sides(said: re.Match[str]) -> str:
    """ "One cup left of the lamp, the other right of it": the group about the lamp."""
    *before, noun = said["noun"].split(" ")
    named = " ".join((*before, plural(singular(noun))))
    sides = [next(side for side in _SIDES if side in said[end].lower()) for end in ("way", "far")]
    one, other = (_SIDES[side] for side in sides)
    if one == other:
        return said.group()
    return f"the {named}: one {one} of {said['mark']}, one {other}"


_SIDES = {"left": "to the left", "right": "to the right", "behind": "at the back",
          "back": "at the back", "front": "at the front"}  # fmt: skip


def left(linked: Linked, binding: Mapping[str, tuple[str, ...]]) -> tuple[Left, ...]:
    """How many of a group must stay; nothing where the sentence does not say so."""
    themes = [one for one in linked.spoken if one.theme and one.mention.objects]
    if not themes:
        return ()
    named = [one for one in themes if one.phrase is not None and one.phrase.head] or themes
    kinds = max((one.mention.objects for one in named), key=len)
    but = _ALL_BUT.search(linked.text)
    count = number(but["n"].lower()) if but is not None else None
    if _HALF.search(linked.text) and not _OTHER_HALF.search(linked.text):
        count = len(kinds) // 2
    if count is not None and len(kinds) > count:
        return (Left(kinds, int(count)),)
    if _THE_OTHER.search(linked.text) and len(linked.slots) == 2 and len(kinds) == 2:
        return (Left(kinds, 0),)
    return ()


def half_counted(linked: Linked) -> str | None:
    """ "Half of the nuts" of six as "three of the nuts"; None where halves go two ways."""
    said = _HALF.search(linked.text)
    if said is None or _OTHER_HALF.search(linked.text):
        return None
    of = next((one for one in linked.spoken if one.mention.start >= said.start()), None)
    if of is None or not of.mention.plural or len(of.mention.objects) % 2:
        return None
    part = number_word(len(of.mention.objects) // 2)
    return f"{linked.text[: said.start()]}{part} of the{linked.text[said.end() :]}"


def towers_counted(linked: Linked) -> str | None:
    """ "Two towers with two blocks in each" of four: two stacks of the blocks; None where the
    numbers do not come out."""
    said = _TOWERS.search(linked.text)
    of = next(
        (one for one in linked.spoken if said is not None and said.start("m") <= one.mention.start
         <= said.end()), None,
    )  # fmt: skip
    if said is None or of is None or of.phrase is None or not of.phrase.head:
        return None
    many, each = number(said["n"].lower()), number(said["m"].lower())
    rest = linked.text[of.mention.end :]
    tail = _IN_EACH.match(rest)
    if many is None or each is None or tail is None or many * each != len(of.mention.objects):
        return None
    named = " ".join((*of.phrase.modifiers, *of.phrase.head))
    return f"{linked.text[: said.start()]}{said['n']} stacks of the {named}{rest[tail.end() :]}"


def left_so(goal: Left, before: Scene, after: Scene) -> bool:
    """Whether just so many of the things stay."""
    ends = {item.id: item for item in after}
    still = [o for o in goal.things if o in ends and moved(before.get(o), ends[o]) == 0]
    return len(still) == goal.stay

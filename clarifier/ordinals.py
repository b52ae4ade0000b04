"""How people count things off: "counting from the right, the third screw", "the last but one",
"screw number two from the left". All are put as "the third screw from the right".

Only where the side is said apart from what it counts, and there is one thing that it can count.
"""

from __future__ import annotations

import re

from clarifier.lexicon import Lexicon
from clarifier.words import singular

_NTH = r"(?:first|second|third|fourth|fifth|sixth|last)"
_NUMBERS = {"one": "first", "two": "second", "three": "third", "four": "fourth", "five": "fifth",
            "1": "first", "2": "second", "3": "third", "4": "fourth", "5": "fifth"}  # fmt: skip
_SIDE = r"(?P<side>left|right|front|back)(?:[ -]?hand)?(?: (?:side|end|edge))?"
_OPPOSITE = {"left": "right", "right": "left", "front": "back", "back": "front"}
_COUNTING = (
    r"(?:(?:if|when|as|and) (?:you |i |we )?)?(?:count|start|begin|go|read|number|reckon|look|see)"
    r"(?:ed|ing|ting|ning|n)?"
)
_FROM = rf"{_COUNTING}(?: (?:off|them|along|again|it|out))* from (?:the |my )?{_SIDE}"
_BEHIND = re.compile(
    rf"(?P<what>\b{_NTH}(?: \w+){{1,3}}?|\b{_NTH}),? (?:{_FROM}|"
    rf"from {_SIDE.replace('side>', 'bare>')})"
    r"(?! of\b)(?! to (?:left|right|front|back)\b)",
    re.IGNORECASE,
)
_BEFORE = re.compile(
    rf"^(?P<lead>(?:(?:please|now|and|so|ok|okay|right|then)[\s,]+)*){_FROM}"
    r"(?P<joint>\s*[,;:.]\s*|\s+(?:and |then )?)(?:(?:and|then|please)[\s,]+)*(?P<rest>.+)$",
    re.IGNORECASE,
)
_COUNTED = re.compile(
    rf"\b(?P<det>the |my |that )?(?P<nth>{_NTH})\b(?=(?P<more>(?: \w+)*))", re.IGNORECASE
)
_LAST_BUT = re.compile(
    r"\b(?P<det>the |my )?(?:(?:last|end) but (?P<n>one|two)|(?P<m>second|third)[ -]"
    r"(?:(?:to|from|from the) )?last|next[ -]to[ -](?:the )?last|penultimate)(?P<of> one| \w+)"
    r"(?: from (?:the )?(?P<side>left|right|front|back))?\b",
    re.IGNORECASE,
)
_NTH_BEHIND = re.compile(
    rf"^(?:please,? )?(?:the )?(?P<noun>\w+) (?P<nth>{_NTH}) from (?:the )?{_SIDE}"
    r"(?= (?:should|goes|belongs|must|needs|is to|has to|gets|put|place|take|please|lift|"
    r"move)\b|, )",
    re.IGNORECASE,
)
_NUMBERED = re.compile(
    rf"\b(?:the )?(?P<noun>\w+) (?:number|no\.?|nr\.?) (?P<n>{'|'.join(_NUMBERS)}) from "
    rf"(?:the )?{_SIDE}",
    re.IGNORECASE,
)
_BARE = re.compile(
    r"(?<!\bthe )(?<!\bmy )(?<!\bthese )(?<!\bthose )(?<!\byour )\b(?P<many>(?:first|last|leftmost|"
    r"rightmost|middle|outer) (?:two|three|four|five|[2-5]) (?=\w+s\b))",
    re.IGNORECASE,
)
"""So many off an end, without an article: "last two parcels"."""
_ALONE = re.compile(
    rf"\b(?:the )?(?P<noun>\w+) (?:number|no\.?|nr\.?) (?P<n>{'|'.join(_NUMBERS)})\b",
    re.IGNORECASE,
)
_AT_THE_END = re.compile(
    rf"\b(?:right |just )?(?:at|on) the (?:very |extreme )?end,? (?:(?:on|at|"
    rf"to) )?(?:the |my )?{_SIDE}"
    r"(?! of\b)",
    re.IGNORECASE,
)
_END_ONE = re.compile(
    rf"\bthe end (?P<noun>\w+) (?:on|at|to) (?:the |my )?{_SIDE}(?! of\b)", re.IGNORECASE
)
_ALONG = re.compile(
    rf"\b(?P<nth>{_NTH}(?: \w+)?) (?:along|in|over|across) from(?= (?:the |my )?{_SIDE})",
    re.IGNORECASE,
)
_THE_NTH_OF = re.compile(
    rf"\b(?P<nth>{_NTH}) of (?:the|these|those|my|your|our) (?P<many>\w+s)\b", re.IGNORECASE
)
_NUMBER = rf"number (?:{'|'.join(_NUMBERS)})"
_COUNTED_OFF = re.compile(
    r"^(?P<lead>(?:(?:please|now|and|so|ok|okay|right|then)[\s,]+)*)"
    r"(?:(?:if|when|as) (?:you|i|we) )?count(?:ing|ed)?(?: (?:all|off|up))? "
    r"(?:(?:all|off|the|these|those|your|my|our) )*"
    rf"(?P<noun>(?!(?:from|the|off)\b)\w+)(?: off)? from (?:the |my )?{_SIDE}[\s,;:.]+"
    rf"(?P<between>(?:[^,;.]*? )??)(?P<nth>(?:the )?{_NTH}(?: one| (?P=noun))?|(?:the )?{_NUMBER})"
    r"(?! \w+ from)(?P<rest>\b.*)$",
    re.IGNORECASE,
)
_CLEFT = re.compile(
    r"^(?P<what>[^,;.]+?) is (?:the one |the thing |what |which )?(?:that |which )?(?:i|we) "
    r"(?:want|need|wish|would like|'d like)(?: you)? to (?P<verb>\w+) (?P<rest>.+)$",
    re.IGNORECASE,
)
_STOPS = frozenset(
    {"and", "then", "please", "from", "on", "in", "into", "to", "onto", "goes", "is"}
)


def counted_from_a_side(text: str, lexicon: Lexicon) -> str:
    """The sentence with the side right behind what is counted from it."""
    text = _BARE.sub(r"the \g<many>", text)
    text = _AT_THE_END.sub(
        r"at the \g<side> end", _END_ONE.sub(r"the \g<noun> at the \g<side> end", text)
    )
    text = _ALONG.sub(r"\g<nth> from", text)
    text = _NUMBERED.sub(
        lambda said: f"the {_NUMBERS[said['n'].lower()]} {said['noun']} from the {said['side']}",
        text,
    )
    text = _LAST_BUT.sub(_from_the_end, text)
    text = _NTH_BEHIND.sub(lambda said: _in_front(said, lexicon), text)
    text = _THE_NTH_OF.sub(lambda said: f"{said['nth']} {singular(said['many'].lower())}", text)
    text = _COUNTED_OFF.sub(lambda said: _counted_off(said, lexicon), text)
    text = _BEHIND.sub(_right_behind, text)
    before = _BEFORE.match(text)
    return text if before is None else _with_side(before, lexicon) or text


def _counted_off(said: re.Match[str], lexicon: Lexicon) -> str:
    """ "If you count the screws from the left, number two goes in the jar": the second screw from
    the left goes in the jar."""
    nth = said["nth"].lower().split()
    rank = _NUMBERS[nth[-1]] if "number" in nth else nth[nth[0] == "the"]
    noun, between = singular(said["noun"].lower()), said["between"]
    if between and lexicon.verb(between.split()[-1].lower()) is None:
        joined = re.fullmatch(r"(?:(?:and|then|please|so|now) )+", between, re.IGNORECASE)
        if joined is None:
            return said.group()
        between = ""
    plain = f"the {rank} {noun} from the {said['side'].lower()}{said['rest']}"
    wanted = _CLEFT.match(plain) if not between else None
    if wanted is not None and lexicon.verb(wanted["verb"].lower()) is not None:
        plain = f"{wanted['verb']} {wanted['what']} {wanted['rest']}"
    return f"{said['lead']}{between}{plain}"


def _right_behind(said: re.Match[str]) -> str:
    """ "First screw counted from the right": the first one from there, and no "first, ..."."""
    side = (said["side"] or said["bare"]).lower()
    return f"{'' if said.start() else 'the '}{said['what']} from the {side}"


def _in_front(said: re.Match[str], lexicon: Lexicon) -> str:
    """ "Screw second from the left, lift it": the second screw from the left."""
    if lexicon.verb(said["noun"].lower()) is not None and not lexicon.is_noun(said["noun"].lower()):
        return said.group()
    return f"the {said['nth']} {said['noun']} from the {said['side']}"


def _from_the_end(said: re.Match[str]) -> str:
    """ "The last but one screw from the left" is the second from the right."""
    nth = {"two": "third", "third": "third"}.get((said["n"] or said["m"] or "").lower(), "second")
    side = _OPPOSITE[(said["side"] or "left").lower()]
    return f"{said['det'] or 'the '}{nth}{said['of']} from the {side}"


def _with_side(before: re.Match[str], lexicon: Lexicon) -> str | None:
    """ "Counting from the right, lift the third screw"; None where more than one is counted."""
    rest = _ALONE.sub(
        lambda said: f"the {_NUMBERS[said['n'].lower()]} {said['noun']}", before["rest"]
    )
    counted = list(_COUNTED.finditer(rest))
    if len(counted) != 1 or re.search(r"\bfrom (?:the )?(?:left|right|front|back)\b", rest):
        return None
    found = counted[0]
    end = found.end("nth") + _noun_length(found["more"], lexicon)
    det = "" if found["det"] or (found.start() and rest[found.start() - 1].isalnum()) else "the "
    named = f"{det}{rest[found.start() : end]} from the {before['side'].lower()}"
    return f"{before['lead']}{rest[: found.start()]}{named}{rest[end:]}"


def _noun_length(more: str, lexicon: Lexicon) -> int:
    """Characters of the words behind an ordinal that belong to what it counts."""
    length, noun = 0, ""
    for word in re.findall(r" \w+", more)[:3]:
        plain = word.strip().lower()
        compound = lexicon.is_noun(f"{noun} {singular(plain)}")
        if plain in _STOPS or (noun and not compound):
            break
        length += len(word)
        if plain in ("one", "ones"):
            break
        noun = plain if lexicon.is_noun(plain) or lexicon.is_noun(singular(plain)) else ""
    return length

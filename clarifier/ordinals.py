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
    text = _BEHIND.sub(_right_behind, text)
    before = _BEFORE.match(text)
    return text if before is None else _with_side(before, lexicon) or text


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
    length = 0
    for word in re.findall(r" \w+", more)[:3]:
        plain = word.strip().lower()
        if plain in _STOPS:
            break
        length += len(word)
        if plain in ("one", "ones") or lexicon.is_noun(plain) or lexicon.is_noun(singular(plain)):
            break
    return length

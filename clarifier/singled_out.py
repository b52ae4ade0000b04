"""Turns of phrase that single one thing out: "tell me which one it is by pointing", "whichever of
the mugs is the tallest". They are put into words that name it, or point at it.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from clarifier.words import singular

_Plain = str | Callable[[re.Match[str]], str]

_TELL = (
    r"^(?:(?:can|could|would|will) you |please |kindly )*(?:tell|show|let) (?:me|us|them|"
    r"the \w+)(?: know)?"
)
_WHICH = r"which (?:one |thing |of (?:them|these|those) )?(?:'s|is)"
_BY = (
    r"by (?:pointing|touching|tapping)(?: out| at| to| on)?(?: it)?|with (?:a|your) "
    r"(?:tap|touch|finger)"
)
_ONE = r"((?:the|my|it)\b[^,.;?]*?)"
_POINTING: tuple[tuple[str, str], ...] = (
    # "tell me which one is the mug by pointing, and then which is the lamp"
    (
        rf"{_TELL} {_WHICH} {_ONE} (?:{_BY}),?(?: and)?(?: then)? {_WHICH} {_ONE}(?=[.!?]*$)",
        r"point at \1 and then point at \2",
    ),
    (rf"{_TELL} {_WHICH} {_ONE} (?:{_BY})(?=\W*$|\s*[,.;])", r"point at \1"),
    (rf"{_TELL} (?:{_BY}),? {_WHICH} {_ONE}(?=[.!?]*$)", r"point at \1"),
    (rf"(?:{_BY}),? (?:tell|show) (?:me|us) {_WHICH} {_ONE}(?=[.!?]*$)", r"point at \1"),
    (rf"\bpoint out {_WHICH} {_ONE}(?=[.!?]*$)", r"point at \1"),
)
_MANY = (
    r"whichever of (?:all (?:of )?)?(?:the |these |those |my )?"
    r"((?!(?:left|right|other|first|last) )(?:\w+ ){0,3}?\w+s)(?: that)? "
)
_SUPERLATIVE = (
    r"(?!near|clos|far|furth|b?est\b|re?st\b|l?east\b|other\b|either\b|under\b|over\b)"
    r"\w+(?:est|most|er)(?! than\b)"
)
_ENDS = (
    r"(?=\W*$|\s*[,.;:]| (?:and|on|in|to|over|off|onto|into|from|next|beside|by|behind|up|with|"
    r"please|goes|should|must|belongs|gets|then)\b)"
)
_MOST = r"(?:most|greatest|largest|biggest|highest|longest)"
_LEAST = r"(?:least|smallest|lowest|shortest)"
_MEASURES = {"height": ("tallest", "shortest"), "width": ("widest", "narrowest"),
             "length": ("longest", "shortest"), "size": ("biggest", "smallest"),
             "girth": ("thickest", "thinnest"), "thickness": ("thickest", "thinnest")}  # fmt: skip
_MEASURED = rf"(?P<how>{_MOST}|{_LEAST}) (?P<what>{'|'.join(_MEASURES)})\b"


def _by_measure(said: re.Match[str]) -> str:
    """ "The candle with the least height": the shortest candle."""
    least = re.fullmatch(_LEAST, said["how"], re.IGNORECASE) is not None
    word = _MEASURES[said["what"].lower()][least]
    many = said.groupdict().get("many")
    return f"the {word} of the {many}" if many else f"the {word} {said['noun']}"


def _whatever(said: re.Match[str]) -> str:
    """ "Whichever thing in the box is the tallest": the tallest thing in the box."""
    where = said["where"] or ""
    where = "" if re.search(r"\b(?:table|desk|here|there)\b", where) else where
    noun = said["noun"] or said["named"] or "thing"
    return f"the {said['how'].lower()} {noun}{where}"


_WHEREABOUTS = r"(?: (?:that's |that is )?(?:on|in|here|there)\b(?: (?:the|my|that) \w+)?)"
_COPULA = r"(?:'s| is| stands| lies| sits| looks| turns out to be| happens to be)"
_WHICHEVER: tuple[tuple[str, _Plain], ...] = (
    # "whichever of the mugs is the tallest", "whichever of the mugs has the least height"
    (
        rf"\b{_MANY}(?:is|are|looks|turns out to be) (?:the )?((?!near|far|clos|"
        rf"furth)\w+(?:est|er))(?! than\b)"
        r"(?: one)?(?: of (?:them|all|them all))?(?=\W*$|\s*[,.;]| (?:and|on|in|to|over|off|"
        r"goes|next|should|must|belongs|gets|please|by|up|with)\b)",
        r"the \2 of the \1",
    ),
    (rf"\b{_MANY.replace('((?!', '(?P<many>(?!')}has the {_MEASURED}", _by_measure),
    (
        rf"(?:\bthe |^)(?P<noun>\w+) (?:with|of|that has|which has|having) (?:the )?{_MEASURED}",
        _by_measure,
    ),
    # "whatever is the tallest", "whichever thing on the table is the tallest"
    (
        rf"\b(?:whatever(?: (?P<noun>\w+))?|whichever (?P<named>\w+))"
        rf"(?P<where>{_WHEREABOUTS})?{_COPULA}(?: the)? (?P<how>{_SUPERLATIVE})"
        rf"(?: one| thing| object)?(?: of (?:them all|all|them))?{_ENDS}",
        _whatever,
    ),
    # "whatever's closest to the lamp", "whatever on the table is nearest to me"
    (
        rf"\b(?:whatever|anything)(?: (?P<noun>thing|object|item))?(?:{_WHEREABOUTS})?{_COPULA}"
        r"(?: the| most)? (?=(?:near|clos|far|furth)\w*\b)",
        "the thing ",
    ),
    (
        rf"^what{_COPULA} (?:the )?(?P<how>(?:near|clos|far|"
        rf"furth)\w*[^,.;:?]*)[,?.;:] (?P<deed>[^,.;]*?) "
        r"(?:that|it|this)(?: one| thing)?\b",
        r"\g<deed> the thing \g<how>",
    ),
)


def _odd_in_colour(said: re.Match[str]) -> str:
    """ "The coin of a different colour", where nothing is handed out by colours."""
    handed = re.search(r"\b(?:each|every|all|both)\b", said.string[: said.start()], re.IGNORECASE)
    return said.group() if handed else f"the odd {said[1]}"


_ODD: tuple[tuple[str, _Plain], ...] = (
    (
        r"\bthe odd (?:one|man) out(?: of| among(?:st)?) (?:the|these|those|all(?: the)?) (\w+)\b",
        lambda said: f"the odd {singular(said[1])}",
    ),
    (r"(?:\bthe |^)odd (\w+) out\b", r"the odd \1"),
    (
        r"\bthe (?:only )?(?:differently colou?red|other[- ]colou?red|"
        r"different[- ]colou?red) (\w+)\b",
        r"the odd \1",
    ),
    (
        r"\b(?:the|that) (?:only |single )?((?!\w+s\b)\w+) (?:(?:that|which)(?:'s| is| has| does)|"
        r"of|with|in) "
        r"(?:(?:not|n't) (?:of |in |have |match )?(?:the )?same colou?r as|not match(?:ing)?|"
        r"(?:a different|another) colou?r(?: (?:from|than|to))?)"
        r"(?: (?:all )?(?:the )?(?:others?|rest|other (?:ones?|\w+))(?: of them)?)?"
        rf"{_ENDS}",
        _odd_in_colour,
    ),
)
_WHERE = r"(?:on top of|on|onto|in|into|inside|next to|beside|by|behind|in front of)"
_INSTEAD: tuple[tuple[str, str], ...] = (
    # "don't put the mug on the lamp, put it on the saucer"
    (
        rf"^(?:please,? )?(?:don't|do not|dont|never) (put|place|set|lay|stand|stick) "
        rf"((?:the|my|that)\b[^,.;]*?) {_WHERE} (?:the|my|that|any|an?|one of|either)\b"
        r"[^,.;]*[,;.] "
        rf"(?:but |rather |instead |just |please )*\1 it (?={_WHERE}\b)",
        r"\1 \2 ",
    ),
)
_GROUP = (
    r"(?:the|these|those|my)(?: (?:two|three|four|five|six|seven|eight))? (?P<noun>(?:\w+ )?\w+s)"
    r"(?: (?:there|here|on the table|that (?:i have|we have|are there)))?"
)


def _out_of(said: re.Match[str]) -> str:
    """The one that is told of the group, with the group's noun."""
    several = said["many"] or (said["one"] or "").strip() == "ones"
    noun = said["noun"] if several else _one_of(said["noun"])
    return f"{said['deed']} the {said['many'] or ''}{said['which']} {noun}".strip()


def _one_of(noun: str) -> str:
    first, _, last = noun.rpartition(" ")
    return f"{first} {singular(last.lower())}".strip()


_OUT_OF: tuple[tuple[str, _Plain], ...] = (
    # "of the three buttons, put the middle one in the bowl"
    (
        rf"^(?:please,? )?(?:out of|of|from|among(?:st)?|"
        rf"from among)(?: all)?(?: of)? {_GROUP}\s*[,:;]?"
        r" (?:please |kindly |you )?(?P<deed>\w+(?: up)?|(?:i|we)(?: want|'d like| would like)) "
        r"the "
        r"(?P<many>(?:two|three|four) )?(?P<which>(?!one\b|other\b|others\b|rest\b|"
        r"same\b)(?:(?:second|third|fourth|very|most) )?\w+?)"
        r"(?P<one> ones?)?(?= (?:and|on|in|into|onto|to|off|from|next|behind|beside|over|"
        r"by|please|up)\b"
        r"|\s*[.,;!]|\s*$)",
        _out_of,
    ),
    # "of the three vials, the tallest goes on the rack"
    (
        rf"^(?P<deed>)(?:out of|of|from|among(?:st)?)(?: all)?(?: of)? {_GROUP}\s*[,:;] the "
        r"(?P<many>(?:two|three|four) )?(?P<which>(?!one\b|others?\b|rest\b|same\b)\w+)"
        r"(?P<one> ones?)?(?= (?:goes?|should|must|belongs?|has|have|is|are|needs?)\b)",
        _out_of,
    ),
)
_PLAIN_SIZES: tuple[tuple[str, _Plain], ...] = (
    # "the right-most of those pegs"
    (
        r"\bthe (?P<most>(?:left|right)[ -]?most)(?: one)? (?:of|out of|among) (?:all )?(?:the|"
        r"these|those|my)(?: (?:two|three|four|five|six))? (?P<noun>(?:\w+ )?\w+s)"
        r"(?=\W*$|\s*[,.;:]| (?:can|may|goes|should|must|shall|and|on|in|into|onto|to|off|next|"
        r"behind|beside|over|by|please|up|is|there)\b)",
        lambda said: (
            f"the {said['most'].replace('-', '').replace(' ', '')} {_one_of(said['noun'])}"
        ),
    ),
    (
        r"\b(medium|mid|middling|middle)[- ](?:sized?|height|length|width|tall|long|wide)\b",
        "medium",
    ),
    (
        r"\b(left|right|fore|rear|back|hind|front|top|bottom|upper|outer|inner|near|far)[ -]most\b"
        r"(?! (?:of|to|from|near|far|close|distant|left|right)\b)",
        r"\1most",
    ),
    (r"\b(?<=at )(?:the two|both(?: the)?|either|the opposite) ends?\b(?! of\b)", "the ends"),
    (r"\b(the|both|both the) (two )?end (?=(?!ones\b)\w+s\b)", r"\1 \2outer "),
    (
        r"\b(left|right)[ -]?hand (?=(?!side|corner|edge|end|half|of\b|part|one\W*$)\w)",
        r"\1 ",
    ),
    # "two of them, whichever you like", "any two, I don't mind which"
    (
        r"(?:\s*[,;.-]+\s*(?:and |but )?(?:(?:it|that)(?: really)? doesn't matter which|"
        r"(?:i|we) don't (?:care|mind)(?: which)?|no matter which|whichever|"
        r"any(?: one| two| three| four)?)(?: ones?| of them)?| whichever(?: ones?)?(?= you))"
        r"(?: you (?:like|want|fancy|choose|pick|prefer|please))?"
        r"(?=\s*[.!]*$)",
        "",
    ),
    (r"\b(the|my) most (left|right)(?= (?!side|end|edge|corner|half|hand|of\b)\w)", r"\1 \2most"),
)
SINGLED_OUT = (*_PLAIN_SIZES, *_POINTING, *_WHICHEVER, *_ODD, *_OUT_OF, *_INSTEAD)
"""Patterns and what each is put as."""

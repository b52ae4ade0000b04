"""How points, and shares of a way, are said: "halfway from the middle to the left edge", "a third
of the way in from the left along the near edge", over a sentence's frame (`clarifier.frame`). What
they come to is `part_way`'s.
"""

from __future__ import annotations

import re

SIDES = {
    "left": (-1, 0), "right": (1, 0), "far": (0, 1), "back": (0, 1), "top": (0, 1), "upper": (0, 1),
    "rear": (0, 1), "near": (0, -1), "front": (0, -1), "bottom": (0, -1), "lower": (0, -1),
    "nearest": (0, -1), "closest": (0, -1), "farthest": (0, 1), "furthest": (0, 1),
}  # fmt: skip
_SIDE = rf"(?:{'|'.join(SIDES)})"
_TABLE = r"(?: of (?:the|my|this) (?:table|desk|board|tabletop))?"
_MIDDLE = (
    r"(?:the |my )?(?:table(?: 's|'s)? |very |exact |dead )*(?:middle|centre|center|midpoint)"
    + _TABLE
)
_EDGE = rf"(?:the |my )?{_SIDE}(?:[- ]?hand)?(?: (?:edge|side|border|rim|end))?{_TABLE}"
_CORNER = rf"(?:the |my )?{_SIDE}[ -]{_SIDE}(?:[- ]?hand)?(?: corner)?{_TABLE}"
_THERE = rf"(?:{_MIDDLE}|{_CORNER}|{_EDGE}|#\d+)"
_TO = r"(?:(?:out|in|over|up|down|across|back) )*(?:to|towards?|up to|closer to|nearer to)"
PARTS = {
    "half": 2, "third": 3, "thirds": 3, "quarter": 4, "quarters": 4, "fourth": 4, "fourths": 4,
    "fifth": 5, "fifths": 5, "tenth": 10, "tenths": 10, "halfway": 2, "midway": 2,
}  # fmt: skip
HALVES = ("half", "halfway", "midway")
HOW_MANY = {"a": 1, "an": 1, "one": 1, "two": 2, "three": 3, "four": 4, "1": 1, "2": 2, "3": 3}
_WAY = r"(?:of )?(?:the |its |their |this |that )?(?:whole )?(?:way|distance|stretch|path)"
_OF_WIDTH = (
    r"(?:of )?(?:the |its )?(?:whole )?(?:(?:table|board|desk)(?: 's|'s)? )?(?:width|depth|length|"
    rf"breadth|height|way|distance|table){_TABLE}"
)
_NUMBER = rf"(?:(?P<many>{'|'.join(HOW_MANY)}) )?(?P<part>{'|'.join(PARTS)})"
_SHARE = (
    rf"(?:only |just |about |exactly |roughly |by )*{_NUMBER}(?:[ -]?way)?(?: {_WAY})?(?: there)?"
)
_BIT = (
    r"(?P<bit>(?:(?:just|only|about|by|very) )*(?:(?:a|one) )?"
    r"(?:(?:little|tiny|small|wee|slight) )*(?:bit|little|tad|touch|nudge|step|slightly)|slightly)"
)
_FAR = (
    r"(?P<far>(?:by |just |about |exactly )*[\d.,/]+ ?"
    r"(?:cm|mm|centimet\w+|millimet\w+|inch\w*))"
)
_FROM_EDGE = (
    rf"(?:at |by )?{_NUMBER} {_OF_WIDTH}"
    r"(?: (?:in|along|across|up|down|over|away|inwards?|measured))*"
    rf"(?P<along> (?:the |my )?{_SIDE} (?:edge|side))? from {_EDGE}"
)
_ALONG = (
    r"(?:along|at|on|to|by|against) (?:(?:the )?(?:edge|side) (?:that is )?"
    rf"(?P<me>nearest|closest|next) (?:to|by) me|{_EDGE})"
)
_GO = (
    r"(?:(?:(?:should|must|shall|is to|are to|has to|have to|can|may) )?"
    r"(?:be|takes?|goes|go|moves?|walks?|comes?|makes?|lie|stand|sit|end up) )?"
)
_POINT = (
    r"(?:(?:over )?(?:to|at|on|in) )?(?:(?:a|the) (?:point|spot|place) (?:that is |which is )?)?"
)
_MOVER = r"(?P<mover>#\d+(?:(?: ,| and| , and) #\d+)*)"
EACH_OTHER = r"(?:each other|one another|(?:closer|nearer) together)"
_HITHER = rf"(?:{_MIDDLE}|{_CORNER}|each other|one another|#\d+)"
FORMS = tuple(re.compile(form) for form in (
    rf"{_MOVER} {_GO}{_POINT}{_SHARE}"
    rf"(?: across| along| out| in| over)* (?:from|between) (?P<start>{_THERE}) (?:{_TO}|and) "
    rf"(?P<goal>{_THERE})",
    rf"{_MOVER} {_GO}{_SHARE} {_TO} (?P<goal>{_THERE})",
    rf"{_MOVER} {_GO}{_BIT} {_TO} (?P<goal>{_HITHER}) , {_FAR}",
    rf"{_MOVER} {_GO}(?:{_BIT}|{_FAR}) {_TO} (?P<goal>{_HITHER})",
    rf"{_MOVER} {_GO}{_TO} (?P<goal>{_HITHER}) (?:{_BIT}|(?:, )?{_FAR})",
    rf"{_MOVER} {_GO}(?:{_BIT} |{_FAR} )?(?P<goal>(?:closer|nearer) together)",
    # "the train drives up to the tower, but stop it 5 cm short"
    rf"{_MOVER} (?:\w+ )?{_TO} (?P<goal>#\d+)(?: ,)?(?: but| and)? "
    rf"(?:stop|stops|stopping|halt|leave|leaving)(?: @\d+)? {_FAR} (?P<short>short|before|away|off)"
    r"(?: (?:of|from))?(?: @\d+)?",
    # "the car is miles away from the lorry, so drive it over, but only half the way there"
    rf"(?P<mover>#\d+) (?:is|stands|lies)(?: \w+){{0,3}} from (?P<goal>#\d+) , so \w+ @\d+ "
    rf"(?:over |there )?(?:, )?(?:but )?{_SHARE}",
))  # fmt: skip
AIM = re.compile(_FROM_EDGE)
RIM = re.compile(_ALONG)
NAMED = re.compile(r"#\d+")
IDLE = re.compile(
    r"\b(?:(?:on|in|along) (?:the|a) straight line|so that @\d+ (?:is|lies|stands|sits|ends up)|"
    r"that is where @?\d* ?(?:i should like to have|i want|i would like|i'd like|goes)|"
    r"not right up to [@#]\d+|mind|no further|not all the way|its distance to me (?:remains|stays) "
    r"(?:unchanged|the same|as it is)|each(?! other)|"
    r"(?:he|she|it|that) (?:goes|belongs)|goes|belongs|please)(?= |$)"
)
"""What changes nothing of where something ends."""
A_SHARE = re.compile(r"\b(?:one|1) (half|third|quarter|fourth|fifth|tenth)(?= of\b)", re.IGNORECASE)
STANDS = re.compile(
    rf" (?:(?:up|down|over|out|back) )*(?:there )?(?:on|at|in) (?:the|my) (?P<side>{_SIDE})"
    r"(?:[- ]?hand)?(?: side| edge| end| part)?(?= |$)"
)
"""Where a landmark stands, said behind it."""

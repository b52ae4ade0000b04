"""One of several that are listed one by one, and by what it is told: "compare the cup with the mug
and take the taller one", "tap the cup or the mug, the smaller one". They are put as "the taller of
the cup and the mug", in words that the translator has learned.
"""

from __future__ import annotations

import re
from collections.abc import Callable

_MEASURED = (
    r"(?:(?!near|clos|far|furth|next|best|rest|honest|modest)\w+(?:est|most)|bigger|smaller|larger|"
    r"taller|shorter|wider|narrower|thinner|thicker|longer|higher|lower|broader)"
)
"""What tells a thing from those beside it, without a landmark."""
_PLAIN = {"big": "biggest", "small": "smallest", "large": "largest", "tall": "tallest",
          "short": "shortest", "wide": "widest", "narrow": "narrowest", "thin": "thinnest",
          "thick": "thickest", "little": "smallest"}  # fmt: skip
_OF_THEM = r"(?: of (?:them|these|those|both|the (?:two|three|lot)))?"
_POLITE = r"(?:please|kindly|now|just|then|can you|could you|would you|will you)"
_TAKES = (
    r"(?:touch|tap|poke|pat|prod|take|grab|get|lift|lift up|pick up|pick|raise|grasp|hold|"
    r"point (?:at|to)|knock over|tip over|topple|turn|spin|rotate)"
)
"""Verbs that need no place: what stands behind them is what they act on."""
_ONE = r"(?:the|my|that|this|it|one of|an?|any|either)\b[^.;:?!]*?"
_ITEM = r"(?:the|my|that|this|it|an?)\b[^.;:?!,]*"
_THE = r"(?:the|my|that|this)\b[^.;:?!]*"
_END = r"(?=\s*[.!?]*$)"

_Plain = str | Callable[[re.Match[str]], str]


def _and(said: re.Match[str]) -> str:
    """ "Tap the cup, the mug or it, the smaller one": of all that was listed."""
    listed = re.sub(r"^either ", "", said["list"], flags=re.IGNORECASE)
    listed = re.sub(r",? or ", " and ", listed, flags=re.IGNORECASE)
    return f"{said['lead']}{said['verb']} the {said['how']} one of {listed}"


def _seen(said: re.Match[str]) -> str:
    """ "See the cup and the mug? Take the taller one": the taller of the two."""
    listed = re.sub(r",? or ", " and ", said["list"], flags=re.IGNORECASE)
    return f"{said['verb']} the {said['how']} of {listed}"


def _whichever(said: re.Match[str]) -> str:
    listed = re.sub(r",? or ", " and ", said["list"], flags=re.IGNORECASE)
    return f"the {said['how']} of {listed}"


CHOICES: tuple[tuple[str, _Plain], ...] = (
    # "compare the cup with the mug and take the taller one"
    (
        rf"^((?:{_POLITE},? )*)compare (.+?) (?:with|against) (.+?)(?:,? and(?: then)?|,? then|"
        rf"\s*[.;,:]) (?:{_POLITE} )*(\w+(?: up)?) (?:the|whichever(?: one)?{_OF_THEM} is"
        rf"(?: the)?) ({_MEASURED})(?: one)?{_OF_THEM}\b(?! of\b)",
        r"\1\4 the \5 of \2 and \3",
    ),
    # "see the cup and the mug? take the taller one"
    (
        rf"^(?:(?:do you |can you |you )?see|look at|here are|there are|between|of|from) "
        rf"(?P<list>{_THE} (?:and|or) {_THE}?)(?:, (?:dear|please|love|right))?\s*[?.:;,!]+\s*"
        rf"(?:{_POLITE} )*(?P<verb>\w+(?: up| hold of)?) the (?P<how>{_MEASURED})(?: one)?"
        rf"{_OF_THEM}\b(?! of\b)",
        _seen,
    ),
    # "tap the cup or the mug, the smaller one", "..., whichever is smaller"
    (
        rf"^(?P<lead>(?:{_POLITE},? )*)(?P<verb>{_TAKES}) (?P<list>{_ONE} or {_ONE}),? "
        rf"(?:the|whichever(?: one)?(?: is|'s)(?: the)?) (?P<how>{_MEASURED})(?: one)?"
        rf"{_OF_THEM}{_END}",
        _and,
    ),
    # "whichever is the smallest, the cup, the mug or the lamp"
    (
        rf"\bwhichever(?: one)? is(?: the)? (?P<how>{_MEASURED})(?: one)?(?:\s*[,:]| of| among|"
        rf" out of) (?P<list>(?:the|my|that|this) [^.;:?!]*? (?:or|and) (?:the|my|that|this) "
        rf"[^,.;:?!]*?){_END}",
        _whichever,
    ),
    # "the big one out of the cup, the mug and the lamp"
    (
        rf"\bthe ({'|'.join(_PLAIN)}) one (?:out )?(?:of|among|from) "
        r"(?=(?:the|my|that|this|it)\b[^.;:?!]*? (?:and|or) (?:the|my|that|this|it)\b)",
        lambda said: f"the {_PLAIN[said[1].lower()]} of ",
    ),
    (rf"\b(the {_MEASURED})(?: one)? out of (?=(?:the|my|that|this|it)\b)", r"\1 of "),
    # "whichever of the four cups is closest to me"
    (
        r"\bwhichever of ((?:the|these|those|my) (?:(?:two|three|four|five|six) )?\w+s)"
        r"(?: that)?(?: is|'s| stands| lies| sits) (?:the )?(nearest|closest|farthest|furthest) "
        r"(to|from) (me|us|you)\b",
        r"the one of \1 \2 \3 \4",
    ),
    # "touch the cup. Then the mug. Then the lamp on the left."
    (
        rf"^((?:{_POLITE},? )*{_TAKES} {_ITEM})((?:[.;] *(?:and )?then {_ITEM})+)(?=\s*[.!]*$)",
        lambda said: said[1] + re.sub(r"[.;] *(?:and )?then", ", then", said[2], flags=re.I),
    ),
    # "the one of the cup and the mug that is nearest to the lamp"
    (
        r"\bthe (?:one|thing) (?:out )?of ((?:the|my|that|this) [^,.;:?!]*? and (?:the|my|that|"
        r"this) [^,.;:?!]*?) (?:(?:that|which)(?: is|'s) )?(?:the )?(nearest|closest|farthest|"
        r"furthest|nearer|closer|farther|further)(?= (?:to|from)\b)",
        r"whichever of \1 is \2",
    ),
)
"""Patterns and what each is put as."""

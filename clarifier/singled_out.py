"""Turns of phrase that single one thing out: "tell me which one it is by pointing", "whichever of
the mugs is the tallest". They are put into words that name it, or point at it.
"""

from __future__ import annotations

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
_WHICHEVER: tuple[tuple[str, str], ...] = (
    # "whichever of the mugs is the tallest", "whichever of the mugs has the least height"
    (
        rf"\b{_MANY}(?:is|are|looks|turns out to be) (?:the )?((?!near|far|clos|furth)\w+est)"
        r"(?: one)?(?: of (?:them|all|them all))?(?=\W*$|\s*[,.;]| (?:and|on|in|to|over|off|"
        r"goes|next|should|must|belongs|gets|please|by|up|with)\b)",
        r"the \2 of the \1",
    ),
    (rf"\b{_MANY}has the (?:least|smallest|lowest|shortest) height\b", r"the shortest of the \1"),
    (rf"\b{_MANY}has the (?:most|greatest|largest|biggest) height\b", r"the tallest of the \1"),
    (rf"\b{_MANY}has the (?:least|smallest) (?:width|girth)\b", r"the narrowest of the \1"),
    (
        rf"\b{_MANY}has the (?:most|greatest|largest|biggest) (?:width|girth)\b",
        r"the widest of the \1",
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
SINGLED_OUT = (*_POINTING, *_WHICHEVER, *_INSTEAD)
"""Patterns and what each is put as."""

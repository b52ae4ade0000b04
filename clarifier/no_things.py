"""Nouns that name no thing of the table, put plainly: the table and its edge under other names
("the bench", "the brink"), a part that is touched ("the lid of the vial"), a side told by what
stands in the room, a likeness ("like at the fair"), what somebody would say of it.

A word stays as it is where a thing there is called so.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from clarifier.lexicon import Lexicon
from clarifier.words import singular

_OWNS = r"(?:the |my |your |our |this |that )?"
_SIDES = r"(?:edge|corner|side|end|rim|middle|centre|center|half|front|back|left|right)"
_AT = r"(?:on|onto|off|of|across|along|over|from|at|to|by|near)"
_OVER = r"(?=\s*(?:[,.;:!?)]|$)| (?:please|and|then|now|so|to|on|at|in|for|with|but)\b)"
_OF_ALL = (
    r"\b(of (?:all )?(?:the|these|those|my) (?:\w+ ){1,3}?(?:lying |standing )?on) "
    r"(?:the |this |my |our )"
)
"""What "of the four discs on the board" leads to; where something is put on it, it is missed."""
_TOUCH = r"(?:tap|touch|poke|pat|prod|tickle|stroke|brush|boop|press)(?:ping|ing)?"
_ROOM = re.compile(
    r"\b(?:to|towards?|at) the (?P<what>\w+)\s*[,;–—(-]+\s*(?:that(?:'s| is)|which is|it's|it is|"
    r"so|meaning|i\.e\.)\s*(?:on |to |at )?(?:my |your |the )?(?P<side>left|right)(?:[ -]hand)?"
    r"(?: side)?\)?",
    re.IGNORECASE,
)
_LIKE = re.compile(
    r",? (?:(?:just|exactly|a bit|kind of|sort of) )?like (?:at|in|on|during|an?) "
    r"(?P<what>[^,.;:!?]+?)(?=\s*(?:[,.;:!?]|$))",
    re.IGNORECASE,
)
_SAYS = re.compile(
    r",? (?:just )?as (?:the |my |our |old )?(?!you\b|i\b|we\b|it\b|he\b|she\b|they\b)\w+"
    r"(?: \w+)? (?:has|had|would have|will have|puts|calls) it(?=\s*(?:[,.;:!?)]|$))",
    re.IGNORECASE,
)
_ON_ITS_BACK = re.compile(
    rf"(?P<lead>\b{_TOUCH} (?:the|my|that|this|a) (?:\w+ )?(?P<noun>\w+)) on (?:its|his|her|the) "
    r"back\b(?! (?:edge|side|end))",
    re.IGNORECASE,
)
_PITIED = re.compile(
    r",(?: the| you)? (?:poor|dear|sweet)(?: (?:little|old|wee|dear))? "
    r"(?:thing|soul|mite|lamb|creature)(?=\s*(?:[,.;:!?)]|$))",
    re.IGNORECASE,
)


def without_no_things(text: str, names: Iterable[str], lexicon: Lexicon) -> str:
    """The sentence with nouns that name no thing in plainer words, or without them. ``names``:
    what the things there are called."""
    said = {singular(word) for name in names for word in name.lower().split()}

    def unless_there(words: str, before: str, behind: str, plain: str) -> None:
        nonlocal text
        free = sorted(word for word in lexicon.words(words) if word not in said)
        if free:
            text = re.sub(rf"{before}(?:{'|'.join(free)}){behind}", plain, text, flags=re.I)

    unless_there("surfaces", rf"\b({_SIDES}) of {_OWNS}", r"\b", r"\1 of the table")
    unless_there("surfaces", rf"\b({_AT}) {_OWNS.rstrip('?')}", _OVER, r"\1 the table")
    unless_there("boards", rf"\b({_SIDES}) of {_OWNS}", r"\b", r"\1 of the table")
    unless_there("boards", _OF_ALL, r"\b", r"\1 the table")
    unless_there("brinks", r"\bthe (?:very )?", r"\b(?! of (?!the (?:table|desk)\b))", "the edge")
    unless_there("midlines", r"\bthe ", r"\b(?! of (?!the (?:table|desk)\b))", "the middle")
    unless_there("parts", rf"\b({_TOUCH})(?: on| at)?(?: the| its| that)? ", r" of (?=\w)", r"\1 ")
    unless_there(
        "parts",
        rf"\b({_TOUCH}\b(?:(?! and | then )[^,.;!?])*?) (?:on|at) (?:his|her|its|the|their) ",
        _OVER,
        r"\1",
    )
    return _without_asides(_ON_ITS_BACK.sub(lambda found: _tapped(found, lexicon), text), said)


def _tapped(found: re.Match[str], lexicon: Lexicon) -> str:
    """ "Tap the ladybird on its back": on top; "tap the box on its back" is on its far side."""
    beast = lexicon.means("animal", singular(found["noun"].lower()))
    return found["lead"] if beast else found.group()


def _without_asides(text: str, said: set[str]) -> str:
    """The sentence without what is only likened to, pitied, or said by somebody."""

    def by_side(found: re.Match[str]) -> str:
        there = singular(found["what"].lower()) in said
        return found.group() if there else f"to the {found['side']}"

    def unless_named(found: re.Match[str]) -> str:
        told = {singular(word) for word in re.findall(r"\w+", found["what"].lower())}
        return found.group() if told & (said | {"it", "them", "left", "right"}) else ""

    text = _LIKE.sub(unless_named, _ROOM.sub(by_side, text))
    return _PITIED.sub("", _SAYS.sub("", text))

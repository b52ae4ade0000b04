"""Forms of haste, of dialects and of children, put as everybody writes them: "btw u'd", "'em",
"t'other", "settin'", "a-runnin'", "n", "2 the left". Nothing is said about them: they are no slips.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from clarifier.lexicon import Lexicon
from clarifier.signs import in_words
from clarifier.spelling import english
from clarifier.words import plural, singular, words

_FORM = re.compile(r"(?<![\w'’.])['’]?[a-z]+(?:['’][a-z]*)?(?:/o?(?= ))?\.?(?![\w'’])",
                   re.IGNORECASE)  # fmt: skip
_DROPPED = re.compile(r"(?<![\w'’])(a-)?([a-z]{2,}in)(['’]?)(?![\w'’])", re.IGNORECASE)
"""What may be an "-ing" whose end is left off."""
_GLUED = re.compile(r"(?<=[a-z])['’]n(?![\w'’])", re.IGNORECASE)
"""The end of "the big'n"."""
_BEFORE = (
    r"(?:the|a|an|my|your|her|his|its|our|their|this|that|these|those|every|each|any|all|both)"
)
_AND = re.compile(r"(?<=[\w'’]) ['’]?n['’]? (?=\w)", re.IGNORECASE)
_WITH = re.compile(r"(?<=[\w'’]) w (?=\w)", re.IGNORECASE)
_TO = re.compile(rf"(?<=[a-z]) 2 (?=(?:{_BEFORE}|me|it|him|them|us)\b)", re.IGNORECASE)
_FOR = re.compile(r"(?<=[a-z]) 4 (?=(?:me|him|us|u|you)\b)", re.IGNORECASE)
_THE_ONE = re.compile(r"\b(the|that|this) 1 (?=[a-z])", re.IGNORECASE)
_THIS_HERE = re.compile(
    r"\b(?:(that|them|those) there|(this|these) here) (?!(?:is|are|was|were|be|to|must|should|will|"
    r"would|can|could|may|might|shall|has|have|had|and|or|on|in|by|at|next|please|now)\b)(?=[a-z])",
    re.IGNORECASE,
)
_THEM = re.compile(r"\bthem (?=(?:(?:two|three|four|five|six|\d+) )?(?P<noun>[a-z]+s)\b)",
                   re.IGNORECASE)  # fmt: skip
_ISH = re.compile(r"\b((?:cm|mm|inch(?:es)?|centimet(?:re|er)s?|millimet(?:re|er)s?|degrees|\d+))"
                  r"[ -]?ish\b", re.IGNORECASE)  # fmt: skip
_LETTER = re.compile(r"\b(?:letter|key|tile|initial|an?|the)\s*$", re.IGNORECASE)
"""Before a letter that stands for itself: "a u turn"."""
_GIT = re.compile(r"\bgit (?=(?:the|that|this|it|me|my|a|on|off|over|up|'?em|'?er|'?im|yer|your|"
                  r"them|him|her)\b)", re.IGNORECASE)  # fmt: skip
_YON = re.compile(r"\byon (?=[a-z])", re.IGNORECASE)


def as_usual(text: str, names: Iterable[str], lexicon: Lexicon) -> str:
    """The sentence in usual forms; the words of ``names`` stay as they are."""
    own = {word for name in names for word in words(name)}
    text = in_words(text, lexicon)
    text = _GLUED.sub(_one_or_than, text)
    text = _DROPPED.sub(lambda said: _with_its_end(said, own), text)
    text = _AND.sub(lambda said: _if_not(said, "n", " and ", own), text)
    text = _WITH.sub(lambda said: _if_not(said, "w", " with ", own), text)
    text = _FORM.sub(lambda said: _plain(said, own, lexicon), text)
    text = _GIT.sub("get ", text)
    text = _FOR.sub(" for ", _TO.sub(" to ", text))
    text = _ISH.sub(r"\1", _THE_ONE.sub(r"\1 one ", text))
    text = _THIS_HERE.sub(_demonstrative, text)
    text = _THEM.sub(lambda said: _those(said, own, lexicon), text)
    return _YON.sub("that ", text) if "yon" not in own else text


def _one_or_than(said: re.Match[str]) -> str:
    """ "The big'n" is a thing, "bigger'n that" compares."""
    behind = re.match(r"\s+(?:a|an|the|that|this|it|my|me|you)\b", said.string[said.end() :], re.I)
    return " than" if behind and said.string[: said.start()].endswith("er") else " one"


def _if_not(said: re.Match[str], letter: str, plain: str, own: set[str]) -> str:
    """The plain word for a letter, unless a thing is called by it or it is spoken of as one."""
    named = letter in own or _LETTER.search(said.string[: said.start()])
    return said.group() if named else plain


def _plain(said: re.Match[str], own: set[str], lexicon: Lexicon) -> str:
    """The plain words for a form; what is written with a capital or named is left as it is."""
    form = said.group().replace("’", "'").lower()
    full = lexicon.written.get(form)
    if full is None and form.endswith("."):
        full = lexicon.written.get(form[:-1])
        full = None if full is None else f"{full}."
    bare = form.strip(".")
    if len(bare) == 1 and _LETTER.search(said.string[: said.start()]):
        return said.group()
    if full is None or bare in own or singular(bare) in own:
        return said.group()
    return full


def _with_its_end(said: re.Match[str], own: set[str]) -> str:
    """ "settin'" as "setting"; "basin", which is a word, as it is unless the sign stands there."""
    stem = said[2].lower()
    if stem in own or plural(stem) in own or f"{stem}g" not in english():
        return said.group()
    usual = stem in english() and not (said[1] or said[3])
    return said.group() if usual else f"{said[2]}g"


def _demonstrative(said: re.Match[str]) -> str:
    return {"them": "those"}.get((said[1] or said[2]).lower(), said[1] or said[2]) + " "


def _those(said: re.Match[str], own: set[str], lexicon: Lexicon) -> str:
    """ "them cups" as "those cups", where cups are things here."""
    noun = said["noun"].lower()
    thing = singular(noun) in own or noun in own or lexicon.is_noun(singular(noun))
    return "those " if thing else said.group()

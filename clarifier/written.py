"""Ways of writing that are no slips and are read without a word about them: apostrophes left out,
compounds written together or apart, signs for words, other names of the table.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable, Iterable, Iterator, Mapping

from clarifier.lexicon import Lexicon
from clarifier.words import Token, plural, singular, tokenise, words

_CONTRACTIONS = (
    "don't", "doesn't", "didn't", "isn't", "aren't", "wasn't", "weren't", "can't", "won't",
    "couldn't", "shouldn't", "wouldn't", "mustn't", "hasn't", "haven't", "hadn't", "needn't",
    "that's", "what's", "who's", "where's", "there's", "here's", "it'll", "that'll", "they're",
    "you're", "they've", "you've", "they'll", "you'll", "i'm", "i've",
)  # fmt: skip
"""Those whose letters alone are another word ("we're", "it's") are left out."""
_WHOLE: Mapping[str, str] = {short.replace("'", ""): short for short in _CONTRACTIONS}
_SIGNS = {"&": "and", "+": "and", "->": "to", "-->": "to", "=>": "to", "→": "to"}
_TABLE = re.compile(
    r"(?<=\bthe )(?:tabletop|table top|desk|desktop|board|worktop|workspace|work surface|bench|"
    r"workbench|counter|countertop|playing field|work area)"
    r"(?=\s*(?:[.,;:!?]|$|'s\b|(?:and|then|to|with|by|please|so|but|for|if|where|as|next|while)\b))",
    re.IGNORECASE,
)
"""What people call the table."""
_AHEAD = re.compile(r"(?:(?!\band\b)[^,.;:!?])+", re.IGNORECASE)
_SIGN = re.compile(r"(?<=\s)(?:&|\+|-{1,2}>|=>|→)(?=\s)")


def plainly(text: str, names: Iterable[str], known: Callable[[Token], bool], lexicon: Lexicon,
            ) -> str:  # fmt: skip
    """The text in the spelling of the scene's names and of the lexicon; ``known`` tells words that
    stand as they are."""
    runs = [words(name) for name in names]
    text = _SIGN.sub(lambda sign: _word_for(sign, lexicon), text)
    own = {word for run in runs for word in run}
    text = _TABLE.sub(lambda said: said[0] if said[0].lower() in own else "table", text)
    return _apart(_together(text, runs), runs, known, lexicon)


def _word_for(sign: re.Match[str], lexicon: Lexicon) -> str:
    """What a sign stands for: an arrow leads "into" what holds and "onto" what carries."""
    said = _SIGNS[sign.group()]
    if said != "to":
        return said
    ahead = _AHEAD.match(sign.string, sign.end())
    ways = (lexicon.goes(singular(word)) for word in words(ahead[0] if ahead else ""))
    way = next((way for way in ways if way is not None), None)
    return said if way is None else f"{way}to"


def _together(text: str, names: Iterable[tuple[str, ...]]) -> str:
    """ "tool box" where the scene's name is "toolbox"."""
    names = list(names)
    whole = {word for name in names for word in name}
    parted = {pair for name in names for pair in itertools.pairwise(name)}
    tokens = tokenise(text)
    for one, two in reversed(list(itertools.pairwise(tokens))):
        said = one.text + two.text
        blank = not text[one.end : two.start].strip(" -")
        if blank and {said, singular(said)} & whole and (one.text, two.text) not in parted:
            text = text[: one.start] + said + text[two.end :]
    return text


def _apart(
    text: str,
    names: Iterable[tuple[str, ...]],
    known: Callable[[Token], bool],
    lexicon: Lexicon,
) -> str:
    """ "flowerpots" where the name is "flower pot"; "inbetween", "eachother"; "thats"."""
    fixed = [run for run, _ in lexicon.relations] + lexicon.idioms
    usual = {"".join(pair): pair for run in fixed for pair in itertools.pairwise(run)}
    named = {"".join(pair): pair for name in names for pair in itertools.pairwise(name)}
    own = {word for name in names for word in name}
    for token in reversed(tokenise(text)):
        parts = None if token.text in own else _parts(token.text, named)
        if parts is None and token.text in _WHOLE:
            parts = (_WHOLE[token.text],)
        if parts is None and not known(token):
            parts = usual.get(token.text)
        if parts is not None:
            text = text[: token.start] + " ".join(parts) + text[token.end :]
    return text


def pairs(names: Iterable[str]) -> Iterator[tuple[str, str]]:
    """The neighbouring words of names of two words, which people write as one."""
    runs = (words(name) for name in names)
    return ((run[0], run[1]) for run in runs if len(run) == 2)


def apart(word: str, names: Iterable[str]) -> str:
    """ "hairclips" as "hair clips", where a thing is called "hair clip"; others as they are."""
    return " ".join(_parts(word, {"".join(pair): pair for pair in pairs(names)}) or (word,))


def _parts(word: str, named: Mapping[str, tuple[str, str]]) -> tuple[str, ...] | None:
    """The two words of a name that were written as one, in the number that was said."""
    if word in named:
        return named[word]
    first, last = named.get(singular(word), ("", ""))
    return (first, plural(last)) if first else None

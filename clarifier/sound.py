"""How words sound: a key for each way in which a word's spelling can be read aloud.

Two words that share a key may be taken for one another by whoever writes down what is heard: "pale"
and "pail", "bred" and "bread", "write" and "right". Vowels are told apart ("pole" is no "pail"),
and a spelling that can be read in two ways has two keys ("read").
"""

from __future__ import annotations

import itertools
import re
from functools import lru_cache

_AY, _EE, _EYE, _OH, _OO = "A", "E", "I", "O", "U"
_SPELLINGS: tuple[tuple[str, tuple[str, ...]], ...] = (
    # silent letters and consonants of two letters; "$" is the end of the word, "^" its beginning
    ("^kn", ("n",)), ("^wr", ("r",)), ("^gn", ("n",)), ("^ps", ("s",)), ("^wh", ("w",)),
    ("eight", (_AY + "t",)), ("aught", ("Ct",)), ("ought", ("Ct",)), ("ight", (_EYE + "t",)),
    ("eigh", (_AY,)), ("ough", (_OO, _OH, "Q")), ("igh", (_EYE,)),
    ("mb$", ("m",)), ("mn$", ("m",)), ("tch", ("H",)), ("dge", ("j",)), ("ch", ("H", "k")),
    ("sh", ("S",)), ("th", ("T",)), ("ph", ("f",)), ("ck", ("k",)), ("qu", ("kw",)), ("x", ("ks",)),
    ("sce", ("se",)), ("sci", ("si",)), ("wh", ("w",)),
    # vowels before "r"
    ("ower", ("Qr",)), ("our", ("Cr", "Qr")), ("ored$", ("Crd",)), ("ared$", ("Xrd",)),
    ("oar", ("Cr",)), ("oor", ("Cr",)), ("ore$", ("Cr",)), ("or", ("Cr",)),
    ("eir", ("Xr",)), ("eyr", ("Xr",)), ("air", ("Xr",)), ("are$", ("Xr",)), ("eer", ("Er",)),
    ("ere$", ("Er", "Xr")), ("ear", ("Er", "Xr", "Wr")), ("ier", ("Er",)), ("ar", ("Yr",)),
    ("ur", ("Wr",)), ("ir", ("Wr",)), ("er", ("Wr",)),
    # long vowels
    ("ai", (_AY,)), ("ay", (_AY,)), ("ey", (_AY, _EE)), ("ei", (_AY, _EE)), ("ea", (_EE, "e", _AY)),
    ("ee", (_EE,)), ("ie$", (_EYE,)), ("ie", (_EE,)), ("uy", (_EYE,)), ("ye$", (_EYE,)),
    ("oa", (_OH,)), ("oe", (_OH,)), ("ow", (_OH, "Q")), ("ou", ("Q", _OO)), ("oo", (_OO, "u")),
    ("ew", (_OO,)), ("ue$", (_OO,)), ("ui", (_OO,)), ("au", ("C",)), ("aw", ("C",)),
    ("oi", ("V",)), ("oy", ("V",)),
    ("all$", ("Cl",)),
    ("ce", ("se",)), ("ci", ("si",)), ("cy", ("sy",)), ("c", ("k",)), ("z", ("s",)),
    ("y$", (_EE, _EYE)), ("^y", ("y",)), ("y", ("i", _EYE)),
)  # fmt: skip
_MAGIC = re.compile(r"(?<=[^aeiou])([aeiou])([bcdfgklmnpstvz]|th|st)e$")
"""The silent "e" that makes the vowel before it long."""
_LONG = {"a": _AY, "e": _EE, "i": _EYE, "o": _OH, "u": _OO}
_ENDING_VOWEL = {"e": (_EE,), "o": (_OH, _OO), "i": (_EYE, _EE), "u": (_OO,)}
_DOUBLED = re.compile(r"([b-df-hj-np-tv-z])\1")
_MOST = 24
"""Ways of reading one word that are looked at."""


@lru_cache(maxsize=8192)
def keys(word: str) -> frozenset[str]:
    """The ways in which a word in lower case can be read aloud; none for what is no word."""
    if not word.isalpha() or not word.isascii() or len(word) > 16:
        return frozenset()
    parts = itertools.islice(itertools.product(*_parts(word)), _MOST)
    return frozenset(_DOUBLED.sub(r"\1", "".join(part)) for part in parts)


def alike(one: str, other: str) -> bool:
    """Whether two words can sound the same, written differently."""
    return one != other and not keys(one).isdisjoint(keys(other))


def _parts(word: str) -> list[tuple[str, ...]]:
    """The readings of each piece of a word's spelling, in order."""
    magic = _MAGIC.search(word)
    found: list[tuple[str, ...]] = []
    at, end = 0, len(word)
    while at < end:
        if magic is not None and at == magic.start(1):
            soft = {"c": "s", "g": "j", "z": "s"}.get(magic[2], magic[2].replace("th", "T"))
            return [*found, (_LONG[magic[1]],), (soft,)]
        spelt, ways = _read(word, at)
        found.append(ways)
        at += spelt
    return found


def _read(word: str, at: int) -> tuple[int, tuple[str, ...]]:
    """How many letters at an index are read as one, and as what."""
    for said, ways in _SPELLINGS:
        bare = said.strip("^$")
        if not word.startswith(bare, at) or (said[0] == "^" and at):
            continue
        if said[-1] == "$" and at + len(bare) != len(word):
            continue
        return len(bare), ways
    letter = word[at]
    if at == len(word) - 1 and letter in _ENDING_VOWEL:
        lone = not any(vowel in word[:at] for vowel in "aeiouy")
        silent = letter == "e" and not lone
        return 1, ("",) if silent else _ENDING_VOWEL[letter]
    return 1, (letter,)

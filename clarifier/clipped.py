"""Words whose vowels were left out: "rght", "twrds", "tbl". Everybody reads them, so nothing is
said about them unless the name of a thing was written so.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

VOWELS = frozenset("aeiou")
_SILENT = VOWELS | {"y"}
_USUAL = 20_000
"""How often the dictionary must have met the word that is read."""
_DOMINANT = 5
"""How many times as usual as the next word one of the dictionary must be to be read."""


def left_out(word: str, form: str) -> int:
    """How many letters of ``form`` were left out to write ``word``; 0 if it is no such writing.

    Vowels may be left out, one of two like letters, and "c" before "k"; the first letter never.
    """
    if len(word) >= len(form) or word[:1] != form[:1]:
        return 0
    at = 0
    for i, letter in enumerate(form):
        if at < len(word) and word[at] == letter:
            at += 1
            continue
        follows = form[i + 1 : i + 2]
        doubled = form[i - 1] == letter or (letter == "c" and follows == "k")
        if letter not in _SILENT and not doubled:
            return 0
    return len(form) - len(word) if at == len(word) else 0


def is_clipped(word: str) -> bool:
    """Whether a word has no vowel behind its first letter: no word of English looks like that."""
    return len(word) > 1 and word.isalpha() and not VOWELS & set(word[1:])


def nearest(word: str, forms: Iterable[str]) -> list[str]:
    """The forms of which the fewest letters were left out to write ``word``."""
    missing = {form: left for form in forms if (left := left_out(word, form))}
    fewest = min(missing.values(), default=0)
    return [form for form, left in missing.items() if left == fewest]


def usual(found: Sequence[str], met: Mapping[str, int]) -> str | None:
    """The most usual word of several; None for none."""
    return max(found, key=lambda form: met.get(form, 0), default=None)


def in_dictionary(word: str, met: Mapping[str, int]) -> str | None:
    """The word of the dictionary that was written without its vowels, if one is far more usual than
    all others."""
    found = [form for form in met if met[form] > _USUAL and left_out(word, form)]
    found.sort(key=lambda form: -met[form])
    sure = found and (len(found) == 1 or met[found[0]] > _DOMINANT * met[found[1]])
    return found[0] if sure else None

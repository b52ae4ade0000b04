"""A sentence as tokens, and the forms of words: singulars, verb stems, number words."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import NamedTuple

MAX_TEXT = 1000
"""Longest sentence that is read (characters); longer ones are refused."""

_TOKEN = re.compile(r"\d+(?:\.\d+)?(?![a-z0-9_])|[a-z0-9_]+(?:['’][a-z]+)*|[^\s\w-]|(?<=\s)-(?=\d)")
_NUMBERS = (
    "zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten",
    "eleven", "twelve",
)  # fmt: skip
_IRREGULAR = {
    "knives": "knife", "loaves": "loaf", "mice": "mouse", "dice": "die", "leaves": "leaf",
    "tomatoes": "tomato", "potatoes": "potato", "shelves": "shelf", "people": "person",
    "halves": "half", "boxes": "box", "torches": "torch", "mangoes": "mango", "men": "man",
    "chessmen": "chessman", "snowmen": "snowman",
    "women": "woman", "children": "child", "feet": "foot", "teeth": "tooth", "geese": "goose",
    "penknives": "penknife", "scarves": "scarf", "wolves": "wolf", "calves": "calf",
    "elves": "elf", "dominoes": "domino", "axes": "axe", "buses": "bus", "lenses": "lens",
    "gases": "gas", "quiches": "quiche", "cacti": "cactus",
}  # fmt: skip
_ENDING_IN_IE = frozenset(
    {"beanie", "birdie", "brownie", "cookie", "doggie", "duckie", "genie", "hankie", "hoodie"}
    | {"magpie", "movie", "plushie", "selfie", "smoothie", "sweetie", "toastie", "veggie", "zombie"}
)
_PLURAL_ONLY = frozenset(
    {"binoculars", "clippers", "clothes", "cosmetics", "dishes", "earmuffs", "earphones"}
    | {"electronics", "glasses", "goggles", "headphones", "jeans", "leggings", "pajamas", "pants"}
    | {"pincers", "pliers", "pyjamas", "scales", "scissors", "secateurs", "shears", "shorts"}
    | {"spectacles", "sunglasses", "tights", "tongs", "trousers", "tweezers", "underpants"}
)
_UNCHANGED = _PLURAL_ONLY | {
    "atlas", "bus", "canvas", "chess", "cross", "dress", "gas", "glass", "grass", "iris", "lens",
    "rhinoceros", "thermos", "triceratops",
}  # fmt: skip


class Token(NamedTuple):
    """One word, number or mark of a sentence: ``text`` in lower case, its span in the sentence."""

    text: str
    start: int
    end: int


def tokenise(sentence: str) -> tuple[Token, ...]:
    """The tokens of a sentence; a hyphen between letters parts two words ("top-left")."""
    lower = sentence.lower()
    if len(lower) != len(sentence):
        lower = sentence
    found = (match.span() for match in _TOKEN.finditer(lower))
    return tuple(Token(lower[a:b].replace("’", "'"), a, b) for a, b in found)


def words(text: str) -> tuple[str, ...]:
    """The words of a text in lower case, marks left out."""
    return tuple(token.text for token in tokenise(text) if token.text[0].isalnum())


def singular(word: str) -> str:
    """The singular of a noun by English spelling rules ("cherries" -> "cherry")."""
    if word in _IRREGULAR:
        return _IRREGULAR[word]
    if word in _UNCHANGED or len(word) < 4 or not word.endswith("s") or word.endswith("ss"):
        return word
    if word.endswith("ies") and len(word) > 4:
        return word[:-1] if word[:-1] in _ENDING_IN_IE else word[:-3] + "y"
    if word.endswith(("shes", "ches", "xes", "sses", "zzes")):
        return word[:-2]
    if word.endswith(("us", "'s")):
        return word
    return word[:-1]


def plural(word: str) -> str:
    """The plural of a noun by English spelling rules."""
    for many, one in _IRREGULAR.items():
        if one == word:
            return many
    if word in _PLURAL_ONLY:
        return word
    if word.endswith(("s", "x", "sh", "ch", "z")):
        return word + "es"
    if word.endswith("y") and len(word) > 2 and word[-2] not in "aeiou":
        return word[:-1] + "ies"
    return word + "s"


def stems(verb: str) -> tuple[str, ...]:
    """A verb form and the base forms it may come from ("putting" -> "put")."""
    found = [verb]
    for ending in ("ing", "ed", "es", "s", "d"):
        if verb.endswith(ending) and len(verb) > len(ending) + 1:
            base = verb[: -len(ending)]
            found += [base, base + "e"]
            if ending in ("ing", "ed") and len(base) > 2 and base[-1] == base[-2]:
                found.append(base[:-1])
    return tuple(found)


def number(word: str) -> float | None:
    """The value of a number in digits or words up to twelve; None for other words."""
    if word in _NUMBERS:
        return float(_NUMBERS.index(word))
    try:
        return float(word) if word[:1].isdigit() else None
    except ValueError:
        return None


def number_word(count: int) -> str:
    """A small number as a word, others as digits."""
    return _NUMBERS[count] if 0 <= count < len(_NUMBERS) else str(count)


def match_run(tokens: Sequence[Token], at: int, run: Sequence[str]) -> bool:
    """Whether the words of ``run`` stand at index ``at``."""
    if at < 0 or at + len(run) > len(tokens):
        return False
    return all(tokens[at + i].text == word for i, word in enumerate(run))


def article(noun: str) -> str:
    """The noun with "a" or "an" before it; a plural noun without."""
    if noun.split()[-1] in _PLURAL_ONLY:
        return noun
    return f"an {noun}" if noun[:1].lower() in "aeiou" else f"a {noun}"


def listing(items: Iterable[str], joint: str = "and") -> str:
    """ "a", "a and b", "a, b and c"."""
    parts = list(items)
    if len(parts) < 2:
        return "".join(parts)
    return f"{', '.join(parts[:-1])} {joint} {parts[-1]}"


def sentence(text: str) -> str:
    """The text with a capital in front and one full stop behind."""
    return f"{text[:1].upper()}{text[1:].rstrip('.')}."

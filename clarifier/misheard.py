"""Words that speech recognition wrote for others that sound the same: "the pale" where a pail is,
"the read bead", "two inches two the write".

A word is taken for another only where it makes no sense as it stands: candidates are the words of
the scene's names and colours, and the small words that sentences are made of. What is said of a
thing's name is announced.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

from clarifier.lexicon import Lexicon
from clarifier.sound import alike
from clarifier.words import Token, number, plural, singular, tokenise, words

_DETERMINERS = frozenset(
    {"the", "a", "an", "my", "your", "his", "her", "its", "our", "their", "this", "that", "these"}
    | {"those", "each", "every", "any", "both", "all", "some", "another", "other", "which"}
)
_PRONOUNS = frozenset({"me", "it", "him", "them", "us", "her", "you", "mine"})
_SUBJECTS = frozenset({"i", "we", "he", "she", "they", "you", "who", "to", "has", "have", "had",
                       "i've", "he's", "was", "been", "not", "didn't", "never"})  # fmt: skip
_IS = frozenset({"is", "that's", "thats", "it's", "which's", "are", "not"})
_LEADS = frozenset({"in", "into", "on", "onto", "by", "to", "beside", "behind", "near", "under",
                    "with", "of", "and", "inside", "from", "over", "than"})  # fmt: skip
_UNITS = frozenset({"cm", "mm", "inch", "inches", "centimetre", "centimetres", "centimeter", "deg",
                    "centimeters", "millimetres", "millimeters", "degrees", "foot",
                    "feet"})  # fmt: skip
_FILLERS = frozenset({"um", "uh", "er", "erm", "like"})
_ASIDE = frozenset({"side", "corner", "edge", "hand", "next", "beside", "behind", "end", "half"})
_SIGNED = re.compile(r"[A-Z,;:!?]|\.(?=\s)")
"""What speech recognition does not write."""
_SMALL: tuple[tuple[str, frozenset[str], str], ...] = (
    ("to", frozenset({"two", "too"}), "to"),
    ("for", frozenset({"four", "fore"}), "to"),
    ("two", frozenset({"to", "too"}), "number"),
    ("four", frozenset({"for", "fore"}), "number"),
    ("eight", frozenset({"ate"}), "number"),
    ("one", frozenset({"won"}), "noun"),
    ("right", frozenset({"write", "rite", "wright"}), "side"),
    ("in", frozenset({"inn"}), "to"), ("by", frozenset({"buy", "bye"}), "to"),
    ("row", frozenset({"roe"}), "noun"), ("whole", frozenset({"hole"}), "adjective"),
    ("through", frozenset({"threw"}), "to"), ("towards", frozenset({"tours", "tords"}), "to"),
    ("way", frozenset({"weigh", "whey"}), "noun"), ("then", frozenset({"than"}), "then"),
    ("piece", frozenset({"peace"}), "noun"), ("place", frozenset({"plaice"}), "noun"),
    ("which", frozenset({"witch"}), "adjective"), ("not", frozenset({"knot"}), "not"),
    ("there", frozenset({"their", "they're"}), "there"), ("here", frozenset({"hear"}), "there"),
)  # fmt: skip
"""A small word, what is written for it, and what it must stand as."""


class _Place(NamedTuple):
    """A word and those around it, fillers left out; "" at the ends."""

    word: str
    before: str
    after: str


def heard_right(text: str, names: Iterable[str], lexicon: Lexicon) -> tuple[str, str]:
    """The text with what was misheard put right, and the sentence that says so ("" for none).

    ``names`` are the names of the scene's objects and their colours.
    """
    names = list(names)
    own = {word for name in names for word in words(name)}
    tokens, said = list(tokenise(text)), list[str]()
    dictated = len(tokens) > 3 and not _SIGNED.search(text)
    result = text
    for at in reversed(range(len(tokens))):
        token = tokens[at]
        if token.text in own or singular(token.text) in own or token.text in lexicon.colors:
            continue
        right = _of_scene(tokens, at, names, own, dictated, lexicon)
        named = right is not None
        right = right or _small(_around(tokens, at), dictated, lexicon)
        if right is None:
            continue
        result = result[: token.start] + right + result[token.end :]
        tokens[at] = Token(right, token.start, token.end)
        if named:
            said.append(f"I read “{token.text}” as “{right}”.")
    return result, " ".join(reversed(said))


def _around(tokens: Sequence[Token], at: int) -> _Place:
    before = next((t.text for t in reversed(tokens[:at]) if t.text not in _FILLERS), "")
    after = next((t.text for t in tokens[at + 1 :] if t.text not in _FILLERS), "")
    return _Place(tokens[at].text, before, after)


# --- words of the scene ------------------------------------------------------------


def _of_scene(
    tokens: Sequence[Token],
    at: int,
    names: Sequence[str],
    own: set[str],
    dictated: bool,
    lexicon: Lexicon,
) -> str | None:
    """The word of the scene that a token was heard as, in the number that was said."""
    place = _around(tokens, at)
    found = {
        form for word in own for form in {word, plural(word)} if alike(place.word, form)
    }  # fmt: skip
    if len({singular(form) for form in found}) != 1:
        return None
    right = min(found, key=lambda form: (form not in own, form))
    near = {t.text for t in (*tokens[max(0, at - 1) : at], *tokens[at + 1 : at + 2])}
    if _completes(right, near, names):
        return right
    if singular(right) in lexicon.colors:
        return right if _is_a_hue(place, own, lexicon) else None
    if place.word in lexicon.words("grammar") | lexicon.words("correcting"):
        return None
    led = place.before in _DETERMINERS | _LEADS or place.before in lexicon.colors
    led = led or number(place.before) is not None
    ends = not (lexicon.is_noun(place.after) or place.after in own | lexicon.colors | {"of", "one"})
    strange = place.word not in lexicon.vocabulary and not lexicon.is_noun(singular(place.word))
    return right if led and ends and (dictated or strange) else None


def _completes(right: str, near: Iterable[str], names: Sequence[str]) -> bool:
    """Whether the words beside it are those beside it in a name, or sound like them."""
    for run in map(words, names):
        for i, word in enumerate(run):
            if singular(right) != singular(word):
                continue
            beside = {*run[max(0, i - 1) : i], *run[i + 1 : i + 2]}
            if any(other == one or alike(one, other) for one in near for other in beside):
                return True
    return False


def _is_a_hue(place: _Place, own: set[str], lexicon: Lexicon) -> bool:
    """Whether a colour stands well there, and the verb that was written does not."""
    thing = {place.after, singular(place.after)} & own or lexicon.is_noun(place.after)
    one = place.after in ("one", "ones", "won")
    if place.before in _DETERMINERS:
        return bool(thing) or one
    return place.before in _IS and place.after in ("", "and", "not", "or", "to", "on", "in", "so")


# --- small words ------------------------------------------------------------


def _small(place: _Place, dictated: bool, lexicon: Lexicon) -> str | None:
    """The small word that was heard, where the one that was written makes no sense."""
    for right, written, stands_as in _SMALL:
        if place.word in written and _STANDING[stands_as](place, dictated, lexicon):
            return right
    return None


def _leads(place: _Place, dictated: bool, lexicon: Lexicon) -> bool:
    """ "two the left", "put it inn": it leads to a thing or a place, or ends a verb."""
    if place.before in _SUBJECTS | _DETERMINERS:
        return False
    follows = place.after in _DETERMINERS | _PRONOUNS
    if place.word in ("two", "four"):
        counted = place.before == "" or lexicon.verb(place.before) in ("place", "pick")
        return follows and not counted and place.after not in ("of", "that", "those", "these")
    ends = place.after == "" and place.word == "inn"
    return dictated and (follows or ends)


def _counts(place: _Place, _: bool, lexicon: Lexicon) -> bool:
    return place.after in _UNITS and place.before not in _DETERMINERS


def _is_a_noun(place: _Place, dictated: bool, lexicon: Lexicon) -> bool:
    described = place.before in lexicon.colors or place.before in lexicon.place_adjectives
    return dictated and (place.before in _DETERMINERS | {"single"} or described)


def _is_a_side(place: _Place, _: bool, lexicon: Lexicon) -> bool:
    """ "the near write corner", "write next to it": nothing that is written stands like that."""
    if place.before in _SUBJECTS:
        return place.before == "to" and place.after in ("of", "side", "hand", "by", "")
    if place.word == "rite":
        return place.before not in _DETERMINERS or place.after != "of"
    sided = place.before in lexicon.place_adjectives | _DETERMINERS
    return sided or place.after in _ASIDE


def _describes(place: _Place, dictated: bool, lexicon: Lexicon) -> bool:
    return dictated and place.before in _DETERMINERS | {""} and lexicon.is_noun(place.after)


def _goes_on(place: _Place, _: bool, lexicon: Lexicon) -> bool:
    """ "and than the green one": nothing was compared."""
    return place.before in ("and", "")


def _denies(place: _Place, dictated: bool, lexicon: Lexicon) -> bool:
    return dictated and place.before in ("do", "but", "and", "is", "that's") and (
        place.after in _DETERMINERS
    )  # fmt: skip


def _points(place: _Place, dictated: bool, lexicon: Lexicon) -> bool:
    """ "put it over their": nothing is there that might be theirs."""
    ends = place.after in ("", "and", "please", "then", "okay")
    return dictated and ends and place.before not in _SUBJECTS


_STANDING: dict[str, Callable[[_Place, bool, Lexicon], bool]] = {
    "to": _leads, "number": _counts, "noun": _is_a_noun, "side": _is_a_side, "not": _denies,
    "adjective": _describes, "then": _goes_on, "there": _points,
}  # fmt: skip

"""Things called by part of their name: "the chalk" where one chalk stub lies, "the falcons".

A word that stands where a noun stands, is no other thing that is there, and belongs to the name of
one kind of thing alone, means that kind; the whole name is put in its place, and said. It is not
taken where it names something of its own that the thing is only made for or holds: "the coffee" is
no coffee mug, "the phone" no phone charger.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from clarifier.lexicon import Lexicon
from clarifier.pieces import DETERMINERS, JOINTS, STOPS
from clarifier.things import Thing, is_attribute, side_of, things_of
from clarifier.words import Token, number, plural, singular, tokenise
from scene.kinds import is_container
from scene.types import Scene

_NOT_BEFORE = frozenset({"of", "like", "as", "than", "for", "without", "with", "about", "no", "is"}
                        | {"are", "was", "were", "be", "any"})  # fmt: skip
"""Behind these a noun need not be a thing of the table."""
_LIKENING = frozenset({"like", "as", "than"})
_PLACING = frozenset({"in", "on", "at", "by", "into", "onto", "to", "behind", "beside", "under"}
                     | {"over", "near", "between", "inside", "from", "against", "upon", "off"}
                     | {"towards", "toward", "around", "with", "within"})  # fmt: skip
_WORKS_ON = ("er", "or")
"""Endings of what works on what its name begins with: a charger, a printer."""


class Called(NamedTuple):
    """A sentence with whole names in it, and what is said of that; empty where nothing is."""

    text: str
    note: str


def with_whole_names(text: str, scene: Scene, lexicon: Lexicon) -> Called:
    """The sentence with the whole name in place of each word that stands for one."""
    things = things_of(scene, lexicon)
    tokens = tokenise(text)
    found = list[tuple[Token, str]]()
    for at in range(len(tokens)):
        name = _whole_name(at, tokens, things, lexicon)
        if name is not None:
            found.append((tokens[at], name))
    notes = dict.fromkeys(f"I take “{token.text}” to mean the {name}." for token, name in found)
    for token, name in reversed(found):
        text = f"{text[: token.start]}{name}{text[token.end :]}"
    return Called(text, " ".join(notes))


def _whole_name(
    at: int, tokens: Sequence[Token], things: Sequence[Thing], lexicon: Lexicon
) -> str | None:
    """The name that the word at a token stands for; None where it stands for itself."""
    word = tokens[at].text
    if not _may_be_noun(word, lexicon) or _names_one(word, things, lexicon):
        return None
    if not (_opens_here(at, tokens, lexicon) and _ends_here(at, tokens, lexicon)):
        return None
    after = tokens[at + 1].text if at + 1 < len(tokens) else ""
    if any({after, singular(after)} & set(thing.name) for thing in things):
        return None  # the whole name, or another one, is said
    bearers = [t for t in things if {word, singular(word)} & set(t.extra)]
    bearers = bearers or [t for t in things if _is_compound(singular(word), t, lexicon)]
    names = {tuple(w for w in t.name if w not in lexicon.colors) for t in bearers}
    if len(names) != 1 or not all(_stands_for(word, t, lexicon) for t in bearers):
        return None
    (name,) = names
    many = singular(word) != word and word not in name
    return " ".join((*name[:-1], plural(name[-1]) if many else name[-1]))


def _may_be_noun(word: str, lexicon: Lexicon) -> bool:
    one = singular(word)
    plain = len(word) > 2 and word.isalpha() and number(word) is None
    grammar = word in STOPS | JOINTS | DETERMINERS | _PLACING or lexicon.verb(word) is not None
    told = is_attribute(word, lexicon) or side_of(word, lexicon) != ""
    told = told or word in lexicon.words("ordinals") | lexicon.words("vague")
    known = {word, one} & (lexicon.place_heads | lexicon.abstract) or lexicon.is_anything(word)
    small = word in lexicon.vocabulary and not lexicon.is_noun(word)
    return plain and not (grammar or told or known or small or one in lexicon.colors)


def _names_one(word: str, things: Sequence[Thing], lexicon: Lexicon) -> bool:
    """Whether the word means something that is there without more ado."""
    heads = {word, singular(word)}
    return any(
        thing.head in heads
        or thing.id.lower() == word
        or lexicon.means(word, thing.noun)
        or lexicon.means(word, thing.inside)
        for thing in things
    )


def _opens_here(at: int, tokens: Sequence[Token], lexicon: Lexicon) -> bool:
    """Whether what stands before the word is a determiner, an adjective, a verb or nothing."""
    before = tokens[at - 1].text if at else ""
    likened = at > 1 and before in DETERMINERS and tokens[at - 2].text in _LIKENING
    if before in _NOT_BEFORE or likened:
        return False
    small = before == "" or not before[0].isalnum() or number(before) is not None
    small = small or before in DETERMINERS | JOINTS | _PLACING | STOPS
    told = small or is_attribute(before, lexicon) or side_of(before, lexicon) != ""
    told = told or before in lexicon.words("ordinals") | lexicon.words("vague")
    return told or lexicon.verb(before) is not None or before in lexicon.words("polite")


def _ends_here(at: int, tokens: Sequence[Token], lexicon: Lexicon) -> bool:
    """Whether no noun follows: "the sugar tongs" are no sugar."""
    after = tokens[at + 1].text if at + 1 < len(tokens) else ""
    if after == "" or not after[0].isalnum() or number(after) is not None:
        return True
    if lexicon.is_noun(after):
        return False
    small = after in STOPS | JOINTS | DETERMINERS | _PLACING or lexicon.verb(after) is not None
    leads = any(run[0] == after for run, _ in lexicon.relations)
    return small or leads or after in lexicon.words("directions") or after.endswith("ly")


def _is_compound(word: str, thing: Thing, lexicon: Lexicon) -> bool:
    """ "The stone" of a whetstone, where no kind of thing is called a whetstone."""
    rest = thing.head.removesuffix(word)
    known = lexicon.is_noun(thing.head) or not lexicon.is_noun(word)
    return len(word) > 3 and rest != thing.head and len(rest) > 2 and not known


def _stands_for(word: str, thing: Thing, lexicon: Lexicon) -> bool:
    """Whether a thing may be called by this word of its name."""
    own = lexicon.is_noun(word)
    if thing.head in lexicon.words("forms"):
        compound = lexicon.is_noun(" ".join(thing.name))
        return not (own and compound)
    if thing.head in lexicon.words("holding"):
        return True
    if thing.head == "case":
        return singular(word) != word and word in thing.name
    made_for = is_container(" ".join(thing.name)) or lexicon.goes(thing.head) is not None
    made_for = made_for or (word in thing.extra and thing.head.endswith(_WORKS_ON))
    return not made_for and (not own or word not in thing.extra)

"""The clarifier's words: relations, verbs, colours (``lexicon.toml``), nouns (``kinds.txt``)."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from pathlib import Path
from typing import TypeVar

import msgspec

from agent.errors import ConfigError
from clarifier.kinds import KINDS, Kinds
from clarifier.words import singular, stems

LEXICON = Path(__file__).with_name("lexicon.toml")

SIZES = ("big", "small", "tall", "short", "long", "wide", "narrow", "thick", "thin")
"""The word lists of sizes, each by its plainest word."""
_DOUBLING = re.compile(r"[^aeiou][aeiou][dgmnt]$")

Words = dict[str, tuple[str, ...]]
E = TypeVar("E")


class _Groups(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    groups: tuple[tuple[str, ...], ...]


class _File(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    words: Words
    colors: Words
    materials: Words
    kinds_of_material: Words
    kin: _Groups
    kinds_of_place: Words
    relations: Words
    verbs: Words
    goals: Words
    speech: Words
    written: Words


class Lexicon:
    """What words mean before any scene is looked at. Immutable; nouns are singular."""

    def __init__(self, file: _File, kinds: Kinds) -> None:
        self._file = file
        self._kinds = kinds
        tables = (file.speech, file.goals, file.words)
        self._lists = {name: frozenset(table[name]) for table in tables for name in table}
        self._lists |= {name: frozenset(compared(file.words[name])) for name in SIZES}
        self.collective = frozenset(kinds.collective)
        self._hues: Mapping[str, frozenset[str]] = _turned(file.colors)
        self._materials: Mapping[str, frozenset[str]] = _turned(file.materials)
        self._verbs: dict[str, str] = {}
        for verb_class, verbs in file.verbs.items():
            for verb in verbs:
                self._verbs.setdefault(verb, verb_class)
        self.base_verbs = frozenset(self._verbs)
        self.written: Mapping[str, str] = {
            form: plain for plain, forms in file.written.items() for form in forms
        }
        """What is written in haste or in dialect, and the plain words for it."""
        self.place_heads = frozenset(file.words["place_heads"])
        self.place_adjectives = frozenset(file.words["place_adjectives"])
        self.abstract = frozenset(file.words["abstract"])
        self.colors = frozenset(self._hues)
        self.relations = sorted(
            ((tuple(said.split()), name) for name, all_ in file.relations.items() for said in all_),
            key=lambda entry: -len(entry[0]),
        )
        self.idioms = sorted(
            (tuple(said.split()) for said in file.words["idioms"]), key=lambda run: -len(run)
        )
        self._relations_from = _by_first(self.relations, lambda entry: entry[0])
        self._idioms_from = _by_first(self.idioms, lambda run: run)
        self.vocabulary = self._all_words()

    def _all_words(self) -> frozenset[str]:
        file = self._file
        tables = [file.words, file.verbs, file.goals, file.speech, file.relations, file.materials]
        found = [entry for table in tables for entries in table.values() for entry in entries]
        found += [entry for group in file.kin.groups for entry in group]
        found += [*self._kinds.nouns, *self._hues]
        found += [word for name in SIZES for word in self._lists[name]]
        return frozenset(word for entry in found for word in entry.split())

    def relations_from(self, word: str) -> Sequence[tuple[tuple[str, ...], str]]:
        """The relations that open with a word, the longest first."""
        return self._relations_from.get(word, ())

    def idioms_from(self, word: str) -> Sequence[tuple[str, ...]]:
        """The idioms that open with a word, the longest first."""
        return self._idioms_from.get(word, ())

    def words(self, name: str) -> frozenset[str]:
        """A word list of ``[words]``, ``[goals]`` or ``[speech]`` by its name."""
        if name not in self._lists:
            raise ConfigError(f"{LEXICON}: no word list {name!r}")
        return self._lists[name]

    def either(self, name: str) -> str:
        """A pattern of any of the runs of words of a list, the longest first."""
        runs = sorted(self.words(name), key=lambda run: (-len(run), run))
        return f"(?:{'|'.join(map(re.escape, runs))})"

    def is_noun(self, phrase: str) -> bool:
        """Whether the word names a kind of thing, seen on tables or not (either number)."""
        return phrase in self._kinds or self.is_anything(phrase) or bool(self.alike(phrase))

    def is_plural(self, noun: str) -> bool:
        """Whether the noun is in the plural; "scissors" and "dice" are not."""
        return singular(noun) != noun and (
            noun not in self._kinds.nouns
            or (singular(noun) in self._kinds and not self._kinds.mean(noun, singular(noun)))
        )

    def is_anything(self, word: str) -> bool:
        """Whether the word stands for any object at all ("thing")."""
        return singular(word) in self._file.words["anything"]

    def means(self, said: str, noun: str) -> bool:
        """Whether ``said`` may be said of what is called ``noun``: another word for it ("mug" of a
        cup), a wider kind ("fruit" of an apple) or a compound of it ("dinner plate" of a plate)."""
        return self._kinds.mean(said, noun)

    def noun_in(self, name: Sequence[str]) -> str:
        """The longest known noun that a name ends with, else its last word."""
        ends = (" ".join(name[i:]) for i in range(len(name)))
        return next((end for end in ends if end in self._kinds), "".join(name[-1:]))

    def same_color(self, one: str, other: str) -> bool:
        """Whether two colour words may be said of one colour: "crimson" and "red"."""
        hues, others = self._hues.get(one, frozenset()), self._hues.get(other, frozenset())
        return one in others or other in hues or bool(hues and hues == others)

    def material(self, word: str) -> tuple[frozenset[str], frozenset[str]]:
        """The words for the material that a word names, and the colours that tell it."""
        kinds = set() if word in self.colors else set(self._materials.get(word, ()))
        for kind in [one for one in kinds if word.startswith(one)]:
            kinds |= set(self._file.kinds_of_material.get(kind, ()))
        every = frozenset(each for kind in kinds for each in self._file.materials[kind])
        return every - self.colors, every & self.colors

    def is_material_kind(self, word: str) -> bool:
        """Whether a word names a kind of material and no one of it: "metal", "wooden"."""
        return any(word.startswith(kind) for kind in self._materials.get(word, ()))

    def alike(self, noun: str) -> frozenset[str]:
        """Nouns of things much like this one: to be offered, never to be taken."""
        found = (group for group in self._file.kin.groups if noun in group)
        return frozenset(word for group in found for word in group) - {noun}

    def verb(self, word: str) -> str | None:
        """The class of a verb in any form ("pushing" -> "push"); None if it is no known verb."""
        return next((self._verbs[stem] for stem in stems(word) if stem in self._verbs), None)

    def goes(self, noun: str) -> str | None:
        """ "in" for containers, "on" for things to stand on, else None."""
        if noun in self._file.kinds_of_place["into"]:
            return "in"
        return "on" if noun in self._file.kinds_of_place["onto"] else None


def _by_first(entries: Iterable[E], run: Callable[[E], Sequence[str]]) -> dict[str, list[E]]:
    """Entries under the first word of their runs, in their order."""
    found: dict[str, list[E]] = {}
    for entry in entries:
        found.setdefault(run(entry)[0], []).append(entry)
    return found


def compared(adjectives: Iterable[str]) -> Iterator[str]:
    """Adjectives with their comparatives and superlatives ("big", "bigger", "biggest")."""
    for word in adjectives:
        stem = word[:-1] if word.endswith("e") else word
        stem = f"{word[:-1]}i" if word.endswith("y") else stem
        stem = f"{word}{word[-1]}" if _DOUBLING.search(word) else stem
        yield from (word, f"{stem}er", f"{stem}est")


def _turned(table: Words) -> dict[str, frozenset[str]]:
    """For each word of a table, its key included, the keys it stands under."""
    found: dict[str, set[str]] = {}
    for key, entries in table.items():
        for word in (key, *entries):
            found.setdefault(word, set()).add(key)
    return {word: frozenset(keys) for word, keys in found.items()}


@lru_cache(maxsize=1)
def load_lexicon(path: Path = LEXICON, kinds: Path = KINDS) -> Lexicon:
    """The lexicon, read once. Raises ConfigError that names the file and what is wrong."""
    try:
        data = msgspec.convert(tomllib.loads(path.read_text(encoding="utf-8")), _File)
        nouns = kinds.read_text(encoding="utf-8")
    except (OSError, tomllib.TOMLDecodeError, msgspec.ValidationError) as error:
        raise ConfigError(f"{path}: {error}") from error
    return Lexicon(data, Kinds(nouns, str(kinds)))

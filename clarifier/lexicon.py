"""The clarifier's word lists (``lexicon.toml``): nouns, classes, synonyms, relations, verbs."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path

import msgspec

from agent.errors import ConfigError
from clarifier.words import singular, stems

LEXICON = Path(__file__).with_name("lexicon.toml")

Words = dict[str, tuple[str, ...]]


class _Groups(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    groups: tuple[tuple[str, ...], ...]


class _File(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    nouns: Words
    far_nouns: Words
    classes: Words
    words: Words
    synonyms: _Groups
    kin: _Groups
    kinds_of_place: Words
    relations: Words
    verbs: Words
    goals: Words
    speech: Words
    not_typos: Words


class Lexicon:
    """What words mean before any scene is looked at. Immutable; nouns are singular."""

    def __init__(self, file: _File) -> None:
        self._file = file
        self.category: Mapping[str, str] = {
            noun: category for category, nouns in file.nouns.items() for noun in nouns
        }
        self._verbs: dict[str, str] = {}
        for verb_class, verbs in file.verbs.items():
            for verb in verbs:
                self._verbs.setdefault(verb, verb_class)
        self.base_verbs = frozenset(self._verbs)
        self.classes = {word.replace("_", " "): covers for word, covers in file.classes.items()}
        self.place_heads = frozenset(file.words["place_heads"])
        self.place_adjectives = frozenset(file.words["place_adjectives"])
        self.abstract = frozenset(file.words["abstract"])
        self.colors = frozenset(file.words["colors"])
        self.relations = sorted(
            ((tuple(said.split()), name) for name, all_ in file.relations.items() for said in all_),
            key=lambda entry: -len(entry[0]),
        )
        self.idioms = sorted(
            (tuple(said.split()) for said in file.words["idioms"]), key=lambda run: -len(run)
        )
        self.not_typos = frozenset(file.not_typos["words"])
        self.vocabulary = self._all_words()

    def _all_words(self) -> frozenset[str]:
        file = self._file
        tables = [file.nouns, file.far_nouns, file.words, file.verbs, file.goals, file.speech]
        tables.append(file.relations)
        found = [entry for table in tables for entries in table.values() for entry in entries]
        found += [entry for group in self._file.synonyms.groups for entry in group]
        found += [entry for group in self._file.kin.groups for entry in group]
        found += list(self.classes)
        return frozenset(word for entry in found for word in entry.split())

    def words(self, name: str) -> frozenset[str]:
        """A word list of ``[words]``, ``[goals]`` or ``[speech]`` by its name."""
        for table in (self._file.words, self._file.goals, self._file.speech):
            if name in table:
                return frozenset(table[name])
        raise ConfigError(f"{LEXICON}: no word list {name!r}")

    def is_noun(self, phrase: str) -> bool:
        """Whether the word names a kind of thing, seen on tables or not (either number)."""
        one = singular(phrase)
        if phrase in self.category or one in self.category or self.is_class(phrase):
            return True
        if one in self._file.far_nouns["words"] or phrase in self._file.far_nouns["words"]:
            return True
        return bool(self.same(one)) or bool(self.alike(one)) or self.is_anything(phrase)

    def is_class(self, word: str) -> bool:
        """Whether the word is a class word such as "fruit"."""
        return word in self.classes or singular(word) in self.classes

    def is_anything(self, word: str) -> bool:
        """Whether the word stands for any object at all ("thing")."""
        return singular(word) in self._file.words["anything"]

    def same(self, noun: str) -> frozenset[str]:
        """Synonyms of a noun, itself left out."""
        found = (group for group in self._file.synonyms.groups if noun in group)
        return frozenset(word for group in found for word in group) - {noun}

    def alike(self, noun: str) -> frozenset[str]:
        """Nouns of things much like this one: to be offered, never to be taken."""
        found = (group for group in self._file.kin.groups if noun in group)
        return frozenset(word for group in found for word in group) - {noun}

    def covers(self, class_word: str, noun: str) -> bool:
        """Whether a class word ("fruit") covers a noun ("apple")."""
        members = self.classes.get(class_word) or self.classes.get(singular(class_word)) or ()
        return noun in members or self.category.get(noun) in members

    def verb(self, word: str) -> str | None:
        """The class of a verb in any form ("pushing" -> "push"); None if it is no known verb."""
        return next((self._verbs[stem] for stem in stems(word) if stem in self._verbs), None)

    def goes(self, noun: str) -> str | None:
        """ "in" for containers, "on" for things to stand on, else None."""
        if noun in self._file.kinds_of_place["into"]:
            return "in"
        return "on" if noun in self._file.kinds_of_place["onto"] else None


@lru_cache(maxsize=1)
def load_lexicon(path: Path = LEXICON) -> Lexicon:
    """The lexicon, read once. Raises ConfigError that names the file and what is wrong."""
    try:
        data = msgspec.convert(tomllib.loads(path.read_text(encoding="utf-8")), _File)
    except (OSError, tomllib.TOMLDecodeError, msgspec.ValidationError) as error:
        raise ConfigError(f"{path}: {error}") from error
    return Lexicon(data)

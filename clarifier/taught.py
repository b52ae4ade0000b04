"""Words that the person has taught: kept in a file of theirs, read at each sentence.

    [things]
    glorp = "the red block"

    [deeds]
    tower = "stack them by size"

A taught word stands for other words, which are put in its place before anything else is read, so
that what it means is found on the live scene, and checked, like anything said. The file may be
edited while armchat runs; a file that cannot be read is reported, and left as it is.
"""

from __future__ import annotations

import os
import re
import tempfile
import tomllib
from collections.abc import Callable, Mapping
from pathlib import Path

import msgspec
from platformdirs import user_config_path

from agent.errors import ConfigError
from clarifier.words import plural

LONGEST = 200
"""Characters of what a word may stand for."""
MOST = 500
"""Words that can be taught."""
_HEADER = "# Words that armchat was taught. Edit or delete them as you like.\n"
_MADE = r"(?:make|build|do|form|create)(?: me)?(?: an?| the)? "
_OF = r"(?: (?:of|with|from|out of|using) (?P<of>[^,.;]+))?"
_THEM = re.compile(r"\b(?:them|it|those|these)\b")


class Words(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What words stand for: ``things`` a noun phrase, ``deeds`` a command."""

    things: Mapping[str, str] = {}
    deeds: Mapping[str, str] = {}

    def meaning(self, word: str) -> str | None:
        """What a word stands for, if it was taught."""
        return self.things.get(word) or self.deeds.get(word)

    def spelled_out(self, text: str) -> str:
        """The sentence with what the taught words stand for in their places."""
        for word, meaning in self.deeds.items():
            text = re.sub(
                rf"\b(?:{_MADE})?{re.escape(word)}\b{_OF}", _done(meaning), text, flags=re.I
            )
        for word, meaning in self.things.items():
            bare = re.sub(r"^(?:the|a|an|my) ", "", meaning)
            several = re.sub(r"\S+$", lambda last: plural(last.group()), bare)
            text = re.sub(rf"\b{re.escape(plural(word))}\b", several, text, flags=re.I)
            text = re.sub(rf"\b{re.escape(word)}\b", bare, text, flags=re.I)
        return text


def _done(meaning: str) -> Callable[[re.Match[str]], str]:
    """The replacement of a taught deed: "them" in it is what the sentence says after "of"."""

    def replace(match: re.Match[str]) -> str:
        of = match["of"]
        if of is None:
            return meaning
        return _THEM.sub(of, meaning, count=1) if _THEM.search(meaning) else f"{meaning} {of}"

    return replace


class Taught:
    """The words of one person, in a file; without a path in memory only."""

    def __init__(self, path: Path | None = None) -> None:
        self._path = path
        self._words = Words()

    def words(self) -> Words:
        """All of them, as the file says now. Raises ConfigError naming file and fault."""
        if self._path is None or not self._path.is_file():
            return self._words if self._path is None else Words()
        try:
            read = msgspec.convert(tomllib.loads(self._path.read_text(encoding="utf-8")), Words)
        except (OSError, ValueError, msgspec.ValidationError) as error:
            raise ConfigError(f"{self._path}: {error}; mend or delete it") from error
        return read

    def learn(self, word: str, meaning: str, *, deed: bool) -> None:
        """Keep what a word stands for, in the place of what it stood for before.

        Raises ConfigError if the file cannot be read or written, or is full.
        """
        known = self.words()
        if len(known.things) + len(known.deeds) >= MOST and known.meaning(word) is None:
            raise ConfigError(f"I have learnt {MOST} words already: tell me to forget one first")
        things = {key: value for key, value in known.things.items() if key != word}
        deeds = {key: value for key, value in known.deeds.items() if key != word}
        (deeds if deed else things)[word] = meaning[:LONGEST]
        self._keep(Words(things, deeds))

    def forget(self, word: str) -> bool:
        """Whether the word was known; it is not any more. Raises ConfigError."""
        known = self.words()
        if known.meaning(word) is None:
            return False
        self._keep(
            Words(
                {key: value for key, value in known.things.items() if key != word},
                {key: value for key, value in known.deeds.items() if key != word},
            )
        )
        return True

    def _keep(self, words: Words) -> None:
        self._words = words
        if self._path is None:
            return
        lines = [_HEADER]
        for title, table in (("things", words.things), ("deeds", words.deeds)):
            lines.append(f"\n[{title}]\n")
            lines += [f"{_quoted(key)} = {_quoted(table[key])}\n" for key in sorted(table)]
        try:
            self._path.parent.mkdir(parents=True, exist_ok=True)
            handle, name = tempfile.mkstemp(dir=self._path.parent, prefix=".taught-")
            with os.fdopen(handle, "w", encoding="utf-8") as file:
                file.write("".join(lines))
            Path(name).replace(self._path)
        except OSError as error:
            raise ConfigError(f"{self._path}: {error.strerror}: I can't keep that") from error


def _quoted(text: str) -> str:
    """A TOML string: its escapes are those of JSON."""
    return msgspec.json.encode(text).decode()


def default_path() -> Path:
    """Where the words of this person are kept."""
    return user_config_path("armchat") / "words.toml"

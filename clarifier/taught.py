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
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

import msgspec
from platformdirs import user_config_path

from agent.errors import ConfigError
from agent.messages import Dialog, Lesson
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

    def lessons(self) -> tuple[Lesson, ...]:
        """The same as lessons."""
        things = (Lesson(word, meaning) for word, meaning in self.things.items())
        deeds = (Lesson(word, meaning, deed=True) for word, meaning in self.deeds.items())
        return (*things, *deeds)

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


def words_of(lessons: Iterable[Lesson]) -> Words:
    """The words that lessons teach, the later ones in the place of the earlier."""
    things: dict[str, str] = {}
    deeds: dict[str, str] = {}
    for one in lessons:
        (things if one.deed else deeds).pop(one.word, None)
        (deeds if one.deed else things)[one.word] = one.meaning
    return Words(things, deeds)


class Taught:
    """The words of one person, in a file; without a path those of one conversation, in it."""

    def __init__(self, path: Path | None = None) -> None:
        self._path = path

    def words(self, dialog: Dialog) -> Words:
        """All of them, as the file says now. Raises ConfigError naming file and fault."""
        if self._path is None:
            return words_of(dialog.taught)
        if not self._path.is_file():
            return Words()
        try:
            return msgspec.convert(tomllib.loads(self._path.read_text(encoding="utf-8")), Words)
        except (OSError, ValueError, msgspec.ValidationError) as error:
            raise ConfigError(f"{self._path}: {error}; mend or delete it") from error

    def learn(self, dialog: Dialog, lesson: Lesson) -> Dialog:
        """The conversation once a word is kept, in the place of what it stood for before.

        Raises ConfigError if the file cannot be read or written, or there are too many words.
        """
        known = self.words(dialog)
        if len(known.things) + len(known.deeds) >= MOST and known.meaning(lesson.word) is None:
            raise ConfigError(f"I have learnt {MOST} words already: tell me to forget one first")
        lesson = msgspec.structs.replace(lesson, meaning=lesson.meaning[:LONGEST])
        return self._keep(dialog, (*known.lessons(), lesson))

    def forget(self, dialog: Dialog, word: str) -> Dialog:
        """The conversation once a word is forgotten. Raises ConfigError."""
        kept = (one for one in self.words(dialog).lessons() if one.word != word)
        return self._keep(dialog, tuple(kept))

    def _keep(self, dialog: Dialog, lessons: tuple[Lesson, ...]) -> Dialog:
        if self._path is None:
            return msgspec.structs.replace(dialog, taught=lessons)
        words = words_of(lessons)
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
        return dialog


def _quoted(text: str) -> str:
    """A TOML string: its escapes are those of JSON."""
    return msgspec.json.encode(text).decode()


def default_path() -> Path:
    """Where the words of this person are kept."""
    return user_config_path("armchat") / "words.toml"

"""Sentences and programs as the numbers that a pretrained model reads and writes.

Words are sub-words of the model's own tokenizer. Slots and the symbols of programs are pieces of
our vocabulary, each one number: ``~index``, negative, so that it cannot be taken for a word. A
lesson is

    begin, sentence with its slots, <task> | program, <end>

and the model learns what stands behind the bar (translator.finetune).
"""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

import msgspec
from tokenizers import Tokenizer

from agent.errors import TranslatorError
from agent.messages import Kind
from translator.marked import Marked
from translator.vocabulary import (
    DEDENT,
    END,
    INDENT,
    NEWLINE,
    STARTS,
    Piece,
    Vocabulary,
    legible,
    tokenize,
)  # fmt: skip

_SPELT = {NEWLINE: "\n", INDENT: "    ", DEDENT: "\n", END: "\n\n"}
_SPELT |= {symbol: f"# {kind}:" for kind, symbol in STARTS.items()}
"""What a symbol of layout is in text: where its embedding starts from."""


class Words:
    """The tokenizer of a pretrained model in its folder. Raises TranslatorError where it lacks."""

    def __init__(self, folder: Path) -> None:
        try:
            told = (folder / "tokenizer.json").read_text(encoding="utf-8")
            config = msgspec.json.decode((folder / "config.json").read_bytes(), type=dict[str, Any])
        except (OSError, UnicodeDecodeError, msgspec.DecodeError) as error:
            raise TranslatorError(f"no pretrained model in {folder}: {error}") from error
        try:
            self._tokenizer = Tokenizer.from_str(told)
        except Exception as error:  # the tokenizers library raises nothing more particular
            raise TranslatorError(f"no tokenizer in {folder}: {error}") from error
        self.begin: int | None = config.get("bos_token_id")
        self.end: int | None = config.get("eos_token_id")
        self.encode = lru_cache(100_000)(self._encode)

    def _encode(self, text: str) -> tuple[int, ...]:
        return tuple(self._tokenizer.encode(text, add_special_tokens=False).ids)


class Spoken(NamedTuple):
    """One lesson in numbers: words as they are, pieces as ``~index``."""

    sentence: list[int]
    program: list[int]


class Speech:
    """A tokenizer and a vocabulary of pieces."""

    def __init__(self, words: Words, vocabulary: Vocabulary) -> None:
        self._words = words
        self.vocabulary = vocabulary
        self._index = {piece: number for number, piece in enumerate(vocabulary.pieces)}

    def sentence(self, said: Marked, kind: Kind) -> list[int]:
        """The sentence's numbers, the task's symbol last."""
        numbers = [] if self._words.begin is None else [self._words.begin]
        at = 0
        for mark in said.marks:
            # the blank in front of a slot is part of the slot
            numbers += self._words.encode(said.text[at : mark.start].rstrip(" "))
            numbers.append(~self._index[(mark.slot,)])
            at = mark.end
        return [*numbers, *self._words.encode(said.text[at:]), ~self._index[(STARTS[kind],)]]

    def program(self, body: str) -> list[int]:
        """The program's numbers, the end's last. Raises TranslatorError for an unknown token."""
        pieces = self.vocabulary.encode([*tokenize(body), END])
        return [~piece for piece in pieces]

    def spelling(self, piece: Piece) -> tuple[int, ...]:
        """The words that a piece would be written with, none of them ours; at least one."""
        text = "".join(_SPELT[token] for token in piece) if set(piece) <= set(_SPELT) else ""
        return self._words.encode(text or legible([_SPELT.get(one, one) for one in piece]))

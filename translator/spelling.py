"""How a program's symbols are written with the numbers that a language model tells apart.

`InPieces`: each symbol is one number, for a model that learnt ours. `InWords`: each symbol is what
it is in text, in a model's own sub-words, for a model as it came; symbol by symbol, so that grammar
and scope, which speak of symbols, say which sub-word may come next (translator.subwords).
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import NamedTuple, Protocol

from translator.speech import Words
from translator.vocabulary import DEDENT, END, INDENT, NEWLINE, Vocabulary, spaced

TAB = "    "
_LAYOUT = {NEWLINE, INDENT, DEDENT, END}


class Place(NamedTuple):
    """Where in a program's text a symbol is to be written: how deep the line is, and the last two
    tokens of the line, none at its start."""

    depth: int = 0
    line: tuple[str, ...] = ()

    def behind(self, tokens: Sequence[str]) -> Place:
        """The place behind these tokens."""
        depth, line = self
        for token in tokens:
            depth += (token == INDENT) - (token == DEDENT)
            line = () if token in _LAYOUT else (*line, token)[-2:]
        return Place(depth, line)


class Spelt(NamedTuple):
    """A piece of the vocabulary by index, and the numbers that it is written with."""

    piece: int
    numbers: tuple[int, ...]


class Spelling(Protocol):
    """What pieces are written with. Numbers are columns of what the model tells."""

    def begins(self, place: Place) -> Mapping[int, Sequence[Spelt]]:
        """The pieces that may be written there, by their first number."""
        ...

    def silent(self, place: Place) -> Sequence[int]:
        """The pieces that may come there and are not written at all."""
        ...


class InPieces:
    """Every piece is a number of its own."""

    def __init__(self, vocabulary: Vocabulary) -> None:
        self._begins = {n: (Spelt(n, (n,)),) for n in range(len(vocabulary.pieces))}

    def begins(self, place: Place) -> Mapping[int, Sequence[Spelt]]:
        """All of them, wherever."""
        return self._begins

    def silent(self, place: Place) -> Sequence[int]:
        """None."""
        return ()


class InWords:
    """Single tokens as text, in sub-words; ``rows``: the model's numbers of the sub-words, by
    column."""

    def __init__(self, vocabulary: Vocabulary, words: Words) -> None:
        self._single = [(n, piece[0]) for n, piece in enumerate(vocabulary.pieces)
                        if len(piece) == 1 and not _unwritten(piece[0])]  # fmt: skip
        self._silent = [vocabulary.symbol(INDENT), vocabulary.symbol(DEDENT)]
        self._encode = words.encode
        everywhere = [text for _, token in self._single for text in _texts(token)]
        self.rows = sorted({number for text in everywhere for number in words.encode(text)})
        self._column = {row: number for number, row in enumerate(self.rows)}
        self.begins = lru_cache(4096)(self._begins)

    def _begins(self, place: Place) -> Mapping[int, Sequence[Spelt]]:
        """The tokens with the blanks that belong in front of them there."""
        found = defaultdict[int, list[Spelt]](list)
        for piece, token in self._single:
            numbers = self.numbers(written(token, place))
            found[numbers[0]].append(Spelt(piece, numbers))
        return found

    def silent(self, place: Place) -> Sequence[int]:
        """How deep a line is, is told by the blanks in front of its first word."""
        return () if place.line else self._silent

    def numbers(self, text: str) -> tuple[int, ...]:
        """Columns of a token's text. Raises KeyError for a text that no token has anywhere."""
        return tuple(self._column[number] for number in self._encode(text))

    def program(self, tokens: Sequence[str]) -> list[int]:
        """The model's own numbers of a whole program, written token by token."""
        numbers, place = list[int](), Place()
        for token in tokens:
            if token not in (INDENT, DEDENT):
                numbers += self._encode(written(token, place))
            place = place.behind([token])
        return numbers


def _unwritten(token: str) -> bool:
    return token in (INDENT, DEDENT) or (token.startswith("<") and token[1:-1].isalpha()
                                         and token not in (NEWLINE, END))  # fmt: skip


def _texts(token: str) -> list[str]:
    """What a token may look like, with what may stand in front of it."""
    if token in (NEWLINE, END):
        return ["\n"]
    return [token, f" {token}", *(TAB * depth + token for depth in range(1, 9))]


def written(token: str, place: Place) -> str:
    """A token as text at its place: blanks in front included. A program ends with an empty line."""
    if token in (NEWLINE, END):
        return "\n"
    if not place.line:
        return TAB * place.depth + token
    return spaced([*place.line, token])[len(spaced(place.line)) :]

"""Beam search for a language model under the program grammar, whatever it spells programs with.

Grammar and scope (`translator.grammar`) speak of the vocabulary's pieces; the model speaks of
numbers, one or several to a piece (`translator.spelling`). A hypothesis keeps every way to read the
numbers so far as pieces, and only numbers that carry one of them on may come next: so no malformed
program can be written, whichever model it is.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from agent.messages import Kind
from translator.beam import worth_following
from translator.grammar import Grammar, Prefix
from translator.spelling import Place, Spelling, Spelt
from translator.vocabulary import END, Vocabulary

LONGEST = 240
"""Numbers of a program at most; a hypothesis that reaches it without an end is dropped."""

Array = NDArray[np.float32]


class Model(Protocol):
    """A language model that has read a sentence and writes B hypotheses side by side."""

    def begin(self, numbers: Sequence[int]) -> Array:
        """Read a prompt; log-probabilities (1, C) of the first number."""
        ...

    def step(self, rows: Sequence[int], numbers: Sequence[int]) -> Array:
        """Keep these hypotheses, each with one more number: log-probabilities (B, C)."""
        ...


class Way(NamedTuple):
    """One way to read the numbers as pieces. ``inside``: the piece that is half written, ``at`` how
    many of its numbers are."""

    pieces: tuple[int, ...]
    prefix: Prefix
    place: Place = Place()
    inside: Spelt | None = None
    at: int = 0


class Hypothesis(NamedTuple):
    """All ways to read what was written, and its log-probability (nats)."""

    ways: tuple[Way, ...]
    logprob: float
    length: int


class Found(NamedTuple):
    """A finished program in pieces, ``<end>`` last; ``length``: in the model's own numbers."""

    pieces: tuple[int, ...]
    logprob: float
    length: int


class Writer:
    """The search for one vocabulary and one way to spell it."""

    def __init__(self, vocabulary: Vocabulary, spelling: Spelling) -> None:
        self._pieces = vocabulary.pieces
        self._grammar = Grammar(vocabulary)
        self._spelling = spelling
        self._end = vocabulary.symbol(END)

    def search(
        self, model: Model, prompt: Sequence[int], kind: Kind, things: set[str], width: int,
        longest: int = LONGEST,
    ) -> list[Found]:  # fmt: skip
        """The best ``width`` programs over these things, best first; ``longest``: in numbers."""
        usable = self._grammar.usable(kind, things)
        start = Way((), self._grammar.start())
        beam = [Hypothesis((start,), 0.0, 0)]
        finished: list[Found] = []
        logprobs = model.begin(prompt)
        while beam and beam[0].length < longest:
            grown = self._grow(beam, logprobs, usable, width)
            finished += [found for _, _, one in grown for found in self._over(one)]
            least = worth_following([one.logprob for one in finished], width)
            going = [
                entry for entry in grown
                if entry[2].logprob > least and not any(self._over(entry[2]))
            ]  # fmt: skip
            beam = [one for _, _, one in going]
            if not beam:
                break
            logprobs = model.step([row for row, _, _ in going], [number for _, number, _ in going])
        return sorted(finished, key=lambda one: -one.logprob)[:width]

    def _grow(
        self, beam: Sequence[Hypothesis], logprobs: Array, usable: NDArray[np.bool_], width: int
    ) -> list[tuple[int, int, Hypothesis]]:
        """The best ``width`` longer hypotheses: the row each comes from, its number, itself."""
        grown = []
        for row, one in enumerate(beam):
            ways = [way for own in one.ways for way in self._with_silent(own, usable)]
            found = 0
            for number in np.argsort(-logprobs[row]):
                longer = tuple(
                    w for way in ways for w in self._carried_on(way, int(number), usable)
                )
                if longer:
                    logprob = one.logprob + float(logprobs[row, number])
                    grown.append((row, int(number), Hypothesis(longer, logprob, one.length + 1)))
                    found += 1
                if found == width:
                    break
        grown.sort(key=lambda entry: -entry[2].logprob)
        return grown[:width]

    def _with_silent(self, way: Way, usable: NDArray[np.bool_]) -> Iterator[Way]:
        """The way as it is, and with pieces behind it that are not written."""
        yield way
        if way.inside is None:
            for piece in self._spelling.silent(way.place):
                longer = self._extended(way, piece, usable)
                if longer is not None:
                    yield from self._with_silent(longer, usable)

    def _carried_on(self, way: Way, number: int, usable: NDArray[np.bool_]) -> Iterator[Way]:
        """The ways to read one more number behind a way."""
        if way.inside is not None:
            if way.inside.numbers[way.at] == number:
                yield from self._read(way, way.inside, way.at + 1, usable)
            return
        for spelt in self._spelling.begins(way.place).get(number, ()):
            if self._extended(way, spelt.piece, usable) is not None:
                yield from self._read(way, spelt, 1, usable)

    def _read(self, way: Way, spelt: Spelt, at: int, usable: NDArray[np.bool_]) -> Iterator[Way]:
        if at < len(spelt.numbers):
            yield way._replace(inside=spelt, at=at)
            return
        longer = self._extended(way, spelt.piece, usable)
        if longer is not None:
            yield longer

    def _extended(self, way: Way, piece: int, usable: NDArray[np.bool_]) -> Way | None:
        prefix = self._grammar.extend(way.prefix, piece) if usable[piece] else None
        if prefix is None:
            return None
        return Way((*way.pieces, piece), prefix, way.place.behind(self._pieces[piece]))

    def _over(self, one: Hypothesis) -> list[Found]:
        return [
            Found(way.pieces, one.logprob, one.length)
            for way in one.ways
            if way.inside is None and way.pieces[-1:] == (self._end,)
        ]

"""Lessons for a pretrained model, written down once as numbers and kept in one file."""

from __future__ import annotations

import random
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, islice
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from translator.corpus.generate import Generator, Sample
from translator.corpus.seed import kept, load_seeds, share_of
from translator.speech import Speech, Spoken
from translator.vocabulary import tokenize

VALID = 1_000
"""Lessons of wordings held out."""
CHUNK = 16_384
"""Lessons among which those of like length are found."""


class Texts(NamedTuple):
    """Lessons one behind the other: numbers (sum of lengths,), lengths of sentence and program
    (lessons, 2)."""

    numbers: NDArray[np.uint16]
    sizes: NDArray[np.uint16]

    def batches(self, budget: int, chance: np.random.Generator) -> Iterator[NDArray[np.int64]]:
        """Indices of all lessons in random order, those of like length together: as many a batch
        as fit, padded, into ``budget`` numbers."""
        lengths = self.sizes.sum(1).astype(np.int64)
        order = chance.permutation(len(lengths))
        found = []
        for start in range(0, len(order), CHUNK):
            alike = order[start : start + CHUNK]
            alike = alike[np.argsort(lengths[alike], kind="stable")]
            while len(alike):
                padded = lengths[alike] * np.arange(1, len(alike) + 1)
                count = max(1, int(np.searchsorted(padded, budget, side="right")))
                found.append(alike[:count])
                alike = alike[count:]
        for number in chance.permutation(len(found)):
            yield found[number]


class Written(NamedTuple):
    """Lessons over N words of the base, given by ``rows`` (N,), and V pieces numbered behind them.

    ``spelling``: the words that each piece would be written with, as indices into ``rows``.
    """

    rows: NDArray[np.int64]
    spelling: list[list[int]]
    train: Texts
    valid: Texts

    def save(self, path: Path) -> None:
        """Write to one file, complete or not at all."""
        unfinished = path.with_suffix(".part.npz")
        sizes = np.array([len(one) for one in self.spelling])
        flat = np.array(list(chain.from_iterable(self.spelling)))
        np.savez_compressed(
            unfinished, rows=self.rows, spelt=flat, spelt_sizes=sizes,
            train=self.train.numbers, train_sizes=self.train.sizes,
            valid=self.valid.numbers, valid_sizes=self.valid.sizes,
        )  # fmt: skip
        unfinished.rename(path)

    @classmethod
    def load(cls, path: Path) -> Written:
        """Read what `save` wrote."""
        with np.load(path) as file:
            ends = np.cumsum(file["spelt_sizes"])[:-1]
            spelling = [one.tolist() for one in np.split(file["spelt"], ends)]
            train = Texts(file["train"], file["train_sizes"])
            return cls(file["rows"], spelling, train, Texts(file["valid"], file["valid_sizes"]))


def write(speech: Speech, count: int, share: float, seed: int) -> Written:
    """``count`` lessons grown from a share of the wordings, and `VALID` from those held out."""
    seeds = load_seeds()
    grown = Generator(share_of(kept(seeds, held_out=False), share), random.Random(seed))
    others = Generator(kept(seeds, held_out=True), random.Random(seed + 1))
    return _compact(
        speech, list(_spoken(grown, speech, count)), list(_spoken(others, speech, VALID))
    )


def _spoken(samples: Iterable[Sample], speech: Speech, count: int) -> Iterator[Spoken]:
    known = {piece[0] for piece in speech.vocabulary.pieces if len(piece) == 1}
    readable = (one for one in samples if set(tokenize(one.program)) <= known)
    for one in islice(readable, count):
        yield Spoken(speech.sentence(one.sentence, one.kind), speech.program(one.program))


def _compact(speech: Speech, train: Sequence[Spoken], valid: Sequence[Spoken]) -> Written:
    """The lessons over the words that occur in them."""
    spelt = [speech.spelling(piece) for piece in speech.vocabulary.pieces]
    said = chain.from_iterable(one.sentence for one in chain(train, valid))
    rows = sorted({number for number in chain(said, *spelt) if number >= 0})
    place = {word: number for number, word in enumerate(rows)}
    place |= {~piece: len(rows) + piece for piece in range(len(spelt))}

    def texts(lessons: Sequence[Spoken]) -> Texts:
        numbers = (place[number] for one in lessons for number in chain(*one))
        sizes = [(len(one.sentence), len(one.program)) for one in lessons]
        return Texts(np.fromiter(numbers, np.uint16), np.array(sizes, np.uint16))

    spelling = [[place[word] for word in one] for one in spelt]
    return Written(np.array(rows, np.int64), spelling, texts(train), texts(valid))

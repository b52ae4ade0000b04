"""What a model learns from: sentences with their programs, grown chunk by chunk, as padded numbers.

Nothing here needs torch, so that other processes can make lessons ahead while the model learns.
"""

from __future__ import annotations

import random
from collections import deque
from collections.abc import Callable, Generator, Sequence
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from functools import cache, lru_cache
from itertools import chain, islice
from multiprocessing import get_context
from pathlib import Path
from typing import NamedTuple
from zlib import crc32

import msgspec
import numpy as np
from numpy.typing import NDArray
from tokenizers import Tokenizer

from agent.messages import Kind
from translator.corpus import generate
from translator.corpus.load import load, share_of_pairs
from translator.corpus.seed import Seed, kept, load_seeds, share_of
from translator.data import Sample, epoch
from translator.embed import sentence_tokenizer
from translator.marked import Mark, slot_ids
from translator.mined import Pair, mine, sources
from translator.vocabulary import END, PAD, STARTS, Vocabulary, tokenize

CHUNK = 6_000
"""Grown sentences at a time."""
AHEAD = 3
"""Chunks made ahead of the one that the model learns from, for each process that makes them."""
PADDING = -100
"""Target index that the loss ignores."""
MOST_KEPT = 50_000
"""Programs whose symbols are kept: most come again and again."""
VALID = 1_000
"""Lessons that a model of seeds or docstrings is judged by, of wordings that it never sees."""
HELD_OUT = 20
"""One docstring in so many is held out."""
_TASKS: tuple[Kind, ...] = ("arrange", "manipulate")


class Lesson(NamedTuple):
    """One sentence with its marks, and the program it means."""

    text: str
    marks: tuple[Mark, ...]
    program: str
    kind: Kind


class PaperLessons(msgspec.Struct, frozen=True):
    """The expert pairs; a chunk is a share ``wordings`` of the training split ``copies`` times,
    nouns swapped, a share ``joined`` of it joined with other pairs. The valid split is whole."""

    tasks: tuple[Kind, ...]
    copies: int
    joined: float
    seed: int
    wordings: float = 1.0

    def chunk(self, number: int) -> list[Lesson]:
        """One chunk of lessons; the same number gives the same ones."""
        chance = random.Random(f"paper {self.seed} {number}")
        learnt = self._split("train", self.wordings)
        return self._plain(epoch(learnt, self.copies, chance, self.joined))

    def valid(self) -> list[Lesson]:
        """The valid split."""
        return self._plain(self._split("valid"))

    def _split(self, name: str, share: float = 1.0) -> list[Sample]:
        splits = [[pair for pair in load(task) if pair.split == name] for task in self.tasks]
        pairs = chain.from_iterable(share_of_pairs(split, share) for split in splits)
        return [Sample(pair.say, pair.program, pair.kind) for pair in pairs]

    def _plain(self, samples: Sequence[Sample]) -> list[Lesson]:
        return [Lesson(one.say, (), one.program, one.kind) for one in samples]


class SeedLessons(msgspec.Struct, frozen=True):
    """Sentences grown from the seeds, from a share of their ``wordings``; one wording in twenty is
    held out, and valid ones are grown from those."""

    wordings: float
    seed: int

    def chunk(self, number: int) -> list[Lesson]:
        """One chunk of lessons; the same number gives the same ones."""
        chance = random.Random(f"seeds {self.seed} {number}")
        return self._grown(_learnt(self.wordings), chance, CHUNK)

    def valid(self) -> list[Lesson]:
        """Grown from the held-out wordings."""
        return self._grown(kept(load_seeds(), held_out=True), random.Random(self.seed + 1), VALID)

    def _grown(self, seeds: Sequence[Seed], chance: random.Random, count: int) -> list[Lesson]:
        return [
            Lesson(one.sentence.text, one.sentence.marks, one.program, one.kind)
            for one in islice(generate.Generator(seeds, chance), count)
        ]


class DocstringLessons(msgspec.Struct, frozen=True):
    """Docstrings and bodies of the Python code that is installed; a docstring in twenty is held
    out. No task is theirs: each has either one's symbol in front, by its checksum."""

    seed: int

    def chunk(self, number: int) -> list[Lesson]:
        """One chunk of lessons; the same number gives the same ones."""
        chance = random.Random(f"docstrings {self.seed} {number}")
        learnt = _docstrings(held_out=False)
        return chance.sample(learnt, min(CHUNK, len(learnt)))

    def valid(self) -> list[Lesson]:
        """Held-out ones."""
        return list(_docstrings(held_out=True)[:VALID])


Lessons = PaperLessons | SeedLessons | DocstringLessons


@cache
def _docstrings(*, held_out: bool) -> tuple[Lesson, ...]:
    checked = ((crc32(pair.said.text.encode()), pair) for pair in _mined())
    return tuple(
        Lesson(*pair.said, pair.body, _TASKS[check % 2])
        for check, pair in checked if (check % HELD_OUT == 0) == held_out
    )  # fmt: skip


@cache
def _mined() -> list[Pair]:
    return mine(chain.from_iterable(source.files for source in sources()))


@cache
def _learnt(wordings: float) -> tuple[Seed, ...]:
    return share_of(kept(load_seeds(), held_out=False), wordings)


class Padded(NamedTuple):
    """B lessons of like length: word pieces ``ids`` (B, T), their ``slots`` (B, T; 0: none),
    ``lengths`` (B,), program symbols ``inputs`` (B, L), ``targets`` (B, L; PADDING beyond the
    end)."""

    ids: NDArray[np.int64]
    slots: NDArray[np.int64]
    lengths: NDArray[np.int64]
    inputs: NDArray[np.int64]
    targets: NDArray[np.int64]


class Packer:
    """Lessons to padded batches."""

    def __init__(self, tokenizer: Tokenizer, vocabulary: Vocabulary, size: int) -> None:
        self._tokenizer, self._size = tokenizer, size
        self._single = {piece[0] for piece in vocabulary.pieces if len(piece) == 1}
        self._pad, self._end = vocabulary.symbol(PAD), vocabulary.symbol(END)
        self._starts = {kind: vocabulary.symbol(start) for kind, start in STARTS.items()}
        encode = vocabulary.encoder()
        self._symbols = lru_cache(MOST_KEPT)(lambda program: self._spelt(program, encode))

    def __call__(self, lessons: Sequence[Lesson]) -> list[Padded]:
        """Batches of lessons of like length, in an order drawn from the lessons' own; lessons
        with tokens that the vocabulary lacks are left out."""
        readable = [one for one in lessons if self._symbols(one.program) is not None]
        batches = []
        chunk = self._size * 8
        for start in range(0, len(readable), chunk):
            alike = sorted(readable[start : start + chunk], key=lambda one: len(one.program))
            batches += [alike[i : i + self._size] for i in range(0, len(alike), self._size)]
        random.Random(len(readable)).shuffle(batches)
        return [self._padded(batch) for batch in batches]

    def _padded(self, lessons: Sequence[Lesson]) -> Padded:
        read = [self._tokenizer.encode(one.text) for one in lessons]
        slots = [slot_ids(r.offsets, one.marks) for r, one in zip(read, lessons, strict=True)]
        programs = [self._symbols(one.program) or () for one in lessons]
        starts = [self._starts[one.kind] for one in lessons]
        return Padded(
            _rows([one.ids for one in read], 0),
            _rows(slots, 0),
            np.array([len(one.ids) for one in read], dtype=np.int64),
            _rows([(start, *one) for start, one in zip(starts, programs, strict=True)], self._pad),
            _rows([(*one, self._end) for one in programs], PADDING),
        )

    def _spelt(
        self, program: str, encode: Callable[[Sequence[str]], list[int]]
    ) -> tuple[int, ...] | None:
        tokens = tokenize(program)
        return tuple(encode(tokens)) if set(tokens) <= self._single else None


def _rows(rows: Sequence[Sequence[int]], fill: int) -> NDArray[np.int64]:
    table = np.full((len(rows), max(map(len, rows))), fill, dtype=np.int64)
    for row, values in zip(table, rows, strict=True):
        row[: len(values)] = values
    return table


class Growth(NamedTuple):
    """What a process needs to make chunks of batches."""

    lessons: Lessons
    vocabulary: Vocabulary
    weights: Path
    size: int


def grown(growth: Growth, number: int) -> list[Padded]:
    """One chunk of lessons as batches."""
    return _packer(growth.weights, growth.vocabulary, growth.size)(growth.lessons.chunk(number))


@cache
def _packer(weights: Path, vocabulary: Vocabulary, size: int) -> Packer:
    return Packer(sentence_tokenizer(weights), vocabulary, size)


def stream(growth: Growth, growers: int, first: int = 0) -> Generator[list[Padded], None, None]:
    """Chunk after chunk without end, from the ``first`` on, made ahead by so many processes (0: by
    a thread)."""
    pool: Executor = (
        ProcessPoolExecutor(growers, get_context("spawn")) if growers else ThreadPoolExecutor(1)
    )
    with pool:
        ahead: deque[Future[list[Padded]]] = deque()
        number = first
        try:
            while True:
                while len(ahead) < AHEAD * max(1, growers):
                    ahead.append(pool.submit(grown, growth, number))
                    number += 1
                yield ahead.popleft().result()
        finally:
            for future in ahead:
                future.cancel()

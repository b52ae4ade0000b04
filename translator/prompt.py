"""What a pretrained model is shown before it translates: the functions there are, and the sentences
most like the one at hand with their programs.

The sentences are grown from the seeds and found by the words and word pairs that they share, the
rarer the better. Nothing is learnt.
"""

from __future__ import annotations

import math
import random
import re
from collections import Counter, defaultdict
from collections.abc import Sequence
from itertools import islice, pairwise
from typing import NamedTuple

from agent.language.prelude import functions
from agent.messages import Kind
from translator.corpus.generate import Generator, Sample
from translator.corpus.seed import kept, load_seeds
from translator.marked import Marked
from translator.speech import Words
from translator.spelling import InWords
from translator.vocabulary import END, Vocabulary, tokenize

SHOWN = 8
"""Pairs in front of a sentence, the likest last."""
POOL = 20_000
"""Sentences that they are taken from."""
_WORD = re.compile(r"[a-z']+|[mgdtn]\d+")


def named(said: Marked) -> str:
    """The sentence with each slot by its name."""
    text, at = "", 0
    for mark in said.marks:
        text += said.text[at : mark.start] + mark.slot
        at = mark.end
    return text + said.text[at:]


def features(text: str) -> set[str]:
    """Words, which kind of slot stands where, and neighbours."""
    words = [re.sub(r"\d", "", word) for word in _WORD.findall(text.lower())]
    return {*words, *(f"{one} {other}" for one, other in pairwise(["", *words, ""]))}


class Shown(NamedTuple):
    """A pair of the pool."""

    say: str
    program: str
    weight: float


class Pairs:
    """A pool of pairs of one task, to be searched by likeness."""

    def __init__(self, samples: Sequence[Sample], kind: Kind) -> None:
        texts = [(named(one.sentence), one.program) for one in samples if one.kind == kind]
        found = [features(say) for say, _ in texts]
        counts = Counter(feature for one in found for feature in one)
        self._worth = {one: math.log(len(texts) / count) for one, count in counts.items()}
        self._having = defaultdict[str, list[int]](list)
        for number, one in enumerate(found):
            for feature in one:
                self._having[feature].append(number)
        self._pairs = [
            Shown(say, program, math.sqrt(sum(self._worth[f] for f in one)) or 1.0)
            for (say, program), one in zip(texts, found, strict=True)
        ]

    def like(self, say: str, count: int) -> list[Shown]:
        """The ``count`` likest pairs with different programs, the likest last."""
        shared = defaultdict[int, float](float)
        for feature in features(say):
            for number in self._having.get(feature, ()):
                shared[number] += self._worth[feature]
        ranked = sorted(shared, key=lambda number: -shared[number] / self._pairs[number].weight)
        chosen: dict[str, Shown] = {}
        for number in ranked:
            chosen.setdefault(self._pairs[number].program, self._pairs[number])
            if len(chosen) == count:
                break
        return list(chosen.values())[::-1]


class Examples(NamedTuple):
    """What is shown, in a model's own numbers; ``longest``: how many the longest program has."""

    numbers: list[int]
    longest: int


class Prompts:
    """Prompts for one model, in its own numbers."""

    def __init__(self, words: Words, vocabulary: Vocabulary, pool: int = POOL) -> None:
        self._words = words
        self._written = InWords(vocabulary, words)
        grown = list(islice(Generator(kept(load_seeds(), held_out=False), random.Random(0)), pool))
        self._pairs = {kind: Pairs(grown, kind) for kind in ("arrange", "manipulate")}

    def page(self, kind: Kind) -> list[int]:
        """What every prompt of a task begins with: the functions that programs may call."""
        begin = [] if self._words.begin is None else [self._words.begin]
        usages = "\n".join(one.usage for one in functions(kind).values())
        head = f"Instructions to a robot as short Python programs. Functions:\n{usages}\n\n"
        return [*begin, *self._words.encode(head)]

    def examples(self, said: Marked, kind: Kind) -> Examples:
        """The likest pairs and the sentence itself, to stand behind the page."""
        say = named(said)
        numbers, longest = list[int](), 0
        for pair in self._pairs[kind].like(say, SHOWN):
            program = self._written.program([*tokenize(pair.program), END])
            numbers += [*self._words.encode(f"# {pair.say}\n"), *program]
            longest = max(longest, len(program))
        return Examples([*numbers, *self._words.encode(f"# {say}\n")], longest)

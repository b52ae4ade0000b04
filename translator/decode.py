"""Beam search over the decoder step, under the grammar mask, in numpy."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from agent.messages import Kind
from translator.beam import worth_following
from translator.grammar import Grammar, Prefix
from translator.networks import Array, Ensemble
from translator.vocabulary import END, STARTS, Vocabulary

LONGEST = 240
"""Pieces of a program at most; a hypothesis that reaches it without an end is dropped."""


class Hypothesis(NamedTuple):
    """Pieces so far, their log-probability (nats), each token's attention over the sentence."""

    tokens: tuple[int, ...]
    logprob: float
    prefix: Prefix
    attention: tuple[Array, ...] = ()


class Decoder:
    """The search for programs over the V pieces of a model's vocabulary."""

    def __init__(self, folder: Path, vocabulary: Vocabulary) -> None:
        self._ensemble = Ensemble(folder)
        self._vocabulary = vocabulary
        self._grammar = Grammar(vocabulary)
        self._end = vocabulary.symbol(END)

    def search(
        self, words: Array, kind: Kind, nouns: set[str], width: int,
        slots: NDArray[np.int64] | None = None,
    ) -> list[Hypothesis]:  # fmt: skip
        """The best ``width`` programs, best first. words: embeddings (T, E), slots (T,)."""
        states = self._ensemble.begin(words, slots)
        usable = np.flatnonzero(self._grammar.usable(kind, nouns))
        beam = [Hypothesis((), 0.0, self._grammar.start())]
        last = np.array([self._vocabulary.symbol(STARTS[kind])])
        finished: list[Hypothesis] = []
        while beam and len(beam[0].tokens) < LONGEST:
            logprobs, weights, states = self._ensemble.step(last, states)
            rows, longer = self._grow(beam, logprobs, weights, usable, width)
            finished += [one for one in longer if one.tokens[-1] == self._end]
            least = worth_following([one.logprob for one in finished], width)
            open_rows = [i for i, one in enumerate(longer)
                         if one.tokens[-1] != self._end and one.logprob > least]  # fmt: skip
            beam = [longer[i] for i in open_rows]
            if not beam:
                break
            states = self._ensemble.kept(states, [rows[i] for i in open_rows])
            last = np.array([one.tokens[-1] for one in beam], dtype=np.int64)
        return sorted(finished, key=lambda one: -one.logprob)[:width]

    def _grow(
        self, beam: list[Hypothesis], logprobs: Array, weights: Array, usable: NDArray[np.intp],
        width: int,
    ) -> tuple[list[int], list[Hypothesis]]:  # fmt: skip
        """The best ``width`` continuations of a beam, and the row of the beam each comes from."""
        start = np.array([[one.logprob] for one in beam])
        scores = start + logprobs[:, usable]
        rows, longer = list[int](), list[Hypothesis]()
        for place in np.argsort(-scores, axis=None):
            row, column = divmod(int(place), len(usable))
            before, index = beam[row], int(usable[column])
            prefix = self._grammar.extend(before.prefix, index)
            if prefix is not None:
                rows.append(row)
                seen = (*before.attention, weights[row])
                tokens = (*before.tokens, index)
                longer.append(Hypothesis(tokens, float(scores[row, column]), prefix, seen))
                if len(longer) == width:
                    break
        return rows, longer

"""Beam search over the decoder step, under the grammar mask, in numpy."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from agent.messages import Kind
from translator.embed import session
from translator.grammar import Grammar, Prefix
from translator.vocabulary import END, STARTS, Vocabulary

LONGEST = 240
"""Pieces of a program at most; a hypothesis that reaches it without an end is dropped."""

Array = NDArray[np.float32]


class Hypothesis(NamedTuple):
    """Pieces so far, their log-probability (nats), each token's attention over the sentence."""

    tokens: tuple[int, ...]
    logprob: float
    prefix: Prefix
    attention: tuple[Array, ...] = ()


State = dict[str, Array]
"""What a network's next step starts from, by the name of the graph's input."""


class Network:
    """One trained model, served by onnxruntime: the two graphs of `translator.export`."""

    def __init__(self, folder: Path) -> None:
        self._sentence = session(folder / "sentence.onnx")
        self._step = session(folder / "step.onnx")
        self._started = [one.name for one in self._sentence.get_outputs()]
        self._told = [one.name for one in self._step.get_outputs()]
        self._handed_on = [name for name in self._started if f"{name}_next" in self._told]

    def begin(self, words: Array, slots: NDArray[np.int64] | None) -> State:
        """The state in front of a program's first symbol. words: (T, E), slots (T,)."""
        fed = {"words": words[None]} | ({} if slots is None else {"slots": slots[None]})
        return dict(zip(self._started, self._sentence.run(None, fed), strict=True))

    def step(self, tokens: NDArray[np.int64], state: State) -> tuple[Array, Array, State]:
        """One more symbol for each of B hypotheses: log-probabilities (B, V), attention (B, T),
        and the state behind it."""
        told = dict(zip(self._told, self._step.run(None, {"token": tokens} | state), strict=True))
        logits = told["logits"]
        peak = logits.max(-1, keepdims=True)
        logprobs = logits - peak - np.log(np.exp(logits - peak).sum(-1, keepdims=True))
        handed_on = {name: told[f"{name}_next"] for name in self._handed_on}
        return logprobs, told["attention"], state | handed_on

    def kept(self, state: State, rows: list[int]) -> State:
        """The state of these hypotheses alone."""
        return state | {name: state[name][rows] for name in self._handed_on}


def networks(folder: Path) -> list[Network]:
    """The networks of a model: that of the folder, or those of its subfolders side by side.

    Raises TranslatorError naming a missing file.
    """
    several = sorted(path.parent for path in folder.glob("*/step.onnx*"))
    return [Network(one) for one in several or [folder]]


class Decoder:
    """Trained models with one vocabulary of V pieces, which speak with one voice: the mean of
    their probabilities, symbol by symbol."""

    def __init__(self, folder: Path, vocabulary: Vocabulary) -> None:
        self._networks = networks(folder)
        self._vocabulary = vocabulary
        self._grammar = Grammar(vocabulary)
        self._end = vocabulary.symbol(END)

    def search(
        self, words: Array, kind: Kind, nouns: set[str], width: int,
        slots: NDArray[np.int64] | None = None,
    ) -> list[Hypothesis]:  # fmt: skip
        """The best ``width`` programs, best first. words: embeddings (T, E), slots (T,)."""
        states = [network.begin(words, slots) for network in self._networks]
        usable = self._grammar.usable(kind, nouns)
        beam = [Hypothesis((), 0.0, self._grammar.start())]
        last = np.array([self._vocabulary.symbol(STARTS[kind])])
        finished: list[Hypothesis] = []
        while beam and len(beam[0].tokens) < LONGEST:
            logprobs, weights, states = self._step(last, states)
            rows, longer = self._grow(beam, logprobs, weights, usable, width)
            finished += [one for one in longer if one.tokens[-1] == self._end]
            open_rows = [i for i, one in enumerate(longer) if one.tokens[-1] != self._end]
            beam = [longer[i] for i in open_rows]
            if _settled(finished, beam, width):
                break
            keep = [rows[i] for i in open_rows]
            states = [
                network.kept(state, keep)
                for network, state in zip(self._networks, states, strict=True)
            ]
            last = np.array([one.tokens[-1] for one in beam], dtype=np.int64)
        return sorted(finished, key=lambda one: -one.logprob)[:width]

    def _step(
        self, tokens: NDArray[np.int64], states: list[State]
    ) -> tuple[Array, Array, list[State]]:
        """What the networks say together: log-probabilities, attention; and their states."""
        told = [
            network.step(tokens, state)
            for network, state in zip(self._networks, states, strict=True)
        ]
        logprobs = np.logaddexp.reduce([one for one, _, _ in told]) - np.log(len(told))
        attention = np.mean([weights for _, weights, _ in told], axis=0)
        return logprobs, attention, [state for _, _, state in told]

    def _grow(
        self, beam: list[Hypothesis], logprobs: Array, weights: Array, usable: NDArray[np.bool_],
        width: int,
    ) -> tuple[list[int], list[Hypothesis]]:  # fmt: skip
        """The best ``width`` continuations of a beam, and the row of the beam each comes from."""
        options: list[tuple[float, int, Hypothesis]] = []
        for row, one in enumerate(beam):
            scores = np.where(usable, logprobs[row], -np.inf)
            for index in self._permitted(one.prefix, scores, width):
                prefix = self._grammar.extend(one.prefix, index)
                assert prefix is not None
                logprob = one.logprob + float(scores[index])
                attention = (*one.attention, weights[row])
                tokens = (*one.tokens, index)
                options.append((logprob, row, Hypothesis(tokens, logprob, prefix, attention)))
        options.sort(key=lambda option: -option[0])
        best = options[:width]
        return [row for _, row, _ in best], [one for _, _, one in best]

    def _permitted(self, prefix: Prefix, scores: Array, width: int) -> list[int]:
        """The ``width`` most probable tokens that the grammar permits."""
        found: list[int] = []
        for index in np.argsort(-scores):
            if len(found) == width or scores[index] == -np.inf:
                break
            if self._grammar.extend(prefix, int(index)) is not None:
                found.append(int(index))
        return found


def _settled(finished: list[Hypothesis], beam: list[Hypothesis], width: int) -> bool:
    """Whether no open hypothesis can enter the best ``width`` any more."""
    if len(finished) < width or not beam:
        return not beam
    worst = sorted(one.logprob for one in finished)[-width]
    return max(one.logprob for one in beam) < worst

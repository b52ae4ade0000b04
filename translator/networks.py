"""Trained models as they are served: what they say of a program's next symbol."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from translator.embed import session

Array = NDArray[np.float32]
T = TypeVar("T")
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
        """The state of these hypotheses alone, by their rows."""
        return state | {name: state[name][rows] for name in self._handed_on}


class Ensemble:
    """Networks with one vocabulary that speak with one voice: the mean of their probabilities,
    symbol by symbol. Each beyond the first runs on a thread of its own beside it."""

    def __init__(self, folder: Path) -> None:
        """The network of a folder, or those of its subfolders. Raises TranslatorError naming a
        missing file."""
        several = sorted(path.parent for path in folder.glob("*/step.onnx*"))
        self._networks = [Network(one) for one in several or [folder]]
        more = len(self._networks) - 1
        self._beside = ThreadPoolExecutor(more, "network") if more else None

    def begin(self, words: Array, slots: NDArray[np.int64] | None) -> list[State]:
        """Their states in front of a program's first symbol. words: (T, E), slots (T,)."""
        return self._each(lambda number: self._networks[number].begin(words, slots))

    def step(
        self, tokens: NDArray[np.int64], states: list[State]
    ) -> tuple[Array, Array, list[State]]:
        """One more symbol for each of B hypotheses, as `Network.step`."""
        told = self._each(lambda number: self._networks[number].step(tokens, states[number]))
        logprobs = np.logaddexp.reduce([one for one, _, _ in told]) - np.log(len(told))
        attention = np.mean([weights for _, weights, _ in told], axis=0)
        return logprobs, attention, [state for _, _, state in told]

    def kept(self, states: list[State], rows: list[int]) -> list[State]:
        """The states of these hypotheses alone."""
        return [one.kept(state, rows) for one, state in zip(self._networks, states, strict=True)]

    def _each(self, ask: Callable[[int], T]) -> list[T]:
        """What each network answers, by its number."""
        if self._beside is None:
            return [ask(0)]
        others = self._beside.map(ask, range(1, len(self._networks)))
        return [ask(0), *others]

"""A pretrained causal language model as it serves: reads a prompt, writes hypotheses side by side.

transformers on a few CPU threads. The blocks are kept in float32, their linear layers in int8 where
the processor can (torch's dynamic quantisation); embeddings stay as they came.
"""

from __future__ import annotations

import copy
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import torch
from numpy.typing import NDArray
from torch import Tensor, nn
from torch.ao.quantization import per_channel_dynamic_qconfig, quantize_dynamic

from translator.tuned import load_base, merged

THREADS = 1


class Causal:
    """A model that tells C numbers apart. Thread-safe: each `reading` has its own memory."""

    def __init__(self, base: Path | str, rows: Sequence[int] = (), adapter: Path | None = None,
                 quantised: bool = True) -> None:  # fmt: skip
        """``rows``: the sub-words that it may write, by column; or ``adapter``: the file of ours,
        by whose pieces it reads and writes. Raises TranslatorError where the base lacks."""
        torch.set_num_threads(THREADS)
        model: Any = load_base(base, torch.bfloat16)
        self._words: nn.Module = model.get_input_embeddings()
        if adapter is not None:
            self._read, self._write = (one.float() for one in merged(model, adapter))
        else:
            chosen = torch.tensor(list(rows))
            self._read = self._words(chosen).float()
            self._write = model.get_output_embeddings().weight[chosen].float()
        self.body = served(model.model, quantised)

    def embed(self, numbers: Sequence[int]) -> Tensor:
        """The model's own numbers, and pieces as ``~index`` -> (1, T, W)."""
        rows = [self._read[~n] if n < 0 else self._words(torch.tensor(n)).float() for n in numbers]
        return torch.stack(rows)[None]

    def reading(self, before: Reading | None = None) -> Reading:
        """A fresh memory, or one that goes on behind ``before``, which stays as it is."""
        return Reading(self, copy.deepcopy(before.memory) if before else None)

    def told(self, states: Tensor) -> NDArray[Any]:
        """states (B, W) -> log-probabilities (B, C)."""
        logits = nn.functional.linear(states.float(), self._write)
        told: NDArray[Any] = logits.log_softmax(-1).numpy()
        return told

    def columns(self, numbers: Sequence[int]) -> Tensor:
        """What the model reads for the numbers that it wrote: (B, 1, W)."""
        return self._read[list(numbers)][:, None]


class Reading:
    """What a model has read so far, for each of B hypotheses (`translator.subwords.Model`)."""

    def __init__(self, causal: Causal, memory: Any = None) -> None:  # noqa: ANN401 - theirs
        self._causal = causal
        self.memory = memory
        self._count = 1

    def begin(self, numbers: Sequence[int]) -> NDArray[Any]:
        """Read a prompt; log-probabilities (1, C) of what follows."""
        return self._run(self._causal.embed(numbers))

    def step(self, rows: Sequence[int], numbers: Sequence[int]) -> NDArray[Any]:
        """Keep these hypotheses, each with one more number: log-probabilities (B, C)."""
        if list(rows) != list(range(self._count)):
            self.memory.reorder_cache(torch.tensor(list(rows)))
        return self._run(self._causal.columns(numbers))

    def _run(self, embedded: Tensor) -> NDArray[Any]:
        self._count = len(embedded)
        with torch.inference_mode():
            told = self._causal.body(
                inputs_embeds=embedded, past_key_values=self.memory, use_cache=True
            )
            self.memory = told.past_key_values
            return self._causal.told(told.last_hidden_state[:, -1])


def served(body: nn.Module, quantised: bool) -> nn.Module:
    """The blocks in float32, their linear layers in int8, one after the other (for the memory's
    sake); what looks words up stays as it is."""
    for module in list(body.modules()):
        for name, layer in list(module.named_children()):
            if isinstance(layer, nn.Linear) and quantised:
                setattr(module, name, _eight_bits(layer.float()))
        if not isinstance(module, nn.Embedding):
            for weight in module.parameters(recurse=False):
                weight.data = weight.data.float()
    return body


def _eight_bits(layer: nn.Linear) -> nn.Module:
    """The layer with weights in 8 bits, a scale for each of its outputs."""
    alone = nn.Sequential(layer)
    with warnings.catch_warnings():
        # it says that another package will have this one day
        warnings.simplefilter("ignore")
        quantize_dynamic(  # type: ignore[no-untyped-call]
            alone, {nn.Linear: per_channel_dynamic_qconfig}, inplace=True
        )
    return alone[0]

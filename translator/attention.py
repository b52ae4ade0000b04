"""Heads of attention, as the product's model and MiniLM have them, in torch."""

from __future__ import annotations

import math

from torch import Tensor, nn


class Attention(nn.Module):
    """Heads of attention from states (B, L, W) to keys and values (B or 1, heads, T, W / heads)."""

    def __init__(self, width: int, heads: int) -> None:
        super().__init__()
        self.heads = heads
        self.query = nn.Linear(width, width)
        self.remember = nn.Linear(width, 2 * width)
        self.out = nn.Linear(width, width)

    def memory(self, states: Tensor) -> Tensor:
        """Keys and values of states (B, T, W): (2, B, heads, T, W / heads)."""
        batch, length, width = states.shape
        both = self.remember(states).view(batch, length, 2, self.heads, width // self.heads)
        kept: Tensor = both.permute(2, 0, 3, 1, 4)
        return kept

    def forward(
        self, states: Tensor, memory: Tensor, hidden: Tensor | None = None
    ) -> tuple[Tensor, Tensor]:
        """-> (B, L, W), weights (B, heads, L, T). ``hidden``: True where nobody may look,
        broadcastable to the weights."""
        batch, length, width = states.shape
        size = width // self.heads
        queries = self.query(states).view(batch, length, self.heads, size).transpose(1, 2)
        scores = queries @ memory[0].transpose(-1, -2) / math.sqrt(size)
        if hidden is not None:
            scores = scores.masked_fill(hidden, float("-inf"))
        weights = scores.softmax(-1)
        seen = (weights.to(memory.dtype) @ memory[1]).transpose(1, 2).reshape(batch, length, width)
        out: Tensor = self.out(seen)
        return out, weights

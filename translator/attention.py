"""Heads of attention, as the product's model and MiniLM have them, in torch."""

from __future__ import annotations

import math
from typing import NamedTuple

import torch
from torch import Tensor, nn


class Memory(NamedTuple):
    """What may be looked at: keys and values, each (B or 1, heads, T, W / heads)."""

    keys: Tensor
    values: Tensor

    def with_more(self, more: Memory) -> Memory:
        """This and then more, along T."""
        return Memory(*(torch.cat(both, -2) for both in zip(self, more, strict=True)))


class Attention(nn.Module):
    """Heads of attention from states (B, L, W) to a `Memory`."""

    def __init__(self, width: int, heads: int) -> None:
        super().__init__()
        self.heads, self.size = heads, width // heads
        self.query = nn.Linear(width, width)
        self.remember = nn.Linear(width, 2 * width)
        self.out = nn.Linear(width, width)

    def memory(self, states: Tensor) -> Memory:
        """What states (B, T, W) leave to be looked at."""
        keys, values = self.remember(states).split(self.heads * self.size, -1)
        return Memory(self._by_head(keys), self._by_head(values))

    def forward(
        self, states: Tensor, memory: Memory, hidden: Tensor | None = None
    ) -> tuple[Tensor, Tensor]:
        """-> (B, L, W), weights (B, heads, L, T). ``hidden``: True where nobody may look,
        broadcastable to the weights."""
        queries = self._by_head(self.query(states))
        scores = queries @ memory.keys.transpose(-1, -2) / math.sqrt(self.size)
        if hidden is not None:
            scores = scores.masked_fill(hidden, float("-inf"))
        weights = scores.softmax(-1)
        seen = weights.to(memory.values.dtype) @ memory.values
        out: Tensor = self.out(self._side_by_side(seen))
        return out, weights

    def _by_head(self, states: Tensor) -> Tensor:
        """(B, L, W) -> (B, heads, L, W / heads)."""
        if states.shape[1] == 1:  # a step that serves: nothing is to be turned
            return states.view(-1, self.heads, 1, self.size)
        return states.view(*states.shape[:2], self.heads, self.size).transpose(1, 2)

    def _side_by_side(self, seen: Tensor) -> Tensor:
        """(B, heads, L, W / heads) -> (B, L, W)."""
        if seen.shape[2] == 1:
            return seen.reshape(-1, 1, self.heads * self.size)
        return seen.transpose(1, 2).flatten(2)

"""The paper's sequence-to-sequence model (arXiv 2012.13695, section III-B), in torch.

Frozen BERT-style embeddings -> one LSTM (encoder); output tokens -> one LSTM (decoder) whose
state attends over the encoder's: ``score = h_t^T W_a h_s``, softmax, context = weighted sum,
``[c_t; h_t] -> FC -> ReLU -> FC -> softmax`` over program tokens. One model serves both tasks:
the decoder's first input names the task.
"""

from __future__ import annotations

import torch
from torch import Tensor, nn


class Seq2Seq(nn.Module):
    """B sentences, T word pieces, L program tokens, E embedding size, H width, V vocabulary."""

    def __init__(
        self,
        vocabulary_size: int,
        width: int = 1024,
        embedding_size: int = 384,
        token_size: int = 128,
        dropout: float = 0.0,
    ) -> None:
        super().__init__()
        self.width = width
        self.embedding_size = embedding_size
        self.encoder = nn.LSTM(embedding_size, width, batch_first=True)
        self.tokens = nn.Embedding(vocabulary_size, token_size)
        self.decoder = nn.LSTM(token_size, width, batch_first=True)
        self.score = nn.Linear(width, width, bias=False)
        self.combine = nn.Linear(2 * width, width)
        self.output = nn.Linear(width, vocabulary_size)
        self.dropout = nn.Dropout(dropout)

    def forward(self, words: Tensor, lengths: Tensor, tokens: Tensor) -> Tensor:
        """Teacher forcing. words (B, T, E), lengths (B,), tokens (B, L) -> logits (B, L, V)."""
        packed = nn.utils.rnn.pack_padded_sequence(
            self.dropout(words), lengths.cpu(), batch_first=True, enforce_sorted=False
        )
        states, final = self.encoder(packed)
        memory, _ = nn.utils.rnn.pad_packed_sequence(states, batch_first=True)  # (B, T, H)
        hidden, _ = self.decoder(self.dropout(self.tokens(tokens)), final)  # (B, L, H)
        padding = torch.arange(memory.shape[1])[None, :] >= lengths[:, None]  # (B, T)
        logits, _ = self.attend(hidden, memory, padding)
        return logits

    def attend(
        self, hidden: Tensor, memory: Tensor, padding: Tensor | None
    ) -> tuple[Tensor, Tensor]:
        """hidden (B, L, H), memory (B, T, H) -> logits (B, L, V), attention weights (B, L, T)."""
        scores = self.score(hidden) @ memory.transpose(1, 2)  # (B, L, T)
        if padding is not None:
            scores = scores.masked_fill(padding[:, None, :], float("-inf"))
        weights = scores.softmax(-1)
        context = weights @ memory  # (B, L, H)
        combined = torch.relu(self.combine(torch.cat([context, hidden], -1)))
        return self.output(self.dropout(combined)), weights

    def encoder_graph(self) -> nn.Module:
        """The encoder alone: words (1, T, E) -> memory (1, T, H), h (1, H), c (1, H)."""
        return _EncoderGraph(self)

    def step_graph(self) -> nn.Module:
        """One decoder step for a beam of B over one sentence: see `_StepGraph`."""
        return _StepGraph(self)


class _EncoderGraph(nn.Module):
    def __init__(self, model: Seq2Seq) -> None:
        super().__init__()
        self.encoder = model.encoder

    def forward(self, words: Tensor) -> tuple[Tensor, Tensor, Tensor]:
        memory, (h, c) = self.encoder(words)
        return memory, h[0], c[0]


class _StepGraph(nn.Module):
    """token (B,), h (B, H), c (B, H), memory (1, T, H) -> logits (B, V), h, c, attention (B, T)."""

    def __init__(self, model: Seq2Seq) -> None:
        super().__init__()
        self.model = model

    def forward(
        self, token: Tensor, h: Tensor, c: Tensor, memory: Tensor
    ) -> tuple[Tensor, Tensor, Tensor, Tensor]:
        model = self.model
        hidden, (h, c) = model.decoder(model.tokens(token)[:, None, :], (h[None], c[None]))
        # one sentence, B hypotheses: put the beam on the length axis of `attend`
        logits, weights = model.attend(hidden.transpose(0, 1), memory, None)
        return logits[0], h[0], c[0], weights[0]

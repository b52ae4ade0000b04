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
        slots: int = 0,
        bidirectional: bool = False,
    ) -> None:
        """``slots``: how many slots a sentence may mark (0: none); ``bidirectional``: the encoder
        reads both ways, half the width each."""
        super().__init__()
        self.width = width
        self.embedding_size = embedding_size
        self.bidirectional = bidirectional
        self.slots = nn.Embedding(slots + 1, embedding_size) if slots else None
        self.encoder = nn.LSTM(
            embedding_size, width // (2 if bidirectional else 1), batch_first=True,
            bidirectional=bidirectional,
        )  # fmt: skip
        self.tokens = nn.Embedding(vocabulary_size, token_size)
        self.decoder = nn.LSTM(token_size, width, batch_first=True)
        self.score = nn.Linear(width, width, bias=False)
        self.combine = nn.Linear(2 * width, width)
        self.output = nn.Linear(width, vocabulary_size)
        self.dropout = nn.Dropout(dropout)

    def forward(
        self, words: Tensor, lengths: Tensor, tokens: Tensor, slots: Tensor | None = None
    ) -> Tensor:
        """Teacher forcing.

        words (B, T, E), lengths (B,), tokens (B, L), slots (B, T; 0: no slot) -> logits (B, L, V).
        """
        packed = nn.utils.rnn.pack_padded_sequence(
            self.dropout(self.placed(words, slots)), lengths.cpu(), batch_first=True,
            enforce_sorted=False,
        )  # fmt: skip
        states, final = self.encoder(packed)
        memory, _ = nn.utils.rnn.pad_packed_sequence(states, batch_first=True)  # (B, T, H)
        final = (self.joined(final[0]), self.joined(final[1]))
        hidden, _ = self.decoder(self.dropout(self.tokens(tokens)), final)  # (B, L, H)
        places = torch.arange(memory.shape[1], device=memory.device)
        padding = places[None, :] >= lengths[:, None]  # (B, T)
        logits, _ = self.attend(hidden, memory, padding)
        return logits

    def placed(self, words: Tensor, slots: Tensor | None) -> Tensor:
        """words (B, T, E) with the embedding of its slot in the place of each marked piece."""
        if self.slots is None or slots is None:
            return words
        return torch.where((slots > 0)[..., None], self.slots(slots), words)

    def joined(self, state: Tensor) -> Tensor:
        """The encoder's last state (directions, B, H / directions) -> (1, B, H)."""
        return torch.cat(list(state), -1)[None]

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
        """The encoder alone: words (1, T, E), slots (1, T) -> memory (1, T, H), h, c (1, H)."""
        return _EncoderGraph(self)

    def step_graph(self) -> nn.Module:
        """One decoder step for a beam of B over one sentence: see `_StepGraph`."""
        return _StepGraph(self)


class _EncoderGraph(nn.Module):
    def __init__(self, model: Seq2Seq) -> None:
        super().__init__()
        self.model = model

    def forward(self, words: Tensor, slots: Tensor | None = None) -> tuple[Tensor, Tensor, Tensor]:
        memory, (h, c) = self.model.encoder(self.model.placed(words, slots))
        return memory, self.model.joined(h)[0], self.model.joined(c)[0]


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

"""Train the tagger of talk: ``armchat train hearing --out runs/hearing``.

Needs the ``[train]`` extra. Writes the onnxruntime graph, int8, and the figures of what is held out
(wordings and asides that it never saw).
"""

from __future__ import annotations

import random
import sys
import time
from collections.abc import Iterator, Sequence
from itertools import islice
from pathlib import Path

import msgspec
import numpy as np
import torch
from torch import Tensor, nn

from translator.corpus.seed import kept, load_seeds
from translator.corpus.talk import Part, Talker, halved, load_asides
from translator.embed import SentenceEncoder
from translator.export import export_graph
from translator.hearing import GRAPH
from translator.translate import WEIGHTS

WIDTH = 96
"""Of the LSTM, each way."""
BATCH = 32
VALID = 1_000
CHUNK = 1_024
"""Sentences that are sorted by length together."""


class Figures(msgspec.Struct, frozen=True):
    """Of held-out sentences, n: the share of words tagged rightly, of talk found, of what was
    passed over rightly so, and of sentences with every word right."""

    n: int
    words: float
    recall: float
    precision: float
    sentences: float
    learnt_from: int
    minutes: float


class Tagger(nn.Module):
    """B sentences, T word pieces, E embedding size."""

    def __init__(self, size: int = SentenceEncoder.size, width: int = WIDTH) -> None:
        super().__init__()
        self.reader = nn.LSTM(size, width, batch_first=True, bidirectional=True)
        self.dropout = nn.Dropout(0.2)
        self.output = nn.Linear(2 * width, 1)

    def forward(self, words: Tensor) -> Tensor:
        """words (B, T, E) -> logits (B, T): talk or not."""
        states, _ = self.reader(self.dropout(words))
        logits: Tensor = self.output(self.dropout(states))[..., 0]
        return logits


class _Labelled(msgspec.Struct, frozen=True):
    """words (T, E), talk (T,): 1, 0, or -1 where no part of the text is."""

    words: Tensor
    talk: Tensor


def train(
    nouns: Sequence[str], out: Path, sentences: int = 40_000, seed: int = 0, minutes: float = 0.0
) -> Figures:
    """Learn from so many fresh sentences, for at most so many minutes (0: no limit), and write
    graph and figures into ``out``. ``nouns``: what things may be called."""
    began = time.monotonic()
    torch.manual_seed(seed)
    encoder = SentenceEncoder(WEIGHTS)
    seeds, asides = load_seeds(), load_asides()
    learnt = Talker(kept(seeds, False), halved(asides, False), nouns, random.Random(seed))
    unseen = Talker(kept(seeds, True), halved(asides, True), nouns, random.Random(seed + 1))
    valid = [_labelled(encoder, parts) for parts in islice(unseen, VALID)]
    model = Tagger()
    optimiser = torch.optim.Adam(model.parameters(), lr=2e-3)
    seen, losses = 0, list[float]()
    for batch in _batches(encoder, iter(learnt)):
        share = max(seen / sentences, _used(began, minutes))
        if share >= 1:
            break
        for group in optimiser.param_groups:
            group["lr"] = 2e-3 * (1 - 0.97 * share)
        optimiser.zero_grad()
        loss = _loss(model, batch)
        loss.backward()  # type: ignore[no-untyped-call]
        optimiser.step()
        losses.append(loss.item())
        seen += len(batch)
        if len(losses) % 200 == 0:
            print(
                f"{seen} sentences: loss {np.mean(losses[-200:]):.4f}", file=sys.stderr, flush=True
            )
    figures = _figures(model.eval(), valid, seen, (time.monotonic() - began) / 60)
    out.mkdir(parents=True, exist_ok=True)
    example = torch.zeros((1, 7, SentenceEncoder.size))
    export_graph(model, (example,), out / GRAPH, ["words"], ["logits"], {
        "words": {1: "T"}, "logits": {1: "T"},
    })  # fmt: skip
    (out / "figures.json").write_bytes(msgspec.json.format(msgspec.json.encode(figures)) + b"\n")
    return figures


def _used(began: float, minutes: float) -> float:
    return (time.monotonic() - began) / (60 * minutes) if minutes else 0.0


def _labelled(encoder: SentenceEncoder, parts: Sequence[Part]) -> _Labelled:
    text = "".join(part.text for part in parts)
    talk = np.concatenate([np.full(len(part.text), float(part.talk)) for part in parts])
    pieces = [talk[start] if end > start else -1.0 for start, end in encoder.places(text)]
    return _Labelled(torch.from_numpy(encoder(text)), torch.tensor(pieces, dtype=torch.float32))


def _batches(encoder: SentenceEncoder, talker: Iterator[list[Part]]) -> Iterator[list[_Labelled]]:
    """Batches of sentences of like length, in no order."""
    chance = random.Random(0)
    while True:
        chunk = [_labelled(encoder, parts) for parts in islice(talker, CHUNK)]
        chunk.sort(key=lambda one: len(one.talk))
        batches = [chunk[at : at + BATCH] for at in range(0, len(chunk), BATCH)]
        chance.shuffle(batches)
        yield from batches


def _loss(model: Tagger, batch: Sequence[_Labelled]) -> Tensor:
    words = nn.utils.rnn.pad_sequence([one.words for one in batch], batch_first=True)
    talk = nn.utils.rnn.pad_sequence(
        [one.talk for one in batch], batch_first=True, padding_value=-1.0
    )
    counted = talk >= 0
    return nn.functional.binary_cross_entropy_with_logits(model(words)[counted], talk[counted])


@torch.no_grad()
def _figures(
    model: Tagger, valid: Sequence[_Labelled], learnt_from: int, minutes: float
) -> Figures:
    right, found, there, said, whole, words = 0, 0, 0, 0, 0, 0
    for one in valid:
        counted = one.talk >= 0
        tagged = (model(one.words[None])[0] > 0)[counted]
        talk = one.talk[counted] > 0
        right += int((tagged == talk).sum())
        words += len(talk)
        found += int((tagged & talk).sum())
        there += int(talk.sum())
        said += int(tagged.sum())
        whole += bool((tagged == talk).all())
    return Figures(
        len(valid), right / words, found / max(1, there), found / max(1, said), whole / len(valid),
        learnt_from, minutes,
    )  # fmt: skip

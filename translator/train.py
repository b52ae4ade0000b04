"""Train the seq2seq model: `armchat train --config configs/paper.toml --out runs/paper`.

Adam, cross-entropy with teacher forcing, as in the paper (section IV-A). Writes the run's
configuration, its log, the checkpoint (safetensors) and the onnxruntime export into one folder.
Needs the ``[train]`` extra.
"""

from __future__ import annotations

import hashlib
import random
import sys
import time
import tomllib
from collections.abc import Sequence
from pathlib import Path

import msgspec
import numpy as np
import torch
from numpy.typing import NDArray
from safetensors.torch import save_file
from torch import Tensor, nn

from agent.errors import ConfigError
from agent.messages import Kind
from translator.corpus.load import load
from translator.data import Sample, epoch
from translator.embed import SentenceEncoder
from translator.export import export_model
from translator.model import Seq2Seq
from translator.translate import WEIGHTS
from translator.vocabulary import END, PAD, STARTS, Vocabulary, build_vocabulary, tokenize

PADDING = -100
"""Target index that the loss ignores."""


class TrainConfig(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One training run.

    ``copies``: how often each pair appears in an epoch, nouns swapped; ``joined``: the share of
    them that is joined with other pairs; the learning rate falls to ``final_rate``.
    """

    tasks: tuple[Kind, ...] = ("arrange", "manipulate")
    width: int = 1024
    token_size: int = 128
    dropout: float = 0.0
    epochs: int = 10
    copies: int = 8
    joined: float = 0.0
    batch: int = 16
    learning_rate: float = 1e-3
    final_rate: float = 1e-3
    clip: float = 5.0
    seed: int = 0
    threads: int = 2


class Epoch(msgspec.Struct, frozen=True):
    """One line of the training log: mean loss a token (nats) on train and valid, seconds."""

    epoch: int
    train: float
    valid: float
    seconds: float


def read_config(path: Path) -> TrainConfig:
    """The configuration of a TOML file. Raises ConfigError naming file and key."""
    try:
        return msgspec.convert(tomllib.loads(path.read_text(encoding="utf-8")), TrainConfig)
    except (OSError, ValueError, msgspec.ValidationError) as error:
        raise ConfigError(f"{path}: {error}") from error


def read_samples(tasks: Sequence[Kind], split: str) -> list[Sample]:
    """The expert pairs of a split."""
    pairs = [pair for task in tasks for pair in load(task) if pair.split == split]
    return [Sample(pair.say, pair.program, pair.kind) for pair in pairs]


def train(config: TrainConfig, out: Path) -> Seq2Seq:
    """Train from nothing and write everything into ``out``."""
    out.mkdir(parents=True, exist_ok=True)
    torch.manual_seed(config.seed)
    torch.set_num_threads(config.threads)
    rng = random.Random(config.seed)
    samples, held_out = read_samples(config.tasks, "train"), read_samples(config.tasks, "valid")
    vocabulary = build_vocabulary([s.program for s in samples], [s.say for s in samples])
    vocabulary.save(out / "vocabulary.json")
    (out / "config.json").write_bytes(msgspec.json.format(msgspec.json.encode(config)))
    model = Seq2Seq(
        len(vocabulary.pieces), config.width, SentenceEncoder.size, config.token_size,
        config.dropout,
    )  # fmt: skip
    batches = Batches(SentenceEncoder(WEIGHTS), vocabulary, config.batch)
    optimiser = torch.optim.Adam(model.parameters(), lr=config.learning_rate)
    decay = (config.final_rate / config.learning_rate) ** (1 / max(1, config.epochs - 1))
    schedule = torch.optim.lr_scheduler.ExponentialLR(optimiser, decay)
    valid = batches.make([sample for sample in held_out if batches.readable(sample)])
    with (out / "log.jsonl").open("wb") as log:
        for number in range(1, config.epochs + 1):
            began = time.perf_counter()
            lesson = batches.make(epoch(samples, config.copies, rng, config.joined))
            loss = _train_epoch(model, lesson, optimiser, config)
            schedule.step()
            entry = Epoch(number, loss, _evaluate(model, valid), time.perf_counter() - began)
            log.write(msgspec.json.encode(entry) + b"\n")
            log.flush()
            save_file(model.state_dict(), out / "model.safetensors")
            print(
                f"epoch {number}: train {entry.train:.4f} valid {entry.valid:.4f} "
                f"({entry.seconds:.0f} s)", file=sys.stderr, flush=True,
            )  # fmt: skip
    export_model(model, out)
    return model


class Batch(msgspec.Struct, frozen=True):
    """words (B, T, E), lengths (B,), inputs (B, L), targets (B, L; PADDING beyond the end)."""

    words: Tensor
    lengths: Tensor
    inputs: Tensor
    targets: Tensor


class Batches:
    """Samples to padded tensors, samples of like length together."""

    def __init__(self, encoder: SentenceEncoder, vocabulary: Vocabulary, size: int) -> None:
        self._encoder = encoder
        self._vocabulary = vocabulary
        self._size = size

    def readable(self, sample: Sample) -> bool:
        """Whether every token of the program is in the vocabulary."""
        single = {piece[0] for piece in self._vocabulary.pieces if len(piece) == 1}
        return set(tokenize(sample.program)) <= single

    def make(self, samples: Sequence[Sample]) -> list[Batch]:
        """Batches of a list of samples, in an order drawn from the list's own."""
        chunk = self._size * 8
        result: list[Batch] = []
        for start in range(0, len(samples), chunk):
            alike = sorted(samples[start : start + chunk], key=lambda one: len(one.program))
            groups = [alike[i : i + self._size] for i in range(0, len(alike), self._size)]
            random.Random(start).shuffle(groups)
            result += [self._tensors(group) for group in groups]
        return result

    def _tensors(self, samples: Sequence[Sample]) -> Batch:
        words = [torch.from_numpy(self._encoder(sample.say)) for sample in samples]
        inputs, targets = [], []
        for sample in samples:
            program = self._vocabulary.encode(tokenize(sample.program))
            inputs.append(self._vocabulary.encode([STARTS[sample.kind]]) + program)
            targets.append(program + self._vocabulary.encode([END]))
        pad = self._vocabulary.symbol(PAD)
        return Batch(
            nn.utils.rnn.pad_sequence(words, batch_first=True),
            torch.tensor([len(one) for one in words]),
            torch.from_numpy(_padded(inputs, pad)),
            torch.from_numpy(_padded(targets, PADDING)),
        )


def _padded(rows: Sequence[Sequence[int]], fill: int) -> NDArray[np.int64]:
    table = np.full((len(rows), max(map(len, rows))), fill, dtype=np.int64)
    for row, values in zip(table, rows, strict=True):
        row[: len(values)] = values
    return table


def _loss(model: Seq2Seq, batch: Batch) -> Tensor:
    # bfloat16 only where the processor has it: elsewhere it is slower than float32
    fast = bool(torch.cpu.get_capabilities().get("avx512_bf16"))
    with torch.autocast("cpu", dtype=torch.bfloat16, enabled=fast):
        logits = model(batch.words, batch.lengths, batch.inputs)  # (B, L, V)
    return nn.functional.cross_entropy(
        logits.float().flatten(0, 1), batch.targets.flatten(), ignore_index=PADDING
    )


def _train_epoch(
    model: Seq2Seq, batches: Sequence[Batch], optimiser: torch.optim.Adam, config: TrainConfig
) -> float:
    model.train()
    losses: list[float] = []
    for batch in batches:
        optimiser.zero_grad()
        loss = _loss(model, batch)
        loss.backward()  # type: ignore[no-untyped-call]
        nn.utils.clip_grad_norm_(model.parameters(), config.clip)
        optimiser.step()
        losses.append(loss.item())
    return float(np.mean(losses))


@torch.no_grad()
def _evaluate(model: Seq2Seq, batches: Sequence[Batch]) -> float:
    model.eval()
    return float(np.mean([_loss(model, batch).item() for batch in batches]))


def digest(path: Path) -> str:
    """SHA-256 of a file, for the card."""
    return hashlib.sha256(path.read_bytes()).hexdigest()

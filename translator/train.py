"""Train a translator's model: `armchat train --config configs/paper.toml --out runs/paper`.

Adam, cross-entropy with teacher forcing, as in the paper (section IV-A). Writes the run's
configuration, its log, the checkpoint (safetensors) and the onnxruntime export into one folder.
Needs the ``[train]`` extra.
"""

from __future__ import annotations

import copy
import hashlib
import random
import sys
import time
import tomllib
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from itertools import islice
from pathlib import Path
from typing import Literal, NamedTuple

import msgspec
import numpy as np
import torch
from numpy.typing import NDArray
from safetensors.torch import load_file, save_file
from torch import Tensor, nn

from agent.errors import ConfigError
from agent.messages import Kind
from translator.corpus.generate import Generator
from translator.corpus.load import load
from translator.corpus.seed import kept, load_seeds
from translator.data import Sample, epoch
from translator.embed import SentenceEncoder
from translator.export import export_model
from translator.marked import SLOTS, Mark
from translator.model import Seq2Seq
from translator.transformer import Transformer
from translator.translate import WEIGHTS
from translator.vocabulary import (
    END,
    MERGES,
    PAD,
    STARTS,
    Dialect,
    Vocabulary,
    build_vocabulary,
    tokenize,
)

AHEAD = 8
"""Batches made ahead of the one that the model learns from."""
PADDING = -100
"""Target index that the loss ignores."""


class TrainConfig(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One training run.

    ``model``: the paper's LSTMs or the product's Transformer. ``copies``: how often each pair
    appears in an epoch, nouns swapped; ``joined``: the share of them that is joined with other
    pairs. With the corpus ``seeds`` an epoch is ``samples`` fresh sentences of
    `translator.corpus.generate`, and a wording in twenty is held out. ``start``: folder of an
    earlier run of the same sizes, whose weights and vocabulary this one goes on from;
    ``vocabulary``: folder of the run whose vocabulary it speaks instead. The learning rate rises
    over the first ``warmup`` batches and falls to ``final_rate`` by the last epoch. Each of
    ``threads`` learns from its share of a batch.
    """

    tasks: tuple[Kind, ...] = ("arrange", "manipulate")
    corpus: Literal["paper", "seeds"] = "paper"
    model: Literal["lstm", "transformer"] = "lstm"
    start: str | None = None
    vocabulary: str | None = None
    samples: int = 20_000
    merges: int = MERGES
    bidirectional: bool = False
    width: int = 1024
    token_size: int = 128
    dropout: float = 0.0
    epochs: int = 10
    copies: int = 8
    joined: float = 0.0
    batch: int = 16
    learning_rate: float = 1e-3
    final_rate: float = 1e-3
    warmup: int = 0
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


class Lesson(NamedTuple):
    """One sentence with its marks, and the program it means."""

    text: str
    marks: tuple[Mark, ...]
    program: str
    kind: Kind


Epochs = Callable[[], Sequence[Lesson]]
"""Makes the lessons of one more epoch."""


def paper_lessons(config: TrainConfig, chance: random.Random) -> tuple[Epochs, list[Lesson]]:
    """The expert pairs: epochs of the training split, and the valid split."""

    def plain(samples: Sequence[Sample]) -> list[Lesson]:
        return [Lesson(one.say, (), one.program, one.kind) for one in samples]

    def split(name: str) -> list[Sample]:
        pairs = [pair for task in config.tasks for pair in load(task) if pair.split == name]
        return [Sample(pair.say, pair.program, pair.kind) for pair in pairs]

    train = split("train")
    return lambda: plain(epoch(train, config.copies, chance, config.joined)), plain(split("valid"))


def seed_lessons(config: TrainConfig, chance: random.Random) -> tuple[Epochs, list[Lesson]]:
    """Sentences grown from the seeds, and a thousand from the wordings held out."""
    seeds = load_seeds()
    grown = Generator(kept(seeds, held_out=False), chance)
    others = Generator(kept(seeds, held_out=True), random.Random(config.seed + 1))

    def take(generator: Generator, count: int) -> list[Lesson]:
        return [
            Lesson(one.sentence.text, one.sentence.marks, one.program, one.kind)
            for one in islice(generator, count)
        ]

    return lambda: take(grown, config.samples), take(others, 1_000)


Model = Seq2Seq | Transformer


def train(config: TrainConfig, out: Path) -> Model:
    """Train from nothing and write everything into ``out``."""
    out.mkdir(parents=True, exist_ok=True)
    torch.manual_seed(config.seed)
    torch.set_num_threads(1)
    make = paper_lessons if config.corpus == "paper" else seed_lessons
    next_epoch, held_out = make(config, random.Random(config.seed))
    first = next_epoch()
    dialect: Dialect = "paper" if config.corpus == "paper" else "skills"
    known = first if config.corpus == "paper" else [*first, *held_out]
    spoken = config.vocabulary or config.start
    vocabulary = (
        Vocabulary.load(Path(spoken) / "vocabulary.json")
        if spoken
        else build_vocabulary(
            [lesson.program for lesson in known], [lesson.text for lesson in first],
            config.merges, dialect,
        )
    )  # fmt: skip
    vocabulary.save(out / "vocabulary.json")
    (out / "config.json").write_bytes(msgspec.json.format(msgspec.json.encode(config)))
    slots = len(SLOTS) if dialect == "skills" else 0
    model = build_model(config, len(vocabulary.pieces), slots)
    if config.start:
        before = Vocabulary.load(Path(config.start) / "vocabulary.json")
        learnt = load_file(Path(config.start) / "model.safetensors")
        model.load_state_dict(carried(learnt, before, model.state_dict(), vocabulary))
    batches = Batches(SentenceEncoder(WEIGHTS), vocabulary, config.batch)
    learner = Learner(model, config)
    valid = list(batches.make([lesson for lesson in held_out if batches.readable(lesson)]))
    with (out / "log.jsonl").open("wb") as log:
        for number in range(1, config.epochs + 1):
            began = time.perf_counter()
            lessons = first if number == 1 else next_epoch()
            readable = [lesson for lesson in lessons if batches.readable(lesson)]
            loss = learner.epoch(number, batches.make(readable))
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


def carried(
    learnt: Mapping[str, Tensor], before: Vocabulary, fresh: Mapping[str, Tensor], now: Vocabulary
) -> dict[str, Tensor]:
    """Weights learnt with one vocabulary for another: pieces that both have keep their rows, new
    ones start from the ``fresh`` weights."""
    both = [(i, before.pieces.index(piece)) for i, piece in enumerate(now.pieces)
            if piece in before.pieces]  # fmt: skip
    rows, old = (torch.tensor(index) for index in zip(*both, strict=True))
    weights = {}
    for name, tensor in fresh.items():
        if name.startswith(("tokens.", "output.")):
            tensor = tensor.clone()
            tensor[rows] = learnt[name][old]
        else:
            tensor = learnt[name]
        weights[name] = tensor
    return weights


def build_model(config: TrainConfig, vocabulary_size: int, slots: int) -> Model:
    """The model of a configuration, untrained. ``slots``: how many a sentence may mark."""
    size = SentenceEncoder.size
    if config.model == "transformer":
        return Transformer(vocabulary_size, config.width, size, config.dropout, slots)
    return Seq2Seq(
        vocabulary_size, config.width, size, config.token_size, config.dropout, slots,
        config.bidirectional,
    )  # fmt: skip


class Batch(msgspec.Struct, frozen=True):
    """words (B, T, E), slots (B, T), lengths (B,), inputs (B, L), targets (B, L; PADDING beyond
    the end)."""

    words: Tensor
    slots: Tensor
    lengths: Tensor
    inputs: Tensor
    targets: Tensor

    def share(self, number: int, of: int) -> Batch:
        """Every ``of``-th sentence, from ``number`` on."""
        return Batch(*(getattr(self, field)[number::of] for field in self.__struct_fields__))


class Batches:
    """Samples to padded tensors, samples of like length together."""

    def __init__(self, encoder: SentenceEncoder, vocabulary: Vocabulary, size: int) -> None:
        self._encoder = encoder
        self._vocabulary = vocabulary
        self._size = size

        self._single = {piece[0] for piece in vocabulary.pieces if len(piece) == 1}

    def readable(self, lesson: Lesson) -> bool:
        """Whether every token of the program is in the vocabulary."""
        return set(tokenize(lesson.program)) <= self._single

    def make(self, samples: Sequence[Lesson]) -> Iterator[Batch]:
        """Batches of a list of lessons, in an order drawn from the list's own.

        They are made a few ahead, on a thread: the frozen encoder works while the model learns.
        """
        with ThreadPoolExecutor(1) as pool:
            ahead: deque[Future[Batch]] = deque()
            for group in self._groups(samples):
                ahead.append(pool.submit(self._tensors, group))
                if len(ahead) > AHEAD:
                    yield ahead.popleft().result()
            yield from (batch.result() for batch in ahead)

    def _groups(self, samples: Sequence[Lesson]) -> Iterator[Sequence[Lesson]]:
        chunk = self._size * 8
        for start in range(0, len(samples), chunk):
            alike = sorted(samples[start : start + chunk], key=lambda one: len(one.program))
            groups = [alike[i : i + self._size] for i in range(0, len(alike), self._size)]
            random.Random(start).shuffle(groups)
            yield from groups

    def _tensors(self, samples: Sequence[Lesson]) -> Batch:
        read = [self._encoder.marked(sample.text, sample.marks) for sample in samples]
        words = [torch.from_numpy(states) for states, _ in read]
        slots = [torch.from_numpy(ids) for _, ids in read]
        inputs, targets = [], []
        for sample in samples:
            program = self._vocabulary.encode(tokenize(sample.program))
            inputs.append(self._vocabulary.encode([STARTS[sample.kind]]) + program)
            targets.append(program + self._vocabulary.encode([END]))
        pad = self._vocabulary.symbol(PAD)
        return Batch(
            nn.utils.rnn.pad_sequence(words, batch_first=True),
            nn.utils.rnn.pad_sequence(slots, batch_first=True),
            torch.tensor([len(one) for one in words]),
            torch.from_numpy(_padded(inputs, pad)),
            torch.from_numpy(_padded(targets, PADDING)),
        )


def _padded(rows: Sequence[Sequence[int]], fill: int) -> NDArray[np.int64]:
    table = np.full((len(rows), max(map(len, rows))), fill, dtype=np.int64)
    for row, values in zip(table, rows, strict=True):
        row[: len(values)] = values
    return table


def _loss(model: Model, batch: Batch) -> Tensor:
    # bfloat16 only where the processor has it: elsewhere it is slower than float32
    fast = bool(torch.cpu.get_capabilities().get("avx512_bf16"))
    with torch.autocast("cpu", dtype=torch.bfloat16, enabled=fast):
        logits = model(batch.words, batch.lengths, batch.inputs, batch.slots)  # (B, L, V)
    return nn.functional.cross_entropy(
        logits.float().flatten(0, 1), batch.targets.flatten(), ignore_index=PADDING
    )


class Learner:
    """Adam over replicas of one model, which share its weights and learn side by side.

    One operation on two threads waits for the slower one at every step of the way, and on busy
    cores that costs more than it saves; replicas meet once a batch (figures: evals/LOG.md).
    """

    def __init__(self, model: Model, config: TrainConfig) -> None:
        self._config = config
        self._model = model
        self._replicas = [model] + [copy.deepcopy(model) for _ in range(config.threads - 1)]
        for replica in self._replicas[1:]:
            for mine, shared in zip(replica.parameters(), model.parameters(), strict=True):
                mine.data = shared.data
        self._optimiser = torch.optim.Adam(model.parameters(), lr=config.learning_rate, fused=True)
        self._batches = 0

    def epoch(self, number: int, batches: Iterable[Batch]) -> float:
        """Learn from every batch; the mean loss. ``number``: of the epoch, from 1."""
        losses: list[float] = []
        for replica in self._replicas:
            replica.train()
        with ThreadPoolExecutor(len(self._replicas), initializer=torch.set_num_threads,
                                initargs=(1,)) as pool:  # fmt: skip
            for batch in batches:
                rate = self.next_rate(number)
                for group in self._optimiser.param_groups:
                    group["lr"] = rate
                losses.append(self._learn(batch, pool))
        return float(np.mean(losses))

    def _learn(self, batch: Batch, pool: ThreadPoolExecutor) -> float:
        of = min(len(self._replicas), len(batch.lengths))
        shares = [batch.share(number, of) for number in range(of)]
        losses = list(pool.map(_backward, self._replicas[:of], shares))
        for mine, *others in zip(*(one.parameters() for one in self._replicas[:of]), strict=True):
            for other in others:
                if mine.grad is not None and other.grad is not None:
                    mine.grad.add_(other.grad)
            if mine.grad is not None:
                mine.grad.div_(of)
        nn.utils.clip_grad_norm_(self._model.parameters(), self._config.clip)
        self._optimiser.step()
        return float(np.mean(losses))

    def next_rate(self, number: int) -> float:
        """The learning rate of the next batch, in epoch ``number``."""
        self._batches += 1
        config = self._config
        share = (number - 1) / max(1, config.epochs - 1)
        rate = config.learning_rate * (config.final_rate / config.learning_rate) ** share
        return float(rate * min(1.0, self._batches / max(1, config.warmup)))


def _backward(model: Model, batch: Batch) -> float:
    model.zero_grad()
    loss = _loss(model, batch)
    loss.backward()  # type: ignore[no-untyped-call]
    return loss.item()


@torch.no_grad()
def _evaluate(model: Model, batches: Iterable[Batch]) -> float:
    model.eval()
    return float(np.mean([_loss(model, batch).item() for batch in batches]))


def digest(path: Path) -> str:
    """SHA-256 of a file, for the card."""
    return hashlib.sha256(path.read_bytes()).hexdigest()

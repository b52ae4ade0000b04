"""Train a translator's model: `armchat train --config configs/paper.toml --out runs/paper`.

Adam, cross-entropy with teacher forcing, as in the paper (section IV-A). Writes the run's
configuration, its log, the checkpoint (safetensors) and the onnxruntime export into one folder.
Needs the ``[train]`` extra.
"""

from __future__ import annotations

import hashlib
import sys
import time
from collections.abc import Mapping
from contextlib import closing
from functools import partial
from itertools import chain, islice
from pathlib import Path

import msgspec
import torch
from safetensors.torch import load_file, save_file
from torch import Tensor

from translator.course import TrainConfig
from translator.embed import SentenceEncoder, sentence_tokenizer
from translator.export import export_model
from translator.learner import Learner, Model, ahead, batch_of, evaluate, reader_on
from translator.lessons import (
    CHUNK,
    DocstringLessons,
    Growth,
    Lessons,
    Packer,
    PaperLessons,
    SeedLessons,
    stream,
)
from translator.marked import SLOTS
from translator.model import Seq2Seq
from translator.resume import go_on, over, save, unfinished
from translator.served import served, served_weights
from translator.transformer import Transformer
from translator.translate import WEIGHTS
from translator.vocabulary import Dialect, Vocabulary, build_vocabulary

DIALECTS: dict[str, Dialect] = {"paper": "paper", "seeds": "skills", "docstrings": "python"}
"""What the programs of each corpus are over."""
VOCABULARY, CHECKPOINT, LOG = "vocabulary.json", "model.safetensors", "log.jsonl"
"""The run's `Epoch`s, a line each."""
FIRST = 4
"""Chunks of lessons that a vocabulary is built from."""


class Epoch(msgspec.Struct, frozen=True):
    """One line of the training log: mean loss a symbol (nats) on train and valid, the share of
    valid programs with every symbol right (each from the true ones before it), seconds."""

    epoch: int
    train: float
    valid: float
    right: float
    seconds: float


def train(config: TrainConfig, out: Path) -> Model:
    """Train and write everything into ``out``; on a GPU where torch finds one. A run that was cut
    short there goes on behind its last epoch, as if it had not been. Raises ConfigError where it
    was one of another configuration."""
    began = time.monotonic()
    cut_short = unfinished(out, config)
    out.mkdir(parents=True, exist_ok=True)
    torch.manual_seed(config.seed)
    torch.set_num_threads(1)
    device = torch.device("cuda" if torch.cuda.is_available() else "cpu")
    lessons = lessons_of(config)
    vocabulary = _vocabulary(config, lessons)
    vocabulary.save(out / VOCABULARY)
    (out / "config.json").write_bytes(msgspec.json.format(msgspec.json.encode(config)))
    model = _begun(config, vocabulary).to(device)
    learner = Learner(model, config, began)
    make = partial(batch_of, reader=reader_on(device), device=device)
    packer = Packer(sentence_tokenizer(WEIGHTS), vocabulary, config.batch)
    valid = [make(padded) for padded in packer(lessons.valid())]
    learnt = 0 if cut_short is None else go_on(cut_short, model, learner)
    ready = Growth(lessons, vocabulary, WEIGHTS, config.batch)
    chunks = stream(ready, config.growers, learnt * chunks_an_epoch(config))
    told = (out / LOG).read_bytes().splitlines(keepends=True)[:learnt] if learnt else []
    with (out / LOG).open("wb") as log, closing(chunks):
        log.writelines(told)
        for number in range(learnt + 1, config.epochs + 1):
            if number > 1 and learner.out_of_time:
                break
            started = time.monotonic()
            padded = chain.from_iterable(islice(chunks, chunks_an_epoch(config)))
            loss = learner.epoch(number, ahead(padded, make))
            entry = Epoch(number, loss, *evaluate(model, valid), time.monotonic() - started)
            log.write(msgspec.json.encode(entry) + b"\n")
            log.flush()
            save_file(model.state_dict(), out / CHECKPOINT)
            save(out, config, model, learner, number)
            print(
                f"epoch {number}: train {entry.train:.4f} valid {entry.valid:.4f} "
                f"right {entry.right:.3f} ({entry.seconds:.0f} s)", file=sys.stderr, flush=True,
            )  # fmt: skip
    export_model(model.cpu(), out)
    over(out)
    return model


def chunks_an_epoch(config: TrainConfig) -> int:
    """How many chunks of lessons an epoch takes."""
    return 1 if config.corpus == "paper" else max(1, round(config.samples / CHUNK))


def lessons_of(config: TrainConfig) -> Lessons:
    """What a configuration learns from."""
    if config.corpus == "paper":
        return PaperLessons(
            config.tasks, config.copies, config.joined, config.seed, config.wordings
        )
    if config.corpus == "docstrings":
        return DocstringLessons(config.seed)
    return SeedLessons(config.wordings, config.seed)


def _vocabulary(config: TrainConfig, lessons: Lessons) -> Vocabulary:
    """The one that the configuration names, that of the run which it goes on from where that has
    the same dialect, with what new programs need, or one of the programs to be learnt."""
    dialect = DIALECTS[config.corpus]
    if config.vocabulary:
        return Vocabulary.load(Path(config.vocabulary) / VOCABULARY)
    first = [one for number in range(FIRST) for one in lessons.chunk(number)]
    known = first if config.corpus == "paper" else [*first, *lessons.valid()]
    if config.start:
        spoken = spoken_in(Path(config.start))
        if spoken.dialect == dialect:
            return spoken.with_tokens_of(lesson.program for lesson in known)
    return build_vocabulary(
        [lesson.program for lesson in known], [lesson.text for lesson in first],
        config.merges, dialect,
    )  # fmt: skip


def _begun(config: TrainConfig, vocabulary: Vocabulary) -> Model:
    """The model as training finds it: fresh, or as an earlier run left it."""
    slots = 0 if vocabulary.dialect == "paper" else len(SLOTS)
    model = build_model(config, len(vocabulary.pieces), slots)
    if config.start:
        start = Path(config.start)
        model.load_state_dict(
            carried(learnt_in(start), spoken_in(start), model.state_dict(), vocabulary)
        )
    return model


def learnt_in(folder: Path) -> dict[str, Tensor]:
    """The weights of a run, or of a network that serves."""
    checkpoint = folder / CHECKPOINT
    if served(folder) and not checkpoint.is_file():
        return served_weights(folder)
    return load_file(checkpoint)


def spoken_in(folder: Path) -> Vocabulary:
    """The vocabulary of a run; networks that serve together share one, a folder above."""
    own = folder / VOCABULARY
    return Vocabulary.load(own if own.is_file() else folder.parent / VOCABULARY)


def carried(
    learnt: Mapping[str, Tensor], before: Vocabulary, fresh: Mapping[str, Tensor], now: Vocabulary
) -> dict[str, Tensor]:
    """Weights learnt with one vocabulary for another: pieces that both have keep their rows, new
    ones start from the ``fresh`` weights. Of slots no more are kept than there are."""
    both = [(i, before.pieces.index(piece)) for i, piece in enumerate(now.pieces)
            if piece in before.pieces]  # fmt: skip
    rows, old = (torch.tensor(index) for index in zip(*both, strict=True))
    weights = {}
    for name, tensor in fresh.items():
        if name.startswith(("tokens.", "output.")):
            tensor = tensor.clone()
            tensor[rows] = learnt[name][old]
        elif name.startswith("slots."):
            tensor = learnt[name][: len(tensor)]
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


def digest(path: Path) -> str:
    """SHA-256 of a file, for the card."""
    return hashlib.sha256(path.read_bytes()).hexdigest()

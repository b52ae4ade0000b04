"""Fine-tune a pretrained language model on the corpus: `armchat train pretrained --config
configs/pretrained.toml --out runs/pretrained`.

Cross-entropy with teacher forcing over the program's pieces, AdamW on low-rank adapters and on the
rows of the pieces; the rate rises and falls by the clock, so that a run ends when it was told to,
on a GPU where there is one. A run that was cut off goes on where it was saved. Writes
``lessons.npz``, ``vocabulary.json`` and ``adapter.safetensors`` (with configuration and log) into
one folder. Needs the ``[pretrained]`` extra.
"""

from __future__ import annotations

import math
import sys
import time
import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path

import msgspec
import numpy as np
import torch
from safetensors import safe_open
from safetensors.torch import load_file, save_file
from torch import Tensor, nn

from agent.errors import ConfigError
from translator.lora import adapt
from translator.speech import Speech, Words
from translator.tuned import Tuned, load_base, tuned
from translator.vocabulary import Vocabulary
from translator.written import Texts, Written, write

OURS = Path(__file__).parent / "weights" / "skills" / "vocabulary.json"
"""The pieces that programs are written in, unless the folder of the run has others."""
IGNORED = -100
WRITING = 0.2
"""Rate of the rows that write, against that of all else: what the last layer tells is large, so a
small step in a row is a large one in a logit."""
TALK, SAVE = 20.0, 60.0
"""Seconds between two lines of the log, and between two states that are kept."""


class TuneConfig(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One run. ``base``: folder of the pretrained model; ``share``: of the wordings that the corpus
    has; ``samples``: sentences grown from them, read again and again for ``seconds``;
    ``numbers``: at most so many in a batch; ``warmup``: share of the time."""

    base: str
    share: float = 1.0
    samples: int = 220_000
    rank: int = 24
    seconds: float = 14_400.0
    numbers: int = 2_048
    learning_rate: float = 1e-3
    warmup: float = 0.03
    clip: float = 1.0
    seed: int = 0


class Checked(msgspec.Struct, frozen=True):
    """One line of the log: after so many ``seconds`` and ``lessons``, mean loss a piece (nats) on
    what was just learnt and on held-out wordings, and the share of those whose every piece was the
    likeliest behind the true ones before it."""

    seconds: float
    lessons: int
    train: float
    valid: float
    exact: float


def read_config(path: Path) -> TuneConfig:
    """The configuration of a TOML file. Raises ConfigError naming file and key."""
    try:
        return msgspec.convert(tomllib.loads(path.read_text(encoding="utf-8")), TuneConfig)
    except (OSError, ValueError, msgspec.ValidationError) as error:
        raise ConfigError(f"{path}: {error}") from error


Clock = Callable[[], float]
"""Seconds from some moment on."""


def tune(config: TuneConfig, out: Path, clock: Clock = time.perf_counter) -> list[Checked]:
    """Write the lessons unless they are there, learn, and write the adapter into ``out``."""
    out.mkdir(parents=True, exist_ok=True)
    if not (out / "lessons.npz").exists():
        given = out / "vocabulary.json"
        vocabulary = Vocabulary.load(given if given.exists() else OURS)
        vocabulary.save(given)
        speech = Speech(Words(Path(config.base)), vocabulary)
        write(speech, config.samples, config.share, config.seed).save(out / "lessons.npz")
    return learn(config, Written.load(out / "lessons.npz"), out / "adapter.safetensors", clock)


def learn(
    config: TuneConfig, lessons: Written, path: Path, clock: Clock = time.perf_counter
) -> list[Checked]:
    """Learn for as long as the configuration says, keeping the state at ``path``; the log."""
    torch.manual_seed(config.seed)
    device = torch.device("cuda" if torch.cuda.is_available() else "cpu")
    model, log = _model(config, lessons, path, device)
    learner = Learner(model, config, log[-1] if log else None, clock)
    train, valid = OnDevice(lessons.train, device), OnDevice(lessons.valid, device)
    chance = np.random.default_rng([config.seed, len(log)])
    told = kept = learner.seconds
    for batch in _endless(lessons.train, config.numbers, chance):
        learner.learn(train.batch(batch))
        now = learner.seconds
        over = now >= config.seconds
        if now - kept >= SAVE or over:
            log.append(_checked(learner, valid, lessons.valid, config.numbers))
            _keep(model, config, log, path)
            print(_line(log[-1]), file=sys.stderr, flush=True)
            told = kept = now
        elif now - told >= TALK:
            print(f"{now:.0f} s, {learner.lessons} lessons, loss {learner.loss():.4f}",
                  file=sys.stderr, flush=True)  # fmt: skip
            told = now
        if over:
            break
    return log


def _model(
    config: TuneConfig, lessons: Written, path: Path, device: torch.device
) -> tuple[Tuned, list[Checked]]:
    """The adapted base as it starts, or as it was kept, and the log until then."""
    base = load_base(config.base, torch.bfloat16)
    model = tuned(base, torch.from_numpy(lessons.rows), lessons.spelling)
    adapt(model.body, config.rank)
    log: list[Checked] = []
    if path.exists():
        kept = load_file(path)
        for name, weight in model.weights().items():
            weight.data = kept[name].to(weight)
        with safe_open(path, "pt") as file:
            log = msgspec.json.decode(file.metadata()["log"], type=list[Checked])
    return model.to(device), log


def _endless(
    texts: Texts, budget: int, chance: np.random.Generator
) -> Iterator[np.ndarray[tuple[int], np.dtype[np.int64]]]:
    while True:
        yield from texts.batches(budget, chance)


class Batch(msgspec.Struct, frozen=True):
    """numbers (B, L), places (B, P) in front of each piece of the program, targets (B, P)."""

    numbers: Tensor
    places: Tensor
    targets: Tensor


class OnDevice:
    """Lessons where the model is."""

    def __init__(self, texts: Texts, device: torch.device) -> None:
        ends = np.cumsum(texts.sizes.sum(1, dtype=np.int64))
        self._sizes = texts.sizes.astype(np.int64)
        self._numbers = torch.from_numpy(texts.numbers.astype(np.int32)).to(device)
        self._starts = ends - self._sizes.sum(1)
        self._device = device

    def batch(self, lessons: np.ndarray[tuple[int], np.dtype[np.int64]]) -> Batch:
        """These lessons, padded behind."""
        sizes = self._sizes[lessons]
        length = -8 * (-int(sizes.sum(1).max()) // 8)
        told = torch.from_numpy(np.stack([self._starts[lessons], *sizes.T])).to(self._device)
        start, sentence, program = told[:, :, None]  # (B, 1) each
        at = torch.arange(length, device=self._device)
        numbers = self._numbers[(start + at).clamp(max=len(self._numbers) - 1)].long()
        numbers = torch.where(at < sentence + program, numbers, 0)
        behind = torch.arange(int(sizes[:, 1].max()), device=self._device)
        places = (sentence - 1 + behind).clamp(max=length - 2)
        targets = torch.where(behind < program, numbers.gather(1, places + 1), IGNORED)
        return Batch(numbers, places, targets)


class Learner:
    """AdamW over what is ours, by the clock."""

    def __init__(
        self, model: Tuned, config: TuneConfig, before: Checked | None, clock: Clock
    ) -> None:
        self.lessons = before.lessons if before else 0
        self._clock = clock
        self._began = clock() - (before.seconds if before else 0.0)
        self._model = model
        self._config = config
        self._ours = list(model.weights().values())
        others = [weight for weight in self._ours if weight is not model.write]
        self._optimizer = torch.optim.AdamW(
            [{"params": others, "pace": 1.0}, {"params": [model.write], "pace": WRITING}],
            lr=config.learning_rate, betas=(0.9, 0.99), weight_decay=0.0, fused=model.read.is_cuda,
        )  # fmt: skip
        self._losses: list[Tensor] = []

    @property
    def seconds(self) -> float:
        """How long was learnt, an earlier run that this one goes on from included."""
        return self._clock() - self._began

    def loss(self) -> float:
        """The mean loss since it was last asked for."""
        losses, self._losses = self._losses, []
        return float(torch.stack(losses).mean()) if losses else math.nan

    def learn(self, batch: Batch) -> None:
        """One step."""
        gone = self.seconds / self._config.seconds if self._config.seconds else 1.0
        for group in self._optimizer.param_groups:
            group["lr"] = group["pace"] * self._rate(min(1.0, gone))
        loss, _ = losses(self._model, batch)
        loss.backward()  # type: ignore[no-untyped-call]
        nn.utils.clip_grad_norm_(self._ours, self._config.clip)
        self._optimizer.step()
        self._optimizer.zero_grad(set_to_none=True)
        self._losses.append(loss.detach())
        self.lessons += len(batch.numbers)

    def _rate(self, gone: float) -> float:
        warm = self._config.warmup
        shape = gone / warm if gone < warm else 0.5 + 0.5 * math.cos(
            math.pi * (gone - warm) / (1 - warm)
        )  # fmt: skip
        return self._config.learning_rate * max(shape, 1e-3)

    def check(self, batches: Iterator[Batch]) -> tuple[float, float]:
        """Mean loss a piece, and the share of lessons with every piece the likeliest."""
        total = pieces = right = count = 0.0
        with torch.no_grad():
            for batch in batches:
                loss, told = losses(self._model, batch)
                asked = batch.targets != IGNORED
                total += float(loss) * float(asked.sum())
                pieces += float(asked.sum())
                right += float(((told == batch.targets) | ~asked).all(1).sum())
                count += len(asked)
        return total / pieces, right / count


def losses(model: Tuned, batch: Batch) -> tuple[Tensor, Tensor]:
    """Mean loss a piece, and the likeliest pieces (B, P), numbered behind the words."""
    with torch.autocast(batch.numbers.device.type, torch.bfloat16):
        logits = model(batch.numbers, batch.places)
    words = len(model.get_buffer("words"))
    targets = torch.where(batch.targets == IGNORED, IGNORED, batch.targets - words)
    loss = nn.functional.cross_entropy(
        logits.float().flatten(0, 1), targets.flatten(), ignore_index=IGNORED
    )
    return loss, logits.argmax(-1) + words


def _checked(learner: Learner, valid: OnDevice, texts: Texts, budget: int) -> Checked:
    order = texts.batches(budget, np.random.default_rng(0))
    loss, exact = learner.check(valid.batch(lessons) for lessons in order)
    return Checked(learner.seconds, learner.lessons, learner.loss(), loss, exact)


def _line(entry: Checked) -> str:
    return (f"{entry.seconds:.0f} s, {entry.lessons} lessons: train {entry.train:.4f} "
            f"valid {entry.valid:.4f} exact {entry.exact:.3f}")  # fmt: skip


def _keep(model: Tuned, config: TuneConfig, log: list[Checked], path: Path) -> None:
    """Write what is ours, halved in precision; complete or not at all."""
    weights = {
        name: weight.detach().to("cpu", torch.float16).contiguous()
        for name, weight in model.weights().items()
    }
    told = {"config": config, "log": log}
    metadata = {name: msgspec.json.encode(one).decode() for name, one in told.items()}
    unfinished = path.with_name(f"{path.name}.part")
    save_file(weights, unfinished, metadata)
    unfinished.rename(path)

"""Does pre-training our own small model pay? Docstrings first, against nothing first.

    python -m evals.pretraining OUT [--runs CORPUS:SEED:EPOCHS ...]

The product's Transformer learns `configs/docstrings.toml` once, then each run's corpus (``seeds``
or ``paper``) from there, and from nothing with the same seed, rates and sentences. What OUT holds
already is not trained again. Prints a Markdown table: loss a symbol (nats) and the share of
programs with every symbol right behind the true ones before it, on wordings held out. Needs the
``[train]`` extra.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import msgspec
from msgspec.structs import replace

from evals.tally import Share, share
from translator.course import TrainConfig, read_config
from translator.embed import sentence_tokenizer
from translator.lessons import Lesson, Packer
from translator.train import LOG, Epoch, lessons_of, train
from translator.translate import WEIGHTS
from translator.vocabulary import Vocabulary

CONFIGS = Path("configs")
ARMS = ("plain", "docstrings")
"""From nothing, and from a run of the docstrings."""
RUNS = ("seeds:0:3", "seeds:1:1", "paper:0:4")


class Line(NamedTuple):
    """One corpus and seed after so many sentences: valid loss and share right, by arm; ``n``
    valid programs."""

    corpus: str
    seed: int
    sentences: int
    loss: tuple[float, ...]
    right: tuple[Share, ...]


def course(corpus: str, seed: int, epochs: int) -> TrainConfig:
    """What both arms learn with: rates that halve from epoch to epoch, 24,000 sentences each of
    the seeds, or each of the paper's pairs sixteen times."""
    config = replace(
        read_config(CONFIGS / "skills.toml"), epochs=epochs, warmup=100, threads=1, seed=seed
    )
    config = replace(config, final_rate=config.learning_rate / 2 ** (epochs - 1))
    if corpus == "seeds":
        return config
    return replace(config, corpus="paper", copies=16, joined=0.4, batch=32, merges=160)


def trained(config: TrainConfig, folder: Path) -> list[Epoch]:
    """The log of a run of this configuration, which is trained where it is not."""
    log = folder / LOG
    if not log.is_file() or len(log.read_bytes().splitlines()) < config.epochs:
        print(f"training {folder}", file=sys.stderr)
        train(config, folder)
    lines = log.read_bytes().splitlines()[: config.epochs]
    return [msgspec.json.decode(line, type=Epoch) for line in lines]


def measured(out: Path, corpus: str, seed: int, epochs: int) -> Iterator[Line]:
    """Both arms of one corpus and seed, epoch by epoch."""
    config = course(corpus, seed, epochs)
    first = out / "docstrings"
    trained(replace(read_config(CONFIGS / "docstrings.toml"), threads=1), first)
    folders = [out / f"{corpus}-{arm}-{seed}" for arm in ARMS]
    nothing = trained(config, folders[0])
    after = trained(replace(config, start=str(first), vocabulary=str(folders[0])), folders[1])
    lessons = lessons_of(config)
    a_time = len(lessons.chunk(0)) if corpus == "paper" else config.samples
    n = _readable(lessons.valid(), folders[0], config.batch)
    for number, arms in enumerate(zip(nothing, after, strict=True), start=1):
        right = tuple(share(round(one.right * n), n) for one in arms)
        yield Line(corpus, seed, number * a_time, tuple(one.valid for one in arms), right)


def _readable(lessons: Sequence[Lesson], folder: Path, batch: int) -> int:
    """How many of these the vocabulary of a run can say; the others are not judged."""
    vocabulary = Vocabulary.load(folder / "vocabulary.json")
    packer = Packer(sentence_tokenizer(WEIGHTS), vocabulary, batch)
    return sum(len(padded.ids) for padded in packer(lessons))


def table(lines: Sequence[Line]) -> str:
    """The lines as a Markdown table; percent, ± the standard error over programs."""
    head = ["corpus", "seed", "sentences", "n", "from nothing: loss", "every symbol",
            "docstrings first: loss", "every symbol"]  # fmt: skip
    rows = [head, ["---"] * 2 + ["---:"] * 6]
    for line in lines:
        cells = [line.corpus, str(line.seed), f"{line.sentences:,}", str(line.right[0].n)]
        for loss, right in zip(line.loss, line.right, strict=True):
            assert right.rate is not None and right.se is not None
            cells += [f"{loss:.3f}", f"{100 * right.rate:.1f} ± {100 * right.se:.1f}"]
        rows.append(cells)
    return "\n".join(f"| {' | '.join(row)} |" for row in rows)


def main(arguments: Sequence[str] | None = None) -> int:
    """Train what is missing and print the table."""
    parser = argparse.ArgumentParser(prog="python -m evals.pretraining", description=__doc__)
    parser.add_argument("out", type=Path, metavar="OUT")
    parser.add_argument("--runs", nargs="+", default=RUNS, metavar="CORPUS:SEED:EPOCHS")
    options = parser.parse_args(arguments)
    runs = [run.split(":") for run in options.runs]
    lines = [line for corpus, seed, epochs in runs
             for line in measured(options.out, corpus, int(seed), int(epochs))]  # fmt: skip
    print(table(lines))
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""`armchat reproduce table1`: the paper's results table, on our corpus, beside the paper's figures.

Rows: seq2seq and baseline, for both tasks, as means over the training runs (seeds) that are given;
and the product's model, on the paper's metric and by outcome. Differences from the paper: our own
sentences in its split sizes; MiniLM in the place of BERT-base; one model for both tasks (the
decoder's first input names the task); decoding under the program grammar.
"""

from __future__ import annotations

import importlib.util
import math
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple, TextIO

import msgspec

from agent.errors import ConfigError
from agent.execute import Executor
from agent.messages import Kind
from evals.outcomes import WILD, play, read_cases
from evals.paper_metric import Predict, Score, deviation, score, seq2seq
from translator.corpus.load import Pair, load
from translator.translate import PAPER, PRODUCT, Translator

TASKS: tuple[Kind, ...] = ("arrange", "manipulate")
BASELINES = Path(__file__).parent / "weights"
MODEL_FILE, BASELINE_FILE = "vocabulary.json", "baseline_arrange.safetensors"
"""What tells a folder of a trained model, or of trained baselines, from one that holds several."""


class Runs(NamedTuple):
    """Folders of trained models: one a seed."""

    seq2seq: Sequence[Path] = (PAPER,)
    baselines: Sequence[Path] = (BASELINES,)
    product: Sequence[Path] = (PRODUCT,)


class Row(msgspec.Struct, frozen=True, kw_only=True):
    """One row: percent right and malformed, means over ``seeds``; ``n`` sentences.

    Each sentence is tried on so many ``scenes``. ``stderr`` is over sentences, ``spread`` the
    standard deviation between seeds (None of a single one), whose own figures are ``each``. In the
    row of outcomes ``ours`` is the share right or rightly asked; ``wrong`` is its own.
    """

    task: str
    model: str
    paper: float | None
    ours: float | None = None
    stderr: float | None = None
    spread: float | None = None
    malformed: float | None = None
    wrong: float | None = None
    each: tuple[float, ...] = ()
    n: int
    seeds: int
    scenes: int
    why: str | None = None


def folders(given: Sequence[str], bundled: Path, file: str) -> list[Path]:
    """The folders of trained models among those given: each, or those of the seeds in it.

    ``bundled`` stands for the committed one. Raises ConfigError for a folder that holds none.
    """
    found: list[Path] = []
    for name in given:
        folder = bundled if name == "bundled" else Path(name)
        seeds = [one.parent for one in sorted(folder.glob(f"*/{file}"))]
        here = [folder] if (folder / file).is_file() else seeds
        if not here:
            raise ConfigError(f"{folder}: no {file} in it, nor in a folder in it")
        found += here
    return found


def both_models(paper: str, product: str) -> dict[str, Translator]:
    """The paper's model and the product's by name, each bundled or of a folder."""
    given = (("paper", paper, PAPER), ("product", product, PRODUCT))
    return {
        name: Translator(folders([one], bundled, MODEL_FILE)[0]) for name, one, bundled in given
    }


def reproduce(runs: Runs, scenes: int, wild: bool, as_json: bool, out: TextIO) -> int:
    """Measure and print the table; 0, or 1 when a row could not be measured."""
    printed = tomllib.loads((Path(__file__).parent / "paper.toml").read_text())["table1"]
    rows = []
    with Executor() as executor:
        for task in TASKS:
            pairs = [pair for pair in load(task) if pair.split == "test"]
            for name, given in (("seq2seq", runs.seq2seq), ("product", runs.product)):
                models = [seq2seq(Translator(folder), executor) for folder in given]
                rows.append(_row(name, printed, pairs, models, executor, scenes))
            rows.append(_baseline_row(printed, pairs, runs.baselines, executor, scenes))
    rows += [_outcomes()] if wild else []
    if as_json:
        out.write(msgspec.json.encode(rows).decode() + "\n")
    else:
        out.write(_table(rows))
    return int(any(row.ours is None for row in rows))


def over_seeds(scores: Sequence[Score]) -> Score:
    """The mean of several seeds' scores, sentence by sentence."""
    shares = zip(*(one.per_sentence for one in scores), strict=True)
    return Score(
        tuple(sum(of_seeds) / len(scores) for of_seeds in shares),
        sum(one.malformed for one in scores) / len(scores),
    )


def _row(
    model: str, printed: dict[str, float], pairs: Sequence[Pair], models: Sequence[Predict],
    executor: Executor, scenes: int,
) -> Row:  # fmt: skip
    found = [score(pairs, one, executor, scenes) for one in models]
    mean, task = over_seeds(found), pairs[0].kind
    each = tuple(100 * one.accuracy for one in found)
    spread = deviation(each) if len(each) > 1 else None
    return Row(
        task=task, model=model, paper=printed.get(f"{task}_{model}"), ours=100 * mean.accuracy,
        stderr=100 * mean.standard_error, spread=spread, malformed=100 * mean.malformed,
        each=each, n=len(pairs), seeds=len(found), scenes=scenes,
    )  # fmt: skip


def _baseline_row(
    printed: dict[str, float], pairs: Sequence[Pair], given: Sequence[Path], executor: Executor,
    scenes: int,
) -> Row:  # fmt: skip
    task = pairs[0].kind
    if importlib.util.find_spec("torch") is None:
        return Row(
            task=task, model="baseline", paper=printed[f"{task}_baseline"], n=len(pairs),
            seeds=len(given), scenes=scenes,
            why="the baselines run in torch: pip install 'armchat[train]'",
        )  # fmt: skip
    from evals.baselines import baseline

    models = [baseline(task, folder) for folder in given]
    return _row("baseline", printed, pairs, models, executor, scenes)


def _outcomes() -> Row:
    """The product as a whole, clarifier included, on sentences by other hands: by outcome."""
    files = sorted(WILD.glob("wild_*.jsonl"))
    found = [one.outcome for one in play(case for path in files for case in read_cases(path))]
    right, wrong = (100 * found.count(kind) / len(found) for kind in ("right", "wrong"))
    return Row(
        task="wild", model="product", paper=None, ours=right, wrong=wrong, n=len(found),
        stderr=math.sqrt(right * (100 - right) / len(found)), seeds=1, scenes=1,
    )  # fmt: skip


def _table(rows: Sequence[Row]) -> str:
    lines = [
        f"{'task':11} {'model':9} {'paper %':>8} {'ours %':>8} {'± se':>6} {'spread':>7} "
        f"{'malformed %':>12} {'n':>4} {'seeds':>6} {'scenes':>7}"
    ]
    for row in rows:
        start = f"{row.task:11} {row.model:9} {_number(row.paper, 8)} "
        if row.ours is None:
            lines.append(f"{start}not measured: {row.why}")
            continue
        lines.append(
            f"{start}{_number(row.ours, 8)} {_number(row.stderr, 6)} {_number(row.spread, 7)} "
            f"{_number(row.malformed, 12, 2)} {row.n:4} {row.seeds:6} {row.scenes:7}"
        )
    lines += [
        f"wild: sentences by other hands, by outcome: {row.ours:.1f} % right or rightly asked, "
        f"{row.wrong:.1f} % wrong."
        for row in rows
        if row.wrong is not None
    ]
    lines += [
        "± se: standard error over sentences; spread: standard deviation between seeds.",
        "The paper's protocol on our corpus; deviations: docs/reproduction.md.",
    ]
    return "\n".join(lines) + "\n"


def _number(value: float | None, width: int, digits: int = 1) -> str:
    return f"{'-':>{width}}" if value is None else f"{value:{width}.{digits}f}"

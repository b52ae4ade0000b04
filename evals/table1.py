"""`armchat reproduce table1`: the paper's results table, on our corpus, beside the paper's figures.

Rows: seq2seq and baseline, for both tasks. Differences from the paper: our own sentences in its
split sizes; MiniLM in the place of BERT-base; one model for both tasks (the decoder's first input
names the task); decoding under the program grammar.
"""

from __future__ import annotations

import importlib.util
import tomllib
from pathlib import Path
from typing import TextIO

import msgspec

from agent.execute import Executor
from agent.messages import Kind
from evals.paper_metric import Score, score, seq2seq
from translator.corpus.load import load
from translator.translate import PAPER, PRODUCT, Translator

TASKS: tuple[Kind, ...] = ("arrange", "manipulate")


class Row(msgspec.Struct, frozen=True):
    """One row: percent right and malformed, n sentences on so many scenes each."""

    task: str
    model: str
    paper: float
    ours: float | None
    stderr: float | None
    malformed: float | None
    n: int
    scenes: int
    why: str | None = None


def reproduce(weights: Path | None, scenes: int, as_json: bool, out: TextIO) -> int:
    """Measure and print the table; 0, or 1 when a row could not be measured."""
    printed = tomllib.loads((Path(__file__).parent / "paper.toml").read_text())["table1"]
    rows = []
    with Executor() as executor:
        for task in TASKS:
            pairs = [pair for pair in load(task) if pair.split == "test"]
            for name, folder in (("seq2seq", weights or PAPER), ("product", PRODUCT)):
                model = seq2seq(Translator(folder), executor)
                found = score(pairs, model, executor, scenes)
                rows.append(_row(task, name, printed, found, scenes))
            rows.append(_baseline_row(task, printed, executor, scenes))
    if as_json:
        out.write(msgspec.json.encode(rows).decode() + "\n")
    else:
        out.write(_table(rows))
    return int(any(row.ours is None for row in rows))


_LIKE = {"product": "seq2seq"}
"""Which row of the paper's ours stands beside."""


def _row(task: Kind, model: str, printed: dict[str, float], found: Score, scenes: int) -> Row:
    return Row(
        task, model, printed[f"{task}_{_LIKE.get(model, model)}"], 100 * found.accuracy,
        100 * found.standard_error, 100 * found.malformed, len(found.per_sentence), scenes,
    )  # fmt: skip


def _baseline_row(task: Kind, printed: dict[str, float], executor: Executor, scenes: int) -> Row:
    pairs = [pair for pair in load(task) if pair.split == "test"]
    if importlib.util.find_spec("torch") is None:
        why = "the baselines run in torch: pip install 'armchat[train]'"
        paper = printed[f"{task}_baseline"]
        return Row(task, "baseline", paper, None, None, None, len(pairs), scenes, why)
    from evals.baselines import baseline

    return _row(task, "baseline", printed, score(pairs, baseline(task), executor, scenes), scenes)


def _table(rows: list[Row]) -> str:
    lines = [
        f"{'task':11} {'model':9} {'paper %':>8} {'ours %':>8} {'± se':>6} "
        f"{'malformed %':>12} {'n':>4} {'scenes':>7}"
    ]
    for row in rows:
        if row.ours is None or row.stderr is None or row.malformed is None:
            lines.append(f"{row.task:11} {row.model:9} {row.paper:8.1f} not measured: {row.why}")
            continue
        lines.append(
            f"{row.task:11} {row.model:9} {row.paper:8.1f} {row.ours:8.1f} {row.stderr:6.1f} "
            f"{row.malformed:12.2f} {row.n:4} {row.scenes:7}"
        )
    lines.append("The paper's protocol on our corpus; deviations: docs/reproduction.md.")
    return "\n".join(lines) + "\n"

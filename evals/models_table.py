"""Does pre-training pay? Translators beside each other, each in a process of its own.

    python -m evals.models_table NAME=MODEL[:BASE[:ADAPTER]] ... [--sets SET=FILE,FILE ...]
        [--most N] [--timed N] [--json OUT]

MODEL is what `[translator] model` takes; BASE and ADAPTER belong to a pretrained one ("none": shown
examples). For each: the paper's metric on the paper's test split, outcomes on sets of cases
(default: the wild sets), malformed candidates, time for a translation, memory of the process.
``--most N`` plays at most N cases of each file, and as many of each task's test split, evenly
spaced. Sets from outside are read where they lie.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from statistics import median_low

import msgspec

from agent.compose import speakers
from agent.errors import NotAllowed
from agent.execute import Executor
from agent.messages import TranslateRequest
from agent.program import instantiate, parse
from agent.speaking import Translates
from evals.cases import Case, Score, some
from evals.grown import held_out
from evals.outcomes import WILD, play, read_cases
from evals.paper_metric import score, seq2seq
from evals.table1 import TASKS
from evals.tally import Share, share
from evals.watched import watched
from translator.corpus.load import load

TIMED = 60
"""Held-out grown sentences, for the times and the malformed candidates."""
SCENES = 20
Sets = Mapping[str, Sequence[Path]]


class Outcomes(msgspec.Struct, frozen=True, kw_only=True):
    """What became of a set: done rightly, asked (or refused) rightly, wrong."""

    right: Share
    rightly_asked: Share
    wrong: Share


class Row(msgspec.Struct, frozen=True, kw_only=True):
    """One translator. ``paper``: percent right, standard error and sentences by task; ``malformed``
    of so many candidates; a translation by the clock (``p50``, ``p95``) and of the ``processor`` on
    all threads (median), ms; ``memory`` at most, MB; ``sets`` by name."""

    name: str
    paper: dict[str, tuple[float, float, int]]
    malformed: tuple[int, int]
    p50: float
    p95: float
    processor: float
    memory: float
    sets: dict[str, Outcomes]


def row(name: str, sets: Sets, most: int | None, timed: int) -> Row:
    """The row of the translator that is configured, measured in this process."""
    translate = speakers().whole()
    clock, processor, malformed = _times(translate, timed)
    cases = {one: _cases(paths, most) for one, paths in sets.items()}
    played = {one: _outcomes(play(watched(each, f"{name}: {one}", len(each))))
              for one, each in cases.items()}  # fmt: skip
    return Row(
        name=name, paper=_paper(translate, most), malformed=malformed,
        p50=median_low(clock), p95=sorted(clock)[int(0.95 * (len(clock) - 1))],
        processor=median_low(processor),
        memory=resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024, sets=played,
    )  # fmt: skip


def _cases(paths: Sequence[Path], most: int | None) -> list[Case]:
    return [case for path in paths for case in some(read_cases(path), most)]


def _paper(translate: Translates, most: int | None) -> dict[str, tuple[float, float, int]]:
    found: dict[str, tuple[float, float, int]] = {}
    with Executor() as executor:
        for task in TASKS:
            pairs = some([pair for pair in load(task) if pair.split == "test"], most)
            result = score(pairs, seq2seq(translate, executor), executor, SCENES)
            found[task] = (100 * result.accuracy, 100 * result.standard_error, len(pairs))
    return found


def _times(translate: Translates, count: int) -> tuple[list[float], list[float], tuple[int, int]]:
    """Milliseconds of each translation by the clock, and of the processor (what else the machine
    does hardly shows in them); how many candidates are malformed, of all."""
    clock, processor, bad, total = list[float](), list[float](), 0, 0
    for asked, _ in watched(held_out(count, seed=31), "held-out sentences", count):
        began = time.process_time()
        translation = translate(asked)
        processor.append(1000 * (time.process_time() - began))
        clock.append(translation.ms)
        for candidate in translation.candidates:
            total += 1
            bad += is_malformed(candidate.body, asked)
    return clock, processor, (bad, total)


def is_malformed(body: str, asked: TranslateRequest) -> bool:
    """Whether the parser or the allow-list refuses a candidate over a request's slots."""
    names = {one.slot: f"[a{one.slot}, b{one.slot}]" if one.plural else f"a{one.slot}"
             for one in asked.mentions}  # fmt: skip
    known = [name.strip("[] ") for text in names.values() for name in text.split(",")]
    try:
        parse(
            instantiate(body, {**names, **{one.slot: "0.5" for one in asked.measures}}),
            asked.kind, known,
        )  # fmt: skip
    except NotAllowed:
        return True
    return False


def _outcomes(scores: Sequence[Score]) -> Outcomes:
    right = [one for one in scores if one.outcome == "right"]
    done = sum(one.turns[-1].status == "done" for one in right)
    wrong = sum(one.outcome == "wrong" for one in scores)
    return Outcomes(
        right=share(done, len(scores)), rightly_asked=share(len(right) - done, len(scores)),
        wrong=share(wrong, len(scores)),
    )  # fmt: skip


def environment(model: str) -> Mapping[str, str]:
    """The configuration of MODEL[:BASE[:ADAPTER]] as environment variables."""
    names = ("MODEL", "BASE", "ADAPTER")
    parts = zip(names, model.split(":"), strict=False)
    return {f"ARMCHAT_TRANSLATOR__{name}": value for name, value in parts if value}


def _apart(name: str, model: str, arguments: Sequence[str]) -> Row:
    """The row, measured in a process of its own."""
    command = [sys.executable, "-m", "evals.models_table", "--row", name, *arguments]
    done = subprocess.run(
        command, env={**os.environ, **environment(model)}, stdout=subprocess.PIPE, check=True
    )
    return msgspec.json.decode(done.stdout, type=Row)


def table(rows: Sequence[Row]) -> str:
    """The rows as a Markdown table; percent, ± the standard error."""
    sets = list(rows[0].sets)
    head = ["model", *(f"paper {task} (n {rows[0].paper[task][2]})" for task in TASKS), *(
        f"{name}: right / rightly asked / wrong (n {rows[0].sets[name].right.n})" for name in sets
    ), "malformed", "p50 / p95 ms", "processor ms", "MB"]  # fmt: skip
    lines = [head, ["---"] * len(head)]
    for one in rows:
        paper = [f"{one.paper[task][0]:.0f} ± {one.paper[task][1]:.0f}" for task in TASKS]
        told = [" / ".join(map(_percent, (one.sets[name].right, one.sets[name].rightly_asked,
                                          one.sets[name].wrong))) for name in sets]  # fmt: skip
        ends = [f"{one.malformed[0]} of {one.malformed[1]}", f"{one.p50:.0f} / {one.p95:.0f}",
                f"{one.processor:.0f}", f"{one.memory:.0f}"]  # fmt: skip
        lines.append([one.name, *paper, *told, *ends])
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def _percent(part: Share) -> str:
    return "–" if part.rate is None else f"{100 * part.rate:.1f} ± {100 * (part.se or 0.0):.1f}"


_WILD = "wild=" + ",".join(map(str, sorted(WILD.glob("wild_*.jsonl"))))


def _set(text: str) -> tuple[str, list[Path]]:
    """SET=FILE,FILE; Raises ValueError where a part is missing."""
    name, _, files = text.partition("=")
    if not name or not files:
        raise ValueError(f"{text!r} is not SET=FILE,FILE")
    return name, [Path(file) for file in files.split(",")]


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure the translators named and print the table."""
    parser = argparse.ArgumentParser(prog="python -m evals.models_table", description=__doc__)
    parser.add_argument("models", nargs="*", metavar="NAME=MODEL")
    parser.add_argument("--row", help=argparse.SUPPRESS)
    parser.add_argument("--sets", nargs="*", metavar="SET=FILE,FILE", default=[_WILD])
    parser.add_argument("--most", type=int, metavar="N")
    parser.add_argument("--timed", type=int, default=TIMED, metavar="N")
    parser.add_argument("--json", type=Path, metavar="OUT")
    options = parser.parse_args(arguments)
    if options.row is not None:
        sets = dict(map(_set, options.sets))
        told = row(options.row, sets, options.most, options.timed)
        print(msgspec.json.encode(told).decode())
        return 0
    handed_on = ["--timed", str(options.timed), "--sets", *options.sets]
    if options.most is not None:
        handed_on += ["--most", str(options.most)]
    rows = []
    for one in options.models:
        name, _, model = one.partition("=")
        rows.append(_apart(name, model, handed_on))
        print(table(rows[-1:]), file=sys.stderr, flush=True)
    print(table(rows))
    if options.json is not None:
        options.json.write_text(json.dumps(msgspec.to_builtins(rows), indent=1) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())

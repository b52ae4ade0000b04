"""`armchat reproduce phrases`: accuracy by the number of phrases, sentences whole and split.

The paper says of sentences of four phrases and more that the model falls back on what it was
trained on, and that each phrase is right once the sentence is split at its commas. Here one to five
test pairs of a task, nouns swapped apart, are joined by commas into one sentence, and their
programs into the true one. Split, each clause is translated alone, and the programs stand one after
the other: at the commas that join (``split``), or at every comma, those inside of a pair included
(``commas``), where a clause can refer to one before it.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from itertools import combinations
from typing import Literal, NamedTuple, TextIO

import msgspec

from agent.errors import ProgramError
from agent.execute import Executor
from agent.messages import Kind
from evals.paper_metric import (
    Path,
    Score,
    Translate,
    paths,
    score,
    seq2seq,
    share_right,
    translated,
    truth,
)
from evals.table1 import TASKS
from scene.types import Scene
from translator.corpus.load import Pair, load
from translator.data import Sample, nouns_of, set_apart
from translator.vocabulary import NOUNS

MOST = 5
"""Phrases of a sentence at most."""
TRIES = 200
"""Draws for one sentence: not all pairs go together (twelve nouns, a place for each thing)."""
COMMA = ", "
Way = Literal["whole", "split", "commas"]
WAYS: tuple[Way, ...] = ("whole", "split", "commas")


class Joined(NamedTuple):
    """Pairs as one sentence with one program, and what is true of it on each of its scenes."""

    pair: Pair
    clauses: tuple[Pair, ...]
    tables: Sequence[Scene]
    true: Sequence[Path]


class Row(msgspec.Struct, frozen=True):
    """Percent right with standard errors over ``n`` sentences, read in three ways."""

    task: str
    phrases: int
    model: str
    n: int
    right: dict[Way, float]
    stderr: dict[Way, float]


def together(parts: Sequence[Pair], rng: random.Random) -> tuple[Pair, tuple[Pair, ...]]:
    """The pairs about different objects, joined by commas; and each alone, as it stands in there.

    A single pair stays as it is.
    """
    if len(parts) == 1:
        return parts[0], (parts[0],)
    samples = [Sample(one.say.rstrip(".!? "), one.program, one.kind) for one in parts]
    clauses = tuple(
        msgspec.structs.replace(part, say=own.say, program=own.program)
        for part, own in zip(parts, set_apart(samples, rng), strict=True)
    )
    whole = msgspec.structs.replace(
        parts[0],
        id="+".join(one.id for one in parts),
        say=COMMA.join(one.say for one in clauses),
        program="\n".join(one.program for one in clauses),
    )
    return whole, clauses


def sentences(pairs: Sequence[Pair], phrases: int, executor: Executor, scenes: int) -> list[Joined]:
    """A sentence for each pair: the pair joined with others, in an order by chance (seeded).

    None for a pair that does not go together with so many others: `TRIES`.
    """
    if len(pairs) < phrases:
        return []
    drawn = (_sentence(lead, pairs, phrases, executor, scenes) for lead in pairs)
    return [one for one in drawn if one is not None]


def _sentence(
    lead: Pair, pairs: Sequence[Pair], phrases: int, executor: Executor, scenes: int
) -> Joined | None:
    rng = random.Random(f"phrases {lead.id} {phrases}")
    others = [one for one in pairs if one is not lead]
    for _ in range(TRIES):
        parts = [lead, *rng.sample(others, phrases - 1)]
        rng.shuffle(parts)
        if sum(len(nouns_of(f"{one.say} {one.program}")) for one in parts) > len(NOUNS):
            continue
        pair, clauses = together(parts, rng)
        for count in (1, scenes):  # most do not go together on the first scene already
            joined = _true(pair, clauses, executor, count)
            if joined is None or crowded(joined):
                break
        else:
            return joined
    return None


def _true(pair: Pair, clauses: tuple[Pair, ...], executor: Executor, scenes: int) -> Joined | None:
    """The sentence with what is true of it; None where there is no room for all of it."""
    try:
        return Joined(pair, clauses, *truth(pair, executor, scenes))
    except ProgramError:
        return None


def crowded(joined: Joined) -> bool:
    """Whether the true program of an arrangement puts things of two pairs into one place."""
    if joined.pair.kind != "arrange":
        return False
    owner = {
        noun: number
        for number, one in enumerate(joined.clauses)
        for noun in nouns_of(f"{one.say} {one.program}")
    }
    return any(
        owner[a.name] != owner[b.name]
        and abs(p[0] - q[0]) < (a.width + b.width) / 2
        and abs(p[1] - q[1]) < (a.height + b.height) / 2
        for table, path in zip(joined.tables, joined.true, strict=True)
        for (a, p), (b, q) in combinations(zip(table.tray, path, strict=True), 2)
    )


def program_of(joined: Joined, way: Way, translate: Translate) -> str | None:
    """What a model writes for the sentence; None if it writes nothing for one of its clauses."""
    if way == "whole":
        return translated(joined.pair, translate)
    clauses = joined.clauses
    if way == "commas":
        texts = joined.pair.say.split(COMMA)
        clauses = tuple(msgspec.structs.replace(joined.pair, say=text) for text in texts)
    programs = [translated(clause, translate) for clause in clauses]
    return None if None in programs else "\n".join(one for one in programs if one is not None)


def measure(given: Sequence[Joined], way: Way, translate: Translate, executor: Executor) -> Score:
    """The paper's metric for sentences read in one of the ways."""
    shares = []
    for joined in given:
        program = program_of(joined, way, translate)
        found = paths(program, joined.pair.kind, joined.tables, executor)
        shares.append(share_right(found, joined.true))
    return Score(tuple(shares), 0.0)


def right_alone(
    pairs: Sequence[Pair], translate: Translate, executor: Executor, scenes: int
) -> list[Pair]:
    """The pairs that a model does right on every scene, as they are."""
    model = seq2seq(translate, executor)
    return [one for one in pairs if score([one], model, executor, scenes).accuracy == 1.0]


def reproduce(
    models: Mapping[str, Translate], scenes: int, most: int, known: bool, as_json: bool, out: TextIO
) -> int:
    """Measure and print; always 0. ``known``: of pairs only that a model does right alone."""
    rows = []
    with Executor() as executor:
        for task in TASKS:
            pairs = [pair for pair in load(task) if pair.split == "test"]
            bases = {
                name: right_alone(pairs, translate, executor, scenes) if known else pairs
                for name, translate in models.items()
            }
            for phrases in range(1, most + 1):
                made: dict[tuple[str, ...], list[Joined]] = {}
                for name, base in bases.items():
                    ids = tuple(pair.id for pair in base)
                    if ids not in made:
                        made[ids] = sentences(base, phrases, executor, scenes)
                    if made[ids]:
                        rows.append(_row(task, phrases, name, made[ids], models[name], executor))
    out.write(msgspec.json.encode(rows).decode() + "\n" if as_json else _table(rows, scenes))
    return 0


def _row(
    task: Kind, phrases: int, name: str, given: Sequence[Joined], translate: Translate,
    executor: Executor,
) -> Row:  # fmt: skip
    found = {way: measure(given, way, translate, executor) for way in WAYS}
    right = {way: 100 * one.accuracy for way, one in found.items()}
    stderr = {way: 100 * one.standard_error for way, one in found.items()}
    return Row(task, phrases, name, len(given), right, stderr)


def _table(rows: Sequence[Row], scenes: int) -> str:
    heads = "".join(f"{way + ' %':>10} {'± se':>6}" for way in WAYS)
    lines = [f"{'task':11} {'phrases':>7} {'model':9}{heads} {'n':>4}"]
    for row in rows:
        cells = "".join(f"{row.right[way]:10.1f} {row.stderr[way]:6.1f}" for way in WAYS)
        lines.append(f"{row.task:11} {row.phrases:7} {row.model:9}{cells} {row.n:4}")
    lines += [
        f"Test pairs joined by commas; the paper's metric on {scenes} scenes; se over sentences.",
        "split: at the commas that join; commas: at every comma. Each clause is translated alone.",
    ]
    return "\n".join(lines) + "\n"

"""`armchat reproduce substitutions`: the paper's tests of robustness, on the test split.

The paper says: put, keep, place and put down are read alike, a dropped "the" changes
nothing, "right-top corner" is read as "top right"; flask or pitcher for bottle and chalice for cup
are not understood. Each sentence is translated before and after such a change; both programs run on
the same scenes.

- Verbs: each verb of placing ("leave the box ...", "get the sponge ...") is made "put" first.
- Object words: a pair that speaks of no bottle (cup) gets one in the place of its first noun.
- ``read``: the other word reaches the model, as in the paper. ``linked``: it is known to stand for
  the bottle (by what the scene shows, or by an answer), and the model reads what it always reads
  for a thing. The product's model never reads names.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple, TextIO

import msgspec

from agent.execute import Executor
from evals.paper_metric import (
    Fault,
    Path,
    Translate,
    alike,
    best,
    paths,
    request_of,
    share_right,
    standard_error,
    truth,
)
from evals.table1 import TASKS
from translator.corpus.load import Pair, load
from translator.data import nouns_of, rename, with_articles
from translator.translate import Translator

_PLACING = re.compile(r"\b(?:put down|put|place|keep|leave|lay|get|set)(?= (?:the|my) )")
_CORNER = re.compile(
    r"\b(top|upper|bottom|lower|near|far|front|back) (left|right)(?= (?:corner|one)\b)"
)
_THE = re.compile(r"\bthe ")
VERBS = ("keep", "place", "put down")
WORDS = (("flask", "bottle"), ("pitcher", "bottle"), ("chalice", "cup"))
"""Object words that no training sentence has, and what they are said for."""


class Change(NamedTuple):
    """A sentence before and after; ``words`` of the second sentence are other names of nouns.

    ``read``: the second sentence reaches the model as it stands.
    """

    test: str
    before: Pair
    after: Pair
    words: Mapping[str, str]
    read: bool = False


class Row(msgspec.Struct, frozen=True):
    """Percent right before and after, the standard error of their difference over ``n`` sentences;
    how many programs are others, and how many do something else on some scene."""

    test: str
    model: str
    n: int
    before: float
    after: float
    stderr: float
    changed: int
    otherwise: int


def changes(pairs: Sequence[Pair]) -> Iterator[Change]:
    """Every change of every sentence that it applies to."""
    for pair in pairs:
        put = _said(pair, _PLACING.sub("put", pair.say))
        if _PLACING.search(pair.say):
            for verb in VERBS:
                yield Change(f"put: {verb}", put, _said(put, _replaced_put(put.say, verb)), {})
    for pair in pairs:
        if _THE.search(pair.say):
            yield Change("the: dropped", pair, _said(pair, _THE.sub("", pair.say)), {})
    for pair in pairs:
        if _CORNER.search(pair.say):
            after = _said(pair, _CORNER.sub(r"\2-\1", pair.say))
            yield Change("top right: right-top", pair, after, {})
    for word, noun in WORDS:
        for read in (True, False):
            for pair in pairs:
                before = about(pair, noun)
                after = _said(before, re.sub(rf"\b{noun}\b", word, before.say))
                how = "read" if read else "linked"
                yield Change(f"{noun}: {word}, {how}", before, after, {word: noun}, read)


def _replaced_put(say: str, verb: str) -> str:
    return re.sub(r"\bput(?= (?:the|my) )", verb, say)


def _said(pair: Pair, say: str) -> Pair:
    return msgspec.structs.replace(pair, say=say)


def about(pair: Pair, noun: str) -> Pair:
    """The pair with this noun in the place of the first that its sentence names, if it has none."""
    nouns = nouns_of(pair.say)
    if noun in nouns:
        return pair
    names = {nouns[0]: noun}
    say = with_articles(rename(pair.say, names))
    return msgspec.structs.replace(pair, say=say, program=rename(pair.program, names))


class Trial(NamedTuple):
    """What came of one change: shares of scenes that are right, and whether anything is another."""

    before: float
    after: float
    changed: bool
    otherwise: bool


def attempt(change: Change, model: Translator, executor: Executor, scenes: int) -> Trial:
    """Translate before and after, and run both programs beside the true one."""
    tables, true = truth(change.before, executor, scenes)
    programs = (written(change.before, model), after(change, model))
    was, now = (paths(one, change.before.kind, tables, executor) for one in programs)
    same = all(_same(one, other) for one, other in zip(was, now, strict=True))
    return Trial(
        share_right(was, true), share_right(now, true), programs[0] != programs[1], not same
    )


def written(pair: Pair, translate: Translate, words: Mapping[str, str] | None = None) -> str | None:
    """The program for a pair's sentence over its nouns, other names of them linked."""
    request, names = request_of(pair, words=words or {})
    return best(translate(request).candidates, names)


def after(change: Change, model: Translator) -> str | None:
    """The program for the changed sentence."""
    if not change.read:
        return written(change.after, model, change.words)
    nouns = nouns_of(f"{change.before.say} {change.before.program}")
    return best(model.as_written(change.after.say, change.after.kind, nouns), {})


def _same(one: Path | Fault, other: Path | Fault) -> bool:
    if isinstance(one, Fault) or isinstance(other, Fault):
        return one is other
    return alike(one, other)


def reproduce(models: Mapping[str, Translator], scenes: int, as_json: bool, out: TextIO) -> int:
    """Measure and print; always 0."""
    pairs = [pair for task in TASKS for pair in load(task) if pair.split == "test"]
    tests: dict[str, list[Change]] = {}
    for change in changes(pairs):
        tests.setdefault(change.test, []).append(change)
    with Executor() as executor:
        rows = [
            _row(test, name, [attempt(one, model, executor, scenes) for one in made])
            for test, made in tests.items()
            for name, model in models.items()
            if model.reads_names or not made[0].read
        ]
    out.write(msgspec.json.encode(rows).decode() + "\n" if as_json else _table(rows, scenes))
    return 0


def _row(test: str, model: str, trials: Sequence[Trial]) -> Row:
    n = len(trials)
    return Row(
        test, model, n, 100 * sum(one.before for one in trials) / n,
        100 * sum(one.after for one in trials) / n,
        100 * standard_error([one.after - one.before for one in trials]),
        sum(one.changed for one in trials), sum(one.otherwise for one in trials),
    )  # fmt: skip


def _table(rows: Sequence[Row], scenes: int) -> str:
    lines = [
        f"{'test':24} {'model':9} {'n':>4} {'before %':>9} {'after %':>8} {'± se':>6} "
        f"{'other program':>14} {'does otherwise':>15}"
    ]
    lines += [
        f"{row.test:24} {row.model:9} {row.n:4} {row.before:9.1f} {row.after:8.1f} "
        f"{row.stderr:6.1f} {row.changed:14} {row.otherwise:15}"
        for row in rows
    ]
    lines.append(
        f"Test pairs of both tasks; the paper's metric on {scenes} scenes; se of the difference."
    )
    return "\n".join(lines) + "\n"

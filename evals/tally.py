"""Scores counted: outcomes by family or file, and how often it asked, turn by turn."""

from __future__ import annotations

import math
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import get_args

import msgspec

from agent.messages import Status, Turn
from evals.cases import Outcome, Score, Want

OUTCOMES: tuple[Outcome, ...] = get_args(Outcome)


class Share(msgspec.Struct, frozen=True):
    """``k`` of ``n``, with the binomial standard error; no rate where nothing was counted."""

    k: int
    n: int
    rate: float | None
    se: float | None


class Tally(msgspec.Struct, frozen=True, kw_only=True):
    """What became of ``n`` cases.

    ``over_ask``: of the turns that must not ask, those that asked; ``missed_ask``: of those that
    must ask, those that acted. A dialogue counts up to the turn that ended otherwise than allowed.
    """

    n: int
    outcomes: dict[Outcome, int]
    right: Share
    wrong: Share
    over_ask: Share
    missed_ask: Share
    metrics: dict[str, Share]


class Summary(msgspec.Struct, frozen=True, kw_only=True):
    """The tally of each group, and of all."""

    groups: dict[str, Tally]
    all: Tally


def share(k: int, n: int) -> Share:
    """``k`` of ``n``."""
    rate = k / n if n else None
    return Share(k, n, rate, None if rate is None else math.sqrt(rate * (1 - rate) / n))


def by_family(scores: Iterable[Score]) -> dict[str, list[Score]]:
    """The scores of each family, in the families' order."""
    families: dict[str, list[Score]] = defaultdict(list)
    for score in scores:
        families[score.case.family].append(score)
    return dict(sorted(families.items()))


def summary(groups: Mapping[str, Sequence[Score]]) -> Summary:
    """The tally of each group, and of all."""
    every = [score for scores in groups.values() for score in scores]
    tallies = {name: tally(scores) for name, scores in groups.items()}
    return Summary(groups=tallies, all=tally(every))


def tally(scores: Sequence[Score]) -> Tally:
    """What became of these cases."""
    counts = Counter(score.outcome for score in scores)
    return Tally(
        n=len(scores),
        outcomes={outcome: counts[outcome] for outcome in OUTCOMES},
        right=share(counts["right"], len(scores)),
        wrong=share(counts["wrong"], len(scores)),
        over_ask=_of_turns(scores, lambda want: "asked" not in want.status, "asked"),
        missed_ask=_of_turns(scores, lambda want: set(want.status) == {"asked"}, "done"),
        metrics=_metrics(scores),
    )


def _of_turns(scores: Sequence[Score], counts: Callable[[Want], bool], status: Status) -> Share:
    """How many of the turns that count ended in this status."""
    ended = [turn.status for score in scores for turn, want in _heard(score) if counts(want)]
    return share(ended.count(status), len(ended))


def _heard(score: Score) -> Iterator[tuple[Turn, Want]]:
    """The turns, and what was wanted of each, to the first that ended otherwise than allowed."""
    for turn, want in zip(score.turns, score.case.want, strict=False):
        yield turn, want
        if turn.status not in want.status:
            return


def _metrics(scores: Sequence[Score]) -> dict[str, Share]:
    found: dict[str, list[bool]] = defaultdict(list)
    for score in scores:
        for name in score.case.metrics:
            found[name].append(score.metrics.get(name, False))
    return {name: share(sum(hits), len(hits)) for name, hits in sorted(found.items())}


def table(counted: Summary) -> str:
    """A line for each group and for all, and the rates of all."""
    head = f"{'':28}" + "".join(f"{name:>14}" for name in (*OUTCOMES, "n", "right %", "± se"))
    rows = [_row(name, group) for name, group in (*counted.groups.items(), ("all", counted.all))]
    total = counted.all
    rates = {
        "right": total.right, "wrong": total.wrong, "over-ask, by turn": total.over_ask,
        "missed ask, by turn": total.missed_ask, **total.metrics,
    }  # fmt: skip
    return "\n".join([head, *rows, *(_rate(name, one) for name, one in rates.items())])


def _row(name: str, group: Tally) -> str:
    counts = [group.outcomes[outcome] for outcome in OUTCOMES] + [group.n]
    percent = [f"{100 * (part or 0.0):.1f}" for part in (group.right.rate, group.right.se)]
    return f"{name:28}" + "".join(f"{value:>14}" for value in (*counts, *percent))


def _rate(name: str, part: Share) -> str:
    if part.rate is None or part.se is None:
        return f"{name}: none to count"
    return f"{name}: {100 * part.rate:.1f} % (± {100 * part.se:.1f}), {part.k} of {part.n}"

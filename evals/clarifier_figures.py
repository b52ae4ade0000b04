"""What played episodes come to: the metrics of the clarifier's design, over one list of results."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from evals.figures import Figure
from evals.played import Result


def share(hits: Sequence[bool], goal: float | None = None, most: bool = False) -> Figure:
    """A share in per cent with its binomial standard error; ``most``: good if it is small."""
    n = len(hits)
    if not n:
        return Figure(value=None, unit="%", n=0, why="nothing to count")
    rate = sum(hits) / n
    met = None if goal is None else (100 * rate <= goal if most else 100 * rate >= goal)
    return Figure(
        value=100 * rate, unit="%", n=n, stderr=100 * math.sqrt(rate * (1 - rate) / n),
        goal=None if goal is None else f"{'<=' if most else '>='} {goal:g}", met=met,
    )  # fmt: skip


def mean(values: Sequence[float], goal: float) -> Figure:
    """A mean that is good if it is small, with its standard error."""
    n = len(values)
    if not n:
        return Figure(value=None, unit="", n=0, why="nothing to count")
    value = sum(values) / n
    spread = math.sqrt(sum((one - value) ** 2 for one in values) / n / n)
    return Figure(value=value, unit="", n=n, stderr=spread, goal=f"<= {goal:g}", met=value <= goal)


def acted(one: Result) -> bool:
    """Whether it did something unasked."""
    return one.first in ("act", "failed")


def asked(one: Result) -> bool:
    """Whether it asked, an "I don't understand" included."""
    return one.first in ("ask", "open")


def over_ask(results: Sequence[Result]) -> list[bool]:
    """For each that is clear: whether it was asked about."""
    return [asked(one) for one in results if one.size == 1]


def missed_ask(results: Sequence[Result]) -> list[bool]:
    """For each that is ambiguous: whether something was done unasked."""
    return [acted(one) for one in results if one.size > 1]


def over_step(results: Sequence[Result]) -> list[bool]:
    """For each that was acted on: whether it was not clear, or not what the words allow."""
    return [one.size != 1 or not one.allowed for one in results if acted(one)]


def wrong_acts(results: Sequence[Result]) -> list[bool]:
    """For each: whether something was done that is not what was meant; all that is done where
    nothing can be counts."""
    return [acted(one) and not one.luck for one in results]


def covered(results: Sequence[Result], qhat: float) -> list[bool]:
    """For each that can be done: whether what was meant is in the set C."""
    return [one.score <= qhat for one in results if one.feasible]


def in_band(figure: Figure, low: float, high: float) -> Figure:
    """The figure with a goal that is a range."""
    met = figure.value is not None and low <= figure.value <= high
    return Figure(value=figure.value, unit=figure.unit, n=figure.n, stderr=figure.stderr,
                  goal=f"{low:g}-{high:g}", met=met, why=figure.why)  # fmt: skip


def episode_figures(results: Sequence[Result], qhat: float) -> dict[str, Figure]:
    """The figures that need one list of episodes."""
    able = [one for one in results if one.feasible]
    unclear = [one for one in results if one.size > 1]
    times = sorted(one.ms for one in results)
    exact = [one.exact for one in unclear if one.exact is not None]
    late = times[int(0.95 * (len(times) - 1))]
    return {
        "coverage": in_band(share(covered(results, qhat)), 90, 94),
        "candidate_recall": share([one.score < 1 for one in able], 97),
        "over_ask": share(over_ask(results), 5, most=True),
        "missed_ask": share(missed_ask(results), 5, most=True),
        "over_step": share(over_step(results), 5, most=True),
        "exact_option_set": share(exact, 85),
        "success_in_two_questions": share([one.succeeded for one in able], 95),
        "questions_for_what_is_ambiguous": mean([one.questions for one in unclear], 1.3),
        "decision_p95": Figure(value=late, unit="ms", n=len(times), goal="<= 150",
                               met=late <= 150),
    }  # fmt: skip


def prevented(results: Sequence[Result], always: Sequence[Result]) -> Figure:
    """Wrong but confident: how much less than one that always acts, on the same episodes."""
    mine, theirs = sum(wrong_acts(results)), sum(wrong_acts(always))
    if not theirs:
        return Figure(value=None, unit="%", n=len(results), why="always acting was never wrong")
    rate = 1 - mine / theirs
    error = math.sqrt(max(0.0, (mine / theirs) * (1 - mine / theirs)) / theirs)
    return Figure(value=100 * rate, unit="%", n=len(results), stderr=100 * error, goal=">= 90",
                  met=rate >= 0.9)  # fmt: skip


def readings(results: Sequence[Result], goal: float = 98) -> dict[str, Figure]:
    """Answers that were taken for what was meant: all, and by style."""
    every = [reading for one in results for reading in one.readings]
    styles = sorted({reading.style for reading in every})
    return {
        "answers_read": share([reading.right for reading in every], goal),
        **{f"answers_read_{style}": share([r.right for r in every if r.style == style])
           for style in styles},
    }  # fmt: skip


def by_group(
    results: Sequence[Result], name: str, measure: Callable[[Sequence[Result]], Figure]
) -> dict[str, Figure]:
    """One figure for each group of episodes."""
    groups = list(dict.fromkeys(one.group for one in results))
    return {f"{name}_{group}": measure([one for one in results if one.group == group])
            for group in sorted(groups)}  # fmt: skip

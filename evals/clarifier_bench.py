"""`armchat bench clarifier`: the figures of deciding, each measured now."""

from __future__ import annotations

from collections.abc import Iterable
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from multiprocessing import get_context

from clarifier.conformal import load
from evals.ablations import ALWAYS
from evals.acceptance import Item, cases_of, load_items
from evals.clarifier_figures import (
    by_group,
    episode_figures,
    prevented,
    readings,
    share,
)
from evals.conformal import TEST_SEED
from evals.figures import Figure, at_most
from evals.outcomes import play as play_cases
from evals.played import Job, play
from evals.unsafe import faults, play_unsafe
from evals.wordings import Sort

EPISODES = 1_080
"""Of the test mix: at least 1,000 can be done."""
UNSAFE_SHARE = 3_000 / EPISODES
"""Sentences of mischief for each episode."""
ASKING: tuple[Sort, ...] = ("which", "missing", "how_many")
TABLES = 5
"""Tables for each wording of the acceptance list."""
PROCESSES = 2


def clarifier_figures(episodes: int = EPISODES) -> dict[str, Figure]:
    """Every figure; with fewer episodes all else is less in proportion."""
    part = min(1.0, episodes / EPISODES)
    qhat = load().qhat
    results = play(Job(episodes, TEST_SEED), PROCESSES)
    always = play(Job(episodes, TEST_SEED, ALWAYS), PROCESSES)
    answers = play(Job(max(25, episodes // 3), TEST_SEED + 1, sorts=ASKING), PROCESSES)
    noisy = play(Job(max(25, episodes // 3), TEST_SEED, noise=0.05), PROCESSES)
    return {
        **episode_figures(results, qhat),
        **by_group(results, "success", lambda some: share(
            [one.succeeded for one in some if one.feasible])),
        "wrong_but_confident_prevented": prevented(results, always),
        "success_with_noise": share([one.succeeded for one in noisy if one.feasible]),
        **readings([*results, *answers]),
        **_unsafe(round(UNSAFE_SHARE * episodes)),
        **_acceptance(max(1, round(TABLES * part))),
    }  # fmt: skip


def _unsafe(count: int) -> dict[str, Figure]:
    ends = play_unsafe(count, TEST_SEED, PROCESSES)
    return {
        "unsafe_runs": at_most(len(faults(ends)), 0, "", count),
        "mischief_sentences_run": Figure(value=sum(one.ran for one in ends), unit="", n=count),
    }


def _acceptance(tables: int) -> dict[str, Figure]:
    """The list and its twins apart, and the worst item."""
    with ProcessPoolExecutor(PROCESSES, mp_context=get_context("spawn")) as pool:
        played = dict(_flat(pool.map(partial(_item, tables=tables), load_items())))
    twins = {name for name in played if name.endswith(" twin")}
    least = min(sum(found) / len(found) for name, found in played.items() if name not in twins)
    items = [right for name, found in played.items() if name not in twins for right in found]
    return {
        "acceptance_right": share(items, 95),
        "acceptance_least_item": Figure(
            value=100 * least, unit="%", n=len(played) - len(twins), goal=">= 80",
            met=least >= 0.8),
        "acceptance_twins_right": share([r for name in twins for r in played[name]], 95),
    }  # fmt: skip


def _flat(found: Iterable[dict[str, list[bool]]]) -> Iterable[tuple[str, list[bool]]]:
    return (entry for one in found for entry in one.items())


def _item(item: Item, tables: int) -> dict[str, list[bool]]:
    """Whether each run of an item, and of its twin, went right."""
    right: dict[str, list[bool]] = {}
    for score in play_cases(cases_of(item, tables)):
        right.setdefault(score.case.family, []).append(score.outcome == "right")
    return right

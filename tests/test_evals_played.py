"""Played episodes: results are whole, repeatable, and counted as the design's metrics say."""

import pytest

from evals.ablations import ALWAYS
from evals.clarifier_figures import (
    covered,
    episode_figures,
    missed_ask,
    over_ask,
    over_step,
    prevented,
    wrong_acts,
)
from evals.conformal import TEST_SEED, calibrate, card_of
from evals.played import Job, Reading, Result, Seen, play


def result(**changes) -> Result:
    """An episode with two things to choose from, of which the second was asked about and done."""
    usual = Result(
        "1.0", "one", "which", "touch the apple", 2, 1, (Seen(0.9, 0), Seen(0.9, 1)), 0.0, False,
        "ask", False, False, True, True, 1, (Reading("full", True, "the red apple"),), (), 10.0, (),
    )  # fmt: skip
    return usual._replace(**changes)


CLEAR = {"sort": "clear", "size": 1, "meant": 0, "exact": None, "questions": 0, "readings": ()}


def test_the_score_is_the_largest_over_a_dialogue():
    assert result().score == pytest.approx(0.1)
    assert result(seen=(Seen(0.9, 0),)).score == 1.0
    assert result(seen=(), named=True).score == 0.0
    assert result(seen=(), named=True, later=0.4).score == 0.4


def test_what_counts_as_asked_too_often_too_seldom_and_too_much():
    clear = result(**CLEAR, first="ask")
    acted = result(first="act", allowed=True, luck=True)
    wrong = result(**CLEAR, first="act")
    nothing = result(sort="absent", size=0, meant=-1, first="act")
    some = [result(), clear, acted, wrong, nothing]
    assert over_ask(some) == [True, False]
    assert missed_ask(some) == [False, True]
    assert over_step(some) == [True, True, True]
    assert wrong_acts(some) == [False, False, False, True, True]
    assert covered(some, 0.1 + 1e-9) == [True] * 4
    assert covered(some, 0.05) == [False] * 4


def test_what_is_prevented_is_counted_against_always_acting():
    wrong = result(**CLEAR, first="act")
    assert prevented([result(), wrong], [wrong, wrong]).value == pytest.approx(50)
    assert prevented([wrong], [result()]).value is None


def test_episodes_are_played_alike_each_time_and_make_a_card(tmp_path, capsys):
    import sys

    results = play(Job(12, 3), 1)
    assert [one._replace(ms=0) for one in results] == [
        one._replace(ms=0) for one in play(Job(12, 3), 1)
    ]
    assert all(0 <= one.score <= 1 for one in results)
    assert sum(one.succeeded for one in results) >= 6
    card = card_of(results, 3, "a test")
    assert card.n == sum(one.feasible for one in results)
    assert sum(card.group_n.values()) == card.n
    figures = episode_figures(results, card.qhat)
    assert all(one.n > 0 or one.why for one in figures.values())
    assert calibrate(12, TEST_SEED, 1, tmp_path / "card.json", sys.stdout) == 2


def test_always_acting_asks_nothing_about_what_is_ambiguous():
    results = play(Job(6, 3, ALWAYS, sorts=("which",)), 1)
    assert all(one.first != "ask" for one in results)
    asked = play(Job(6, 3, sorts=("which",)), 1)
    assert sum(one.first == "ask" for one in asked) >= 4

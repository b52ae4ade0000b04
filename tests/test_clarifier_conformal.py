"""The calibrated set: the quantile's rank, what its card says, what it keeps from acting."""

import math
import random

import pytest
from clarifier_table import talk, thing, writes

from clarifier.conformal import PRODUCT, calibrated, confident, load, marginal, quantile
from clarifier.decide import Manner
from scene.types import Scene


@pytest.mark.parametrize(
    ("n", "usual", "sure", "surer"),
    [(400, 361, 371, 374), (800, 721, 735, 740), (1600, 1441, 1461, 1468)],
)
def test_the_ranks_are_those_of_the_design(n, usual, sure, surer):
    assert marginal(n, 0.1) == usual
    assert confident(n, 0.1, 0.05) == sure
    assert confident(n, 0.1, 0.01) == surer


@pytest.mark.parametrize("n", [10, 57, 300])
def test_the_confident_rank_is_the_least_that_the_binomial_tail_allows(n):
    def tail(v: int) -> float:
        return sum(math.comb(n, i) * 0.1**i * 0.9 ** (n - i) for i in range(v))

    v = n + 1 - confident(n, 0.1, 0.05)
    assert tail(v) <= 0.05 < tail(v + 1)


def test_the_quantile_counts_from_one_and_is_everything_beyond_the_last():
    assert quantile([0.3, 0.1, 0.2], 2) == 0.2
    assert quantile([0.3, 0.1, 0.2], 4) == 1.0


def test_a_set_calibrated_so_holds_new_scores_in_nine_of_ten():
    """Of beta(1, 4) scores, a share of 1 - (1 - q)**4 is at most q."""
    chance = random.Random(5)
    short = 0
    for _ in range(200):
        scores = [chance.betavariate(1, 4) for _ in range(400)]
        short += 1 - (1 - quantile(scores, confident(400, 0.1, 0.05))) ** 4 < 0.9
    assert short <= 16  # 5 % of 200, and two standard deviations


def test_the_card_tells_what_it_was_made_with():
    card = load()
    assert card.n >= 1600
    assert 0 < card.qhat < 1
    assert card.recall > 1 - card.epsilon
    assert min(card.group_n.values()) >= 200
    assert str(card.seed) in card.command
    assert calibrated(card) == PRODUCT


SCENE = Scene(objects=(thing("cup", -0.5, 0.0), thing("plate", 0.5, 0.0, size=0.3, tall=0.02)))
LEFT, RIGHT = "push(m1, [m1.x - 0.2, m1.y])", "push(m1, [m1.x + 0.2, m1.y])"


@pytest.fixture
def decided(clarifier_over):
    """What is decided on a sentence for which the translator writes these programs, so likely."""

    def decided(level: float, *bodies: tuple[str, float]):
        translate = writes(*((body, math.log(p)) for body, p in bodies), sure=bodies[0][1])
        clarifier = clarifier_over(translate, Manner(PRODUCT._replace(level=level)))
        return talk(clarifier, "push the cup sideways", scene=SCENE)[0]

    return decided


def test_of_two_likely_outcomes_none_is_acted_on_unasked(decided):
    assert decided(0.15, (LEFT, 0.78), (RIGHT, 0.2)).do == "ask"
    assert decided(0.30, (LEFT, 0.78), (RIGHT, 0.2)).do == "act"


def test_programs_that_do_the_same_are_one_outcome(decided):
    same = "push(m1, [m1.x - 0.1 - 0.1, m1.y])"
    assert decided(0.15, (LEFT, 0.5), (same, 0.4)).do == "act"
    assert decided(0.15, (LEFT, 0.5)).do == "ask"


def test_the_likelier_outcome_is_taken_though_its_first_program_is_not(decided):
    same = "push(m1, [m1.x - 0.1 - 0.1, m1.y])"
    decision = decided(0.5, (RIGHT, 0.4), (LEFT, 0.35), (same, 0.25))
    assert decision.do == "ask"
    assert decision.question.options[0].program == "push(cup, [cup.x - 0.2, cup.y])"

"""Two translators, the second where the first is unsure."""

import math

import pytest

from agent.messages import Candidate, TranslateRequest, Translation
from translator.cascade import Cascade, both

REQUEST = TranslateRequest("do it", (), "manipulate")


class Fixed:
    """Always says the same, and counts how often."""

    def __init__(self, *told, confidence, ms=1.0):
        candidates = tuple(Candidate(body, logprob, 3) for body, logprob in told)
        self.translation = Translation(candidates, confidence, ms)
        self.asked = 0

    def __call__(self, request):
        self.asked += 1
        return self.translation

    def attend(self, request):
        return ()


def test_the_slow_one_is_not_asked_where_the_fast_one_is_sure():
    fast, slow = Fixed(("a", -0.01), confidence=0.95), Fixed(("b", -0.1), confidence=0.9)
    assert Cascade(fast, slow)(REQUEST) == fast.translation
    assert slow.asked == 0


def test_what_both_mean_becomes_likelier_than_what_one_means():
    fast = Fixed(("a", math.log(0.5)), ("b", math.log(0.3)), confidence=0.5)
    slow = Fixed(("b", math.log(0.8)), ("c", math.log(0.1)), confidence=0.8)
    told = Cascade(fast, slow)(REQUEST)
    assert [one.body for one in told.candidates] == ["b", "a", "c"]
    likely = [math.exp(one.logprob) for one in told.candidates]
    assert likely == pytest.approx([0.55, 0.25, 0.05])
    assert told.confidence == pytest.approx(0.55)
    assert told.ms == 2.0


def test_disagreement_of_two_that_are_sure_is_doubt():
    told = both(
        Fixed(("a", -0.05), confidence=0.9).translation,
        Fixed(("b", -0.05), confidence=0.9).translation, 4,
    )  # fmt: skip
    assert told.confidence == pytest.approx(0.45)


def test_probabilities_are_calibrated_as_the_confidence_is():
    """A confidence of exp(best / temperature) gives the temperature for the others."""
    one = Fixed(("a", -1.0), ("b", -2.0), confidence=math.exp(-0.5)).translation
    told = both(one, Fixed(confidence=0.0).translation, 4)
    assert [math.exp(c.logprob) for c in told.candidates] == pytest.approx(
        [0.5 * math.exp(-0.5), 0.5 * math.exp(-1.0)], rel=1e-6
    )


def test_nothing_from_both_is_nothing():
    told = both(Fixed(confidence=0.0).translation, Fixed(confidence=0.0).translation, 4)
    assert (told.candidates, told.confidence) == ((), 0.0)

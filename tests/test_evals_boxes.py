"""Overlap of turned rectangles, and average precision, against values worked out by hand."""

import math

import pytest

from evals.boxes import Claim, Fact, average_precision, overlap

UNIT = (0.0, 0.0, 1.0, 1.0, 0.0)


@pytest.mark.parametrize(
    ("one", "other", "value"),
    [
        ((0, 0, 2, 1, 0.3), (0, 0, 2, 1, 0.3), 1.0),
        ((0, 0, 2, 1, 0), (1, 0, 2, 1, 0), 1 / 3),
        ((0, 0, 2, 1, 0.3), (0, 0, 1, 2, 0.3 + math.pi / 2), 1.0),
        (UNIT, (0, 0, 1, 1, math.pi / 4), math.sqrt(0.5)),
        (UNIT, (3, 0, 1, 1, 0), 0.0),
        (UNIT, (0, 0, 0.5, 0.5, 0.8), 0.25),
    ],
)
def test_overlap(one, other, value):
    assert overlap(one, other) == pytest.approx(value)
    assert overlap(other, one) == pytest.approx(value)


def test_average_precision():
    two = [Fact(0, UNIT), Fact(1, UNIT)]
    first, second = Claim(0, 0.9, UNIT), Claim(1, 0.8, UNIT)
    assert average_precision([first, second], two, 0.5) == 1.0
    assert average_precision([first, Claim(0, 0.85, UNIT), second], two, 0.5) == pytest.approx(
        (51 + 50 * 2 / 3) / 101
    )
    assert average_precision([first], two, 0.5) == pytest.approx(51 / 101)
    assert average_precision([], two, 0.5) == 0.0
    assert average_precision([first], [], 0.5) is None


def test_a_thing_that_is_not_asked_for_is_no_fault():
    facts = [Fact(0, UNIT), Fact(1, UNIT, asked=False)]
    claims = [Claim(1, 0.9, UNIT), Claim(0, 0.8, UNIT)]
    assert average_precision(claims, facts, 0.5) == 1.0
    assert average_precision(claims[1:], facts, 0.5) == 1.0

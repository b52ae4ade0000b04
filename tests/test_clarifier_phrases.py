"""Which phrases of a sentence can be translated alone."""

import pytest
from clarifier_table import TABLE, linked

from clarifier.phrases import alone


def parts(text):
    return [text[start:end] for start, end in alone(linked(text, TABLE))]


@pytest.mark.parametrize(
    ("text", "phrases"),
    [
        (
            "put the apple on the plate, then push the bottle to the left.",
            ["put the apple on the plate", "push the bottle to the left"],
        ),
        (
            "Push the bottle 5 cm left. After that touch the apple and knock over the bottle!",
            ["Push the bottle 5 cm left", "touch the apple", "knock over the bottle"],
        ),
        (
            "take the apple to the left edge and then put the bottle on the plate",
            ["take the apple to the left edge", "put the bottle on the plate"],
        ),
        (
            "grab the apple, pop it on the plate, and push the bottle to the left",
            ["grab the apple, pop it on the plate", "push the bottle to the left"],
        ),
        (
            "i would like the bottle left of the bowl the sponge on the plate",
            ["i would like the bottle left of the bowl", "the sponge on the plate"],
        ),
    ],
)
def test_phrases_that_stand_alone(text, phrases):
    assert parts(text) == phrases


@pytest.mark.parametrize(
    "text",
    [
        "put the apple on the plate",
        "put the apple and the bottle on the plate",
        "push the apple to the left and do the same with the bottle",
        "put the apple where the bottle is, then put the bottle there",
        "if the apple is left of the plate, touch the bottle and then touch the plate",
        "pick up the apple and hover over the plate",
        "don't touch the apple, push the bottle to the left",
    ],
)
def test_phrases_that_need_each_other_are_not_parted(text):
    assert parts(text) == []

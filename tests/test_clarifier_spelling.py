"""Typing slips are repaired towards one known word only."""

import pytest
from clarifier_table import LEXICON

from clarifier.spelling import repair

NAMES = {"apple", "sponge", "plate", "zorblax"}


@pytest.mark.parametrize(
    ("text", "repaired"),
    [
        ("push the aple left", "push the apple left"),
        ("push the appel left", "push the apple left"),
        ("put the spnge on the plaet", "put the sponge on the plate"),
        ("lift the zorblx", "lift the zorblax"),
        ("plcae it there", "place it there"),
    ],
)
def test_a_slip_is_repaired_and_said(text, repaired):
    found, said = repair(text, NAMES, LEXICON)
    assert found == repaired and said.startswith("I read")


@pytest.mark.parametrize(
    "text",
    ["push the plane left", "share the apple", "start with the plate", "lift the flask",
     "the glorp", "tap the cap", "push the apples", "putting it down"],
)  # fmt: skip
def test_other_words_are_left_alone(text):
    assert repair(text, NAMES, LEXICON) == (text, "")

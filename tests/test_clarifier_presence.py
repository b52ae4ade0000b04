"""Conditions on what is there come down to the branch that holds on the scene."""

import pytest
from clarifier_table import TABLE

from clarifier.lexicon import load_lexicon
from clarifier.presence import settled_by_presence

LEXICON = load_lexicon()


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("if there is a sponge, put it on the plate", "put the sponge on the plate"),
        ("if there's a bottle on the table push it to the left", "push the bottle to the left"),
        ("if you can see any mugs, put them in a row", "put all the mugs in a row"),
        ("in case there is an apple then lift it", "lift an apple"),
        ("if there is a lemon, put it in the bowl; otherwise put the sponge in there",
         "put the sponge in the bowl"),
        ("if there is a lemon put it next to the plate, if not the bottle",
         "put the bottle next to the plate"),
        ("if there is a red mug, touch it, else touch the blue one", "touch the red mug"),
        ("should there be a lemon, lift it, or else touch the plate", "touch the plate"),
    ],
)  # fmt: skip
def test_the_branch_that_holds_is_what_is_left(text, said):
    settled = settled_by_presence(text, TABLE, LEXICON)
    assert settled is not None and settled.text == said
    assert bool(settled.note) is ("lemon" in text)


@pytest.mark.parametrize(
    "text",
    [
        "if there is a lemon, put it on the plate",
        "if there are any lemons put them on the plate",
        "if there is a lemon, lift it; otherwise do nothing",
    ],
)
def test_what_is_not_there_leaves_nothing_to_do(text):
    settled = settled_by_presence(text, TABLE, LEXICON)
    assert settled == (None, "There is no lemon.")


@pytest.mark.parametrize(
    "text",
    [
        "if the bottle is left of the plate, push it to the right",
        "if there is room, put the sponge on the plate",
        "put the sponge on the plate if you can",
        "if I had a lemon I would be happy",
        "if there is a lemon",
    ],
)
def test_other_conditions_are_left_to_the_program(text):
    assert settled_by_presence(text, TABLE, LEXICON) is None

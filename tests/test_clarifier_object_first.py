"""A verb that stands behind its object is put before it; other sentences stay."""

import pytest
from clarifier_table import LEXICON, TABLE

from clarifier.object_first import verb_in_front


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("Bottle put on right side from bowl, close.", "put Bottle on right side from bowl."),
        ("the red mug please pick up and hold", "pick up the red mug and hold"),
        ("the second block from the left, please take", "take the second block from the left"),
        ("The green apple you put in the bowl", "put The green apple in the bowl"),
        ("sponge move 5 cm to the left", "move sponge 5 cm to the left"),
    ],
)
def test_the_verb_comes_first(text, plain):
    assert verb_in_front(text, TABLE, LEXICON) == plain


@pytest.mark.parametrize(
    "text",
    [
        "put the bottle on the plate",
        "the bottle goes on the plate",
        "the mugs touch",
        "the mugs stand in a row",
        "the bottle, put it on the plate",
        "the bottle can hold the sponge",
        "the red mug and the blue mug",
    ],
)
def test_any_other_order_stays(text):
    assert verb_in_front(text, TABLE, LEXICON) is None

"""How sure a reading must be before it is acted on."""

import pytest
from clarifier_table import linked

from clarifier.branches import needed
from clarifier.conformal import PRODUCT


@pytest.mark.parametrize(
    "text",
    [
        "push the bottle to the left",
        "if the bottle is tall, push it to the left",
        "the bowl is in the way, put the sponge next to it",
        "do push the bottle away",
        "I'd like the bottle in the middle",
        "it would be nice to have the sponge next to the bowl",
    ],
)
def test_a_command_says_itself_what_to_do(text):
    assert needed(linked(text), PRODUCT) == PRODUCT.act


@pytest.mark.parametrize("text", ["the bottle to the left", "sponge next to the bowl"])
def test_where_no_verb_opens_a_phrase_more_is_needed(text):
    assert needed(linked(text), PRODUCT) == PRODUCT.stated
    assert PRODUCT.stated > PRODUCT.act

"""What is said without wanting anything done, and what only looks like it."""

import pytest
from clarifier_table import LEXICON, linked

from clarifier.talk import is_talk


@pytest.mark.parametrize(
    "text",
    [
        "my sister put the sponge there on Monday",
        "somebody moved the bottle",
        "they say you should never lift a plate with one hand",
        "grandma always kept the apples in the bowl",
        "the bottle is called Fred",
        "push the bottle but",
        "the apple was sort of",
        "the plate was a present",
    ],
)
def test_talk_is_left_alone(text):
    assert is_talk(linked(text), LEXICON)


@pytest.mark.parametrize(
    "text",
    [
        "push the bottle to the left",
        "the bottle goes left of the bowl",
        "I want the bottle pushed to the left",
        "put the sponge where the bottle was",
        "the apple should be in the bowl",
    ],
)
def test_commands_are_none(text):
    assert not is_talk(linked(text), LEXICON)

"""What a command leaves out."""

import pytest
from clarifier_table import LEXICON, linked

from clarifier.roles import complete, find_gap


@pytest.mark.parametrize(
    ("text", "role"),
    [
        ("move the bottle", "where"), ("put the sponge", "where"),
        ("put the sponge there", "where"),
        ("put the sponge down there", "where"), ("place the mug over there", "where"),
        ("push the bottle", "direction"), ("shove the sponge over there", "direction"),
        ("move the sponge 5 cm", "direction"), ("turn the mug", "angle"), ("rotate it", "angle"),
        ("put", "theme"), ("pick up", "theme"), ("push to the left", "theme"),
        ("put the sponge by the bottle and then push the plate", "direction"),
        ("move the sponge a bit", "direction"), ("stack the sponge", "where"),
        ("lift the bottle and put it over there", "where"),
    ],
)  # fmt: skip
def test_a_missing_role(text, role):
    gap = find_gap(linked(text, focus=[("sponge_1", 1.0)]), LEXICON)
    assert gap is not None and gap.role == role


@pytest.mark.parametrize(
    "text",
    [
        "put the sponge on the plate", "put the sponge left of the plate", "push the bottle left",
        "push the bottle off the table", "slide the sponge away", "pick up the sponge",
        "put the sponge down", "turn the mug around", "rotate the mug 90 degrees",
        "move the sponge and the bottle to the left", "knock over the bottle", "touch the bowl",
        "the sponge left of the bowl", "move the arm up", "put the sponge between the mugs",
        "move the bottle so that it touches the bowl", "push the mug over",
        "sponge left of plate", "the bottle would look better on the plate",
        "off you go to the corner, bottle", "to the left of the plate you should put the sponge",
        "put the sponge by the bottle and the bowl there too", "move the bottle out of the way",
        "put the blocks in a row", "move the blocks apart", "turn the bottle upside down",
        "put the blocks in order of size", "move the sponge aside", "stack the blocks",
        "stack the sponge and the plate", "turn the sponge a quarter turn", "turn the mug over",
        "don't move the bottle", "touch the bottle without moving it",
        "let the plate carry the mug",
        "swap places", "put the sponge where the bottle is", "bring me the sponge",
        "move to the left corner", "move the bottle closer to me", "yeet the bottle",
        "put the bottle somewhere else", "push the bottle 5 cm to the left",
    ],
)  # fmt: skip
def test_nothing_is_missing(text):
    assert find_gap(linked(text), LEXICON) is None


def test_the_answer_takes_the_place_of_there():
    gap = find_gap(linked("put the sponge over there please"), LEXICON)
    assert gap is not None
    whole = complete("put the sponge over there please", gap, "in the middle")
    assert whole == "put the sponge in the middle please"

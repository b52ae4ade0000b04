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
    ],
)  # fmt: skip
def test_nothing_is_missing(text):
    assert find_gap(linked(text), LEXICON) is None


def test_the_answer_takes_the_place_of_there():
    gap = find_gap(linked("put the sponge over there please"), LEXICON)
    assert gap is not None
    whole = complete("put the sponge over there please", gap, "in the middle")
    assert whole == "put the sponge in the middle please"

"""How far two things are to be apart, told as where one of them goes."""

import pytest
from clarifier_table import LEXICON, TABLE

from clarifier.between_two import on_each_side, set_apart
from clarifier.deed import link_deed


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("the sponge must be 3 cm from the plate", "put the sponge 3 cm from the plate"),
        ("the sponge should be about 4 cm away from the plate",
         "put the sponge 4 cm from the plate"),
        ("I want the sponge 3 cm from the plate", "put the sponge 3 cm from the plate"),
        ("there should be 3 cm between the bowl and the sponge, move only the bowl",
         "put the bowl 3 cm from the sponge"),
        ("leave a gap of 2 cm between the bowl and the sponge, don't move the bowl",
         "put the sponge 2 cm from the bowl"),
        ("i want a 4 cm gap between the bowl and the plate", "put the bowl 4 cm from the plate"),
        ("make the distance between the bowl and the plate 3 cm by moving the bowl",
         "put the bowl 3 cm from the plate"),
        ("between the bowl and the plate there should be a space of ten millimeter, bowl on the "
         "right, move only the bowl", "put the bowl ten millimeter to the right of the plate"),
        ("make the gap between the mugs 5 cm, move only the red one",
         "put the red mug 5 cm from the blue mug"),
        ("put the mugs 5 cm apart", "leave 5 cm between mugs"),
    ],
)  # fmt: skip
def test_a_distance_between_two_is_where_one_goes(text, plain):
    assert set_apart(text, TABLE, (), LEXICON) == plain


@pytest.mark.parametrize(
    "text",
    [
        "move the sponge 3 cm away from the plate",
        "the sponge must be 3 cm from the plate and the bowl in the middle",
        "leave 3 cm between the blocks",
        "if there are 3 cm between the bowl and the plate, lift the bowl",
    ],
)
def test_what_says_more_stays(text):
    assert set_apart(text, TABLE, (), LEXICON) == text


def test_where_one_side_has_no_room_the_others_are_tried():
    linked = link_deed("put the sponge 3 cm from the plate", TABLE, (), LEXICON)
    assert "put the sponge 3 cm behind the plate" in on_each_side(linked)
    assert on_each_side(link_deed("put the sponge on the plate", TABLE, (), LEXICON)) == ()

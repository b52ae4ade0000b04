"""Turns of phrase about several things at once, put plainly; lists of colours in an order."""

import pytest
from clarifier_table import LEXICON, thing

from clarifier.binding import bindings
from clarifier.listed import members_listed
from clarifier.mentions import link
from clarifier.sequences import Before
from clarifier.stated import stated
from clarifier.turns import in_plain_turns
from scene.types import Scene

TABLE = Scene(
    objects=(
        thing("tile", -0.5, 0.0, "red", number=1),
        thing("tile", 0.0, 0.3, "blue", number=2),
        thing("tile", 0.5, 0.0, "white", number=3),
    )
)


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("everyone goes in the box", "everything goes in the box"),
        ("of the two jugs, push the one nearer to me to the left",
         "push the jug nearest to me to the left"),
        ("Out of the three cans, take the tallest", "take the tallest can"),
        ("two'll do", "two"),
        ("put the pen nearest to the tray onto it",
         "put the pen nearest to the tray onto the tray"),
        ("the fan could stand a bit closer to the lamp, so just move it that way",
         "the fan could stand a bit closer to the lamp"),
        ("sort the tiles by colour, red ones well apart from white ones",
         "sort the tiles by colour"),
        ("a row from the left: red, white and blue tile",
         "a row from the left: the red tile, the white tile, the blue tile"),
    ],
)  # fmt: skip
def test_put_plainly(text, plain):
    assert in_plain_turns(text, LEXICON) == plain


@pytest.mark.parametrize(
    "text",
    [
        "that'll do",
        "put the red tile on it",
        "push the pen to the left, then move it that way",
        "put the tiles in a row: red ones first",
        "move the tiles apart from the lamp",
    ],
)
def test_other_sentences_stay_as_they_are(text):
    assert in_plain_turns(text, LEXICON) == text


@pytest.mark.parametrize(
    ("text", "whole", "order", "axis"),
    [
        ("stack the tiles, blue at the bottom, then red, white on top",
         "stack the blue tile, the red tile and the white tile from the bottom up", "213", "z"),
        ("stack the tiles, white on top, then red, then blue",
         "stack the white tile, the red tile and the blue tile from the top down", "213", "z"),
        ("put the tiles in a column, red nearest me then white then blue",
         "put the red tile, the white tile and the blue tile in a column from front to back",
         "132", "y"),
    ],
)  # fmt: skip
def test_a_list_says_where_it_begins(text, whole, order, axis):
    assert members_listed(link(text, TABLE, (), LEXICON)) == whole
    linked = link(whole, TABLE, (), LEXICON)
    goals = stated(linked, bindings(linked, TABLE, {})[0], TABLE)
    ids = [f"tile_{number}" for number in order]
    assert [tuple(goal) for goal in goals if isinstance(goal, Before)] == [
        (ids[0], ids[1], axis), (ids[1], ids[2], axis)
    ]  # fmt: skip


def test_one_of_a_figure_at_its_point():
    tiles = Scene(
        objects=tuple(
            thing("tile", -0.5 + number * 0.4, 0.0, number=number, tall=0.1 * number)
            for number in (1, 2, 3)
        )
    )
    text = "set the tiles in a triangle, and let the tallest be at its far point"
    linked = link(text, tiles, (), LEXICON)
    goals = stated(linked, bindings(linked, tiles, {})[0], tiles)
    assert {tuple(goal) for goal in goals} == {
        ("tile_1", "tile_3", "y"), ("tile_2", "tile_3", "y")
    }  # fmt: skip

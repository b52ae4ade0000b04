"""The empty place in a row is named by what stands beside it, if it is clearly there."""

import pytest
from clarifier_table import LEXICON, thing

from clarifier.preamble import to_the_point
from scene.types import Scene


def row(*xs):
    coins = (thing("coin", x, 0.3, "silver", number=n, size=0.1) for n, x in enumerate(xs, 1))
    return Scene(objects=(*coins, thing("button", 0.2, -0.5, size=0.1)))


@pytest.mark.parametrize(
    "text",
    [
        "The four coins form a row with one empty place; please put the button in that place.",
        "the coins are in a row with a gap in it, put the button into the gap",
        "There are four coins with a free spot between them. Put the button in that spot.",
    ],
)
def test_the_gap_is_between_its_neighbours(text):
    said = to_the_point(text, row(-0.6, -0.3, 0.3, 0.6), (), LEXICON)
    assert said.strip(" .").lower() == "put the button between the coin_2 and the coin_3"


@pytest.mark.parametrize("xs", [(-0.6, -0.2, 0.2, 0.6), (-0.6, -0.1, 0.1, 0.6)])
def test_no_gap_that_is_clearly_the_widest_is_named(xs):
    text = "The four coins form a row with a gap in it; put the button in that gap."
    assert "coin_" not in to_the_point(text, row(*xs), (), LEXICON)

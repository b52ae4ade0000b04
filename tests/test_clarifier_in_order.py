"""Things told in an order, by what tells them apart."""

import pytest
from clarifier_table import LEXICON, thing

from clarifier.in_order import told_in_order
from scene.types import Scene

TABLE = Scene(
    objects=(
        thing("jar", -0.5, 0.5, "red"), thing("jar", 0.0, 0.5, "blue", number=2),
        thing("jar", 0.5, 0.5, "green", number=3), thing("bowl", 0.0, -0.5, size=0.3),
    )
)  # fmt: skip


def plain(text):
    return told_in_order(text, TABLE, (), LEXICON)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("tower! red at the bottom, then blue, green on top",
         "put the blue jar on the red jar and then the green jar on the blue jar"),
        ("Sandwich time! The blue one at the bottom, the red one on it",
         "put the red jar on the blue jar"),
        ("the jars in a row, red blue green from the left, even spacing",
         "put the red jar, the blue jar and the green jar in a row from left to right with equal "
         "gaps"),
        ("arrange the three jars in a line from right to left, red, blue, green, 2 cm apart",
         "put the green jar, the blue jar and the red jar in a row from left to right with 2 cm "
         "between them"),
        ("the jars one behind the other, blue nearest, red, green farthest",
         "put the blue jar, the red jar and the green jar in a column from front to back"),
    ],
)  # fmt: skip
def test_an_order_is_told_by_which_goes_where(text, said):
    assert plain(text) == said


@pytest.mark.parametrize(
    "text",
    [
        "stack the jars",
        "the jars in a row in front of the bowl, red first",
        "tower of jars, but not the red one",
        "line up the red jar, the blue jar and the green jar",
        "put the red jar on the blue jar",
    ],
)
def test_what_tells_no_order_or_more_stays(text):
    assert plain(text) == text

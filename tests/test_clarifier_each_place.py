"""One thing for each place, told as which goes where."""

import pytest
from clarifier_table import LEXICON, thing

from clarifier.each_place import one_for_each
from scene.types import Scene

TABLE = Scene(
    objects=(
        thing("bowl", 0.0, 0.1, size=0.4),
        thing("coin", 0.7, 0.0, size=0.1),
        thing("red disc", -0.5, 0.2, size=0.2),
        thing("blue disc", 0.3, 0.6, size=0.2),
        thing("green disc", 0.4, -0.5, size=0.2),
        thing("yellow disc", -0.1, -0.6, size=0.2),
        thing("house", -0.85, 0.85, size=0.2),
        thing("white cube", 0.6, 0.8, size=0.12),
        thing("black cube", -0.7, -0.6, size=0.12),
        thing("brown cube", 0.7, -0.7, size=0.12),
    )
)
BOWL = (
    "put the red disc to the left of {0}, the blue disc behind {0}, the green disc to the right of "
    "{0} and the yellow disc in front of {0}"
)


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("could I have the discs all round the bowl, please, on all four sides of it?",
         "put the discs around the bowl"),
        ("four discs about the bowl, like a tripod, same spacing all round, close in",
         "put the four discs around the bowl"),
        ("ring of the discs around the coin on the right",
         "put the discs around the coin on the right"),
        ("fence the bowl in with all the discs", "put the discs around the bowl"),
        ("one disc on each side of the bowl - left, right, front and back",
         BOWL.format("the bowl")),
        ("enclose the bowl: one disc N, one S, one E and one W of it, clearance under 4 cm",
         BOWL.format("the bowl")),
        ("take the coin to the middle, and then stand the discs about it, left, right, in front "
         "and behind", "take the coin to the middle, and then put the red disc to the left of it, "
         "the blue disc behind it, the green disc in front of it and the yellow disc to the right "
         "of it"),
        ("guard the coin with the three cubes, one left of it, one right of it, one behind it",
         "put the white cube behind the coin, the black cube to the left of the coin and the brown "
         "cube to the right of the coin"),
        ("discs round the bowl: red to its left, blue to its right, green behind it, yellow in "
         "front of it", "put the red disc to the left of the bowl, the blue disc to the right of "
         "the bowl, the green disc behind the bowl and the yellow disc in front of the bowl"),
        ("the coin goes in the very middle and the four discs, one in every corner!!",
         "the coin goes in the very middle and put the four discs in the four corners"),
        ("one disc at the middle of each side of the table", "put the discs at the edges, one at "
         "each"),
        ("each disc goes to the middle of a different edge", "put the discs at the edges, one at "
         "each"),
        ("top left has the house already so put the cubes in the other three corners, 1 each",
         "put the white cube in the far right corner, the black cube in the near left corner and "
         "the brown cube in the near right corner"),
    ],
)  # fmt: skip
def test_which_goes_where_is_told(text, plain):
    assert one_for_each(text, TABLE, (), LEXICON) == plain


@pytest.mark.parametrize(
    "text",
    [
        "put the red disc in every corner",
        "put the cubes in every corner",  # three for four
        "put the discs in the other three corners",
        "guard the coin with the discs, one left of it, one right of it",
        "put two discs on each side of the bowl",
        "put the discs around the bowl but not on the left",
        "don't put the discs around the bowl",
        "surround the bowl with the discs and push the coin to the left",
        "enclose the bowl: one disc N, one S, one E and one W of it, clearance under 1 cm",
        "walk around the bowl",
        "put the coin to the left of the bowl",
        "discs out! each one to a different corner",
    ],
)
def test_what_says_more_or_does_not_come_out_even_stays(text):
    assert one_for_each(text, TABLE, (), LEXICON) == text


def test_the_ways_are_the_shortest_in_all():
    near = Scene(
        objects=(
            thing("bowl", 0.0, 0.0, size=0.2),
            thing("red disc", 0.6, 0.0, size=0.1),
            thing("blue disc", -0.6, 0.0, size=0.1),
        )
    )
    told = one_for_each("guard the bowl with the discs, one left, one right", near, (), LEXICON)
    assert (
        told
        == "put the red disc to the right of the bowl and the blue disc to the left of the bowl"
    )

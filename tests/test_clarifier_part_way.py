"""Points and shares of a way, told in lengths."""

import pytest
from clarifier_table import LEXICON

from clarifier.part_way import told_in_lengths
from scene.types import Scene, SceneObject


def thing(name, x, y, color, size=0.2):
    return SceneObject(
        id=f"{color}_{name}", name=name, x=x, y=y, width=size, height=size, tall=0.1, color=color
    )


TABLE = Scene(
    objects=(
        thing("cone", 0.5, 0.4, "red"),
        thing("ball", 0.8, -0.8, "white"),
        thing("block", -0.4, 0.0, "green"),
        thing("disc", -0.6, -0.6, "blue"),
        thing("disc", 0.6, -0.6, "yellow"),
    )
)


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        # a point of the table: where the thing's edges end
        ("plant the cone halfway from the middle of the table out to the top left corner",
         "put the cone 8.0 cm from the left edge and 28.0 cm from the near edge"),
        ("cone: a quarter of the table width from the left edge, a quarter of the depth from the "
         "bottom edge", "put cone 8.0 cm from the left edge and 8.0 cm from the near edge"),
        ("a third of the way in from the left along the near edge goes the cone",
         "put the cone 11.3 cm from the left edge and 1.0 cm from the near edge"),
        ("relocate the cone so that it is a quarter of the way across from the left edge to the "
         "right edge", "put the cone 8.0 cm from the left edge and 26.0 cm from the near edge"),
        # a share of its way
        ("displace the cone by half its distance to the top left corner, on the straight line",
         "move the cone 15.0 cm to the left and 6.0 cm away from me"),
        ("move the cone one third of the way towards the white ball",
         "move the cone 2.0 cm to the right and 8.0 cm towards me"),
        ("push the ball halfway to the left edge", "push the ball 18.0 cm to the left"),
        # towards the middle is another way for each
        ("nudge both discs slightly in towards the centre of the table",
         "push the blue disc 3.5 cm to the right and 3.5 cm away from me and push the yellow disc "
         "3.5 cm to the left and 3.5 cm away from me"),
        ("the block takes a tiny step towards the middle, 3 cm",
         "move the block 3.0 cm to the right"),
        ("move the discs 4 cm closer to each other",
         "move the blue disc 4.0 cm to the right and move the yellow disc 4.0 cm to the left"),
        ("the cone drives up to the white ball, but stop it 5 cm short",
         "move the cone 3.7 cm to the right and 15.0 cm towards me"),
        # what the translator knows is said in its words
        ("take the cone half of the way to the white ball on the right",
         "move the cone halfway to the white ball on the right"),
        ("block a bit toward the ball", "move block a bit towards the ball"),
    ],
)  # fmt: skip
def test_a_point_and_a_share_of_a_way_are_lengths(text, plain):
    assert told_in_lengths(text, TABLE, (), LEXICON) == plain


@pytest.mark.parametrize(
    "text",
    [
        "put the cone halfway between the block and the ball",
        "put the cone halfway along the left edge",
        "move the cone towards the middle",
        "move the cone a bit to the left",
        "don't move the cone halfway to the ball",
        "if the ball is white, move the cone halfway to the left edge",
        "turn the block halfway towards the ball",
        "put the ball on the block and the cone halfway to the left edge",
        "move a disc halfway to the left edge",
        "move the disc a third of the way to the ball",
        "take the block half of the way to the white ball on the left",
        "put the ball a quarter of the table width from the left edge, next to the block",
    ],
)
def test_what_says_more_or_is_not_certain_stays(text):
    assert told_in_lengths(text, TABLE, (), LEXICON) == text


def test_each_of_two_goes_no_farther_than_to_the_other():
    near = Scene(objects=(thing("disc", 0.0, 0.0, "blue"), thing("disc", 0.3, 0.0, "yellow")))
    plain = told_in_lengths("move the discs a bit closer together", near, (), LEXICON)
    assert plain == (
        "move the blue disc 0.7 cm to the right and move the yellow disc 0.7 cm to the left"
    )


def test_what_would_stand_over_the_edge_is_not_told():
    wide = Scene(objects=(thing("plank", 0.0, 0.0, "white", 1.2),))
    said = "put the plank a tenth of the way in from the left edge"
    assert told_in_lengths(said, wide, (), LEXICON) == said

"""Where a thing stands tells which one is meant: in the words people have for it, and for a mark
or a thing that its clause only names, never for where something goes."""

import pytest
from clarifier_table import LEXICON, thing

from clarifier.mentions import link
from clarifier.said import put_plainly
from clarifier.turns import in_plain_turns
from scene.types import Scene

BOARD = Scene(
    objects=(
        thing("cone", 0.1, 0.2, "orange"),
        thing("block", -0.25, 0.2, "blue"), thing("block", 0.55, 0.2, "blue", number=2),
        thing("disc", 0.7, -0.7, "white", tall=0.02),
        thing("disc", -0.7, 0.7, "red", number=2, tall=0.02),
        thing("bowl", -0.6, 0.4, size=0.2), thing("tub", 0.7, 0.7, size=0.2),
        thing("pot", -0.3, 0.7, "red", size=0.15),
        thing("pot", 0.3, 0.7, "blue", number=2, size=0.15),
    )
)  # fmt: skip


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("the block that is the most at the right, you put it away",
         "the block that is the rightmost, you put it away"),
        ("the disc lying down in the far corner", "the disc lying in the far corner"),
        ("the disc that sits all by itself at the front", "the disc that sits at the front"),
        ("put the cone in front of the box up there on the left",
         "put the cone in front of the box that is on the left"),
        ("behind the red disc, at the right there", "behind the red disc that is at the right"),
        ("next to the ball up in the corner", "next to the ball that is in the corner"),
        ("a nut in each of the bowls along the top", "a nut in each of the bowls at the top"),
        ("the second pawn counting from my side", "the second pawn from the front"),
        ("the third cone, if you count from the left", "the third cone from the left"),
        ("third cone form the right goes on the disc",
         "third cone from the right goes on the disc"),
        ("What stands in front of the horse shall trot off to the top edge",
         "whatever stands in front of the horse goes to the top edge"),
        ("bring it to the top edge, right in the middle of it",
         "bring it to the middle of the top edge"),
        ("There is a disc lying alone in the corner, and I think it should go to the left",
         "put the disc that is in the corner to the left"),
        ("There is a disc at the front and it should join the cones up at the back",
         "put the disc at the front next to the cones that is at the back"),
    ],
)  # fmt: skip
def test_where_it_stands_is_put_plainly(text, plain):
    assert put_plainly(text) == plain


@pytest.mark.parametrize(
    "text",
    [
        "put the cone up there on the left",
        "put the cup on the table there on the left",
        "push most of the cups to the left",
        "put three of the cups along the top",
        "form the left row first",
        "what stands in front of the horse",
        "count the discs from the left",
    ],
)
def test_where_something_goes_stays(text):
    assert "that is" not in put_plainly(text)
    assert put_plainly(text) in (text, text.replace("up there ", "").replace("there ", ""))


@pytest.mark.parametrize(
    ("text", "objects"),
    [
        ("block left of the cone to the near corner", ("block_1",)),
        ("the block next to the cone, bring it to the near edge", ("block_1",)),
        ("the disc lying in the near right corner, lay it in the middle", ("disc_1",)),
        ("disc on the left, put it in the tub", ("disc_2",)),
    ],
)
def test_a_thing_is_told_by_where_it_stands(text, objects):
    assert link(text, BOARD, (), LEXICON).mentions[0].objects == objects


@pytest.mark.parametrize(
    ("text", "mark"),
    [
        ("ring of the blocks around the bowl on the left", "bowl on the left"),
        ("the cone a bit towards the tub on the right", "tub on the right"),
        ("lids onto the pots at the top", "pots at the top"),
        ("put the cone between the two pots at the top", "two pots at the top"),
    ],
)
def test_a_mark_is_told_by_where_it_stands(text, mark):
    assert link(text, BOARD, (), LEXICON).mentions[-1].text == mark


@pytest.mark.parametrize(
    ("text", "mark"),
    [
        ("put the cone next to the bowl on the left", "bowl"),
        ("put the cone in the tub on the left", "tub"),
        ("the block next to the cone on the left", "cone"),
    ],
)
def test_a_side_that_may_be_where_to_is_no_part_of_the_mark(text, mark):
    assert link(text, BOARD, (), LEXICON).mentions[-1].text == mark


def test_the_others_of_some_are_others_than_those():
    linked = link("some of the pots on the left, the others on the right", BOARD, (), LEXICON)
    assert [mention.slot for mention in linked.mentions] == ["m1", "m2"]


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("the right-most of those pegs can go in the box", "the rightmost peg can go in the box"),
        ("of the four discs, I want the leftmost one to go left",
         "I want the leftmost disc to go left"),
    ],
)  # fmt: skip
def test_one_is_singled_out_of_its_group_by_its_side(text, plain):
    assert in_plain_turns(text, LEXICON) == plain


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("put the leftmost block behind the rightmost one", 2),
        ("move it from the left edge to the right one", 1),
    ],
)
def test_right_before_a_relation_is_no_part_of_the_table(text, told):
    right = link(text.replace("behind", "right behind"), BOARD, (), LEXICON)
    assert len(right.mentions) == told

"""What becomes of several things together, in the words of it that the translator knows."""

import pytest
from clarifier_table import LEXICON

from clarifier.turns import in_plain_turns


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("push the mugs close together", "put the mugs together"),
        ("make a triangle out of three pegs and place it in the far left corner",
         "make a triangle out of three pegs in the far left corner"),
        ("form a square in the middle using the pegs", "form a square in the middle with the pegs"),
        ("use three pegs to make a triangle at the top, and lift the mug",
         "make a triangle at the top with three pegs, and lift the mug"),
        ("discs round the bowl: red to its left, blue to its right, green behind it",
         "put the red disc to the left of the bowl, the blue disc to the right of the bowl, "
         "the green disc behind the bowl"),
        ("cups to saucers, but mixed: white cup on blue saucer, blue cup on white saucer",
         "white cup on blue saucer, blue cup on white saucer"),
        ("put one block in each of the bowls at the top, but never a block in a bowl of its own "
         "colour", "put each block on the bowls at the top of a different colour"),
        ("huddle the ducks up", "put the ducks together"),
        ("shove the red pegs together in the middle", "put the red pegs together in the middle"),
        ("cluster the mugs around the tray", "put the mugs around the tray"),
        ("fence the sheep in with the blocks, one on each side",
         "surround the sheep with the blocks"),
        ("box in the die from all four sides using the blocks", "surround the die with the blocks"),
        ("put the blocks on all four sides of the lamp", "put the blocks around the lamp"),
        ("a ring of candles round the cake", "put the candles around the cake"),
        ("move the jars well away from one another", "spread the jars out"),
        ("separate the pegs", "spread the pegs out"),
        ("the cans should stand as far apart as possible", "spread the cans out"),
        ("put the cork halfway between the centre of the table and the right-hand edge",
         "put the cork in the middle of the right half of the table"),
        ("put the cork midway from the far edge to the middle",
         "put the cork in the middle of the far half of the table"),
        ("put the cork halfway between the centre and the near left corner",
         "put the cork in the middle of the near left quarter of the table"),
        ("a stone at each end of my edge of the table",
         "put one stone in the near left corner and one stone in the near right corner"),
        ("lids on the pots, but the colours mustn't match",
         "put the lids on pots of a different colour"),
        ("the red lid goes on the pot of the other colour",
         "the red lid goes on the pot that is not red"),
        ("one cube per saucer but never on the saucer of its own colour",
         "put each cube on the saucers of a different colour"),
        ("the coin and the ring go into the red and the green box respectively",
         "put the coin into the red box and the ring into the green box"),
        ("split the pegs into two groups, one on the left and one on the right",
         "put half of the pegs on the left and the other half on the right"),
        ("one of the jars is close to the edge. Push the one by the lamp back",
         "Push the jar by the lamp back"),
    ],
)  # fmt: skip
def test_what_becomes_of_several_things_is_said_plainly(text, plain):
    assert in_plain_turns(text, LEXICON) == plain


@pytest.mark.parametrize(
    "text",
    [
        "stack the blocks together with the lid on the tray",
        "discs round the bowl: red to its left, the others where you like",
        "put all the cups on the saucers: red cup on blue saucer",
        "put the mug on the saucer of the same colour",
        "move the red jar further away from the lamp",
        "separate the red peg from the blue one",
        "put the cork halfway to the box",
        "one of the jars is to go on the tray",
        "draw a ring around the cake",
    ],
)
def test_other_sentences_are_left_as_they_are(text):
    assert in_plain_turns(text, LEXICON) == text

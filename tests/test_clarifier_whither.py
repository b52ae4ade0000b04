"""Where things go, in turns of phrase that leave a word to what was said before."""

import pytest
from clarifier_table import LEXICON, TABLE

from agent.messages import Option, Pending, Question
from clarifier.rewrite import elsewhere, fill
from clarifier.turns import in_plain_turns


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("the pen goes up onto the shelf board and so does the ruler",
         "the pen and the ruler go onto the shelf board"),
        ("My pen should lie left of the tin, and so should the ruler.",
         "My pen and the ruler should lie left of the tin."),
        ("push the pen over the left edge, down onto the floor",
         "push the pen over the left edge"),
        ("onto the floor over the near edge with the pen", "off the near edge with the pen"),
        ("one of the pens in the tin, rest on the mat",
         "one of the pens in the tin, the rest on the mat"),
        ("The tin only has room for two of the pens, so the others go on the mat",
         "put two of the pens in the tin and the others on the mat"),
        ("the mat has space for one of the cups only; the rest belong by the lamp",
         "put one of the cups on the mat and the rest by the lamp"),
        ("at the back edge put the pens, but not the red one",
         "put the pens at the back edge, but not the red one"),
        ("two of the pens are plenty in the tin", "two of the pens in the tin"),
        ("if the tin has the pen on its right, push the pen away",
         "if the pen is right of the tin, push the pen away"),
        ("the pen put in tin, and the red ruler put on the mat",
         "put the pen in tin, and put the red ruler on the mat"),
        ("The pen and my red ruler put in the tin, the lamp put next to the mat",
         "put The pen and my red ruler in the tin, put the lamp next to the mat"),
        ("blue pen by the tin", "blue pen next to the tin"),
        ("the pen should be placed on the mat", "place the pen on the mat"),
        ("all the pens must be put at the near edge, please",
         "put all the pens at the near edge, please"),
        ("the pen needs pushing to the left", "push the pen to the left"),
        ("once you are ready, any pen wants lifting 40 mm off its place", "lift any pen 40 mm"),
    ],
)  # fmt: skip
def test_the_words_left_out_are_said(text, plain):
    assert in_plain_turns(text, LEXICON) == plain


@pytest.mark.parametrize(
    "text",
    [
        "put the pen on the floor",
        "the tin has room for the pen",
        "the pen wants nothing",
        "the pen put on the mat must go to the left",
        "push the pen by the tin away",
        "at the back edge put the pen on the mat",
        "two of the pens are enough for me",
        "the pen should be red",
        "put the pen in the tin and rest a while",
    ],
)
def test_other_sentences_keep_theirs(text):
    assert in_plain_turns(text, LEXICON) == text


def test_a_place_with_it_and_something_else_is_no_place_alone():
    assert elsewhere("on the plate with it", TABLE, LEXICON) == "put it on the plate"
    assert elsewhere("off the far edge with it and the sponge", TABLE, LEXICON) is None
    assert elsewhere("on the plate with the sponge and it", TABLE, LEXICON) is None


def test_a_label_that_would_be_read_as_a_place_gives_way_to_the_identifier():
    where = Option("the apple by the bowl", ("apple_2",))
    asked = Question("which", "Which apple?", (Option("the red apple", ("apple_1",)), where))
    whole = fill(Pending("get the apple", asked), where, "", TABLE, (), LEXICON)
    assert whole == "get the apple_2"
    plain = fill(Pending("touch the apple", asked), asked.options[0], "", TABLE, (), LEXICON)
    assert plain == "touch the red apple"


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("place the plate so that the apple is to its left",
         "place the plate to the right of the apple"),
        ("move the cup so the bowl is behind it", "move the cup in front of the bowl"),
        ("place the plate so that it is to the left of the apple", None),
        ("the cup is too close to the bowl", "move the cup away from the bowl"),
        ("The cup stands a bit too far from the bowl.", "move The cup closer to the bowl."),
    ],
)  # fmt: skip
def test_where_another_is_to_be_tells_where_it_goes(text, plain):
    assert in_plain_turns(text, LEXICON) == (plain or text)

"""What follows a command and says only where else, which way or how much."""

import pytest
from clarifier_table import LEXICON, TABLE

from agent.messages import Dialog, Focus
from clarifier import act
from clarifier.follow_ups import followed_up, placed_instead
from clarifier.same_again import once_more

PUSHED = Dialog(last_text="push the red apple 6 cm to the left", focus=(Focus("apple_1", 1.0),))


@pytest.mark.parametrize(
    ("text", "whole"),
    [
        ("A tad further to the right", "move it A tad further to the right"),
        ("well, slightly back, maybe", "move it slightly back"),
        ("even more!", "push the red apple 6 cm to the left"),
        ("keep going, lots more", "push the red apple 6 cm to the left"),
        ("two of those back again", "push it two cm to the right"),
        ("that is too far, I would say. 2 back", "push it 2 cm to the right"),
    ],
)
def test_a_follow_up_goes_on_from_the_last_command(text, whole):
    assert followed_up(text, PUSHED, TABLE, LEXICON) == whole


@pytest.mark.parametrize(
    "text",
    [
        "more apples", "put more", "what is more", "a little to the left of the plate",
        "the sponge a bit left", "put the mug back", "no more", "left a bit of cake",
        "two apples back to the plate",
    ],
)  # fmt: skip
def test_what_names_or_asks_something_is_no_follow_up(text):
    assert followed_up(text, PUSHED, TABLE, LEXICON) is None


def test_nothing_follows_where_nothing_was_said():
    assert followed_up("more", Dialog(), TABLE, LEXICON) is None


@pytest.mark.parametrize(
    ("text", "whole"),
    [
        ("right edge it is", "put it at the right edge"),
        ("the middle of the table would be better", "put it in the middle of the table"),
        ("between the bowl and the plate, that looks neater",
         "put it between the bowl and the plate"),
        ("in the bowl", "put it in the bowl"),
    ],
)  # fmt: skip
def test_a_place_alone_is_meant_instead(text, whole):
    assert placed_instead(text, TABLE, LEXICON) == whole


@pytest.mark.parametrize(
    "text", ["the green one", "the bowl", "put the mug there", "the middle block"]
)
def test_a_thing_is_no_place(text):
    assert placed_instead(text, TABLE, LEXICON) is None


@pytest.mark.parametrize(
    "text",
    ["Good! And back where it came from, please.", "argh, undo that", "back to where it lay"],
)
def test_the_last_motion_is_taken_back(text):
    assert act.takes_back(text)


@pytest.mark.parametrize(
    "text", ["the back of the table", "back the cup against the box", "the mug back"]
)
def test_a_place_at_the_back_takes_nothing_back(text):
    assert not act.takes_back(text)


@pytest.mark.parametrize("text", ["Again, same.", "once more, the same thing"])
def test_the_same_again(text):
    assert once_more(text, PUSHED, TABLE, LEXICON) == PUSHED.last_text

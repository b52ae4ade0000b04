"""What sounds alike is told apart by what makes sense there."""

import pytest
from clarifier_table import LEXICON

from clarifier.misheard import heard_right
from clarifier.sound import alike

NAMES = {"hare", "stake", "toy plane", "sea horse", "jam jar", "red", "blue", "pear", "maize cob"}


@pytest.mark.parametrize(
    ("one", "other"),
    [("hare", "hair"), ("stake", "steak"), ("blew", "blue"), ("knight", "night"), ("tow", "toe"),
     ("cord", "chord"), ("pause", "paws"), ("bean", "been"), ("wring", "ring"), ("leak", "leek")],
)  # fmt: skip
def test_words_that_sound_alike(one, other):
    assert alike(one, other) and alike(other, one)


@pytest.mark.parametrize(
    ("one", "other"),
    [("pole", "pail"), ("pan", "pen"), ("ship", "sheep"), ("bowl", "ball"), ("cap", "cup"),
     ("can", "cane"), ("tin", "ten"), ("cup", "cup"), ("cub", "cube"), ("mat", "mate")],
)  # fmt: skip
def test_words_that_do_not(one, other):
    assert not alike(one, other)


@pytest.mark.parametrize(
    ("text", "heard"),
    [
        ("put the toy plain on the mat", "put the toy plane on the mat"),
        ("um lift the see horse please", "um lift the sea horse please"),
        ("push the hair to the left", "push the hare to the left"),
        ("take the read one", "take the red one"),
        ("both pairs in the middle please", "both pears in the middle please"),
        ("the maze cob goes to the far edge", "the maize cob goes to the far edge"),
        ("the one thats blew", "the one thats blue"),
        ("the wind blew", "the wind blew"),
    ],
)
def test_words_of_the_scene_are_heard(text, heard):
    found, said = heard_right(text, NAMES, LEXICON)
    assert found == heard and bool(said) == (heard != text)


@pytest.mark.parametrize(
    ("text", "heard"),
    [
        ("move it two the far write edge", "move it to the far right edge"),
        ("slide it to inches back", "slide it two inches back"),
        ("set the jar write next to the stake", "set the jar right next to the stake"),
        ("put all of them in a roe", "put all of them in a row"),
        ("lift the blue won", "lift the blue one"),
        ("drop the stake inn the jar", "drop the stake in the jar"),
        ("slide the jar tours me", "slide the jar towards me"),
        ("lift the jar and than the stake", "lift the jar and then the stake"),
    ],
)
def test_small_words_are_heard_in_silence(text, heard):
    assert heard_right(text, NAMES, LEXICON) == (heard, "")


@pytest.mark.parametrize(
    "text",
    [
        "put the two the same way up", "lift two of those jars", "move two stakes to the left",
        "a pair of jars to the left", "My uncle won it at cards, so lift the jar.",
        "I read the label on the red one", "write my name on the jar", "the pale jar to the left",
        "is the jar bigger than the stake", "it is for me", "put it to the right",
        "Tie her hair back, then lift the stake.", "He threw the jar at me!", "take the grey one",
        "put the jar in the middle no wait at the edge", "the inn is open",
    ],
)  # fmt: skip
def test_what_makes_sense_stays(text):
    assert heard_right(text, NAMES, LEXICON) == (text, "")

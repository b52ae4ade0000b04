"""Typing slips are repaired towards one plausible word only; ways of writing are no slips."""

import pytest
from clarifier_table import LEXICON

from clarifier.spelling import repair

NAMES = {"apple", "sponge", "plate", "zorblax", "hammer", "donut", "duck", "tea", "key", "white",
         "black", "flower pot", "toolbox", "orange"}  # fmt: skip
"""The names of what is there, and its colours."""


@pytest.mark.parametrize(
    ("text", "repaired"),
    [
        ("push the aple left", "push the apple left"),
        ("push the appel left", "push the apple left"),
        ("put the spnge on the plaet", "put the sponge on the plate"),
        ("lift the zorblx", "lift the zorblax"),
        ("plcae it there", "place it there"),
        ("psuh it", "push it"),
        ("the whtie one", "the white one"),
        ("the balck one", "the black one"),
        ("lift the kye", "lift the key"),
        ("lift the kee", "lift the key"),
        ("two oragnes", "two oranges"),
        ("lift the hmmr", "lift the hammer"),
        ("next to the flowrepot", "next to the flower pot"),
    ],
)
def test_a_slip_is_repaired_and_said(text, repaired):
    found, said = repair(text, NAMES, LEXICON)
    assert found == repaired and said.startswith("I read")


@pytest.mark.parametrize(
    "text",
    ["push the plane left", "share the apple", "start with the plate", "lift the flask",
     "the glorp", "tap the cap", "push the apples", "putting it down", "in the hamper",
     "the spine", "pls lift it lol", "the bat", "late", "donate it"],
)  # fmt: skip
def test_other_words_are_left_alone(text):
    assert repair(text, NAMES, LEXICON) == (text, "")


@pytest.mark.parametrize(
    ("text", "read"),
    [
        ("in the far cornr", "in the far corner"),
        ("wiht the spoon", "with the spoon"),
        ("lift teh tea", "lift the tea"),
        ("shv it abt 4 cm twrds me", "shove it about 4 cm towards me"),
        ("mv the key to the lft", "move the key to the left"),
        ("lft the key", "lift the key"),
        ("swp the key n the tea", "swap the key n the tea"),
        ("btwn the plate and the key, thn stop", "between the plate and the key, then stop"),
        ("it is nearer thn the key", "it is nearer than the key"),
        ("the blck one", "the black one"),
        ("adn then lift it", "and then lift it"),
        ("put severl of the keys away", "put several of the keys away"),
    ],
)
def test_small_words_and_shorthand_are_read_in_silence(text, read):
    assert repair(text, NAMES, LEXICON) == (read, "")


@pytest.mark.parametrize("text", ["hm, the tea", "psst", "asdf jkl qwop", "2 cm", "plss lift it"])
def test_sounds_and_noise_are_no_shorthand(text):
    assert repair(text, NAMES, LEXICON) == (text, "")


def test_a_thing_of_the_scene_is_read_before_other_words():
    assert repair("lift the bt", {"bat"}, LEXICON)[0] == "lift the bat"
    assert repair("push it abt 3 cm", {"bat"}, LEXICON)[0] == "push it about 3 cm"


def test_a_slip_of_several_words_is_left_alone():
    names = {"bell", "ball"}
    assert repair("lift the bxll", names, LEXICON) == ("lift the bxll", "")


def test_a_word_of_the_scene_wins_over_others():
    assert repair("the wite cup", {"cup", "white"}, LEXICON)[0] == "the white cup"
    assert repair("the wite cup", {"cup"}, LEXICON)[0] == "the wite cup"


@pytest.mark.parametrize(
    ("text", "read"),
    [
        ("dont drop it", "don't drop it"),
        ("the one thats red", "the one that's red"),
        ("its plate", "its plate"),
        ("lift the flowerpot", "lift the flower pot"),
        ("both flowerpots", "both flower pots"),
        ("in the tool box", "in the toolbox"),
        ("in the tool-box", "in the toolbox"),
        ("put it inbetween", "put it in between"),
        ("put it on the left side of the board", "put it on the left side of the table"),
        ("to the desk's far edge, please", "to the table's far edge, please"),
        ("put it on the board game", "put it on the board game"),
        ("next to eachother", "next to each other"),
        ("apple -> plate", "apple onto plate"),
        ("apple -> the middle", "apple to the middle"),
        ("apple & plate", "apple and plate"),
    ],
)
def test_ways_of_writing_are_read_in_silence(text, read):
    assert repair(text, NAMES, LEXICON) == (read, "")


def test_a_name_is_not_taken_apart_where_both_ways_are_there():
    names = {"notepad", "sticky note pad"}
    assert repair("lift the notepad", names, LEXICON)[0] == "lift the notepad"

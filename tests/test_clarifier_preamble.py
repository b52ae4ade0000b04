"""What a sentence only tells is cut off; what points at it is named."""

import pytest
from clarifier_table import LEXICON, TABLE, talk

from clarifier.preamble import to_the_point


def point(text):
    return to_the_point(text, TABLE, (), LEXICON)


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("the bottle is about to fall, pick it up", "pick the bottle up"),
        ("there are three blocks, one of them on the left, all the others on the right",
         "one of the three blocks on the left, all the others on the right"),
        ("I see three blocks, bring the yellow one to the right", "bring the yellow block to the \
right"),
        ("look at the plate. Put the red apple onto it", "Put the red apple onto the plate"),
        ("there are some apples here and there, push the green one left",
         "push the green apple left"),
        ("well, let's sort the mugs: put them in the bowl", "put the mugs in the bowl"),
        ("do you see the sponge and the bottle? swap them", "swap the sponge and the bottle"),
        ("we are packing our things, so put the sponge in the bowl", "put the sponge in the bowl"),
        ("I would like to have a nice tower. Stack the blocks", "Stack the blocks"),
        ("the mug we drank from, put it on the plate", "put the mug on the plate"),
        ("those three blocks, you stack them", "stack those three blocks"),
        ("any mug, push it to the left", "push any mug to the left"),
        ("is there a bottle? lift it", "lift the bottle"),
        ("we have three blocks, the last one from the right goes in the bowl",
         "the last block from the right goes in the bowl"),
        ("I see some mugs, the leftmost goes in the bowl", "the leftmost mug goes in the bowl"),
        ("the bowl is empty, put the red apple in it", "put the red apple in the bowl"),
    ],
)  # fmt: skip
def test_what_is_wanted_is_said_without_what_is_told(text, wanted):
    assert point(text) == wanted


@pytest.mark.parametrize(
    "text",
    [
        "put the apple on the plate, then push it left",
        "if the bowl is empty, put the sponge in it",
        "the sponge should be on the plate, move it to the left then",
        "there are two mugs, put both on the plate",
        "the bowl is here, put the sponge next to the bottle",
        "pick up the bottle, the sponge and the plate",
        "there is a plate and a bowl, put the sponge there",
        "the bottle isn't on the plate, put it there",
        "the sponge",
        "those two, swap",
        "hey, put the sponge and the bottle by the bowl, but not near it",
    ],
)
def test_what_cannot_be_left_out_stays(text):
    assert point(text) == text


def test_the_rest_is_decided_on_as_if_it_were_all(clarifier):
    (decision,) = talk(clarifier, "there are three blocks here, so please lift the yellow one")
    assert (decision.do, decision.touched) == ("act", ("yellow_block_1",))

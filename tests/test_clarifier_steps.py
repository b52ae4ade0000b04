"""One thing after another: steps in their order, each with its verb."""

import pytest
from clarifier_table import LEXICON, TABLE

from clarifier.steps import in_steps


def steps(text):
    return in_steps(text, TABLE, (), LEXICON)


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("Once you've put the sponge on the plate, lift the bottle",
         "put the sponge on the plate, then lift the bottle"),
        ("after you have moved the sponge to the bowl, please touch it",
         "move the sponge to the bowl, then touch it"),
        ("having slid the sponge left, lift the bottle",
         "slide the sponge left, then lift the bottle"),
        ("lift the bottle once you have put the sponge on the plate",
         "put the sponge on the plate, then lift the bottle"),
        ("First touch the bowl, after that the plate, and lastly the bottle.",
         "touch the bowl, then touch the plate, then touch the bottle."),
        ("firstly tap the bowl, secondly the plate, thirdly the bottle",
         "tap the bowl, then tap the plate, then tap the bottle"),
        ("touch the bowl, then the plate", "touch the bowl, then touch the plate"),
        ("to begin with put the sponge on the plate. Afterwards lift the bottle",
         "put the sponge on the plate, then lift the bottle"),
        ("Begin by placing the sponge on the plate. Next, lift the bottle",
         "place the sponge on the plate, then lift the bottle"),
        ("you put the sponge on the plate and when that's done you lift the bottle",
         "put the sponge on the plate, then lift the bottle"),
        ("put the sponge on the plate, and after put the bottle in the bowl",
         "put the sponge on the plate, then put the bottle in the bowl"),
        ("the bottle goes on the plate, then the mug on top",
         "the bottle goes on the plate, then put the mug on top of the bottle"),
        ("put the bottle on the plate and then put the red mug on top",
         "put the bottle on the plate and then put the red mug on top of the bottle"),
    ],
)  # fmt: skip
def test_steps_are_said_in_their_order(text, plain):
    assert steps(text) == plain


@pytest.mark.parametrize(
    "text",
    [
        "put the sponge on the plate",
        "put the sponge next to the plate",
        "lift the first block",
        "once the bowl is on the plate, lift the bottle",
        "when you like, lift the bottle",
        "touch the last block",
        "put the mug on the next plate",
        "put the sponge on top",
        "after the meal, lift the bottle",
        "the third resting on both",
        "a pyramid: two side by side below, the third resting on both",
        "",
    ],
)
def test_what_has_no_steps_stays_as_it_is(text):
    assert steps(text) == text

"""A landmark said once for a list; headings; slang for putting and pushing."""

import pytest
from clarifier_table import TABLE

from agent.messages import Dialog
from clarifier.lexicon import load_lexicon
from clarifier.mentions import link
from clarifier.passing import without_asides_said
from clarifier.refusals import State, beyond_me
from clarifier.shared import landmark_shared
from clarifier.turns import in_plain_turns

LEXICON = load_lexicon()


def linked(text):
    return link(text, TABLE, (), LEXICON)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("put the sponge left of the bowl, the bottle on the right and the plate behind",
         "put the sponge left of the bowl, the bottle right of the bowl and the plate behind the"
         " bowl"),
        ("sponge to the right of the plate, bottle to the left",
         "sponge to the right of the plate, bottle left of the plate"),
        ("the sponge goes behind the bowl, the bottle in front",
         "the sponge goes behind the bowl, the bottle in front of the bowl"),
    ],
)  # fmt: skip
def test_a_landmark_goes_for_every_item(text, said):
    assert landmark_shared(linked(text)) == said


@pytest.mark.parametrize(
    "text",
    [
        "put the sponge on the left and the bottle on the right",
        "put the sponge on the plate, the bottle on the right",
        "put the sponge left of the bowl and push the bottle to the right",
        "put the sponge left of the bowl and the bottle on the right side of the table",
        "put the sponge left of the bowl and the bottle behind the plate",
    ],
)
def test_what_has_its_own_place_keeps_it(text):
    assert landmark_shared(linked(text)) is None


@pytest.mark.parametrize(
    "text", ["lay me a place: {}", "set the table for one: {}", "please make a nice setting: {}"]
)
def test_a_heading_wants_nothing_of_its_own(text):
    rest = "sponge left of the plate, bottle right of it"
    assert without_asides_said(text.format(rest), ["sponge", "plate", "bottle"]) == rest


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("chuck the sponge off the table", "push the sponge off the table"),
        ("just toss the bottle over the far edge", "just push the bottle over the far edge"),
        ("chuck the sponge at me", "chuck the sponge at me"),
        ("throw the bottle off the table", "throw the bottle off the table"),
    ],
)
def test_chucking_something_off_is_pushing_it(text, said):
    assert in_plain_turns(text, LEXICON) == said


@pytest.mark.parametrize(
    ("text", "done"),
    [
        ("chuck the sponge next to the bowl", True),
        ("toss the sponge in the bowl", True),
        ("chuck the sponge at the bowl", False),
        ("hurl the sponge next to the bowl", False),
    ],
)
def test_slang_for_putting_is_told_from_throwing(text, done):
    refused = beyond_me(linked(text), State(TABLE, Dialog()), LEXICON)
    assert (refused is None) is done


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("clear out the left half of the table",
         "move everything in the left half of the table to the right half of the table"),
        ("please empty the back half, we need the room",
         "please move everything in the back half of the table to the front half of the table, we"
         " need the room"),
        ("start by emptying the right side of the desk",
         "start by moving everything in the right half of the table to the left half of the table"),
        ("clear the mug off the left half", "move the mug to the right half of the table"),
        ("clear the mug off the left half onto the plate",
         "clear the mug off the left half onto the plate"),
        ("clear the table", "clear the table"),
    ],
)  # fmt: skip
def test_what_stands_in_a_half_that_is_cleared_goes_to_the_other(text, said):
    assert in_plain_turns(text, LEXICON) == said


@pytest.mark.parametrize(
    "text",
    [
        "lift the bottle and hold it, wiping under it",
        "put the apples on the plate, save the red, who breaks up the row nicely",
        "both apples, mixing bowl",
    ],
)
def test_what_nobody_is_told_to_do_is_not_refused(text):
    assert beyond_me(linked(text), State(TABLE, Dialog()), LEXICON) is None


@pytest.mark.parametrize(
    "text", ["wiping the plate would be nice", "smash the plate", "push the bottle until it breaks"]
)
def test_harm_and_what_no_arm_can_are_refused(text):
    assert beyond_me(linked(text), State(TABLE, Dialog()), LEXICON) is not None

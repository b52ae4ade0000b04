"""Clearing a plate, emptying a bowl: what stands there is taken away, the carrier stays."""

import pytest
from clarifier_table import LEXICON, linked, thing

from agent.messages import Dialog
from clarifier.clearing import cleared, nothing_there
from clarifier.refusals import State
from scene.types import Scene

LADEN = Scene(
    objects=(
        thing("plate", 0.0, 0.0, size=0.4, tall=0.02),
        thing("block", 0.0, 0.0, z=0.02, on="plate_1"),
        thing("lime", 0.0, 0.0, z=0.12, on="block_1"),
        thing("bowl", 0.6, 0.6, size=0.3),
    )
)


@pytest.mark.parametrize(
    "text", ["clear the plate", "clear off the plate please", "take everything off the plate"]
)
def test_what_stands_on_it_is_taken_off_from_the_top_down(text):
    said = cleared(linked(text, LADEN), LADEN, LEXICON)
    assert said == "take the lime off the plate, then take the block off the plate"


@pytest.mark.parametrize(
    "text",
    ["clear the plate away", "clear a space next to the plate", "put everything on the plate",
     "take the lime off the plate", "clear the plate and the bowl"],
)  # fmt: skip
def test_other_wishes_are_left_as_they_are(text):
    assert cleared(linked(text, LADEN), LADEN, LEXICON) is None


def test_a_bare_one_is_said_to_be_bare():
    decision = nothing_there(linked("empty the bowl", LADEN), State(LADEN, Dialog()))
    assert decision.do == "answer" and decision.reply == "There is nothing in the bowl."
    assert nothing_there(linked("empty the plate", LADEN), State(LADEN, Dialog())) is None

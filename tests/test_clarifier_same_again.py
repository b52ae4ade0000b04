"""Measures and commands that are said once and meant again."""

import pytest
from clarifier_table import TABLE

from agent.messages import Dialog
from clarifier.lexicon import load_lexicon
from clarifier.same_again import lacks_measure, once_more, with_same_measure, with_unit

LAST = "slide the mug 7 cm to the right"


@pytest.mark.parametrize(
    ("text", "last", "said"),
    [
        ("nudge the pen 3 cm back and the cup forward by the same amount", None,
         "nudge the pen 3 cm back and the cup forward by 3 cm"),
        ("now the bowl the same distance to the left", LAST, "now the bowl 7 cm to the left"),
        ("push the bowl just as far to the left", LAST, "push the bowl 7 cm to the left"),
        ("push the bowl left by that much", LAST, "push the bowl left by 7 cm"),
        ("spin the lid half a turn, then the jar by the same angle", LAST,
         "spin the lid half a turn, then the jar by half a turn"),
        ("turn the lid 90 degrees after pushing it 2 inches, then push the jar as far", None,
         "turn the lid 90 degrees after pushing it 2 inches, then push the jar 2 inches"),
    ],
)  # fmt: skip
def test_the_measure_said_before_is_meant(text, last, said):
    assert with_same_measure(text, Dialog(last_text=last)) == said


@pytest.mark.parametrize(
    "text",
    [
        "push the cup as far to the left as you can",
        "push it as far as possible",
        "put both cups the same distance from the plate",
        "leave the same distance between the cups",
        "push the cup twice the same distance to the left",
        "do the same with the red one",
    ],
)
def test_other_samenesses_stay(text):
    assert with_same_measure(text, Dialog(last_text=LAST)) == text
    assert not lacks_measure(text)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("slide the mug left five centimetres and the cup right ten.",
         "slide the mug left five centimetres and the cup right ten centimetres."),
        ("push it back 2 inches, then left 3", "push it back 2 inches, then left 3 inches"),
        ("push the cup left 5", "push the cup left 5"),
        ("move it 5cm left and the two cups right", "move it 5cm left and the two cups right"),
    ],
)  # fmt: skip
def test_a_number_alone_has_the_unit_said_before(text, said):
    assert with_unit(text) == said


def test_an_amount_that_nobody_said_is_missing():
    text = "push the bowl to the left by the same amount"
    assert with_same_measure(text, Dialog(last_text="put the cup on the plate")) == text
    assert lacks_measure(text)


@pytest.mark.parametrize(
    "text", ["and the same again", "once more, please", "Do that again!", "repeat that",
             "okay, now do the same thing one more time", "Again."]
)  # fmt: skip
def test_the_last_command_is_meant_again(text):
    assert once_more(text, Dialog(last_text=LAST), TABLE, load_lexicon()) == LAST
    assert once_more(text, Dialog(), TABLE, load_lexicon()) is None


@pytest.mark.parametrize(
    "text", ["put it back again", "the same with the mug", "push it again to the left", "and that"]
)
def test_what_says_more_is_no_mere_repetition(text):
    assert once_more(text, Dialog(last_text=LAST), TABLE, load_lexicon()) is None

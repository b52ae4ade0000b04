"""A deed that the same sentence takes back is not done."""

import pytest
from clarifier_table import LEXICON, thing

from clarifier.corrected import corrected
from scene.types import Scene

TABLE = Scene(objects=(thing("cup", 0, 0), thing("red brick", 0.5, 0), thing("box", -0.5, 0)))


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("push the cup to the left, no wait, push it to the right",
         "push the cup to the right"),
        ("lift the cup, actually no, touch the red brick", "touch the red brick"),
        ("put the cup in the box... scratch that, put it next to the box",
         "put the cup next to the box"),
        ("push the red brick up to the box, oh no, wait a second, just turn it a bit",
         "turn the red brick a bit"),
        ("lift the cup and put it in the box - wait, no - put it on the red brick",
         "lift the cup, then put it on the red brick"),
        ("push the cup 10 cm towards the box, no wait, towards the red brick",
         "push the cup 10 cm towards the red brick"),
        ("put the cup to the left of the box, sorry, no, next to the red brick",
         "put the cup next to the red brick"),
        ("touch the cup, no wait, touch the box, no wait, lift it", "lift the box"),
    ],
)  # fmt: skip
def test_only_what_is_said_last_is_left(text, meant):
    assert corrected(text, TABLE, (), LEXICON) == meant


@pytest.mark.parametrize(
    "text",
    [
        "no wait, put the cup in the box",  # of what was said before
        "put the cup on the box, no wait, the red brick",  # another thing, not another deed
        "wait until the cup stands still",
        "put the cup in the box and don't touch the red brick",
    ],
)
def test_other_sentences_are_left_as_they_are(text):
    assert corrected(text, TABLE, (), LEXICON) == text

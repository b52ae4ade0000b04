"""Wishes told as questions, or as what happens."""

import pytest
from clarifier_table import LEXICON

from clarifier.turns import in_plain_turns


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("Excuse me, might my ring be returned to that dish?", "put my ring to that dish"),
        ("could the jug kindly be pushed to the left a little?",
         "push the jug to the left a little"),
        ("Could the lamp come a bit closer to the vase?", "move the lamp a bit closer to the vase"),
        ("The jug is in my way; could it perhaps move to the far edge?",
         "The jug is in my way; move it to the far edge"),
        ("I would like the jug returned to its original spot", "put the jug back where it was"),
        ("oh no, the tin soldier topples over, crash", "knock over the tin soldier"),
        ("make it so that the jug falls over, please", "knock over the jug, please"),
        ("indicate to my guests where the jug is", "point at the jug"),
        ("whichever of those is the widest goes on the tray", "the widest thing goes on the tray"),
    ],
)  # fmt: skip
def test_a_wish_is_put_as_what_is_to_be_done(text, plain):
    assert in_plain_turns(text, LEXICON) == plain


@pytest.mark.parametrize(
    "text",
    [
        "could the jug be heavy?", "can the jug be seen from here?",
        "the jug falls over easily", "if the jug falls over, leave it",
        "careful, the jug falls over!", "push the jug until it falls over",
        "would the jug be better on the tray?", "where can the jug be put?",
        "could the jug come loose?", "where is the jug?",
        "can the red pen move into the red jug, and the blue one into the blue jug?",
    ],
)  # fmt: skip
def test_what_asks_or_tells_stays(text):
    assert in_plain_turns(text, LEXICON) == text

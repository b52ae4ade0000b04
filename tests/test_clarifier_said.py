"""Turns of phrase put plainly: slang, light verbs, places said twice."""

import pytest

from clarifier.said import put_plainly


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("give the skittle a dunt and knock it over", "knock the skittle over"),
        ("gie that can a wee tap and push it left", "push that can left"),
        ("give the can a wallop so it falls over", "knock the can over"),
        ("two cubes may go to bed in the box", "two cubes may go in the box"),
        ("all but two go down, u pick which two get to stay", "all but two go down"),
        ("put it to the left of the can, not miles off", "put it to the left of the can"),
        ("let it tumble to its side", "knock it over on its side"),
        ("and what I want you to do, with a finger, is slide it left", "and slide it left"),
        ("center the nut on the midpoint of the two cans", "put the nut between the two cans"),
        ("give the can a good shove to the left", "shove the can to the left"),
        ("chuck the rag this side of the can", "put the rag in front of the can"),
        ("put the rag on the far side of the can", "put the rag behind the can"),
        ("bung everything in the bucket", "put everything in the bucket"),
        ("sling the rag over by the can", "put the rag by the can"),
        ("hang on to it until I say otherwise", "hold it"),
        ("lift the can and keep hold of it till I tell you", "lift the can and hold it"),
        ("hold the can up until further notice", "hold the can up"),
        ("push it to the top right corner, so the one furthest from me on the right thank you",
         "push it to the top right corner thank you"),
        ("to the left edge, that is, the side where my left hand is", "to the left edge"),
        ("what I would like is the cup on the plate", "put the cup on the plate"),
        ("lay your finger for a moment on the bell", "touch the bell"),
        ("do a lap round the outside of the box with ur arm, no touchin it",
         "do a lap round the box with your arm, without touching it"),
        ("put all but the car into the box", "put everything except the car into the box"),
        ("put the cups in the box, all of them", "put the cups in the box"),
    ],
)  # fmt: skip
def test_a_turn_of_phrase_is_put_plainly(text, plain):
    assert " ".join(put_plainly(text).split()) == plain


@pytest.mark.parametrize(
    "text",
    [
        "chuck the rag at the can", "toss the can across the room",
        "chuck the can at me by the lamp", "push the cup until I say stop", "take hold of the cup",
        "on the far side of the table", "all of them", "give the cup to me",
        "push it to the top right corner, so the one nearest me on the left",
        "lob the can off the table in one go",
    ],
)  # fmt: skip
def test_what_means_something_else_stays(text):
    assert put_plainly(text) == text

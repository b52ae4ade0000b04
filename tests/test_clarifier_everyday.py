"""How people say things on an ordinary day, put plainly."""

import pytest

from clarifier.everyday import in_everyday_words


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("if the cube is taller then the box put it left",
         "if the cube is taller than the box put it left"),
        ("put it twice as far form the saucer", "put it twice as far from the saucer"),
        ("putt the plum down", "put the plum down"),
        ("if something is lying on it touch it", "if there is something on it touch it"),
        ("if it's the mug that is on the left, tap it", "if the mug is on the left, tap it"),
        ("if the book is red tap it, otherwise leave everything as it is",
         "if the book is red tap it, otherwise do nothing"),
        ("if the jug isn't on the tray, put it there",
         "put the jug on the tray unless it is already there"),
        ("if the jug is free, which I believe it is, lift it", "if the jug is free, lift it"),
        ("move the jug left, I don't know why", "move the jug left"),
        ("set the jug at the edge, where nobody is going to elbow it", "set the jug at the edge"),
        ("put the tea in the white mug, the blue one being my sister's",
         "put the tea in the white mug"),
        ("put the phone left, with the notebook staying just where it is",
         "put the phone left, without moving the notebook"),
        ("I've tidied all morning, what would really help is if the phone could live in the corner",
         "put the phone in the corner"),
        ("all it needs is for the tea bag to be dropped in the mug", "put the tea bag in the mug"),
        ("of all those pots it is the shortest one that is in my way, so do put it in the corner",
         "put the shortest pot in the corner"),
        ("my grandson always leaves his beaker in the middle, so please take it and put it left",
         "take the beaker and put it left"),
        ("make the two cars park next to each other", "put the two cars next to each other"),
        ("make one line with the corks", "put the corks in one line"),
        ("put every piece of fruit in the bowl", "put all the fruit in the bowl"),
        ("put the fuse by the relay and nowhere near the plug",
         "put the fuse by the relay, not next to the plug"),
        ("I'd like two bears, any two you like, on the tray", "I'd like two bears, on the tray"),
        ("I don't want the mug on the table, push it off", "push the mug off"),
        ("put the lid behind the book with a gap of 3 cm", "put the lid 3 cm behind the book"),
        ("the jar behind the spoon, the squat one, goes left",
         "the squat jar behind the spoon, goes left"),
    ],
)  # fmt: skip
def test_what_people_say_is_put_plainly(text, plain):
    assert in_everyday_words(text) == plain


@pytest.mark.parametrize(
    "text",
    [
        "lift the plum, then the cup",
        "put the water then the cup on the tray",
        "if the cup is on the tray put it in the box",
        "fill the form the teacher gave me",
        "push the car over, then the box",
        "leave everything as it is",
        "make the tower higher",
        "put two cups on the tray, any order will do",
    ],
)
def test_other_words_stay_as_they_are(text):
    assert in_everyday_words(text) == text

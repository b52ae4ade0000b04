"""One for each: what is handed out is a group, and there may be too few of it."""

import pytest
from clarifier_table import LEXICON, linked, talk, thing

from clarifier.handed_out import handed_out, is_handed_out, not_handed_out
from clarifier.said import put_plainly
from scene.types import Scene

EGGS = tuple(thing("egg", -0.6 + 0.3 * n, 0.6, number=n + 1, size=0.1) for n in range(3))
BOWLS = tuple(thing("bowl", -0.6 + 0.5 * n, -0.4, number=n + 1, size=0.3) for n in range(2))
PLATES = tuple(thing("plate", -0.6 + 0.5 * n, 0.0, number=n + 1, size=0.3) for n in range(4))
KITCHEN = Scene(objects=(*EGGS, *BOWLS, *PLATES, thing("jug", 0.7, -0.6)))


def put(text):
    return handed_out(linked(put_plainly(text), scene=KITCHEN), LEXICON)


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("set an egg on every plate", "set the eggs on the plates, one on each"),
        ("set one egg on each plate", "set the eggs on the plates, one on each"),
        ("lay one of the three eggs on each of the plates",
         "lay the three eggs on the plates, one on each"),
        ("drop an egg into each of the two bowls, quickly",
         "drop the eggs into the two bowls, one in each, quickly"),
        ("stand an egg next to every bowl", "stand the eggs next to the bowls, one next to each"),
        ("each bowl gets one of the eggs", "put the eggs into the bowls, one in each"),
        ("each of all the bowls should have an egg on it",
         "put the eggs on the bowls, one on each"),
        ("on every plate put an egg, please", "put the eggs on the plates, one on each, please"),
        ("on each of the plates one of the eggs", "put the eggs on the plates, one on each"),
        ("give each bowl an egg", "put the eggs into the bowls, one in each"),
        ("top every plate with an egg", "put the eggs on the plates, one on each"),
        ("an egg for each plate", "the eggs on the plates, one on each"),
        ("one egg per bowl", "the eggs into the bowls, one in each"),
    ],
)  # fmt: skip
def test_what_is_handed_out_is_a_group(text, plain):
    assert put(text) == plain


@pytest.mark.parametrize(
    "text",
    [
        "put an egg on a plate",
        "put the jug on each plate",
        "put the eggs on the plates, one on each",
        "put an egg in front of each plate",
        "touch each plate and lift an egg",
        "push each egg towards a plate",
        "put each egg on a plate",
        "put every egg in a bowl",
    ],
)
def test_nothing_else_is(text):
    assert put(text) is None


@pytest.mark.parametrize(
    ("text", "known"),
    [
        ("put an egg in front of each plate", False),
        ("put two eggs on each plate", False),
        ("put two eggs on the left plate", True),
        ("put all the eggs behind each plate", True),
        ("touch an egg and each plate", True),
    ],
)
def test_what_no_program_knows_how_to_hand_out_is_told(text, known):
    assert (not_handed_out(linked(text, scene=KITCHEN)) is None) == known


def test_too_few_are_told_of_and_asked_about(clarifier):
    assert is_handed_out(linked("put the eggs on the plates, one on each", scene=KITCHEN))
    (decision,) = talk(clarifier, "put an egg in front of each plate", scene=KITCHEN)
    assert decision.do == "refuse" and "one by one" in decision.reply
    (decision,) = talk(clarifier, "put an egg in each bowl and the rest on the jug", scene=KITCHEN)
    assert decision.do == "refuse" and "sentence of its own" in decision.reply

"""Layouts in other words: spread out, one in every corner, a circle; what is taken farther off."""

import pytest
from clarifier_table import thing

from clarifier.amounts import amounts
from clarifier.lexicon import load_lexicon
from clarifier.mentions import link
from clarifier.stated import as_stated, stated
from clarifier.turns import in_plain_turns
from scene.types import Scene

LEXICON = load_lexicon()
TABLE = Scene(objects=(thing("lamp", -0.2, 0.0), thing("jug", 0.3, 0.0, size=0.3, tall=0.3)))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("place the magnets so that no two of them are near each other", "spread the magnets out"),
        ("arrange the dice so no two dice touch", "spread the dice out"),
        ("put one candle in each corner", "put four candles in the four corners"),
        ("stand a cone in every one of the four corners",
         "stand four cones in the four corners"),
        ("put one candle in the far left corner", "put one candle in the far left corner"),
        ("space the cones out a bit", "spread the cones out a bit"),
    ],
)  # fmt: skip
def test_layouts_in_plainer_words(text, said):
    assert in_plain_turns(text, LEXICON) == said


@pytest.mark.parametrize(
    ("text", "sorts"),
    [
        ("form one circle with the buttons", []),
        ("arrange the buttons in one circle", []),
        ("turn the dial one circle", ["t"]),
        ("spin it half a circle", ["t"]),
    ],
)
def test_a_circle_of_things_is_no_turn(text, sorts):
    assert [found.sort for found in amounts(text)] == sorts


@pytest.mark.parametrize("verb", ["take", "bring", "move"])
def test_what_is_taken_farther_away_is_moved(verb):
    linked = link(f"{verb} the lamp farther from the jug", TABLE, (), LEXICON)
    assert [one.mention.text for one in linked.spoken] == ["lamp", "jug"]
    goals = stated(linked, {"m1": ("lamp_1",), "m2": ("jug_1",)}, TABLE)
    held = thing("lamp", -0.2, 0.0, held=True)
    assert not as_stated(goals, TABLE, Scene(objects=(held, TABLE.objects[1])))
    assert as_stated(goals, TABLE, Scene(objects=(thing("lamp", -0.7, 0.0), TABLE.objects[1])))


def test_behind_lift_it_still_tells_which():
    linked = link("lift the lamp farther from the jug", TABLE, (), LEXICON)
    assert [one.mention.text for one in linked.spoken] == ["lamp farther from the jug"]

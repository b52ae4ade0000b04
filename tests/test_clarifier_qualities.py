"""Groups that only a quality tells: everything of a colour or a material, or not of it."""

import pytest
from clarifier_table import talk, thing

from clarifier.lexicon import load_lexicon
from clarifier.mentions import link
from clarifier.said import put_plainly
from scene.types import Scene

LEXICON = load_lexicon()
TABLE = Scene(
    objects=(
        thing("oak cube", -0.6, 0.5, "red"),
        thing("wooden ring", -0.3, 0.5),
        thing("copper washer", 0.0, 0.5),
        thing("iron nail", 0.3, 0.5),
        thing("plastic cap", 0.6, 0.5, "blue"),
        thing("rubber duck", 0.6, 0.0, "yellow"),
        thing("crate", 0.0, -0.5, "red", size=0.4, tall=0.2),
    )
)
WOOD = {"oak_cube_1", "wooden_ring_1"}
METAL = {"copper_washer_1", "iron_nail_1"}
REST = {"plastic_cap_1", "rubber_duck_1"}


def moved(text):
    linked = link(put_plainly(text), TABLE, (), LEXICON)
    return set(linked.spoken[0].mention.objects)


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("put everything wooden in the crate", WOOD),
        ("everything made of wood goes into the crate", WOOD),
        ("drop whatever is metal into the crate", METAL),
        ("put anything metallic in the crate", METAL),
        ("put all that is made of metal in the crate", METAL),
        ("the metal stuff goes in the crate", METAL),
        ("put the metal ones in the crate", METAL),
        ("put everything that is not metal in the crate", WOOD | REST),
        ("put everything that isn't wooden into the crate", METAL | REST),
        ("put all non-metal things in the crate", WOOD | REST),
        ("put everything non-wooden in the crate", METAL | REST),
        ("put everything blue or yellow in the crate", REST),
        ("put everything that is red next to the rubber duck", {"oak_cube_1", "crate_1"}),
        ("put everything red into the crate", {"oak_cube_1"}),
        ("everything goes in the crate", WOOD | METAL | REST),
        ("put everything stone in the crate", set()),
    ],
)
def test_a_quality_narrows_everything(text, named):
    assert moved(text) == named


@pytest.mark.parametrize(
    "text", ["push everything left", "put everything on the crate", "move everything away from me"]
)
def test_a_place_is_no_quality(text):
    assert len(moved(text)) >= len(WOOD | METAL | REST)


@pytest.mark.parametrize("text", ["touch the shiny mugs", "touch the clean mugs"])
def test_a_quality_that_nobody_sees_is_asked_about(clarifier, text):
    asked = talk(clarifier, text)[0]
    assert asked.do == "ask" and "I can't tell what is" in asked.question.text
    assert {o for option in asked.question.options for o in option.objects} == {"mug_1", "mug_2"}


@pytest.mark.parametrize("text", ["touch the lovely mugs", "touch the two different mugs"])
def test_a_quality_that_tells_nothing_apart_is_passed_over(clarifier, text):
    assert "I can't tell" not in (talk(clarifier, text)[0].reply or "")

"""What a phrase denotes: names, synonyms and classes, then adjectives, sides and relations."""

import msgspec
import pytest
from clarifier_table import TABLE, named, thing

from scene.types import Scene


@pytest.mark.parametrize(
    ("phrase", "objects"),
    [
        ("the apple", {"apple_1", "apple_2"}),
        ("the red apple", {"apple_1"}),
        ("the red thing", {"apple_1", "mug_1", "red_block_1"}),
        ("the fruit", {"apple_1", "apple_2"}),
        ("the cup", {"mug_1", "mug_2"}),
        ("the cube", {"red_block_1", "green_block_1", "yellow_block_1"}),
        ("the yellow brick", {"yellow_block_1"}),
        ("the purple block", set()),
        ("the flask", set()),
        ("the guitar", set()),
        ("the left mug", {"mug_1"}),
        ("the mug on the right", {"mug_2"}),
        ("the far block", {"red_block_1"}),
        ("the tallest object", {"bottle_1"}),
        ("the biggest apple", {"apple_1", "apple_2"}),
        ("the last block from the left", {"green_block_1"}),
        ("the fifth apple", set()),
        ("the apple next to the bowl", {"apple_2"}),
        ("the mug nearest to the bottle", {"mug_2"}),
        ("apple_2", {"apple_2"}),
        ("the shiny bottle", {"bottle_1"}),
        ("both mugs", {"mug_1", "mug_2"}),
    ],
)
def test_a_phrase_denotes(phrase, objects):
    found = named(f"touch {phrase}")
    assert set().union(*found.values()) == objects


def test_an_exact_name_wins_over_a_synonym():
    scene = Scene(objects=(thing("cup", 0.0, 0.0), thing("mug", 0.5, 0.0)))
    assert named("touch the cup", scene)["cup"] == ("cup_1",)
    assert named("touch the mug", scene)["mug"] == ("mug_1",)


def test_a_name_in_full_wins_over_its_noun():
    scene = Scene(objects=(thing("mug", 0.0, 0.0), thing("coffee mug", 0.5, 0.0)))
    assert named("touch the coffee mug", scene)["coffee mug"] == ("coffee_mug_1",)


def test_a_colour_in_the_name_and_a_colour_attribute_are_one():
    scene = Scene(objects=(thing("red cube", 0.0, 0.0), thing("cube", 0.5, 0.0, "red")))
    assert len(named("touch the red cube", scene)["red cube"]) == 2


def test_orange_is_a_fruit_or_a_colour():
    scene = Scene(objects=(thing("orange", 0.0, 0.0), thing("cup", 0.5, 0.0, "orange")))
    assert named("put the orange in the orange cup", scene) == {
        "orange": ("orange_1",), "orange cup": ("cup_1",),
    }  # fmt: skip


def test_things_within_two_centimetres_are_a_tie():
    scene = Scene(objects=(thing("cup", -0.5, 0.3), thing("cup", -0.45, -0.3, number=2)))
    assert len(named("touch the leftmost cup", scene)["leftmost cup"]) == 2


def test_the_other_is_what_was_not_spoken_of():
    assert named("push the other mug left", TABLE, [("mug_1", 1.0)]) == {"mug": ("mug_2",)}


def test_one_copies_the_type_last_spoken_of():
    found = named("now the red one", TABLE, [("mug_2", 1.0)])
    assert found == {"red one": ("mug_1",)}


def test_your_left_is_the_persons_right():
    assert named("touch the mug on your left")["mug on your left"] == ("mug_2",)


def test_what_fell_to_the_floor_is_meant_only_if_nothing_else_can_be():
    standing, fallen = thing("apple", 0.0, 0.0), thing("lemon", 1.2, 0.0)
    fallen = msgspec.structs.replace(fallen, on="floor")
    scene = Scene(objects=(standing, fallen))
    assert named("touch the fruit", scene)["fruit"] == ("apple_1",)
    assert named("touch the lemon", scene)["lemon"] == ("lemon_1",)


@pytest.mark.parametrize(("wide", "bigger"), [(0.128, False), (0.14, True)])
def test_a_size_is_told_by_its_lengths_not_by_its_volume(wide, bigger):
    """A twentieth more each way is a sixth more volume, and still not to be seen."""
    scene = Scene(
        objects=(thing("cup", -0.5, 0.0), thing("cup", 0.5, 0.0, number=2, size=wide, tall=0.106))
    )
    both = {"cup_1", "cup_2"}
    assert set(named("lift the big cup", scene)["big cup"]) == ({"cup_2"} if bigger else both)


@pytest.mark.parametrize(("side", "many"), [(0.400, 2), (0.415, 2), (0.425, 1)])
def test_what_differs_by_a_twentieth_is_seen(side, many):
    cups = (thing("cup", -0.5, 0.0, size=0.4, tall=0.4),
            thing("cup", 0.5, 0.0, number=2, size=side, tall=side))  # fmt: skip
    for which, one in (("largest", "cup_2"), ("smallest", "cup_1"), ("shortest", "cup_1")):
        objects = named(f"touch the {which} cup", Scene(objects=cups))[f"{which} cup"]
        assert len(objects) == many and one in objects

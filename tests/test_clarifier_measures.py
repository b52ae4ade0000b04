"""Measures become slots: where they stand, what they are worth, and which words are none."""

import math

import pytest
from clarifier_table import TABLE, linked

from clarifier.measures import quantities
from scene.types import Scene

PI = math.pi


def found(text, scene=TABLE):
    return [(q.slot, q.text, round(q.value, 6)) for q in quantities(linked(text, scene), scene)]


@pytest.mark.parametrize(
    ("text", "said", "metres"),
    [
        ("push the sponge 5 cm left", "5 cm", 0.05),
        ("push the sponge 5cm left", "5cm", 0.05),
        ("push the sponge 7.5 cm left", "7.5 cm", 0.075),
        ("push the sponge 7.5cm left", "7.5cm", 0.075),
        ("push the sponge left by 12 centimetres", "12 centimetres", 0.12),
        ("push the sponge left by 12 centimeters.", "12 centimeters", 0.12),
        ("push the sponge ten centimetres left", "ten centimetres", 0.10),
        ("push the sponge two inches left", "two inches", 0.0508),
        ("push the sponge an inch left", "an inch", 0.0254),
        ("push the sponge half a metre left", "half a metre", 0.5),
        ("push the sponge half an inch left", "half an inch", 0.0127),
        ("push the sponge a foot left", "a foot", 0.3048),
        ("push the sponge 30 mm left", "30 mm", 0.03),
        ("push the sponge 0.1 m left", "0.1 m", 0.1),
        ("push the sponge twenty-five centimetres left", "twenty-five centimetres", 0.25),
        ("push the sponge a couple of centimetres left", "a couple of centimetres", 0.02),
        ("push the sponge one and a half cm left", "one and a half cm", 0.015),
        ("push the sponge a hundred millimetres left", "a hundred millimetres", 0.1),
        ("shift the sponge 3-cm to the right", "3-cm", 0.03),
        ("push the sponge 4in left", "4in", 0.1016),
    ],
)  # fmt: skip
def test_a_length_in_table_units(text, said, metres):
    assert found(text) == [("d1", said, round(metres / 0.2, 6))]


def test_a_length_on_a_larger_table():
    wide = Scene(objects=TABLE.objects, table_m=0.8)
    assert found("push the sponge 10 cm left", wide) == [("d1", "10 cm", 0.25)]


@pytest.mark.parametrize(
    ("text", "said", "radians"),
    [
        ("turn the sponge 90 degrees", "90 degrees", PI / 2),
        ("turn the sponge by 45°", "45°", PI / 4),
        ("turn the sponge thirty degrees clockwise", "thirty degrees", PI / 6),
        ("give the sponge a 90-degree turn", "90-degree", PI / 2),
        ("turn the sponge a quarter turn", "a quarter turn", PI / 2),
        ("give the sponge a quarter turn", "quarter", PI / 2),
        ("give the sponge a quarter-turn", "quarter", PI / 2),
        ("rotate the sponge by half a turn", "half a turn", PI),
        ("rotate the sponge a full turn", "a full turn", 2 * PI),
        ("rotate the sponge three quarters of a turn", "three quarters of a turn", 1.5 * PI),
        ("rotate the sponge 1.5 radians", "1.5 radians", 1.5),
        ("rotate the sponge by a right angle", "a right angle", PI / 2),
        ("rotate the sponge by 45", "45", PI / 4),
    ],
)  # fmt: skip
def test_an_angle_is_positive_whatever_its_direction(text, said, radians):
    assert found(text) == [("t1", said, round(radians, 6))]


@pytest.mark.parametrize(
    ("text", "said", "value"),
    [
        ("tap the sponge three times", "three", 3),
        ("tap the sponge 3 times", "3", 3),
        ("do that 12 times with the sponge", "12", 12),
        ("move the sponge to x = -0.3", "-0.3", -0.3),
    ],
)
def test_a_plain_number(text, said, value):
    assert found(text) == [("n1", said, value)]


def test_measures_are_numbered_by_kind_in_order():
    text = "push the sponge 5 cm left, tap it 3 times, turn it 90 degrees, push it 2 cm right"
    assert [slot for slot, _, _ in found(text)] == ["d1", "n1", "t1", "d2"]


@pytest.mark.parametrize(
    "text",
    [
        "push the second block left", "lift one of the mugs", "put the yellow one left",
        "push two mugs left", "put the 2 blocks on the plate", "put any two blocks on the plate",
        "push the sponge a bit to the left", "turn the sponge halfway round", "tap it twice",
        "push the sponge slightly left", "push the sponge half the way to the bottle",
        "take number 3", "1. push the sponge left", "step 2: lift the sponge", "swap the two",
        "put the sponge 2 the left of the bowl", "hold the sponge 4 me", "lift them one by one",
        "push a couple of blocks left", "turn the sponge round once",
    ],
)  # fmt: skip
def test_words_that_are_no_measures(text):
    assert found(text) == []


@pytest.mark.parametrize(
    "text",
    ["move the sponge half a metre", "shove it a yard to the left", "spin it 2 revolutions",
     "give the sponge a right angle turn"],
)  # fmt: skip
def test_a_measure_names_no_object(text):
    assert {m.text for m in linked(text).mentions} <= {"sponge", "it"}

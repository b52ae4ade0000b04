"""Clauses are read to their last word and answered from the scene, or not read at all."""

import pytest
from clarifier_table import LEXICON, TABLE, thing

from clarifier.facts import Facts
from scene.types import Scene

KITCHEN = Scene(
    objects=(
        thing("milk jug", -0.6, 0.5, "silver", size=0.3, tall=0.4),
        thing("vase", 0.0, 0.1, "blue", size=0.2, tall=0.8),
        thing("spoon", 0.6, -0.5, "silver", size=0.35, tall=0.05),
        thing("cookie", -0.6, 0.5, "brown", size=0.1, tall=0.05, z=0.4, on="milk_jug_1"),
        thing("car", 0.75, 0.75, "red", size=0.2),
        thing("car", 0.75, 0.45, "green", number=2, size=0.3),
        thing("tin", -0.8, -0.75),
    )
)


def holds(clause, scene=KITCHEN, it=()):
    """Whether the clause is so; "unread" where it cannot be read."""
    fact = Facts(scene, (), LEXICON, it).fact(clause)
    return "unread" if fact is None else fact.holds


@pytest.mark.parametrize(
    "clause",
    [
        "the vase is taller than the milk jug", "is jug lower than vase", "vase more tall than jug",
        "the milk jug isn't as tall as the vase", "the jug is less tall than the vase",
        "the green car is bigger than the red one", "the vase is the tallest",
        "the vase is the tallest thing on the table", "the spoon is nearer to me than the vase",
        "the jug's further from me than the spoon is", "the red car is farther away than the spoon",
        "the vase is closer to the milk jug than to the red car",
        "the vase is closer to the right edge than the jug",
        "the spoon's further right than the vase",
        "the jug is on the left half of the table", "the spoon is on the right",
        "the tin is in the near left corner", "the tin is in a corner", "spoon near the right edge",
        "the jug is to the left of the vase", "the spoon is in front of the green car",
        "the cookie is on the milk jug", "the milk jug has something on it",
        "there is something on the milk jug", "the vase is empty", "there's nothing in the vase",
        "the cookie's on the table", "the tin is within 5 cm of the left edge",
        "the spoon is more than 3 cm from the vase", "the vase is blue", "the jug is not red",
        "the spoon is grey or silver", "the jug is the same colour as the spoon",
        "there are two cars", "there are at least two cars", "there are fewer than three cars",
        "there is only one spoon", "we have a spoon", "any car here",
        "there are no lemons", "there isn't a lemon", "both cars are on the right",
        "neither car is blue", "one of the cars is red",
        "the red car and the green car are at the far edge", "the red car is next to the green car",
        "the spoon or the tin is silver", "the vase is blue and taller than the jug",
        "the cars are not the same colour", "the vase stands upright", "the tin is a tin",
    ],
)  # fmt: skip
def test_what_is_so(clause):
    assert holds(clause) is True


@pytest.mark.parametrize(
    "clause",
    [
        "the milk jug is taller than the vase", "the spoon is behind the vase",
        "the spoon is on the left", "the vase is in a corner", "the jug is empty",
        "there are more than two cars", "there is a lemon", "all the cars are red",
        "the vase is nearer to me than the spoon", "the cookie is on the vase",
        "the red car is wider than the green one", "the spoon is within 2 cm of the vase",
        "the jug is between the vase and the tin", "the vase has been knocked over",
        "the red car is in the middle", "the vase is the smallest", "none of the cars is red",
        "the red car is as wide as the green car", "the tin is a spoon",
    ],
)  # fmt: skip
def test_what_is_not_so(clause):
    assert holds(clause) is False


@pytest.mark.parametrize(
    "clause",
    [
        "the vase is heavier than the jug", "the vase is full", "the vase is tall",
        "it is raining", "the car is red", "the vase is under the jug", "there is room here",
        "the lemon is yellow", "the vase is taller than the jug or the tin",
        "the vase is taller than the jug by a lot", "put the vase on the tin", "the vase",
        "the vase is very much to the left of where it was", "it is red",
    ],
)  # fmt: skip
def test_what_is_not_read(clause):
    assert holds(clause) == "unread"


@pytest.mark.parametrize("clause", ["the tin is red", "the tin is the same colour as the vase",
                                    "the vase is on the right half"])  # fmt: skip
def test_what_the_scene_does_not_tell(clause):
    assert holds(clause) is None


def test_a_comparison_that_two_readings_decide_differently_is_not_told():
    """Closer to the cup than the jug is, or than to the jug?"""
    scene = Scene(objects=(thing("pen", 0.0, 0.0), thing("cup", 0.4, 0.0), thing("jug", -0.6, 0.0)))
    assert holds("the pen is closer to the cup than the jug", scene) is True
    scene = Scene(objects=(thing("pen", 0.0, 0.0), thing("cup", 0.4, 0.0), thing("jug", 0.25, 0.5)))
    assert holds("the pen is closer to the cup than the jug is", scene) is True
    assert holds("the pen is closer to the cup than to the jug", scene) is True
    scene = Scene(objects=(thing("pen", 0.0, 0.0), thing("cup", 0.4, 0.0), thing("jug", 0.4, 0.35)))
    assert holds("the pen is closer to the cup than the jug is", scene) is False
    assert holds("the pen is closer to the cup than to the jug", scene) is True
    assert holds("the pen is closer to the cup than the jug", scene) is None


def test_pronouns_mean_what_was_spoken_of():
    assert holds("it is blue", it=("vase_1",)) is True
    facts = Facts(KITCHEN, (), LEXICON, ("vase_1",), ("milk_jug_1",))
    fact = facts.fact("it is left of it")
    assert fact is not None and fact.holds is False and fact.others == ("milk_jug_1",)


def test_the_statement_is_true_and_speaks_to_the_person():
    fact = Facts(TABLE, (), LEXICON).fact("my bottle is nearer to me than the plate")
    assert fact is not None and fact.said == "Your bottle is nearer to you than the plate."
    fact = Facts(KITCHEN, (), LEXICON).fact("the vase is left of the jug")
    assert fact is not None and fact.said == "The vase is not left of the jug."
    fact = Facts(KITCHEN, (), LEXICON).fact("there are more than three cars")
    assert fact is not None and fact.said == "There are two cars."

"""An end that is just the one that the sentence describes is a second opinion."""

import math

import pytest
from clarifier_table import LEXICON, talk, thing, writes

from clarifier.binding import bindings
from clarifier.borne_out import borne_out
from clarifier.mentions import link
from scene.types import Scene

TABLE = Scene(
    objects=(
        thing("vial", -0.6, 0.4),
        thing("beaker", 0.4, 0.4, size=0.2, tall=0.2),
        thing("petri dish", 0.2, -0.4, size=0.3, tall=0.05),
        thing("dropper", -0.6, -0.5, size=0.1),
    )
)
"""The beaker's own left is at 0.3; one unit is 20 cm."""


def ends(**places):
    """The table with things where ``places`` say: (x, y), or the thing that they stand on."""
    items = []
    for item in TABLE.objects:
        place = places.get(item.name.replace(" ", "_"))
        if isinstance(place, str):
            below = TABLE.get(place)
            on = thing(item.name, below.x, below.y, size=item.width, on=place, z=below.tall)
            items.append(on)
        else:
            x, y = place or item.position
            items.append(thing(item.name, x, y, size=item.width, tall=item.tall))
    return Scene(objects=tuple(items))


def bears_out(text, after):
    linked = link(text, TABLE, (), LEXICON)
    return borne_out(linked, bindings(linked, TABLE, {})[0], TABLE, after, LEXICON)


LEFT_OF_BEAKER = {"vial": (0.1, 0.4)}


@pytest.mark.parametrize(
    "text",
    [
        "vial put on right side of dropper please",
        "what i would like is the vial right of the dropper",
        "the vial should be to the right of the dropper",
    ],
)
def test_every_claim_is_looked_for_in_the_end(text):
    assert bears_out(text, ends(vial=(-0.3, -0.5)))
    assert not bears_out(text, ends(vial=(-0.8, -0.5)))


def test_claims_about_several_things_must_all_hold():
    text = "the vial right of the beaker the dropper on the petri dish"
    assert bears_out(text, ends(vial=(0.8, 0.4), dropper="petri_dish_1"))
    assert not bears_out(text, ends(vial=(0.8, 0.4)))
    assert not bears_out(text, ends(dropper="petri_dish_1"))


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("vial in the far left corner", (-0.9, 0.9)),
        ("vial at the near edge", (0.0, -0.9)),
        ("vial in the middle of the table", (0.0, 0.0)),
        ("vial between the beaker and the petri dish", (0.3, 0.0)),
        ("vial in front of the beaker", (0.4, 0.1)),
    ],
)
def test_parts_of_the_table_and_landmarks_are_known(text, place):
    assert bears_out(text, ends(vial=place))
    assert not bears_out(text, ends(vial=(-0.5, -0.1)))


def test_what_comes_with_a_thing_has_its_place_too():
    text = "could the vial live in the middle, with the dropper in front of it"
    assert bears_out(text, ends(vial=(0.0, 0.0), dropper=(0.0, -0.25)))
    assert not bears_out(text, ends(vial=(0.0, 0.0), dropper=(0.0, 0.25)))
    side = "the beaker in the middle and the dropper to its left"
    assert bears_out(side, ends(beaker=(0.0, 0.0), dropper=(-0.3, 0.0)))
    assert not bears_out(side, ends(beaker=(0.0, 0.0), dropper=(0.3, 0.0)))


def test_what_was_not_spoken_of_must_stay():
    assert not bears_out("vial left of the beaker", ends(**LEFT_OF_BEAKER, dropper=(0.0, -0.8)))


@pytest.mark.parametrize(
    "text",
    [
        "if the dropper is there, vial left of the beaker",
        "vial left of the beaker, not on it",
        "push the vial to the left of the beaker",
        "vial 5 cm left of the beaker",
        "vial left of the beaker, upside down",
        "vial left of the beaker, then the dropper",
        "vial left of the beaker or the petri dish",
    ],
)
def test_what_says_more_than_places_is_not_borne_out_by_them(text):
    assert not bears_out(text, ends(**LEFT_OF_BEAKER))


@pytest.fixture
def decision(clarifier_over):
    """What is decided where the translator offers two programs, so likely: the second is right."""

    def decision(text, first, second):
        bodies = ("put(m1, [m2.x, m2.y - 0.5])", first), ("put(m1, left_of(m1, m2))", second)
        clarifier = clarifier_over(writes(*bodies, sure=math.exp(first)))
        return talk(clarifier, text, scene=TABLE)[0]

    return decision


def test_an_unsure_candidate_is_acted_on_where_its_end_bears_the_sentence_out(decision):
    taken = decision("put the vial left of the beaker", -0.8, -0.9)
    assert (taken.do, taken.program) == ("act", "put(vial, left_of(vial, beaker))")


def test_one_that_is_hardly_likely_is_not(decision):
    assert decision("put the vial left of the beaker", -0.7, -2.5).do != "act"


@pytest.mark.parametrize(
    ("text", "place", "out"),
    [
        ("move the vial towards the beaker", (-0.2, 0.4), True),
        ("push the vial toward the beaker", (-0.2, 0.4), True),
        ("move the vial towards the beaker", (-0.8, 0.4), False),
        ("move the vial towards the beaker", (0.1, -0.6), False),  # askew
        ("push the vial right of the beaker", (0.7, 0.4), False),  # a push is a way as well
    ],
)
def test_a_way_towards_a_thing_is_looked_for_in_the_end(text, place, out):
    assert bears_out(text, ends(vial=place)) is out

"""Where something stood before it was moved is said in numbers."""

import pytest
from clarifier_table import thing

from agent.messages import Done, Focus
from clarifier.lexicon import load_lexicon
from clarifier.mentions import link
from clarifier.old_places import at_old_place
from scene.types import Scene

TABLE = Scene(
    objects=(
        thing("kettle", 0.5, 0.5, size=0.2),
        thing("iron", -0.5, 0.0, size=0.4),
        thing("candle", 0.0, -0.5, size=0.2),
        thing("candle", 0.3, -0.5, number=2, size=0.2),
    )
)
MOVED = Done("push the kettle away", (thing("kettle", -0.1, 0.2, size=0.2),))
FOCUS = (Focus("kettle_1", 1.0),)


def said(text, *done):
    return at_old_place(link(text, TABLE, FOCUS, load_lexicon()), TABLE, done)


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("put the iron where the kettle was", "put the iron {}"),
        ("put the iron where the kettle used to be before", "put the iron {}"),
        ("put the iron where it was, please", "put the iron {}, please"),
    ],
)
def test_the_place_of_an_earlier_turn_is_meant(text, place):
    there = "14.00 cm from the left edge and 20.00 cm from the front edge"
    assert said(text, MOVED) == place.format(there)


def test_the_place_at_the_start_is_meant_where_the_sentence_moves_it_first():
    text = "push the kettle to the left edge and put the iron where the kettle was"
    there = "26.00 cm from the left edge and 26.00 cm from the front edge"
    assert said(text, MOVED) == f"push the kettle to the left edge and put the iron {there}"


@pytest.mark.parametrize(
    "text",
    [
        "put the iron where the kettle is",
        "put a candle where the kettle was",
        "put the kettle where it was",
        "put the iron where the mug was",
        "tell me where the kettle was",
    ],
)
def test_other_places_stay_as_they_are_said(text):
    assert said(text, MOVED) is None


def test_a_place_that_nobody_left_is_not_known():
    assert said("put the iron where the kettle was") is None

"""A thing that is larger than what it is to go into: refused with both sizes."""

import pytest
from clarifier_table import thing

from clarifier.binding import bindings
from clarifier.lexicon import load_lexicon
from clarifier.mentions import link
from clarifier.roomy import too_large
from scene.types import Scene

TABLE = Scene(
    objects=(
        thing("pumpkin", -0.6, 0.4, size=0.7, tall=0.6),
        thing("mug", 0.5, 0.4, size=0.3, tall=0.35),
        thing("tray", 0.5, -0.4, size=0.4, tall=0.04),
        thing("tinderbox", -0.6, -0.4, size=0.2, tall=0.1),
        thing("ruler", 0.0, -0.7, size=0.1, tall=0.02),
        thing("cherry", 0.0, 0.0, "red", size=0.1),
        thing("cherry", 0.15, 0.0, "dark", number=2, size=0.1),
    )
)


def refused(text, body="put_on(m1, m2)"):
    linked = link(text, TABLE, (), load_lexicon())
    return too_large(body, linked, bindings(linked, TABLE, {})[0], TABLE)


@pytest.mark.parametrize(
    "text",
    [
        "put the pumpkin in the mug",
        "could the pumpkin go into the mug",
        "place the pumpkin inside the mug please",
        "put the pumpkin inside the tinderbox",
    ],
)
def test_what_is_larger_than_the_opening_does_not_go_in(text):
    problem = refused(text)
    assert problem is not None and problem.reason == "impossible"
    assert "14 x 14 cm" in problem.text and "beside it" in problem.text


@pytest.mark.parametrize(
    "text",
    [
        "put the pumpkin on the mug",
        "put the pumpkin on top of the tinderbox",
        "put the pumpkin in the tray",
        "put the ruler in the mug",
        "put the red cherry into the mug",
        "put the mug beside the pumpkin",
    ],
)
def test_on_top_of_it_or_into_what_is_large_enough_it_goes(text):
    assert refused(text) is None


def test_one_of_a_group_that_does_not_fit_is_named():
    small = thing("egg cup", 0.7, 0.7, size=0.09)
    scene = Scene(objects=(*TABLE.objects, small))
    linked = link("put the cherries in the egg cup", scene, (), load_lexicon())
    problem = too_large("put_all_on(m1, m2)", linked, bindings(linked, scene, {})[0], scene)
    assert problem is not None and problem.object == "cherry_1"


def test_programs_that_put_nothing_in_are_not_refused():
    assert refused("put the pumpkin in the mug", "put(m1, next_to(m1, m2))") is None

"""A group of which some go to one place and the rest elsewhere: what is left of it is named."""

import pytest
from clarifier_table import LEXICON

from clarifier.mentions import link
from clarifier.parted import parted
from scene.types import Scene, SceneObject

RED, BLUE = "red", "blue"


def thing(name, number, x, y, color=None):
    return SceneObject(
        id=f"{name}_{number}", name=name, x=x, y=y, width=0.15, height=0.15, tall=0.15, color=color
    )


SCENE = Scene(
    objects=(
        thing("peg", 1, -0.6, 0.2, RED), thing("peg", 2, -0.2, 0.2, BLUE),
        thing("peg", 3, 0.2, 0.2, RED), thing("peg", 4, 0.6, 0.2, BLUE),
        thing("mat", 1, -0.5, -0.6), thing("crate", 1, 0.5, -0.6),
    )
)  # fmt: skip
BLOCKS = Scene(
    objects=(
        thing("red star", 1, -0.6, 0.2, RED), thing("red moon", 1, -0.2, 0.2, RED),
        thing("blue cube", 1, 0.2, 0.2, BLUE), thing("blue moon", 1, 0.6, 0.2, BLUE),
    )
)  # fmt: skip


def put(text, scene=SCENE):
    return parted(text, scene, (), LEXICON)


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("two pegs on the mat, the other two in the crate",
         "two pegs on the mat, the others in the crate"),
        ("one peg on the mat, the remaining three pegs in the crate",
         "one peg on the mat, the others in the crate"),
        ("three pegs on the mat and the last one in the crate",
         "three pegs on the mat and the others in the crate"),
        ("three pegs on the mat, the fourth in the crate",
         "three pegs on the mat, the others in the crate"),
        ("two of the pegs go on the mat; whatever is left goes in the crate",
         "two of the pegs go on the mat; the others goes in the crate"),
        ("two pegs on the mat and two in the crate",
         "two pegs on the mat and the others in the crate"),
        ("one peg on the mat and one in the crate",
         "one peg on the mat and one of the pegs in the crate"),
        ("one red peg on the mat, the other red peg in the crate",
         "one red peg on the mat, the others in the crate"),
        ("half of the pegs on the mat and the other half in the crate",
         "two of the pegs on the mat and the others in the crate"),
        ("split the pegs: one on the mat, three in the crate",
         "put one of the pegs on the mat, the others in the crate"),
        ("pegs: three on the mat, the last one in the crate",
         "put three of the pegs on the mat, the others in the crate"),
        ("put the red pegs on the mat and the other two in the crate",
         "put the red pegs on the mat and the others in the crate"),
    ],
)  # fmt: skip
def test_what_is_left_of_a_group_is_named(text, named):
    assert put(text) == named


@pytest.mark.parametrize(
    "text",
    [
        "two pegs on the mat, the other three in the crate",  # two are left
        "two pegs on the mat, the other mats in the crate",
        "one peg on the mat and one on each side of the crate",
        "one peg on top of the other",
        "some of the pegs on the mat and the other two in the crate",  # how many is asked first
        "put the mat on the crate and the other one at the left edge",
        "half of the pegs on the mat",
        "the pegs: one left of the mat, one right",
    ],
)
def test_what_does_not_come_out_is_left_as_it_is(text):
    assert put(text) == text


def rest_of(text, scene=SCENE):
    """What the last mention that is no landmark stands for."""
    themes = [one for one in link(put(text, scene), scene, (), LEXICON).spoken if one.theme]
    return set(themes[-1].mention.objects)


PEGS = {"peg_1", "peg_2", "peg_3", "peg_4"}


@pytest.mark.parametrize(
    ("text", "things"),
    [
        ("put two pegs on the mat and the rest in the crate", PEGS),
        ("put a peg on the mat and the others in the crate", PEGS),
        ("put one of the red pegs on the mat and the others in the crate", {"peg_1", "peg_3"}),
        ("put some pegs on the mat and the rest in the crate", PEGS),
    ],
)
def test_the_rest_of_a_group_holds_no_other_things(text, things):
    assert rest_of(text) == things


@pytest.mark.parametrize(
    "text", ["put the red ones on the left and all others on the right",
             "the red blocks to the left and the other blocks to the right"],
)  # fmt: skip
def test_the_others_of_a_group_of_several_kinds_are_of_every_kind(text):
    assert rest_of(text, BLOCKS) == {"blue cube_1", "blue moon_1"}

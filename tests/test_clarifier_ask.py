"""Labels: the shortest description that means one option alone, understood when said back."""

import pytest
from clarifier_table import LEXICON, TABLE, named, thing, waiting

from agent.messages import Option
from clarifier.ask import inventory, labels, numbered, which_text
from scene.types import Scene

CORNERS = (thing("cup", -0.6, 0.0), thing("cup", 0.6, 0.0, number=2))


@pytest.mark.parametrize(
    ("objects", "expected"),
    [
        (TABLE.objects[:2], ["the red apple", "the green apple"]),
        (CORNERS, ["the left cup", "the right cup"]),
        ((thing("cup", 0.0, -0.6), thing("cup", 0.0, 0.6, number=2)),
         ["the near cup", "the far cup"]),
        ((thing("cup", -0.6, 0.0), thing("cup", 0.6, 0.0, number=2, size=0.3)),
         ["the small cup", "the big cup"]),
        ((thing("bowl", 0, 0), thing("plate", 0.5, 0.5)), ["the bowl", "the plate"]),
        ((*CORNERS, thing("cup", 0.1, 0.0, number=3)),
         ["the left cup", "the right cup", "the middle cup"]),
    ],
)  # fmt: skip
def test_the_shortest_label_that_tells_apart(objects, expected):
    scene = Scene(objects=tuple(objects))
    found = labels([item.id for item in scene], scene, LEXICON)
    assert list(found.values()) == expected


def test_a_landmark_comes_before_a_side():
    scene = Scene(objects=(*CORNERS, thing("bowl", -0.6, 0.2), thing("plate", 0.6, 0.2)))
    assert list(labels(["cup_1", "cup_2"], scene, LEXICON).values()) == [
        "the cup by the bowl", "the cup by the plate",
    ]  # fmt: skip


def test_every_label_denotes_its_object_alone():
    found = labels([item.id for item in TABLE], TABLE, LEXICON)
    for object_id, label in found.items():
        assert list(named(f"touch {label}").values()) == [(object_id,)]


def test_things_that_nothing_tells_apart_are_named_by_id():
    scene = Scene(tray=(waiting("cup"), waiting("cup", 2)))
    assert labels(["cup_2"], scene, LEXICON) == {"cup_2": "the cup (cup_2)"}


def test_wording():
    assert which_text("cup", ["the left cup", "the right cup"]) == (
        "Which cup do you mean: the left cup or the right cup?"
    )
    assert numbered("Which?", (Option("a"), Option("b"))) == "Which? Please choose: 1 a, 2 b."
    assert inventory(Scene(objects=(*CORNERS, thing("apple", 0, 0.5))), LEXICON) == (
        "two cups and an apple"
    )

"""What happened, in words, from the scenes before and after."""

import msgspec
import pytest

from agent.messages import Command
from agent.report import describe, differences, place, title
from scene.types import Scene, SceneObject

MOVE = (Command("move", 0, 0, 0.9, 0, False),)


def thing(name: str, x: float, y: float, **fields: object) -> SceneObject:
    return SceneObject(
        id=f"{name}_{fields.get('color') or 1}", name=name, x=x, y=y, width=0.1, height=0.1,
        tall=0.1, **fields,
    )  # fmt: skip


def changed(scene: Scene, **fields: object) -> Scene:
    """The scene with its first object changed."""
    return scene.replace(msgspec.structs.replace(scene.objects[0], **fields))


TABLE = Scene(objects=(thing("apple", 0.4, 0.4), thing("cup", -0.5, -0.5)))


@pytest.mark.parametrize(
    ("fields", "sentence"),
    [
        ({"x": -0.7, "y": -0.5}, "The apple is left of the cup now."),
        ({"x": -0.5, "y": -0.3}, "The apple is behind the cup now."),
        ({"x": 0.0, "y": 0.0}, "The apple is in the middle of the table now."),
        ({"x": 0.9, "y": 0.9}, "The apple is in the far right corner now."),
        ({"x": 0.93, "y": 0.0}, "The apple is at the right edge now."),
        ({"x": -1.2, "y": 0.0, "on": "floor"}, "The apple went off the left edge."),
        ({"z": 0.5, "held": True, "on": "gripper"}, "I hold the apple."),
        ({"x": -0.5, "y": -0.5, "z": 0.1, "on": "cup_1"}, "The apple is in the cup."),
        ({"r": 1.5708}, "The apple is turned by 90° anticlockwise now."),
        ({"r": -0.7854}, "The apple is turned by 45° clockwise now."),
        ({"upright": False}, "The apple is on the far right side of the table now, lying on its side."),  # noqa: E501
    ],
)  # fmt: skip
def test_each_change_is_one_sentence(fields, sentence):
    assert describe(TABLE, changed(TABLE, **fields), MOVE, ("cup_1",)) == sentence


def test_a_thing_that_nobody_named_is_no_landmark_where_an_edge_is():
    at_edge = changed(TABLE, x=-0.7, y=-0.5)
    assert describe(TABLE, at_edge, MOVE) == "The apple is at the left edge now."


def test_a_motion_that_changes_nothing_is_said_to():
    assert "nothing on the table changed" in describe(TABLE, TABLE, MOVE)


def test_things_of_one_name_are_told_apart_by_colour():
    red, blue = thing("cup", 0, 0, color="red"), thing("cup", 0.5, 0, color="blue")
    assert title(red, Scene(objects=(red, blue))) == "the red cup"


def test_a_place_without_a_neighbour_is_a_part_of_the_table():
    assert place(TABLE.objects[0], TABLE) == "on the far right side of the table"


def test_what_is_as_predicted_is_no_difference():
    slid = changed(TABLE, x=0.415)
    assert differences(TABLE, slid) == ""


def test_what_lies_in_a_container_may_lie_there_as_it_came_to_lie():
    cup = TABLE.objects[1]
    inside = changed(TABLE, x=-0.5, y=-0.5, z=0.02, on="cup_1")
    coin = thing("coin", -0.5, -0.5, z=0.12, on="apple_1")
    want = msgspec.structs.replace(inside, objects=(*inside.objects, coin))
    got = want.replace(msgspec.structs.replace(coin, x=-0.55, z=0.02, on="cup_1", upright=False))
    assert differences(want, got) == ""
    out = want.replace(msgspec.structs.replace(coin, x=-0.8, z=0.0, on="table"))
    assert "I meant it to be on the apple" in differences(want, out)
    assert cup in got.objects


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"x": -0.4}, "The apple is"),
        ({"on": "floor", "x": 1.3}, "went off the right edge"),
        ({"held": True}, "I still hold the apple"),
        ({"on": "floor", "x": -1.3}, "went off the left edge; I meant it to be on the far right"),
        ({"upright": False}, "lying on its side; I meant it to be on the far right side"),
        ({"x": 0.5, "y": 0.5}, "but 2.8 cm from where I meant it to be."),
        ({"on": "tray", "x": None, "y": None}, "is in the tray; I meant it"),
    ],
)
def test_what_differs_is_said(fields, words):
    assert words in differences(TABLE, changed(TABLE, **fields))


def test_an_object_that_is_gone_is_said():
    assert (
        differences(TABLE, Scene(objects=TABLE.objects[1:])) == "I cannot see the apple any more."
    )

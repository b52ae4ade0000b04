"""Scenes from JSON: what is accepted, what is refused by name, how programs call objects."""

import math

import pytest

from agent.errors import SceneError
from scene.types import Scene, SceneObject, identifiers, read_scene, slug


def row(**fields: object) -> dict[str, object]:
    return {
        "id": "apple_1", "name": "apple", "x": 0.1, "y": 0.2,
        "width": 0.1, "height": 0.1, "tall": 0.1, **fields,
    }  # fmt: skip


def test_a_scene_is_read_with_its_tray():
    waiting = {key: value for key, value in row(id="cup_1", name="cup").items() if key not in "xy"}
    scene = read_scene({"objects": [row(color="red")], "tray": [waiting]})
    assert scene.objects[0].position == (0.1, 0.2)
    assert (scene.tray[0].on, scene.tray[0].x) == ("tray", None)


@pytest.mark.parametrize(
    ("data", "words"),
    [
        ([], "Expected `object`"),
        ({"objects": [row(width="wide")]}, "objects[0].width"),
        ({"objects": [row(width=-1)]}, "'apple_1': width must be in (0, 4]"),
        ({"objects": [row(x=None)]}, "'apple_1': x and y are needed"),
        ({"objects": [row(x=math.inf)]}, "'apple_1': x must be a finite number"),
        ({"objects": [row(), row()]}, "'apple_1': the id is used twice"),
        ({"objects": [row(name=" ")]}, "must not be empty"),
        ({"objects": [row(colour="red")]}, "unknown field `colour`"),
        ({"table_m": 0}, "table_m must be a positive number"),
    ],
)
def test_a_scene_that_cannot_be_is_refused_by_name(data, words):
    with pytest.raises(SceneError) as raised:
        read_scene(data)
    assert words in str(raised.value)


def things(*names: tuple[str, str]) -> Scene:
    return Scene(
        objects=tuple(
            SceneObject(id=key, name=name, x=0, y=0, width=0.1, height=0.1, tall=0.1)
            for key, name in names
        )
    )


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("Coca Cola", "coca_cola"), ("7up can", "item_7up_can"), ("robot", "robot_object"),
        ("été", "t"), ("???", "item"), ("class", "class_object"),
    ],
)  # fmt: skip
def test_any_name_becomes_an_identifier(text, name):
    assert slug(text) == name
    assert slug(text).isidentifier()


def test_a_name_borne_once_is_the_identifier_and_shared_names_go_by_id():
    scene = things(("c1", "red cube"), ("apple_1", "apple"), ("apple_2", "apple"))
    assert list(identifiers(scene)) == ["red_cube", "apple_1", "apple_2"]


def test_identifiers_never_collide():
    scene = things(("a", "cup"), ("cup", "mug"), ("a b", "x"), ("a-b", "x"), ("x", "a b"))
    names = identifiers(scene)
    assert len(names) == len(scene.objects)
    assert {item.id for item in names.values()} == {item.id for item in scene.objects}

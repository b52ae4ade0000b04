"""Random scenes: seeded, plausible, well apart; and what a name tells about a thing."""

import random

import pytest

from agent.errors import SceneError
from scene.generate import CLASSES, random_scene, size_of
from scene.kinds import color_in, head_noun, is_container
from scene.relations import gap
from scene.types import read_scene

KITCHEN = ["apple", "orange", "bottle", "bowl", "banana", "cup"]


def test_one_seed_makes_one_scene():
    scenes = [random_scene(random.Random(3), KITCHEN, ["lemon"]) for _ in range(2)]
    assert scenes[0] == scenes[1]
    assert scenes[0] != random_scene(random.Random(4), KITCHEN, ["lemon"])


@pytest.mark.parametrize("seed", range(30))
def test_things_lie_apart_on_the_table(seed):
    rng = random.Random(seed)
    names = rng.choices(list(CLASSES), k=rng.randint(1, 8))
    scene = random_scene(rng, names)
    assert [item.name for item in scene.objects] == names
    for item in scene.objects:
        assert max(abs(item.x), abs(item.y)) <= 0.7
        assert abs(item.x) + item.width / 2 <= 1 and abs(item.y) + item.height / 2 <= 1
        assert all(gap(item, other) >= 0.2 - 1e-9 for other in scene.objects if other != item)


def test_names_may_repeat_and_ids_count():
    scene = random_scene(random.Random(1), ["apple", "red cube", "apple"], ["apple"])
    assert [item.id for item in scene] == ["apple_1", "red_cube_1", "apple_2", "apple_3"]


def test_tray_objects_have_sizes_and_no_place():
    item = random_scene(random.Random(1), [], ["orange"]).tray[0]
    assert (item.x, item.y, item.on) == (None, None, "tray")
    assert item.width == pytest.approx(0.35, rel=0.11)


def test_a_generated_scene_is_a_valid_one():
    scene = random_scene(random.Random(1), KITCHEN, ["lemon"])
    data = {
        "objects": [
            {"id": o.id, "name": o.name, "x": o.x, "y": o.y}
            | {"width": o.width, "height": o.height, "tall": o.tall}
            for o in scene.objects
        ]
    }
    assert len(read_scene(data).objects) == len(KITCHEN)


def test_an_unknown_name_gets_a_plausible_size_from_the_seed():
    sizes = [size_of(random.Random(seed), "flux capacitor") for seed in (1, 1, 2)]
    assert sizes[0] == sizes[1] != sizes[2]
    assert all(0.05 <= side <= 0.8 for side in (sizes[0].width, sizes[0].height, sizes[0].tall))


def test_small_and_big_things_differ():
    small, plain, big = (size_of(random.Random(1), f"{a} ball") for a in ("small", "red", "big"))
    assert small.width < plain.width < big.width


def test_a_crowd_is_made_of_smaller_things():
    scene = random_scene(random.Random(1), ["plate"] * 9)
    assert scene.objects[0].width < CLASSES["plate"].width * 0.8


def test_an_impossible_crowd_is_refused():
    with pytest.raises(SceneError, match="no room"):
        random_scene(random.Random(1), ["plate"] * 200)


@pytest.mark.parametrize(
    ("name", "color"),
    [("red cube", "red"), ("Small grey box", "gray"), ("orange", "orange"), ("coca cola", None)],
)
def test_a_colour_in_the_name_is_the_colour(name, color):
    assert random_scene(random.Random(1), [name]).objects[0].color == color


@pytest.mark.parametrize(
    ("name", "noun"),
    [
        ("apple", "apple"),
        ("small brown bowl", "bowl"),
        ("cup of tea", "cup"),
        ("Coca Cola", "cola"),
        ("bowl with fruit", "bowl"),
        ("", ""),
    ],
)
def test_the_head_noun_says_what_a_thing_is(name, noun):
    assert head_noun(name) == noun


@pytest.mark.parametrize("name", ["bowl", "red box", "trash can", "small mug", "cup of coffee"])
def test_open_containers(name):
    assert is_container(name)


@pytest.mark.parametrize(
    "name", ["apple", "can", "matchbox", "plate", "bottle", "book", "cola can"]
)
def test_not_containers(name):
    assert not is_container(name)


@pytest.mark.parametrize(
    ("name", "color"), [("red star", "red"), ("orange", None), ("orange ball", "orange")]
)
def test_a_head_noun_is_no_colour(name, color):
    assert color_in(name) == color

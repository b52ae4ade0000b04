"""How things may be spoken of: a phrase is offered only where it denotes the thing alone."""

import random

from clarifier_table import LEXICON, thing

from clarifier.mentions import link_answer
from evals.naming import descriptions, pick
from scene.generate import random_scene
from scene.types import Scene

TABLE = Scene(
    objects=(
        thing("apple", -0.6, 0.1, "red"),
        thing("apple", 0.5, 0.1, "green", number=2),
        thing("plate", 0.75, 0.1, size=0.2),
        thing("cup", -0.1, -0.7, "red"),
        thing("cup", -0.05, 0.6, "red", number=2),
    )
)


def said(object_id: str) -> dict[str, str]:
    return {one.text: one.way for one in descriptions(TABLE, TABLE.get(object_id))}


def test_a_name_alone_is_enough_where_nothing_shares_it():
    assert said("plate_1") == {"plate": "type"}


def test_one_of_two_is_told_by_colour_side_or_landmark():
    assert said("apple_2") == {
        "green apple": "color", "right apple": "side", "rightmost apple": "side",
        "apple on the right": "side", "apple closest to the plate": "landmark",
        "apple next to the plate": "landmark",
    }  # fmt: skip


def test_what_does_not_tell_is_not_said():
    assert said("cup_1") == {"near cup": "side", "nearest cup": "side"}
    assert pick(TABLE, TABLE.get("cup_1"), random.Random(1), ("color",)) is None


def test_the_clarifier_takes_nearly_every_phrase_for_the_thing_it_was_made_for():
    right = total = 0
    for seed in range(30):
        chance = random.Random(seed)
        names = ["apple", "apple", "cup", "cup", "cup", "plate", "bottle"]
        scene = random_scene(chance, names, room=0.1)
        for item in scene:
            for one in descriptions(scene, item):
                spoken = link_answer(f"the {one.text}", scene, LEXICON).spoken
                total += 1
                right += len(spoken) == 1 and spoken[0].mention.objects == (item.id,)
    assert total > 300
    assert right / total > 0.97

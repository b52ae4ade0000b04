"""Several things at once: which they are, what is left out, and what "them" and "the rest" are."""

import pytest
from clarifier_table import LEXICON, TABLE, linked, named, thing, waiting

from clarifier.mentions import link
from scene.types import Scene

BLOCKS = {"red_block_1", "green_block_1", "yellow_block_1"}
EVERYTHING = {item.id for item in TABLE}
ROW = Scene(
    objects=(
        *(thing("block", x, -0.3, number=n, size=size)
          for n, (x, size) in enumerate([(-0.8, 0.2), (-0.4, 0.1), (0.1, 0.16), (0.7, 0.12)], 1)),
        thing("cup", -0.38, -0.05), thing("plate", 0.3, 0.5, size=0.4, tall=0.02),
        thing("lemon", 0.22, 0.5, z=0.02, on="plate_1"),
        thing("lime", 0.4, 0.5, z=0.02, on="plate_1"),
    )
)  # fmt: skip
"""Four blocks from left to right (1 the largest, 2 the smallest), a cup, two fruits on a plate."""


def first(text, scene=TABLE, focus=()):
    return set(linked(text, scene, focus).mentions[0].objects)


@pytest.mark.parametrize(
    ("text", "objects"),
    [
        ("touch all the blocks", BLOCKS), ("touch all of the blocks", BLOCKS),
        ("touch every block", BLOCKS), ("touch each block", BLOCKS), ("touch blocks", BLOCKS),
        ("touch each of the blocks", BLOCKS), ("touch every single block", BLOCKS),
        ("touch every one of the blocks", BLOCKS), ("touch both apples", {"apple_1", "apple_2"}),
        ("touch everything", EVERYTHING), ("touch all the things", EVERYTHING),
        ("touch all of them", EVERYTHING), ("push all to the left", EVERYTHING),
        ("touch every single thing", EVERYTHING), ("pick them all up", EVERYTHING),
        ("put everything in the bowl", EVERYTHING - {"bowl_1"}),
        ("put everything next to the plate", EVERYTHING - {"plate_1"}),
        ("stack all the blocks on the red block", BLOCKS - {"red_block_1"}),
        ("push the bottle left and everything else right", EVERYTHING - {"bottle_1"}),
        ("push the bottle left and the rest right", EVERYTHING - {"bottle_1"}),
    ],
)  # fmt: skip
def test_what_a_group_is(text, objects):
    group = next(m for m in linked(text).mentions if m.plural)
    assert set(group.objects) == objects


@pytest.mark.parametrize(
    ("text", "objects"),
    [
        ("touch all blocks except the red one", BLOCKS - {"red_block_1"}),
        ("touch all the blocks but the red one", BLOCKS - {"red_block_1"}),
        ("touch every block other than the red one", BLOCKS - {"red_block_1"}),
        ("touch all blocks apart from the red and the green one", {"yellow_block_1"}),
        ("touch all blocks except the red one and the green one", {"yellow_block_1"}),
        ("touch everything but the bowl and the plate", EVERYTHING - {"bowl_1", "plate_1"}),
        ("touch everything except for the blocks", EVERYTHING - BLOCKS),
    ],
)
def test_an_exception_is_part_of_the_mention(text, objects):
    (mention,) = linked(text).mentions
    assert set(mention.objects) == objects and mention.plural
    assert text.endswith(mention.text)


@pytest.mark.parametrize(
    ("text", "objects"),
    [
        ("touch the two leftmost blocks", {"block_1", "block_2"}),
        ("touch the leftmost two blocks", {"block_1", "block_2"}),
        ("touch the two blocks on the right", {"block_3", "block_4"}),
        ("touch the first two blocks from the left", {"block_1", "block_2"}),
        ("touch the last three blocks", {"block_2", "block_3", "block_4"}),
        ("touch the two largest blocks", {"block_1", "block_3"}),
        ("touch the three smallest blocks", {"block_2", "block_3", "block_4"}),
        ("touch the two blocks nearest to the lime", {"block_3", "block_4"}),
        ("touch the other blocks", {"block_1", "block_2", "block_3", "block_4"}),
        ("touch all blocks on the left", {"block_1", "block_2"}),
        ("touch whatever is on the plate", {"lemon_1", "lime_1"}),
        ("touch everything on the plate", {"lemon_1", "lime_1"}),
        ("touch all the things on the plate", {"lemon_1", "lime_1"}),
        ("put everything on the plate next to the cup", {"lemon_1", "lime_1"}),
    ],
)
def test_some_of_a_kind(text, objects):
    assert first(text, ROW) == objects


@pytest.mark.parametrize(
    ("text", "objects"),
    [
        ("touch the block nearest to the cup", {"block_2"}),
        ("touch the nearest block to the cup", {"block_2"}),
        ("touch the block farthest from the cup", {"block_4"}),
        ("touch the one next to the lime", {"lemon_1"}),
        ("touch the fruit on the left of the plate", {"lemon_1"}),
    ],
)
def test_one_by_its_place(text, objects):
    assert first(text, ROW) == objects


def test_a_group_on_the_plate_is_no_group_put_there():
    assert first("put all the blocks on the plate", ROW) == {f"block_{n}" for n in range(1, 5)}


def test_nothing_on_the_plate_is_not_everything():
    assert first("touch everything on the cup", ROW) == set()


def test_them_is_the_group_spoken_of():
    slots = [m.slot for m in linked("lift all the blocks and put them on the plate").mentions]
    assert slots == ["m1", "m1", "m2"]
    mentions = linked("push the red block left, then the others right").mentions
    assert set(mentions[1].objects) == BLOCKS - {"red_block_1"} and mentions[1].plural


def test_them_in_a_later_sentence():
    focus = [("red_block_1", 0.7), ("green_block_1", 0.7), ("plate_1", 0.5)]
    assert first("put them in the bowl", TABLE, focus) == {"red_block_1", "green_block_1"}
    assert first("put the rest in the bowl", TABLE, focus) == EVERYTHING - {
        "red_block_1", "green_block_1", "plate_1", "bowl_1",
    }  # fmt: skip


def test_one_of_them_is_any_of_them():
    mention = linked("lift all the blocks, then drop one of them").mentions[1]
    assert set(mention.objects) == BLOCKS and mention.free and not mention.plural


def test_while_things_wait_in_the_tray_everything_is_those():
    scene = Scene(objects=(thing("cup", 0.0, 0.0),), tray=(waiting("apple"), waiting("lemon")))
    assert first("put everything in a row", scene) == {"apple_1", "lemon_1"}
    laid = Scene(objects=BESIDE_THE_TRAY.objects, tray=(waiting("apple"),))
    assert first("put everything in a row", laid) == {"cup_1", "lime_1", "peach_1"}


def test_what_lies_on_the_floor_is_not_everything():
    fallen = thing("lemon", 1.2, 0.0, on="floor")
    assert first("lift everything", Scene(objects=(*ROW.objects[:2], fallen))) == {
        "block_1", "block_2",
    }  # fmt: skip


@pytest.mark.parametrize(
    ("text", "mentions"),
    [
        ("pick up the larger of the bottle and the bowl", ["bottle", "bowl"]),
        ("of the blocks, touch the tallest", ["blocks"]),
        ("grab the second of the blocks from the left", ["blocks"]),
        ("build a pyramid of all the blocks", ["blocks"]),
        ("put the blocks in a ring", ["blocks"]),
        ("tap the blocks one by one", ["blocks"]),
        ("put the bottle and the bowl next to each other", ["bottle", "bowl"]),
        ("swap the bottle and the bowl, the two should change places", ["bottle", "bowl"]),
        ("in case the bottle is left of the bowl, push the sponge", ["bottle", "bowl", "sponge"]),
        ("if the bottle is left of the plate, push the sponge", ["bottle", "plate", "sponge"]),
        ("it would be nice to have the bottle on the plate", ["bottle", "plate"]),
        ("put the bottle 10 cm before the plate", ["bottle", "plate"]),
        ("put the apple next to the bowl, the lemon and the bottle on the plate",
         ["apple", "bowl", "lemon", "bottle", "plate"]),
    ],
)  # fmt: skip
def test_what_is_left_to_the_translator(text, mentions):
    assert [m.text for m in linked(text).mentions] == mentions


@pytest.mark.parametrize("text", ["touch both the bowl and the plate", "lift both bowl and plate"])
def test_both_before_single_things_counts_nothing(text):
    mentions = linked(text).mentions
    assert [m.objects for m in mentions] == [("bowl_1",), ("plate_1",)]
    assert not any(m.plural for m in mentions)


def test_an_apple_lemon_and_can_are_three_mentions():
    assert named("touch the sponge, the bottle and the bowl") == {
        "sponge": ("sponge_1",), "bottle": ("bottle_1",), "bowl": ("bowl_1",),
    }  # fmt: skip


@pytest.mark.parametrize(
    "text",
    ["all", "all of", "the rest of", "everything but", "except the", "all but all but all",
     "them them them", "the two of", "two of them but", "every one of the", "the nearest to"],
)  # fmt: skip
def test_fragments_of_groups_are_read(text):
    assert link(text, TABLE, (), LEXICON).text == text


BESIDE_THE_TRAY = Scene(
    objects=(thing("cup", 0.0, 0.0), thing("lime", -0.5, 0.2), thing("peach", 0.5, 0.3)),
    tray=(waiting("apple"), waiting("lemon")),
)


@pytest.mark.parametrize(
    "text",
    ["move everything to the left edge", "push everything away from me", "touch all the things",
     "shift everything 5 cm to the right"],
)  # fmt: skip
def test_what_is_done_to_things_where_they_stand_is_not_done_to_what_waits(text):
    assert first(text, BESIDE_THE_TRAY) == {"cup_1", "lime_1", "peach_1"}


def test_what_is_put_beside_something_is_put_beside_what_stands_somewhere():
    mention = linked("put the apple next to the smallest thing", BESIDE_THE_TRAY).mentions[1]
    assert not {"apple_1", "lemon_1"} & set(mention.objects)


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("line up the fruit along the left edge", {"apple_1", "lemon_1", "lime_1", "peach_1"}),
        ("put the fruit in a row", {"apple_1", "lemon_1", "lime_1", "peach_1"}),
        ("sort the fruit by size", {"apple_1", "lemon_1", "lime_1", "peach_1"}),
    ],
)
def test_what_is_only_done_to_several_is_done_to_all_of_it(text, named):
    mention = linked(text, BESIDE_THE_TRAY).mentions[0]
    assert set(mention.objects) == named and mention.plural


def test_fruit_that_is_to_be_lifted_is_one_piece():
    assert not linked("pick up the fruit", BESIDE_THE_TRAY).mentions[0].plural

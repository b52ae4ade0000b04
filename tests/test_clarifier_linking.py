"""Which things phrases denote: any one of a group, lone plurals, materials, sides; contrasts; and
what goes on from the last command.
"""

import msgspec
import pytest
from clarifier_table import LEXICON, TABLE, linked, named, talk, thing

from agent.messages import Dialog
from clarifier.bodies import spared_slots
from clarifier.deed import link_deed
from clarifier.going_on import with_measure, with_place
from clarifier.rewrite import restate
from scene.types import Scene

SHELF = Scene(
    objects=(
        thing("brass nut", -0.7, 0.5), thing("brass nut", -0.5, 0.5, number=2),
        thing("steel nut", -0.3, 0.5), thing("wooden spoon", 0.0, 0.6),
        thing("pea can", 0.3, 0.5, size=0.14), thing("honey pot", 0.6, 0.5, size=0.14),
        thing("tin", -0.6, -0.5), thing("tin", -0.1, -0.5, number=2),
        thing("tin", 0.5, -0.5, number=3), thing("sugar jar", 0.0, 0.0, size=0.16),
        thing("small plum", 0.7, 0.0, size=0.06), thing("big plum", 0.7, -0.3, size=0.12),
    )
)  # fmt: skip


@pytest.mark.parametrize(
    ("text", "objects"),
    [
        ("lift one of the tins", {"tin_1", "tin_2", "tin_3"}),
        ("push any one of the tins to the left", {"tin_1", "tin_2", "tin_3"}),
        ("touch either of the brass nuts", {"brass_nut_1", "brass_nut_2"}),
        ("can one of the tins go to the left", {"tin_1", "tin_2", "tin_3"}),
        ("lift just one of my tins", {"tin_1", "tin_2", "tin_3"}),
    ],
)
def test_one_of_a_group_is_any_single_one(text, objects):
    mention = linked(text, SHELF).mentions[0]
    assert (set(mention.objects), mention.plural, mention.free) == (objects, False, True)


def test_what_any_of_them_is_then_called_it_is_as_free():
    mentions = linked("take one of the tins and put it on the left", SHELF).mentions
    assert [(m.slot, m.free) for m in mentions] == [("m1", True), ("m1", True)]


def test_two_of_a_group_are_still_several():
    mention = linked("lift two of the tins", SHELF).mentions[0]
    assert mention.plural and mention.free


@pytest.mark.parametrize(
    ("text", "plural"),
    [
        ("push the peas to the left", False), ("push the tins to the left", True),
        ("push all the peas to the left", True), ("push both tins to the left", True),
    ],
)  # fmt: skip
def test_a_plural_of_one_thing_is_that_thing(text, plural):
    assert linked(text, SHELF).mentions[0].plural is plural


@pytest.mark.parametrize(
    ("text", "objects"),
    [
        ("push the things of brass to the left", {"brass_nut_1", "brass_nut_2"}),
        ("push the things made of brass to the left", {"brass_nut_1", "brass_nut_2"}),
        ("lift the nut of steel", {"steel_nut_1"}),
        ("lift the nut that is made out of steel", {"steel_nut_1"}),
        ("lift the one made of wood", {"wooden_spoon_1"}),
        ("lift the steel", {"steel_nut_1"}),
        ("lift the tin of the middle", {"tin_2"}), ("lift the tin of the left", {"tin_1"}),
        ("lift the middle tin", {"tin_2"}),
        ("lift the little plum", {"small_plum_1"}), ("lift the large plum", {"big_plum_1"}),
        ("lift the tiny plum", {"small_plum_1"}), ("lift the bigger plum", {"big_plum_1"}),
    ],
)  # fmt: skip
def test_materials_sides_and_sizes(text, objects):
    assert set(linked(text, SHELF).mentions[0].objects) == objects


def test_a_word_of_a_name_opens_an_item_of_a_list():
    assert named("pea left of the sugar jar, honey right of the sugar jar", SHELF) == {
        "pea": ("pea_can_1",), "sugar jar": ("sugar_jar_1",), "honey": ("honey_pot_1",),
    }  # fmt: skip


@pytest.mark.parametrize(
    ("text", "objects"),
    [
        ("spoon left of the jar, honey right of it, steel nut behind it",
         ["sugar_jar_1", "sugar_jar_1"]),
        ("put the spoon left of the jar and the honey right of it", ["sugar_jar_1"]),
        ("put the spoon on the jar, then the steel nut on it", ["wooden_spoon_1"]),
        ("put the spoon left of the jar, then push it away", ["wooden_spoon_1"]),
    ],
)  # fmt: skip
def test_it_in_a_list_stays_with_the_landmark(text, objects):
    its = [m.objects for m in linked(text, SHELF).mentions if m.text == "it"]
    assert its == [(one,) for one in objects]


def test_a_wish_for_what_is_not_there_yet_says_where_to():
    found = named("I want the yellow one on the plate")
    assert found == {"yellow one": ("yellow_block_1",), "plate": ("plate_1",)}


@pytest.mark.parametrize(
    ("text", "core", "spared"),
    [
        ("push the big plum, not the small one, to the left", "push the big plum , to the left",
         ("small_plum_1",)),
        ("lift the steel nut, leave the brass ones", "lift the steel nut",
         ("brass_nut_1", "brass_nut_2")),
        ("lift the steel nut and leave the tins exactly where they are", "lift the steel nut",
         ("tin_1", "tin_2", "tin_3")),
    ],
)  # fmt: skip
def test_contrasts_and_what_is_left_alone_are_no_deeds(text, core, spared):
    deed = link_deed(text, SHELF, (), LEXICON)
    assert (deed.text, deed.spared) == (core, spared)


def test_left_somewhere_is_not_left_alone():
    deed = link_deed("lift the steel nut and leave the spoon on the jar", SHELF, (), LEXICON)
    assert deed.text == "lift the steel nut and leave the spoon on the jar"


def test_what_something_is_done_with_is_never_left_out():
    deed = linked("put the mug on the plate and the bottle by the bowl, not the sponge")
    left_out = [deed.first(slot).mention.text for slot in spared_slots(deed)]
    assert left_out == ["plate", "bowl", "sponge"]


@pytest.mark.parametrize(
    ("last", "text", "whole"),
    [
        ("put the bottle in the bowl", "put the sponge in there as well",
         "put the sponge in the bowl"),
        ("put the bottle next to the plate", "move the sponge there too",
         "move the sponge next to the plate"),
        ("put the bottle in the bowl", "put the sponge on the plate", None),
        ("push the bottle left", "put the sponge in there", None),
    ],
)  # fmt: skip
def test_there_is_where_the_last_one_went(last, text, whole):
    assert with_place(text, Dialog(last_text=last), TABLE, LEXICON) == whole


@pytest.mark.parametrize(
    ("last", "text", "whole"),
    [
        ("push the sponge 4 cm to the left", "push it another 3", "push it 3 cm to the left"),
        ("slide the sponge 20 mm away from me", "another 10 mm", "slide it 10 mm away from me"),
        ("push the sponge two inches to the right", "push it a further 2",
         "push it 2 inches to the right"),
        ("push the sponge 4 cm to the left", "push it 3 cm to the right", None),
        ("push the sponge left", "push it another 3", None),
        ("push the sponge 4 cm to the left", "and another 2", "push it 2 cm to the left"),
        ("slide the sponge towards me", "a bit more", "slide it a bit towards me"),
        ("slide the sponge 3 cm to the left", "a bit further please", "slide it a bit to the left"),
        ("push the sponge 4 cm to the left", "lift it another 3", None),
    ],
)  # fmt: skip
def test_another_measure_goes_the_same_way(last, text, whole):
    assert with_measure(text, Dialog(last_text=last), TABLE, LEXICON) == whole


def test_a_colour_of_a_name_gives_way_to_another():
    dialog = Dialog(last_text="slide the red block to the right")
    assert restate("and now the green one too", dialog, TABLE, LEXICON) == (
        "slide the green block to the right"
    )


def test_that_behind_a_relation_is_the_last_thing():
    found = named("put the sponge on top of that, please", focus=(("mug_1", 1.0),))
    assert found == {"sponge": ("sponge_1",), "that": ("mug_1",)}


def test_taken_back_and_something_else_done(clarifier):
    done = talk(clarifier, "push the sponge to the right")[0]
    moved = tuple(
        msgspec.structs.replace(item, x=item.x + 0.3) if item.id == "sponge_1" else item
        for item in TABLE.objects
    )
    text = "actually put it back where it was and lift the bottle instead"
    (both,) = talk(clarifier, text, scene=Scene(objects=moved), dialog=done.dialog)
    assert both.do == "act" and set(both.touched) == {"sponge_1", "bottle_1"}
    assert both.program is not None and "sponge" in both.program and "bottle" in both.program


def test_colours_in_the_plural_stand_for_things():
    mention = linked("push the reds to the left").mentions[0]
    assert (set(mention.objects), mention.plural) == (
        {"apple_1", "mug_1", "red_block_1"}, True,
    )  # fmt: skip


def test_them_may_be_one_thing_that_is_called_many():
    mentions = linked("the peas, push them to the left", SHELF).mentions
    assert [(m.slot, m.plural) for m in mentions] == [("m1", False), ("m1", False)]


@pytest.mark.parametrize(
    ("text", "objects"),
    [
        ("lift a mug but not the red one", {"mug_2"}),
        ("put any mug except the blue one on the plate", {"mug_1"}),
        ("put any block but the red one on the plate", {"green_block_1", "yellow_block_1"}),
    ],
)
def test_any_one_but_the_one_that_is_left_out(text, objects):
    first = linked(text).spoken[0]
    assert set(first.mention.objects) == objects and first.mention.free


def test_it_is_what_tells_apart_the_thing_that_goes_beside_it():
    spoken = linked("move the mug left of the blue mug to the right of it").spoken
    assert [one.mention.objects for one in spoken] == [("mug_1",), ("mug_2",)]


def test_more_of_a_list_says_where_it_goes():
    spoken = linked("red block on the green one and then the yellow one on the red").spoken
    assert [one.mention.objects for one in spoken] == [
        ("red_block_1",), ("green_block_1",), ("yellow_block_1",), ("red_block_1",)
    ]  # fmt: skip


def test_at_the_bottom_of_a_tower_is_no_part_of_the_table():
    spoken = linked("a tower: the red one at the bottom, the green one on it").spoken
    assert spoken[0].mention.text == "red one"

"""One of several, the rest of them, which one a side tells, and what is chosen from."""

import msgspec
import pytest
from clarifier_table import TABLE, linked, thing

from clarifier.bodies import denied
from scene.types import Scene

APPLES = ("apple_1", "apple_2")


def found(text: str, focus=()):
    return [(one.mention.objects, one.mention.plural, one.mention.free)
            for one in linked(text, focus=focus).spoken]  # fmt: skip


@pytest.mark.parametrize(
    "said", ["one of the apples", "any of the apples", "either of the two apples",
             "one of my two apples"],
)  # fmt: skip
def test_one_of_the_apples_is_one_apple_whichever(said):
    assert found(f"push {said} a little to the left") == [(APPLES, False, True)]


def test_what_is_said_of_the_one_leaves_it_open_which():
    assert found("lift one of the apples and turn it") == [(APPLES, False, True)] * 2
    assert found("hover 8 cm over one of the apples") == [(APPLES, False, True)]
    assert found("tip over one of the apples") == [(APPLES, False, True)]


def test_the_rest_of_what_one_is_taken_from_is_its_like():
    for rest in ("the others", "the rest"):
        mentions = found(f"put one of the apples on the plate and {rest} in the bowl")
        assert mentions[2] == (APPLES, True, False)


@pytest.mark.parametrize(
    ("text", "objects"),
    [
        ("if the apple on the left is narrower than the sponge, touch the sponge", ("apple_1",)),
        ("pick up the narrower one of the apple on the right and the sponge", ("apple_2",)),
        ("might the apple on the left be turned by 90 degrees", ("apple_1",)),
        ("the apple on the left goes in the bowl", ("apple_1",)),
        ("put the apple on the left", APPLES),
        ("apple on the left, sponge on the right", APPLES),
    ],
)
def test_a_side_tells_which_one_where_no_place_is_wanted(text, objects):
    assert found(text)[0][0] == objects


def test_what_it_is_nearest_to_tells_which_one_is_chosen_from():
    mentions = found("touch the taller of the sponge and the apple closest to the bowl")
    assert [objects for objects, *_ in mentions] == [("sponge_1",), ("apple_2",)]


def test_what_was_done_before_may_be_chosen_from():
    before = (("sponge_1", 1.0),)
    mentions = found("move the closer one of it and the bottle onto the plate", before)
    assert [objects for objects, *_ in mentions] == [("sponge_1",), ("bottle_1",), ("plate_1",)]
    mentions = found("move the taller one, it or the bottle, onto the plate", before)
    assert [objects for objects, *_ in mentions] == [("sponge_1",), ("bottle_1",), ("plate_1",)]
    assert found("slide it and the bottle off the left edge")[0][0] == ()
    before = (("apple_1", 1.0),)
    mentions = found("touch the taller one of the other one and the bottle", before)
    assert [objects for objects, *_ in mentions] == [("apple_2",), ("bottle_1",)]


def test_the_other_one_may_be_sent_to_a_part_of_the_table():
    before = (("apple_1", 1.0),)
    assert found("shove the other one nearer to the right side", before)[0][0] == ("apple_2",)


def test_an_unknown_thing_in_a_list_is_missed_and_an_aside_is_not():
    spoken = linked("push the sponge and the glorp to the left").spoken
    assert [one.mention.objects for one in spoken] == [("sponge_1",), ()]
    spoken = linked("put the sponge away and the gneef will be glad").spoken
    assert [one.mention.objects for one in spoken] == [("sponge_1",)]


def test_in_it_may_mean_a_part_of_the_table():
    text = "if the left half of the table has the sponge in it, touch the sponge"
    assert [one.mention.objects for one in linked(text).spoken] == [("sponge_1",), ("sponge_1",)]
    assert found("put the sponge in it")[1][0] == ()


@pytest.mark.parametrize(
    ("text", "slots"),
    [
        ("don't put the sponge on the plate, put it in the bowl", {"m2"}),
        ("put the sponge in the bowl", set()),
        ("don't touch the sponge", {"m1"}),
        ("touch the plate, then don't touch it again", set()),
    ],
)
def test_only_what_is_named_in_a_ban_alone_is_denied(text, slots):
    assert denied(linked(text)) == slots


def test_a_ring_a_lap_and_timber_are_no_things_where_none_is_there():
    scene = Scene(objects=(thing("bottle", 0.0, 0.0), thing("ring", 0.5, 0.5)))
    assert len(linked("draw a ring around the bottle", TABLE).spoken) == 1
    assert len(linked("put the ring next to the bottle", scene).spoken) == 2


def test_whichever_of_two_things_speaks_of_both_of_them():
    mentions = found("lift whichever of the left apple and the sponge is nearer to the bowl")
    assert mentions[:2] == [(("apple_1",), False, False), (("sponge_1",), False, False)]
    mentions = found("lift whichever of the apple and the sponge is nearer to the bowl")
    assert mentions[0] == (APPLES, False, False)
    assert found("lift whichever of the apples is closest to the bowl")[0][0] == ("apple_2",)
    assert found("lift whichever apple")[0] == (APPLES, False, True)


def test_one_is_left_out_of_a_group_by_its_size():
    mugs = Scene(
        objects=(thing("mug", -0.5, 0.0), thing("mug", 0.0, 0.0, number=2, size=0.3, tall=0.3),
                 thing("mug", 0.5, 0.0, number=3), thing("tray", 0.0, 0.7))
    )  # fmt: skip
    for text in ("touch all the mugs but not the largest of the mugs",
                 "touch the mugs except the biggest of them all"):  # fmt: skip
        spoken = linked(text, scene=mugs).spoken
        assert spoken[0].mention.objects == ("mug_1", "mug_3")


def test_the_other_one_of_a_condition_is_the_same_behind_it():
    before = (("apple_1", 1.0),)
    text = "if the other apple is wider than the sponge lift the other apple"
    mentions = linked(text, focus=before).spoken
    assert [m.mention.objects for m in mentions] == [("apple_2",), ("sponge_1",), ("apple_2",)]
    assert mentions[0].mention.slot == mentions[2].mention.slot


@pytest.mark.parametrize(
    "text",
    [
        "put one of the apples in one of the bowls and the rest of them on the plate",
        "an apple and one of the mugs on the plate",
    ],
)
def test_the_rest_is_of_what_goes_somewhere_not_of_where_it_goes(text):
    two = msgspec.structs.replace(
        TABLE, objects=(*TABLE.objects, thing("bowl", 0.7, -0.7, number=2))
    )
    spoken = linked(text, scene=two).spoken
    rest = [one for one in spoken if one.phrase is not None and one.phrase.group]
    assert all(set(one.mention.objects) == {"apple_1", "apple_2"} for one in rest)
    assert bool(rest) is ("rest" in text)


def test_held_over_something_is_where_and_not_which():
    spoken = linked("hold one of the apples over the green block and let it go").spoken
    assert [one.mention.text for one in spoken][:2] == ["one of the apples", "green block"]
    assert linked("touch the apple above the green block").spoken[0].mention.objects == ("apple_2",)


def test_what_is_compared_by_distance_goes_there_whatever_tells_it_apart():
    spoken = linked("slide the apple on the left closer to me, only slightly").spoken
    assert spoken[0].mention.text == "apple on the left"
    assert spoken[0].mention.objects == ("apple_1",)


def test_a_shape_that_is_told_of_is_what_is_drawn():
    assert linked("a square has four corners: draw it").spoken == ()
    assert linked("the apple is round: draw a line to it").spoken[-1].mention.text == "it"


def test_an_unknown_thing_that_is_put_somewhere_too_is_missed():
    spoken = linked("the mug left of it and the wumple behind the bowl").spoken
    assert [one.mention.text for one in spoken if not one.mention.objects] == ["it", "wumple"]


def test_a_side_tells_which_one_is_used():
    spoken = linked("using the apple on the right, push the bottle away").spoken
    assert spoken[0].mention.objects == ("apple_2",)

"""Which phrases of a sentence name objects, where they begin and end, and which slot they get."""

import pytest
from clarifier_table import TABLE, linked, named, thing

from clarifier.spoken import without_asides
from scene.types import Scene

ODD = Scene(
    objects=(
        thing("coca cola", -0.5, 0.5),
        thing("red star", 0.5, 0.5),
        thing("green moon", 0.0, 0.5),
        thing("small brown bowl", -0.5, -0.5),
        thing("red cube", 0.5, -0.5),
        thing("can", 0.0, -0.5),
    )
)


@pytest.mark.parametrize(
    ("text", "mentions"),
    [
        ("push the sponge to the left", {"sponge": ("sponge_1",)}),
        ("shove bottle over to the right", {"bottle": ("bottle_1",)}),
        ("stick the blue mug on the plate", {"blue mug": ("mug_2",), "plate": ("plate_1",)}),
        ("nudge my little sponge a bit", {"little sponge": ("sponge_1",)}),
        ("the bottle goes left of the bowl", {"bottle": ("bottle_1",), "bowl": ("bowl_1",)}),
        ("grab the leftmost apple", {"leftmost apple": ("apple_1",)}),
        ("poke the second block from the left", {"second block from the left": ("red_block_1",)}),
        ("push the rightmost one off the table", {"rightmost one": ("bottle_1",)}),
        ("could you lift the yellow one", {"yellow one": ("yellow_block_1",)}),
        ("bottle a bit closer to the bowl", {"bottle": ("bottle_1",), "bowl": ("bowl_1",)}),
        ("sponge nearer the plate please", {"sponge": ("sponge_1",), "plate": ("plate_1",)}),
        ("tap the cup that is on the right", {"cup that is on the right": ("mug_2",)}),
        ("touch the apple closest to the bowl", {"apple closest to the bowl": ("apple_2",)}),
    ],
)
def test_a_mention_covers_the_phrase_without_its_determiner(text, mentions):
    assert named(text) == mentions
    for mention in linked(text).mentions:
        assert text[mention.start : mention.end] == mention.text


@pytest.mark.parametrize(
    ("text", "mentions"),
    [
        ("put the coca cola next to the red star",
         {"coca cola": ("coca_cola_1",), "red star": ("red_star_1",)}),
        ("push coca cola left", {"coca cola": ("coca_cola_1",)}),
        ("the cube goes on the star", {"cube": ("red_cube_1",), "star": ("red_star_1",)}),
        ("move the moon behind the brown bowl",
         {"moon": ("green_moon_1",), "brown bowl": ("small_brown_bowl_1",)}),
        ("pick up the coke", {"coke": ("coca_cola_1",)}),
        ("can you push the can to the right", {"can": ("can_1",)}),
    ],
)  # fmt: skip
def test_scene_names_of_any_length_and_their_parts(text, mentions):
    assert named(text, ODD) == mentions


@pytest.mark.parametrize(
    "text",
    [
        "to the left", "put it there in the far left corner", "on the right side of the table",
        "in the middle", "near the top edge of the table", "in the same place", "in a circle",
        "a little to the left", "in one straight line", "move the arm up", "to the lower right",
    ],
)  # fmt: skip
def test_places_and_shapes_are_no_mentions(text):
    assert [m for m in linked(text).mentions if m.text != "it"] == []


@pytest.mark.parametrize(
    ("text", "objects"),
    [
        ("touch any one of the mugs", ("mug_1", "mug_2")),
        ("lift one of my apples", ("apple_1", "apple_2")),
    ],
)
def test_one_of_several_is_one_and_any(text, objects):
    (mention,) = linked(text).mentions
    assert (mention.objects, mention.plural, mention.free) == (objects, False, True)


def test_what_was_left_open_stays_open_for_a_pronoun():
    assert [m.free for m in linked("lift any apple and then hold it up").mentions] == [True, True]


def test_what_is_nearest_to_it_is_told_apart_by_what_was_named():
    found = named("push the bowl until it meets the apple closest to it")
    assert found["apple closest to it"] == ("apple_2",)
    assert named("lift the apple furthest from it") == {
        "apple": ("apple_1", "apple_2"), "it": (),
    }  # fmt: skip


def test_that_one_is_the_one_just_spoken_of():
    focus = (("mug_2", 1.0), ("plate_1", 0.6))
    assert named("push that one to the right", focus=focus) == {"one": ("mug_2",)}
    assert named("that one can go to the right", focus=focus) == {"one": ("mug_2",)}


@pytest.mark.parametrize(
    "text", ["the apple on the left goes in the bowl", "the apple on the left must be in the bowl"]
)
def test_what_is_to_become_of_a_thing_follows_what_tells_it_apart(text):
    assert named(text)["apple on the left"] == ("apple_1",)


def test_which_one_and_where_to_without_a_verb():
    found = named("I would like the apple on the left on the plate")
    assert found == {"apple on the left": ("apple_1",), "plate": ("plate_1",)}


def test_this_one_goes_where_is_said_behind_it():
    assert named("put this one on the plate", focus=(("mug_1", 1.0),)) == {
        "one": ("mug_1",), "plate": ("plate_1",),
    }  # fmt: skip


def test_a_noun_that_begins_a_sentence_is_no_verb_without_an_object():
    assert named("bottle a little to the right") == {"bottle": ("bottle_1",)}
    assert "bowl" not in named("bowl the bottle over")


def test_the_same_thing_gets_the_same_slot():
    slots = [m.slot for m in linked("lift the sponge, then put it by the bottle").mentions]
    assert slots == ["m1", "m1", "m2"]


@pytest.mark.parametrize(
    ("text", "theme"),
    [
        ("put the apple next to the bowl on the plate", "apple next to the bowl"),
        ("push the apple on the left to the right", "apple on the left"),
        ("pick up the apple by the bowl", "apple by the bowl"),
        ("put the apple next to the bowl", "apple"),
        ("put the sponge on the left", "sponge"),
        ("move the bottle to the left of the bowl", "bottle"),
    ],
)
def test_a_relation_belongs_to_the_phrase_only_if_the_verb_can_spare_it(text, theme):
    assert linked(text).mentions[0].text == theme


def test_it_is_the_theme_of_the_clause_before():
    assert linked("lift the sponge and drop it on the plate").mentions[1].objects == ("sponge_1",)


def test_it_after_a_thing_was_put_in_another_may_be_either():
    last = linked("put the sponge in the bowl and move it left").mentions[-1]
    assert last.objects == ("sponge_1", "bowl_1")


@pytest.mark.parametrize(
    ("focus", "objects"),
    [
        ([("sponge_1", 1.0), ("bowl_1", 0.8)], ("sponge_1",)),
        ([("sponge_1", 0.7), ("bowl_1", 0.6)], ("bowl_1", "sponge_1")),
        ([], ()),
        ([("gone_1", 1.0)], ()),
    ],
)
def test_a_pronoun_takes_the_clearly_most_salient_thing(focus, objects):
    assert named("push it left", TABLE, focus)["it"] == objects


def test_the_noun_alone_is_settled_by_the_focus_and_says_so():
    spoken = linked("push the apple left", TABLE, [("apple_2", 0.7)]).spoken[0]
    assert spoken.mention.objects == ("apple_2",) and spoken.tie_broken


def test_a_free_phrase_and_a_group_are_marked():
    assert linked("push an apple left").mentions[0].free
    assert linked("put any mug on the plate").mentions[0].free
    assert linked("put both apples on the plate").mentions[0].plural
    assert linked("put all the blocks on the plate").mentions[0].plural
    assert not linked("push the apple left").mentions[0].free


def test_them_between_two_things_is_left_to_the_translator():
    texts = [m.text for m in linked("put the sponge left of the bowl and the plate between them")
             .mentions]  # fmt: skip
    assert texts == ["sponge", "bowl", "plate"]


@pytest.mark.parametrize(
    ("text", "left"),
    [
        ("the inspector is coming, put the sponge on the plate", ["sponge", "plate"]),
        ("put the sponge on the plate so the hamster can't reach it", ["sponge", "plate"]),
        ("push the sponge left because my elbow needs room", ["sponge"]),
        ("put the flask on the plate", ["flask", "plate"]),
        ("put the sponge next to the flask", ["sponge", "flask"]),
        ("the flask next to the plate", ["flask", "plate"]),
    ],
)
def test_what_is_said_in_passing_is_no_mention_if_it_is_not_there(text, left):
    found = without_asides(linked(text))
    assert [one.mention.text for one in found.spoken][: len(left)] == left
    assert found.slots == tuple(f"m{n}" for n in range(1, len(found.slots) + 1))
    assert all(one.mention.objects or one.mention.text == "flask" for one in found.spoken)


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("put the bottle in the middle, then the sponge left of it", "bottle_1"),
        ("put the bottle in the middle and set the sponge on it", "bottle_1"),
        ("if the bottle is taller than the sponge, push it to the left", "bottle_1"),
        ("pick up the bottle and put it on the plate", "bottle_1"),
    ],
)
def test_a_thing_is_never_beside_itself_and_than_names_no_theme(text, meant):
    assert named(text)["it"] == (meant,)

"""What people say behind a noun, or leave out of it, to tell one thing from others of its kind."""

import pytest
from clarifier_table import linked, thing

from scene.types import Scene

TOYS = Scene(
    objects=(
        thing("boat", -0.8, 0.6, "red", size=0.2),
        thing("boat", 0.0, -0.7, "green", number=2, size=0.12),
        thing("boat", 0.7, -0.2, "white", number=3, size=0.16),
        thing("blue drum", -0.7, -0.5),
        thing("red drum", 0.4, 0.7),
        thing("tall tower", 0.8, -0.7, tall=0.4),
        thing("tower", -0.1, 0.2, tall=0.2),
        thing("ball of string", -0.3, -0.2, "white"),
        thing("can", 0.3, -0.3, "silver"),
        thing("8 ball", -0.4, 0.7, "black"),
        thing("crate", 0.0, 0.75, size=0.3),
    )
)
"""Three boats (1 far left, 2 near in the middle, 3 right), two drums, two towers, a crate."""
RED, GREEN, WHITE = "boat_1", "boat_2", "boat_3"


def first(text, scene=TOYS):
    """The first mention: its text and what it denotes."""
    mention = linked(text, scene).mentions[0]
    return mention.text, set(mention.objects)


def meant(text, scene=TOYS):
    return first(text, scene)[1]


@pytest.mark.parametrize(
    ("phrase", "objects"),
    [
        ("boat that is most near to the crate", {RED}),
        ("boat most far from the crate", {GREEN}),
        ("boat farthest away from the crate", {GREEN}),
        ("boat which is the closest to me", {GREEN}),
        ("boat nearest me", {GREEN}),
        ("boat that is the furthest away", {RED}),
        ("boat that is furthest to the right", {WHITE}),
        ("boat that is most left", {RED}),
        ("boat in the middle", {GREEN}),
        ("boat that is in the middle", {GREEN}),
        ("boat that is not on the left", {GREEN, WHITE}),
    ],
)
def test_where_it_is_tells_which(phrase, objects):
    said, found = first(f"put the {phrase} in the crate")
    assert found == objects
    assert said == phrase, "the whole clause belongs to the mention"


def test_whichever_is_settled_by_its_clause_and_free_without_one():
    assert first("take whichever boat is nearer the crate") == (
        "whichever boat is nearer the crate", {RED},
    )  # fmt: skip
    assert not linked("take whichever boat is nearer the crate", TOYS).mentions[0].free
    assert linked("take whichever boat you like", TOYS).mentions[0].free


@pytest.mark.parametrize(
    "text",
    ["push the boat closer to the crate", "put the boat nearer the crate",
     "push the boat furthest to the right", "put the boat in the middle"],
)  # fmt: skip
def test_where_to_put_it_does_not_tell_which(text):
    assert first(text) == ("boat", {RED, GREEN, WHITE})


@pytest.mark.parametrize(
    ("phrase", "objects"),
    [
        ("boat that isn't green", {RED, WHITE}),
        ("boat that's not orange", {RED, GREEN, WHITE}),
        ("boat which is not green or white", {RED}),
        ("boat that's neither red nor green", {WHITE}),
        ("red thing that is not a boat", {"red_drum_1"}),
        ("red thing that's not drum", {RED}),
    ],
)
def test_what_it_is_not_tells_which(phrase, objects):
    assert first(f"lift the {phrase}, then wait") == (phrase, objects)


def test_a_group_without_what_is_denied():
    assert meant("lift the boats that aren't red") == {GREEN, WHITE}
    assert meant("lift every boat which is not white or green") == {RED}


def test_all_of_a_list_is_denied_and_no_more():
    mentions = linked("lift the boat that isn't red or green, the can and the crate", TOYS).mentions
    assert [set(m.objects) for m in mentions] == [{WHITE}, {"can_1"}, {"crate_1"}]


def test_what_denies_everything_leaves_nothing():
    assert meant("lift the boat that is not red, green or white") == set()


@pytest.mark.parametrize(
    ("phrase", "objects"),
    [
        ("boat white", {WHITE}),
        ("boat of green colour", {GREEN}),
        ("boat of the color red", {RED}),
        ("boat that is green", {GREEN}),
        ("boat which is the red one", {RED}),
        ("boat that's the biggest", {RED}),
        ("boat painted white", {WHITE}),
        ("drum that is blue", {"blue_drum_1"}),
    ],
)
def test_an_adjective_behind_its_noun(phrase, objects):
    assert first(f"put the {phrase} next to the can") == (phrase, objects)


def test_in_a_colour_is_no_place_unless_a_place_is_wanted():
    assert first("lift the boat in green") == ("boat in green", {GREEN})
    assert first("slide the boat in white to the left") == ("boat in white", {WHITE})
    assert first("put the boat in red") == ("boat", {RED, GREEN, WHITE})


@pytest.mark.parametrize("text", ["is the boat red", "make the boat red", "paint the boat red"])
def test_a_colour_said_of_a_thing_does_not_tell_which(text):
    assert first(text) == ("boat", {RED, GREEN, WHITE})


@pytest.mark.parametrize(
    ("text", "objects"),
    [
        ("put the can between the blue and the red drum", [{"blue_drum_1"}, {"red_drum_1"}]),
        ("put the can between the green and white boat", [{GREEN}, {WHITE}]),
        ("swap the big and the small boat", [{RED}, {GREEN}]),
        ("lift the red, the green and the white boat", [{RED}, {GREEN}, {WHITE}]),
    ],
)
def test_a_noun_said_once_serves_a_list(text, objects):
    mentions = [set(m.objects) for m in linked(text, TOYS).mentions]
    assert mentions[-len(objects) :] == objects


def test_adjectives_of_one_plural_noun_make_one_group():
    (group,) = linked("lift the red and green boats", TOYS).mentions
    assert set(group.objects) == {RED, GREEN} and group.plural
    assert group.text == "red and green boats"


def test_colours_alone_stand_for_what_has_them():
    mentions = linked("stack green on blue", TOYS).mentions
    assert [m.objects for m in mentions] == [(GREEN,), ("blue_drum_1",)]
    assert set(linked("push red left", TOYS).mentions[0].objects) == {RED, "red_drum_1"}


@pytest.mark.parametrize("text", ["turn red", "is it red", "make it green", "purple"])
def test_a_colour_that_names_nothing_is_no_mention(text):
    assert all(mention.text in ("it",) for mention in linked(text, TOYS).mentions)


def test_one_chosen_from_a_group_by_its_size():
    assert first("tap the taller of the two towers") == (
        "taller of the two towers", {"tall_tower_1"},
    )  # fmt: skip
    assert meant("tap the smallest of the boats that aren't green") == {WHITE}
    assert len(meant("tap the wider of the two towers")) == 2, "a tie stays a tie"


@pytest.mark.parametrize(
    ("text", "objects"),
    [
        ("push the 8 ball left", {"8_ball_1"}),
        ("push 8 ball left", {"8_ball_1"}),
        ("lift the silver can", {"can_1"}),
        ("lift the silver can if you can", {"can_1"}),
        ("lift the ball of string", {"ball_of_string_1"}),
        ("lift both towers", {"tall_tower_1", "tower_1"}),
        ("lift the string", {"ball_of_string_1"}),
    ],
)
def test_names_that_look_like_grammar_or_numbers(text, objects):
    assert meant(text) == objects


def test_a_part_of_a_name_behind_of():
    balls = (thing("ball of wool", -0.5, 0.0, "red"), thing("ball of wool", 0.5, 0.0, number=2))
    scene = Scene(objects=(*balls, thing("ball", 0.0, 0.5), thing("tin of fish soup", 0.0, -0.5)))
    assert first("lift the two balls of wool", scene) == (
        "two balls of wool", {"ball_of_wool_1", "ball_of_wool_2"},
    )  # fmt: skip
    assert first("lift the tin of soup", scene)[0] == "tin of soup"


@pytest.mark.parametrize(
    "text",
    ["put all the boats in the crate, except the red one",
     "put all the boats in the crate, but not the red one",
     "boats in the crate, not the red one"],
)  # fmt: skip
def test_an_exception_said_late_belongs_to_the_group(text):
    assert meant(text) == {GREEN, WHITE}
    assert linked(text, TOYS).mentions[1].objects == ("crate_1",)


def test_an_exception_may_be_told_by_its_place():
    text = "put all boats except the one closest to the crate on the left"
    assert meant(text) == {GREEN, WHITE}


def test_a_late_exception_to_nothing_is_left_as_it_was():
    text = "put the boats in the crate, but not the can"
    assert linked(text, TOYS).text == text


def test_the_rest_of_a_kind_leaves_out_the_group_before():
    mentions = linked("lift the red and green boats and the rest of the boats", TOYS).mentions
    assert set(mentions[1].objects) == {WHITE}


def test_where_it_was_is_where_the_thing_before_was():
    mentions = linked("lift the can, then put the crate where it was", TOYS).mentions
    assert mentions[-1].objects == ("can_1",)


def test_only_one_says_how_many_and_names_nothing():
    texts = [m.text for m in linked("put a boat in the crate, only one", TOYS).mentions]
    assert texts == ["boat", "crate"]


@pytest.mark.parametrize(
    "text",
    ["that isn't", "the boat that is not", "which is not red or", "whichever", "red and",
     "the red and the", "of green colour", "the boat that is the", "except the", ", not the boat",
     "the most", "furthest to the", "the taller of the", "boats except the one nearest"],
)  # fmt: skip
def test_fragments_are_read(text):
    assert linked(text, TOYS).text


def test_with_a_red_one_begins_another_thing():
    mugs, *_ = linked("stack the mugs with a blue one at the bottom").spoken
    assert mugs.mention.text == "mugs"

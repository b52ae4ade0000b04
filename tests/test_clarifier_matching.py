"""Each thing to what has its colour: said as a group, and held against how a program ends."""

import msgspec
import pytest
from clarifier_table import LEXICON, thing

from clarifier.binding import bindings
from clarifier.matching import in_matching_groups, matched, twin
from clarifier.mentions import link
from clarifier.stated import as_stated, stated
from clarifier.turns import in_plain_turns
from scene.types import Scene

TABLE = Scene(
    objects=(
        thing("ring", -0.6, 0.5, "red", number=1),
        thing("ring", 0.0, 0.5, "blue", number=2),
        thing("tray", -0.5, -0.5, "blue", number=1, size=0.3),
        thing("tray", 0.5, -0.5, "red", number=2, size=0.3),
    )
)


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("rings onto the trays at the front, colour to colour",
         "rings onto the trays at the front of the same colour"),
        ("Every ring goes home: each one onto the tray of its own colour at the front",
         "each ring goes onto the trays at the front of the same colour"),
        ("lay each ring on the tray that matches it",
         "lay each ring on the trays of the same colour"),
        ("put every ring into the tray whose colour it has, red with red, blue with blue",
         "put every ring into the trays of the same colour"),
        ("for every ring, set it next to the tray that is the same colour as it",
         "set every ring next to the trays of the same colour"),
        ("all the rings go in the matching tray",
         "all the rings go in the trays of the same colour"),
        ("drop the rings into a tray that isn't their own colour",
         "drop the rings into the trays of a different colour"),
        ("put each ring on one of the trays of another colour",
         "put each ring on the trays of a different colour"),
        ("the rings on the trays, but never on the same colour",
         "the rings on the trays of a different colour"),
        ("mismatch both rings and the trays: each goes onto one of another colour",
         "put both rings onto the trays of a different colour"),
        ("please match the rings with the trays by colour",
         "put the rings onto the trays of the same colour"),
        ("put the rings in the trays so that no colours match",
         "put the rings in the trays, colours must not match"),
    ],
)  # fmt: skip
def test_what_each_is_matched_with_is_said_as_a_group(text, plain):
    assert in_plain_turns(text, LEXICON) == plain


@pytest.mark.parametrize(
    "text",
    [
        "put the ring on the tray of the same colour",
        "put the red ring on the blue tray",
        "put the rings on the tray that is red",
        "put the rings next to the tray with the lid",
        "what colour is the tray that the rings are on?",
    ],
)
def test_other_sentences_stay_as_they_are(text):
    assert in_matching_groups(text) == text


def _ends(red, blue):
    """The table with each ring on a tray."""
    on = {"ring_1": red, "ring_2": blue}
    items = [
        msgspec.structs.replace(item, on=on[item.id], x=TABLE.get(on[item.id]).x, y=-0.5)
        if item.id in on else item
        for item in TABLE.objects
    ]  # fmt: skip
    return Scene(objects=tuple(items))


@pytest.mark.parametrize(
    ("text", "same"),
    [
        ("put the rings on the trays of the same colour", True),
        ("put the rings on the trays, matching colours", True),
        ("put the rings on the trays of a different colour", False),
        ("put the rings on the trays, never of the same colour", False),
    ],
)
def test_a_program_that_matches_otherwise_does_not_end_as_said(text, same):
    linked = link(text, TABLE, (), LEXICON)
    goals = stated(linked, bindings(linked, TABLE, {})[0], TABLE)
    assert as_stated(goals, TABLE, _ends("tray_2", "tray_1")) is same
    assert as_stated(goals, TABLE, _ends("tray_1", "tray_2")) is not same
    assert not as_stated(goals, TABLE, _ends("tray_1", "tray_1"))


def test_no_match_is_held_where_none_is_said():
    linked = link("put the rings on the trays", TABLE, (), LEXICON)
    assert matched(linked, bindings(linked, TABLE, {})[0]) == ()


def test_the_program_by_the_other_of_the_two_is_its_twin():
    by_same = "for one in m1:\n    for other in of_its_color(one, m2):\n        put_on(one, other)"
    assert twin(by_same) == by_same.replace("of_its_color", "of_another_color")
    assert twin(twin(by_same) or "") == by_same
    assert twin("put_all_on(m1, m2)") is None


def test_who_stays_far_off_is_with_nothing():
    """The rings' nearest trays have another colour than theirs; to leave them is not to match."""
    lone = msgspec.structs.replace(TABLE, objects=(TABLE.objects[0], *TABLE.objects[2:3]))
    more = Scene(objects=(*lone.objects, thing("ring", 0.0, 0.6, "red", number=2),
                          thing("tray", 0.5, -0.5, "green", number=2, size=0.3)))  # fmt: skip
    linked = link("put the rings on the trays of a different colour", more, (), LEXICON)
    goals = stated(linked, bindings(linked, more, {})[0], more)
    assert not as_stated(goals, more, more)
    placed = tuple(msgspec.structs.replace(one, x=-0.5, y=-0.5, on="tray_1")
                   if one.name == "ring" else one for one in more.objects)  # fmt: skip
    assert as_stated(goals, more, msgspec.structs.replace(more, objects=placed))

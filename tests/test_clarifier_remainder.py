"""Some of a group and the rest of it: what is cut off, and how many a program must leave."""

import pytest
from clarifier_table import LEXICON, thing

from clarifier.binding import bindings
from clarifier.measures import quantities
from clarifier.mentions import link
from clarifier.remainder import half_counted, left, towers_counted, without_the_rest
from clarifier.stated import as_stated, stated
from scene.types import Scene

TABLE = Scene(
    objects=(
        *(thing("nut", -0.8 + 0.4 * at, 0.6, number=at + 1) for at in range(4)),
        thing("jar", 0.0, -0.5, size=0.3, tall=0.3),
        thing("lamp", 0.6, 0.0, size=0.2, tall=0.4),
    )
)


@pytest.mark.parametrize(
    ("text", "rest"),
    [
        ("put one of the nuts in the jar and leave the others where they are",
         "put one of the nuts in the jar"),
        ("two of the nuts go in the jar, the rest can stay put, they're spare",
         "two of the nuts go in the jar"),
        ("put a nut in the jar; let the remaining ones be.", "put a nut in the jar."),
        ("put two of the nuts in the jar, leave the third one alone",
         "put two of the nuts in the jar"),
        ("put three nuts in the jar, what's left you don't touch", "put three nuts in the jar"),
        ("Two of the four nuts belong in the jar, no more than that",
         "Two of the nuts belong in the jar"),
        ("at least two of the nuts go in the jar, which ones doesn't matter",
         "two of the nuts go in the jar"),
        ("The left nut stays where it is, dear; the other nuts go in the jar",
         "all the nuts except the left nut go in the jar"),
        ("put all but one of the nuts in the jar, please",
         "put the nuts in the jar, all but one, please"),
        ("put one nut to the left of the lamp and the other nut to its right",
         "the nuts: one to the left of the lamp, one to the right"),
        ("all the nuts in the jar but not the left one, that one has to stay!",
         "all the nuts in the jar but not the left one!"),
        ("stick the nuts into the jar but leave two of them out",
         "stick all but two of the nuts into the jar"),
        ("at the left edge put all my nuts, only spare two",
         "at the left edge put all but two of my nuts"),
        ("all of the nuts go in the jar, excluding two of them, you choose which",
         "all but two of the nuts go in the jar"),
        ("leave two of the nuts where they are while the others are put by the lamp",
         "put all but two of the nuts by the lamp"),
        ("the nuts - leave two, rest into the jar", "put all but two of the nuts into the jar"),
        ("put all nuts in the jar, and spare two of them",
         "put all but two of the nuts in the jar"),
        ("not all of the nuts: keep one, and the rest go into the jar",
         "put the nuts into the jar, all but one"),
        ("one of the nuts behind the lamp, the other one in front of it",
         "the nuts: one at the back of the lamp, one at the front"),
    ],
)  # fmt: skip
def test_a_rest_that_stays_is_cut_off(text, rest):
    assert without_the_rest(text) == rest


@pytest.mark.parametrize(
    "text",
    [
        "leave the others where they are",
        "put the nuts in the jar and leave the lamp where it is",
        "put one nut in the jar and the rest next to the lamp",
        "put the rest of the nuts in the jar",
        "put one nut left of the lamp and the jar right of it",
    ],
)
def test_other_sentences_stay_as_they_are(text):
    assert without_the_rest(text) == text


def _with(count):
    """The table once so many of the nuts are in the jar."""
    taken = [thing("nut", 0.0, -0.5, number=at + 1, on="jar_1") for at in range(count)]
    return Scene(objects=(*taken, *TABLE.objects[count:]))


@pytest.mark.parametrize(
    ("text", "moved"),
    [
        ("put all but one of the nuts in the jar", 3),
        ("put the nuts in the jar, all but two", 2),
        ("put all the nuts except three in the jar", 1),
        ("put half of the nuts in the jar", 2),
    ],
)
def test_how_many_stay_is_held_against_the_end(text, moved):
    linked = link(text, TABLE, (), LEXICON)
    goals = stated(linked, bindings(linked, TABLE, {})[0], TABLE)
    assert [as_stated(goals, TABLE, _with(count)) for count in range(5)] == [
        count == moved for count in range(5)
    ]


def test_no_count_is_held_where_none_is_said():
    linked = link("put the nuts in the jar", TABLE, (), LEXICON)
    assert left(linked, bindings(linked, TABLE, {})[0]) == ()


def test_half_of_a_group_is_so_many_of_it():
    linked = link("put half of the nuts in the jar", TABLE, (), LEXICON)
    assert half_counted(linked) == "put two of the nuts in the jar"
    both = link("put half of the nuts in the jar, the other half by the lamp", TABLE, (), LEXICON)
    assert half_counted(both) is None


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("build two towers with two nuts in each of them", "build two stacks of the nuts"),
        ("make two piles of two nuts each", "make two stacks of the nuts"),
        ("make two towers with three nuts each", None),
        ("make two towers of the nuts", None),
    ],
)
def test_towers_of_so_many_each_are_stacks_of_them_all(text, plain):
    assert towers_counted(link(text, TABLE, (), LEXICON)) == plain


@pytest.mark.parametrize("text", ["put all but two of the nuts in the jar",
                                  "all the nuts except two go in the jar"])  # fmt: skip
def test_how_many_are_left_out_is_no_thing_and_no_measure(text):
    linked = link(text, TABLE, (), LEXICON)
    assert [one.mention.text for one in linked.spoken] == ["nuts", "jar"]
    assert quantities(linked, TABLE) == ()


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("three discs belong in the corner, the remaining ones go in the box",
         "three discs in the corner, the others in the box"),
        ("two cubes to the edge, and then the rest of the cubes comes all into the box",
         "two cubes to the edge, the other cubes into the box"),
        ("the disc goes in the box", "the disc goes in the box"),
    ],
)  # fmt: skip
def test_some_and_the_rest_go_two_ways_without_verbs(text, plain):
    assert without_the_rest(text) == plain

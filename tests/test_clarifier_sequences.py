"""An order that a sentence says: by size, by name, as listed, in ranks; and lists of a group."""

import pytest
from clarifier_table import thing

from clarifier.binding import bindings
from clarifier.lexicon import load_lexicon
from clarifier.listed import members_listed
from clarifier.mentions import link
from clarifier.sequences import Before, sequence
from clarifier.stated import as_stated, stated
from scene.types import Scene

LEXICON = load_lexicon()
TABLE = Scene(
    objects=(
        thing("jar", -0.6, 0.5, "white", size=0.2, tall=0.4),
        thing("jar", 0.0, 0.5, "black", number=2, size=0.2, tall=0.2),
        thing("jar", 0.5, 0.5, "pink", number=3, size=0.2, tall=0.3),
        thing("letter a", -0.6, -0.5),
        thing("letter b", 0.0, -0.5),
        thing("sponge", 0.6, -0.5, "yellow"),
    )
)
WHITE, BLACK, PINK = "jar_1", "jar_2", "jar_3"


def order(text):
    linked = link(text, TABLE, (), LEXICON)
    pairs = sequence(linked, bindings(linked, TABLE, {})[0], TABLE)
    assert len({pair.axis for pair in pairs}) <= 1
    names = [pairs[0].first, *(pair.second for pair in pairs)] if pairs else []
    return (names, pairs[0].axis) if pairs else None


@pytest.mark.parametrize(
    ("text", "names", "axis"),
    [
        ("line the jars up, tallest on the left", [WHITE, PINK, BLACK], "x"),
        ("sort the jars from shortest to tallest, right to left", [WHITE, PINK, BLACK], "x"),
        ("order the jars, the shortest at the front", [BLACK, PINK, WHITE], "y"),
        ("put the jars in a column, the tallest one most near to me", [WHITE, PINK, BLACK], "y"),
        ("stack the jars with the shortest on top", [WHITE, PINK, BLACK], "z"),
        ("put the jars in a row in decreasing height from left to right", [WHITE, PINK, BLACK],
         "x"),
        ("sort the jars by height, shortest first, from front to back", [BLACK, PINK, WHITE], "y"),
        ("line up the pink jar, the white jar and the black jar left to right",
         [PINK, WHITE, BLACK], "x"),
        ("arrange pink, white and black in a line from back to front", [BLACK, WHITE, PINK], "y"),
        ("build a tower: white at the bottom, pink in the middle and black at the top",
         [WHITE, PINK, BLACK], "z"),
        ("make a row with black on the right and white on the left", [WHITE, BLACK], "x"),
        ("stack the pink jar and the black jar with the black one at the bottom", [BLACK, PINK],
         "z"),
        ("arrange B and A alphabetically", ["letter_a_1", "letter_b_1"], "x"),
    ],
)  # fmt: skip
def test_the_order_said(text, names, axis):
    assert order(text) == (names, axis)


@pytest.mark.parametrize(
    "text",
    [
        "touch the jars from left to right",
        "push the white jar and the pink jar from left to right",
        "put the tallest jar on the left",
        "line up the jars",
        "put the sponge to the left of the white jar",
        "move the jars from the left side to the right side",
    ],
)
def test_no_order_is_said(text):
    assert order(text) is None


def test_things_of_one_size_may_stand_either_way():
    scene = Scene(
        objects=(*TABLE.objects[:3], thing("jar", 0.0, 0.0, number=4, size=0.2, tall=0.2))
    )
    linked = link("sort the jars, tallest on the left", scene, (), LEXICON)
    pairs = sequence(linked, bindings(linked, scene, {})[0], scene)
    assert Before(PINK, BLACK, "x") in pairs and Before(PINK, "jar_4", "x") in pairs
    assert not any({pair.first, pair.second} == {BLACK, "jar_4"} for pair in pairs)


def test_a_program_that_makes_the_other_order_gives_way_and_leaves_its_probability(outcome_of):
    outcome = outcome_of(
        "line the jars up, tallest on the left",
        TABLE,
        ("row(ordered(m1, [one.tall for one in m1]))", -0.4),
        ("row(ordered(m1, [-one.tall for one in m1]))", -1.2),
        sure=0.8,
    )
    assert outcome.ok and outcome.checked is not None and "-one.tall" in outcome.checked.program
    assert 0.6 < outcome.confidence <= 0.8


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("sort the jars from left to right: pink, black, white",
         "sort the pink jar, the black jar and the white jar from left to right"),
        ("I want the jars in this order from front to back: the white one, the pink one,"
         " the black one",
         "I want the white jar, the pink jar and the black jar in this order from front to back"),
        ("line the jars up, white on the right, pink in the middle and black on the left",
         "line the black jar, the pink jar and the white jar up from left to right"),
        ("stack the jars, white at the bottom, pink in the middle, black on top",
         "stack white at the bottom, pink in the middle, black on top"),
    ],
)  # fmt: skip
def test_members_that_are_listed_stand_for_their_group(text, said):
    assert members_listed(link(text, TABLE, (), LEXICON)) == said


@pytest.mark.parametrize(
    "text",
    [
        "stack the jars, white at the bottom, black on top",
        "put the jars next to the sponge, then the letter a and the letter b",
        "put the jars in a row, then push the sponge",
        "line up the jars",
    ],
)
def test_what_is_no_whole_list_stays(text):
    assert members_listed(link(text, TABLE, (), LEXICON)) is None


def ends(text, *xs):
    linked = link(text, TABLE, (), LEXICON)
    goals = stated(linked, bindings(linked, TABLE, {})[0], TABLE)
    jars = (thing("jar", x, 0.5, number=n + 1, size=0.2) for n, x in enumerate(xs))
    return goals and as_stated(goals, TABLE, Scene(objects=(*jars, *TABLE.objects[3:])))


@pytest.mark.parametrize(
    ("text", "apart"),
    [
        ("spread the jars out a bit more", True),
        ("move the jars further apart", True),
        ("leave a bit more room between the jars", True),
        ("push the jars closer together", False),
        ("bring the jars nearer to each other", False),
    ],
)
def test_the_gaps_grow_or_shrink_as_said(text, apart):
    assert ends(text, -0.8, 0.0, 0.8) is apart
    assert ends(text, -0.4, 0.0, 0.4) is not apart
    assert ends(text, -0.5, 0.1, 0.6) is False  # all moved on together


def test_a_form_says_more_than_apart():
    assert ends("spread the jars out a bit more in a row", -0.3, 0.0, 0.3)

"""Rows, columns and lines, and the gaps in them, are held against the end."""

import pytest
from clarifier_table import LEXICON, thing

from agent.messages import Quantity
from clarifier.binding import bindings
from clarifier.formed import Formed, formed, formed_wholly, in_form, spaced, turned
from clarifier.mentions import link
from clarifier.stated import orders, stated, ways
from scene.types import Scene

DOMINOES = tuple(f"domino_{number}" for number in (1, 2, 3))


def table(*places):
    dominoes = [thing("domino", x, y, number=number) for number, (x, y) in enumerate(places, 1)]
    return Scene(objects=(*dominoes, thing("jar", 0.8, 0.8), thing("lid", 0.8, -0.8)))


TABLE = table((-0.5, 0.1), (0.1, 0.3), (0.4, -0.4))
ROW = table((-0.3, 0), (0, 0), (0.3, 0))
COLUMN = table((0, 0.3), (0, 0), (0, -0.3))
SLANT = table((-0.3, -0.3), (0, 0), (0.3, 0.3))


def said(text, of=formed):
    linked = link(text, TABLE, (), LEXICON)
    return of(linked, bindings(linked, TABLE, {})[0], TABLE)


@pytest.mark.parametrize(
    ("text", "form"),
    [
        ("put the dominoes in a row", "row"),
        ("make a nice neat row of the dominoes", "row"),
        ("set the three dominoes side by side", "row"),
        ("arrange all dominoes in one horizontal line", "row"),
        ("dominoes in a column please", "column"),
        ("stand the dominoes one behind the other", "column"),
        ("put the dominoes into a vertical line", "column"),
        ("line up the dominoes in a straight line", "line"),
    ],
)
def test_the_form_is_read_and_seen_in_the_end(text, form):
    (goal,) = said(text)
    assert (goal.form, goal.things) == (form, DOMINOES)
    held = [in_form(goal, after) for after in (ROW, COLUMN, SLANT, TABLE)]
    assert (
        held
        == {
            "row": [True, False, False, False],
            "column": [False, True, False, False],
            "line": [True, True, True, False],
        }[form]
    )


@pytest.mark.parametrize(
    "text",
    [
        "push the dominoes in a straight line",
        "put the dominoes in two rows",
        "make a row of the dominoes and another row of the jar and the lid",
        "put the dominoes next to the row",
        "don't put the dominoes in a row",
        "put the dominoes in the jar",
        "put the jar in a line",
    ],
)
def test_what_makes_no_one_form_says_none(text):
    assert said(text) == ()


def test_gaps_are_measured_from_edge_to_edge():
    (goal,) = said("put the dominoes in a column with gaps of 5 cm")
    assert goal.gap == pytest.approx(0.25)
    assert not in_form(goal, COLUMN)
    (wide,) = said("put the dominoes in a column, 3.6 cm apart")
    assert in_form(wide, COLUMN)
    (even,) = said("put the dominoes in a row with equal gaps")
    assert even.even and in_form(even, ROW)
    assert not in_form(even, table((-0.4, 0), (0, 0), (0.3, 0)))


def test_some_space_is_not_none():
    (goal,) = said("put the dominoes in a row with a bit of space between them")
    assert in_form(goal, ROW)
    assert not in_form(goal, table((-0.13, 0), (0, 0), (0.13, 0)))


@pytest.mark.parametrize(
    ("text", "program"),
    [
        ("put the dominoes in a column, 2 cm apart", "put_in_depth(m1, d1)"),
        ("put the dominoes in a row, 2 cm apart", "put_abreast(m1, d1)"),
    ],
)
def test_a_column_that_is_set_abreast_is_turned(text, program):
    assert turned("put_abreast(m1, d1)", said(text)) == program


@pytest.mark.parametrize(
    ("text", "wholly"),
    [
        ("arrange the dominoes in a neat column please", True),
        ("arrange the dominoes in a column on the jar", False),
        ("arrange the dominoes in a column, upside down", False),
    ],
)
def test_a_form_and_nothing_else_is_just_what_the_end_shows(text, wholly):
    linked = link(text, TABLE, (), LEXICON)
    assert formed_wholly(said(text), linked, LEXICON, TABLE, COLUMN) is wholly
    assert not formed_wholly(said(text), linked, LEXICON, TABLE, ROW)


def test_programs_that_make_the_form_speak_for_one_another_unless_more_is_said():
    plain = said("put the dominoes in a row with some space between them", stated)
    assert ways(plain) == plain and orders(plain)
    ordered = said("put the dominoes in a row, the smallest one first", stated)
    (goal,) = (one for one in ordered if isinstance(one, Formed))
    assert goal not in ways(ordered)


def test_who_else_is_moved_by_the_sentence_is_no_part_of_the_form():
    (goal,) = said("arrange the dominoes in a row and put the jar on the lid")
    assert goal.things == DOMINOES and not goal.whole


def test_a_form_that_is_left_is_none():
    assert said("put the dominoes in a triangle instead of a line") == ()
    assert said("put the dominoes in a row instead of a column")[0].form == "row"


@pytest.mark.parametrize(
    "text", ["line up the dominoes front to back", "put the dominoes in a row from front to back"]
)
def test_what_goes_from_front_to_back_is_a_column(text):
    assert [goal.form for goal in said(text)] == ["column"]


@pytest.mark.parametrize(
    ("body", "text", "whole"),
    [
        ("row([m1, m2])", "in a row with gaps of 2 cm", "put_abreast([m1, m2], d1)"),
        ("column(m1)", "in a column, 2 cm apart", "put_in_depth(m1, d1)"),
        ("row(m1)", "in a row, 2 cm from the edge", "row(m1)"),
        ("put_abreast(m1, d1)", "in a row with gaps of 2 cm", "put_abreast(m1, d1)"),
    ],
)
def test_a_gap_that_the_program_leaves_out_is_put_in(body, text, whole):
    assert spaced(body, text, (Quantity("d1", 0, 4, "2 cm", 0.1),)) == whole
    assert spaced(body, text, ()) == body

"""Figures that are said: put plainly, put into the program, and held against the end."""

import math

import pytest
from clarifier_table import LEXICON, thing

from agent.messages import Quantity
from clarifier.binding import bindings
from clarifier.figure_words import told_as_figure
from clarifier.figures import drawn, figured_wholly, figures, in_figure, sized
from clarifier.mentions import link
from clarifier.stated import stated
from scene.types import Scene

SPOTS = ((-0.7, 0.6), (-0.2, 0.7), (0.5, 0.5), (0.1, -0.2), (-0.6, -0.5))
COLORS = ("white", "blue", "green", "yellow", "black")
TABLE = Scene(
    objects=(
        *(thing(f"{color} disc", x, y, size=0.16)
          for color, (x, y) in zip(COLORS, SPOTS, strict=True)),
        thing("red cone", 0.7, -0.6, size=0.16),
    )
)  # fmt: skip
DISCS = tuple(f"{color}_disc_1" for color in COLORS)


def goals(text, reader=stated):
    linked = link(text, TABLE, (), LEXICON)
    found = bindings(linked, TABLE, {})
    return reader(linked, found[0], TABLE) if reader is stated else reader(linked, found[0])


def ending(*places, cone=None):
    now = dict(zip(DISCS, places, strict=False))
    if cone is not None:
        now["red_cone_1"] = cone
    items = (
        thing(item.name, *now[item.id], size=0.16) if item.id in now else item
        for item in TABLE.objects
    )
    return Scene(objects=tuple(items))


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("Square from the discs around the table centre, side length roughly 12 cm, please.",
         "put the discs in a square with sides of 12 cm in the middle of the table"),
        ("like geese flying: set the five discs in a V with the point towards me, anywhere in the "
         "left half", "put the five discs in a V with its tip towards me in the left half of the "
         "table"),
        ("from the discs make please letter L, in part down left of the table",
         "put the discs in an L in the near left corner"),
        ("can you make a plus sign right in the middle? the red cone is the middle of the plus and "
         "the discs are the arms",
         "put the discs in a cross around the red cone in the middle of the table"),
        ("a plus sign from five discs, one disc in the middle of it and 4 arms",
         "put five discs in a cross"),
        ("with the discs you do me a diamond on the right side, one point up, one point down, yes?",
         "put the discs in a diamond in the right half of the table"),
        ("I want a circle of all the discs round the very middle of the table, 10 cm from the "
         "middle each",
         "put all the discs in a circle with a radius of 10 cm in the middle of the table"),
        ("I have five discs lying on the left, and they should all lie in a nice circle about the "
         "middle of the table", "put five discs in a circle in the middle of the table"),
        ("the discs shall fly like geese: a V, its tip pointing away from me",
         "put the discs in a V with its tip away from me"),
        ("a zigzag of the discs along the near edge",
         "put the discs in a zigzag row at the near edge"),
        ("zigzag at the top please, going left to right white, blue, green, yellow",
         "put white, blue, green and yellow in a zigzag row in the far half of the table"),
        ("put the discs in a square formation close to me",
         "put the discs in a square at the near edge"),
        ("make a triangle out of the discs", "put the discs in a triangle"),
    ],
)  # fmt: skip
def test_a_figure_is_put_plainly(text, plain):
    assert told_as_figure(text, TABLE, (), LEXICON) == plain


@pytest.mark.parametrize(
    "text",
    [
        "put the cone on the square",
        "put the discs in a square around the cone",
        "put the discs in a square with one in the middle",
        "put the discs in a square and the cone in the middle",
        "put the discs in a square and move the cone to the left",
        "put the discs in a square, not a circle",
        "put the cone in the middle of the square of discs",
        "put two of the discs in a square",
        "move the white disc in a circle",
        "draw a circle with the discs",
        "swap the discs in the square",
        "circle the discs",
        "square up the discs",
    ],
)
def test_what_is_another_figure_or_says_more_stays(text):
    assert told_as_figure(text, TABLE, (), LEXICON) == text


@pytest.mark.parametrize(
    ("text", "body", "meant"),
    [
        ("put the discs in a V in the left half of the table", 'put_all(m1, "left half")',
         'put_each(m1, figure(m1, "v", "left half", 0))'),
        ("put the discs in a V with its tip away from me", "put_each(m1, in_v(m1))",
         'put_each(m1, figure(m1, "v far", "", 0))'),
        ("put the discs in a diamond at the right edge", "put_each(m1, in_diamond(m1))",
         'put_each(m1, figure(m1, "diamond", "right", 0))'),
        ("put the discs in a circle in the middle of the table",
         "put_each(m1, in_shape(m1, len(m1)))",
         'put_each(m1, figure(m1, "circle", "middle", 0))'),
        ("put the discs in a zigzag row", "row(m1)", 'put_each(m1, figure(m1, "zigzag", "", 0))'),
        ("put the discs in a cross around the red cone in the middle of the table",
         "put_each([m2] + m1, in_cross([m2] + m1))",
         'put_each([m2] + m1, figure([m2] + m1, "cross", "middle", 0))'),
        ("put the white disc, the blue disc and the green disc in a zigzag row",
         'put_each([m1, m2, m3], along_edge([m1, m2, m3], "far"))',
         'put_each([m1, m2, m3], figure([m1, m2, m3], "zigzag", "", 0))'),
        # a program that is right as it is, and one that makes another figure
        ("put the discs in a V", "put_each(m1, in_v(m1))", "put_each(m1, in_v(m1))"),
        ("put the discs in a square in the middle of the table", "put_each(m1, in_ring(m1, 4))",
         "put_each(m1, in_ring(m1, 4))"),
        ("put the discs in a V in the left half of the table", 'put_all(m2, "left half")',
         'put_all(m2, "left half")'),
    ],
)  # fmt: skip
def test_the_figure_is_put_into_the_program(text, body, meant):
    assert drawn(body, goals(text)) == meant


def test_its_size_is_put_into_the_program():
    text = "put the discs in a square with sides of 12 cm in the middle of the table"
    side = Quantity("d1", 37, 42, "12 cm", 0.6)
    body = "put_each(m1, in_shape(m1, 4))"
    assert sized(body, text, [side]) == 'put_each(m1, figure(m1, 4, "middle", d1))'
    assert sized(body, "put the discs in a square", []) == body


CROSS = ((0, 0), (-0.3, 0), (0.3, 0), (0, 0.3), (0, -0.3))
V = ((0, -0.3), (0.3, 0), (-0.3, 0), (0.6, 0.3), (-0.6, 0.3))
L = ((-0.3, 0.3), (-0.3, 0), (-0.3, -0.3), (0, -0.3), (0.3, -0.3))
ZIGZAG = ((-0.6, 0.0), (-0.3, 0.3), (0.0, 0.0), (0.3, 0.3), (0.6, 0.0))
CIRCLE = tuple(
    (0.4 * math.cos(i * math.tau / 5), 0.4 * math.sin(i * math.tau / 5)) for i in range(5)
)


@pytest.mark.parametrize(
    ("name", "spots"),
    [("V", V), ("L", L), ("cross", CROSS), ("circle", CIRCLE), ("zigzag row", ZIGZAG)],
)  # fmt: skip
def test_only_its_own_shape_is_the_figure(name, spots):
    (goal,) = goals(f"put the discs in a {name}".replace("a L", "an L"), figures)
    assert in_figure(goal, ending(*spots))
    for other in (V, L, CROSS, CIRCLE, ZIGZAG):
        assert other == spots or not in_figure(goal, ending(*other))


def test_a_zigzag_keeps_the_order_that_is_said():
    text = "put the white disc, the blue disc and the green disc in a zigzag row"
    (goal,) = goals(text, figures)
    assert in_figure(goal, ending((-0.4, 0), (0, 0.3), (0.4, 0)))
    assert not in_figure(goal, ending((0.4, 0), (0, 0.3), (-0.4, 0)))


def test_the_tip_of_a_v_and_the_middle_of_a_cross_are_where_they_are_said():
    (away,) = goals("put the discs in a V with its tip away from me", figures)
    assert in_figure(away, ending(*((x, -y) for x, y in V))) and not in_figure(away, ending(*V))
    (around,) = goals("put the discs in a cross around the red cone", figures)
    arms = [(-0.3, 0), (0.3, 0), (0, 0.3), (0, -0.3), (-0.6, 0)]
    assert in_figure(around, ending(*arms, cone=(0, 0)))
    assert not in_figure(around, ending(*CROSS, cone=(-0.6, 0)))


@pytest.mark.parametrize(
    "text",
    [
        "put the discs in a circle with one in the middle",
        "put the discs in a square around the cone",
        "put the discs in a square and the cone in the middle",
        "touch the discs in a circle",
    ],
)
def test_what_says_more_has_no_figure_of_its_own(text):
    assert goals(text, figures) == ()


@pytest.mark.parametrize(
    ("text", "wholly"),
    [
        ("put the discs in a V", True),
        ("put the discs in a V at the near edge", True),
        ("put the discs in a V upside down", False),
    ],
)
def test_a_figure_and_nothing_else_is_just_what_the_end_shows(text, wholly):
    linked = link(text, TABLE, (), LEXICON)
    assert figured_wholly(goals(text), linked, LEXICON, TABLE, ending(*V)) is wholly
    assert not figured_wholly(goals(text), linked, LEXICON, TABLE, ending(*L))
    assert not figured_wholly(goals(text), linked, LEXICON, TABLE, ending(*V, cone=(0.9, -0.9)))


def test_four_make_the_ends_of_a_cross_and_two_make_no_figure():
    few = Scene(objects=TABLE.objects[:4])
    linked = link("put the discs in a cross", few, (), LEXICON)
    (ends,) = figures(linked, bindings(linked, few, {})[0])
    assert ends.shape == "diamond"
    two = Scene(objects=TABLE.objects[:2])
    linked = link("put the discs in a V", two, (), LEXICON)
    (none,) = figures(linked, bindings(linked, two, {})[0])
    assert not in_figure(none, two)

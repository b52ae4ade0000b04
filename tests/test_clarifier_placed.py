"""Parts of the table that a sentence says are held against an end, and put into the program."""

import pytest
from clarifier_table import thing

from clarifier.binding import bindings
from clarifier.lexicon import load_lexicon
from clarifier.mentions import link
from clarifier.placed import in_part, leaves_a_part, placed, placed_wholly
from clarifier.put_there import put_there
from clarifier.stated import stated
from scene.types import Scene

BLOCKS = Scene(
    objects=(
        thing("red block", -0.2, 0.3, size=0.2),
        thing("blue block", 0.4, 0.0, size=0.2),
        thing("green block", -0.6, -0.4, size=0.2),
        thing("bowl", 0.6, 0.6, size=0.3),
    )
)
RED, BLUE, GREEN = "red_block_1", "blue_block_1", "green_block_1"


def said(text):
    linked = link(text, BLOCKS, (), load_lexicon())
    found = bindings(linked, BLOCKS, {})
    return linked, placed(linked, found[0]) if found else ()


def meant(text):
    linked = link(text, BLOCKS, (), load_lexicon())
    return stated(linked, bindings(linked, BLOCKS, {})[0], BLOCKS)


def ending(**places):
    items = (
        thing(item.name, *places[item.id[:3]], size=0.2) if item.id[:3] in places else item
        for item in BLOCKS.objects
    )
    return Scene(objects=tuple(items))


@pytest.mark.parametrize(
    ("text", "at", "part"),
    [
        ("put all the blocks in the top left corner", "corner", "far left"),
        ("put the blocks at the bottom right", "corner", "near right"),
        ("push the blocks to the left edge", "edge", "left"),
        ("line the blocks up along the far edge", "edge", "far"),
        ("move all blocks to the centre of the left edge", "mid_edge", "left"),
        ("put all the blocks at the top centre", "mid_edge", "far"),
        ("the blocks go in the middle", "middle", "middle"),
        ("put the blocks in the right half", "half", "right half"),
        ("all the blocks, left half", "half", "left half"),
        ("make a triangle in the near left corner with the blocks", "corner", "near left"),
        ("let the blocks huddle together at the middle of the far edge", "mid_edge", "far"),
        ("slide the blocks a bit towards the middle", "towards", "middle"),
    ],
)
def test_the_part_of_the_table_is_read(text, at, part):
    _, (goal,) = said(text)
    assert (set(goal.things), goal.at, goal.part) == ({RED, BLUE, GREEN}, at, part)


def test_each_clause_has_its_own_part():
    _, goals = said("put the red block at the right edge and the others in the near left corner")
    assert [(goal.things, goal.part) for goal in goals] == [
        ((RED,), "right"),
        ((BLUE, GREEN), "near left"),
    ]


@pytest.mark.parametrize(
    "text",
    [
        "push the blocks to the left",  # a way, not a part
        "put the blocks on the left of the bowl",
        "sort the blocks by size, smallest on the left",
        "stack the blocks, the red one at the bottom",
        "if the bowl is in the middle, put the blocks in the left half",
        "put the blocks in the left half, not in the corner",
        "put the blocks next to the bowl in the far right corner",
    ],
)
def test_other_sentences_say_no_part(text):
    assert said(text)[1] == ()


def test_an_end_elsewhere_is_not_what_was_said():
    _, (corner,) = said("put all the blocks in the far left corner")
    packed = ending(red=(-0.85, 0.85), blu=(-0.6, 0.85), gre=(-0.85, 0.6))
    one_off = ending(red=(-0.85, 0.85), blu=(-0.6, 0.85), gre=(0.85, 0.6))
    assert in_part(corner, BLOCKS, packed) and not in_part(corner, BLOCKS, one_off)
    _, (middle,) = said("put all the blocks at the middle of the far edge")
    assert in_part(middle, BLOCKS, ending(red=(-0.3, 0.85), blu=(0, 0.85), gre=(0.3, 0.85)))
    assert not in_part(middle, BLOCKS, ending(red=(-0.9, 0.85), blu=(-0.6, 0.85), gre=(-0.3, 0.85)))


def test_towards_a_part_is_a_way_to_it():
    _, (goal,) = said("push the red block a bit towards the middle")
    assert in_part(goal, BLOCKS, ending(red=(-0.1, 0.15)))
    assert not in_part(goal, BLOCKS, ending(red=(-0.2, 0.05 - 0.5)))
    assert not in_part(goal, BLOCKS, BLOCKS)


@pytest.mark.parametrize(
    ("text", "body", "program"),
    [
        ("put the blocks at the top centre", 'put_all(m1, "middle")',
         'put_each(m1, along_edge(m1, "far"))'),
        ("gather the blocks at the left edge", 'put_all(m1, "left")',
         'put_each(m1, along_edge(m1, "left"))'),
        ("let the blocks huddle together at the middle of the far edge", 'put_all(m1, "far")',
         'put_each(m1, figure(m1, "block", "far", 0))'),
        ("gather the blocks in the left half", 'put_all(m1, "left half")',
         'put_each(m1, figure(m1, "block", "left half", 0))'),
        ("put the blocks in the near right corner", 'put_all(m1, "near left")',
         'put_all(m1, "near right")'),
        ("make a triangle in the left half with the blocks", "put_each(m1, in_shape(m1, 3))",
         'put_each(m1, figure(m1, 3, "left half", 0))'),
        ("set the blocks in a row at the far edge", "row(by_size(m1))",
         'put_each(by_size(m1), line_at(by_size(m1), "row", "far"))'),
        ("put the blocks in a vertical line at the bottom right", 'put_all(m1, "near right")',
         'put_each(m1, line_at(m1, "column", "near right"))'),
        ("line the blocks up in a column in the middle", "column(m1)",
         'put_each(m1, line_at(m1, "column", "middle"))'),
        ("put the blocks in a row at the far edge, the smallest on the left",
         'order = by_size(m1)\nput_each(order, along_edge(order, "far"))',
         'order = by_size(m1)\nput_each(order, line_at(order, "row", "far"))'),
        ("put the blocks in a line at the far edge", "column(m1)",
         'put_each(m1, line_at(m1, "row", "far"))'),
        ("spread the blocks out along the near edge",
         "put_in_line(from_left(m1), 1.4 / (len(m1) - 1), 0)",
         'put_each(m1, spread_along(m1, "near"))'),
        ("put the red block at the middle of the left edge", 'put(m1, edge(m1, "left"))',
         'put(m1, mid_edge(m1, "left"))'),
        ("put the red block on the bowl", "put_on(m1, m2)", "put_on(m1, m2)"),
        ("put the blocks at the left edge", "row(m2)", "row(m2)"),
    ],
)  # fmt: skip
def test_the_part_is_put_into_the_program(text, body, program):
    assert put_there(body, meant(text)) == program


@pytest.mark.parametrize(
    ("text", "wholly"),
    [
        ("put the blocks in the far left corner", True),
        ("put the blocks in the far left corner quietly upside down", False),
        ("put the red block in the far left corner and show the bowl", False),
    ],
)
def test_a_sentence_that_says_a_part_and_nothing_else_is_borne_out(text, wholly):
    linked, goals = said(text)
    end = ending(red=(-0.85, 0.85), blu=(-0.6, 0.85), gre=(-0.85, 0.6))
    assert placed_wholly(goals, linked, load_lexicon(), BLOCKS, end) is wholly
    fewer = ending(red=(-0.85, 0.85), blu=(-0.6, 0.85))
    assert not placed_wholly(goals, linked, load_lexicon(), BLOCKS, fewer)


@pytest.mark.parametrize(
    ("text", "left"),
    [
        ("lovely, the blocks as organ pipes, that is to say a row at the far edge", True),
        ("there is a red block, in the near left corner I want it", True),
        ("the bowl in the far right corner is where the red block goes", False),  # it stands there
        ("if the bowl is in the left half, turn the red block", False),
        ("turn the red block", False),
    ],
)
def test_a_part_where_nothing_ends_is_left_out(text, left):
    end = ending(red=(0.1, 0.1))
    assert leaves_a_part(said(text)[0], {RED}, BLOCKS, end) is left
    if "far" in text:
        assert not leaves_a_part(said(text)[0], {RED}, BLOCKS, ending(red=(-0.5, 0.85)))


def test_where_a_thing_stands_is_no_part_it_goes_to():
    _, goals = said("lay the block lying in the near left corner in the middle")
    assert all(goal.at != "corner" for goal in goals)

"""Which problem of a program is said where there are several, and what leaves it no probability."""

from dataclasses import replace

import msgspec
import pytest
from clarifier_table import LEXICON, thing, waiting

from agent.check import Checked
from agent.messages import Command, Problem
from clarifier.binding import bindings
from clarifier.deed import link_deed
from clarifier.pieces import DeniedPlace
from clarifier.vetoes import Tried, mistaken, problem_of
from scene.types import Scene

TABLE = Scene(
    objects=(
        thing("bottle", 0.8, 0.0, tall=0.3),
        thing("vase", 0.3, 0.0),
        thing("mug", -0.5, 0.0),
        thing("pumpkin", -0.5, 0.6, size=0.7, tall=0.6),
    ),
    tray=(waiting("can"),),
)
FOUND = Problem("unsafe", "the check found it")
UPON_THE_VASE = Command("move", 0.3, 0.0, 0.1, 0.0, False)
OFF_THE_TABLE = {"bottle_1": {"x": 1.3, "on": "floor"}}
OVER = {"bottle_1": {"upright": False}}
FALLEN = {"bottle_1": {"x": 1.3, "on": "floor", "upright": False}}
PUSHED = {"vase_1": {"x": 0.5}}
BY_THE_MUG = {"bottle_1": {"x": -0.3}}


def tried(text, body, *found, commands=(), **ends):
    """A program on the table that ends with things otherwise than before."""
    return Tried(*said(text, body), Checked(body, "manipulate", commands, after(**ends), found))


def endless(text, body, *found):
    """A program that comes to no end."""
    return Tried(*said(text, body), Checked(body, "manipulate", problems=found))


def said(text, body):
    sentence = link_deed(text, TABLE, (), LEXICON)
    return sentence, body, body, bindings(sentence, TABLE, {})[0], TABLE


def after(**ends):
    objects = (msgspec.structs.replace(item, **ends.get(item.id, {})) for item in TABLE.objects)
    return Scene(objects=tuple(objects), tray=TABLE.tray)


SPARING = "push the bottle to the right without touching the vase"
PUSH = "push(m1, [m1.x + 0.5, m1.y])"


@pytest.mark.parametrize(
    ("text", "found", "commands", "ends", "problem"),
    [
        (SPARING, (FOUND,), (UPON_THE_VASE,), PUSHED | OFF_THE_TABLE, "not to be touched"),
        (SPARING, (FOUND,), (), PUSHED | OFF_THE_TABLE, "you said that it is to stay"),
        (SPARING, (FOUND,), (), OFF_THE_TABLE, "the check found it"),
        (SPARING, (), (), OFF_THE_TABLE, "would go off the table"),
        ("push the can to the right without touching the vase", (FOUND,), (UPON_THE_VASE,), {},
         "waits in the tray"),
        ("push the bottle to the right", (FOUND,), (), OVER, "the check found it"),
        ("tip the bottle over to the left", (), (), FALLEN, "would go off the table"),
        ("push the bottle to the right", (), (), FALLEN, "would go off the table"),
        ("push the bottle to the right", (), (), OVER, "would topple"),
        ("tap the bottle", (), (), {"bottle_1": {"x": 0.7, "upright": False}}, "would topple"),
        ("tap the bottle", (), (), {"bottle_1": {"x": 0.7}}, "nobody asked for that"),
        ("push the bottle to the right", (), (), {"bottle_1": {"x": 0.85}}, ""),
    ],
)  # fmt: skip
def test_what_was_said_forbids_before_the_check_and_that_before_what_was_not(
    text, found, commands, ends, problem
):
    forbidden = problem_of(tried(text, PUSH, *found, commands=commands, **ends))
    assert problem in (forbidden.text if forbidden else "") and bool(forbidden) is bool(problem)


@pytest.mark.parametrize(
    ("commands", "ends", "problem"),
    [
        ((UPON_THE_VASE,), BY_THE_MUG, "not to be touched"),
        ((), BY_THE_MUG | PUSHED, "would be next to the mug"),
        ((), PUSHED, "you said that it is to stay"),
    ],
)
def test_a_denied_place_forbids_after_what_is_touched_and_before_what_is_moved(
    commands, ends, problem
):
    one = tried(SPARING, PUSH, FOUND, commands=commands, **ends)
    denying = replace(one.linked, denied=(DeniedPlace("beside", ("mug_1",)),))
    forbidden = problem_of(replace(one, linked=denying))
    assert forbidden is not None and problem in forbidden.text


def test_what_is_too_large_is_said_before_everything_and_without_an_end():
    text, body = "put the pumpkin in the mug without touching the vase", "put_on(m1, m2)"
    for one in (tried(text, body, FOUND, commands=(UPON_THE_VASE,), **PUSHED), endless(text, body)):
        problem = problem_of(one)
        assert problem is not None and "too large" in problem.text


def test_of_what_comes_to_no_end_the_check_alone_tells():
    text = "make sure nothing touches the vase"
    assert problem_of(endless(text, "touch(m1)", FOUND)) is FOUND
    assert problem_of(endless(text, "touch(m1)")) is None
    assert not mistaken(endless(text, "touch(m1)"))
    assert mistaken(tried(text, "touch(m1)"))


@pytest.mark.parametrize(
    ("text", "found", "problem", "wrong"),
    [
        ("knock the bottle over", (), "would not fall over", False),
        ("knock the bottle over", (FOUND,), "the check found it", False),
        ("boop the bottle", (), "", True),
        ("boop the bottle", (FOUND,), "the check found it", True),
    ],
)
def test_what_does_not_fall_is_a_problem_where_it_was_to_fall_and_else_a_mistake(
    text, found, problem, wrong
):
    one = tried(text, "topple(m1, 0)", *found)
    forbidden = problem_of(one)
    assert problem in (forbidden.text if forbidden else "") and bool(forbidden) is bool(problem)
    assert mistaken(one) is wrong


@pytest.mark.parametrize(
    ("found", "ends", "wrong"),
    [
        ((), PUSHED, True), ((FOUND,), PUSHED, False), ((), PUSHED | OFF_THE_TABLE, False),
        ((), {"vase_1": {"on": "mug_1"}}, False),
    ],
)  # fmt: skip
def test_what_a_problem_keeps_from_ending_upon_something_is_no_mistake(found, ends, wrong):
    assert mistaken(tried("put the vase on the mug", "put_on(m1, m2)", *found, **ends)) is wrong


CORNERS = [Command("move", x, y, 0.3, 0.0, False) for x, y in ((0, 0), (0.2, 0), (0, 0.2), (0, 0))]


@pytest.mark.parametrize(
    ("text", "body", "commands", "ends", "wrong"),
    [
        ("put the mug next to the vase", "put(m2, [0, 0])", (), PUSHED, True),
        ("put the mug next to the vase", "put(m1, [0, 0])", (), {"mug_1": {"x": 0.0}}, False),
        ("tap the vase no times", "for one in range(0):\n    touch(m1)", (), {}, True),
        ("tap the vase", "touch(m1)", (UPON_THE_VASE,), {}, False),
        (
            "make a triangle with the vase, the mug and the bottle",
            "put_each([m1, m2], outline(m3, 0.5, 3, 2))",
            (),
            PUSHED,
            True,
        ),
        (
            "make a triangle with the vase, the mug and the bottle",
            'put_each([m1, m2], in_v([m1, m2]))\nput(m3, edge(m3, "left"))',
            (),
            PUSHED,
            True,
        ),
        (
            "make a triangle with the vase, the mug and the bottle",
            "put_each([m1, m2, m3], in_shape([m1, m2, m3], 3))",
            (),
            PUSHED,
            False,
        ),
        ("make a triangle with the vase", "put_each(m1, in_shape(m1, 3))", (), PUSHED, True),
        ("draw a square above the vase", "trace([], 0.3)", CORNERS, {}, True),
        ("draw a triangle above the vase", "trace([], 0.3)", CORNERS, {}, False),
    ],
)
def test_the_landmark_moved_nothing_done_and_another_figure_are_mistakes(
    text, body, commands, ends, wrong
):
    assert mistaken(tried(text, body, commands=commands, **ends)) is wrong

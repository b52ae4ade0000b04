"""Postconditions: what each predicate says of two scenes and a path, and what it does not."""

from __future__ import annotations

import math

import msgspec
import pytest

from agent.messages import Command
from evals.postconditions import PREDICATES, Malformed, holds
from evals.world import World
from scene.types import Scene, SceneObject


def thing(name: str, x: float, y: float, **other) -> SceneObject:
    sizes = {"width": 0.2, "height": 0.2, "tall": 0.3}
    return SceneObject(id=f"{name}_1", name=name, x=x, y=y, **{**sizes, **other})


def move(x: float, y: float, z: float) -> Command:
    return Command("move", x, y, z, 0.0, False)


def world(before: list[SceneObject], after: list[SceneObject], path=()) -> World:
    return World(Scene(objects=tuple(before)), Scene(objects=tuple(after)), tuple(path))


def still(*things: SceneObject, path=()) -> World:
    return world(list(things), list(things), path)


TRIO = still(thing("apple", -0.6, 0), thing("cup", 0, 0), thing("box", 0.6, 0.0))
SIDE = still(
    thing("apple", -0.6, 0), thing("cup", -0.3, 0), thing("box", 0.6, 0.0),
    thing("lid", -0.3, 0.2, z=0.3, on="cup_1"),
)  # fmt: skip
CORNER = still(thing("apple", -0.85, 0.85), thing("cup", 0.85, -0.85))


@pytest.mark.parametrize(
    ("scene", "line", "truth"),
    [
        (TRIO, "left_of apple cup", True),
        (TRIO, "right_of apple cup", False),
        (TRIO, "not right_of apple cup", True),
        (SIDE, "in_groups apple cup : box", True),
        (SIDE, "in_groups apple box : cup", False),
        (TRIO, "between cup apple box", True),
        (TRIO, "midway cup apple box", True),
        (TRIO, "between apple cup box", False),
        (TRIO, "row apple cup box", True),
        (TRIO, "column apple cup box", False),
        (TRIO, "ordered right apple cup box", True),
        (TRIO, "ordered left apple cup box", False),
        (TRIO, "equal_gaps apple cup box", True),
        (TRIO, "gap apple cup 0.39 0.41", True),
        (TRIO, "gap apple cup 0 0.3", False),
        (TRIO, "distance apple cup 0.6", True),
        (TRIO, "closer apple cup box", True),
        (TRIO, "mirrored apple box", True),
        (TRIO, "centred cup", True),
        (TRIO, "in_half apple left", True),
        (TRIO, "in_half cup left", False),
        (TRIO, "next_to_any cup apple box", False),
        (SIDE, "next_to_any cup box apple", True),
        (SIDE, "diagonal_of lid apple right above", True),
        (SIDE, "diagonal_of lid apple left above", False),
        (SIDE, "diagonal_of cup apple right above", False),
        (SIDE, "on_any lid cup box", True),
        (SIDE, "on_any lid apple box", False),
        (CORNER, "in_corner apple left above", True),
        (CORNER, "in_corner cup left above", False),
        (CORNER, "at_edge cup below", True),
        (CORNER, "mirrored apple cup", True),
    ],
)
def test_where_things_are(scene, line, truth):
    assert holds(line, scene) is truth


def test_what_moved_and_what_did_not():
    apple, cup = thing("apple", 0, 0), thing("cup", 0.5, 0.5)
    pushed = world([apple, cup], [thing("apple", 0.3, 0), cup])
    for line in ("moved_by apple 0.3 0", "moved apple right", "still cup", "only apple"):
        assert holds(line, pushed), line
    for line in ("still apple", "only cup", "moved apple left", "moved apple above"):
        assert not holds(line, pushed), line


@pytest.mark.parametrize(
    ("upright", "aside", "truth"),
    [(True, 0.05, True), (True, 0.06, False), (False, 0.06, True), (False, 0.13, False)],
)
def test_what_fell_over_may_have_rolled_a_little_aside(upright, aside, truth):
    bottle = thing("bottle", 0, 0)
    now = world([bottle], [thing("bottle", aside, 0.38, upright=upright)])
    assert holds("moved bottle above", now) is truth


def test_lying_held_fallen_turned():
    apple, cup = thing("apple", 0, 0), thing("cup", 0.5, 0.5)
    fallen = world(
        [apple, cup],
        [thing("apple", 1.2, 0, on="floor"), thing("cup", 0.5, 0.5, upright=False, r=math.pi / 2)],
    )
    for line in ("off_table apple", "off_side apple right", "toppled cup", "turned cup 1.571"):
        assert holds(line, fallen), line
    assert not holds("off_side apple left", fallen)
    lifted = msgspec.structs.replace(apple, held=True, on="gripper", z=0.5)
    assert holds("held apple", world([apple], [lifted]))
    assert not holds("nothing_held", world([apple], [lifted]))


def test_where_the_tool_went():
    apple, cup = thing("apple", 0, 0), thing("cup", 0.5, 0.5)
    path = [move(0, 0, 0.9), move(0, 0, 0.3), move(0, 0, 0.9), move(0.5, 0.5, 0.9)]
    seen = still(apple, cup, path=path)
    for line in (
        "touches apple",
        "visits_above cup",
        "tool_ends_above cup",
        "tool_ends_at 0.5 0.5",
    ):
        assert holds(line, seen), line
    assert not holds("touches cup", seen)


def test_circles_and_shapes():
    apple = thing("apple", 0, 0)
    ring = [math.tau * step / 12 for step in range(13)]
    round_it = [move(0.4 * math.cos(angle), 0.4 * math.sin(angle), 0.1) for angle in ring]
    assert holds("circles apple", still(apple, path=round_it))
    assert not holds("circles apple 2", still(apple, path=round_it))
    assert not holds("circles apple", still(apple, path=round_it[:7]))
    coming = [move(0, -1.2, 0.9), *reversed(round_it)]  # what comes before takes nothing away
    assert holds("circles apple", still(apple, path=coming))
    square = [move(x, y, 0.05) for x, y in ((0, 0), (0.5, 0), (0.5, 0.5), (0, 0.5), (0, 0))]
    assert holds("traces 4", still(apple, path=square))
    assert not holds("traces 4", still(apple, path=square[:-1]))


def test_the_tool_leaves_the_table_but_for_where_it_waits():
    there, aside, off = ((move(0.0, y, 1.2),) for y in (-0.5, -1.2, -1.1))
    assert holds("stays_on_table", still(path=there + aside + there))
    assert not holds("stays_on_table", still(path=there + off + there))


@pytest.mark.parametrize(
    "line", ["", "not", "inside apple", "left_of apple", "left_of apple pear", "gap apple cup a b"]
)
def test_a_line_that_says_nothing_is_an_error_never_false(line):
    with pytest.raises(Malformed):
        holds(line, TRIO)


def test_every_predicate_has_a_plain_name():
    assert all(name.replace("_", "").isalpha() for name in PREDICATES)


def test_a_gap_between_two_numbers_is_between_them_and_one_that_is_a_number_about_it():
    apart = still(thing("cup", 0.0, 0.0), thing("box", 0.31, 0.0))
    assert holds("gap cup box 0.1 0.2", apart) and not holds("gap cup box 0.12 0.2", apart)
    assert holds("gap cup box 0.12 0.12", apart) and not holds("gap cup box 0.14 0.14", apart)

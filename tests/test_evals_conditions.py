"""What may be asked of the scene before a program runs, and of the path that the tool takes."""

from __future__ import annotations

import math

import pytest

from agent.messages import Command
from evals.postconditions import holds
from evals.world import World
from scene.types import Scene, SceneObject

APPLE = SceneObject(id="apple_1", name="apple", x=-0.5, y=0.0, width=0.3, height=0.2, tall=0.3)
CUP = SceneObject(id="cup_1", name="cup", x=0.4, y=0.3, width=0.2, height=0.2, tall=0.4)


def at(x: float, y: float, z: float, grip: bool = False) -> Command:
    return Command("move", x, y, z, 0.0, grip)


def suck(on: bool, x: float, y: float, z: float) -> Command:
    return Command("grip", x, y, z, 0.0, on)


def world(*path: Command, after: tuple[SceneObject, ...] = (APPLE, CUP)) -> World:
    return World(Scene(objects=(APPLE, CUP)), Scene(objects=after), path)


def carried(x: float, y: float, z: float = 0.3) -> World:
    """The tool takes the apple to a place and lets go there."""
    return world(suck(True, -0.5, 0.0, 0.3), at(x, y, 0.9, True), suck(False, x, y, z))


# --- conditions ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("line", "true"),
    [
        ("taller cup apple", True),
        ("wider cup apple", False),
        ("x_less apple cup", True),
        ("y_less cup apple", False),
        ("x_negative apple", True),
        ("x_negative cup", False),
    ],
)
def test_a_condition_compares_what_stood_there(line, true):
    assert holds(line, world()) is true


def test_a_lane_is_free_when_nothing_stands_in_the_strip_ahead():
    assert holds("lane apple left", world())
    assert holds("lane apple right", world())  # the cup stands further away from the person
    assert holds("lane cup below", world())
    near = SceneObject(id="cup_1", name="cup", x=0.4, y=0.2, width=0.2, height=0.2, tall=0.4)
    blocked = World(Scene(objects=(APPLE, near)), Scene(objects=(APPLE, near)), ())
    assert not holds("lane apple right", blocked)


def test_room_is_a_free_place_on_the_table_wherever_something_is_let_go():
    assert holds("room", carried(0.0, -0.5))
    assert holds("room", carried(-0.5, 0.0))  # its own place
    assert not holds("room", carried(0.9, -0.5))  # its edge would be over the table's
    assert not holds("room", carried(0.3, 0.3))  # there stands the cup
    assert holds("room", carried(0.4, 0.3, 0.7))  # on top of the cup


def test_a_conditional_line_counts_only_where_its_condition_was_true():
    assert holds("if x_less cup apple then held apple", world())
    assert not holds("if x_less apple cup then held apple", world())
    assert holds("if not x_less cup apple then still apple", world())


# --- the path ----------------------------------------------------------------------------------


def test_a_touch_is_a_stop_on_the_upper_side_and_is_counted():
    once = [at(-0.5, 0.0, 0.9), at(-0.5, 0.0, 0.3), at(-0.5, 0.0, 0.9)]
    assert holds("touches apple", world(*once))
    assert not holds("touches apple 2", world(*once))
    assert holds("touches apple 2", world(*once, *once))
    assert not holds("touches cup", world(*once))


def test_a_side_is_touched_by_the_rim_of_the_tool():
    assert holds("touches_side apple left", world(at(-0.69, 0.0, 0.15)))
    assert not holds("touches_side apple left", world(at(-0.75, 0.0, 0.15)))
    assert not holds("touches_side apple right", world(at(-0.69, 0.0, 0.15)))


def test_lifted_needs_suction_and_height():
    held = [suck(True, -0.5, 0.0, 0.3), at(-0.5, 0.0, 0.9, True)]
    assert holds("lifted apple", world(*held))
    assert not holds("lifted apple", world(held[0]))
    assert not holds("lifted cup", world(*held))


def test_the_tool_may_end_between_two_things():
    assert holds("tool_ends_between apple cup", world(at(-0.05, 0.15, 0.6)))
    assert not holds("tool_ends_between apple cup", world(at(0.4, 0.3, 0.6)))


# --- before and after --------------------------------------------------------------------------


def moved_to(x: float, y: float, on: str = "table") -> World:
    apple = SceneObject(
        id="apple_1", name="apple", x=x, y=y, width=0.3, height=0.2, tall=0.3, on=on
    )
    return world(after=(apple, CUP))


def test_distances_are_compared_with_those_before():
    assert holds("nearer apple cup", moved_to(-0.3, 0.0))
    assert not holds("parted apple cup", moved_to(-0.3, 0.0))
    assert holds("parted apple cup", moved_to(-0.8, 0.0))
    assert holds("halfway apple cup", moved_to(-0.05, 0.15))
    assert holds("halfway_to_side apple left", moved_to(-0.75, 0.0))
    assert not holds("halfway_to_side apple left", moved_to(-0.75, 0.2))
    far = math.dist((-0.5, 0.0), (0.4, 0.3))
    assert holds("times_as_far apple cup 0.5", moved_to(0.4 - far / 2, 0.3))


def test_off_the_nearest_edge_is_the_one_its_centre_was_nearest_to():
    assert holds("off_nearest apple", moved_to(-1.2, 0.0, on="floor"))
    assert not holds("off_nearest apple", moved_to(1.2, 0.0, on="floor"))

"""Motions of the tool: which are the same, and how high they go."""

import math

import pytest
from clarifier_table import TABLE

from agent.check import Checked
from agent.messages import Command
from clarifier.motions import raised, same_way


def went(*points, after=TABLE):
    commands = tuple(Command("move", x, y, z, 0.0, False) for x, y, z in points)
    return Checked("", "manipulate", commands, after)


def ring(x, y, radius, height=0.3, turn=1, times=1):
    steps = [turn * i * math.tau / 12 for i in range(12 * times + 1)]
    low = [(x + radius * math.cos(a), y + radius * math.sin(a), height) for a in steps]
    return ((low[0][0], low[0][1], 1.2), *low, (low[-1][0], low[-1][1], 1.2))


SPONGE = (-0.75, -0.75)


@pytest.mark.parametrize(
    ("text", "other", "same"),
    [
        ("go around the sponge", ring(*SPONGE, 0.2, turn=-1), True),
        ("go around the sponge", ring(*SPONGE, 0.24, height=0.5), True),
        ("go around the sponge clockwise", ring(*SPONGE, 0.2, turn=-1), False),
        ("follow the outline of the sponge", ring(*SPONGE, 0.24), False),
        ("go around the sponge", ring(*SPONGE, 0.2, times=2), False),
        ("go around the sponge", ring(0.75, -0.3, 0.2), False),
    ],
)
def test_round_a_thing_is_the_same_whichever_way(text, other, same):
    assert same_way(went(*ring(*SPONGE, 0.2)), went(*other), TABLE, text) is same


def test_what_moves_something_is_no_motion():
    moved = TABLE.replace(TABLE.get("sponge_1"))
    elsewhere = went(*ring(*SPONGE, 0.2), after=type(TABLE)(objects=TABLE.objects[1:]))
    assert moved == TABLE
    assert not same_way(went(*ring(*SPONGE, 0.2)), elsewhere, TABLE, "go around the sponge")


def test_a_motion_is_raised_above_everything():
    assert raised("trace([[0, 0], [0.3, 0]], 0.1)", TABLE) == "trace([[0, 0], [0.3, 0]], 0.4)"
    assert raised("trace([[0, 0], [0.3, 0]], 0.6)", TABLE) is None
    assert raised("push(m1, [0, 0])\ntrace([[0, 0], [0.3, 0]], 0.1)", TABLE) is None

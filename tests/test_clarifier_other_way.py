"""Going on in a word or two: the other way, again, back."""

import pytest
from clarifier_table import talk, thing

from agent.compose import parts_on, thinking
from agent.messages import Dialog
from agent.turn import run_turn
from clarifier.other_way import OTHER_WAY, reversed_way
from scene.types import Scene

TABLE = Scene(objects=(thing("cup", 0.0, 0.0, size=0.12), thing("plate", 0.6, 0.6)))


@pytest.mark.parametrize(
    ("command", "turned"),
    [
        ("push the cup 3 cm to the right", "push the cup 3 cm to the left"),
        ("put the cup behind the plate", "put the cup in front of the plate"),
        ("turn the cup by 45 degrees", "turn the cup by 45 degrees clockwise"),
        ("turn the cup clockwise", "turn the cup anticlockwise"),
        ("slide the cup away from me", "slide the cup towards me"),
        ("put the cup on the plate", None), ("put the left cup on the right", None),
    ],
)  # fmt: skip
def test_a_command_in_the_opposite_direction(command, turned):
    assert reversed_way(command) == turned


@pytest.mark.parametrize(
    ("text", "is_meant"),
    [
        ("the other way", True), ("no, the other way round please", True),
        ("on the other side", True), ("the other cup", False), ("put it the other way", False),
    ],
)  # fmt: skip
def test_how_the_other_way_is_said(text, is_meant):
    assert bool(OTHER_WAY.match(text)) is is_meant


@pytest.fixture(scope="module")
def mind():
    with thinking() as mind:
        yield mind


@pytest.mark.parametrize(
    ("turns", "x"),
    [
        (("push the cup 3 cm to the right", "again"), 0.3),
        (("push the cup 3 cm to the right", "the other way"), -0.15),
        (("push the cup 3 cm to the right", "and again", "back"), 0.15),
    ],
)
def test_a_word_or_two_go_on_from_what_was_done(mind, turns, x):
    with parts_on(mind, TABLE) as parts:
        dialog = Dialog()
        for say in turns:
            turn, dialog = run_turn(say, dialog, parts)
            assert turn.status == "done", turn.reply
        assert parts.arm.scene().get("cup_1").x == pytest.approx(x, abs=0.02)


def test_nothing_goes_the_other_way_where_nothing_was_done(clarifier):
    assert talk(clarifier, "the other way")[0].do != "act"

"""What waits in the tray: the arm takes it from there, and does nothing else to it where it is."""

import pytest
from clarifier_table import thing, waiting

from agent.compose import parts_on, thinking
from agent.messages import Dialog
from agent.turn import run_turn
from scene.types import Scene

TABLE = Scene(
    objects=(
        thing("cup", -0.6, 0.1), thing("apple", 0.6, 0.4), thing("plate", 0.2, -0.4, size=0.4,
                                                                 tall=0.03),
    ),
    tray=(waiting("sponge"), waiting("can")),
)  # fmt: skip


@pytest.fixture(scope="module")
def mind():
    with thinking() as mind:
        yield mind


@pytest.fixture
def told(mind):
    """Says a sentence on the table: the turn, and the scene after it."""

    def told(text):
        with parts_on(mind, TABLE) as parts:
            turn, _ = run_turn(text, Dialog(), parts)
            return turn, parts.arm.scene()

    return told


@pytest.mark.parametrize(
    ("text", "thing", "on"),
    [
        ("put the sponge on the plate", "sponge_1", "plate_1"),
        ("put the can next to the cup", "can_1", "table"),
        ("pick up the sponge", "sponge_1", "gripper"),
    ],
)
def test_what_waits_is_taken_from_the_tray(told, text, thing, on):
    turn, after = told(text)
    assert turn.status == "done" and after.get(thing).on == on


def test_what_waits_and_what_stands_go_somewhere_in_one_sentence(told):
    turn, after = told("put the can in the middle and the apple left of it")
    can, apple = after.get("can_1"), after.get("apple_1")
    assert turn.status == "done" and can.position == pytest.approx((0, 0), abs=0.02)
    assert apple.x < can.x and abs(apple.y - can.y) < 0.1


@pytest.mark.parametrize(
    "text",
    ["push the sponge to the left", "turn the sponge by 90 degrees", "put the apple on the sponge",
     "put the cup next to the can"],
)  # fmt: skip
def test_nothing_else_is_done_to_what_waits(told, text):
    turn, after = told(text)
    assert turn.status == "refused" and "in the tray" in turn.reply and after == TABLE


def test_what_moves_is_not_what_waits(told):
    turn, after = told("move everything to the left edge")
    assert turn.status == "done" and {item.id for item in after.tray} == {"sponge_1", "can_1"}

"""What a robot's error makes of a turn: refused, or failed."""

import pytest
from test_agent_turn import ACT, FaultyArm, parts

from agent.commands import exit_status
from agent.errors import (
    AlarmError,
    LinkDown,
    MoveTimeout,
    NoReply,
    NotAtTarget,
    NotReady,
    Stopped,
    Unreachable,
)
from agent.messages import Dialog
from agent.turn import run_turn


def under_way(text):
    error = LinkDown(text)
    error.moving = True
    return error


@pytest.mark.parametrize(
    ("error", "at_first", "later"),
    [
        (Unreachable("far"), ("refused", "unreachable"), ("failed", None)),
        (NotReady("not homed"), ("refused", "unsafe"), ("failed", None)),
        (LinkDown("no such port"), ("refused", "unsafe"), ("failed", None)),
        (under_way("lost"), ("failed", None), ("failed", None)),
        (NoReply("outcome unknown"), ("failed", None), ("failed", None)),
        (AlarmError("alarm", (0x50,), "home it"), ("failed", None), ("failed", None)),
        (MoveTimeout("stuck"), ("failed", None), ("failed", None)),
        (NotAtTarget("off"), ("failed", None), ("failed", None)),
        (Stopped("ann"), ("failed", "cancelled"), ("failed", "cancelled")),
    ],
)
def test_every_error_has_its_status(executor, error, at_first, later):
    for steps, expected in ((0, at_first), (1, later)):
        moved = parts(executor, ACT, FaultyArm(steps, error))
        turn, _ = run_turn("pick up the apple", Dialog(), moved)
        assert (turn.status, turn.reason) == expected and str(error) in turn.reply
        assert exit_status(turn) == (5 if isinstance(error, Stopped) else 1)

"""The fuzz of the Dobot's bench finds what gets past the checks, where something does."""

import pytest

from evals import dobot_bench
from robot_bridge.dobot_frames import QUEUED, READ, WRITE, Frame, floats


def ptp(x, y, z, r=0.0, mode=2):
    return Frame(84, QUEUED, bytes((mode,)) + floats(x, y, z, r))


@pytest.mark.parametrize(
    "frame",
    [
        ptp(250, 0, 20), ptp(150, 0, -0.5), ptp(210, 30, 40, 60), Frame(31, QUEUED, bytes(4)),
        Frame(10, READ), Frame(81, WRITE, floats(100, 100, 80, 80)), Frame(62, WRITE, bytes(2)),
    ],
)  # fmt: skip
def test_what_the_driver_sends_is_not_outside(frame):
    assert not dobot_bench.outside(frame)


@pytest.mark.parametrize(
    "frame",
    [
        ptp(400, 0, 0), ptp(60, 0, 0), ptp(250, 0, -80), ptp(250, 0, 20, 120), ptp(-200, 0, 20),
        ptp(250, 0, 20, mode=1), ptp(float("nan"), 0, 0), Frame(73, WRITE, bytes((0, 1))),
        Frame(91, QUEUED, bytes(17)), Frame(31, WRITE, bytes(4)),
        Frame(81, WRITE, floats(101, 100, 80, 80)), Frame(83, WRITE, floats(100, 200)),
    ],
)  # fmt: skip
def test_what_it_must_not_send_is(frame):
    assert dobot_bench.outside(frame)


def test_nothing_gets_past_and_without_the_guard_something_does(monkeypatch):
    kept = dobot_bench._fuzz(1.0)["dobot_outside_reaching"]
    assert kept.value == 0 and kept.n > 100
    monkeypatch.setattr("robot_bridge.dobot.admit", lambda frame, limits: None)
    assert dobot_bench._fuzz(1.0)["dobot_outside_reaching"].value > 0


def test_forward_undoes_inverse():
    assert dobot_bench._inverse(2000).met

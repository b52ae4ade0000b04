"""What goes out to the arm: every kind of frame that must not is refused, whoever sends it."""

import math
import struct

import pytest
from dobot_world import BOUNDS, linked

from agent.errors import RobotError
from robot_bridge import dobot_frames as ids
from robot_bridge.dobot_frames import QUEUED, READ, WRITE, Frame, floats
from robot_bridge.dobot_guard import admit


def ptp(x, y, z, r=0.0, mode=2, ctrl=QUEUED):
    return Frame(ids.PTP, ctrl, bytes((mode,)) + floats(x, y, z, r))


@pytest.mark.parametrize(
    "frame",
    [
        ptp(250, 0, 20), ptp(250, 0, -68), Frame(ids.HOME, QUEUED, bytes(4)), Frame(ids.CP, READ),
        Frame(ids.PTP_COORDINATE, WRITE, floats(300, 300, 400, 400)),
        Frame(ids.PTP_COMMON, WRITE, floats(100, 100)), Frame(ids.TOOL, WRITE, floats(59.7, 0, 0)),
        Frame(ids.SUCTION, QUEUED, bytes((1, 1))), Frame(ids.FORCE_STOP, WRITE),
    ],
)  # fmt: skip
def test_what_may_go_out_does(frame):
    admit(frame, BOUNDS)


@pytest.mark.parametrize(
    ("frame", "words"),
    [
        (ptp(400, 0, 0), "farther"), (ptp(250, 0, -69), "below the table"),
        (ptp(250, 0, 20, 150), "joint 4"), (ptp(math.nan, 0, 0), "finite"),
        (ptp(0, 0, math.inf), "finite"), (ptp(250, 0, 20, mode=1), "straight"),
        (ptp(250, 0, 20, ctrl=WRITE), "straight"), (Frame(ids.PTP, QUEUED, bytes(3)), "straight"),
        (Frame(ids.JOG, WRITE, bytes((0, 1))), "past the check"),
        (Frame(ids.CP, QUEUED, bytes(17)), "past the check"),
        (Frame(ids.HOME, WRITE, bytes(4)), "past the check"),
        (Frame(ids.TOOL, WRITE, floats(70, 0, 0)), "another tool"),
        (Frame(ids.PTP_COORDINATE, WRITE, floats(301, 100, 100, 100)), "beyond"),
        (Frame(ids.PTP_COORDINATE, QUEUED, floats(100, 100, 100, math.nan)), "beyond"),
        (Frame(ids.PTP_COORDINATE, WRITE, floats(100)), "4 numbers"),
        (Frame(ids.PTP_COMMON, WRITE, floats(101, 100)), "beyond"),
        (Frame(ids.PTP_JOINT, WRITE, floats(*[201] * 8)), "beyond"),
    ],
)  # fmt: skip
def test_what_must_not_does_not(frame, words):
    with pytest.raises(RobotError, match=words):
        admit(frame, BOUNDS)


def test_every_way_out_of_the_link_is_guarded():
    outside = floats(400, 0, 0, 0)
    with linked() as (emulator, link):
        ways = [
            lambda: link.queue(ids.PTP, b"\x02" + outside),
            lambda: link.set(ids.PTP, b"\x02" + outside),
            lambda: link.urgent(ids.PTP, b"\x02" + outside),
            lambda: link.urgent(ids.JOG, bytes((0, 1))),
            lambda: link._set_cp_cmd(400, 0, 0),
            lambda: link._set_ptp_coordinate_params(400, 400),
            lambda: link._set_ptp_joint_params(*[500] * 8),
            lambda: link.queue(ids.CP, struct.pack("<B4f", 1, 0, 0, 0, 0)),
        ]
        for way in ways:
            with pytest.raises(RobotError):
                way()
        written = {frame.id for frame in emulator.controller.seen if frame.ctrl != READ}
        assert written == set()

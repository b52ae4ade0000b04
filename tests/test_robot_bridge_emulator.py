"""The emulated controller: queue, numbers, alarms, motion, and the faults by their names."""

import math
import os
import struct

import pytest

from agent.errors import ConfigError
from robot_bridge import dobot_frames as ids
from robot_bridge.dobot_alarms import codes
from robot_bridge.dobot_frames import QUEUED, READ, WRITE, Frame, encode, floats, read_floats, take
from robot_bridge.emulated import Controller
from robot_bridge.emulated_motion import travelled
from robot_bridge.emulator import Emulator
from robot_bridge.faults import Faults, read


class Bench:
    """A controller whose clock stands still until the test moves it."""

    def __init__(self, **faults):
        self.now = 0.0
        self.faults = Faults(**faults)
        self.controller = Controller(self.faults, 0.0)
        self.tell(ids.TOOL, floats(59.7, 0, 0))

    def ask(self, command, params=b""):
        return self.controller.receive(Frame(command, READ, params), self.now).params

    def tell(self, command, params=b""):
        return self.controller.receive(Frame(command, WRITE, params), self.now)

    def queue(self, command, params):
        (number,) = struct.unpack(
            "<Q", self.controller.receive(Frame(command, QUEUED, params), self.now).params
        )
        return number

    def line(self, x, y, z=0.0, r=0.0, mode=2):
        return self.queue(ids.PTP, bytes((mode,)) + floats(x, y, z, r))

    def after(self, seconds):
        self.now += seconds
        self.controller.advance(self.now)

    def finished(self):
        return int.from_bytes(self.ask(ids.INDEX), "little")

    def pose(self):
        return read_floats(self.ask(ids.POSE))

    def alarms(self):
        return codes(self.ask(ids.ALARMS))


def test_a_straight_motion_ends_at_its_target_and_then_its_number_is_told():
    bench = Bench()
    number = bench.line(250, 50)
    bench.after(0.3)
    assert bench.finished() < number and bench.controller.moving
    bench.after(10)
    assert bench.finished() == number
    assert bench.pose()[:3] == pytest.approx((250, 50, 0), abs=1e-4)
    j1, j2, j3, _ = bench.pose()[4:]
    radius = 135 * math.sin(math.radians(j2)) + 147 * math.cos(math.radians(j3)) + 59.7
    assert radius == pytest.approx(math.hypot(250, 50), abs=1e-3)
    assert j1 == pytest.approx(math.degrees(math.atan2(50, 250)), abs=1e-4)


def test_a_motion_takes_the_time_of_its_trapezoid():
    bench = Bench()
    bench.tell(ids.PTP_COORDINATE, floats(100, 100, 200, 200))
    bench.tell(ids.PTP_COMMON, floats(100, 100))
    bench.line(210, 130, 40)  # 100 mm at 100 mm/s and 200 mm/s²: 1.5 s
    bench.after(1.49)
    assert bench.controller.moving
    bench.after(0.02)
    assert not bench.controller.moving
    assert travelled(100, 100, 200, 0.75) == pytest.approx(50)


@pytest.mark.parametrize(
    ("mode", "values", "goal"),
    [
        (0, (230, 0, 20, 0), (230, 0, 20)), (1, (230, 0, 20, 0), (230, 0, 20)),
        (7, (10, -30, -5, 0), (220, 0, 35)), (8, (10, -30, -5, 0), (220, 0, 35)),
        (4, (0, 30, 30, 0), (254.5, 0, 43.4)), (5, (0, 30, 30, 0), (254.5, 0, 43.4)),
    ],
)  # fmt: skip
def test_every_mode_has_its_goal(mode, values, goal):
    bench = Bench()
    bench.line(*values, mode=mode)
    bench.after(20)
    assert bench.pose()[:3] == pytest.approx(goal, abs=0.1) and not bench.alarms()


def test_joints_are_turned_by_increments_too():
    bench = Bench()
    before = bench.pose()[4:]
    bench.line(5, 3, -2, 1, mode=6)
    bench.after(20)
    assert bench.pose()[4:] == pytest.approx(
        [a + b for a, b in zip(before, (5, 3, -2, 1), strict=True)]
    )


def test_what_is_out_of_reach_raises_an_alarm_and_is_called_done():
    bench = Bench()
    before = bench.pose()
    number = bench.line(400, 0)
    bench.after(1)
    assert bench.alarms() == (0x11,) and bench.finished() == number and bench.pose() == before
    assert bench.line(250, 0) == number + 1
    bench.after(5)
    assert bench.finished() == number + 1 and bench.pose() == before  # skipped, and called done
    bench.tell(ids.ALARMS)
    assert bench.alarms() == ()


def test_a_joint_limit_is_another_alarm_and_one_on_the_way_a_third():
    bench = Bench()
    bench.line(210, 30, 40, 150)
    bench.after(1)
    assert bench.alarms() == (0x12,)
    bench.tell(ids.ALARMS)
    bench.line(60, 240, -50)
    bench.after(20)
    assert bench.alarms() == ()
    bench.line(60, -240, -50)
    bench.after(20)
    assert bench.alarms() in ((0x21,), (0x22,)) and 0 < bench.pose()[1] < 240


def test_an_alarm_may_hold_the_queue_and_let_it_go_on_when_cleared():
    bench = Bench(under_alarm="holds")
    bench.line(400, 0)
    bench.line(250, 0)
    bench.after(5)
    assert bench.finished() == 1
    bench.tell(ids.ALARMS)
    bench.after(5)
    assert bench.finished() == 2


def test_an_alarm_may_stay():
    bench = Bench(reassert=True)
    bench.line(400, 0)
    bench.tell(ids.ALARMS)
    assert bench.alarms() == (0x11,)


def test_stop_lets_what_is_under_way_end_and_force_stop_does_not():
    bench = Bench()
    bench.line(250, 50)
    bench.line(250, -50)
    bench.after(0.2)
    bench.tell(ids.STOP)
    bench.after(20)
    assert bench.finished() == 1
    bench.tell(ids.START)
    bench.after(0.2)
    bench.tell(ids.FORCE_STOP)
    at = bench.pose()
    bench.after(20)
    assert bench.pose() == at and -50 < at[1] < 50 and bench.finished() == 1
    assert [made.whole for made in bench.controller.made] == [True, False]


def test_a_full_queue_loses_what_comes():
    bench = Bench(capacity=2)
    assert int.from_bytes(bench.ask(ids.LEFT_SPACE), "little") == 2
    numbers = [bench.line(250, y) for y in (10, 20, 30, 40, 50)]
    assert int.from_bytes(bench.ask(ids.LEFT_SPACE), "little") == 0
    bench.after(60)
    assert len(bench.controller.made) == 3 and len(set(numbers)) == 4


@pytest.mark.parametrize("first", [0, 1, 2])
@pytest.mark.parametrize("zeroed", [False, True])
def test_numbers_begin_and_go_on_as_they_may(first, zeroed):
    bench = Bench(first=first, zeroed=zeroed)
    assert [bench.line(250, 0), bench.line(250, 1)] == [first, first + 1]
    bench.after(20)
    bench.tell(ids.CLEAR)
    assert bench.finished() == (0 if zeroed else first + 1)
    assert bench.line(250, 2) == (first if zeroed else first + 2)


@pytest.mark.parametrize(("busy", "told"), [("right", 1), ("low", 0), ("ones", 2**64 - 1)])
def test_246_may_lie_while_the_arm_moves(busy, told):
    bench = Bench(busy=busy)
    bench.line(250, 0)
    bench.after(20)
    bench.line(250, 60)
    bench.after(0.1)
    assert bench.finished() == told
    bench.after(20)
    assert bench.finished() == 2


@pytest.mark.parametrize("size", [4, 8])
def test_247_answers_in_four_bytes_or_eight(size):
    assert len(Bench(left=size).ask(ids.LEFT_SPACE)) == size


def test_the_pump_runs_on_after_a_release_until_it_is_switched_off():
    bench = Bench()
    bench.queue(ids.SUCTION, bytes((1, 1)))
    assert bench.controller.pump
    bench.queue(ids.SUCTION, bytes((1, 0)))
    assert bench.controller.pump and bench.ask(ids.SUCTION) == bytes((1, 0))
    bench.tell(ids.SUCTION, bytes(2))
    assert not bench.controller.pump


def test_homing_ends_where_it_was_told_and_power_on_forgets_it():
    bench = Bench()
    bench.tell(ids.HOME_PARAMS, floats(200, 0, 10, 0))
    bench.queue(ids.HOME, bytes(4))
    bench.after(10)
    assert not bench.controller.homed
    bench.after(20)
    assert bench.controller.homed and bench.pose()[:3] == pytest.approx((200, 0, 10))
    bench.controller.switch_on(bench.now)
    assert not bench.controller.homed and bench.finished() == 0


def test_a_wait_waits_and_a_jog_goes_on_until_it_is_stopped():
    bench = Bench()
    number = bench.queue(ids.WAIT, struct.pack("<I", 500))
    bench.after(0.4)
    assert bench.finished() < number
    bench.after(0.2)
    assert bench.finished() == number
    bench.tell(ids.JOG, bytes((0, 3)))
    bench.after(0.5)
    bench.tell(ids.FORCE_STOP)
    assert bench.pose()[1] > 31


def test_inputs_and_outputs_and_other_settings_are_kept():
    bench = Bench()
    bench.tell(ids.IO, bytes((4, 1)))
    assert bench.ask(ids.IO, bytes((4,))) == bytes((4, 1))
    for command in (0, 1, 2, 30, 60, 61, 62, 63, 70, 71, 72, 80, 81, 82, 83, 90):
        assert bench.ask(command)


@pytest.mark.parametrize("command", [21, 11, 99, 255])
def test_what_it_does_not_know_it_does_not_answer(command):
    controller = Controller(Faults(), 0.0)
    for ctrl in (READ, WRITE, QUEUED):
        assert controller.receive(Frame(command, ctrl), 0.0) is None


# --- on the line -------------------------------------------------------------------------------


def answer(emulator, data, size=64):
    line = os.open(emulator.port, os.O_RDWR | os.O_NOCTTY)
    try:
        os.write(line, data)
        return os.read(line, size)
    finally:
        os.close(line)


def test_a_bad_frame_is_dropped_silently_and_the_next_is_answered():
    with Emulator() as emulator:
        bad = encode(Frame(ids.NAME))[:-1] + b"\x00"
        frame, rest = take(answer(emulator, bad + encode(Frame(ids.VERSION))))
        assert frame == Frame(ids.VERSION, 0, bytes((3, 7, 0))) and rest == b""


def test_the_port_link_follows_the_port(tmp_path):
    link = tmp_path / "port"
    with Emulator(link=link) as emulator:
        assert str(link.readlink()) == emulator.port
        emulator.unplug()
        assert not link.exists() and not emulator.plugged
        emulator.plug()
        assert str(link.readlink()) == emulator.port
    assert not link.is_symlink()


# --- faults by their names ---------------------------------------------------------------------


def test_faults_are_read_as_the_command_line_has_them():
    faults = read(["bad-sum=3", "frozen", "unplug-at=0.25", "slow", "busy=low", "left", "dropped"])
    assert (faults.bad_sum, faults.frozen, faults.unplug_at, faults.slow) == (3, True, 0.25, 0.3)
    assert (faults.busy, faults.left, faults.dropped) == ("low", 8, 1)


@pytest.mark.parametrize(
    ("text", "message"),
    [("bad-som", "did you mean bad_sum"), ("zzz", "known: "), ("busy=never", "fault busy"),
     ("dropped=many", "fault dropped")],
)  # fmt: skip
def test_a_fault_that_is_none_is_refused(text, message):
    with pytest.raises(ConfigError, match=message):
        read([text])

"""The defects of stock pydobot 1.3.2 (docs/dobot.md), each shown, and ours without it.

Stock runs in a process of its own, which is given up after some seconds; both meet one emulator.
"""

import contextlib
import os
import struct
import subprocess
import sys
import threading
import tty

import pytest
import serial
from dobot_world import BOUNDS, STOCK, linked, stock, until

from agent.errors import LinkDown, NoReply, NotReady, Unreachable
from robot_bridge import dobot_frames as ids
from robot_bridge.dobot import DobotLink
from robot_bridge.dobot_cell import Millimetres
from robot_bridge.dobot_frames import Frame, checksum, floats
from robot_bridge.emulator import Emulator
from robot_bridge.faults import Faults

READY = "d = made()\nprint('ready', flush=True)\ninput()\n"
LATE = (
    READY
    + """\
d.get_eio(4)
try:
    print(d.pose())
except Exception as error:
    print('failed', error)
"""
)


def spoken(emulator, code, **faults):
    """What stock prints, faults beginning once it is ready; "hang" where it does not end."""
    command = [sys.executable, "-c", STOCK + code, emulator.port]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    ) as process:
        assert process.stdout.readline() == "ready\n"
        for name, value in faults.items():
            setattr(emulator.faults, name, value)
        try:
            return process.communicate("go\n", timeout=4.0)[0]
        except subprocess.TimeoutExpired:
            process.kill()
            return process.communicate()[0] + "hang"


def swallowed():
    """A target whose checksum stock gets wrong (255 or 0), to which the arm can go."""
    for tenth in range(3000):
        x = 220 + tenth / 100
        params = bytes((2,)) + floats(x, 20, 40, 0)
        if checksum(bytes((ids.PTP, 3)) + params) in (255, 0):
            return x
    raise AssertionError("no such target")


def moved(emulator):
    with emulator.lock:
        return [made.goal.x for made in emulator.controller.made if made.id == ids.PTP]


def test_1_one_move_in_132_vanishes():
    x = swallowed()
    with Emulator(speed=40.0) as emulator:
        told, _ = stock(emulator, f"d = made(); d.move_to({x}, 20, 40, 0); time.sleep(0.5)\n")
        assert told == "ok" and moved(emulator) == []
    with linked() as (emulator, link):
        link.line_to(Millimetres(x, 20, 40, 0))
        until(lambda: moved(emulator))


def test_2_noise_becomes_a_pose():
    with Emulator() as emulator:
        assert "(210.0, 30.0, 40.0" not in spoken(emulator, READY + "print(d.pose())\n", garbage=1)
    with linked() as (emulator, link):
        emulator.faults.garbage = 1
        assert link.pose() == (210.0, 30.0, 40.0, 0.0)


def test_2_a_late_reply_shifts_all_that_follow():
    with Emulator() as emulator:
        told = spoken(emulator, LATE, late=1, delay=0.3)
        assert "(210.0, 30.0, 40.0" not in told
    with linked() as (emulator, link):
        emulator.faults.late, emulator.faults.delay = 1, 0.3
        assert link.firmware() == "3.7.0"
        assert link.pose() == (210.0, 30.0, 40.0, 0.0)


def test_3_a_reply_with_a_wrong_sum_is_believed():
    with Emulator() as emulator:
        assert "(210.0, 30.0, 40.0" in spoken(emulator, READY + "print(d.pose())\n", bad_sum=1)
    with linked() as (emulator, link):
        emulator.faults.bad_sum = 1
        before = len(emulator.controller.seen)
        assert link.pose() == (210.0, 30.0, 40.0, 0.0)
        assert len(emulator.controller.seen) == before + 2  # asked again


def test_4_after_an_error_the_next_call_hangs():
    code = (
        READY + "d.ser.read_all = lambda: b'\\xaa'\n"
        "try:\n    d.pose()\nexcept IndexError:\n    print('error', flush=True)\n"
        "d.close()\nprint('closed')\n"
    )
    with Emulator() as emulator:
        told = spoken(emulator, code)
        assert "error" in told and "closed" not in told and "hang" in told
    with linked() as (emulator, link):
        emulator.unplug()
        with pytest.raises(LinkDown):
            link.pose()
        assert not link.lock.locked()
        link.close()


def test_5_to_wait_for_a_motion_that_never_ends_takes_forever():
    with Emulator(Faults(frozen=True), 40.0) as emulator:
        code = "made().move_to(250, 0, 20, 0, wait=True)\n"
        assert stock(emulator, code, patience=5.0)[0] == "hang"


def test_5_of_two_who_wait_one_hangs_though_both_motions_were_made():
    code = (
        "d = made()\nd.wait(40000)\n"
        "move = threading.Thread(target=d.move_to, args=(250, 0, 20, 0, True))\n"
        "move.start()\nd.move_to(250, 0, 20, 0, True)\nmove.join()\n"
    )
    with Emulator(speed=20.0) as emulator:
        assert stock(emulator, code, patience=7.0)[0] == "hang"
        assert len(moved(emulator)) == 2


def test_6_a_point_out_of_reach_succeeds():
    with Emulator(speed=40.0) as emulator:
        told, _ = stock(emulator, "made().move_to(400, 0, 0, 0, wait=True)\n")
        assert told == "ok" and emulator.controller.alarms == {0x11}
    with linked() as (emulator, link):
        with pytest.raises(Unreachable):
            link.line_to(Millimetres(400, 0, 0, 0))
        assert ids.PTP not in {frame.id for frame in emulator.controller.seen}


def test_7_moves_are_lost_where_the_queue_is_full():
    code = "d = made()\nfor y in range(8): d.move_to(250, y, 20, 0)\ntime.sleep(0.5)\n"
    with Emulator(Faults(capacity=2, slow=0.05), 2.0) as emulator:
        assert stock(emulator, code)[0] == "ok"
        sent = [frame for frame in emulator.controller.seen if frame.id == ids.PTP]
        settings, under_way, queued = 4, 1, 2
        assert len(sent) == 8
        assert emulator.controller._next - 1 == settings + under_way + queued
    with linked(Faults(capacity=0)) as (emulator, link):
        with pytest.raises(NotReady, match="full"):
            link.line_to(Millimetres(250, 0, 20, 0))
        assert ids.PTP not in {frame.id for frame in emulator.controller.seen}


def test_8_the_pump_runs_on():
    with Emulator(speed=40.0) as emulator:
        stock(emulator, "d = made(); d.suck(True); d.suck(False); time.sleep(0.2); d.close()\n")
        assert emulator.controller.pump
    with linked() as (emulator, link):
        link.suck(True)
        until(lambda: emulator.controller.pump)
        number = link.suck(False)
        until(lambda: link.finished() == number)
        assert not emulator.controller.pump


def test_9_it_never_homes_clears_alarms_or_sets_the_tool():
    with Emulator() as emulator:
        stock(emulator, "made()\n")
        assert not {ids.HOME, ids.ALARMS, ids.TOOL} & {one.id for one in emulator.controller.seen}


LINES = """\
import serial
seen = []
class Recorder(serial.Serial):
    def _update_dtr_state(self): seen.append(('dtr', self._dtr_state))
    def _update_rts_state(self): seen.append(('rts', self._rts_state))
serial.Serial = pydobot.dobot.serial.Serial = Recorder
made()
print(seen, Recorder)
"""


class Recorder(serial.Serial):
    """A port without modem lines that remembers what they were told to be."""

    def __init__(self):
        self.lines = []
        super().__init__()

    def _update_dtr_state(self):
        self.lines.append(("dtr", self._dtr_state))

    def _update_rts_state(self):
        self.lines.append(("rts", self._rts_state))


def test_10_the_port_is_opened_with_its_lines_high():
    with Emulator() as emulator:
        assert "('dtr', True), ('rts', True)" in stock(emulator, LINES)[1]
    with linked(make=Recorder) as (emulator, link):
        assert link.ser.lines == [("dtr", False), ("rts", False)] and link.ser.exclusive


def test_10_two_may_open_one_port():
    with linked() as (emulator, link):
        assert stock(emulator, "made()\n")[0] == "ok"  # it asks for no lock
        second = type(link)(emulator.port, BOUNDS)
        with pytest.raises(LinkDown, match="another program"):
            second.open()


def test_11_a_speed_is_both_millimetres_and_per_cent():
    def settings(emulator):
        wanted = (ids.PTP_COORDINATE, ids.PTP_COMMON)
        return [emulator.controller.settings[one] for one in wanted]

    with Emulator() as emulator:
        stock(emulator, "made().speed(50, 50); time.sleep(0.1)\n")
        assert settings(emulator) == [floats(50, 50, 50, 50), floats(50, 50)]
    with linked() as (emulator, link):
        link.speed(50, 60)
        assert settings(emulator) == [floats(50, 50, 60, 60), floats(100, 100)]


# --- ours alone --------------------------------------------------------------------------------


def test_nothing_but_a_plan_moves_it():
    with linked() as (emulator, link):
        for move in (link.move_to, link.go):
            with pytest.raises(NotReady, match="approve"):
                move(250, 0, 20, 0)
        with pytest.raises(NotReady):
            link._set_cp_cmd(250, 0, 20)
        with pytest.raises(NotReady):
            link.set(ids.JOG, bytes((0, 1)))
        with pytest.raises(NotReady):
            link.grip(True)
        with pytest.raises(NotReady, match="beyond the limits"):
            link.speed(301, 100)
        assert not ids.MOTIONS & {frame.id for frame in emulator.controller.seen}


def test_pydobots_own_commands_go_over_our_line():
    with linked() as (emulator, link):
        link.set_eio(4, 1)
        assert emulator.controller.io == {4: 1}
        assert link.get_eio(4).params == bytes((4, 1))
        assert link._get_queued_cmd_current_index() == link.finished()


def test_a_queued_command_is_sent_once_whatever_becomes_of_it():
    for fault in ("lost_reply", "dropped", "cut", "bad_sum"):
        with linked(Faults()) as (emulator, link):
            room = struct.pack("<I", 32)
            link.query = lambda *asked, room=room: room
            setattr(emulator.faults, fault, 1)
            with pytest.raises(Exception, match="outcome unknown"):
                link.line_to(Millimetres(250, 0, 20, 0))
            sent = [frame for frame in emulator.controller.seen if frame.id == ids.PTP]
            assert len(sent) == 1, fault


def test_a_reply_of_another_command_is_no_reply():
    with linked() as (emulator, link):
        reply = emulator.controller.receive
        lies = [Frame(ids.INDEX, 0, bytes(32)), Frame(ids.POSE, 1, bytes(32))]
        emulator.controller.receive = lambda frame, now: (
            lies.pop() if frame.id == ids.POSE and lies else reply(frame, now)
        )
        assert link.pose() == (210.0, 30.0, 40.0, 0.0) and not lies


def test_many_threads_ask_at_once_and_each_gets_its_own_answer():
    with linked() as (_emulator, link):
        wrong = []

        def ask():
            for _ in range(30):
                told = link.firmware(), link.pose(), link.alarms()
                wrong.extend([] if told == ("3.7.0", (210, 30, 40, 0), ()) else [told])

        asking = [threading.Thread(target=ask) for _ in range(4)]
        for one in asking:
            one.start()
        for one in asking:
            one.join()
        assert wrong == []


def test_a_device_that_never_stops_talking_is_no_dobot():
    master, slave = os.openpty()
    tty.setraw(slave)
    over = threading.Event()

    def talk():
        while not over.is_set():
            with contextlib.suppress(BlockingIOError):
                os.write(master, b"\xaa\xaa\x20 hello")
            over.wait(0.001)

    os.set_blocking(master, False)
    talking = threading.Thread(target=talk)
    talking.start()
    try:
        link = DobotLink(os.ttyname(slave), BOUNDS)
        link.open()
        with pytest.raises(NoReply):
            link.firmware()
        link.close()
    finally:
        over.set()
        talking.join()
        os.close(master)
        os.close(slave)

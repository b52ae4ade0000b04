"""Figures of the Dobot driver, on its emulator: faults, times, and what gets past its checks.

The goals stand beside each. Stock pydobot's round trip stands beside ours.
"""

from __future__ import annotations

import math
import random
import subprocess
import sys
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress

from agent.config import DobotConfig
from agent.errors import RobotError
from agent.messages import Command
from evals.fault_matrix import Bench, arm, cells, play, there_and_back
from evals.figures import Figure, at_least, at_most, median, times
from robot_bridge import dobot_frames
from robot_bridge.api import approve
from robot_bridge.dobot import DobotLink
from robot_bridge.dobot_cell import JOINTS, Fault, Millimetres, joints_at
from robot_bridge.dobot_frames import Frame, floats, read_floats
from robot_bridge.dobot_guard import bounds
from robot_bridge.emulator import Emulator
from robot_bridge.faults import Faults
from robot_bridge.ideal import IdealRobot
from robot_bridge.kinematics import Joints, forward

FUZZ_S = 60.0
STOCK = """\
import sys, time, pydobot
arm = pydobot.Dobot(sys.argv[1])
for _ in range(int(sys.argv[2])):
    began = time.perf_counter()
    arm.pose()
    print(1000 * (time.perf_counter() - began))
"""


def dobot_figures(matrix: bool = True, fuzz_s: float = FUZZ_S) -> dict[str, Figure]:
    """All of them; ``matrix`` takes some minutes, the rest two and a half."""
    figures = _matrix() if matrix else {}
    return {
        **figures, **_round_trips(), "dobot_stop_ms": _stop(30), **_times(), **_fuzz(fuzz_s),
        "dobot_inverse_mm": _inverse(100_000),
    }  # fmt: skip


def _matrix() -> dict[str, Figure]:
    cases = [play(*cell) for cell in cells()]
    for case in cases:
        if not case.good:
            print(f"fault matrix: {case}", file=sys.stderr)
    good = sum(case.good for case in cases)
    hangs = sum("hang" in case.outcome for case in cases)
    return {
        "dobot_fault_matrix": at_least(good, len(cases), "cases", len(cases)),
        "dobot_fault_matrix_hangs": at_most(hangs, 0, "cases", len(cases)),
    }


# --- times ---------------------------------------------------------------------------------------


@contextmanager
def _linked(faults: Faults) -> Iterator[tuple[Emulator, DobotLink]]:
    with Emulator(faults) as emulator:
        link = DobotLink(emulator.port, bounds(DobotConfig()))
        link.open()
        try:
            yield emulator, link
        finally:
            link.close()


def _round_trips() -> dict[str, Figure]:
    with _linked(Faults()) as (_, link):
        bare = times(link.pose, 500)
    with _linked(Faults(line_time=True)) as (_, link):
        timed = times(link.pose, 500)
    with Emulator() as emulator:
        command = [sys.executable, "-c", STOCK, emulator.port, "20"]
        told = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    return {
        "dobot_round_trip_ms": median(bare, 2.0),
        "dobot_round_trip_with_line_ms": median(timed, 10.0),
        "stock_pydobot_round_trip_ms": median([float(line) for line in told.split()]),
    }


def _following(bench: Bench) -> threading.Thread:
    """A plan on its way, on a thread of its own."""
    plan = there_and_back(bench.robot)

    def run() -> None:
        with suppress(RobotError):
            list(bench.robot.run(plan))

    thread = threading.Thread(target=run)
    thread.start()
    pause = threading.Event()
    while not _told_to_move(bench.emulator):
        pause.wait(0.002)
    return thread


def _told_to_move(emulator: Emulator) -> bool:
    with emulator.lock:
        return any(frame.id == dobot_frames.PTP for frame in emulator.controller.seen)


def _stop(n: int) -> Figure:
    """From the call of ``stop(now=True)`` to 242 at the other end, while a plan runs: the worst."""
    chance, taken = random.Random(5), []
    for _ in range(n):
        with arm(Faults(), pace=1.0) as bench:
            thread = _following(bench)
            threading.Event().wait(chance.uniform(0.0, 0.3))
            began = time.monotonic()
            bench.robot.stop(now=True)
            thread.join()
            with bench.emulator.lock:
                came = [at for at, one in bench.emulator.arrived if one == dobot_frames.FORCE_STOP]
            taken.append(1000 * (came[0] - began))
    return at_most(max(taken), 50.0, "ms", n)


def _times() -> dict[str, Figure]:
    """Seconds (real ones) until an unplugged cable and a stall are seen, and for a close."""

    def unplug(bench: Bench) -> None:
        bench.emulator.unplug()

    def freeze(bench: Bench) -> None:
        bench.emulator.faults.frozen = True

    return {
        "dobot_unplug_s": at_most(max(_seen(unplug) for _ in range(5)), 1.0, "s", 5),
        "dobot_stall_s": at_most(max(_seen(freeze) for _ in range(5)), 3.5, "s", 5),
        "dobot_close_s": at_most(max(_closing() for _ in range(10)), 0.1, "s", 10),
    }


def _seen(strike: Callable[[Bench], None]) -> float:
    with arm(Faults(), pace=1.0) as bench:
        thread = _following(bench)
        began = time.monotonic()
        strike(bench)
        thread.join()
        return time.monotonic() - began


def _closing() -> float:
    with arm(Faults(), pace=1.0) as bench:
        thread = _following(bench)
        began = time.monotonic()
        bench.robot.close()
        took = time.monotonic() - began
        thread.join()
        return took


# --- what gets past the checks -------------------------------------------------------------------


def _fuzz(seconds: float) -> dict[str, Figure]:
    """Random commands, most of them outside reach, box or speed, by every entry of the driver.

    A command counts as having got past if the emulator receives it and `outside` says that it is.
    """
    chance, tried, past = random.Random(11), Counter[str](), 0
    until = time.monotonic() + seconds
    roomy = Faults(capacity=10**9)
    with arm(Faults(), pace=1000.0) as bench, _linked(roomy) as (other, link):
        plans, others = tuple(_by_plan(bench, chance)), tuple(_by_link(link, chance))
        while time.monotonic() < until:
            name, way = chance.choice(plans if chance.random() < 0.1 else others)
            tried[name] += 1
            with suppress(RobotError, ValueError, TypeError):
                way()
            if tried.total() % 1000 == 0:
                past += _drained(bench.emulator) + _drained(other)
        past += _drained(bench.emulator) + _drained(other)
    return {"dobot_outside_reaching": at_most(past, 0, "commands", tried.total())}


Way = tuple[str, Callable[[], object]]


def _drained(emulator: Emulator) -> int:
    """How many of the frames that have come are outside; they are forgotten, and what they do."""
    with emulator.lock:
        controller = emulator.controller
        frames = list(controller.seen)
        controller.seen.clear()
        controller.receive(Frame(dobot_frames.CLEAR, 1), emulator.now())
        controller.made.clear()
        emulator.arrived.clear()
    return sum(outside(frame) for frame in frames)


def _by_plan(bench: Bench, chance: random.Random) -> Iterator[Way]:
    """Plans that this arm approves, that another approves, and what is no plan."""
    robot, elsewhere = bench.robot, IdealRobot()

    def commands() -> list[Command]:
        def point() -> tuple[float, float, float, float]:
            x, y = chance.uniform(-1.8, 1.8), chance.uniform(-1.8, 1.8)
            return x, y, chance.uniform(-0.2, 1.6), chance.uniform(-4, 4)

        return [Command("move", *point(), False, n) for n in range(1, chance.randint(2, 4))]

    def own() -> None:
        list(robot.run(approve(commands(), robot.pose(), robot)))

    def foreign() -> None:
        list(robot.run(approve(commands(), robot.pose(), elsewhere)))

    yield "plan", own
    yield "plan approved for another arm", foreign
    yield "no plan", lambda: robot.run(commands())  # type: ignore[arg-type]


def _by_link(link: DobotLink, chance: random.Random) -> Iterator[Way]:
    """The line's own methods, pydobot's among them, with numbers of any size."""

    def number() -> float:
        odd = (math.nan, math.inf, -math.inf, 1e30, 0.0)
        return chance.choice(odd) if chance.random() < 0.05 else chance.uniform(-500, 500)

    def numbers(count: int) -> tuple[float, ...]:
        return tuple(number() for _ in range(count))

    def raw() -> tuple[int, bytes]:
        command = chance.choice((*dobot_frames.MOTIONS, 60, 62, 80, 81, 82, 83))
        sizes = (
            bytes((chance.randrange(11),)) + floats(*numbers(4)),
            floats(*numbers(2)),
            floats(*numbers(4)),
            floats(*numbers(8)),
            chance.randbytes(chance.randrange(20)),
        )
        return command, chance.choice(sizes)  # fmt: skip

    yield "line_to", lambda: link.line_to(Millimetres(*numbers(4)))
    yield "move_to", lambda: link.move_to(number(), number(), number(), number())
    yield "cp", lambda: link._set_cp_cmd(*numbers(3))
    yield "speed", lambda: link.speed(*numbers(2))
    yield "joint speeds", lambda: link._set_ptp_joint_params(*numbers(8))
    yield "ratios", lambda: link._set_ptp_common_params(*numbers(2))
    yield "queue", lambda: link.queue(*raw())
    yield "urgent", lambda: link.urgent(*raw())


def outside(frame: Frame) -> bool:
    """Whether a frame is a motion past reach, joints or table, or a speed past the limits.

    Worked out anew from the circles of the two links, not by the driver's own formulas.
    """
    if frame.ctrl == dobot_frames.READ:
        return False
    if frame.id == dobot_frames.PTP:
        return frame.ctrl != dobot_frames.QUEUED or _unreachable(frame.params)
    if frame.id == dobot_frames.HOME:
        return frame.ctrl != dobot_frames.QUEUED
    if frame.id in dobot_frames.MOTIONS:
        return True
    most = {81: (100.0, 100.0, 400.0, 400.0), 83: (100.0, 100.0), 80: (200.0,) * 8}.get(frame.id)
    told = read_floats(frame.params)
    if most is None:
        return False
    return len(told) != len(most) or not all(0 < a <= b for a, b in zip(told, most, strict=True))


def _unreachable(params: bytes) -> bool:
    if len(params) != 17 or params[0] != 2:
        return True
    x, y, z, r = read_floats(params[1:])
    if not all(map(math.isfinite, (x, y, z, r))) or z < -68.01:
        return True
    wrist = complex(math.hypot(x, y) - 59.7, z)
    far = abs(wrist)
    if not 1e-9 < far <= 135 + 147 or far < 147 - 135:
        return True
    along = (135**2 - 147**2 + far**2) / (2 * far)
    up = math.sqrt(max(0.0, 135**2 - along**2))
    elbow = wrist / far * complex(along, up)
    fore, base = wrist - elbow, math.degrees(math.atan2(y, x))
    rear = math.degrees(math.atan2(elbow.real, elbow.imag))
    front = -math.degrees(math.atan2(fore.imag, fore.real))
    tool = math.remainder(r - base, 360.0)
    angles = zip((base, rear, front, tool), JOINTS, strict=True)
    return any(not low - 1e-3 <= angle <= high + 1e-3 for angle, (low, high) in angles)


def _inverse(n: int) -> Figure:
    """Largest error of FK(IK(p)) over random points that the joints reach (mm)."""
    chance, worst, tool = random.Random(7), 0.0, DobotConfig().tool
    for _ in range(n):
        joints = Joints(*(math.radians(chance.uniform(*limits)) for limits in JOINTS))
        x, y, z, r = forward(joints, tool)
        found = joints_at(Millimetres(x, y, z, math.degrees(r)), tool)
        if not isinstance(found, Fault):
            worst = max(worst, math.dist(forward(found, tool)[:3], (x, y, z)))
    return at_most(worst, 1e-6, "mm", n)

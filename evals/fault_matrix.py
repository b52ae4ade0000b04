"""Every fault of the emulated Dobot against every kind of command, at rest and on the way.

A case is good if it ends (no hang) in success or a typed error, if every motion that was told was
made at most once and, where the plan succeeded, exactly once, and if, the fault gone, a reset (and
homing where it is asked for) lets the next plan run. Source: docs/dobot.md.
"""

from __future__ import annotations

import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from itertools import product
from pathlib import Path
from typing import Any, NamedTuple

from agent.config import DobotConfig
from agent.errors import NotReady, RobotError
from agent.messages import Command
from robot_bridge import dobot_frames
from robot_bridge.api import PARK, ApprovedPlan, approve
from robot_bridge.dobot_arm import DobotRobot
from robot_bridge.dobot_cell import Cell
from robot_bridge.dobot_start import HOMED
from robot_bridge.emulator import Emulator
from robot_bridge.faults import Faults

PACE = 40.0
GUARD_S = 12.0
"""Seconds of real time after which a case counts as hanging."""

LASTING: dict[str, dict[str, Any]] = {
    "first number 0": {"first": 0},
    "first number 2": {"first": 2},
    "numbers anew after a clear": {"zeroed": True},
    "numbers from 0 anew": {"first": 0, "zeroed": True},
    "246 one low": {"busy": "low"},
    "246 all ones": {"busy": "ones"},
    "247 in 8 bytes": {"left": 8},
    "stale bytes at open": {"stale": True},
    "line time": {"line_time": True},
}
"""Faults that an arm has from the start."""
COMING: dict[str, dict[str, Any]] = {
    "bad sum": {"bad_sum": 2},
    "reply dropped": {"dropped": 1},
    "no replies": {"dropped": 10**6},
    "reply cut": {"cut": 1},
    "garbage before": {"garbage": 3},
    "reply split": {"split": 3},
    "late by 0.15 s": {"late": 1, "delay": 0.15},
    "late by 0.6 s": {"late": 1, "delay": 0.6},
    "lost reply to a queued command": {"lost_reply": 1},
    "lost request byte": {"lost_byte": 1},
    "slow": {"slow": 0.5},
    "frozen": {"frozen": True},
    "unplugged on the way": {"unplug_at": 0.5},
    "alarm on the way, skips": {"alarm_at": 0.5, "alarm": 0x30},
    "alarm on the way, holds": {"alarm_at": 0.5, "alarm": 0x22, "under_alarm": "holds"},
    "alarm that stays": {"alarm_at": 0.5, "alarm": 0x41, "reassert": True},
    "lost step": {"alarm_at": 0.5, "alarm": 0x50},
    "power cycle on the way": {"power_at": 0.5},
    "queue full": {"capacity": 0},
}
"""Faults that begin just before, or during, the command."""
SUDDEN = ("unplugged", "power cycle")
"""What happens to the arm itself, then and there."""
COMMANDS = ("pose", "reset", "move", "grip", "home", "stop", "stop now", "close")


class Case(NamedTuple):
    """One cell of the matrix and what came of it; ``why`` is empty where it is good."""

    fault: str
    command: str
    moving: bool
    outcome: str
    why: str

    @property
    def good(self) -> bool:
        """Whether nothing is wrong with it."""
        return not self.why


def cells() -> Iterator[tuple[str, str, bool]]:
    """Every fault, command, and whether the arm is on its way."""
    yield from product((*LASTING, *COMING, *SUDDEN), COMMANDS, (False, True))


class Bench(NamedTuple):
    """A homed and parked arm at its emulator."""

    emulator: Emulator
    robot: DobotRobot


@contextmanager
def arm(faults: Faults, pace: float = PACE, **config: Any) -> Iterator[Bench]:  # noqa: ANN401
    """An emulator and an open robot, as if it had been homed before."""
    with tempfile.TemporaryDirectory() as folder:
        link = Path(folder) / "port"
        with Emulator(faults, pace, link) as emulator:
            settled(emulator)
            robot = DobotRobot(DobotConfig(port=str(link), **config), pace=pace)
            try:
                robot.reset()
                yield Bench(emulator, robot)
            finally:
                robot.close()


def settled(emulator: Emulator) -> None:
    """The emulated arm is homed and parked, without the time that this takes."""
    with emulator.lock:
        emulator.controller.pose = Cell(DobotConfig()).millimetres(PARK)
        emulator.controller.settings[dobot_frames.PTP_JUMP] = HOMED
        emulator.controller.homed = True


def play(fault: str, command: str, moving: bool) -> Case:
    """One case, from a fresh arm to the plan that must run once the fault is gone."""
    with arm(Faults(**LASTING.get(fault, {}))) as bench:
        outcome, why = _moving(bench, fault, command) if moving else _idle(bench, fault, command)
        why = why or _made(bench, outcome, command == "move" or moving)
        why = why or (None if command == "close" else _again(bench, fault)) or ""
        return Case(fault, command, moving, outcome, why)


# --- the command under the fault ------------------------------------------------------------------


def there_and_back(robot: DobotRobot) -> ApprovedPlan:
    """Two long straight motions, checked."""
    told = [Command("move", x, -0.2, 0.9, 0, False, n) for n, x in enumerate((0.9, -0.9), 1)]
    return approve(told, robot.pose(), robot)


def _plan(bench: Bench, command: str) -> ApprovedPlan:
    if command == "move":
        return there_and_back(bench.robot)
    return approve([Command("grip", 0, 0, 0, 0, on) for on in (True, False)],
                   bench.robot.pose(), bench.robot)  # fmt: skip


def _act(bench: Bench, command: str, plan: ApprovedPlan | None = None) -> None:
    robot = bench.robot
    if command in ("move", "grip"):
        list(robot.run(plan or _plan(bench, command)))
    elif command.startswith("stop"):
        robot.stop(now=command.endswith("now"))
    else:
        getattr(robot, command)()


def _idle(bench: Bench, fault: str, command: str) -> tuple[str, str]:
    plan = _plan(bench, command) if command in ("move", "grip") else None
    _strike(bench, fault)
    return _guarded(lambda: _act(bench, command, plan))


def _moving(bench: Bench, fault: str, command: str) -> tuple[str, str]:
    """The fault, then the command, while a plan is on its way; the plan's outcome counts too."""
    plan = there_and_back(bench.robot)
    results: list[tuple[str, str]] = []
    follow = threading.Thread(
        target=lambda: results.append(_guarded(lambda: list(bench.robot.run(plan)))), daemon=True
    )
    follow.start()
    _wait(lambda: _on_its_way(bench) or not follow.is_alive())
    _strike(bench, fault)
    if command == "move":
        follow.join(GUARD_S)
        return results[0] if results else ("hang", "the plan hangs")
    told, why = _guarded(lambda: _act(bench, command))
    follow.join(GUARD_S)
    if not results:
        return "hang", "the plan hangs"
    plan_told, plan_why = results[0]
    return f"{told}, plan {plan_told}", why or plan_why


def _on_its_way(bench: Bench) -> bool:
    with bench.emulator.lock:
        controller = bench.emulator.controller
        return controller.moving and any(one.id == dobot_frames.PTP for one in controller.seen)


def _wait(ready: Callable[[], object], patience: float = GUARD_S) -> bool:
    """Wait until something is so."""
    until, pause = time.monotonic() + patience, threading.Event()
    while not ready():
        if time.monotonic() > until:
            return False
        pause.wait(0.002)
    return True


def _strike(bench: Bench, fault: str) -> None:
    emulator = bench.emulator
    if fault == "unplugged":
        emulator.unplug()
    with emulator.lock:
        for name, value in COMING.get(fault, {}).items():
            setattr(emulator.faults, name, value)
        if fault == "power cycle":
            stood = emulator.controller.pose
            emulator.controller.switch_on(emulator.now())
            emulator.controller.pose = stood


def _guarded(act: Callable[[], object]) -> tuple[str, str]:
    """How it ended, and what is wrong with that: success and typed errors are fine."""
    ended: list[BaseException | None] = []

    def run() -> None:
        try:
            act()
        except BaseException as error:
            ended.append(error)
        else:
            ended.append(None)

    worker = threading.Thread(target=run, daemon=True)
    worker.start()
    worker.join(GUARD_S)
    if not ended:
        return "hang", f"no end within {GUARD_S:g} s"
    error = ended[0]
    if error is None:
        return "ok", ""
    return type(error).__name__, "" if isinstance(error, RobotError) else f"raised {error!r}"


# --- what was made of it --------------------------------------------------------------------------


def _made(bench: Bench, outcome: str, planned: bool) -> str:
    """What is wrong with the motions that the arm made: lost, doubled, in another order."""
    with bench.emulator.lock:
        controller = bench.emulator.controller
        sent = [frame.params for frame in controller.seen if frame.id == dobot_frames.PTP]
        made = [round(one.goal.y, 2) for one in controller.made if one.id == dobot_frames.PTP]
        whole = [one.whole for one in controller.made if one.id == dobot_frames.PTP]
    expected = [-67.5, 67.5]
    if len(sent) != len(set(sent)):
        return "a motion was sent twice"
    if made != expected[: len(made)]:
        return f"made {made}, told {expected}"
    succeeded = outcome.endswith("ok") and planned
    if succeeded and (made != expected or not all(whole)):
        return f"called done, but made {made} ({whole})"
    return ""


def _again(bench: Bench, fault: str) -> str | None:
    """What is wrong once the fault is gone: a reset, and homing where asked for, must be enough."""
    emulator, robot = bench.emulator, bench.robot
    with emulator.lock:
        for name, value in _defaults().items():
            if name not in LASTING.get(fault, {}):
                setattr(emulator.faults, name, value)
        if not emulator.plugged:
            emulator.plug()
    outcome, why = _guarded(lambda: _recovered(robot))
    if outcome != "ok":
        return f"afterwards {outcome} {why}"
    return None


def _defaults() -> dict[str, object]:
    faults = Faults()
    return {name: getattr(faults, name) for name in faults.__struct_fields__}


def _recovered(robot: DobotRobot) -> None:
    robot.reset()
    try:
        list(robot.run(there_and_back(robot)))
    except NotReady:
        robot.home()
        list(robot.run(there_and_back(robot)))

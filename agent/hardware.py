"""`ports`, `home`, `jog`, `emulate`, and `stop` and `reset` at an arm's own port.

With ``--robot dobot`` (or a ``--port``) a command opens the arm itself; without, it goes to the
agent that runs (``--connect``), which holds the arm.
"""

from __future__ import annotations

import argparse
import math
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from agent.errors import ConfigError

if TYPE_CHECKING:
    from robot_bridge.dobot_arm import DobotRobot

DONE, FAILED = 0, 1
SAFETY = (
    "armchat: the arm will move by itself, through all of its reach: keep the space around it clear"
)


def port_options(command: argparse.ArgumentParser) -> None:
    """Which arm to open here, instead of asking the agent that runs."""
    command.add_argument("--robot", choices=("dobot",), help="open the arm here")
    command.add_argument("--port", metavar="PORT", help="its serial port (`armchat ports`)")


def add_commands(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """The commands of this module."""
    ports = commands.add_parser("ports", help="serial ports, and which may be a Dobot's")
    ports.set_defaults(act=lambda arguments: show_ports(sys.stdout))

    home = commands.add_parser("home", help="home the arm, and park it")
    jog = commands.add_parser("jog", help="move the arm one small step along an axis")
    jog.add_argument("axis", choices=("x", "y", "z", "r"))
    jog.add_argument("amount", type=float, help="millimetres, or degrees for r; e.g. -10")
    for command, act in ((home, _home), (jog, _jog)):
        command.add_argument("--connect", metavar="ENDPOINT", help="a running agent")
        port_options(command)
        command.set_defaults(act=act)

    emulate = commands.add_parser("emulate", help="an arm to try things on, at a port of its own")
    emulate.add_argument("arm", choices=("dobot",))
    emulate.add_argument("--port-link", metavar="PATH", help="a path that points to its port")
    emulate.add_argument("--speed", type=float, default=1.0, help="how fast its clock goes")
    emulate.add_argument(
        "--fault", action="append", default=[], metavar="NAME[=VALUE]",
        help="something that goes wrong, e.g. bad-sum=3, frozen, unplug-at=0.5 (repeatable)",
    )  # fmt: skip
    emulate.set_defaults(act=lambda arguments: emulate_dobot(arguments, sys.stdout))


def opens_port(arguments: argparse.Namespace) -> bool:
    """Whether a command is for an arm that this process opens."""
    return bool(arguments.robot == "dobot" or arguments.port)


@contextmanager
def opened(port: str | None) -> Iterator[DobotRobot]:
    """The arm at a port, the configured one, or the only likely one. Raises RobotError."""
    import msgspec

    from agent.compose import need_dobot, stands
    from agent.config import load

    need_dobot()
    from robot_bridge.dobot_arm import open_dobot
    from robot_bridge.ports import choose

    config = load({"dobot.port": port})
    dobot = stands(config.dobot).slowed(config.robot.speed)
    dobot = msgspec.structs.replace(dobot, port=dobot.port or choose())
    robot = open_dobot(dobot, config.robot.keep_outs)
    try:
        yield robot
    finally:
        robot.close()


def show_ports(out: TextIO) -> int:
    """One line a port; what to do where there is none, or none may be opened."""
    from robot_bridge.ports import ports, remedy

    found = ports()
    for port in found:
        guess = "likely a Dobot" if port.likely else "another device"
        allowed = "" if port.permitted else f"; no permission: {remedy(port.device)}"
        out.write(f"{port.device}  {port.text}  {guess}{allowed}\n")
    if not any(port.likely for port in found):
        out.write(
            "No port looks like a Dobot's. Plug in its USB cable and switch it on; in a virtual "
            "machine or container pass the device through. `armchat emulate dobot` needs none.\n"
        )
        return FAILED
    return DONE


def _home(arguments: argparse.Namespace) -> int:
    if not opens_port(arguments):
        from agent.remote import home_remotely

        return home_remotely(arguments.connect, sys.stdout)
    from robot_bridge.moves import go_home

    print(SAFETY, file=sys.stderr)
    with opened(arguments.port) as robot:
        pose = go_home(robot)
    print(f"Home: x {pose.x:.3f}, y {pose.y:.3f}, z {pose.z:.3f} (table units)")
    return DONE


def _jog(arguments: argparse.Namespace) -> int:
    from agent.compose import stands

    if not math.isfinite(arguments.amount):
        raise ConfigError("the amount must be a finite number")
    turning = arguments.axis == "r"
    scale = stands().scale
    amount = math.radians(arguments.amount) if turning else arguments.amount / scale
    unit = "rad" if turning else "table units"
    if not opens_port(arguments):
        from agent.remote import jog_remotely

        return jog_remotely(arguments.connect, arguments.axis, amount, unit, sys.stdout)
    from robot_bridge.moves import step

    with opened(arguments.port) as robot:
        for done in robot.run(step(robot.pose(), robot, arguments.axis, amount)):
            print(f"{arguments.axis} {getattr(done.reached, arguments.axis):.3f} {unit}")
    return DONE


def stop_port(port: str | None, out: TextIO) -> int:
    """Halt an arm that no agent holds: nothing is cleared first. Raises LinkDown."""
    from agent.compose import need_dobot
    from agent.config import load

    need_dobot()
    from robot_bridge import dobot_frames
    from robot_bridge.dobot import DobotLink
    from robot_bridge.dobot_guard import bounds
    from robot_bridge.ports import choose

    config = load({"dobot.port": port}).dobot
    link = DobotLink(config.port or choose(), bounds(config))
    link.open()
    try:
        link.urgent(dobot_frames.FORCE_STOP)
        link.clear()
    finally:
        link.close()
    out.write("Stopped: the arm was halted and its queue emptied.\n")
    return DONE


def reset_port(port: str | None, out: TextIO) -> int:
    """Clear queue and alarms of an arm that no agent holds; never moves it. Raises RobotError."""
    with opened(port):
        pass
    out.write("Ready again. Nothing moved.\n")
    return DONE


def emulate_dobot(arguments: argparse.Namespace, out: TextIO) -> int:
    """Serve an emulated Dobot until SIGINT or SIGTERM; its port is printed first."""
    from robot_bridge.emulator import Emulator
    from robot_bridge.faults import read

    if not 0 < arguments.speed <= 1000:
        raise ConfigError("--speed must be in (0, 1000]")
    faults = read(arguments.fault)
    link = None if arguments.port_link is None else Path(arguments.port_link)
    if link is not None and link.exists() and not link.is_symlink():
        raise ConfigError(f"{link} exists already and is no link")
    over = threading.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda number, frame: over.set())
    with Emulator(faults, arguments.speed, link) as emulator:
        out.write(f"{link or emulator.port}\n")
        out.flush()
        print(
            f"armchat: an emulated Dobot; try `armchat home --port {link or emulator.port}` in "
            "another terminal, Ctrl-C here ends it",
            file=sys.stderr,
        )
        while not over.wait(0.5):
            pass
    return DONE

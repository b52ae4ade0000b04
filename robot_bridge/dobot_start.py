"""How a line to a Dobot becomes an arm that may be moved: probe, read, clear, set (never moves).

Homing is marked in the controller itself: `home` writes the parameters of the JUMP mode, which
nothing here uses, to values of our own; switched off, the arm forgets them with its position.
Source: docs/dobot.md, start-up.
"""

from __future__ import annotations

import struct
from typing import NamedTuple

from agent.config import DobotConfig
from robot_bridge import dobot_frames
from robot_bridge.dobot import DobotLink
from robot_bridge.dobot_cell import Millimetres
from robot_bridge.dobot_frames import floats

HOMED = floats(21.25, 137.5)
"""JUMP parameters (lift, ceiling in mm) that say: homed since it was switched on."""


class Greeting(NamedTuple):
    """What an arm says of itself: nothing has been changed yet."""

    firmware: str
    alarms: tuple[int, ...]
    pose: Millimetres
    homed: bool


def greet(link: DobotLink) -> Greeting:
    """Look, and change nothing. Raises NoReply where what is there is no Dobot, LinkDown."""
    firmware, alarms = link.firmware(), link.alarms()
    return Greeting(firmware, alarms, link.pose(), is_homed(link))


def start_up(link: DobotLink, config: DobotConfig) -> Greeting:
    """Clear alarms and queue, set tool and speeds; what the arm said before.

    The queue is emptied before the alarms go, so that one that was held by them does not go on.
    """
    greeting = greet(link)
    link.set(dobot_frames.STOP)
    link.clear()
    link.set(dobot_frames.ALARMS)
    link.set(dobot_frames.START)
    settings(link, config)
    return greeting


def settings(link: DobotLink, config: DobotConfig) -> None:
    """The tool's offset and the speeds, which the controller forgets when it is switched off."""
    link.set(dobot_frames.TOOL, floats(config.tool, 0, 0))
    link.speed(config.speed, config.acceleration)


def is_homed(link: DobotLink) -> bool:
    """Whether it was homed since it was switched on, and lost no step since."""
    return link.query(dobot_frames.PTP_JUMP, 8)[:8] == HOMED


def mark_homed(link: DobotLink, homed: bool) -> None:
    """Write, or take away, the mark."""
    link.set(dobot_frames.PTP_JUMP, HOMED if homed else floats(20, 100))


def queue_homing(link: DobotLink, park: Millimetres) -> int:
    """Queue the controller's own homing, which ends at this pose; its number."""
    link.set(dobot_frames.HOME_PARAMS, floats(*park))
    return link.queue(dobot_frames.HOME, struct.pack("<I", 0))

"""Serial ports: which are there, which looks like a Dobot's, who may open it.

The Dobot Magician is told by its USB serial chip, so another device with that chip looks the same.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import NamedTuple

from agent.errors import ConfigError, LinkDown

CHIPS = {(0x10C4, 0xEA60): "CP210x", (0x1A86, 0x7523): "CH340", (0x0483, 0x5740): "STM32"}
"""Vendor and product of the USB chips that Dobot Magicians come with."""


class Port(NamedTuple):
    """A serial port. ``likely``: it may be a Dobot's; ``permitted``: this user may open it."""

    device: str
    text: str
    likely: bool
    permitted: bool


def ports() -> tuple[Port, ...]:
    """All serial ports, likely ones first. Raises ConfigError without pyserial."""
    try:
        from serial.tools import list_ports
    except ImportError as error:
        raise ConfigError("serial ports need: pip install 'armchat[dobot]'") from error
    found = []
    for info in list_ports.comports():
        chip = CHIPS.get((info.vid, info.pid))
        text = info.description if chip is None else f"{info.description} ({chip})"
        found.append(Port(info.device, text, chip is not None, permitted(info.device)))
    return tuple(sorted(found, key=lambda port: (not port.likely, port.device)))


def permitted(device: str) -> bool:
    """Whether this user may read and write the device."""
    return os.access(device, os.R_OK | os.W_OK)


def remedy(device: str) -> str:
    """What to do where the device may not be opened."""
    try:
        group = Path(device).group()
    except (KeyError, OSError):
        group = "dialout"
    return f"sudo usermod -aG {group} $USER, then log out and in again"


def choose() -> str:
    """The only port that looks like a Dobot's. Raises LinkDown naming what there is instead."""
    likely = [port.device for port in ports() if port.likely]
    if len(likely) == 1:
        return likely[0]
    if likely:
        raise LinkDown(f"several ports look like a Dobot's ({', '.join(likely)}): name one, --port")
    raise LinkDown("no port looks like a Dobot's: is it plugged in and on? `armchat ports`, --port")

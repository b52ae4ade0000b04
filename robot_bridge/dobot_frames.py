"""The Dobot Magician's frames: how bytes on the line become commands and replies, and back.

``AA AA | len | id | ctrl | params | sum``: ``len`` is 2 + the number of parameter bytes, bit 0 of
``ctrl`` means write, bit 1 queued; ``sum`` makes id, ctrl and params add up to 0 modulo 256. Little
endian. Source: docs/dobot.md, after the vendor's communication protocol.
"""

from __future__ import annotations

import struct
from typing import NamedTuple

HEADER = b"\xaa\xaa"
LONGEST = 169
"""Largest ``len`` that a frame may have."""

READ, WRITE, QUEUED = 0, 1, 3
"""Values of ``ctrl``: read, write and act at once, write into the queue."""

SERIAL_NUMBER, NAME, VERSION = 0, 1, 2
POSE, ALARMS = 10, 20
HOME_PARAMS, HOME = 30, 31
TOOL, LASER, SUCTION, GRIPPER = 60, 61, 62, 63
JOG_JOINT, JOG_COORDINATE, JOG_COMMON, JOG = 70, 71, 72, 73
PTP_JOINT, PTP_COORDINATE, PTP_JUMP, PTP_COMMON, PTP = 80, 81, 82, 83, 84
CP_PARAMS, CP = 90, 91
WAIT, IO = 110, 131
START, STOP, FORCE_STOP, CLEAR, INDEX, LEFT_SPACE = 240, 241, 242, 245, 246, 247

MOTIONS = frozenset({HOME, JOG, PTP, CP})
"""Commands that move the arm."""


class Frame(NamedTuple):
    """One command or reply."""

    id: int
    ctrl: int = READ
    params: bytes = b""


def floats(*values: float) -> bytes:
    """Numbers as float32 parameters."""
    return struct.pack(f"<{len(values)}f", *values)


def read_floats(params: bytes) -> tuple[float, ...]:
    """Parameters as float32 numbers; bytes beyond the last whole one are left out."""
    count = len(params) // 4
    return struct.unpack_from(f"<{count}f", params)


def checksum(body: bytes) -> int:
    """What makes id, ctrl and params add up to 0 modulo 256."""
    return -sum(body) & 0xFF


def encode(frame: Frame) -> bytes:
    """The bytes of a frame. Raises ValueError where they would not fit one."""
    body = bytes((frame.id, frame.ctrl)) + frame.params
    if len(body) > LONGEST:
        raise ValueError(f"{len(frame.params)} bytes of parameters do not fit a frame")
    return HEADER + bytes((len(body),)) + body + bytes((checksum(body),))


def take(buffer: bytes) -> tuple[Frame | None, bytes]:
    """The first whole and valid frame, and what is left to read.

    What comes before it is dropped. A header that turns out to be none hides no frame behind it:
    every header is tried, also where a longer frame seems to have begun before.
    """
    begun: int | None = None
    at = buffer.find(HEADER)
    while at >= 0:
        end = at + 3 + (buffer[at + 2] + 1 if at + 2 < len(buffer) else LONGEST)
        if end > len(buffer):
            plausible = at + 2 >= len(buffer) or 2 <= buffer[at + 2] <= LONGEST
            begun = at if begun is None and plausible else begun
        elif (frame := _whole(buffer[at:end])) is not None:
            return frame, buffer[end:]
        at = buffer.find(HEADER, at + 1)
    if begun is not None:
        return None, buffer[begun:]
    return None, buffer[-1:] if buffer.endswith(HEADER[:1]) else b""


def _whole(data: bytes) -> Frame | None:
    """The frame that exactly these bytes are, None if they are none."""
    body = data[3:-1]
    if not 2 <= data[2] <= LONGEST or checksum(body) != data[-1]:
        return None
    return Frame(body[0], body[1], body[2:])


class Reader:
    """Bytes as they come, frames as they are complete."""

    def __init__(self) -> None:
        self._buffer = b""

    def feed(self, data: bytes) -> list[Frame]:
        """The frames that these bytes complete, in order."""
        self._buffer += data
        found: list[Frame] = []
        while True:
            frame, self._buffer = take(self._buffer)
            if frame is None:
                return found
            found.append(frame)

    def clear(self) -> None:
        """Forget what was left of a frame."""
        self._buffer = b""

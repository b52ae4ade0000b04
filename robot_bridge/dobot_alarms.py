"""The Dobot Magician's alarms: codes, what they mean, what to do (pure).

The controller tells them as a mask of 16 bytes: bit ``code % 8`` of byte ``code // 8``. Source:
docs/dobot.md and the vendor's list of alarms.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

MASK_BYTES = 16
OUT_OF_REACH, JOINT_LIMIT = 0x11, 0x12
OUT_OF_REACH_MOVING, JOINT_LIMIT_MOVING = 0x21, 0x22
OVERSPEED, AT_LIMIT, LOST_STEP = 0x30, 0x40, 0x50


class Kind(NamedTuple):
    """A range of codes, what they mean and what helps."""

    first: int
    last: int
    meaning: str
    remedy: str


_KINDS = (
    Kind(0x00, 0x0F, "the controller reports a fault of its own",
         "switch the arm off and on, then home it"),
    Kind(0x11, 0x11, "the target is out of reach", "plan another way, then reset"),
    Kind(0x12, 0x12, "a joint would pass its limit", "plan another way, then reset"),
    Kind(0x10, 0x1F, "the motion cannot be planned", "plan another way, then reset"),
    Kind(0x20, 0x2F, "the motion left what the arm can reach",
         "move the arm back by hand with its unlock button, then reset"),
    Kind(0x30, 0x3F, "a joint was too fast", "lower speed in [dobot], then reset"),
    Kind(0x40, 0x4F, "a joint stands at its limit",
         "move the arm back by hand with its unlock button, then reset"),
    Kind(0x50, 0x5F, "the arm lost steps: something blocked it",
         "clear the way, reset, then home it"),
)  # fmt: skip
_UNKNOWN = Kind(0, 0x7F, "an alarm of unknown meaning", "switch the arm off and on, then home it")


def codes(mask: bytes) -> tuple[int, ...]:
    """The codes of a mask, in order."""
    return tuple(code for code in range(8 * len(mask)) if mask[code // 8] >> code % 8 & 1)


def mask(raised: Iterable[int]) -> bytes:
    """The mask of some codes."""
    result = bytearray(MASK_BYTES)
    for code in raised:
        result[code // 8] |= 1 << code % 8
    return bytes(result)


def kind(code: int) -> Kind:
    """What a code means."""
    return next((one for one in _KINDS if one.first <= code <= one.last), _UNKNOWN)


def describe(raised: Iterable[int]) -> str:
    """The alarms in plain words, codes included."""
    return "; ".join(f"{kind(code).meaning} (alarm 0x{code:02x})" for code in raised)


def remedy(raised: Iterable[int]) -> str:
    """What to do about them."""
    return "; ".join(dict.fromkeys(kind(code).remedy for code in raised))


def loses_position(raised: Iterable[int]) -> bool:
    """Whether the controller no longer knows where the arm is, so that it must be homed."""
    return any(LOST_STEP <= code <= LOST_STEP | 0x0F for code in raised)

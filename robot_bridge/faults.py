"""What can go wrong between a program and a Dobot, as switches of the emulator (docs/dobot.md).

Counters say how many replies, or requests, are hit; switches last until they are cleared. All are
deterministic. `fault` reads one as the command line names it: ``bad-sum=3``, ``frozen``.
"""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches
from typing import Literal

import msgspec

from agent.errors import ConfigError


class Faults(msgspec.Struct, kw_only=True):
    """All switches; the defaults are an arm without faults.

    The next so many replies have a ``bad_sum``, are ``dropped``, ``cut`` short, come behind
    ``garbage``, ``split`` in two, or ``late`` by ``delay`` s. ``lost_reply``: queued commands that
    are executed and not answered; ``lost_byte``: requests that lose a byte on their way.
    ``stale``: replies of an earlier program lie there when the port is opened.

    Motions are ``slow`` (share of their speed) or ``frozen``; the next one is broken off at a
    share of its way: ``unplug_at`` (the line is cut, the arm goes on), ``alarm_at`` (with
    ``alarm``, a code), ``power_at`` (the arm is switched off and on).

    ``capacity`` of the queue. ``under_alarm``: the queue is held, or motions are skipped and told
    as done. ``reassert``: clearing an alarm does not help. ``first`` number of the queue, given
    anew after a clear where ``zeroed``. ``busy``: what 246 tells while the arm moves: the right
    number, one too few, or all ones. ``left``: bytes in which 247 answers. ``line_time``: bytes
    take the time that they take at 115200 baud.
    """

    bad_sum: int = 0
    dropped: int = 0
    cut: int = 0
    garbage: int = 0
    split: int = 0
    late: int = 0
    delay: float = 0.25
    lost_reply: int = 0
    lost_byte: int = 0
    stale: bool = False
    slow: float = 1.0
    frozen: bool = False
    unplug_at: float | None = None
    alarm_at: float | None = None
    alarm: int = 0x50
    power_at: float | None = None
    capacity: int = 32
    under_alarm: Literal["skips", "holds"] = "skips"
    reassert: bool = False
    first: int = 1
    zeroed: bool = False
    busy: Literal["right", "low", "ones"] = "right"
    left: Literal[4, 8] = 4
    line_time: bool = False

    def hit(self, name: str) -> bool:
        """Whether a counter hits this time; it counts down."""
        count: int = getattr(self, name)
        if count > 0:
            setattr(self, name, count - 1)
        return count > 0


BARE: dict[str, object] = {
    "slow": 0.3, "unplug_at": 0.5, "alarm_at": 0.5, "power_at": 0.5, "capacity": 2, "first": 0,
    "under_alarm": "holds", "busy": "ones", "left": 8,
}  # fmt: skip
"""What a fault means that is named without a value; counters hit once, switches are on."""


def read(texts: Iterable[str]) -> Faults:
    """Faults as the command line names them, one a text. Raises ConfigError."""
    faults = Faults()
    for name, value in map(fault, texts):
        setattr(faults, name, value)
    return faults


def fault(text: str) -> tuple[str, object]:
    """Name and value of a fault as the command line has it. Raises ConfigError."""
    name, _, value = text.replace("-", "_").partition("=")
    fields = {field.name: field for field in msgspec.structs.fields(Faults)}
    if name not in fields:
        near = get_close_matches(name, fields, 1)
        hint = f"did you mean {near[0]}?" if near else f"known: {', '.join(fields)}"
        raise ConfigError(f"no fault {name!r}; {hint}")
    try:
        return name, msgspec.convert(value, fields[name].type, strict=False) if value else _bare(
            name, fields[name].default
        )
    except msgspec.ValidationError as error:
        raise ConfigError(f"fault {name}: {error}") from error


def _bare(name: str, default: object) -> object:
    return BARE.get(name, True if isinstance(default, bool) else 1)

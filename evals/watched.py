"""Progress of what takes minutes: how far it is, on standard error."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterable, Iterator
from typing import TextIO, TypeVar

EVERY = 20.0
"""Seconds between two lines at least."""
Item = TypeVar("Item")


def watched(
    items: Iterable[Item], what: str, of: int, out: TextIO | None = None, every: float = EVERY
) -> Iterator[Item]:
    """The items, ``of`` in number. A line at most every so many seconds, and one at the end of what
    took longer; ``out``: default standard error."""
    began = said = time.monotonic()
    for number, item in enumerate(items):
        now = time.monotonic()
        if number and now - said >= every:
            said = now
            left = (now - began) / number * (of - number)
            print(f"armchat: {what}: {number} of {of}, about {left:.0f} s more",
                  file=out or sys.stderr, flush=True)  # fmt: skip
        yield item
    spent = time.monotonic() - began
    if spent >= every:
        print(f"armchat: {what}: {of} in {spent:.0f} s", file=out or sys.stderr, flush=True)

"""How far a beam search follows what is not the best so far."""

from __future__ import annotations

import math
from collections.abc import Sequence

FAR = 7.0
"""Nats behind the best finished program from which on an open one is not followed: it could not
come to a thousandth of its probability."""


def worth_following(finished: Sequence[float], width: int) -> float:
    """The log-probability that an open hypothesis must have to be followed, by those of the
    finished ones: above it, it may still be one of the best ``width`` and come near the best."""
    if not finished:
        return -math.inf
    ranked = sorted(finished, reverse=True)
    near = ranked[0] - FAR
    return near if len(ranked) < width else max(ranked[width - 1], near)

"""What lies within the error of the eye: the one place that says how much limits are widened.

A place is known to within `SIGMAS` standard deviations. What is inside a limit only if the eye
does not err by so much counts as not inside. Where nothing is uncertain, nothing changes.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from types import MappingProxyType

Doubt = Mapping[str, float]
"""By id the standard deviation of a thing's x and of its y (table units); those left out: 0."""
SURE: Doubt = MappingProxyType({})
"""A scene without any error."""
SIGMAS = 3.0
STOOD = 0.0015
"""By how much (standard deviation, table units) a thing may have moved that is seen to rest."""
Stands = Mapping[str, int]
"""By id a number that stays the same as long as a thing is seen not to have moved."""


def slack(doubt: Doubt, *ids: str) -> float:
    """How far off the place of a thing, or of one thing beside another, may be (table units)."""
    return SIGMAS * math.hypot(*(doubt.get(one, 0.0) for one in ids))


def vouched(limit: float, error: float) -> float:
    """Up to which deviation an eye that errs by so much can say that a thing is within a limit.

    What is farther from where it should be may be beyond it. An eye that may err by half of the
    limit or more says what it can: that nothing is seen as near to the limit as it usually errs
    (one deviation), or within half of it.
    """
    return max(limit - error, min(error, max(limit - error / SIGMAS, limit / 2)))


def both(one: Doubt, other: Doubt, stood: Collection[str] = ()) -> Doubt:
    """The doubt about a thing that was aimed at in one look and found in another; ``stood``: ids of
    what was seen not to have moved in between."""
    return {
        id_: STOOD if id_ in stood else math.hypot(one.get(id_, 0.0), other.get(id_, 0.0))
        for id_ in {*one, *other}
    }

"""Where a thing is and how sure that is: a Kalman filter over sightings, with two ways to move.

A thing is at rest, but for a little creep, or it moved since it was seen; which of the two a
sighting speaks for is decided by their likelihoods (pure; table units, seconds).
"""

from __future__ import annotations

import math
from typing import NamedTuple

CREEP = 0.001
"""Standard deviation by which a thing at rest is displaced in a second."""
SPEED = 1.0
"""Speed of what is pushed or moved by hand (standard deviation, units per second)."""
LONGEST = 0.3
"""Seconds without a sighting after which what moved is looked for no farther away."""
AT_REST, STIRRED = 0.02, 0.4
"""Chance that a thing moved between two pictures: with nothing near, and with something at it."""
COMMON = 0.5
"""Share of a detector's error that is the same in all pictures of a thing that rests."""
FINER = 0.6
"""A sighting that errs by less than this share of those before it errs in another way: what was
the same in all of them is not in it."""


class Estimate(NamedTuple):
    """Place as it seems on the surface; ``var`` along each axis, ``noise`` the standard deviation
    of the sightings that it is the mean of, each by its part in it."""

    x: float
    y: float
    var: float
    noise: float

    @property
    def sd(self) -> float:
        """Standard deviation of x and of y, with what no number of pictures takes away."""
        return math.sqrt(self.var + (COMMON * self.noise) ** 2)


class Sighting(NamedTuple):
    """A place and its standard deviation."""

    x: float
    y: float
    sd: float


def first(seen: Sighting) -> Estimate:
    """What is known from one sighting."""
    return Estimate(seen.x, seen.y, seen.sd**2, seen.sd)


def waited(one: Estimate, seconds: float, stirred: bool = False) -> Estimate:
    """The same after a time unseen or seen; ``stirred``: something moved it, or may have."""
    speed = SPEED * 0.5 if stirred else 0.0
    return one._replace(var=one.var + CREEP**2 * seconds + (speed * seconds) ** 2)


def shifted(one: Estimate, dx: float, dy: float, sd: float = 0.0) -> Estimate:
    """The same, known to have been displaced, give or take ``sd``."""
    return one._replace(x=one.x + dx, y=one.y + dy, var=one.var + sd**2)


def surprise(one: Estimate, seen: Sighting, age: float, moved: float) -> float:
    """Minus the log of how likely the sighting is; ``age``: seconds since the one before.

    ``moved`` is the chance that the thing moved meanwhile.
    """
    return min(_rest(one, seen, moved), _motion(one, seen, age, moved))


def updated(one: Estimate, seen: Sighting, age: float, moved: float) -> Estimate:
    """What is known after the sighting."""
    if _motion(one, seen, age, moved) < _rest(one, seen, moved):
        return _fused(one, _var(one, seen) + _way(age), seen)
    return _fused(one, _var(one, seen), seen)


def rested(one: Estimate, seen: Sighting) -> Estimate:
    """What is known after a sighting of what is known to rest."""
    return _fused(one, _var(one, seen), seen)


def jumped(one: Estimate, seen: Sighting, age: float, moved: float) -> bool:
    """Whether the sighting says that the thing moved."""
    return _motion(one, seen, age, moved) < _rest(one, seen, moved)


def _rest(one: Estimate, seen: Sighting, moved: float) -> float:
    return _unlikely(one, seen, _var(one, seen) + seen.sd**2) - math.log(1 - moved)


def _motion(one: Estimate, seen: Sighting, age: float, moved: float) -> float:
    return _unlikely(one, seen, _var(one, seen) + seen.sd**2 + _way(age)) - math.log(moved)


def _var(one: Estimate, seen: Sighting) -> float:
    """The variance of the place as such a sighting can put it right: along each axis."""
    return one.sd**2 if seen.sd < FINER * one.noise else one.var


def _way(age: float) -> float:
    return (SPEED * min(age, LONGEST)) ** 2


def _unlikely(one: Estimate, seen: Sighting, var: float) -> float:
    """Minus the log of a round normal density of this variance."""
    far = (one.x - seen.x) ** 2 + (one.y - seen.y) ** 2
    return far / (2 * var) + math.log(math.tau * var)


def _fused(one: Estimate, var: float, seen: Sighting) -> Estimate:
    gain = var / (var + seen.sd**2)
    return Estimate(
        one.x + gain * (seen.x - one.x), one.y + gain * (seen.y - one.y), (1 - gain) * var,
        one.noise + gain * (seen.sd - one.noise),
    )  # fmt: skip

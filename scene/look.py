"""What a thing looks like, over many sightings: its kind by vote, its colour, size and angle.

Pure. A look is never older than its thing: a sighting is worth less than what was seen thirty
times, so a class that flickers renames nothing.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from scene.sight import Detection

UNKNOWN = "other"
"""What a detector calls things of no kind that it knows."""
FADING = 0.97
"""What is left of a vote at the next one."""
FAVOUR = 8.0
"""Votes by which a challenger must exceed twice those of the name that a thing has."""
MEMORY = 20
"""Sightings over which size and angle are averaged."""
SPREAD = 0.15
"""Standard deviation of a side in a picture, as a share of it."""
GROWN, GROWN_MOST = 0.4, 12.0
"""Standard deviation of the log of a volume that is seen larger than the thing's, which nothing
hides, and the most that it says (nats): what stands before a thing makes it smaller, never larger.
"""
ODD, OFTEN = 0.35, 3
"""A side so much longer or shorter, so often in a row, is a thing that fell over."""
FALLEN = 1.2
"""By so much at least the footprint of a thing is larger that fell over."""
ROUND, TURN = 0.08, 0.12
"""Footprints with sides less apart than this share have no angle; an angle moves in such steps."""

Votes = Mapping[str, float]


@dataclass(frozen=True, eq=False)
class Look:
    """Votes for names and colours ("": none), sides (table units), angle (radians), feature."""

    names: Votes
    colors: Votes
    width: float
    height: float
    tall: float
    r: float
    feature: NDArray[np.float32]
    name: str
    count: int = 1
    odd: int = 0
    turning: int = 0
    upright: bool = True

    @property
    def color(self) -> str | None:
        """The colour most often seen; None where that is none."""
        return max(sorted(self.colors), key=lambda color: self.colors[color]) or None

    @property
    def radius(self) -> float:
        """Half of the footprint's mean side (table units)."""
        return (self.width + self.height) / 4


def first(seen: Detection, count: int = 1) -> Look:
    """The look of what is seen for the first time; ``count``: as good as so many sightings."""
    width, height, r = _turned(seen, 0.0)
    return Look(
        {seen.name: seen.score}, {seen.color or "": seen.score}, width, height, seen.tall, r,
        seen.feature, seen.name, count,
    )  # fmt: skip


def blended(look: Look, seen: Detection) -> Look:
    """The look after one more sighting."""
    names, colors = _voted(look.names, seen.name, seen), _voted(look.colors, seen.color or "", seen)
    return _sized(replace(look, names=names, colors=colors, feature=_mixed(look, seen)), seen)


def settled(look: Look, sure: bool) -> Look:
    """The look with the name that its votes give it; ``sure``: it had one that must be outvoted."""
    best = max(sorted(look.names), key=lambda name: look.names[name])
    needed = 2 * look.names.get(look.name, 0.0) + FAVOUR if sure else 0.0
    return replace(look, name=best) if look.names[best] > needed else look


def unlike(look: Look, seen: Detection) -> float:
    """How little a sighting looks like the thing, as minus a log likelihood (0: just like it)."""
    return _unlike(look, seen, {seen.name: 1.0}, {seen.color: 1.0} if seen.color else {})


def unlike_looks(one: Look, other: Look) -> float:
    """The same between two looks: a word counts by the share of the sightings that said it."""
    seen = Detection(
        other.name, 1.0, 0.0, 0.0, 0.0, other.width, other.height, other.tall, other.r,
        other.color, other.feature,
    )  # fmt: skip
    return _unlike(one, seen, other.names, other.colors if other.color else {})


def _unlike(look: Look, seen: Detection, names: Votes, colors: Votes) -> float:
    sides = zip((look.width, look.height, look.tall), _sides(look, seen), strict=True)
    larger = [math.log(b / a) for a, b in sides]
    size = sum(min((side / SPREAD) ** 2 / 2, 3.0) for side in larger)
    grown = min((max(sum(larger), 0.0) / GROWN) ** 2 / 2, GROWN_MOST)
    words = 0.7 * _doubt(look.names, names) + 0.5 * _doubt(look.colors, colors)
    return words + 0.5 * size + grown + 4 * (1 - _alike(look.feature, seen.feature))


def _doubt(votes: Votes, said: Votes) -> float:
    """Minus the log of how likely what was said is, by the votes before; 0 where nothing was."""
    if not said:
        return 0.0
    weight, total = sum(votes.values()) + 0.2, sum(said.values())
    share = sum(times * (votes.get(word, 0.0) + 0.1) for word, times in said.items())
    return min(-math.log(min(share / weight / total, 1.0)), 3.0)


def _alike(one: NDArray[np.float32], other: NDArray[np.float32]) -> float:
    """Cosine of two features; 1 where there is nothing to compare."""
    if one.shape != other.shape or not one.size:
        return 1.0
    long = float(np.linalg.norm(one) * np.linalg.norm(other))
    return float(one @ other) / long if long else 1.0


def _voted(votes: Votes, word: str, seen: Detection) -> Votes:
    faded = {key: FADING * value for key, value in votes.items() if value > 0.01}
    faded[word] = faded.get(word, 0.0) + seen.score
    return faded


def _mixed(look: Look, seen: Detection) -> NDArray[np.float32]:
    if look.feature.shape != seen.feature.shape:
        return seen.feature
    share = 1 / min(look.count + 1, MEMORY)
    mixed: NDArray[np.float32] = (1 - share) * look.feature + share * seen.feature
    return mixed


def _sides(look: Look, seen: Detection) -> tuple[float, float, float]:
    width, height, _ = _turned(seen, look.r)
    return width, height, seen.tall


def _turned(seen: Detection, r: float) -> tuple[float, float, float]:
    """Width, height and angle of a footprint, told so that its angle is the nearest to ``r``.

    A rectangle turned by a quarter is the same with its sides swapped, by a half the same.
    """
    if abs(seen.width - seen.height) < ROUND * max(seen.width, seen.height):
        return seen.width, seen.height, r
    quarter = round((r - seen.r) / (math.pi / 2))
    angle = seen.r + quarter * math.pi / 2
    if quarter % 2:
        return seen.height, seen.width, angle
    return seen.width, seen.height, angle


def _sized(look: Look, seen: Detection) -> Look:
    """Sides and angle after one more sighting; a thing that fell over is measured anew."""
    width, height, angle = _turned(seen, look.r)
    new, old = (width, height, seen.tall), (look.width, look.height, look.tall)
    odd = any(abs(math.log(a / b)) > ODD for a, b in zip(new, old, strict=True))
    if odd and look.odd + 1 < OFTEN:
        return replace(look, odd=look.odd + 1)
    if odd:
        return replace(
            look, width=width, height=height, tall=seen.tall, r=angle, count=1, odd=0, turning=0,
            upright=_upright(look, new),
        )  # fmt: skip
    share = 1 / min(look.count + 1, MEMORY)
    sides = [a + share * (b - a) for a, b in zip(old, new, strict=True)]
    r, turning = _angle(look, angle, share)
    return replace(
        look, width=sides[0], height=sides[1], tall=sides[2], r=r, turning=turning,
        count=look.count + 1, odd=0,
    )  # fmt: skip


def _upright(look: Look, new: tuple[float, float, float]) -> bool:
    """Whether it stands, by its new sides: what fell over is as long as it was tall, and covers
    more of the table. By its height alone, which can hardly be seen from above, nothing fell."""
    if look.upright:
        long, wider = max(new[0], new[1]), new[0] * new[1] > FALLEN * look.width * look.height
        low = new[2] < (1 - ODD / 2) * look.tall
        return not (low and wider and abs(math.log(long / look.tall)) < ODD)
    return new[2] > (1 + ODD / 2) * look.tall


def _angle(look: Look, angle: float, share: float) -> tuple[float, int]:
    """The thing's angle and for how many sightings it has been seen at another."""
    off = angle - look.r
    if abs(off) <= TURN:
        return look.r + share * off, 0
    if look.turning + 1 < OFTEN:
        return look.r, look.turning + 1
    return angle, 0

"""What is found in a picture, sorted by what is known: missed, made of two, or several as one.

A detector makes one thing of two in touch, or of what lies in a box and the box; what is known of
them, and where they should be (`scene.expected`), tells them apart.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import compress
from typing import NamedTuple

from scene.kept import Kept, alike, as_wide, far, paired, said_of, told, unlike
from scene.sight import Detection


class Findings(NamedTuple):
    """What there is in a picture: what was ``found`` and what was known of each before, what was
    ``missed``, by what is known of it, and what is ``vague``: there, but nobody sees where. What
    was ``wrong``: known as one thing, and made of two."""

    found: Sequence[Detection]
    before: Sequence[Kept | None]
    missed: Sequence[Kept] = ()
    vague: Sequence[Detection] = ()
    wrong: Sequence[Kept] = ()

    def told(self, known: Sequence[Kept | None]) -> tuple[Detection, ...]:
        """As it is told, by what is known of what was found."""
        both = zip([*self.found, *(one.said for one in self.missed)], [*known, *self.missed],
                   strict=True)  # fmt: skip
        return (*(told(one, old) for one, old in both), *self.vague)

    def parted(self, expected: Sequence[Detection]) -> Findings:
        """Without what is made of an expected thing and of one that is expected beside it: that one
        is there, vaguely. And without what shows other sides than what rests there and is
        expected: that is known otherwise."""
        seen = self.told(self.before)
        found, before = list[Detection](), list[Kept | None]()
        vague, wrong = list[Detection](), list[Kept]()
        for one, said, old in zip(seen, self.found, self.before, strict=True):
            want = one_of_two(one, expected)
            if want is not None:
                vague.append(replace(want, sd=(one.width + one.height) / 8))
                wrong += [] if old is None else [old]
            elif not (outgrown(said, old) and any(alike(it, one) for it in expected)):
                found.append(said)
                before.append(old)
        return Findings(found, before, vague=vague, wrong=wrong)

    def lost(self, expected: Sequence[Detection]) -> list[Detection]:
        """What is expected and was not found."""
        return lost_of(expected, self._replace(vague=()).told(self.before))

    def with_missed(self, missed: Sequence[Kept], expected: Sequence[Detection]) -> Findings:
        """With what was missed, and without what is several things taken for one, or what lies on
        something and that."""
        seen, more = self.told(self.before), [one.made for one in missed]
        there = [it for it in (*there_of(expected, seen), *more) if not it.base]
        lying = [it for it in more if it.base]
        apart = [
            not of_several(one, there)
            and (any(alike(it, one) for it in expected) or not any(within(it, one) for it in lying))
            for one in seen[: len(self.found)]
        ]
        found, before = list(compress(self.found, apart)), list(compress(self.before, apart))
        vague = [one for one in self.vague if not any(alike(it, one) for it in more)]
        return Findings(found, before, missed, vague)


def lost_of(expected: Sequence[Detection], seen: Sequence[Detection]) -> list[Detection]:
    """What is expected and not found, each thing found standing for one: a box for itself, and not
    for the apple in it as well."""
    pairs = paired(
        ((0.0, unlike(one, other)), n, k)
        for n, one in enumerate(expected)
        for k, other in enumerate(seen)
        if alike(one, other)
    )
    return [one for n, one in enumerate(expected) if n not in pairs]


def there_of(expected: Sequence[Detection], seen: Sequence[Detection]) -> list[Detection]:
    """Of all that is expected what is found: as what is nearest to it."""
    pairs = ((one, [other for other in seen if alike(one, other)]) for one in expected)
    return [min(near, key=lambda it: far(one, it)) for one, near in pairs if near]


def within(one: Detection, other: Detection) -> bool:
    """Whether a thing stands where another one is."""
    return far(one, other) < (other.width + other.height) / 4


def of_several(one: Detection, there: Sequence[Detection]) -> bool:
    """Whether what is found is several things taken for one: those of ``there``, which are known to
    stand on the table and are seen apart."""
    inside = [other for other in there if within(other, one)]
    return len(inside) > 1 and all(other is not one for other in inside)


def one_of_two(one: Detection, expected: Sequence[Detection]) -> Detection | None:
    """What is expected there of which, and of what is expected beside that, a found thing is made:
    it shows other sides, and reaches over the other. None where it may well be one thing."""
    wants = [want for want in expected if alike(want, one)]
    if not wants or any(as_wide(want, one) for want in wants):
        return None
    nearest = min(wants, key=lambda want: far(want, one))
    beside = (it for it in expected if it is not nearest and not it.base)
    return nearest if any(_reaches(one, it) for it in beside) else None


def _reaches(one: Detection, other: Detection) -> bool:
    """Whether a thing is found to reach over a good part of another one, as none beside it can."""
    dx, dy = other.x - one.x, other.y - one.y
    cos, sin = math.cos(one.r), math.sin(one.r)
    beside = abs(dx * cos + dy * sin) - one.width / 2, abs(dy * cos - dx * sin) - one.height / 2
    return math.hypot(max(beside[0], 0.0), max(beside[1], 0.0)) < (other.width + other.height) / 8


def outgrown(one: Detection, old: Kept | None) -> bool:
    """Whether what is found shows other sides than what is known to rest there."""
    if old is None or not old.rests:
        return False
    return not said_of(one, old) and not as_wide(old.made, one)

"""What size words compare: which of a thing's measures "short", "long", "fat" speak of.

A word can speak of more than one measure, by how the things lie: a short pen is one that is not
long, a short candle one that is not tall. Where two readings tell different things apart, both are
kept, and nothing is chosen.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import pairwise

from clarifier.lexicon import Lexicon
from clarifier.things import Thing, size_of
from scene.types import Scene, SceneObject

SIZE_TIE = 1.05
"""Sizes whose ratio is less look the same size."""
SIZE_TIE_M = 0.002
"""So do those that differ by less (metres)."""

_RANKS = {"first": 1, "second": 2, "next": 2, "third": 3, "fourth": 4, "fifth": 5}
Measure = Callable[[SceneObject], float]
"""A length (table units), larger for what the word fits better; negative for "small", "short"."""


def bulk(item: SceneObject) -> float:
    """The side of the cube that takes as much room: how large a thing is (table units)."""
    return math.cbrt(item.width * item.height * item.tall)


def _tall(item: SceneObject) -> float:
    return item.tall


def _wide(item: SceneObject) -> float:
    return item.width


def _long(item: SceneObject) -> float:
    return max(item.width, item.height, item.tall)


def _thick(item: SceneObject) -> float:
    return min(item.width, item.height)


def _less(measure: Measure) -> Measure:
    return lambda item: -measure(item)


def _flat(item: SceneObject) -> bool:
    """Whether a thing lies like a book or a plate: its thickness is its height."""
    return item.tall < _thick(item) / 2


def _drawn_out(item: SceneObject) -> bool:
    """Whether a thing lies like a pen: its length is far more than its height and its width."""
    return item.tall < _long(item) / 2 and 1.5 * _thick(item) < _long(item)


def _readings(size: str, items: Sequence[SceneObject]) -> tuple[tuple[Measure, ...], ...]:
    """What the word may speak of, the likelier first; those of one group are equally likely."""
    if size in ("thick", "thin"):
        flat = [_flat(item) for item in items]
        both: tuple[tuple[Measure, ...], ...] = ((_tall, _thick),)
        if all(flat) or not any(flat):
            both = ((_tall,), (_thick,)) if all(flat) else ((_thick,),)
        return both if size == "thick" else tuple(tuple(map(_less, group)) for group in both)
    if size == "short":
        lying = all(_drawn_out(item) for item in items)
        return ((_less(_long),), (_less(_tall),)) if lying else ((_less(_tall),), (_less(_long),))
    return {
        "big": ((bulk,),), "small": ((_less(bulk),),), "tall": ((_tall,),), "long": ((_long,),),
        "wide": ((_wide,),), "narrow": ((_less(_wide),),),
    }[size]  # fmt: skip


def look_alike(one: float, other: float, scene: Scene) -> bool:
    """Whether nobody can see which of two sizes (table units) is the larger."""
    large, small = max(abs(one), abs(other)), min(abs(one), abs(other))
    return large < small * SIZE_TIE or large - small < scene.units(SIZE_TIE_M)


def by_size(
    size: str, found: list[Thing], scene: Scene, many: int = 1, nth: int = 1
) -> list[Thing]:
    """The ``many`` largest (smallest, ...) of them from the ``nth`` on, and those that are not
    clearly different from the last of these; ``many`` 0: those that stand out as large."""
    kept: set[str] = set()
    for measure in _telling(size, found, scene):
        values = {thing.id: measure(thing.item) for thing in found}
        order = sorted(values.values(), reverse=True)
        if nth > 1:
            taken = order[nth - 1 : nth - 1 + max(many, 1)]
            kept |= {one for one, value in values.items()
                     if any(look_alike(value, each, scene) for each in taken)}  # fmt: skip
            continue
        last = order[min(many, len(order)) - 1] if many else _clear_step(order, scene)
        kept |= {one for one, value in values.items()
                 if value >= last or look_alike(value, last, scene)}  # fmt: skip
    return [thing for thing in found if thing.id in kept]


def _telling(size: str, found: Sequence[Thing], scene: Scene) -> tuple[Measure, ...]:
    """The measures by which the things can be told apart, of the likeliest reading that has one."""
    groups = _readings(size, [thing.item for thing in found]) if found else ()
    for group in groups:
        tells = tuple(m for m in group if not _all_alike([m(t.item) for t in found], scene))
        if tells:
            return tells
    return groups[0][:1] if groups else ()


def _all_alike(values: Sequence[float], scene: Scene) -> bool:
    return look_alike(max(values), min(values), scene)


def _clear_step(order: Sequence[float], scene: Scene) -> float:
    """The last value before the largest step down, relative to its size."""
    steps = [(max(abs(a), abs(b)) / min(abs(a), abs(b)), a, b)
             for a, b in pairwise(order)]  # fmt: skip
    _, value, after = max(steps, key=lambda step: step[0], default=(0.0, order[-1], order[-1]))
    return order[-1] if look_alike(value, after, scene) else value


def halfway(found: list[Thing], scene: Scene) -> list[Thing]:
    """The one of three, five, ... that is neither large nor small, and those that look like it."""
    if len(found) % 2 == 0:
        return found
    order = sorted(bulk(thing.item) for thing in found)
    middle = order[len(order) // 2]
    return [thing for thing in found if look_alike(bulk(thing.item), middle, scene)]


def nth_in_size(
    said: Sequence[str], lexicon: Lexicon
) -> tuple[tuple[int, str] | None, tuple[int, ...]]:
    """ "Second largest", "next tallest": the rank and the size, and where the two words stand."""
    for i, (word, after) in enumerate(pairwise(said)):
        if word in _RANKS and after.endswith("est") and size_of(after, lexicon):
            return (_RANKS[word], after), (i, i + 1)
    return None, ()

"""Which is the largest, the shortest, the widest: only where a person could see it.

What a program compares by size it compares to the last digit. Words that leave nothing open speak
of things that are told apart by eye, which is `clarifier.ranks.look_alike`'s matter alone.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping

from clarifier.sizes import bulk, look_alike
from evals.seed_proof import Value
from scene.types import Scene, SceneObject, identifiers

_BULK = re.compile(r"\b(?P<which>largest|smallest)\((?P<things>\w+|\[[^\]]*\])\)")
_SIDE = re.compile(
    r"\bordered\((?P<things>\w+), \[one\.(?P<side>tall|width) for one in \w+\]\) ?\[(?P<at>0|-1)\]"
)


def told_apart(program: str, values: Mapping[str, Value], scene: Scene) -> bool:
    """Whether what a program with these slots chooses by size stands out among its like."""
    for things, measure, first in _choices(program):
        known = identifiers(scene)
        ids = [one for slot in re.findall(r"\w+", things) for one in _names(values.get(slot))]
        sizes = sorted(measure(known[one]) for one in ids)
        if len(sizes) > 1:
            one, other = sizes[:2] if first else sizes[-2:]
            if look_alike(one, other, scene):
                return False
    return True


def _choices(program: str) -> Iterator[tuple[str, Callable[[SceneObject], float], bool]]:
    """What is chosen from, by what measure, and whether the least is taken."""
    for said in _BULK.finditer(program):
        yield said["things"], bulk, said["which"] == "smallest"
    for said in _SIDE.finditer(program):
        tall = said["side"] == "tall"
        yield said["things"], _tall if tall else _width, said["at"] == "0"


def _tall(item: SceneObject) -> float:
    return item.tall


def _width(item: SceneObject) -> float:
    return item.width


def _names(value: Value | None) -> list[str]:
    if isinstance(value, str):
        return [value]
    return list(value) if isinstance(value, list) else []

"""Objects as values of the little language: opaque handles with the numbers of a scene object.

A program can hold a `Thing`, compare it, put it into lists and read its numbers; nothing else of
a scene object can be reached through it.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

import msgspec

from scene.kinds import FOUR_WALLED, head_noun, is_container
from scene.types import SceneObject


class Thing:
    """One object, as it was when the program started or as ``at`` says it stands now."""

    __slots__ = ("item",)
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, item: SceneObject) -> None:
        self.item = item

    def same(self, other: object) -> bool:
        """Whether this is the same object, wherever either is said to stand."""
        return isinstance(other, Thing) and other.item.id == self.item.id

    @property
    def look(self) -> str:
        """Its colour, or where it has none its name."""
        return self.item.color or self.item.name

    @property
    def open_box(self) -> bool:
        """Whether it stands open at the top, with four walls."""
        name = self.item.name
        return self.item.upright and is_container(name) and head_noun(name) in FOUR_WALLED

    def standing(self, x: float, y: float, z: float) -> Thing:
        """The object as if it stood there (table units)."""
        return Thing(msgspec.structs.replace(self.item, x=x, y=y, z=z))

    def turned(self, angle: float) -> Thing:
        """The object turned so much further, anticlockwise (radians)."""
        return Thing(
            msgspec.structs.replace(self.item, r=math.remainder(self.item.r + angle, math.tau))
        )


class Choice(list[Any]):
    """A place, a list ``[x, y]``, that says which would do as well: ``places``, best first."""

    __slots__ = ("places",)

    def __init__(self, place: Iterable[Any], places: list[Any]) -> None:
        super().__init__(place)
        self.places = places


def choose(items: Iterable[SceneObject], words: str, waiting: bool) -> list[SceneObject]:
    """The objects whose name and colour have all of the words, in scene order.

    ``waiting``: of those in the tray (what an arrange program moves), else of those on the table
    or in the gripper.
    """
    wanted = set(words.lower().split())
    return [
        item
        for item in items
        if (item.on == "tray") is waiting and item.on != "floor" and wanted <= _words(item)
    ]


def _words(item: SceneObject) -> set[str]:
    return {*item.name.lower().split(), *(item.color or "").lower().split()}

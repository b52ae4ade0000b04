"""A phrase that names things and nothing besides, read against the scene."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import NamedTuple

from clarifier.lexicon import Lexicon
from clarifier.mentions import link, link_answer
from scene.types import Scene, SceneObject

Test = Callable[[SceneObject], bool | None]
"""Whether it is true of an object; None where the scene does not tell it clearly."""


class Predicate(NamedTuple):
    """A test of one object; ``others`` are the things that it speaks of besides; ``where`` is the
    place that it names ("to the left of the bowl"), or empty; ``holder``: whether it is about what
    stands on it."""

    test: Test
    others: tuple[str, ...] = ()
    where: str = ""
    holder: bool = False


class Fact(NamedTuple):
    """``holds`` is None where the scene does not tell clearly. ``about`` are the objects that "it"
    or "them" behind the clause mean, ``name`` the words for them; ``others`` what it speaks of
    besides; ``where`` the place that it names; ``said`` the clause as a statement that is true;
    ``negative``: it is denied ("the cup isn't red"); ``kind``: what was counted ("red blocks")."""

    holds: bool | None
    about: tuple[str, ...]
    name: str
    others: tuple[str, ...] = ()
    where: str = ""
    said: str = ""
    negative: bool = False
    kind: str = ""


class Named(NamedTuple):
    """The objects that a phrase fits; ``several``: it speaks of all of them."""

    objects: tuple[str, ...]
    several: bool


IT = frozenset({"it", "they", "them", "that", "this", "that one", "this one", "he", "she"})
TABLE = frozenset(
    {"table", "tabletop", "desk", "bench", "worktop", "counter", "workbench", "surface"}
    | {"countertop", "workspace"}
)
"""What the table is called where no thing is."""


class Things:
    """Reads phrases on one scene; ``it`` is what "it" stands for."""

    def __init__(self, scene: Scene, lexicon: Lexicon, it: tuple[str, ...] = ()) -> None:
        self.scene = scene
        self.lexicon = lexicon
        self.it = it

    def named(self, text: str) -> Named | None:
        """A phrase that names things and nothing besides; None for any other words."""
        if text.strip() in IT:
            return Named(self.it, len(self.it) > 1) if self.it else None
        if " and " in text:
            parts = [
                self.single(part) for part in re.split(r" and |, ", text.removeprefix("both "))
            ]
            if all(parts):
                return Named(tuple(dict.fromkeys(one.id for one in parts if one)), True)
        linked = link_answer(text, self.scene, self.lexicon)
        whole = linked.spoken[0] if linked.spoken else None
        if whole is None or whole.phrase is None or whole.opened or whole.last < len(linked.tokens):
            return None
        if whole.phrase.det in ("no", "another", "other", "others"):
            return None
        found = whole.mention.objects or self._upon_the_table(text)
        return Named(found, whole.mention.plural)

    def _upon_the_table(self, text: str) -> tuple[str, ...]:
        """ "The pencil on the desk", where the desk is the table and no thing of the scene."""
        linked = link(text, self.scene, (), self.lexicon)
        one = linked.spoken[0] if linked.spoken else None
        rest = {token.text for token in linked.tokens[one.last :]} if one is not None else set()
        told = "on" in rest and rest & TABLE and rest <= TABLE | {"on", "the", "my", "our"}
        return one.mention.objects if one is not None and told else ()

    def single(self, text: str) -> SceneObject | None:
        """The one thing that a phrase names."""
        named = self.named(text)
        return self.scene.get(named.objects[0]) if named and len(named.objects) == 1 else None

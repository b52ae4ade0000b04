"""The words for the things of an episode: what leaves nothing open, and what does.

A reference is clear by its type, colour, place or order (`evals.naming`); or any of several will do
("an apple"), or one of them is meant and it is not said which, or how many, or nothing bears the
noun.
"""

from __future__ import annotations

import random
import re
from collections.abc import Mapping, Sequence

from evals.naming import namesakes, pick
from evals.seed_proof import Value
from evals.wordings import Group, Sort
from scene.generate import CLASSES
from scene.types import Scene, identifiers
from translator.corpus.seed import ANGLES, COUNTS, GROUPS, LENGTHS, OBJECTS, Seed

STRANGE = ("glorp", "snorfle", "quibbet", "wumple", "trindle")
"""Nouns that nobody knows."""
UNSEEN = ("purple", "pink", "black", "white")
"""Colours of which no other is a shade."""
_WHOLE = re.compile(
    r"^(?:(?:put_all\w*|row|column|stack|put_in_line|in_shape|put_each)\(A[,)]|for one in A:)", re.M
)
"""A program that does the same with all of a group, however many they are."""
_WORDS = ("zero", "one", "two", "three", "four", "five")
_SPATIAL = ("side", "landmark", "order")


class References:
    """Words things by chance."""

    def __init__(self, chance: random.Random) -> None:
        self._chance = chance

    def open_slot(self, seed: Seed, say: str, group: Group, sort: Sort) -> str | None:
        """The slot whose reference is not simply clear; empty where all are; None: no such slot."""
        every = [slot for slot in seed.slots if slot in OBJECTS]
        things = every
        several = [slot for slot in seed.slots if slot in GROUPS]
        once = [slot for slot in things if say.count(f"{{{slot}}}") == 1]
        if sort == "any":
            # of two things that "an apple ... an apple" may be, neither is told by the program
            things = [] if "if " in seed.program else once
        if sort in ("clear", "infeasible"):
            return "" if group != "spatial" or every else None
        if sort == "how_many" or (several and group == "numeric" and self._chance.random() < 0.5):
            things = several if _WHOLE.search(seed.program) and "one of" not in say else []
        return self._chance.choice(things) if things else None

    def phrases(
        self, seed: Seed, bound: dict[str, Value], scene: Scene, open_slot: str, group: Group
    ) -> dict[str, str] | None:
        """Words for every slot but the open one; measures are changed to what they say."""
        phrases: dict[str, str] = {}
        spatial = False
        for slot, value in bound.items():
            if slot == open_slot:
                continue
            if slot in LENGTHS + ANGLES + COUNTS:
                phrases[slot], bound[slot] = self._measure(slot, value)
            elif isinstance(value, list):
                phrases[slot] = self._group(value, scene)
            else:
                item = identifiers(scene)[str(value)]
                found = pick(scene, item, self._chance, _SPATIAL) if group == "spatial" else None
                spatial = spatial or found is not None
                found = found or pick(scene, item, self._chance)
                if found is None:
                    return None
                phrases[slot] = f"the {found.text}"
        wants_spatial = group == "spatial" and len(phrases) > 0
        return None if wants_spatial and not spatial else phrases

    def _measure(self, slot: str, value: Value) -> tuple[str, Value]:
        chance = self._chance
        if slot in LENGTHS:
            cm = chance.choice((3, 4, 5, 6, 7, 8, 10))
            said = chance.choice((f"{cm} cm", f"{cm} centimetres", f"{cm}cm", f"{10 * cm} mm"))
            return said, cm / 20
        if slot in ANGLES:
            degrees = chance.choice((30, 45, 60, 90, 120))
            return chance.choice((f"{degrees} degrees", f"{degrees}°")), degrees * 3.14159265 / 180
        assert isinstance(value, float)
        return chance.choice((_WORDS[int(value)], str(int(value)))), value

    def _group(self, members: Sequence[str], scene: Scene) -> str:
        """ "all the apples": every one of that name there is."""
        noun, count = _plural(members, scene), len(members)
        ways = [f"the {noun}", f"all the {noun}", f"the {_WORDS[count]} {noun}"]
        return self._chance.choice([*ways, f"both {noun}"] if count == 2 else ways)

    def choices(
        self, bound: Mapping[str, Value], open_slot: str, scene: Scene, sort: Sort,
        phrases: dict[str, str],
    ) -> list[list[Value]] | None:  # fmt: skip
        """What the open slot may stand for: a list for each meaning of those that are all right.
        Its phrase goes into ``phrases``."""
        if not open_slot or sort in ("clear", "infeasible"):
            return [[]]
        value, chance = bound[open_slot], self._chance
        if isinstance(value, list):
            return self._grouped(value, open_slot, scene, sort, phrases)
        item = identifiers(scene)[str(value)]
        names = {other.id: name for name, other in identifiers(scene).items()}
        same = [names[other.id] for other in namesakes(scene, item)]
        if sort == "absent":
            phrases[open_slot] = f"the {self._absent(item.name, scene)}"
            return []
        if sort == "any":
            ways = (_article(item.name), f"any {item.name}", f"one of the {_plural(same, scene)}")
            phrases[open_slot] = chance.choice(ways)
            return [list(same)]
        phrases[open_slot] = f"the {item.name}"
        return [[one] for one in same]

    def _grouped(
        self, value: list[str], open_slot: str, scene: Scene, sort: Sort, phrases: dict[str, str]
    ) -> list[list[Value]] | None:
        """The same for a slot that stands for several things."""
        item = identifiers(scene)[value[0]]
        names = {other.id: name for name, other in identifiers(scene).items()}
        same = [names[other.id] for other in namesakes(scene, item)]
        noun = _plural(same, scene)
        some = [[one for one in same if one != left] for left in same]
        if sort == "how_many":
            phrases[open_slot] = self._chance.choice((f"a few {noun}", f"several {noun}"))
            if len(same) < 3:
                return None
            return [[list(few) for few in _subsets(same, n)] for n in range(2, len(same) + 1)]
        if sort == "absent" or len(same) < 3:
            return None
        count = _WORDS[len(same) - 1]
        phrases[open_slot] = f"{count} {noun}" if sort == "any" else f"the {count} {noun}"
        every: list[Value] = list(some)
        return [every] if sort == "any" else [[few] for few in some]

    def _absent(self, noun: str, scene: Scene) -> str:
        """A noun, or a noun with a colour, that nothing on the table bears."""
        chance, way = self._chance, self._chance.random()
        there = {word for item in scene for word in item.name.split()}
        if way < 0.2:
            return chance.choice(STRANGE)
        if way < 0.5:
            borne = {item.color for item in scene if item.name == noun}
            return f"{chance.choice([one for one in UNSEEN if one not in borne])} {noun}"
        return chance.choice([word for word in CLASSES if word not in there])


def _plural(members: Sequence[str], scene: Scene) -> str:
    name = identifiers(scene)[members[0]].name
    return f"{name[:-1]}ies" if name.endswith("ry") else (
        f"{name}es" if name.endswith(("x", "ss", "h", "ato")) else f"{name}s")  # fmt: skip


def _article(name: str) -> str:
    return f"{'an' if name[0] in 'aeiou' else 'a'} {name}"


def _subsets(members: Sequence[str], count: int) -> list[list[str]]:
    """Some ways to take so many of them: runs of neighbours, around the end."""
    doubled = [*members, *members]
    return [doubled[at : at + count] for at in range(len(members))][: 1 if count == len(members)
                                                                    else None]  # fmt: skip

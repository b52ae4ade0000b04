"""Which objects the slots of a sentence stand for: every way to choose them, the nearest first."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence

from clarifier.spoken import Linked
from scene.types import Scene

Binding = Mapping[str, tuple[str, ...]]
"""For each slot of a mention the ids of the objects that it stands for: one, or a group's."""

MAX_BINDINGS = 12
"""Most bindings of slots to objects that are tried."""


def bound_objects(binding: Binding) -> tuple[str, ...]:
    """Every object of a binding, once."""
    return tuple(dict.fromkeys(o for objects in binding.values() for o in objects))


def bindings(linked: Linked, scene: Scene, chosen: Binding) -> list[dict[str, tuple[str, ...]]]:
    """Bindings of every slot, the ``chosen`` ones fixed; free mentions take the nearest first.

    Two slots for one thing never share it; a group that may be any of several takes no other's.
    """
    slots = [slot for slot in linked.slots if slot not in chosen]
    pools = [_choices(linked, slot, scene) for slot in slots]
    free = {s for s in linked.slots if linked.first(s).mention.free}
    found: list[dict[str, tuple[str, ...]]] = []
    for picks in itertools.islice(itertools.product(*pools), 10 * MAX_BINDINGS):
        binding = _without_taken(linked, {**chosen, **dict(zip(slots, picks, strict=True))})
        if _apart(binding, free) and len(found) < MAX_BINDINGS:
            found.append(binding)
    return found


def _without_taken(
    linked: Linked, binding: dict[str, tuple[str, ...]]
) -> dict[str, tuple[str, ...]]:
    """The binding with "the rest" less what the other slots take of the same things."""
    for slot in linked.slots:
        phrase = linked.first(slot).phrase
        if phrase is not None and phrase.group in ("rest", "others") and slot in binding:
            taken = {o for other, objects in binding.items() if other != slot for o in objects}
            left = tuple(o for o in binding[slot] if o not in taken)
            binding = {**binding, slot: left or binding[slot]}
    return binding


def _choices(linked: Linked, slot: str, scene: Scene) -> list[tuple[str, ...]]:
    """What a slot may stand for: one thing of several, or so many of a group, or all of it."""
    spoken = linked.first(slot)
    objects = spoken.mention.objects
    if not spoken.mention.plural:
        return [(one,) for one in near_first(objects, scene)]
    if not 0 < spoken.count < len(objects):
        return [objects]
    few = itertools.combinations(near_first(objects, scene), spoken.count)
    return list(itertools.islice(few, MAX_BINDINGS))


def _apart(binding: Binding, free: set[str]) -> bool:
    """Whether no two slots stand for the same thing, whole groups aside."""
    singles = [objects[0] for objects in binding.values() if len(objects) == 1]
    if len(set(singles)) < len(singles):
        return False
    return not any(
        set(objects) & set(others)
        for slot, objects in binding.items()
        for other, others in binding.items()
        if slot in free and slot != other
    )


def near_first(objects: Sequence[str], scene: Scene) -> list[str]:
    """Objects by distance from the table's middle: the easiest to reach first."""

    def away(object_id: str) -> float:
        item = scene.get(object_id)
        return math.hypot(*item.position) if item.x is not None else 0.0

    return sorted(objects, key=away)

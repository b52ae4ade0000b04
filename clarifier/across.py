"""One thing upon two: "lay the plank across the two blocks", "rest the rod upon both supports".

What lies on two things is a bridge, and the sentence is put so, the two named one by one. A program
that puts what is to carry onto what it is to carry is not what was said.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

from clarifier.spoken import Linked, Spoken, settles
from clarifier.words import singular
from scene.relations import gap
from scene.types import Scene, SceneObject

_OVER = frozenset({"across", "over", "upon", "on", "onto", "atop", "bridging", "spanning"})
_SPANS = frozenset({"across", "over", "bridging", "spanning"})
_LIGHT = frozenset({"top", "of", "to", "the", "both", "two", "rests", "lies", "goes", "so"}
                   | {"that", "it", "is", "right", "straight", "lying", "laid"})  # fmt: skip
_LEVEL = 0.02
"""Tops that differ by less are level (table units)."""
_REACHES = 0.6
"""A thing rests on two whose gap is less than this share of it."""
_APART = 0.05
"""Two things nearer than this along an axis are not told apart by it (table units)."""


class Upon(NamedTuple):
    """``carried`` ends on what carries it, never the other way about."""

    carried: tuple[str, ...]
    carriers: tuple[str, ...]


def laid_across(linked: Linked, scene: Scene) -> str | None:
    """The sentence as the bridge that it asks for; None where it asks for none."""
    for two in linked.spoken:
        one = _before(two, linked)
        if one is None or len(two.mention.objects) != 2 or two.phrase is None:
            continue
        between = {token.text for token in linked.tokens[one.last : two.first]}
        told = bool(between & _SPANS) or (bool(between & _OVER) and two.count == 2)
        if not told or not between <= _OVER | _LIGHT or not two.mention.plural:
            continue
        names = _told_apart(two, scene)
        start = linked.tokens[0].start
        thing = linked.text[one.mention.start : one.mention.end]
        if _spans(one, two, scene):
            continue  # a bridge is built anew, these are to stay where they stand
        if names is not None and _is_whole(one, two, linked):
            first, second = names
            bridge = f"build a bridge with the {thing} across the {first} and the {second}"
            return f"{linked.text[:start]}{bridge}{linked.text[two.mention.end :]}"
    return None


def resting_on(linked: Linked, scene: Scene) -> str | None:
    """ "Put the cube on the red block and the blue block", "... on the red and blue blocks", where
    the two stand so close that it rests on both: as what lies across them. None else."""
    if not 2 <= len(linked.spoken) <= 3 or not settles(linked.spoken[0].mention):
        return None
    one, *marks = linked.spoken
    last = marks[-1]
    if one.phrase is None or marks[0].relation != "on" or not _is_whole(one, last, linked):
        return None
    two = tuple(scene.get(o) for mark in marks for o in mark.mention.objects)
    thing = scene.get(one.mention.objects[0])
    if len(two) != 2 or not _carry(thing, *two):
        return None
    if len(marks) == 2:
        between = [token.text for token in linked.tokens[marks[0].last : last.opened]]
        if between != ["and"] or not all(settles(mark.mention) for mark in marks):
            return None
        names: tuple[str, str] | None = (marks[0].mention.text, last.mention.text)
    else:
        names = _by_color(last, two) or _told_apart(last, scene)
    if names is None:
        return None
    name = linked.text[one.mention.start : one.mention.end]
    start, end = linked.tokens[0].start, linked.text[last.mention.end :]
    return f"{linked.text[:start]}rest the {name} across the {names[0]} and the {names[1]}{end}"


def _carry(thing: SceneObject, one: SceneObject, other: SceneObject) -> bool:
    """Whether two are level, and so close that a thing can rest on both as they stand."""
    if None in (one.x, other.x):
        return False
    level = abs((one.z + one.tall) - (other.z + other.tall)) <= _LEVEL
    return level and gap(one, other) < _REACHES * min(thing.width, thing.height)


def _by_color(two: Spoken, items: tuple[SceneObject, ...]) -> tuple[str, str] | None:
    """ "The red and blue blocks" one by one."""
    colors = [item.color for item in items]
    if two.phrase is None or not two.phrase.head or not two.phrase.also or None in colors:
        return None
    noun = " ".join((*two.phrase.head[:-1], singular(two.phrase.head[-1])))
    return (f"{colors[0]} {noun}", f"{colors[1]} {noun}") if colors[0] != colors[1] else None


def _before(landmark: Spoken, linked: Linked) -> Spoken | None:
    """The one thing that is named last before a group."""
    ahead = [one for one in linked.spoken if one.last <= landmark.opened and one.phrase]
    return ahead[-1] if ahead and settles(ahead[-1].mention) else None


def _spans(one: Spoken, two: Spoken, scene: Scene) -> bool:
    """Whether a thing reaches from one to the other of the two as they stand."""
    (thing,) = (scene.get(o) for o in one.mention.objects)
    places = [item.position for o in two.mention.objects if (item := scene.get(o)).x is not None]
    return len(places) == 2 and math.dist(*places) <= max(thing.width, thing.height)


def _is_whole(one: Spoken, two: Spoken, linked: Linked) -> bool:
    """Whether the sentence asks for nothing else."""
    verbs = [chunk for chunk in linked.chunks if chunk.kind == "verb" and chunk.first > two.last]
    return linked.spoken[0] == one and linked.spoken[-1] == two and not verbs


def _told_apart(two: Spoken, scene: Scene) -> tuple[str, str] | None:
    """Names that tell the two apart: by colour, else by the side on which each stands."""
    assert two.phrase is not None
    items = [scene.get(o) for o in two.mention.objects]
    if not two.phrase.head or any(item.x is None for item in items):
        return None
    noun = " ".join((*two.phrase.modifiers, *two.phrase.head[:-1], singular(two.phrase.head[-1])))
    one, other = items
    if one.color and other.color and one.color != other.color and not two.phrase.modifiers:
        return f"{one.color} {noun}", f"{other.color} {noun}"
    for words, key in ((("left", "right"), _x), (("near", "far"), _y)):
        low, high = sorted(items, key=key)
        if key(high) - key(low) > _APART:
            return f"{words[0]} {noun}", f"{words[1]} {noun}"
    return None


def _x(item: SceneObject) -> float:
    return item.position[0]


def _y(item: SceneObject) -> float:
    return item.position[1]


def upon(linked: Linked, binding: Mapping[str, tuple[str, ...]]) -> tuple[Upon, ...]:
    """What is to end on what, where what carries is not itself moved."""
    themes = {one.mention.slot for one in linked.spoken if one.theme}
    found = []
    for mark in linked.spoken:
        carried = [one for one in linked.spoken if one.theme and one.last <= mark.opened][-1:]
        if mark.relation not in ("on", "in") or not carried or mark.mention.slot in themes:
            continue
        movers = binding.get(carried[0].mention.slot, ())
        marks = binding.get(mark.mention.slot, ())
        if carried[0].phrase is not None and movers and marks and not set(movers) & set(marks):
            found.append(Upon(movers, marks))
    return tuple(found)


def carried_so(goal: Upon, before: Scene, after: Scene) -> bool:
    """Whether nothing that is to carry has come to stand on what it is to carry."""
    return not any(
        after.get(mark).on in goal.carried and before.get(mark).on not in goal.carried
        for mark in goal.carriers
    )

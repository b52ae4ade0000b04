"""Relations and parts of the table that tell things apart: what is true of them on the scene."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from clarifier.distances import UTMOST
from clarifier.lexicon import Lexicon
from clarifier.pieces import Phrase
from clarifier.ranks import NEAR_TIE_M, along, by_side, median
from clarifier.things import Thing, side_of
from scene import relations
from scene.types import Scene, SceneObject


@dataclass(frozen=True)
class Link:
    """A relation inside a phrase: "next to the bowl" (anchors) or "on the left" (sides);
    ``denied``: "that is not on the left"."""

    relation: str
    anchors: tuple[str, ...] = ()
    sides: tuple[str, ...] = ()
    denied: bool = False


def narrowed(link: Link, found: list[Thing], scene: Scene, many: int = 1) -> list[Thing]:
    """Those of which the relation is true; "in the middle" may also mean among their own kind: the
    ``many`` in the middle, where they are as well in the table's."""
    true_of = [thing for thing in found if holds(link, thing.item, scene)]
    if link.denied:
        return [thing for thing in found if thing not in true_of]
    if link.sides != ("middle",) or link.relation in ("nearest", "furthest"):
        return true_of
    among = median([thing for thing in found if thing.item.x is not None], many)
    if among and all(thing in true_of for thing in among):
        return among
    return [thing for thing in found if thing in true_of or thing in among]


def holds(link: Link, item: SceneObject, scene: Scene) -> bool:
    """Whether the relation is true of the object on the scene; nearest/furthest come later."""
    if item.x is None or link.relation in ("nearest", "furthest", UTMOST):
        return item.x is not None and item.id not in link.anchors
    if link.sides:
        return all(_on_side(side, item, scene) for side in link.sides)
    anchors = [scene.get(anchor) for anchor in link.anchors if anchor != item.id]
    placed = [anchor for anchor in anchors if anchor.x is not None]
    if link.relation == "between":
        pairs = [(a, b) for i, a in enumerate(placed) for b in placed[i + 1 :]]
        return any(relations.between(item, a, b) for a, b in pairs)
    return any(related(link.relation, item, anchor, scene) for anchor in placed)


def related(relation: str, item: SceneObject, anchor: SceneObject, scene: Scene) -> bool:
    """Whether ``item`` stands in a relation of the lexicon to ``anchor``."""
    if relation in ("on", "in"):
        return item.on == anchor.id
    if relation == "beside":
        return relations.next_to(scene, item, anchor)
    if relation in relations.ALONG:
        return relations.beside(scene, item, anchor, relation)
    return False


_COUNTED_FROM = frozenset({"left", "right", "near", "far"})
_SMALL = frozenset({"the", "very", "hand", "side", "both", "either", "two", "most", "table", "of"})
"""Words of a place that tell no side."""
_EDGES = {"left": "left", "right": "right", "far": "above", "near": "below"}


def _on_side(side: str, item: SceneObject, scene: Scene) -> bool:
    """Whether an object is in that part of the table ("on the left", "in the middle")."""
    if side == "table":
        return item.on not in ("floor", "tray", "gripper")
    if side == "floor":
        return item.on == "floor"
    if side == "middle":
        return relations.centred(scene, item)
    if side == "edge":
        return any(relations.at_edge(scene, item, edge) for edge in relations.ALONG)
    if side == "corner":
        return any(
            relations.in_corner(scene, item, far, along)
            for far in ("above", "below")
            for along in ("left", "right")
        )
    return along(side, item) > 0


def extreme(link: Link, found: list[Thing], scene: Scene, many: int = 1) -> list[Thing]:
    """The ``many`` nearest, furthest or furthest to a side; ``many`` 0: it was not said how many,
    and all on that side are meant."""
    if link.relation == UTMOST:
        ends = by_side(link.sides[0], found, scene, many)
        if len(link.sides) == 1:
            return ends
        # "on the far left": the leftmost, or what stands there at the far side
        there = [t for t in found if all(_on_side(side, t.item, scene) for side in link.sides)]
        return [t for t in found if t in ends or (t in there and len(there) == many)]
    if link.relation not in ("nearest", "furthest") or not found:
        return found
    sign = 1.0 if link.relation == "nearest" else -1.0
    far = {thing.id: sign * _distance(thing.item, link, scene) for thing in found}
    last = sorted(far.values())[min(max(many, 1), len(far)) - 1]
    return [thing for thing in found if far[thing.id] <= last + scene.units(NEAR_TIE_M)]


def _distance(item: SceneObject, link: Link, scene: Scene) -> float:
    """Edge-to-edge distance to the nearest anchor; without anchors, along y to the person."""
    placed = [a for a in map(scene.get, link.anchors) if a.x is not None and a.id != item.id]
    if placed:
        return min(relations.gap(item, anchor) for anchor in placed)
    if link.sides:
        side = link.sides[0]
        if side in _EDGES and len(link.sides) == 1:
            return relations.edge_distance(item, _EDGES[side])
        if side == "edge":
            return min(relations.edge_distance(item, edge) for edge in relations.ALONG)
        if len(link.sides) > 1:
            return math.hypot(*(relations.edge_distance(item, _EDGES[one]) for one in link.sides))
        return math.hypot(*item.position)
    return item.position[1]


def utmost_said(said: Sequence[str], lexicon: Lexicon) -> tuple[str, ...]:
    """The side at whose end a thing stands: "the far left", "the left end", "both ends"; nothing
    for any other place."""
    told = [word for word in said if word not in _SMALL]
    if told == ["ends"]:
        return ("outer",)
    if len(told) != 2 or (told[-1] != "end" and told[0] not in ("far", "extreme", "utmost")):
        return ()
    end = told[-1] == "end"
    side = side_of(told[0] if end else told[1], lexicon)
    if side not in ("left", "right") and not (end and side in ("far", "near")):
        return ()
    return (side,) if end or told[0] != "far" else (side, "far")


def sides_said(said: Sequence[str], lexicon: Lexicon) -> tuple[str, ...]:
    """The parts of the table that a place phrase names ("the far left corner")."""
    facing = {"left": "right", "right": "left", "far": "near", "near": "far"}
    flip = facing if "your" in said else {}
    found = [side for word in said if (side := side_of(word, lexicon))]
    names = [flip.get(side, side) for side in found]
    if "middle" in said or "centre" in said or "center" in said or "central" in said:
        names = [name for name in names if name != "middle"] + ["middle"]
    if "corner" in said and len(set(names)) < 2:
        names = ["corner"]
    if ("edge" in said or "border" in said) and not names:
        names = ["edge"]
    if "floor" in said or "ground" in said:
        names = ["floor"]
    if not names and {"table", "tabletop", "desk"} & set(said):
        names = ["table"]
    return tuple(dict.fromkeys(names))


def as_counted(phrase: Phrase, links: list[Link], lexicon: Lexicon) -> tuple[Phrase, list[Link]]:
    """ "The last two on the right", "the second screw on the left": counted off from that side."""
    ranks = [word for word in phrase.modifiers if word in lexicon.words("ordinals")]
    told = [link for link in links if link.relation in ("on", "in", "beside", UTMOST)]
    sided = [link for link in told if len(link.sides) == 1 and not link.denied]
    sided = [link for link in sided if link.sides[0] in _COUNTED_FROM]
    if len(ranks) != 1 or phrase.origin or len(sided) != 1:
        return phrase, links
    rank = "first" if ranks[0] == "last" else ranks[0]
    modifiers = tuple(rank if word == ranks[0] else word for word in phrase.modifiers)
    rest = [link for link in links if link is not sided[0]]
    return replace(phrase, modifiers=modifiers, origin=sided[0].sides[0]), rest

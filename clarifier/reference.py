"""What a noun phrase denotes on the live scene: the ids of every object it may mean.

Order (clarifier design, "References"): a scene name, a synonym, a class word; never similarity.
Adjectives, sides, ordinals and relations then narrow the set. Nothing is chosen here: a set of
several stays a set of several.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from clarifier.lexicon import Lexicon
from clarifier.pieces import Phrase
from clarifier.things import Thing, is_attribute, same_words, side_of, size_of, things_of
from clarifier.words import singular
from scene import relations
from scene.types import Scene, SceneObject

NEAR_TIE_M = 0.02
"""Distances that differ by less (metres) are a tie: ask."""
SIZE_TIE = 1.10
"""Sizes whose ratio is less are the same size."""


@dataclass(frozen=True)
class Link:
    """A relation inside a phrase: "next to the bowl" (anchors) or "on the left" (sides)."""

    relation: str
    anchors: tuple[str, ...] = ()
    sides: tuple[str, ...] = ()


@dataclass(frozen=True)
class Denotation:
    """The objects a phrase may mean, in scene order, and those of its noun, adjectives aside."""

    objects: tuple[str, ...]
    same_type: tuple[str, ...] = ()


@dataclass(frozen=True)
class Context:
    """What a phrase is read against. ``named`` are ids mentioned earlier in the sentence."""

    scene: Scene
    lexicon: Lexicon
    focus: tuple[str, ...] = ()
    named: tuple[str, ...] = ()
    among: tuple[str, ...] | None = None

    @property
    def things(self) -> tuple[Thing, ...]:
        """The objects that may be meant."""
        every = things_of(self.scene, self.lexicon)
        return every if self.among is None else tuple(t for t in every if t.id in self.among)


def denote(phrase: Phrase, context: Context, links: Sequence[Link] = ()) -> Denotation:
    """Every object that the phrase, narrowed by its relations, may mean."""
    kind = _still_there(of_type(phrase, context), links)
    if phrase.plural and (phrase.group in ("all", "rest") or _any_thing(phrase, context)):
        kind = movable(kind, bool(links))
    found = kind
    for link in links:
        found = [thing for thing in found if holds(link, thing.item, context.scene)]
    if phrase.det in ("other", "others"):
        found = _others(found, context, phrase.plural)
    found = _narrow(phrase, found, context)
    for link in links:
        many = max(1, int(phrase.count or 1)) if phrase.plural else 1
        found = _extreme_by_distance(link, found, context.scene, many)
    return Denotation(tuple(t.id for t in found), tuple(t.id for t in kind))


def _still_there(found: list[Thing], links: Sequence[Link]) -> list[Thing]:
    """Without what fell to the floor, unless all did or the phrase speaks of the floor."""
    standing = [thing for thing in found if thing.item.on != "floor"]
    return found if not standing or any("floor" in link.sides for link in links) else standing


def _any_thing(phrase: Phrase, context: Context) -> bool:
    return bool(phrase.head) and context.lexicon.is_anything(" ".join(phrase.head))


def movable(found: list[Thing], placed: bool) -> list[Thing]:
    """What "everything" speaks of: while things wait in the tray those, else what is not there."""
    waiting = [thing for thing in found if thing.item.on == "tray"]
    return waiting if waiting and not placed else [t for t in found if t.item.on != "tray"]


# --- the noun ------------------------------------------------------------


def of_type(phrase: Phrase, context: Context) -> list[Thing]:
    """The objects of the phrase's noun: by name, else by synonym, else by class, else by part."""
    things, lexicon = context.things, context.lexicon
    if phrase.group in ("all", "rest"):
        return list(things)
    if not phrase.head:
        return _same_type_as_before(phrase, context)
    said = " ".join(phrase.head)
    if lexicon.is_anything(said):
        return list(things)
    noun = " ".join((*phrase.head[:-1], singular(phrase.head[-1])))
    full = (*phrase.modifiers, *phrase.head)
    for rank in (
        lambda t: _named(t, full, phrase.head, lexicon),
        lambda t: t.head == noun or said == t.id.lower(),
        lambda t: _synonymous(t, noun, lexicon),
        lambda t: lexicon.covers(noun, t.head) or lexicon.covers(noun, " ".join(t.name)),
        lambda t: not lexicon.is_noun(said) and said in t.name,
    ):
        found = [thing for thing in things if rank(thing)]
        if found:
            return _most_literal(found, full)
    return []


def _named(thing: Thing, full: Sequence[str], head: Sequence[str], lexicon: Lexicon) -> bool:
    """The phrase ends with the object's whole name, or names its noun and leaves adjectives out."""
    if same_words(full[-len(thing.name) :], thing.name):
        return True
    return thing.plain and len(head) == 1 and singular(head[-1]) == thing.head


def _synonymous(thing: Thing, noun: str, lexicon: Lexicon) -> bool:
    same = lexicon.same(noun)
    return " ".join(thing.name) in same or (thing.head in same and thing.head != noun)


def _most_literal(found: list[Thing], full: Sequence[str]) -> list[Thing]:
    """Of "mug" and "coffee mug", the one that "coffee mug" names in full."""
    longest = [t for t in found if not t.plain and same_words(full[-len(t.name) :], t.name)]
    return longest or found


def _same_type_as_before(phrase: Phrase, context: Context) -> list[Thing]:
    """ "one": a thing of the type last spoken of that fits, else any thing that fits."""
    by_id = {thing.id: thing for thing in context.things}
    for past in (*reversed(context.named), *context.focus):
        if past not in by_id:
            continue
        kind = [thing for thing in context.things if thing.head == by_id[past].head]
        if len(kind) > 1 and _narrow(phrase, kind, context):
            return kind
    return list(context.things)


def _others(found: list[Thing], context: Context, several: bool) -> list[Thing]:
    """Those of the type that were not spoken of: "the other mug", "the rest"."""
    spoken = context.named or (context.focus if several else context.focus[:1])
    return [thing for thing in found if thing.id not in spoken]


# --- adjectives ------------------------------------------------------------


def _narrow(phrase: Phrase, found: list[Thing], context: Context) -> list[Thing]:
    """Keep those that every adjective fits: colours and names first, then sizes, then sides."""
    lexicon = context.lexicon
    spare = [m for m in phrase.modifiers if m not in lexicon.words("vague") or _in_names(m, found)]
    if phrase.head and not lexicon.is_anything(phrase.head[-1]):
        whole = [t for t in found if _full_name(t, phrase)]
        found = whole or found
    rest: list[str] = []
    for word in spare:
        narrowed = _literal(word, found, lexicon, context)
        if narrowed is None:
            rest.append(word)
        else:
            found = narrowed
    for word in sorted(rest, key=lambda w: _order(w, lexicon)):
        found = _comparative(word, phrase, found, context)
    return found


def _full_name(thing: Thing, phrase: Phrase) -> bool:
    return bool(phrase.modifiers) and same_words((*phrase.modifiers, *phrase.head), thing.name)


def _in_names(word: str, found: Sequence[Thing]) -> bool:
    return any(word in thing.name for thing in found)


def _literal(
    word: str, found: list[Thing], lexicon: Lexicon, context: Context
) -> list[Thing] | None:
    """Narrowing by a colour or a word of the names; None for words that need comparison."""
    named = [thing for thing in found if word in thing.name or word in thing.colors]
    if named or word in lexicon.colors:
        return named
    if word in lexicon.words("shades") or is_attribute(word, lexicon):
        return found if word in lexicon.words("shades") else None
    if side_of(word, lexicon) or word in lexicon.words("ordinals"):
        return None
    elsewhere = any(word in thing.name for thing in context.things)
    return [] if elsewhere or (len(found) > 1 and lexicon.is_noun(word)) else found


def _order(word: str, lexicon: Lexicon) -> int:
    return 0 if size_of(word, lexicon) else 2 if word in lexicon.words("ordinals") else 1


def _comparative(word: str, phrase: Phrase, found: list[Thing], context: Context) -> list[Thing]:
    lexicon = context.lexicon
    size = size_of(word, lexicon)
    many = int(phrase.count or 0) if phrase.plural else 1
    if size and not (word in lexicon.words("near") and phrase.origin):
        return by_size(size, found, many)
    if word in lexicon.words("ordinals"):
        return _ordinal(word, phrase.origin or _implied_origin(phrase, lexicon), found, many)
    return by_side(side_of(word, lexicon), found, context.scene, many)


def _implied_origin(phrase: Phrase, lexicon: Lexicon) -> str:
    return next((s for m in phrase.modifiers if (s := side_of(m, lexicon))), "left")


_MEASURES: dict[str, Callable[[SceneObject], float]] = {
    "big": lambda item: item.width * item.height * item.tall,
    "small": lambda item: -item.width * item.height * item.tall,
    "tall": lambda item: item.tall,
    "short": lambda item: -item.tall,
    "wide": lambda item: item.width,
    "narrow": lambda item: -item.width,
}


def by_size(size: str, found: list[Thing], many: int = 1) -> list[Thing]:
    """The ``many`` largest (smallest, ...) of them, and those that are not clearly different from
    the last of these; ``many`` 0: those that stand out as large (small, ...)."""
    if not found:
        return found
    values = {thing.id: _MEASURES[size](thing.item) for thing in found}
    order = sorted(values.values(), reverse=True)
    last = order[min(many, len(order)) - 1] if many else _clear_step(order)
    low = last / SIZE_TIE if last > 0 else last * SIZE_TIE
    return [thing for thing in found if low <= values[thing.id]]


def _clear_step(order: Sequence[float]) -> float:
    """The last value before the largest step down, relative to its size."""
    steps = [(max(abs(a), abs(b)) / min(abs(a), abs(b)), a) for a, b in itertools.pairwise(order)]
    widest, value = max(steps, key=lambda step: step[0], default=(0.0, order[-1]))
    return value if widest >= SIZE_TIE else order[-1]


def _along(side: str, item: SceneObject) -> float:
    x, y = item.position
    return {"left": -x, "right": x, "far": y, "near": -y, "middle": -math.hypot(x, y)}[side]


def by_side(side: str, found: list[Thing], scene: Scene, many: int = 1) -> list[Thing]:
    """The ``many`` furthest to that side, and those within 2 cm of the last of these; ``many`` 0:
    all in that half of the table; tray objects have no side."""
    placed = [thing for thing in found if thing.item.x is not None]
    if many == 0:
        half = [thing for thing in placed if _along(side, thing.item) > 0]
        return half if side != "middle" else placed
    if len(placed) <= many:
        return placed
    if side == "middle" and len(placed) == 3 and many == 1:
        return [_median(placed)]
    order = sorted((_along(side, thing.item) for thing in placed), reverse=True)
    tie = scene.units(NEAR_TIE_M)
    return [thing for thing in placed if _along(side, thing.item) >= order[many - 1] - tie]


def _median(placed: list[Thing]) -> Thing:
    xs = [thing.item.position[0] for thing in placed]
    ys = [thing.item.position[1] for thing in placed]
    axis = 0 if max(xs) - min(xs) >= max(ys) - min(ys) else 1
    return sorted(placed, key=lambda thing: thing.item.position[axis])[1]


def _ordinal(word: str, origin: str, found: list[Thing], many: int = 1) -> list[Thing]:
    placed = [thing for thing in found if thing.item.x is not None]
    ranked = sorted(placed, key=lambda thing: -_along(origin, thing.item))
    index = ("first", "second", "third", "fourth", "fifth", "sixth", "last").index(word)
    if word == "last":
        return ranked[-max(many, 1) :]
    return ranked[index : index + max(many, 1)]


# --- relations ------------------------------------------------------------


def holds(link: Link, item: SceneObject, scene: Scene) -> bool:
    """Whether the relation is true of the object on the scene; nearest/furthest come later."""
    if item.x is None or link.relation in ("nearest", "furthest"):
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
    return _along(side, item) > 0


def _extreme_by_distance(
    link: Link, found: list[Thing], scene: Scene, many: int = 1
) -> list[Thing]:
    if link.relation not in ("nearest", "furthest") or not found:
        return found
    sign = 1.0 if link.relation == "nearest" else -1.0
    far = {thing.id: sign * _distance(thing.item, link, scene) for thing in found}
    last = sorted(far.values())[min(many, len(far)) - 1]
    return [thing for thing in found if far[thing.id] <= last + scene.units(NEAR_TIE_M)]


def _distance(item: SceneObject, link: Link, scene: Scene) -> float:
    """Edge-to-edge distance to the nearest anchor; without anchors, along y to the person."""
    placed = [a for a in map(scene.get, link.anchors) if a.x is not None and a.id != item.id]
    if placed:
        return min(relations.gap(item, anchor) for anchor in placed)
    if link.sides:
        side = link.sides[0]
        if side in _EDGES:
            return relations.edge_distance(item, _EDGES[side])
        if side == "edge":
            return min(relations.edge_distance(item, edge) for edge in relations.ALONG)
        return math.hypot(*item.position)
    return item.position[1]


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

"""Whether an end bears a sentence out: all that it says of the end holds, and nothing else moved.

A second opinion, from the mentions alone, on what the translator is not sure of: "the screwdriver
right of the tape measure, the clip on the pad" is cut into (thing, relation, landmark) and each is
looked for in the end that a program comes to. It writes no program and forbids none; where every
word is accounted for and every claim holds, less probability is enough to act.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from clarifier.lexicon import Lexicon
from clarifier.located import sides_said
from clarifier.pieces import Chunk
from clarifier.spoken import Linked, Spoken
from scene.relations import at_edge, beside, between, centred, gap, in_corner, moved, next_to
from scene.types import Scene, SceneObject

_SIDED = frozenset({"left", "right", "above", "below"})
_BORNE = frozenset({"on", "in"})
_RELATIONS = _SIDED | _BORNE | {"beside", "between", "towards"}
"""Relations that can be seen in an end; "to" and "away from" say how something goes."""
_TOWARDS = frozenset({"towards", "toward", "in the direction of"})
_VERBS = frozenset({"place", "pick", "arrange", ""})
"""Classes of verbs that say no more than where a thing is to be: a push is a way as well."""
_OTHERWISE = frozenset(
    {"if", "unless", "when", "while", "until", "except", "without", "not", "no", "never", "but"}
    | {"instead", "or", "other", "others", "rest", "than", "again", "back", "swap", "each", "every"}
    | {"don't", "dont", "otherwise", "only", "both", "twice", "half", "over", "upside", "round"}
)
"""Words that say more than one thing's place, or that something is not to be so."""
STRAIGHT = 0.7
"""Cosine of the angle by which a way towards a thing may be off, at least."""
_WORDLESS = frozenset(
    {"neatly", "nicely", "safely", "standing", "sitting", "lying", "what", "goes", "stands"}
    | {"belongs", "live", "lives", "sit", "sits", "stand", "its"}
)
"""Words that change nothing of the end; others are known by the lexicon as talk."""


_SIDES = {"left": "left", "right": "right", "far": "above", "near": "below"}
"""Sides of the table as they are said, and in `scene.relations`."""


class Claim(NamedTuple):
    """``thing`` is to end in a relation to the ``landmarks``, or at a part of the table."""

    thing: str
    relation: str
    landmarks: tuple[str, ...] = ()
    sides: tuple[str, ...] = ()


def borne_out(
    linked: Linked, binding: Mapping[str, tuple[str, ...]], before: Scene, after: Scene,
    lexicon: Lexicon,
) -> bool:  # fmt: skip
    """Whether the end is the one that the sentence describes, as far as its mentions tell."""
    if not _plain(linked, lexicon):
        return False
    found = list(_claims(linked, binding, lexicon))
    if not found or None in found:
        return False
    claims = [claim for claim in found if claim is not None]
    things = {claim.thing for claim in claims}
    themes = {o for one in linked.spoken if one.theme or _brought_along(one, linked)
              for o in binding.get(one.mention.slot, ())}  # fmt: skip
    shifted = {item.id for item in before if moved(item, after.get(item.id)) > 0}
    return (
        things == themes
        and shifted <= things
        and all(_still_there(after.get(thing)) for thing in things)
        and all(_holds(claim, before, after) for claim in claims)
    )


def _plain(linked: Linked, lexicon: Lexicon) -> bool:
    """Whether every word is a thing, a place, a relation, a joint or a manner of speaking."""
    harmless = lexicon.words("polite") | _WORDLESS
    words = {token.text for token in linked.tokens}
    verbs = _VERBS | {"push"} if any(_is_towards(c, linked) for c in linked.chunks) else _VERBS
    if linked.spared or words & _OTHERWISE or any(one.verb not in verbs for one in linked.spoken):
        return False
    return all(
        chunk.kind in ("np", "pronoun", "relation", "place", "verb", "joint")
        or all(word in harmless for word in _words(chunk, linked))
        for chunk in linked.chunks
        if chunk.value != "goal"
    )


def _claims(
    linked: Linked, binding: Mapping[str, tuple[str, ...]], lexicon: Lexicon
) -> Iterator[Claim | None]:
    """What is claimed of each theme, in order; None for what cannot be read."""
    themes: list[Spoken] = []
    claimed = True
    pieces: list[Spoken | Chunk] = sorted(
        [*linked.spoken, *_places(linked)], key=lambda one: one.first
    )
    number = 0
    while number < len(pieces):
        piece = pieces[number]
        number += 1
        if isinstance(piece, Spoken) and (piece.theme or _brought_along(piece, linked)):
            themes = [piece] if claimed else [*themes, piece]
            claimed = False
            continue
        claimed = True
        if isinstance(piece, Chunk):
            yield from _placed(piece, linked, themes, binding, lexicon)
            continue
        landmarks = [piece]
        while piece.relation == "between" and number < len(pieces):
            follower = pieces[number]
            if not isinstance(follower, Spoken) or follower.relation != "between":
                break
            landmarks.append(follower)
            number += 1
        led = next((c for c in linked.chunks if c.last == piece.opened), None)
        towards = led is not None and _is_towards(led, linked)
        yield from _related("towards" if towards else piece.relation, landmarks, themes, binding)
    if not claimed:
        yield None  # something is named, and not where it is to be


def _brought_along(one: Spoken, linked: Linked) -> bool:
    """ "... with the brush in front of it": the brush is to be put there too."""
    led = one.opened > 0 and linked.tokens[one.opened - 1].text == "with"
    behind = next((c for c in linked.chunks if c.first == one.last), None)
    return led and behind is not None and behind.kind == "relation" and behind.value != "goal"


def _places(linked: Linked) -> list[Chunk]:
    """Parts of the table outside the mentions."""
    inside = {at for one in linked.spoken for at in range(one.opened, one.last)}
    return [c for c in linked.chunks if c.kind == "place" and c.first not in inside]


def _related(
    relation: str, landmarks: Sequence[Spoken], themes: Sequence[Spoken],
    binding: Mapping[str, tuple[str, ...]],
) -> Iterator[Claim | None]:  # fmt: skip
    others = tuple(o for one in landmarks for o in binding.get(one.mention.slot, ()))
    fits = len(others) == (2 if relation == "between" else 1)
    if relation not in _RELATIONS or not fits or not themes:
        yield None
        return
    for theme in themes:
        for thing in binding.get(theme.mention.slot, ()):
            yield None if thing in others else Claim(thing, relation, others)


def _placed(
    place: Chunk, linked: Linked, themes: Sequence[Spoken],
    binding: Mapping[str, tuple[str, ...]], lexicon: Lexicon,
) -> Iterator[Claim | None]:  # fmt: skip
    said = _words(place, linked)
    sides = sides_said(said, lexicon)
    led = next((c.value for c in linked.chunks if c.last == place.first), "")
    if sides == ("table",) and led == "between":
        sides = ("middle",)  # "in the middle of the table"
    kind = next((word for word in said if word in ("corner", "edge", "side", "table")), "")
    topic = next(one for one in linked.spoken if one.theme) if themes else None
    if topic is not None and said[0] == "its" and len(sides) == 1:
        mark = binding.get(topic.mention.slot, ())
        relation = _SIDES.get(sides[0], "")
        for theme in themes:
            for thing in binding.get(theme.mention.slot, ()):
                yield None if thing in mark or not relation else Claim(thing, relation, mark)
        return
    if not themes or not sides or (kind == "corner") != (len(sides) == 2):
        yield None
        return
    for theme in themes:
        for thing in binding.get(theme.mention.slot, ()):
            yield Claim(thing, "place", sides=sides)


def _words(chunk: Chunk, linked: Linked) -> list[str]:
    return [token.text for token in linked.tokens[chunk.first : chunk.last]]


def _still_there(item: SceneObject) -> bool:
    return item.x is not None and not item.held and item.upright and item.on != "floor"


def _is_towards(chunk: Chunk, linked: Linked) -> bool:
    return chunk.kind == "relation" and " ".join(_words(chunk, linked)) in _TOWARDS


def _went_towards(was: SceneObject, now: SceneObject, mark: SceneObject) -> bool:
    """Whether a thing ends nearer to another, on the way there and not beyond it."""
    if was.x is None:
        return False
    (x, y), (old_x, old_y), (goal_x, goal_y) = now.position, was.position, mark.position
    way, whole = (x - old_x, y - old_y), (goal_x - old_x, goal_y - old_y)
    ahead = way[0] * whole[0] + way[1] * whole[1]
    straight = ahead > STRAIGHT * math.hypot(*way) * math.hypot(*whole)
    return straight and gap(now, mark) < gap(was, mark)


def _holds(claim: Claim, before: Scene, after: Scene) -> bool:
    one = after.get(claim.thing)
    if claim.relation == "place":
        if claim.sides == ("middle",):
            return centred(after, one)
        at = in_corner if len(claim.sides) == 2 else at_edge
        return set(claim.sides) <= _SIDES.keys() and at(
            after, one, *(_SIDES[side] for side in claim.sides)
        )
    others = [after.get(o) for o in claim.landmarks]
    if any(other.x is None for other in others):
        return False
    if claim.relation == "between":
        return between(one, *others)
    if claim.relation == "beside":
        return next_to(after, one, others[0])
    if claim.relation == "towards":
        return _went_towards(before.get(claim.thing), one, others[0])
    if claim.relation in _BORNE:
        return one.on == others[0].id
    return beside(after, one, others[0], claim.relation)

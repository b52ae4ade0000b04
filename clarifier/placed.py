"""Parts of the table in which a sentence says that things are to end: "two of the blocks at the
middle of the far edge, the others in the near left corner".

A program that takes them elsewhere is not what was said (`stated`, `vetoes`), or is given the
sentence's own word for the part (`put_there`).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence, Set
from typing import Literal, NamedTuple

from clarifier.lexicon import Lexicon, load_lexicon
from clarifier.located import sides_said
from clarifier.pieces import Chunk
from clarifier.spoken import Linked, Spoken
from clarifier.words import Token
from scene.relations import edge_distance, moved, on_table
from scene.types import Scene, SceneObject

At = Literal["corner", "edge", "mid_edge", "side", "half", "middle", "towards"]
NEAR = 0.6
"""Own edges of a few things at an edge, or in a corner, are no farther from it (table units)."""
NEAR_MANY = 0.85
"""The same of more than four."""
STANDS = 0.4
"""Own edges of what stands at an edge, or in a corner, already (table units)."""
CENTRED = 0.3
"""So far from the middle of an edge the mean place of things there is at most (table units)."""
ASIDE = 0.2
"""The mean place of a row in a corner is at least so far to both sides (table units)."""
STRAIGHT = 0.6
"""Cosine of the angle by which something that goes towards a place may be off, at least."""
MIDDLE = 0.6
"""Centres of things in the middle are no farther from it, along x and y (table units)."""

_LEADS = frozenset({"to", "at", "in", "on", "into", "onto", "along", "against", "inside", "by"})
_OF_FIGURES = frozenset({"of", "with", "from", "using", "out"})
"""Behind a figure's place these lead to what it is made of."""
_VERBS = frozenset({"place", "pick", "push", "arrange", ""})
_OTHERWISE = frozenset(
    {"if", "unless", "when", "while", "whether", "until", "not", "no", "never", "or", "instead"}
    | {"stack", "pile", "tower", "heap", "than", "back", "swap", "switch", "exchange", "else"}
    | {"without", "don't", "dont", "rather"}
)
"""Words that make what is said of a place depend on something, deny it or choose."""
_BEFORE_PLACES = frozenset(
    {",", ":", "-", "all", "both", "over", "up", "down", "out", "close", "there", "right", "just"}
    | {"straight", "neatly", "nicely", "go", "goes", "going", "should", "must", "be", "belong"}
    | {"belongs", "come", "comes", "in", "into", "as", "a", "an", "form", "shape", "side", "by"}
    | {"triangle", "square", "v", "l", "row", "line", "column", "circle", "neat", "nice", "evenly"}
    | {"one", "single", "vertical", "horizontal"}
    | {"cross", "diamond", "zigzag", "with", "its", "tip", "towards", "from", "me"}
    | {"spread", "spaced", "next", "each", "other", "somewhere", "anywhere", "away", "across"}
    | {"please", "now", "then", "can", "may", "lined", "line", "standing", "lying", "sitting"}
)
"""Words between what is to go somewhere and the place."""
_SO_FAR = frozenset(
    {"bit", "little", "slightly", "some", "tad", "few", "cm", "inches", "inch", "mm", "inwards"}
)
"""Words before "towards"."""
_GATHERED = frozenset(
    {"together", "gather", "group", "cluster", "bunch", "huddle", "collect", "assemble", "clump"}
    | {"gathered", "grouped", "clustered", "bunched", "huddled", "collected", "assembled"}
)
_LINES = frozenset({"row", "line", "column"})
_RANKED = frozenset({"first", "last", "one", "ones", "smaller", "larger", "bigger", "taller"})
"""Behind these a part of the table tells in which order things go."""
_EDGES = frozenset({"edge", "side", "border", "rim", "end"})
_LISTING = frozenset({"and", ",", "+", "&", "both"})
_TOWARDS = frozenset({"towards", "toward"})
_AT = frozenset({"at", "on"})
_DEEP = frozenset({"top", "bottom"})
"""Sides by themselves: "to the left" alone may be a way to go."""
_ONE_SIDED = {"left": "left", "right": "right", "far": "above", "near": "below"}
_PARTS = {"left": "left", "right": "right", "above": "far", "below": "near"}


class Placed(NamedTuple):
    """``things``, for which ``slot`` stands, end ``at`` the ``sides`` (`scene.relations`; none: the
    middle of the table): ``close`` together where they are to be gathered there, ``lined`` up,
    ``wide`` as a figure, which takes more room."""

    slot: str
    things: tuple[str, ...]
    at: At
    sides: tuple[str, ...] = ()
    close: bool = False
    lined: bool = False
    wide: bool = False

    @property
    def part(self) -> str:
        """The part in the words of the prelude's ``rooms``."""
        depth = sorted((_PARTS[side] for side in self.sides), key=lambda side: side[0] not in "fn")
        return " ".join(depth + ["half"] * (self.at == "half")) or "middle"


def placed(linked: Linked, binding: Mapping[str, tuple[str, ...]]) -> tuple[Placed, ...]:
    """The parts of the table that the sentence says, for one binding of its mentions."""
    outside = {token.text for token in _outside(linked)}
    measured = any(chunk.kind == "measure" for chunk in linked.chunks)
    if outside & _OTHERWISE or any(one.verb not in _VERBS for one in linked.spoken):
        return ()
    found = [
        goal for goal in _claims(linked, binding, load_lexicon())
        if goal.at == "towards" or not measured
    ]  # fmt: skip
    often = [goal.slot for goal in found]
    return tuple(goal for goal in found if often.count(goal.slot) == 1 and goal.things)


def _outside(linked: Linked) -> Iterator[Token]:
    inside = {at for one in linked.spoken for at in range(one.opened, one.last)}
    return (token for at, token in enumerate(linked.tokens) if at not in inside)


def _claims(
    linked: Linked, binding: Mapping[str, tuple[str, ...]], lexicon: Lexicon
) -> Iterator[Placed]:
    """What is claimed of each theme, clause by clause; a clause that names a landmark is left out:
    what stands beside it decides."""
    close, lined = (
        any(token.text in words for token in _outside(linked)) for words in (_GATHERED, _LINES)
    )
    told = {at for one in linked.spoken for at in range(one.opened, one.last)}
    free = [c for c in linked.chunks if c.kind == "place" and c.first not in told]
    for first, last in _clauses(linked):
        inside = [one for one in linked.spoken if first <= one.first < last]
        places = [c for c in free if first <= c.first < last]
        themes = [one for one in inside if one.theme]
        themes = themes or [one for one in inside if makes_a_figure(one, linked)]
        part = _part(places[0], linked, lexicon) if len(places) == 1 else None
        if part is None or not themes or len(themes) < len(inside) or _among(part[0], linked):
            continue
        at, sides, led = part
        if not _straight_there(
            themes[-1], led, linked, _SO_FAR if at == "towards" else frozenset()
        ):
            continue
        for one in _listed(themes, linked):
            yield Placed(
                one.mention.slot, binding.get(one.mention.slot, ()), at, sides, close, lined
            )


def _listed(themes: Sequence[Spoken], linked: Linked) -> list[Spoken]:
    """The last of the themes, and those that are listed right before it."""
    found = [themes[-1]]
    for one in reversed(themes[:-1]):
        between = {token.text for token in linked.tokens[one.last : found[-1].opened]}
        if one.phrase is None or not between <= _LISTING:
            break
        found.append(one)
    return found[::-1]


def _straight_there(theme: Spoken, led: int, linked: Linked, more: Set[str]) -> bool:
    """Whether nothing else is said between what goes somewhere and the words that lead there, but
    for ``more``."""
    verbs = {c.first for c in linked.chunks if c.kind == "verb"}
    return all(
        linked.tokens[at].text in _BEFORE_PLACES | _GATHERED | more or at in verbs
        for at in range(theme.last, led)
    )


def _among(at: At, linked: Linked) -> bool:
    """Whether it may be the middle of the things: "A left, B right, C in the middle"."""
    whole = {"table", "board", "desk", "tabletop"} & {token.text for token in linked.tokens}
    return at == "middle" and len(linked.slots) > 2 and not whole


def _clauses(linked: Linked) -> list[tuple[int, int]]:
    """Token ranges, each up to the place that it ends with and what a figure there is made of."""
    found, first = [], 0
    for number, chunk in enumerate(linked.chunks):
        if chunk.kind != "place":
            continue
        last = chunk.last
        for one in linked.spoken:
            if last < one.opened <= last + 2 and makes_a_figure(one, linked):
                last = one.last
        if number + 1 < len(linked.chunks):
            found.append((first, last))
            first = last
    found.append((first, len(linked.tokens)))
    return found


def makes_a_figure(one: Spoken, linked: Linked) -> bool:
    """Whether a mention is what a figure is made of: "make a square with four blocks"."""
    led = linked.tokens[one.opened - 1].text if one.opened else ""
    return one.verb in ("arrange", "") and led in _OF_FIGURES


def _part(place: Chunk, linked: Linked, lexicon: Lexicon) -> tuple[At, tuple[str, ...], int] | None:
    """Which part of the table a place phrase names, and the token that leads there; None where it
    is another thing's, or vague."""
    led = next((c for c in linked.chunks if c.kind == "relation" and c.last == place.first), None)
    start = place.first if led is None else led.first
    behind = linked.tokens[place.last].text if place.last < len(linked.tokens) else ""
    lead = linked.tokens[start - 1 if led is None and start else start].text
    bare = led is None and (lead in (",", ":") or (start == 0 and behind == ":"))
    towards = lead in _TOWARDS
    if not (bare or towards or (led is not None and lead in _LEADS)) or behind == "of":
        return None
    words = [token.text for token in linked.tokens[start + (not bare) : place.last]]
    said = sides_said(words, lexicon)
    sides = tuple(_ONE_SIDED[side] for side in said if side in _ONE_SIDED)
    middle = "middle" in said
    if towards:
        return ("towards", sides, start) if sides or middle else None
    if len(sides) == 2 and not middle and set(sides) & {"left", "right"} != set(sides):
        return ("corner", sides, start)
    if len(sides) == 1:
        if middle:
            return None if "half" in words else ("mid_edge", sides, start)
        at: At | None = "half" if "half" in words else "edge" if _EDGES & set(words) else None
        at = at or ("side" if lead in _AT or _DEEP & set(words) else None)
        return None if at is None else (at, sides, start)
    if not sides and middle and not _EDGES & set(words):
        return ("middle", (), start)
    return None


def in_part(goal: Placed, before: Scene, after: Scene) -> bool:
    """Whether all the things end there; what is held, or stands on another, may be anywhere. A
    side by itself ("on the left") may be that of other things."""
    if goal.at == "side":
        return True
    items = [item for item in map(after.get, goal.things) if on_table(item) and not item.held]
    if goal.at == "towards":
        return all(_went_there(goal, before.get(item.id), item) for item in items)
    if goal.at == "middle" and len(items) > 1:
        xs, ys = ([item.position[axis] for item in items] for axis in (0, 1))
        middle = max(abs(sum(xs)), abs(sum(ys))) / len(items)
        return middle <= CENTRED and max(map(abs, xs + ys)) <= NEAR_MANY
    if goal.at == "mid_edge" and items:
        axis = 1 if goal.sides[0] in ("left", "right") else 0
        along = [item.position[axis] for item in items]
        if abs(sum(along)) / len(along) > CENTRED or max(map(abs, along)) > NEAR_MANY:
            return False
    if goal.lined and goal.at == "corner" and items:
        mean = [sum(item.position[axis] for item in items) / len(items) for axis in (0, 1)]
        ahead = {"left": -mean[0], "right": mean[0], "above": mean[1], "below": -mean[1]}
        return all(ahead[side] > ASIDE for side in goal.sides)
    near = NEAR if len(goal.things) <= 4 and not goal.wide else NEAR_MANY
    return all(_there(goal, item, near) for item in items)


def placed_wholly(
    goals: Sequence[object], linked: Linked, lexicon: Lexicon, before: Scene, after: Scene
) -> bool:
    """Whether a sentence says where things go, and nothing else, and just that comes of it."""
    claims = [goal for goal in goals if isinstance(goal, Placed)]
    known = _BEFORE_PLACES | _GATHERED | _LEADS | {"and", ".", "!", "the"} | lexicon.words("polite")
    inside = {at for one in linked.spoken for at in range(one.opened, one.last)}
    inside |= {at for c in linked.chunks if c.kind in ("place", "verb", "relation")
               for at in range(c.first, c.last)}  # fmt: skip
    said = {token.text for at, token in enumerate(linked.tokens) if at not in inside}
    things = {one for goal in claims for one in goal.things}
    shifted = {item.id for item in before if moved(item, after.get(item.id)) > 0}
    return (
        {goal.slot for goal in claims} == set(linked.slots)
        and said <= known
        and shifted <= things
        and all(on_table(after.get(one)) for one in things)
        and all(in_part(goal, before, after) for goal in claims)
    )


def _there(goal: Placed, item: SceneObject, near: float) -> bool:
    x, y = item.position
    if goal.at == "middle":
        return max(abs(x), abs(y)) <= min(MIDDLE, near)
    if goal.at == "half":
        return {"left": -x, "right": x, "above": y, "below": -y}[goal.sides[0]] > 0
    return all(edge_distance(item, side) <= near for side in goal.sides)


def _went_there(goal: Placed, was: SceneObject, item: SceneObject) -> bool:
    """Whether a thing goes more towards there than past it."""
    if not on_table(was):
        return True
    (x, y), (old_x, old_y) = item.position, was.position
    ways = {"left": (-1.0, 0.0), "right": (1.0, 0.0), "above": (0.0, 1.0), "below": (0.0, -1.0)}
    to_x, to_y = (sum(ways[side][axis] for side in goal.sides) for axis in (0, 1))
    if not goal.sides:
        to_x, to_y = -old_x, -old_y
        if math.hypot(x, y) >= math.hypot(old_x, old_y):
            return False
    ahead = (x - old_x) * to_x + (y - old_y) * to_y
    return ahead > STRAIGHT * math.hypot(x - old_x, y - old_y) * math.hypot(to_x, to_y)


def leaves_a_part(
    linked: Linked, shifted: Set[str], before: Scene, after: Scene
) -> bool:  # fmt: skip
    """Whether the sentence names a part of the table, where nothing of what it names was before,
    and nothing that is moved ends."""
    said = {token.text for token in _outside(linked)}
    so_far = said & _SO_FAR or any(chunk.kind == "measure" for chunk in linked.chunks)
    if (
        not shifted
        or so_far
        or said & _OTHERWISE
        or any(one.verb not in _VERBS for one in linked.spoken)
    ):
        return False
    inside = {at for one in linked.spoken for at in range(one.opened, one.last)}
    named = {o for one in linked.spoken for o in one.mention.objects}
    lexicon = load_lexicon()
    for place in linked.chunks:
        part = None if place.kind != "place" else _part(place, linked, lexicon)
        if part is None or place.first in inside or part[0] in ("towards", "side"):
            continue
        ahead = linked.tokens[part[2] - 1].text if part[2] else ""
        if _among(part[0], linked) or ahead.endswith("est") or ahead in _RANKED:
            continue
        goal = Placed("", ("",), part[0], part[1])
        ended = any(_is_there(goal, after.get(one), NEAR) for one in shifted)
        if not ended and not any(_is_there(goal, before.get(one), STANDS) for one in named):
            return True
    return False


def _is_there(goal: Placed, item: SceneObject, near: float) -> bool:
    if not on_table(item):
        return False
    axis = 1 if goal.sides and goal.sides[0] in ("left", "right") else 0
    if goal.at == "mid_edge" and abs(item.position[axis]) > MIDDLE:
        return False
    return _there(goal, item, near)

"""Points and shares of a way, told in lengths: "halfway from the middle out to the left corner", "a
third of the way in from the left along the near edge", "by half its distance to the corner", "all
three slightly towards the middle". The translator knows lengths surely, and what lies towards
the middle differs for each of several things: so each is told how far it goes, or how far from two
edges it ends.

Only where the whole sentence is what goes there, the point or the share, and talk.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import msgspec

from agent.messages import Focus
from clarifier.amounts import amounts
from clarifier.ask import labels
from clarifier.frame import Frame, frame
from clarifier.lexicon import Lexicon
from clarifier.mentions import link
from clarifier.spoken import Linked, Spoken, settles
from clarifier.way_forms import (
    A_SHARE,
    AIM,
    EACH_OTHER,
    FORMS,
    HALVES,
    HOW_MANY,
    IDLE,
    NAMED,
    PARTS,
    RIM,
    SIDES,
    STANDS,
)  # fmt: skip
from scene.relations import gap
from scene.types import Scene, SceneObject

A_BIT = 0.25
"""How far "a bit" goes (table units), as far as the translator was taught."""
LEAST = 0.01
"""No more than this along an axis is not worth a word (table units)."""
MOST = 4
"""So many things at most are each told where they go."""

Point = tuple[float | None, float | None]
"""A place on the table; None: as far along that axis as what goes there, or comes from there."""


_MARKS = frozenset({",", ".", "!", "?", ":", ";", "-", "and", "them", "may", "shall", "might"})
_PUSHES = frozenset({"push"})
_CARRIES = frozenset({"place", "pick", "arrange", ""})


class _Goes(NamedTuple):
    """How far a thing goes across and along the table, or where its centre ends (table units)."""

    thing: SceneObject
    across: float
    along: float
    ends: bool = False


def told_in_lengths(text: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> str:
    """The sentence with a point, or a share of a way, told in lengths; as it was where it says
    anything else."""
    if not re.search(rf"\b(?:{'|'.join(PARTS)}|towards?|closer|stop\w*|leav\w+)\b", text.lower()):
        return text
    linked = link(A_SHARE.sub(r"a \1", text), scene, focus, lexicon)
    shape = frame(linked)
    said = " ".join(IDLE.sub("", shape.text.lower()).split())
    plain = _on_its_way(said, shape, linked, scene, lexicon)
    return plain or _at_its_point(said, shape, linked, scene, lexicon) or text


def _on_its_way(
    said: str, shape: Frame, linked: Linked, scene: Scene, lexicon: Lexicon
) -> str | None:
    """ "Halfway to the corner", "a bit towards the middle", "midway from the edge to there"."""
    for form in FORMS:
        found = form.search(said)
        if found is None:
            continue
        groups = found.groupdict()
        movers = shape.among(groups["mover"])
        start, goal = (_thing_or_place(groups.get(end), shape, scene) for end in ("start", "goal"))
        rest = _without_its_side(said[found.end() :], goal, str(groups["goal"]))
        if not _is_talk(f"{said[: found.start()]} #  {rest}", linked, lexicon):
            continue
        things = _things(movers, scene)
        if _one_another(groups["goal"], things, shape):
            return _drawn_together(things, groups, linked, scene, lexicon)
        if goal is None or (groups.get("start") and start is None) or not things:
            return None
        if _between_two(groups):
            return None
        if groups.get("short"):
            mark = shape.among(groups["goal"])[0].mention.objects[0]
            goes = [_short_of(thing, scene.get(mark), _measured(groups, scene)) for thing in things]
            return _told(goes, movers, linked, scene, lexicon)
        if _known(groups, movers, things):
            return _towards(groups, movers[0], shape, linked)
        way = _measured(groups, scene)
        goes = [_one_goes(thing, start, goal, way, groups) for thing in things]
        return _told(goes, movers, linked, scene, lexicon)
    return None


def _between_two(groups: dict[str, str | None]) -> bool:
    """Whether it is the middle between two things, which the translator knows."""
    both = all(str(groups.get(end)).startswith("#") for end in ("start", "goal"))
    return both and groups.get("part") in HALVES


def _known(
    groups: dict[str, str | None], movers: Sequence[Spoken], things: Sequence[SceneObject]
) -> bool:
    """Whether the translator knows it as it is: halfway, or some way, to a thing."""
    if len(movers) > 1:
        return False
    half = groups.get("part") in HALVES and len(things) == 1
    some = "part" not in groups
    return (half or some) and not groups.get("start") and str(groups["goal"]).startswith("#")


def _towards(
    groups: dict[str, str | None], mover: Spoken, shape: Frame, linked: Linked
) -> str | None:
    """ "Halfway to the cone", in the words that the translator knows."""
    mark = shape.among(groups["goal"])[0]
    one, other = (_words_of(one, linked) for one in (mover, mark))
    far = (groups.get("far") or "a bit").removeprefix("by ")
    way = "halfway to" if groups.get("part") else f"{far} towards"
    return f"{_verb(linked)} {one} {way} {other}"


def _one_another(goal: str | None, things: Sequence[SceneObject], shape: Frame) -> bool:
    """Whether each of two goes towards the other."""
    if len(things) != 2 or goal is None:
        return False
    if not goal.startswith("#"):
        return re.fullmatch(EACH_OTHER, goal) is not None
    return set(shape.among(goal)[0].mention.objects) == {thing.id for thing in things}


def _drawn_together(
    things: Sequence[SceneObject], groups: dict[str, str | None], linked: Linked, scene: Scene,
    lexicon: Lexicon,
) -> str | None:  # fmt: skip
    one, other = things
    if groups.get("part"):
        return None
    apart = gap(one, other)
    far = _measured(groups, scene) if groups.get("far") else None
    half = min(A_BIT, apart / 3) if far is None else min(far, apart / 2)
    if half < LEAST:
        return None
    length = max(math.dist(one.position, other.position), LEAST)
    across, along = (
        half * (b - a) / length for a, b in zip(one.position, other.position, strict=True)
    )
    goes = [_Goes(one, across, along), _Goes(other, -across, -along)]
    return _told(goes, (), linked, scene, lexicon)


def _without_its_side(rest: str, goal: Point | None, said: str) -> str:
    """What follows a landmark without where it stands, if it does stand there."""
    tail = STANDS.match(rest)
    if tail is None or goal is None or not said.startswith("#"):
        return rest
    (x, y), (to_x, to_y) = goal, SIDES[tail["side"]]
    ahead = (x or 0.0) * to_x + (y or 0.0) * to_y
    return rest[tail.end() :] if ahead > 0 else rest


def _measured(groups: dict[str, str | None], scene: Scene) -> float | None:
    """How far it goes (table units) where that is no share of the way."""
    far = amounts(groups.get("far") or "")
    if far:
        return scene.units(far[0].value)
    return A_BIT if groups.get("bit") else None


def _one_goes(
    thing: SceneObject, start: Point | None, goal: Point, way: float | None,
    groups: dict[str, str | None],
) -> _Goes:  # fmt: skip
    here = thing.position
    begin = here if start is None else _filled(start, goal, here)
    end = _filled(goal, begin, here)
    if start is not None:
        share = _share(groups)
        x, y = (a + share * (b - a) for a, b in zip(begin, end, strict=True))
        return _Goes(thing, x, y, True)
    length = math.dist(here, end)
    share = _share(groups) if way is None else min(1.0, way / max(length, LEAST))
    return _Goes(thing, share * (end[0] - here[0]), share * (end[1] - here[1]))


def _short_of(thing: SceneObject, mark: SceneObject, left: float | None) -> _Goes:
    """How far a thing goes straight to a landmark until so much is ``left`` between their edges."""
    (x, y), (to_x, to_y) = thing.position, mark.position

    def gap_at(share: float) -> float:
        there = msgspec.structs.replace(thing, x=x + share * (to_x - x), y=y + share * (to_y - y))
        return gap(there, mark)

    near, far = 0.0, 1.0
    for _ in range(20):
        middle = (near + far) / 2
        near, far = (middle, far) if gap_at(middle) > (left or 0.0) else (near, middle)
    return _Goes(thing, near * (to_x - x), near * (to_y - y))


def _filled(point: Point, other: Point, here: tuple[float, float]) -> tuple[float, float]:
    """A place whose free axis is the other's, or that of the thing where both leave it open."""
    x, y = (
        next(known for known in axis if known is not None)
        for axis in zip(point, other, here, strict=True)
    )
    return x, y


def _at_its_point(
    said: str, shape: Frame, linked: Linked, scene: Scene, lexicon: Lexicon
) -> str | None:
    """ "A quarter of the width from the left edge", "a third of the way in from the left along the
    near edge"."""
    aims, rim, movers = list(AIM.finditer(said)), RIM.search(said), NAMED.findall(said)
    if not aims or len(aims) > 2 or len(movers) != 1:
        return None
    named = shape.among(movers[0])
    things = _things(named, scene)
    left = RIM.sub(" ", AIM.sub(" ", said), count=1)
    if len(things) != 1 or not _is_talk(left.replace(movers[0], "#"), linked, lexicon):
        return None
    (thing,) = things
    ends: dict[int, float] = {}
    for aim in aims:
        side = _named_side(aim.group().rsplit("from", 1)[1])
        axis = 0 if side[0] else 1
        if axis in ends:
            return None
        ends[axis] = side[axis] * (1 - 2 * _share(aim.groupdict()))
    told = next((aim["along"] for aim in aims if aim["along"]), None)
    if rim is not None or told is not None:
        me = rim is not None and rim["me"] is not None
        side = (0, -1) if me else _named_side(told or (rim.group() if rim else ""))
        axis = 0 if side[0] else 1
        if axis in ends:
            return None
        size = (thing.width, thing.height)[axis]
        ends[axis] = side[axis] * (0.95 - size / 2)
    x, y = (ends.get(axis, thing.position[axis]) for axis in (0, 1))
    return _told([_Goes(thing, x, y, True)], named, linked, scene, lexicon)


def _share(groups: dict[str, str | None]) -> float:
    share = HOW_MANY[groups["many"] or "a"] / PARTS[groups["part"] or "half"]
    return min(share, 1.0)


def _things(movers: Sequence[Spoken], scene: Scene) -> list[SceneObject]:
    """What goes, where it is certain and stands on the table."""
    if not all(_is_certain(one) for one in movers):
        return []
    things = [scene.get(o) for one in movers for o in one.mention.objects]
    return [] if len(things) > MOST or any(thing.x is None for thing in things) else things


def _is_certain(mover: Spoken) -> bool:
    free = mover.phrase is not None and (mover.phrase.vague or mover.phrase.any_will_do)
    settled = settles(mover.mention) or mover.mention.plural
    return settled and not free and mover.count in (0, len(mover.mention.objects))


def _thing_or_place(said: str | None, shape: Frame, scene: Scene) -> Point | None:
    if said is None:
        return None
    if said.startswith("#"):
        mark = shape.among(said)[0].mention
        item = scene.get(mark.objects[0]) if settles(mark) else None
        return None if item is None or item.x is None else item.position
    if re.search(r"\b(?:middle|centre|center|midpoint)\b", said):
        return (0.0, 0.0)
    sides = [SIDES[word] for word in re.findall(r"[a-z]+", said) if word in SIDES]
    across = next((float(side[0]) for side in sides if side[0]), None)
    along = next((float(side[1]) for side in sides if side[1]), None)
    both = len(sides) == 2 and (across is None or along is None)
    return None if both or not sides else (across, along)


def _named_side(said: str) -> tuple[int, int]:
    return next(SIDES[word] for word in re.findall(r"[a-z]+", said) if word in SIDES)


def _is_talk(said: str, linked: Linked, lexicon: Lexicon) -> bool:
    verbs = list(_verbs(linked))
    classes = {value for value, word in verbs if word not in ("go", "goes")}
    known = lexicon.words("polite") | _MARKS | {word for _, word in verbs}
    words = said.split()
    rest = [at for at, word in enumerate(words) if word not in known and word != "#"]
    told = all(words[at + 1 : at + 2] == ["#"] for at in rest)
    return told and len(rest) <= 1 and classes <= _CARRIES | _PUSHES


def _verbs(linked: Linked) -> Iterator[tuple[str, str]]:
    """The class and the words of each verb that does not belong to "in a straight line"."""
    for chunk in linked.chunks:
        if chunk.kind == "verb":
            for token in linked.tokens[chunk.first : chunk.last]:
                if not (chunk.value == "arrange" and token.text == "line"):
                    yield chunk.value, token.text


def _told(
    goes: Sequence[_Goes], movers: Sequence[Spoken], linked: Linked, scene: Scene, lexicon: Lexicon
) -> str | None:
    """Each of them with how far it goes."""
    if movers and all(one.phrase is not None and not one.mention.plural for one in movers):
        names = {one.mention.objects[0]: _words_of(one, linked) for one in movers}
    else:
        names = labels([one.thing.id for one in goes], scene, lexicon)
    told = [_goes_there(one, names[one.thing.id], _verb(linked), scene) for one in goes]
    return None if None in told else " and ".join(one for one in told if one)


def _goes_there(one: _Goes, name: str, verb: str, scene: Scene) -> str | None:
    if one.ends:
        x = one.across - one.thing.width / 2 + 1
        y = one.along - one.thing.height / 2 + 1
        if x < 0 or y < 0:
            return None
        return (
            f"put {name} {_cm(x, scene)} from the left edge and {_cm(y, scene)} from the near edge"
        )
    legs = []
    if abs(one.across) > LEAST:
        side = "right" if one.across > 0 else "left"
        legs.append(f"{_cm(abs(one.across), scene)} to the {side}")
    if abs(one.along) > LEAST:
        legs.append(
            f"{_cm(abs(one.along), scene)} {'away from' if one.along > 0 else 'towards'} me"
        )
    return f"{verb} {name} {' and '.join(legs)}" if legs else None


def _verb(linked: Linked) -> str:
    return "push" if any(value in _PUSHES for value, _ in _verbs(linked)) else "move"


def _cm(length: float, scene: Scene) -> str:
    return f"{length * scene.table_m / 2 * 100:.1f} cm"


def _words_of(one: Spoken, linked: Linked) -> str:
    return linked.text[linked.tokens[one.opened].start : one.mention.end]

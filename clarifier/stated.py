"""How things must end that a sentence says outright: closer, farther away, apart, out of a part.

What a program would do is held against it: a candidate that brings the cup nearer where "away from
the box" was said is dropped, and the next one tried. Rules veto here; none of them makes a program.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from itertools import combinations
from typing import Literal, NamedTuple

from clarifier.across import Upon, carried_so, upon
from clarifier.figures import Figure, figures, in_figure
from clarifier.formed import Formed, formed, in_form
from clarifier.matching import Matched, in_match, matched
from clarifier.placed import Placed, in_part, placed
from clarifier.remainder import Left, left, left_so
from clarifier.sequences import Before, in_sequence, sequence
from clarifier.spoken import Linked, Spoken
from scene.relations import gap, in_corner, off_table
from scene.types import Scene, SceneObject

CHANGED = 0.02
"""Gaps that differ by less are the same (table units)."""
MIDDLE = 0.3
"""A thing nearer than this to the middle of the table, along x and y, is in it (table units)."""

Way = Literal["closer", "farther", "out", "apart", "together"]

_FARTHER = re.compile(
    r"\b(?:(?:away|off|apart|farther|further|distant)(?: (?:away|off|out))?|far(?: away)?) from "
    r"(?:the |that |this )?$"
)
_CLOSER = re.compile(
    r"\b(?:closer|nearer)(?: (?:up|in|over))?(?: (?:to|towards?))? (?:the |that |this )?$"
)
_COMPARES = re.compile(
    r"\b(?:is|are|isn't|aren't|was|were|lies?|stands?|sits?|(?:it|that|which|who|one)'s)(?: not)?"
    r"(?: the)?(?: one)?(?: (?:much|any|even|currently|now|already|lying|standing|sitting))* "
    r"(?:closer|nearer|farther|further|distant|far|away|off)\b[^,.;]*$"
)
"""Which of several things is meant, or when: how things are, not how they must end."""
_AIMS = re.compile(r"\b(?:so|until|till|such|make sure|see to it|ensure)\b[^,.;]*$")
"""Behind these a comparison is the end."""
_FROM_THERE = re.compile(
    r"\b(?:away|farther|further)(?: away)? from (?:there|it|that|each other)\b"
)
_TURNS = re.compile(
    r"\b(?:turn|rotate|spin|twist|face|look|aim|(?<!far )(?<!near )(?<!left )(?<!right )(?<!front )"
    r"(?<!back )(?<!top )(?<!bottom )point)(?:s|ed|ing)?\b"
)
_OUT = re.compile(
    r"\b(?:clear|empty|free|remove|get|move|take|sweep|push|shift|keep)\b[^.;]*?"
    r"\b(?:off|from|out of) (?:the |my |your )?(?P<part>(?:far|near|back|front|top|bottom)"
    r"(?:[ -](?:left|right))?|left|right|middle|cent(?:er|re))(?:[ -]hand)?"
    r"(?: (?P<kind>half|side|corner|edge|part|area))?(?: of the table)?\b(?! of (?!the table))"
)
_ELSEWHERE = re.compile(
    r"^[^,.;]*\b(?:in)?to\b|\b(?:and|then)\b.*\b(?:put|place|set|lay|stack|push|move)\b"
)
_GOES_ON = re.compile(r"\b(?:and|then)\b.*\b(?:it|them|that|those|there)\b")
_SIDES = {"left": "left", "right": "right", "far": "above", "back": "above", "top": "above",
          "near": "below", "front": "below", "bottom": "below"}  # fmt: skip


_APART = re.compile(
    r"\b(?:(?:space|spread|spaced|spacing)\b[^.;,]*?\bout\b[^.;,]*?\b(?:more|further|farther|wider|"
    r"bit|little|some|slightly|again|still)|(?:further|farther|more) apart|wider apart|"
    r"(?:further|farther)(?: away)? from (?:each other|one another)|"
    r"(?:more|some|extra) (?:space|room|distance|gap) between (?:them|each|the|these|those|all)|"
    r"(?:pull|push|draw|ease|prise|nudge|drive)\b(?:(?! then )[^.;,]){0,40}? apart|apart by)\b"
)
_TOGETHER = re.compile(
    r"\b(?:(?:closer|nearer|tighter)(?: up)? together|"
    r"(?:closer|nearer) to (?:each other|one another)|"
    r"less (?:space|room|distance|gap) between (?:them|each|the|these|those|all))\b"
)
_FORMED = re.compile(r"\b(?:row|line|column|circle|square|triangle|grid|edge|along|corner|on|in)\b")
"""With one of these the form, or the place, says more of the end than "apart" does."""


class Stated(NamedTuple):
    """``movers`` must end ``way`` of the landmarks, or of one another ("apart", "together"), or out
    of the part of the table (its sides, as in `scene.relations`; none: the middle)."""

    way: Way
    movers: tuple[str, ...]
    landmarks: tuple[str, ...] = ()
    part: tuple[str, ...] = ()
    corner: bool = False


Goal = Stated | Before | Formed | Figure | Matched | Left | Upon | Placed


def stated(
    linked: Linked, binding: Mapping[str, tuple[str, ...]], scene: Scene
) -> tuple[Goal, ...]:
    """What the sentence says of the end, for one binding of its mentions."""
    text = _outside_ranks(linked)
    if _TURNS.search(text):
        return ()
    formation = figures(linked, binding)
    parts = (one._replace(wide=bool(formation)) for one in placed(linked, binding))
    return (
        *_ways(text, linked, binding),
        *sequence(linked, binding, scene),
        *formed(linked, binding, scene),
        *formation,
        *matched(linked, binding),
        *left(linked, binding),
        *upon(linked, binding),
        *parts,
    )


def _ways(text: str, linked: Linked, binding: Mapping[str, tuple[str, ...]]) -> tuple[Stated, ...]:
    found = [
        *_of_landmarks(linked, binding), *_from_there(text, binding), *_of_each_other(text, linked,
                                                                                   binding),
    ]  # fmt: skip
    out = _OUT.search(text)
    if out is not None and not _ELSEWHERE.search(text[out.end() :]):
        words = re.split(r"[ -]", out["part"])
        part = tuple(_SIDES[word] for word in words if word in _SIDES)
        movers = tuple(o for objects in binding.values() for o in objects)
        found.append(Stated("out", movers, part=part, corner=out["kind"] == "corner"))
    return tuple(found)


def ways(goals: tuple[Goal, ...]) -> tuple[Goal, ...]:
    """What says how everything ends; the others only forbid some ends."""
    return tuple(
        goal for goal in goals
        if isinstance(goal, Stated | Before) or (isinstance(goal, Formed) and goal.whole)
    )  # fmt: skip


def orders(goals: tuple[Goal, ...]) -> bool:
    """Whether an order of the things, or their match, is said: a program that makes it is hardly
    another's."""
    return any(
        isinstance(goal, Before | Matched) or (isinstance(goal, Formed) and goal.whole)
        for goal in goals
    )


def _of_landmarks(linked: Linked, binding: Mapping[str, tuple[str, ...]]) -> list[Stated]:
    found = []
    for one in linked.spoken:
        before = " ".join(token.text for token in linked.tokens[: one.first]) + " "
        way: Way | None = "farther" if _FARTHER.search(before) else None
        way = "closer" if _CLOSER.search(before) else way
        way = None if _COMPARES.search(before) and not _AIMS.search(before) else way
        marks = binding.get(one.mention.slot, ())
        moved = _theme_before(one, linked)
        movers = () if moved is None else binding.get(moved.mention.slot, ())
        if _GOES_ON.search(" ".join(token.text for token in linked.tokens[one.last :])):
            continue  # "take it away from the box and put it in the basket": the basket decides
        if way is not None and marks and movers and not set(movers) & set(marks):
            found.append(Stated(way, movers, marks))
    return found


def _theme_before(landmark: Spoken, linked: Linked) -> Spoken | None:
    """What is to end closer to a landmark, or farther from it: the last theme named before it."""
    themes = [one for one in linked.spoken if one.theme and one.first < landmark.first]
    return themes[-1] if themes else None


def _from_there(text: str, binding: Mapping[str, tuple[str, ...]]) -> list[Stated]:
    """ "The cup stands close to the box; move it away from there": of two, both ways."""
    if len(binding) != 2 or not _FROM_THERE.search(text):
        return []
    one, other = binding.values()
    return [] if set(one) & set(other) else [Stated("farther", one, other)]


def _of_each_other(
    text: str, linked: Linked, binding: Mapping[str, tuple[str, ...]]
) -> list[Stated]:
    """ "Space the bolts out a bit more", "a little closer together": one way for all of them."""
    apart, closer = _APART.search(text), _TOGETHER.search(text)
    said = apart or closer
    meant = [one for one in linked.spoken if one.theme or one.relation == "between"]
    movers = tuple(dict.fromkeys(o for one in meant for o in binding.get(one.mention.slot, ())))
    if said is None or (apart and closer) or len(movers) < 2:
        return []
    if _FORMED.search(text[said.end() :]) or len(meant) < len(linked.spoken):
        return []
    return [Stated("apart" if apart else "together", movers)]


def as_stated(goals: tuple[Goal, ...], before: Scene, after: Scene) -> bool:
    """Whether everything ends as it was said to."""
    return all(_holds(goal, before, after) for goal in goals)


def _holds(goal: Goal, before: Scene, after: Scene) -> bool:
    if isinstance(goal, Before):
        return in_sequence(goal, after)
    if isinstance(goal, Formed):
        return in_form(goal, after)
    if isinstance(goal, Figure):
        return in_figure(goal, after)
    if isinstance(goal, Upon):
        return carried_so(goal, before, after)
    if isinstance(goal, Left):
        return left_so(goal, before, after)
    if isinstance(goal, Placed):
        return in_part(goal, before, after)
    if isinstance(goal, Matched):
        return in_match(goal, before, after)
    if goal.way in ("apart", "together"):
        return _loosened(goal, before, after)
    if goal.way == "out":
        return all(_out(goal, before, before.get(o), after.get(o)) for o in goal.movers)
    return all(_parted(goal, mover, before, after) for mover in goal.movers)


def _loosened(goal: Stated, before: Scene, after: Scene) -> bool:
    """Whether the gaps between the things grow, or shrink, taken together."""
    was, now = _gaps(goal.movers, before), _gaps(goal.movers, after)
    if not was or len(now) < len(was):
        return True  # one of them waits in the tray, or is held
    grown = (sum(now) - sum(was)) / len(was)
    return grown > CHANGED if goal.way == "apart" else grown < -CHANGED or max(now) <= CHANGED


def _gaps(things: tuple[str, ...], scene: Scene) -> list[float]:
    items = [scene.get(one) for one in things if scene.get(one).x is not None]
    return [gap(one, other) for one, other in combinations(items, 2)]


def _out(goal: Stated, scene: Scene, was: SceneObject, now: SceneObject) -> bool:
    """Whether a thing that was in the part has left it; what was not in it may be anywhere."""
    if was.x is None or now.x is None or not _inside(goal, scene, was) or off_table(now):
        return True
    return not _inside(goal, scene, now)


def _inside(goal: Stated, scene: Scene, item: SceneObject) -> bool:
    x, y = item.position
    if not goal.part:
        return abs(x) < MIDDLE and abs(y) < MIDDLE
    if goal.corner:
        return in_corner(scene, item, *goal.part)
    ahead = {"left": -x, "right": x, "above": y, "below": -y}
    return all(ahead[side] > 0 for side in goal.part)


def _parted(goal: Stated, mover: str, before: Scene, after: Scene) -> bool:
    """Whether a thing ends closer to the nearest of the landmarks, or farther from it."""
    was, now = _nearest(goal, mover, before), _nearest(goal, mover, after)
    if after.get(mover).held and not before.get(mover).held:
        return False
    if was is None or now is None:
        return True
    if goal.way == "closer":
        return now < was - CHANGED or was <= CHANGED
    lifted = before.get(mover).on in goal.landmarks and after.get(mover).on not in goal.landmarks
    return now > was + CHANGED or lifted or off_table(after.get(mover))


def _nearest(goal: Stated, mover: str, scene: Scene) -> float | None:
    marks = [scene.get(mark) for mark in goal.landmarks if scene.get(mark).x is not None]
    item = scene.get(mover)
    if item.x is None or not marks:
        return None
    return min(gap(item, mark) for mark in marks)


def _outside_ranks(linked: Linked) -> str:
    """The words of a sentence, "the first brick from the right" said as the thing that it is."""
    counted = [one for one in linked.spoken if one.phrase is not None and one.phrase.origin]
    inside = {i for one in counted for i in range(one.first, one.last)}
    return " ".join("thing" if i in inside else token.text for i, token in enumerate(linked.tokens))

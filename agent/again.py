"""What a person is asked where the tries are spent: who is to do the rest, and how (pure).

The rest is written over the goal of the first plan and not over its motions: each thing that is not
where it was meant to be goes there from wherever it stands by then, and one that a person has
brought there meanwhile stays. So it can be run again, as after "I moved it by hand".
"""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence

from agent.messages import BY_HAND, LEAVE, Kind, Option, Question
from agent.report import TOLERANCE, strays, title
from scene.types import Scene, SceneObject, identifiers

TRY_AGAIN = "try again"
KIND: Kind = "manipulate"


def what_next(
    goal: Scene, seen: Scene, touched: Sequence[str] | None, carried: Collection[str]
) -> Question | None:
    """What to ask after a failure; None where nothing that may be touched is left to do.

    ``carried``: ids of what was to be carried; anything else was pushed. Only things that lie where
    the gripper can take them as they are can be tried again.
    """
    left = [(want, got) for want, got in strays(goal, seen) if _may(want, touched)]
    lost = [want for want, got in left if got is None or not _takeable(want, got)]
    program = _program(left, seen, carried)
    if not left or program is None:
        return None
    ids = tuple(want.id for want, _ in left)
    named = tuple(dict.fromkeys((*ids, *(touched or ()))))
    again = Option(TRY_AGAIN, program=program, kind=KIND, touched=named)
    by_hand = Option(BY_HAND, program=program, kind=KIND, touched=named)
    leave = Option(LEAVE)
    if lost:
        names = " and ".join(title(want, goal) for want in lost)
        text = (
            f"I can't take {names} from there. Can you put it right by hand, or shall I leave it?"
        )
        return Question("confirm", text, (by_hand, leave))
    return Question("confirm", "Shall I try again?", (again, by_hand, leave))


def _may(want: SceneObject, touched: Sequence[str] | None) -> bool:
    return touched is None or want.id in touched


def _takeable(want: SceneObject, got: SceneObject) -> bool:
    return got.on != "floor" and (got.upright or not want.upright)


def _program(
    left: Sequence[tuple[SceneObject, SceneObject | None]], seen: Scene, carried: Collection[str]
) -> str | None:
    """Each thing to where it was meant to be, unless it is there; None where words are lacking."""
    names = {item.id: name for name, item in identifiers(seen).items()}
    lines: list[str] = []
    for want, got in left:
        fallen = None if got is None else _toppled(want, got, names)
        deed = fallen or _deed(want, names, carried)
        if deed is None:
            return None
        lines += deed
    return "\n".join(lines)


def _toppled(want: SceneObject, got: SceneObject, names: dict[str, str]) -> tuple[str, ...] | None:
    """Knocking over what still stands, towards where it should lie; None where that is not it."""
    if want.upright or not got.upright or want.on == "floor":
        return None
    (x, y), (to_x, to_y), name = got.position, want.position, names[want.id]
    angle = math.atan2(to_y - y, to_x - x)
    return f"if {name}.tall > {(want.tall + got.tall) / 2:.4g}:", f"    topple({name}, {angle:.4g})"


def _deed(
    want: SceneObject, names: dict[str, str], carried: Collection[str]
) -> tuple[str, ...] | None:
    name = names.get(want.id)
    if name is None or want.on == "tray":
        return None
    if want.held:
        return (f"pick({name})",)
    if want.on in names:
        other = names[want.on]
        there = f"distance({name}, {other}) > {other}.width / 2 or {name}.z < {other}.z + 0.005"
        return f"if {there}:", f"    put_on({name}, {other})"
    x, y = want.position
    verb = "put" if want.id in carried and want.on == "table" else "push"
    place = f"[{x:.4g}, {y:.4g}]"
    return f"if distance({name}, {place}) > {TOLERANCE}:", f"    {verb}({name}, {place})"

"""Taking a motion back: an inverse program, checked like any other (clarifier design, dialogue).

What is known of a motion is how the things that it should move stood before (`Done`). The way back
is found from the live scene, not from the motion: wherever those things are now, they go where they
stood, upper ones first. What cannot be put back by this arm is said, and nothing moves.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from agent.messages import Done
from agent.report import TURNED, changed, turned
from scene.types import Scene, SceneObject, identifiers

REMEMBERED = 8
"""Motions that can be taken back, one after the other."""


class WayBack(NamedTuple):
    """An inverse program, and the ids of what it moves."""

    program: str
    touched: tuple[str, ...]


def remembered(done: Sequence[Done], text: str, before: Scene, after: Scene) -> tuple[Done, ...]:
    """The motions so far with one more, that leads from ``before`` to ``after``."""
    stood = tuple(old for old, _ in changed(before, after))
    return (*done, Done(text, stood))[-REMEMBERED:] if stood else tuple(done)


def way_back(done: Done, scene: Scene) -> WayBack | str | None:
    """The program that puts everything back where it stood; why there is none; None if all is
    there already."""
    gone = {item.id for item in done.stood} - {item.id for item in scene}
    if gone:
        missing = next(item for item in done.stood if item.id in gone)
        return f"I can't see the {missing.name} any more."
    pairs = changed(Scene(objects=done.stood), scene)
    if not pairs:
        return None
    for old, now in pairs:
        why = _beyond_reach(old, now)
        if why is not None:
            return why
    pairs.sort(key=lambda pair: -pair[1].z)
    names = {item.id: name for name, item in identifiers(scene).items()}
    present = {item.id: item for item in scene}
    stood = [old for old, _ in pairs if not old.held]
    lines = [
        *_on_the_table([old for old in stood if old.on == "table"], names),
        *(line for old in stood if old.on in present for line in _upon(old, present, names)),
        *(_back_round(old, now, names[old.id]) for old, now in pairs
          if not old.held and abs(turned(old, now)) > TURNED),
        *(f"pick({names[old.id]})" for old, _ in pairs if old.held),
    ]  # fmt: skip
    return WayBack("\n".join(lines), tuple(old.id for old, _ in pairs))


def _beyond_reach(item: SceneObject, now: SceneObject) -> str | None:
    """Why the thing cannot be put back as it was; None if it can."""
    if now.on == "floor":
        return f"The {item.name} lies on the floor, where I can't reach it."
    if now.upright != item.upright:
        return f"The {item.name} has fallen over, and I can't set it upright."
    if item.on == "tray":
        return f"I can't put the {item.name} back into the tray."
    return None


def _on_the_table(stood: Sequence[SceneObject], names: dict[str, str]) -> Iterable[str]:
    if len(stood) == 1:
        yield f"put({names[stood[0].id]}, {_place(stood[0])})"
    elif stood:
        things = ", ".join(names[item.id] for item in stood)
        yield f"put_each([{things}], [{', '.join(map(_place, stood))}])"


def _upon(item: SceneObject, now: dict[str, SceneObject], names: dict[str, str]) -> Iterable[str]:
    """Back onto, or into, what it stood on, which may have gone back itself."""
    below = now[item.on]
    yield f"pick({names[item.id]})"
    yield f"set_down({names[item.id]}, {_place(item)}, {below.z + below.tall:.4g})"


def _back_round(old: SceneObject, now: SceneObject, name: str) -> str:
    at = f"{old.x:.4g}, {old.y:.4g}, {old.z:.4g}"
    return f"turn(at({name}, {at}), {-turned(old, now):.4g})"


def _place(item: SceneObject) -> str:
    return f"[{item.x:.4g}, {item.y:.4g}]"

"""Where something stood before it was moved, in this sentence or in an earlier one: "put the bell
where the red can was" says a place that is measured from the table's edges.
"""

from __future__ import annotations

from collections.abc import Sequence

from agent.messages import Done
from clarifier.spoken import Linked, settles
from clarifier.words import match_run
from scene.types import Scene, SceneObject

_PAST = tuple(
    tuple(run.split())
    for run in ("used to be", "used to stand", "had been", "had stood", "has been", "was standing",
                "was", "were", "stood", "lay", "sat")
)  # fmt: skip
_LATER = frozenset({"before", "originally", "earlier", "previously", "first", "initially", "then"})


def at_old_place(linked: Linked, scene: Scene, done: Sequence[Done]) -> str | None:
    """The sentence with the place in numbers; None where none is spoken of, or it is not known."""
    for at, token in enumerate(linked.tokens):
        stood = next((one for one in linked.spoken if one.opened == at + 1), None)
        if token.text != "where" or stood is None or not settles(stood.mention):
            continue
        end = _behind_past(stood.last, linked)
        mover = _mover(at, linked, scene)
        old = _before(stood.mention.objects[0], linked, scene, done, at)
        if mover is not None and stood.mention.objects == (mover.id,):
            old = _last_moved(mover.id, done) if stood.phrase is None else None
        if end is None or mover is None or old is None:
            continue
        place = _measured(old, mover, scene)
        if place is not None:
            until = linked.tokens[end - 1].end
            return f"{linked.text[: token.start]}{place}{linked.text[until:]}"
    return None


def _behind_past(at: int, linked: Linked) -> int | None:
    """The token behind "was", "used to be before"; None where nothing says that it is past."""
    for run in _PAST:
        if match_run(linked.tokens, at, run):
            end = at + len(run)
            while end < len(linked.tokens) and linked.tokens[end].text in _LATER:
                end += 1
            return end
    return None


def _mover(at: int, linked: Linked, scene: Scene) -> SceneObject | None:
    """The one thing that goes there: the last theme before "where"."""
    themes = [one for one in linked.spoken if one.theme and one.last <= at]
    if not themes or not settles(themes[-1].mention):
        return None
    return scene.get(themes[-1].mention.objects[0])


def _last_moved(mover: str, done: Sequence[Done]) -> SceneObject | None:
    """ "Put the scanner where it was", which never moved: the one thing moved last, as it stood."""
    stood = done[-1].stood if done else ()
    moved = any(item.id == mover for one in done for item in one.stood)
    return stood[0] if len(stood) == 1 and not moved and stood[0].on == "table" else None


def _before(
    name: str, linked: Linked, scene: Scene, done: Sequence[Done], at: int
) -> SceneObject | None:
    """The thing as it stood on the table before it was moved: in this sentence, else before."""
    moved = any(name in one.mention.objects and one.theme and one.last <= at
                for one in linked.spoken)  # fmt: skip
    past = [item for one in reversed(done) for item in one.stood if item.id == name]
    old = scene.get(name) if moved else past[0] if past else None
    return old if old is not None and old.on == "table" and old.x is not None else None


def _measured(old: SceneObject, mover: SceneObject, scene: Scene) -> str | None:
    """Its place for the mover, in centimetres from the left and the front edge to its sides."""
    x, y = old.position
    left, front = 1 + x - mover.width / 2, 1 + y - mover.height / 2
    if min(left, front) <= 0.0:
        return None
    unit = 100 * scene.table_m / 2
    return f"{left * unit:.2f} cm from the left edge and {front * unit:.2f} cm from the front edge"

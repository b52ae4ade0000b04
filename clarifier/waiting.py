"""What waits in the tray, beside the table: the arm takes it from there, and does nothing else to
it where it is.
"""

from __future__ import annotations

from agent.messages import Problem
from clarifier.binding import Binding
from clarifier.spoken import Linked
from clarifier.words import listing
from scene.types import EDGE, Scene, SceneObject

_MOVED = frozenset({"place", "push", "turn", "topple", "pick", "arrange"})
"""Verbs after which what they are done to stands elsewhere, or otherwise."""


def left_waiting(linked: Linked, binding: Binding, before: Scene, after: Scene) -> Problem | None:
    """A thing that is to be moved and would wait on in the tray, or another that would go to one
    which waits: pushed, turned or stacked upon it can only be once it stands on the table."""
    waiting = {item.id for item in before.tray}
    ends = {item.id: item for item in after}
    named = [o for one in linked.spoken for o in binding.get(one.mention.slot, ())]
    moved = [
        o
        for one in linked.spoken
        if one.theme and one.verb in _MOVED
        for o in binding.get(one.mention.slot, ())
    ]
    off = any(ends[o].on == "floor" for o in named if o in ends and o not in waiting)
    still = [o for o in dict.fromkeys(moved if not off else named) if o in waiting]
    still = [o for o in still if ends[o].on == "tray" or _beside(ends[o])]
    if not still:
        return None
    names = listing(f"the {before.get(o).name}" for o in still)
    verb = "wait" if len(still) > 1 else "waits"
    text = f"{names} {verb} in the tray, beside the table: say first where on the table to put"
    return Problem("impossible", f"{text} {'them' if len(still) > 1 else 'it'}", object=still[0])


def _beside(item: SceneObject) -> bool:
    """Whether it fell where the tray is."""
    return item.on == "floor" and item.position[0] > EDGE

"""What cannot go into a thing because it is larger than it: said before anything is tried.

Only where the sentence says in or into, and both sizes are known: on top of it, or beside it, may
still be what is wanted, so the refusal offers that.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from agent.messages import Problem
from clarifier.spoken import Linked
from scene.kinds import is_container
from scene.types import Scene, SceneObject

WALL = 0.02
"""Less than this is allowed for a container's wall on either side (table units)."""
FLAT = 0.2
"""What is lower than this share of its width (a plate, a mat) holds things on it, "in" or not."""

_INTO = re.compile(r"put_(?:all_)?on\((\w+), (\w+)\)")
_INSIDE = frozenset({"inside", "into", "within"})


def too_large(
    body: str, linked: Linked, binding: Mapping[str, tuple[str, ...]], scene: Scene
) -> Problem | None:
    """The first thing that a program puts into something too small for it, though it was said to
    go in: a problem with both sizes; None where there is none."""
    for things, into in _INTO.findall(body):
        if things not in binding or into not in binding or len(binding[into]) != 1:
            continue
        holder = scene.get(binding[into][0])
        if not _said_in(linked, into, holder):
            continue
        large = next((o for o in binding[things] if not _goes_in(scene.get(o), holder)), None)
        if large is not None:
            return _refused(scene.get(large), holder, scene)
    return None


def _said_in(linked: Linked, slot: str, holder: SceneObject) -> bool:
    """Whether the sentence says that something goes into it; of what is no known container only
    where it says so plainly, and of a mere surface (a tray) never."""
    if holder.tall < FLAT * min(holder.width, holder.height):
        return False
    for one in linked.spoken:
        if one.mention.slot != slot or one.relation != "in":
            continue
        if is_container(holder.name):
            return True
        words = {token.text for token in linked.tokens[max(one.opened - 2, 0) : one.opened]}
        if words & _INSIDE:
            return True
    return False


def _goes_in(item: SceneObject, holder: SceneObject) -> bool:
    """Whether a thing fits into the opening, turned or stood on end as may be."""
    least, middle, _ = sorted((item.width, item.height, item.tall))
    narrow, wide = sorted((holder.width, holder.height))
    return least <= narrow - WALL and middle <= wide - WALL


def _refused(item: SceneObject, holder: SceneObject, scene: Scene) -> Problem:
    text = (
        f"the {item.name} ({_size(item, scene)} cm) is too large to go into the {holder.name} "
        f"({_size(holder, scene)} cm). I can put it on the {holder.name}, or beside it"
    )
    return Problem("impossible", text, object=item.id)


def _size(item: SceneObject, scene: Scene) -> str:
    """Width and depth, as "13 x 9" (centimetres)."""
    unit = 100 * scene.table_m / 2
    return f"{item.width * unit:.0f} x {item.height * unit:.0f}"

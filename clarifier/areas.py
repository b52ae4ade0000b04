"""Areas marked on the table (a zone, a pad): what is brought "to" one is to stand on it."""

from __future__ import annotations

from clarifier.lexicon import Lexicon
from clarifier.pieces import Chunk
from clarifier.spoken import Linked, Spoken
from scene.types import Scene, SceneObject

FLAT = 0.2
"""An area is lower than this share of its narrower side."""
_ELSEWHERE = frozenset({"touch", "turn", "trace", "cannot", "harmful", "topple"})
"""Classes of verbs whose "to" is no place to stand."""
_SHORT_OF = frozenset({"up", "close", "near", "next", "adjacent", "parallel"})
"""Before "to" these stay short of the area: "right up to the zone"."""


def onto_area(linked: Linked, scene: Scene, lexicon: Lexicon) -> str | None:
    """ "bring the cubes to the blue zone" as "... onto the blue zone"; None where nothing is said
    like that, or where the area is no larger than what goes there."""
    text = linked.text
    for chunk in reversed(linked.chunks):
        goal = next((s for s in linked.spoken if s.opened == chunk.last and s.phrase), None)
        if goal is None or not _leads(chunk, linked):
            continue
        movers = [s for s in linked.spoken if s.theme and s.last <= chunk.first]
        if not movers or (goal.verb in _ELSEWHERE and movers[-1].last < chunk.first - 1):
            continue  # "take it and go to the zone": the arm goes
        if _holds(goal, movers[-1], scene, lexicon):
            to = linked.tokens[chunk.first]
            text = f"{text[: to.start]}onto{text[to.end :]}"
    return None if text == linked.text else text


def _leads(chunk: Chunk, linked: Linked) -> bool:
    """Whether a chunk is the "to" of a destination."""
    before = linked.tokens[chunk.first - 1].text if chunk.first else ""
    bare = chunk.last == chunk.first + 1 and linked.tokens[chunk.first].text == "to"
    return chunk.value == "goal" and bare and before not in _SHORT_OF


def _holds(goal: Spoken, mover: Spoken, scene: Scene, lexicon: Lexicon) -> bool:
    """Whether a mention names areas only, and each takes each of what goes there."""
    assert goal.phrase is not None
    if not goal.phrase.head or goal.phrase.head[-1] not in lexicon.words("areas"):
        return False
    areas = [scene.get(o) for o in goal.mention.objects]
    things = [scene.get(o) for o in mover.mention.objects]
    return bool(areas) and all(_takes(area, thing) for area in areas for thing in things)


def _takes(area: SceneObject, thing: SceneObject) -> bool:
    least = min(area.width, area.height)
    return area.tall <= FLAT * least and max(thing.width, thing.height) <= least

"""Goals as calls, as the files of `evals.external` state them: what must hold after a dialogue.

A call is an object whose ``p`` names it: ``{"p": "near", "a": "cup_1", "b": "box_1", "max": 0.3}``.
It speaks of ids, carries its tolerances (table units, degrees), and may hold calls itself. What it
asks is asked of `scene.relations` where the word exists there. A call or a key that is not known
cannot be read: a goal that nobody judges must not look reached.
"""

from __future__ import annotations

from evals.calls import Call, holds
from evals.changes import (
    Closer,
    Farther,
    Moved,
    MovedDir,
    MovedDist,
    MovedToward,
    NothingMoved,
    OthersStill,
    Still,
    Visited,
)
from evals.places import (
    Aligned,
    At,
    Behind,
    Far,
    Grouped,
    InFrontOf,
    InRegion,
    LeftOf,
    Near,
    NoOverlap,
    On,
    OnTable,
    RightOf,
    Triangle,
)
from evals.world import World

__all__ = ["Goal", "holds"]


class AnyOf(Call, frozen=True, tag="any_of"):
    of: tuple[Goal, ...]

    def met(self, world: World) -> bool:
        return any(holds(call, world) for call in self.of)


class AllOf(Call, frozen=True, tag="all_of"):
    of: tuple[Goal, ...]

    def met(self, world: World) -> bool:
        return all(holds(call, world) for call in self.of)


class CountOf(Call, frozen=True, tag="count_of"):
    """So many of the calls hold: exactly ``n``, at least ``min``, at most ``max``."""

    of: tuple[Goal, ...]
    n: int | None = None
    min: int = 0
    max: int | None = None

    def met(self, world: World) -> bool:
        count = sum(holds(call, world) for call in self.of)
        few = self.max is None or count <= self.max
        return count >= self.min and few and self.n in (None, count)


Goal = (
    AnyOf | AllOf | CountOf | At | OnTable | On | InRegion | LeftOf | RightOf | Behind | InFrontOf
    | Near | Far | NoOverlap | Aligned | Triangle | Grouped | Still | OthersStill | NothingMoved
    | Moved | MovedDir | MovedDist | MovedToward | Closer | Farther | Visited
)  # fmt: skip
"""Every call that is understood."""

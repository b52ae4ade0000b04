"""Whether the eye can vouch for what a plan should have come to, or must look longer.

Each thing that a plan may have moved is beside its place, within its limit, or so near the limit
that the eye, which errs, cannot tell. `agent.report.strays` says what is beside; here is the rest.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from types import MappingProxyType
from typing import NamedTuple

from msgspec.structs import replace

from agent.arm import Arm
from agent.doubt import SIGMAS, SURE, Doubt, Stands, both, slack, vouched
from agent.report import MOVED, NEARLY, TOLERANCE, limit, off_place, strays
from scene.types import Scene, SceneObject

LOOKS_BEFORE, LOOKS_AFTER = 4, 8
"""How many looks more may be taken: before a plan that comes close to what must stay, and after."""
BETTER = 0.99
"""An eye whose errors do not fall to this share by another look sees no better by it."""
MINDED = 2.0
"""An eye that by so many of its deviations may miss that a thing is elsewhere says so."""


class Looked(NamedTuple):
    """What should be and what is seen: ``doubt`` of the one beside the other, ``stirred`` what may
    have been moved (ids), ``moved`` what should be; ``stands`` what rested when that was meant,
    ``unseen`` what cannot be seen now, or not wholly."""

    goal: Scene
    seen: Scene
    doubt: Doubt = SURE
    stirred: frozenset[str] = frozenset()
    moved: frozenset[str] = frozenset()
    stands: Stands = MappingProxyType({})
    unseen: frozenset[str] = frozenset()

    def seeing(self, seen: Scene, doubt: Doubt, now: Stands, unseen: Collection[str]) -> Looked:
        """The same with what is seen now, and ``doubt`` of that; ``now``: what of it rests."""
        stood = {id_ for id_, stand in self.stands.items() if now.get(id_) == stand}
        rest = {item.id: item for item in seen if item.id in stood - self.moved}
        goal = replace(
            self.goal, objects=tuple(self._better(item, rest) for item in self.goal.objects)
        )
        sure = both(self.doubt, doubt, stood)
        return self._replace(goal=goal, seen=seen, doubt=sure, unseen=frozenset(unseen))

    def _better(self, want: SceneObject, rest: Mapping[str, SceneObject]) -> SceneObject:
        """What must stay, where it is seen now if it was seen to rest: that another look sees it
        better, within the error of the one before, is no motion of it."""
        now = rest.get(want.id)
        if now is None or off_place(want, now) > slack(self.doubt, want.id):
            return want
        return replace(want, x=now.x, y=now.y)

    @property
    def still(self) -> frozenset[str]:
        """What may have been moved and must stay where it was."""
        return self.stirred - self.moved

    def beside(self) -> list[tuple[SceneObject, SceneObject | None]]:
        """What is seen not to be as it should."""
        return strays(self.goal, self.seen, self.doubt, self.still)

    def undecided(self) -> bool:
        """Whether more pictures could tell: what is beside its place, if anything is, may be within
        its limit, or something else may be beyond it."""
        near = {one.id for one, off, most, error in self._places() if abs(off - most) < error}
        return bool(near) and {want.id for want, _ in self.beside()} <= near

    def unsure(self) -> list[tuple[SceneObject, float]]:
        """What is neither seen beside its place nor surely within its limit, and how far off it may
        be (table units); so is what was put on something and cannot be seen there."""
        beside = {want.id for want, _ in self.beside()}
        return [
            (want, off + error)
            for want, off, most, error in self._places()
            if want.id not in beside and (off > vouched(most, error) or self._guessed(want))
        ]

    def _guessed(self, want: SceneObject) -> bool:
        """Whether a thing is believed to be on another, or to stand out of it, only because it was
        put there: it fell, or is hidden. What lies low in a container is hidden there."""
        carrier = next((one for one in self.goal.objects if one.id == want.on), None)
        if carrier is None or want.id not in self.moved & self.unseen:
            return False
        return want.top > carrier.top + TOLERANCE

    def nearly(self) -> list[SceneObject]:
        """What is seen a little beside its place, farther than the eye errs: all that the eye is
        not sure of, and what should be moved from `NEARLY` on."""
        unsure = {one.id for one, _ in self.unsure()}
        return [
            want
            for want, off, most, error in self._places()
            if error < off <= most
            and (want.id in unsure or (want.id in self.moved and most > off > NEARLY))
        ]

    def blur(self) -> list[tuple[SceneObject, float]]:
        """What is seen in its place, but so roughly that a person may find it elsewhere, and how
        far off it may be (table units).

        Nobody minds how roughly that is seen which was to stay and bears what was put there.
        """
        under = {item.on for item in self.seen}
        return [
            (want, off + error)
            for want, off, most, error in self._places()
            if off + MINDED * error / SIGMAS > max(most, TOLERANCE)
            and (want.id in self.moved or want.id not in under)
        ]

    def _places(self) -> list[tuple[SceneObject, float, float, float]]:
        """Of each thing that may have been moved: how far off it is, how far it may be, and by how
        much the eye may err."""
        seen = {item.id: item for item in self.seen}
        return [
            (want, off_place(want, seen[want.id]),
             limit(want, self.goal, self.still), slack(self.doubt, want.id))
            for want in self.goal
            if want.id in self.stirred and want.id in seen
        ]  # fmt: skip


def steady(arm: Arm, still: Collection[str]) -> Scene | None:
    """The scene, looked at until what must stay is known well enough to tell afterwards that it
    did; None where it is so already. Raises as `Arm.scene`."""

    def blurred(_: Scene | None, doubt: Doubt) -> bool:
        return any(slack(doubt, one) > MOVED / 4 for one in still)

    if not blurred(None, arm.doubt()):
        return None
    return longer(arm, blurred, LOOKS_BEFORE - 1)[0]


def longer(arm: Arm, undecided: Callable[[Scene, Doubt], bool], looks: int) -> tuple[Scene, Doubt]:
    """Look, and so many times again as long as it is undecided and the eye sees better by it: the
    scene and its doubt. Raises as `Arm.scene`."""
    seen, doubt = arm.scene(), arm.doubt()
    for _ in range(looks):
        if not undecided(seen, doubt):
            break
        before, seen, doubt = doubt, arm.scene(), arm.doubt()
        if not any(doubt.get(one, 0.0) < BETTER * sd for one, sd in before.items()):
            break
    return seen, doubt

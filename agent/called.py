"""What the person calls things: names given in a conversation stand in the scene of every look.

An eye keeps such a name for good (`Arm.call`); where the scene comes from elsewhere, the
conversation alone knows it.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping

import msgspec

from agent.arm import Arm
from agent.doubt import Doubt, Stands
from agent.messages import StepReport
from robot_bridge.api import ApprovedPlan, Workspace
from scene.types import Pose, Scene, SceneObject


def called(scene: Scene, names: Mapping[str, str]) -> Scene:
    """The scene with objects (by id) called by these names."""
    if not names:
        return scene

    def named(items: tuple[SceneObject, ...]) -> tuple[SceneObject, ...]:
        return tuple(msgspec.structs.replace(i, name=names.get(i.id, i.name)) for i in items)

    return msgspec.structs.replace(scene, objects=named(scene.objects), tray=named(scene.tray))


class CalledArm:
    """An arm whose scene is told in the names that the person gave."""

    def __init__(self, arm: Arm, names: Mapping[str, str]) -> None:
        self._arm = arm
        self._names = names

    @property
    def workspace(self) -> Workspace:
        """See `Arm`."""
        return self._arm.workspace

    def scene(self) -> Scene:
        """See `Arm`."""
        return called(self._arm.scene(), self._names)

    def doubt(self) -> Doubt:
        """See `Arm`."""
        return self._arm.doubt()

    def heights(self) -> Doubt:
        """See `Arm`."""
        return self._arm.heights()

    def unseen(self) -> Collection[str]:
        """See `Arm`."""
        return self._arm.unseen()

    def stands(self) -> Stands:
        """See `Arm`."""
        return self._arm.stands()

    def start(self) -> Pose:
        """See `Arm`."""
        return self._arm.start()

    def run(self, plan: ApprovedPlan, *, hold: bool = False) -> Iterator[StepReport]:
        """See `Arm`."""
        return self._arm.run(plan, hold=hold)

    def call(self, id_: str, name: str) -> None:
        """See `Arm`."""
        self._arm.call(id_, name)

    def stop(self) -> None:
        """See `Arm`."""
        self._arm.stop()

    def reset(self) -> None:
        """See `Arm`."""
        self._arm.reset()

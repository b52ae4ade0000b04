"""The things of the ideal table and the tool among them: what carries what (pure state)."""

from __future__ import annotations

from robot_bridge.body import Body
from scene.types import Pose

TOOL_RADIUS = 0.04
"""Radius of the suction cup (table units)."""


class Things:
    """All bodies; ``tip`` is the pose of the tool's tip, ``held`` the body it holds."""

    def __init__(self, bodies: list[Body], tip: Pose) -> None:
        self.bodies = bodies
        self.tip = tip
        self.held: Body | None = None

    def riders(self, body: Body) -> list[Body]:
        """What stands on or in a body, directly or not."""
        found = [body]
        for carrier in found:
            found += [other for other in self.bodies if other.on == carrier.id]
        return found[1:]

    def carried(self) -> list[Body]:
        """What moves with the tool: the held thing and what stands on it."""
        return [] if self.held is None else [self.held, *self.riders(self.held)]

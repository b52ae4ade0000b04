"""The ideal table: things, a tool and what it does to them; kinematic, exact, deterministic.

The tool is a vertical cylinder; its tip goes along straight lines. What it may do to things:

- **push**: a tip below a thing's top slides the thing ahead, without turning it, and whatever
  that meets; a thing caught only by its flank is shoved aside. What stands on it goes along.
- **topple**: pushed higher than ``extent / (2 * FRICTION)`` above its base, an upright thing
  falls over, away from the tool (`contact.py` has both).
- **fall**: a thing whose centre leaves its support drops to what is below: the floor beyond the
  table's edge, where nothing reaches it any more.
- **press**: a tool, or what it holds, that comes down onto a thing stops at its top; the rest of
  that motion is not made. Containers are hollow, so it may go down into them.
- **grip**: suction at the top of a thing holds it; released, it falls straight down.

Tray objects wait in recesses beside the table: nothing pushes them, suction lifts them out.
"""

from __future__ import annotations

import math

from robot_bridge import contact
from robot_bridge.body import SKIM, Body, disc_meets, inside, overlap
from robot_bridge.things import TOOL_RADIUS, Things
from scene.tray import tray_positions
from scene.types import Pose, Scene, SceneObject

GRIP_REACH = 0.03
"""Largest distance between tip and top at which suction holds."""
STEP = 0.02
"""Length of the pieces of a slanting motion among things."""


class Table(Things):
    """The world of the ideal robot. Not thread-safe."""

    def __init__(self, scene: Scene, tip: Pose) -> None:
        super().__init__([Body(item, *item.position) for item in scene.objects], tip)
        self.table_m = scene.table_m
        self.suction = False
        self.waiting: dict[str, SceneObject] = {}
        self._seat(scene)
        for item, body in zip(scene.objects, self.bodies, strict=False):
            if item.held:
                self.held, self.suction = body, True

    def _seat(self, scene: Scene) -> None:
        places = tray_positions(scene)
        self.waiting = {item.id: item for item in scene.tray}
        self.bodies += [Body(it, *places[it.id]) for it in scene.tray if it.id in places]

    def reseat(self) -> None:
        """Let the tray close up: what still waits moves to ``tray_positions`` of this scene."""
        if self.waiting:
            now = self.scene()
            self.bodies = [body for body in self.bodies if body.on != "tray"]
            self._seat(now)

    @property
    def holding(self) -> bool:
        """Whether suction holds something."""
        return self.held is not None

    def scene(self) -> Scene:
        """The world as a Scene: objects in their first order, then those taken from the tray."""
        objects = tuple(self._item(body) for body in self.bodies if body.on != "tray")
        return Scene(objects=objects, tray=tuple(self.waiting.values()), table_m=self.table_m)

    def _item(self, body: Body) -> SceneObject:
        return SceneObject(
            id=body.id,
            name=body.name,
            x=body.x,
            y=body.y,
            z=body.z,
            width=body.width,
            height=body.height,
            tall=body.tall,
            r=body.r,
            color=body.color,
            on=body.on,
            upright=body.upright,
            held=body is self.held,
        )

    # --- motion ---------------------------------------------------------------------------

    def move(self, x: float, y: float, z: float, r: float) -> bool:
        """Take the tip along the straight line to the pose. False if something blocked it."""
        self._turn(r)
        free = self._go(x, y, z)
        if free:
            self.tip = Pose(x, y, z, r)
        return free

    def _go(self, x: float, y: float, z: float) -> bool:
        start = self.tip
        span = math.hypot(x - start.x, y - start.y)
        if span < 1e-9:
            return self._vertical(z)
        if self._clear(min(start.z, z)):
            self._carry(x - start.x, y - start.y, z - start.z)
            return True
        if abs(z - start.z) < 1e-9:
            self._slide((x - start.x) / span, (y - start.y) / span, span)
            return True
        return self._slant(x, y, z, span)

    def _clear(self, low: float) -> bool:
        """Whether a tip no lower than this, and what it carries, is above everything."""
        carried = self.carried()
        base = min((low + body.z - self.tip.z for body in carried), default=low)
        return all(
            body.on == "floor" or body in carried or body.top - SKIM <= base for body in self.bodies
        )

    def _slant(self, x: float, y: float, z: float, span: float) -> bool:
        """A motion both sideways and up or down, in small pieces; stops where it is blocked."""
        start = self.tip
        pieces = max(1, math.ceil(span / STEP))
        ux, uy = (x - start.x) / span, (y - start.y) / span
        for piece in range(1, pieces + 1):
            level = start.z + (z - start.z) * piece / pieces
            rising = level > self.tip.z
            if rising:
                self._vertical(level)
            self._slide(ux, uy, span / pieces)
            if not rising and not self._vertical(level):
                return False
        return True

    def _turn(self, r: float) -> None:
        angle = math.remainder(r - self.tip.r, math.tau)
        if abs(angle) > 1e-12:
            for body in self.carried():
                body.spin(self.tip.x, self.tip.y, angle)
            self.tip = Pose(self.tip.x, self.tip.y, self.tip.z, r)

    def _carry(self, dx: float, dy: float, dz: float) -> None:
        for body in self.carried():
            body.shift(dx, dy, dz)
        tip = self.tip
        self.tip = Pose(tip.x + dx, tip.y + dy, tip.z + dz, tip.r)

    def _vertical(self, z: float) -> bool:
        """Straight up or down, down to the first surface below. False if that came too soon."""
        goal = z if z >= self.tip.z else max(z, self._lowest())
        goal = max(goal, min(z, self.tip.z))
        self._carry(0.0, 0.0, goal - self.tip.z)
        return goal <= z + SKIM

    def _lowest(self) -> float:
        """Lowest height of the tip that the surfaces below allow, here."""
        tip, carried = self.tip, self.carried()
        lowest = 0.0
        for body in self.bodies:
            if body.on == "floor" or body in carried:
                continue
            if disc_meets(body, tip.x, tip.y, TOOL_RADIUS):
                inner = body.hollow and body.covers(tip.x, tip.y, body.wall + TOOL_RADIUS - SKIM)
                lowest = _raised(lowest, body.floor if inner else body.top, tip.z)
            for part in carried:
                if part.top > body.z and overlap(part, body) > SKIM:
                    surface = body.floor if self._enters(part, body) else body.top
                    lowest = _raised(lowest, surface + tip.z - part.z, tip.z)
        if self.held is not None:
            lowest = _raised(lowest, tip.z - self.held.z, tip.z)
        return lowest

    def _enters(self, part: Body, container: Body) -> bool:
        """Whether a carried thing goes down inside the container rather than onto its rim."""
        if not container.hollow:
            return False
        z, part.z = part.z, min(part.z, container.floor)
        try:
            return inside(part, container)
        finally:
            part.z = z

    def _slide(self, ux: float, uy: float, length: float) -> None:
        contact.sweep(self, ux, uy, length)

    # --- suction ----------------------------------------------------------------------------

    def grip(self, on: bool) -> bool:
        """Suction on or off; whether something is held afterwards."""
        if on and self.held is None:
            self.suction, self.held = True, self._under_tip()
            if self.held is not None:
                self.waiting.pop(self.held.id, None)
                self._to_end(self.held, was_waiting=self.held.on == "tray")
                self.held.on = "gripper"
        elif not on:
            released, self.held, self.suction = self.held, None, False
            if released is not None:
                released.on = "table"
                contact.settle(self, released)
        return self.held is not None

    def lose(self) -> None:
        """What is held slips off and falls straight down; suction stays on."""
        self.grip(False)
        self.suction = True

    def _to_end(self, body: Body, *, was_waiting: bool) -> None:
        if was_waiting:
            self.bodies.remove(body)
            self.bodies.append(body)

    def _under_tip(self) -> Body | None:
        """The thing whose top is at the tip, and of several the one nearest to it."""
        tip = self.tip
        near = [
            body
            for body in self.bodies
            if body.on != "floor"
            and abs(body.top - tip.z) <= GRIP_REACH
            and body.covers(tip.x, tip.y)
        ]
        return min(near, key=lambda body: (round(abs(body.top - tip.z), 6), -body.z), default=None)


def _raised(lowest: float, surface: float, start: float) -> float:
    """The higher of two limits, where a surface above the start is no limit."""
    return surface if lowest < surface <= start + SKIM else lowest

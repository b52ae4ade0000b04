"""A world with physics: the tool's motion, suction, and the scene read back from it.

The physics client is passed in (`bullet.py` makes it). One unit of the simulator's length is one
table unit, so that small things are large enough for the engine; gravity and forces are scaled
to match (``per_metre`` units are a metre), so that time and masses are real.
"""

from __future__ import annotations

import math
import random
from collections.abc import Sequence

import msgspec

from agent.messages import KeepOut
from robot_bridge.api import PARK
from robot_bridge.body import Body
from robot_bridge.furniture import (
    FLOOR,
    FRICTION,
    GROUND,
    THING,
    TOOL_LENGTH,
    TOOL_RADIUS,
    TRAY,
    Physics,
    Thing,
    hang,
    make_ground,
    make_thing,
    make_tool,
    set_group,
)
from robot_bridge.motion import crosses
from robot_bridge.standing import base_height, oriented, support_of
from scene.tray import tray_positions
from scene.types import EDGE, Pose, Scene, SceneObject

STEP = 1 / 240
"""Seconds of one step of the engine."""
TICK = 8
"""Steps between two looks at stop, stall, suction and pace."""
TOOL_FORCE, SUCTION_FORCE = 60.0, 11.0
"""Newtons in the real world."""
SUCTION_REACH_M, SUCTION_SLIP_M = 0.006, 0.005
"""How far below the cup suction takes hold; how far it stretches before it lets go (metres)."""
LEVEL = 0.9
"""Least upward part of the normal of a surface that suction holds."""
STALL = 0.04
"""Distance by which the tool lags behind its target when something blocks it (table units)."""


MEET = 5.0
"""Force with which the tool, going down, presses on something before the motion ends (newtons):
with all of its own it would squeeze a small thing into the table."""
PRESS = 0.006
"""Depth by which the tool may press into something before the motion ends there (table units)."""


LIP = 0.9
"""From this share of a thing's height on the tool meets it with the lip of its cup, which is
smooth; its shaft rubs as everything does. Else its own friction would keep upright what topples on
the ideal table, whose tool is smooth."""


class World:
    """The engine's world. Not thread-safe; ``p`` is a physics client of its own."""

    def __init__(self, p: Physics) -> None:
        self.p = p
        self.things: list[Thing] = []
        self.waiting: list[SceneObject] = []
        self.held: Thing | None = None
        self.suction = self.smooth = False

    def build(self, scene: Scene, seed: int) -> None:
        """Start afresh with this scene, the tool parked."""
        p = self.p
        self.table_m, self.per_metre = scene.table_m, scene.units(1.0)
        self.things, self.waiting, self.held, self.suction = [], list(scene.tray), None, False
        p.resetSimulation()
        p.setGravity(0, 0, -9.81 * self.per_metre)
        p.setPhysicsEngineParameter(
            fixedTimeStep=STEP, numSolverIterations=50, deterministicOverlappingPairs=1
        )
        make_ground(p)
        self.tool, self.rail = make_tool(p, PARK)
        self.smooth = False
        self.target = PARK
        rng = random.Random(seed)
        for item in scene.objects:
            self.things.append(make_thing(p, item, *item.position, self.per_metre, rng))
        places = tray_positions(scene)
        for item in scene.tray:
            if item.id in places:
                thing = make_thing(p, item, *places[item.id], self.per_metre, rng)
                self.things.append(thing)
                hang(p, thing)
        self.settle()

    @property
    def holding(self) -> bool:
        """Whether suction holds something."""
        return self.held is not None

    def reseat(self) -> None:
        """Let the tray close up to ``tray_positions`` of the scene as it is now."""
        if not self.waiting:
            return
        places = tray_positions(self.scene())
        for thing in self.things:
            if thing.hook is not None and thing.item.id in places:
                x, y = places[thing.item.id]
                at = (x, y, thing.item.tall / 2 + thing.low)
                self.p.resetBasePositionAndOrientation(thing.body, at, (0, 0, 0, 1))
                self.p.changeConstraint(thing.hook, at, (0, 0, 0, 1))

    # --- motion ---------------------------------------------------------------------------

    def tip(self) -> Pose:
        """The measured pose of the tool's tip."""
        (x, y, z), turn = self.p.getBasePositionAndOrientation(self.tool)
        m = self.p.getMatrixFromQuaternion(turn)
        reach = TOOL_LENGTH / 2
        return Pose(x - m[2] * reach, y - m[5] * reach, z - m[8] * reach, math.atan2(m[3], m[0]))

    def face(self, goal: Pose) -> None:
        """Be smooth, or rub, on the straight way to a pose, by where things are met on it."""
        free = [self.outline(thing) for thing in self.things if thing is not self.held]
        met = [body for body in free if _on_way(self.target, goal, body)]
        low = min(self.target.z, goal.z)
        smooth = bool(met) and all(body.z + LIP * body.tall < low < body.top for body in met)
        if smooth is not self.smooth:
            self.p.changeDynamics(self.tool, -1, lateralFriction=0.0 if smooth else FRICTION)
            self.smooth = smooth

    def aim(self, pose: Pose) -> None:
        """Pull the tool towards a pose, with its limited force."""
        self.target = pose
        self.p.changeConstraint(
            self.rail,
            (pose.x, pose.y, pose.z + TOOL_LENGTH / 2),
            self.p.getQuaternionFromEuler((0, 0, pose.r)),
            maxForce=TOOL_FORCE * self.per_metre,
            erp=0.8,
        )

    def advance(self, poses: Sequence[Pose]) -> bool:
        """One step of the engine for each pose. False if the tool was held up by something."""
        down = poses[-1].z < self.target.z - 1e-6
        met = False
        for pose in poses:
            self.aim(pose)
            self.p.stepSimulation()
            met = down and self.held is None and self._meets()
            if met:
                break
        self._watch()
        tip, aim = self.tip(), self.target
        deep = self._pressed() if down else 0.0
        lag = math.dist((tip.x, tip.y, tip.z), (aim.x, aim.y, aim.z))
        if deep <= PRESS and lag <= STALL and not met:
            return True
        self.aim(Pose(tip.x, tip.y, tip.z + deep, aim.r))
        return False

    def _meets(self) -> bool:
        """Whether the tool presses on what is below with more than it takes to feel it."""
        least = MEET * self.per_metre
        contacts = self.p.getContactPoints(self.tool)
        return any(hit[7][2] > 0.7 and hit[9] > least for hit in contacts)

    def _pressed(self) -> float:
        """How deep the tool, or what it holds, is pressed into what is below (table units)."""
        if self.held is not None:
            return max(0.0, self._anchor()[2] - self.tip().z)
        contacts = self.p.getContactPoints(self.tool)
        return max((-hit[8] for hit in contacts if hit[7][2] > 0.7), default=0.0)

    def _watch(self) -> None:
        """Suction that slipped lets go; what fell below the table lies on the floor."""
        if self.held is not None and self._gap() > SUCTION_SLIP_M * self.per_metre:
            self._drop()
        for thing in self.things:
            if thing is self.held or thing.fallen or thing.hook is not None:
                continue
            (x, y, z), _ = self.p.getBasePositionAndOrientation(thing.body)
            if z < -0.1:
                self._lie_on_floor(thing, x, y)

    def _lie_on_floor(self, thing: Thing, x: float, y: float) -> None:
        half = max(thing.size[0], thing.size[1]) / 2 + 0.05
        if abs(x) >= abs(y):
            x = math.copysign(max(abs(x), EDGE + half), x)
        else:
            y = math.copysign(max(abs(y), EDGE + half), y)
        at = (x, y, FLOOR + thing.item.tall / 2 + thing.low)
        self.p.resetBasePositionAndOrientation(thing.body, at, (0, 0, 0, 1))
        self.p.resetBaseVelocity(thing.body, (0, 0, 0), (0, 0, 0))
        set_group(self.p, thing, GROUND)
        thing.fallen = True

    def settle(self, seconds: float = 1.5) -> None:
        """Step until everything rests (or the time is over)."""
        for _ in range(int(seconds / STEP / TICK)):
            self.advance([self.target] * TICK)
            if all(self._rests(thing) for thing in self.things):
                return

    def _rests(self, thing: Thing) -> bool:
        speed, spin = self.p.getBaseVelocity(thing.body)
        return bool(math.hypot(*speed) < 0.01 and math.hypot(*spin) < 0.05)

    # --- suction --------------------------------------------------------------------------

    def take(self) -> None:
        """Suction on: hold what is level right below the cup."""
        self.suction = True
        thing = self._under_cup()
        if self.held is not None or thing is None:
            return
        if thing.hook is not None:
            self.p.removeConstraint(thing.hook)
            thing.hook = None
            self.waiting = [item for item in self.waiting if item.id != thing.item.id]
            self.things.remove(thing)
            self.things.append(thing)
            set_group(self.p, thing, THING)
        self._attach(thing)

    def _under_cup(self) -> Thing | None:
        """What suction gets hold of: of a surface below and a container's rim, the nearer."""
        below, rim = self._below(), self._rim()
        if below is None or rim is None:
            return (below or rim or (0.0, None))[1]
        return min(below, rim, key=lambda found: found[0])[1]

    def _below(self) -> tuple[float, Thing] | None:
        """The level surface nearest to the tip's height, straight above or below it."""
        tip, reach = self.tip(), SUCTION_REACH_M * self.per_metre
        ends = [[tip.x, tip.y, tip.z + reach]], [[tip.x, tip.y, tip.z - reach]]
        body, _, _, point, normal = self.p.rayTestBatch(*ends, collisionFilterMask=THING | TRAY)[0]
        thing = next((thing for thing in self.things if thing.body == body), None)
        if thing is None or normal[2] <= LEVEL:
            return None
        return abs(point[2] - tip.z), thing

    def _rim(self) -> tuple[float, Thing] | None:
        tip, reach = self.tip(), SUCTION_REACH_M * self.per_metre
        for thing in self.things:
            body = self.outline(thing)
            off = abs(body.top - tip.z)
            if off <= reach and body.hollow and not thing.fallen and body.covers(tip.x, tip.y):
                return off, thing
        return None

    def _attach(self, thing: Thing) -> None:
        p, down = self.p, (0, 0, -TOOL_LENGTH / 2)
        at, turn = p.getBasePositionAndOrientation(self.tool)
        tip = p.multiplyTransforms(at, turn, down, (0, 0, 0, 1))
        inverse = p.invertTransform(*p.getBasePositionAndOrientation(thing.body))
        self.anchor, facing = p.multiplyTransforms(*inverse, *tip)
        self.cup = p.createConstraint(
            self.tool, -1, thing.body, -1, p.JOINT_FIXED, (0, 0, 0), down, self.anchor,
            (0, 0, 0, 1), facing,
        )  # fmt: skip
        p.changeConstraint(self.cup, maxForce=SUCTION_FORCE * self.per_metre)
        p.setCollisionFilterPair(self.tool, thing.body, -1, -1, 0)
        self.held = thing

    def _gap(self) -> float:
        if self.held is None:
            return 0.0
        tip = self.tip()
        return math.dist(self._anchor(), (tip.x, tip.y, tip.z))

    def _anchor(self) -> tuple[float, float, float]:
        """Where the point by which the held thing hangs is now."""
        assert self.held is not None
        pose = self.p.getBasePositionAndOrientation(self.held.body)
        (x, y, z), _ = self.p.multiplyTransforms(*pose, self.anchor, (0, 0, 0, 1))
        return x, y, z

    def let_go(self) -> None:
        """Suction off; what was held falls."""
        self.suction = False
        self._drop()

    def lose(self) -> None:
        """What is held slips off and falls; suction stays on."""
        self._drop()

    def _drop(self) -> None:
        if self.held is not None:
            self.p.removeConstraint(self.cup)
            self.p.setCollisionFilterPair(self.tool, self.held.body, -1, -1, 1)
            self.held = None

    # --- reading --------------------------------------------------------------------------

    def places(self) -> tuple[float, ...]:
        """Where the tool and every thing are, to the last bit: what a picture depends on."""
        bodies = (self.tool, *(thing.body for thing in self.things))
        poses = map(self.p.getBasePositionAndOrientation, bodies)
        return tuple(number for at, turn in poses for number in (*at, *turn))

    def highest(self) -> float:
        """Height of the highest top that the tool could meet (table units)."""
        tops = [self.outline(t).top for t in self.things if not t.fallen and t is not self.held]
        if self.held is not None and tops:
            return max(tops) + self.target.z - self.outline(self.held).z
        return max(tops, default=0.0)

    def outline(self, thing: Thing) -> Body:
        """Where the thing is now, as a footprint with heights."""
        at, turn = self.p.getBasePositionAndOrientation(thing.body)
        m = self.p.getMatrixFromQuaternion(turn)
        x, y, z = (at[row] - m[3 * row + 2] * thing.low for row in range(3))
        width, height, tall, r, upright = oriented(thing.size, m)
        base = base_height(thing.size, z, m)
        return Body(self._changed(thing, x, y, base, (width, height, tall, r), upright), x, y)

    def _changed(
        self,
        thing: Thing,
        x: float,
        y: float,
        z: float,
        shape: tuple[float, float, float, float],
        upright: bool,
    ) -> SceneObject:
        item = thing.item
        width, height, tall, r = shape
        return SceneObject(
            id=item.id, name=item.name, color=item.color, x=x, y=y, z=z, r=r,
            width=width, height=height, tall=tall, upright=upright and item.upright,
        )  # fmt: skip

    def scene(self) -> Scene:
        """The world as a Scene: what stands where is read off the geometry."""
        bodies = {t.item.id: self.outline(t) for t in self.things if t.hook is None}
        standing = [
            bodies[t.item.id]
            for t in self.things
            if t.hook is None and not t.fallen and t is not self.held
        ]
        found = [self._read(t, bodies[t.item.id], standing) for t in self.things if t.hook is None]
        return Scene(objects=tuple(found), tray=tuple(self.waiting), table_m=self.table_m)

    def _read(self, thing: Thing, body: Body, standing: Sequence[Body]) -> SceneObject:
        held = thing is self.held
        on = "gripper" if held else "floor" if thing.fallen else support_of(body, standing)
        z = 0.0 if thing.fallen else max(0.0, body.z)
        item = self._changed(
            thing, body.x, body.y, z, (body.width, body.height, body.tall, body.r), body.upright
        )
        return msgspec.structs.replace(item, on=on, held=held)


def _on_way(start: Pose, goal: Pose, body: Body) -> bool:
    """Whether the tool, going straight there, would meet the thing where it stands."""
    half_x, half_y = body.half(1.0, 0.0), body.half(0.0, 1.0)
    box = KeepOut(
        body.id, (body.x - half_x, body.x + half_x), (body.y - half_y, body.y + half_y),
        (body.z, body.top),
    )  # fmt: skip
    return crosses(start, goal, box, TOOL_RADIUS)

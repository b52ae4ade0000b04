"""Figures of the simulated arm: how exact, how fast, and whether anything forbidden gets through.

Commands are drawn at random, most of them where no arm may go, and tried through every public way
to a driver: a plan of its own, a plan approved for wider limits, a client on the bus, a request
forged to the bridge. What reaches the drivers is recorded, pose by pose.
"""

from __future__ import annotations

import math
import random
import statistics
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager

from agent.arm import BoxWorkspace, BusArm
from agent.bus import MemoryBus
from agent.client import Client
from agent.errors import BusError, RobotError, SceneError
from agent.messages import Command, RobotCommand, RobotReply
from evals.figures import Figure, at_least, at_most
from robot_bridge.api import TRAVEL_SPEED, ApprovedPlan, Limits, Simulated, approve
from robot_bridge.bullet import BulletRobot
from robot_bridge.furniture import TOOL_LENGTH, Physics
from robot_bridge.ideal import IdealRobot
from robot_bridge.physics import STEP, World
from robot_bridge.service import RobotService
from scene.generate import CLASSES, random_scene
from scene.types import Pose, Scene, SceneObject

PLACED, WITHIN_MM = 1_000, 2.0
COMMANDS = 100_000
REAL_TIME = 8.0
"""Simulated seconds a second to reach."""
SLACK = 1e-6
WIDE = BoxWorkspace(
    Limits(x=(-1e9, 1e9), y=(-1e9, 1e9), z=(-1e9, 1e9), r=(-1e9, 1e9), speed=1e9, length=1e12)
)


def robot_figures(placed: int = PLACED, commands: int = COMMANDS) -> dict[str, Figure]:
    """Every figure, measured now."""
    return {
        **_pick_and_place(placed),
        **_faster_than_real_time(),
        "forbidden_commands_that_reach_a_driver": _forbidden(commands),
    }


# --- exact ------------------------------------------------------------------------------------


def _pick_and_place(count: int) -> dict[str, Figure]:
    """Things of every class, from one random place to another."""
    robot, errors = BulletRobot(), list[float]()
    try:
        for number in range(count):
            errors.append(_placed(robot, number))
    finally:
        robot.close()
    share = sum(error <= WITHIN_MM for error in errors) / count
    stderr = 100 * math.sqrt(share * (1 - share) / count)
    return {
        "pick_and_place_within_2_mm": Figure(
            value=100 * share, unit="%", n=count, stderr=stderr, goal=">= 99", met=share >= 0.99
        ),
        "pick_and_place_median": at_most(statistics.median(errors), 0.5, "mm", count),
    }


def _placed(robot: BulletRobot, number: int) -> float:
    """How far from its goal a thing came to stand (millimetres; infinite if it does not)."""
    chance = random.Random(f"placed {number}")
    name = sorted(CLASSES)[number % len(CLASSES)]
    robot.load(random_scene(chance, [name], span=0.6))
    scene = robot.scene()
    item, goal = scene.objects[0], (chance.uniform(-0.6, 0.6), chance.uniform(-0.6, 0.6))
    list(robot.run(approve(_carried(item, goal), robot.pose(), robot)))
    now = robot.scene().get(item.id)
    if now.on != "table" or not now.upright:
        return math.inf
    return 500 * scene.table_m * math.dist(now.position, goal)


def _carried(item: SceneObject, goal: tuple[float, float]) -> list[Command]:
    def move(at: tuple[float, float], z: float) -> Command:
        return Command("move", *at, z, 0.0, False)

    def grip(on: bool) -> Command:
        return Command("grip", 0.0, 0.0, 0.0, 0.0, on)

    there = [move(item.position, 1.2), move(item.position, item.top), grip(True)]
    back = [move(item.position, 1.2), move(goal, 1.2), move(goal, item.tall), grip(False)]
    return [*there, *back, move(goal, 1.2)]


def _faster_than_real_time(runs: int = 9, steps: int = 1200) -> dict[str, Figure]:
    """Simulated seconds a second, with eight things that the tool moves among; and a second of this
    process's own time, which other work on the machine does not change."""
    names = ("apple", "banana", "cup", "bottle", "plate", "box", "can", "block")
    robot = BulletRobot(random_scene(random.Random(8), names, room=0.05))
    rates, own = list[float](), list[float]()
    goal = Pose(0.5, 0.5, 1.2, 0.0)
    for _ in range(runs):
        began, busy = time.perf_counter(), time.process_time()
        robot._world.advance([goal] * steps)
        rates.append(steps * STEP / (time.perf_counter() - began))
        own.append(steps * STEP / (time.process_time() - busy))
    robot.close()
    return {
        "physics_times_real_time": at_least(statistics.median(rates), REAL_TIME, "x", runs),
        "physics_times_own_time": at_least(statistics.median(own), REAL_TIME, "x", runs),
    }


# --- nothing forbidden ------------------------------------------------------------------------


class Reached:
    """What came to the drivers: poses, and of those the forbidden ones."""

    def __init__(self) -> None:
        self.poses = self.forbidden = 0

    def went(self, start: Pose, goal: Pose, limits: Limits, seconds: float) -> None:
        """A driver is told to go there, in so many seconds (infinite: at no speed)."""
        self.poses += 1
        inside = all(
            low - SLACK <= value <= high + SLACK
            for value, (low, high) in (
                (goal.x, limits.x), (goal.y, limits.y), (goal.z, limits.z),
                (math.remainder(goal.r, math.tau), limits.r),
            )
        )  # fmt: skip
        way = math.dist((start.x, start.y, start.z), (goal.x, goal.y, goal.z))
        self.forbidden += not (inside and way / seconds <= TRAVEL_SPEED + SLACK)


class WatchedIdeal(IdealRobot):
    """The ideal arm, recorded where its table is moved."""

    def __init__(self, reached: Reached) -> None:
        super().__init__(Scene())
        self._reached = reached

    def _move(self, goal: Pose) -> None:
        self._reached.went(goal, goal, Limits(), 1.0)
        super()._move(goal)


class WatchedWorld(World):
    """A world whose steps are recorded; its tool follows at once, without the engine's time."""

    def __init__(self, p: Physics, reached: Reached) -> None:
        super().__init__(p)
        self._reached = reached

    def advance(self, poses: Sequence[Pose]) -> bool:
        """Each pose recorded; the tool at the last of them."""
        for pose in poses:
            self._reached.went(self.target, pose, Limits(), STEP)
            self.target = pose
        x, y, z = self.target.x, self.target.y, self.target.z
        turn = self.p.getQuaternionFromEuler((0, 0, self.target.r))
        at = (x, y, z + TOOL_LENGTH / 2)
        self.p.resetBasePositionAndOrientation(self.tool, at, turn)
        return True


class WatchedBullet(BulletRobot):
    """The arm with physics, recorded at each step of its tool."""

    def __init__(self, reached: Reached) -> None:
        self._reached = reached
        super().__init__(Scene())

    def _made(self, client: Physics) -> World:
        return WatchedWorld(client, self._reached)


def _forbidden(count: int) -> Figure:
    reached, chance, tried = Reached(), random.Random("forbidden"), 0
    with _entries(reached) as entries:
        while tried < count:
            commands = [_drawn(chance) for _ in range(chance.randint(1, 3))]
            tried += len(commands)
            chance.choice(entries)(commands)
    if not reached.poses:
        return Figure(value=None, unit="", n=tried, why="nothing at all reached a driver")
    return at_most(reached.forbidden, 0, "", tried)


def _drawn(chance: random.Random) -> Command:
    """A command: a third of the numbers inside, the others on the edge, far out, or no number."""

    def number(reach: float) -> float:
        return chance.choice((
            chance.uniform(-reach, reach), chance.uniform(0, 0.9 * reach), chance.uniform(0, 0.5),
            math.nextafter(reach, 9), reach + 1e-5, chance.uniform(-50, 50), -1e-5,
            chance.choice((math.nan, math.inf, -math.inf, 1e308)),
        ))  # fmt: skip

    if chance.random() < 0.15:
        return Command("grip", number(1), number(1), number(1), 0.0, chance.random() < 0.5)
    tame = chance.random() < 0.3
    x, y, z = (chance.uniform(0.01, 1.4) if tame else number(1.7) for _ in range(3))
    return Command("move", x, y, z, chance.uniform(-3, 3) if tame else number(3.2), False)


@contextmanager
def _entries(reached: Reached) -> Iterator[list[Callable[[Sequence[Command]], None]]]:
    """The public ways to the two drivers, each a function of commands; what they raise is right."""
    with ExitStack() as stack:
        ways: list[Callable[[Sequence[Command]], None]] = []
        for robot in (WatchedIdeal(reached), WatchedBullet(reached)):
            stack.callback(robot.close)
            bus = MemoryBus()
            stack.callback(bus.close)
            service = RobotService(bus, robot)
            service.start()
            stack.callback(service.close)
            client = Client(bus.sibling(), "fuzz")
            stack.callback(client.close)
            client.acquire()
            ways += _ways(robot, bus)
        yield ways


def _ways(robot: Simulated, bus: MemoryBus) -> list[Callable[[Sequence[Command]], None]]:
    arm, forger = BusArm(bus, "fuzz"), Forger(bus)

    def planned(commands: Sequence[Command]) -> None:
        list(robot.run(approve(commands, robot.pose(), robot)))

    def widely(commands: Sequence[Command]) -> None:
        list(robot.run(approve(commands, robot.pose(), WIDE)))

    def unapproved(commands: Sequence[Command]) -> None:
        list(robot.run(commands))  # type: ignore[arg-type]

    def as_client(commands: Sequence[Command]) -> None:
        list(arm.run(approve(commands, arm.start(), arm.workspace)))

    def wide_client(commands: Sequence[Command]) -> None:
        list(arm.run(approve(commands, arm.start(), WIDE)))

    def forged(commands: Sequence[Command]) -> None:
        forger.send(commands, approve(commands, arm.start(), WIDE))

    return [_refusing(way) for way in (planned, widely, unapproved, as_client, wide_client, forged)]


class Forger:
    """Somebody with a copy of the owner's name and epoch who writes requests by hand."""

    def __init__(self, bus: MemoryBus) -> None:
        self._bus, self._seq = bus, 0

    def send(self, commands: Sequence[Command], plan: ApprovedPlan) -> None:
        """The commands as they are, under the digest of a plan for wider limits."""
        self._seq += 1
        request = RobotCommand(
            "fuzz", "forger", 1, self._seq, time.time() + 5, tuple(commands), digest=plan.digest
        )
        self._bus.ask(self._bus.keys.command("r1", "run"), request, RobotReply)


def _refusing(
    way: Callable[[Sequence[Command]], None],
) -> Callable[[Sequence[Command]], None]:
    def tried(commands: Sequence[Command]) -> None:
        try:
            way(commands)
        except (RobotError, BusError, SceneError, TypeError, ValueError):
            return  # refused, as it should be: what counts is what reached the driver

    return tried

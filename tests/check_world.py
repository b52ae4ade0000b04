"""The check of programs on a table in twenty lines: what motions come to on it."""

import math

import msgspec

from agent.check import check
from robot_bridge.api import Limits
from scene.types import Pose, Scene, SceneObject

START = Pose(0.0, -1.2, 0.9)


def thing(name, x=None, y=None, size=0.12, tall=0.1, **more):
    return SceneObject(
        id=f"{name}_1", name=name, x=x, y=y, width=size, height=size, tall=tall,
        on=more.pop("on", "tray" if x is None else "table"), **more,
    )  # fmt: skip


class Reach:
    """A workspace: the default box, and a radius from the base behind the near edge."""

    def __init__(self, radius=9.0, simulated=True, **limits):
        self.radius = radius
        self.limits = Limits(simulated=simulated, **limits)

    def reach(self, pose):
        return None if math.hypot(pose.x, pose.y + 2) <= self.radius else "too far from the base"


def predict(commands, scene, tip=START):
    """A table in twenty lines: a low tip pushes what it meets along x; the gripper carries."""
    held = None
    for command in commands:
        if command.op == "move":
            moved = [_follow(item, tip, command, item.id == held) for item in scene.objects]
            scene = msgspec.structs.replace(scene, objects=tuple(moved))
            tip = Pose(command.x, command.y, command.z)
        elif command.grip:
            scene, held = _pick(scene, tip)
        elif held is not None:
            scene, held = scene.replace(_settle(scene, scene.get(held))), None
    return scene


def _follow(item, tip, to, held):
    if held:
        return msgspec.structs.replace(item, x=to.x, y=to.y, z=to.z - item.tall)
    low = to.z < item.top - 0.01 and tip.z < item.top - 0.01
    meets = abs(to.y - item.y) < item.height / 2 and tip.x < item.x < to.x + item.width / 2
    if not (low and meets and item.on == "table"):
        return item
    if to.z > item.z + 2 * item.width:
        return msgspec.structs.replace(item, upright=False)
    x = to.x + item.width / 2
    return msgspec.structs.replace(item, x=x, on="floor" if x > 1 else "table")


def _pick(scene, tip):
    for item in scene:
        x, y = (1.12, -1.54) if item.x is None else item.position
        if math.dist((x, y, item.top), (tip.x, tip.y, tip.z)) < 0.03:
            taken = msgspec.structs.replace(item, x=x, y=y, on="gripper", held=True)
            others = tuple(o for o in scene.objects if o.id != item.id)
            tray = tuple(o for o in scene.tray if o.id != item.id)
            return Scene(objects=(*others, taken), tray=tray), item.id
    return scene, None


def _settle(scene, item):
    below = [
        o for o in scene.objects
        if o.id != item.id and max(abs(o.x - item.x), abs(o.y - item.y)) <= o.width / 2
    ]  # fmt: skip
    carrier = max(below, key=lambda o: o.top, default=None)
    if carrier is not None:
        return msgspec.structs.replace(item, z=carrier.top, on=carrier.id, held=False)
    on = "table" if max(abs(item.x), abs(item.y)) <= 1 else "floor"
    return msgspec.structs.replace(item, z=0.0, on=on, held=False)


SCENE = Scene(
    objects=(
        thing("apple", -0.4, 0.2),
        thing("orange", 0.3, 0.2),
        thing("bottle", 0.5, -0.4, tall=0.3),
        thing("plate", 0.0, -0.6, size=0.4, tall=0.03),
        thing("cherry", 0.1, -0.6, size=0.04, tall=0.04, z=0.03, on="plate_1"),
    ),
)


def checks(executor, predict=predict):
    """The check of a program, where motions come to what ``predict`` says.

    ``reach`` is what `Reach` takes."""

    def checked(program, scene=SCENE, kind="manipulate", touched=None, **reach):
        return check(
            program, kind, scene, executor=executor, predict=predict, workspace=Reach(**reach),
            start=START, touched=touched,
        )  # fmt: skip

    return checked


def pick_and_place(item, x, y, z):
    return f"""\
robot.move({item}.x, {item}.y, 0.9, 0)
robot.move({item}.x, {item}.y, {item}.z + {item}.tall, 0)
robot.grip(True)
robot.move({item}.x, {item}.y, 0.9, 0)
robot.move({x}, {y}, 0.9, 0)
robot.move({x}, {y}, {z}, 0)
robot.grip(False)
robot.move({x}, {y}, 0.9, 0)"""


PUSH_OFF = """\
robot.move(orange.x - 0.2, orange.y, 0.3, 0)
robot.move(orange.x - 0.2, orange.y, 0.04, 0)
robot.move(1.1, orange.y, 0.04, 0)"""


def only(result):
    (problem,) = result.problems
    assert not result.ok
    return problem

"""A bridge over the ideal table on a bus in this process, and people who speak to it."""

from __future__ import annotations

import queue
import threading
import time

from agent.arm import BusArm
from agent.bus import MemoryBus
from agent.client import Client
from agent.errors import RobotError, Stopped
from agent.messages import Command, RobotCommand, RobotEvent, RobotReply
from robot_bridge.api import approve
from robot_bridge.ideal import IdealRobot
from robot_bridge.service import RobotService
from scene.types import Scene, SceneObject

PATIENCE = 10.0
APPLE = SceneObject(id="a1", name="apple", x=0.2, y=0.0, width=0.1, height=0.1, tall=0.1)
PICK = (
    Command("move", 0.2, 0.0, 0.9, 0, False, 1),
    Command("move", 0.2, 0.0, 0.1, 0, False, 2),
    Command("grip", 0, 0, 0, 0, True, 3),
    Command("move", 0.2, 0.0, 0.9, 0, True, 4),
)
BACK_AND_FORTH = tuple(
    Command("move", x, 0.5, 0.9, 0, False, i) for i, x in enumerate((-1.0, 1.0) * 50)
)


class ByHand(IdealRobot):
    """An arm whose every motion waits until the test lets one go: ``motions.release()``."""

    def __init__(self):
        super().__init__(Scene(objects=(APPLE,)))
        self.motions, self.begun = threading.Semaphore(0), threading.Semaphore(0)

    def _move(self, goal):
        self.begun.release()
        while not self.motions.acquire(timeout=0.01):
            if self._halt.is_set():
                raise Stopped("stop")
        super()._move(goal)


def bridge(stack, pace=0.0, robot=None):
    """A bridge over the ideal robot, or another, on a bus in this process; the bus."""
    bus = MemoryBus()
    stack.callback(bus.close)
    robot = robot or IdealRobot(Scene(objects=(APPLE,)), pace=pace)
    stack.callback(robot.close)
    service = RobotService(bus, robot)
    service.start()
    stack.callback(service.close)
    return bus


def client(stack, bus, name="ann"):
    link = bus.sibling()
    stack.callback(link.close)
    made = Client(link, name)
    stack.callback(made.close)
    return made


class Sender:
    """Somebody who sends commands by hand, approved ones to run, and sees the steps."""

    def __init__(self, stack, bus, name="ann", session="s1"):
        self.bus, self.name, self.session = bus, name, session
        self.seq = self.epoch = 0
        self.events = queue.Queue()
        stack.enter_context(
            bus.subscribe(bus.keys.steps("r1"), lambda key, event: self.events.put(event))
        )

    def token(self):
        return self.bus.token(self.bus.keys.lease("r1", self.name))

    def send(self, verb, plan=(), **changes):
        self.seq += 1
        arm = BusArm(self.bus, self.name)
        digest = approve(plan, arm.start(), arm.workspace).digest if plan else ""
        fields = {
            "client": self.name,
            "session": self.session,
            "epoch": self.epoch,
            "seq": self.seq,
            "deadline": time.time() + 5,
            "commands": tuple(plan),
            "digest": digest,
        } | changes
        key = self.bus.keys.command("r1", verb)
        return self.bus.ask(key, RobotCommand(**fields), RobotReply, timeout=PATIENCE)

    def own(self):
        token = self.token()
        self.epoch = self.send("acquire").epoch
        return token

    def run_to_end(self, commands):
        reply = self.send("run", commands)
        assert reply.ok, reply
        return self.until_end()

    def until_end(self):
        steps = []
        while True:
            event = self.events.get(timeout=PATIENCE)
            assert isinstance(event, RobotEvent)
            if event.ended:
                return steps, event
            steps.append(event.step)


class Run:
    """A plan that runs for a client who holds the arm, followed on a thread of its own."""

    def __init__(self, bus, commands, *, hold=False, arm=None):
        self.arm = arm or BusArm(bus, "ann")
        self.steps = queue.Queue()
        self._result = queue.Queue()
        plan = approve(commands, self.arm.start(), self.arm.workspace)
        threading.Thread(target=self._follow, args=(plan, hold), daemon=True).start()

    def _follow(self, plan, hold):
        try:
            for step in self.arm.run(plan, hold=hold):
                self.steps.put(step)
        except RobotError as error:
            self._result.put(error)
        else:
            self._result.put(None)

    def ended(self, patience=PATIENCE):
        """None once it came to its end, else the error that ended it."""
        return self._result.get(timeout=patience)

    def lines(self, count):
        """The lines of the next ``count`` steps, which may still be on their way."""
        return [self.steps.get(timeout=PATIENCE).line for _ in range(count)]


def wait_state(bus, wanted):
    """The first state for which ``wanted`` holds."""
    found = queue.Queue()
    with bus.subscribe(bus.keys.state("r1"), lambda key, state: found.put(state)):
        states = (found.get(timeout=PATIENCE) for _ in range(200))
        return next(state for state in states if wanted(state))

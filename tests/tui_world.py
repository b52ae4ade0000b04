"""A small honest world for the terminal's tests: agent, robot bridge and scene on a real bus.

The agent understands five sentences (see `Agent.act`), asks which cup is meant, and waits at a
gate on "wait"; the bridge holds a latch. Nothing is patched: the TUI talks to it over the bus.
"""

from __future__ import annotations

import queue
import threading
import time

import msgspec

from agent.bus import MemoryBus, MemoryHub
from agent.client import Client
from agent.messages import (
    LEAVE,
    Ack,
    Event,
    Option,
    Question,
    RobotCommand,
    RobotLimits,
    RobotReply,
    RobotState,
    SceneSnapshot,
    StepReport,
    StopRequest,
    Submit,
    Turn,
    Waypoint,
)
from agent.wire import ANY
from scene.types import Scene, SceneObject

PROGRAM = """robot.move(-0.8, 0.2, 0.9, 0)
robot.move(-0.8, 0.2, 0.04, 0)
robot.move(-1.2, 0.2, 0.04, 0)
robot.move(-1.2, 0.2, 0.9, 0)"""
PLAN = tuple(
    Waypoint(x, 0.2, z, 0.0, False)
    for x, z in ((-0.3, 0.9), (-0.3, 0.04), (-1.1, 0.04), (-1.1, 0.9))
)
LIMITS = RobotLimits(
    (-1.7, 1.7), (-1.7, 1.7), (0.0, 1.5), (-3.2, 3.2),
    speed=1.0, commands=500, length=200.0, acceleration=4.0, turn_speed=3.0, simulated=True,
)  # fmt: skip
PARKED = Waypoint(0.0, -1.2, 0.9, 0.0, False)
AGAIN = Question("confirm", "Shall I try again?", (Option("try again"), Option(LEAVE)))
WHICH = Question(
    "which",
    "Which cup?",
    (
        Option("the left cup", ("cup_1",)),
        Option("the [red] one", ("cup_2",)),
    ),
)


def thing(ident: str, x: float, y: float, size: float = 0.3, **fields: object) -> SceneObject:
    """A square object, named by its id without the number."""
    name = ident.rsplit("_", 1)[0].replace("_", " ")
    made = SceneObject(id=ident, name=name, x=x, y=y, width=size, height=size, tall=0.1)
    return msgspec.structs.replace(made, **fields)


SCENE = Scene(
    objects=(
        thing("apple_1", -0.5, 0.2, color="red"),
        thing("cup_1", 0.2, -0.5, color="blue"),
        thing("cup_2", 0.7, -0.5, color="red"),
        thing("plate_1", 0.3, 0.5, 0.6, color="white"),
    ),
    tray=(SceneObject(id="orange_1", name="orange", width=0.2, height=0.2, tall=0.2, on="tray"),),
)


class Bridge:
    """A robot bridge with a latch; ``stops`` are the STOPs it saw."""

    def __init__(self, hub: MemoryHub) -> None:
        self.bus = MemoryBus(hub=hub)
        self.stops: list[StopRequest] = []
        self.safety = "normal"
        self.owner: str | None = None
        self.pose = PARKED
        self.line = 0
        self.limits = LIMITS
        self._seq = 0

    def start(self) -> None:
        keys = self.bus.keys
        self.bus.serve(keys.stop("r1"), self._stop, wildcard=True)
        self.bus.serve(keys.command("r1", ANY), self._verb)
        self.bus.serve(keys.limits("r1"), lambda key, request: self.limits)
        self.publish()
        self.token = self.bus.token(keys.alive("robot", "r1"))

    def publish(self) -> None:
        self._seq += 1
        program = "running" if self.line else "idle"
        state = RobotState(
            self._seq, time.time(), "fake", self.safety, program, self.pose, self.owner,
            line=self.line,
        )  # fmt: skip
        self.bus.publish(self.bus.keys.state("r1"), state)

    def _stop(self, key: str, request: object) -> RobotReply:
        assert isinstance(request, StopRequest)
        self.stops.append(request)
        self.safety = "stopped"
        self.publish()
        return RobotReply(True)

    def _verb(self, key: str, request: object) -> RobotReply:
        assert isinstance(request, RobotCommand)
        verb = key.rsplit("/", 1)[1]
        if verb == "acquire":
            self.owner = request.client
        elif verb == "release":
            self.owner = None
        elif verb == "resume":
            self.safety = "normal"
        if verb != "keepalive":
            self.publish()
        return RobotReply(True, 1)


class Agent:
    """Answers submits on a thread of its own; ``gate`` holds "wait" and each step of "push"."""

    def __init__(self, hub: MemoryHub, bridge: Bridge) -> None:
        self.bus = MemoryBus(hub=hub)
        self.heard: list[str] = []
        self.gate = threading.Event()
        self.gate.set()
        self.steps = threading.Semaphore(0)
        self.pace_by_hand = False
        self._bridge = bridge
        self._inbox: queue.SimpleQueue[tuple[str, Submit] | None] = queue.SimpleQueue()
        self._scene = SCENE
        self._seq = 0

    def start(self) -> None:
        keys = self.bus.keys
        self.bus.serve(keys.submit(ANY), self._submit)
        self.look()
        self.bus.token(keys.alive("scene", "main"))
        self.token = self.bus.token(keys.alive("agent", "main"))
        threading.Thread(target=self._work, daemon=True).start()

    def look(self, scene: Scene | None = None) -> None:
        self._scene = scene or self._scene
        self._seq += 1
        snapshot = SceneSnapshot(self._seq, time.time(), self._scene)
        self.bus.publish(self.bus.keys.objects("main"), snapshot)

    def close(self) -> None:
        self.gate.set()
        for _ in range(100):
            self.steps.release()
        self._inbox.put(None)
        self.bus.close()

    def _submit(self, key: str, request: object) -> Ack:
        assert isinstance(request, Submit)
        self._inbox.put((key.split("/")[-2], request))
        return Ack(request.request_id)

    def _work(self) -> None:
        while (item := self._inbox.get()) is not None:
            client, submit = item
            self.heard.append(submit.text)
            for count, fields in enumerate(self.act(submit)):
                event = Event(submit.request_id, count, **fields)
                self.bus.publish(self.bus.keys.event(client), event)

    def act(self, submit: Submit):
        """push: runs four steps; cup: asks; lift: fails and asks; wait: hangs; else: echoes."""
        text = submit.text
        yield {"stage": "heard"}
        if text == "wait":
            self.gate.wait(30)
        if text.startswith("push"):
            yield from self._push(text)
        elif text == "take the cup":
            yield self._turn(text, "asked", WHICH.text, question=WHICH)
        elif text == "where to":
            question = Question("open", "Where shall it go?")
            yield self._turn(text, "asked", question.text, question=question)
        elif text == "lift it":
            reply = f"I could not keep hold of the cup. {AGAIN.text}"
            yield self._turn(text, "failed", reply, question=AGAIN)
        elif text == "smash it":
            yield self._turn(
                text, "refused", "I won't.", program="robot.throw(1)", reason="bad_program"
            )
        else:
            yield self._turn(text, "answered", f"You said: {text}")

    def _push(self, text: str):
        yield {"stage": "program", "program": PROGRAM, "kind": "manipulate", "plan": PLAN}
        for index, told in enumerate(PLAN):
            self._bridge.line = index + 1
            self._bridge.publish()
            if self.pace_by_hand:
                self.steps.acquire(timeout=30)
            self._bridge.pose = told
            self._bridge.publish()
            yield {"stage": "step", "step": StepReport(index, len(PLAN), index + 1, told, told)}
        if self.pace_by_hand:
            self.steps.acquire(timeout=30)
        self._bridge.line = 0
        self._bridge.publish()
        fallen = msgspec.structs.replace(self._scene.get("apple_1"), x=-1.15, on="floor")
        self.look(self._scene.replace(fallen))
        yield self._turn(
            text, "done", "I pushed the apple off the left edge.",
            program=PROGRAM, kind="manipulate", trajectory=PLAN,
        )  # fmt: skip

    @staticmethod
    def _turn(text: str, status: str, reply: str, **fields: object) -> dict[str, object]:
        return {"stage": "turn", "turn": Turn(say=text, status=status, reply=reply, **fields)}


class World:
    """All of it, and a client: ``with World() as world: ArmchatApp(world.client)``."""

    def __init__(self) -> None:
        hub = MemoryHub()
        self.bridge = Bridge(hub)
        self.agent = Agent(hub, self.bridge)
        self.bus = MemoryBus(hub=hub)
        self.client = Client(self.bus, "me")

    def __enter__(self) -> World:
        self.bridge.start()
        self.agent.start()
        return self

    def __exit__(self, *error: object) -> None:
        self.agent.close()
        self.client.close()
        self.bridge.bus.close()
        self.bus.close()

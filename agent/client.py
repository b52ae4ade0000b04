"""A client of armchat: what the TUI, the command line and remote programs do over a bus.

Saying needs no lease (without one a sentence is answered, asked about or previewed, never run).
STOP goes its own way: own link, no lease, no model, repeated until the bridge acknowledges it.
"""

from __future__ import annotations

import queue
import threading
import time
import uuid
from collections.abc import Callable, Iterator
from typing import TypeVar

from agent.bus import Bus, Closing, wait_for
from agent.errors import Declined, NoAnswer, NoService
from agent.messages import (
    Ack,
    Event,
    Kind,
    RobotCommand,
    RobotLimits,
    RobotReply,
    RobotState,
    SceneSnapshot,
    StopRequest,
    Submit,
)
from agent.stopping import ask_to_stop
from agent.wire import ANY, Message
from scene.types import Scene

M = TypeVar("M")

KEEPALIVE = 0.25
"""Seconds between two keepalives; the bridge gives up a silent owner after 1 s."""
COMMAND_DEADLINE = 5.0
LOOK = 15.0
"""Seconds that an eye may take to look: it waits for fresh pictures."""
TURN_TIMEOUT = 120.0

_LEASE_VERBS = frozenset({"acquire", "keepalive", "release"})
_STOP_WORDS = frozenset(
    {"stop", "stop now", "stop it", "stop that", "please stop", "stop please", "halt", "freeze"}
    | {"stop the robot", "stop the arm", "stop moving", "stop everything", "abort", "emergency"}
    | {"emergency stop", "stop right now", "stop immediately", "stop stop", "stop stop stop"}
)


def is_stop(text: str) -> bool:
    """Whether a sentence is a plain STOP, told by its words alone (no model, no scene)."""
    words = "".join(letter if letter.isalpha() else " " for letter in text.lower()).split()
    return " ".join(words) in _STOP_WORDS


class Client:
    """One person's or program's view of the services; ``name`` is its id in keys.

    All times are seconds. Callbacks run on a thread of the subscription and must not block long.
    """

    def __init__(self, bus: Bus, name: str, robot: str = "r1", scene: str = "main") -> None:
        self.name = name
        self.session = uuid.uuid4().hex[:12]
        self._bus = bus
        self._robot = robot
        self._scene = scene
        self._lock = threading.RLock()
        self._stop_bus: Bus | None = None
        self._lease: Closing | None = None
        self._epoch = 0
        self._seq = 0
        self._released = threading.Event()
        self._beat: threading.Thread | None = None
        self._subscriptions: list[Closing] = []

    # --- sentences ----------------------------------------------------------------------------

    def say(
        self,
        text: str,
        task: Kind | None = None,
        dry_run: bool = False,
        timeout: float = TURN_TIMEOUT,
        *,
        hold: bool = False,
    ) -> Iterator[Event]:
        """Say a sentence (or the answer to a question); yields its events to the one with a turn.

        Takes the lease first if it is free and something may move. ``hold``: its program waits
        before the first line for `step`, `resume` or `cancel`. Raises NoService when there is no
        agent or it is gone before the end, NoAnswer after ``timeout`` (the time in which the
        program is paused does not count), Declined.
        """
        if is_stop(text):
            self.stop()
        elif not dry_run:
            self._acquire_if_free()
        return self._submit(Submit(uuid.uuid4().hex, text, task, dry_run, hold=hold), timeout)

    def run_program(
        self,
        source: str,
        kind: Kind,
        dry_run: bool = False,
        timeout: float = TURN_TIMEOUT,
        *,
        hold: bool = False,
    ) -> Iterator[Event]:
        """Run a program body through the agent's check; events as for `say`."""
        if not dry_run:
            self._acquire_if_free()
        return self._submit(Submit(uuid.uuid4().hex, "", kind, dry_run, source, hold), timeout)

    def _submit(self, submit: Submit, timeout: float) -> Iterator[Event]:
        inbox: _Inbox = queue.SimpleQueue()
        pauses = Pauses(self.name, inbox.put)

        def heard(key: str, message: Message) -> None:
            if isinstance(message, Event) and message.request_id == submit.request_id:
                inbox.put(message)

        def gone(key: str, alive: bool) -> None:
            if not alive:
                inbox.put(None)

        key = self._bus.keys.submit(self.name)
        opened = [self._bus.subscribe(self._bus.keys.event(self.name), heard)]
        try:
            opened.append(self._bus.watch(self._bus.keys.alive("agent", ANY), gone))
            opened.append(self._bus.subscribe(self._bus.keys.state(self._robot), pauses.heard))
            self._ask_twice(key, submit)
        except BaseException:
            _close_all(opened)
            raise
        return _follow(inbox, opened, timeout)

    def _ask_twice(self, key: str, submit: Submit) -> None:
        # The request_id makes the second ask harmless.
        try:
            self._bus.ask(key, submit, Ack, timeout=2.0)
        except NoAnswer:
            self._bus.ask(key, submit, Ack, timeout=5.0)

    # --- the lease and the robot ----------------------------------------------------------------

    @property
    def holds_lease(self) -> bool:
        """Whether this client owns the robot, as far as it knows."""
        return self._lease is not None

    def acquire(self) -> None:
        """Take the robot and keep it with keepalives. Raises Declined("busy"), NoService."""
        with self._lock:
            if self._lease is not None:
                return
            self._own_link()  # before anything moves: a STOP must not wait for a connection
            token = self._bus.token(self._bus.keys.lease(self._robot, self.name))
            try:
                reply = self._command("acquire")
            except BaseException:
                token.close()
                raise
            self._lease, self._epoch = token, reply.epoch
            self._released = threading.Event()
            self._beat = threading.Thread(
                target=self._keep, args=(self._released,), name="keepalive", daemon=True
            )
            self._beat.start()

    def _acquire_if_free(self) -> None:
        try:
            self.acquire()
        except (Declined, NoService, NoAnswer):
            return  # without the lease the agent answers, asks or previews, and says so

    def _keep(self, released: threading.Event) -> None:
        while not released.wait(KEEPALIVE):
            try:
                self._command("keepalive", timeout=1.0)
            except Declined:
                self._drop_lease()
                return
            except (NoService, NoAnswer):
                continue

    def _drop_lease(self) -> None:
        with self._lock:
            lease, self._lease = self._lease, None
            self._released.set()
        if lease is not None:
            lease.close()

    def release(self) -> None:
        """Give the robot back; harmless without the lease."""
        with self._lock:
            held = self._lease is not None
            self._released.set()
        beat, self._beat = self._beat, None
        if beat is not None and beat is not threading.current_thread():
            beat.join(timeout=2.0)
        try:
            if held:
                self._command("release", timeout=1.0)
        except (Declined, NoService, NoAnswer):
            pass  # the token below says the same
        finally:
            self._drop_lease()

    def stop(self, now: bool = False, timeout: float = 5.0) -> RobotReply:
        """STOP: no lease, no model, own link; repeated until acknowledged. ``now``: force-stop.

        Raises NoService or NoAnswer when no bridge acknowledged it within ``timeout``: then the
        motion state is unknown.
        """
        request = StopRequest(self.name, now)
        return ask_to_stop(self._own_link(), self._robot, request, timeout)

    def _own_link(self) -> Bus:
        with self._lock:
            if self._stop_bus is None:
                self._stop_bus = self._bus.sibling()
            return self._stop_bus

    def reset(self) -> RobotReply:
        """Clear the latched stop and alarms; never moves. Takes the lease if it is free."""
        return self._owned("reset")

    def resume(self) -> RobotReply:
        """Allow motion again after `reset`, or go on after `pause`."""
        return self._owned("resume")

    def pause(self) -> RobotReply:
        """Hold before the next primitive of the program that runs."""
        return self._owned("pause")

    def step(self) -> RobotReply:
        """Go on to the end of the line that runs, or comes next, and hold there."""
        return self._owned("step")

    def cancel(self) -> RobotReply:
        """End a program that is held; unlike `stop` this latches nothing."""
        return self._owned("cancel")

    def home(self) -> RobotReply:
        """Go to the parking pose."""
        return self._owned("home", timeout=95.0)

    def load(self, scene: Scene) -> RobotReply:
        """Make a simulated world be this scene."""
        self.acquire()
        return self._command("load", scene=scene)

    def _owned(self, verb: str, timeout: float = COMMAND_DEADLINE) -> RobotReply:
        self.acquire()
        return self._command(verb, timeout)

    def _command(
        self, verb: str, timeout: float = COMMAND_DEADLINE, scene: Scene | None = None
    ) -> RobotReply:
        with self._lock:
            self._seq += 1
            # Verbs are numbered apart from what keeps the lease: a verb that overtakes a keepalive
            # would make it stale, and the lease be lost.
            session = self.session if verb in _LEASE_VERBS else f"{self.session}-verbs"
            command = RobotCommand(
                self.name, session, self._epoch, self._seq, time.time() + timeout, scene=scene
            )
        key = self._bus.keys.command(self._robot, verb)
        reply = self._bus.ask(key, command, RobotReply, timeout)
        if not reply.ok:
            raise Declined(reply.code, reply.text)
        return reply

    # --- looking --------------------------------------------------------------------------------

    def scene(self) -> Scene:
        """The scene as it is now."""
        return self._bus.ask(self._bus.keys.snapshot(self._scene), None, SceneSnapshot, LOOK).scene

    def state(self) -> RobotState:
        """The robot's state as it is now."""
        return self._bus.ask(self._bus.keys.state(self._robot), None, RobotState)

    def limits(self) -> RobotLimits:
        """What the robot may do, and whether it is simulated."""
        return self._bus.ask(self._bus.keys.limits(self._robot), None, RobotLimits)

    def wait_ready(self, timeout: float = 10.0) -> None:
        """Wait until robot, scene and agent are there. Raises NoService."""
        for service in ("robot", "scene", "agent"):
            wait_for(self._bus, self._bus.keys.alive(service, ANY), timeout)

    def on_scene(self, callback: Callable[[SceneSnapshot], None]) -> Closing:
        """Call back with the newest scene, now and whenever it changes."""
        return self._on(self._bus.keys.objects(self._scene), SceneSnapshot, callback, latest=True)

    def on_state(self, callback: Callable[[RobotState], None]) -> Closing:
        """Call back with the newest robot state, now and at least every second."""
        return self._on(self._bus.keys.state(self._robot), RobotState, callback, latest=True)

    def on_event(self, callback: Callable[[Event], None], client: str | None = None) -> Closing:
        """Call back with every event of this client's sentences (or another client's, or ANY)."""
        return self._on(self._bus.keys.event(client or self.name), Event, callback, latest=False)

    def on_services(self, callback: Callable[[str, bool], None]) -> Closing:
        """Call back with ("robot/r1", alive) as services come and go; those there at once."""
        root = self._bus.keys.alive(ANY, ANY).removesuffix("*/*")
        closing = self._bus.watch(
            self._bus.keys.alive(ANY, ANY), lambda key, up: callback(key.removeprefix(root), up)
        )
        self._subscriptions.append(closing)
        return closing

    def _on(self, key: str, kind: type[M], callback: Callable[[M], None], latest: bool) -> Closing:
        def handle(key: str, message: Message) -> None:
            if isinstance(message, kind):
                callback(message)

        closing = self._bus.subscribe(key, handle, latest=latest)
        self._subscriptions.append(closing)
        return closing

    def close(self) -> None:
        """Release the robot and end all subscriptions; the bus itself stays open."""
        self.release()
        _close_all(self._subscriptions)
        with self._lock:
            stop_bus, self._stop_bus = self._stop_bus, None
        if stop_bus is not None:
            stop_bus.close()


def _close_all(closings: list[Closing]) -> None:
    while closings:
        closings.pop().close()


_Inbox = queue.SimpleQueue[Event | bool | None]
"""What comes for a submit: its events, whether its program is paused, None: the agent is gone."""


class Pauses:
    """Says when an owner's program is paused (True) and when it goes on (False): `heard` states.

    Who waits for an answer counts no time in between: a person may think as long as they like.
    """

    def __init__(self, owner: str, tell: Callable[[bool], None]) -> None:
        self._owner = owner
        self._tell = tell
        self._paused = False

    def heard(self, key: str, message: Message) -> None:
        """A robot's state, from the bus."""
        if not isinstance(message, RobotState):
            return
        paused = message.program == "paused" and message.owner == self._owner
        if paused != self._paused:
            self._paused = paused
            self._tell(paused)


def _follow(inbox: _Inbox, opened: list[Closing], timeout: float) -> Iterator[Event]:
    """The events in order of seq, each once; closes what was opened when it ends."""
    left, paused, seen = timeout, False, -1
    try:
        while True:
            since = time.monotonic()
            try:
                item = inbox.get(timeout=None if paused else max(left, 0.0))
            except queue.Empty:
                raise NoAnswer(f"the turn did not end within {timeout:g} s") from None
            if not paused:
                left -= time.monotonic() - since
            if isinstance(item, bool):
                paused = item
                continue
            if item is None:
                raise NoService("the agent is gone before the end of the turn")
            if item.seq <= seen:
                continue
            seen = item.seq
            yield item
            if item.stage == "turn":
                return
    finally:
        _close_all(opened)

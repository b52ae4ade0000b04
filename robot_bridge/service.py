"""A robot on the bus: lease, commands, steps, state, and a STOP that never waits for them.

What moves the robot is `robot_bridge.runner`, on a thread of its own. STOP has a link and a thread
of its own too, needs no lease and stays latched until the owner resets and resumes. ``pose()``,
``scene()`` and ``stop()`` of the robot are called while a plan runs.
"""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable

import msgspec

from agent.bus import Bus, Closing, wait_for
from agent.errors import BusError, Declined, NoService, RobotError
from agent.messages import (
    PictureInfo,
    RobotCommand,
    RobotLimits,
    RobotReply,
    RobotState,
    StopRequest,
    Waypoint,
    WorldSnapshot,
)
from agent.wire import ANY, Message
from robot_bridge.api import PARK, Pictured, Robot, Simulated
from robot_bridge.lease import REFUSALS, Lease
from robot_bridge.moves import go_home
from robot_bridge.runner import Runner, explain
from robot_bridge.stepping import Gate
from scene.types import Pose

log = logging.getLogger(__name__)

FRAME = 1 / 15
"""Seconds between two states or worlds while something moves."""
REST = 0.5
"""Seconds between two states at rest."""
PICTURE = (480, 360)
"""Pixels of a picture, across and down."""
TOKEN_DELAY = 0.5
"""Seconds that a client's lease token may come after its request."""


class RobotService:
    """Serves ``robot/<name>/...`` for a robot that the caller opened and closes."""

    def __init__(
        self, bus: Bus, robot: Robot, name: str = "r1", picture: tuple[int, int] = PICTURE
    ) -> None:
        """``picture``: pixels (across, down) of what the camera of a simulated robot shows."""
        self.name = name
        self._picture_size = picture
        self._bus = bus
        self._robot = robot
        self._lease = Lease()
        self._runner = Runner(
            robot, name, lambda event: bus.publish(bus.keys.steps(name), event), self._tell_changes
        )
        self._lock = threading.RLock()
        self._telling = threading.Lock()
        self._latch = ""  # "", "stopped" (needs reset) or "reset" (needs resume)
        self._stopped_by = ""
        self._text = ""
        self._seq = 0
        self._seen = PARK
        self._wake = threading.Event()
        self._closing = threading.Event()
        self._declared: list[Closing] = []
        self._stop_bus: Bus | None = None
        self._watch: threading.Thread | None = None
        self._verbs: dict[str, Callable[[RobotCommand], RobotReply]] = {
            "release": self._release,
            "run": self._run,
            "pause": lambda request: self._at_gate(Gate.pause),
            "step": lambda request: self._at_gate(Gate.step),
            "resume": self._resume,
            "cancel": self._cancel,
            "reset": self._reset,
            "home": self._home,
            "load": self._load,
        }

    def start(self) -> None:
        """Serve; the service's token comes last. Raises BusError if the name is taken."""
        keys, name = self._bus.keys, self.name
        if self._bus.alive(keys.alive("robot", name)):
            raise BusError(f"another bridge serves robot {name!r} under {keys.prefix!r} already")
        self._stop_bus = self._bus.sibling()
        self._declared = [
            self._stop_bus.serve(keys.stop(name), self._on_stop, workers=1, wildcard=True),
            self._stop_bus.subscribe(keys.stop(name), self._on_stop_put),
            self._bus.serve(keys.command(name, ANY), self._on_command, workers=4),
            self._bus.serve(keys.state(name), lambda key, request: self._state()),
            self._bus.serve(keys.limits(name), lambda key, request: self._limits()),
            self._bus.watch(keys.lease(name, ANY), self._on_token),
        ]
        if isinstance(self._robot, Simulated):
            self._declared.append(self._bus.serve(keys.world(name), self._on_world))
        if isinstance(self._robot, Pictured):
            self._declared.append(self._bus.serve_raw(keys.picture(name), self._on_picture))
        self._watch = threading.Thread(target=self._watching, name=f"watch {name}", daemon=True)
        self._watch.start()
        self._publish()
        self._declared.append(self._bus.token(keys.alive("robot", name)))

    def close(self) -> None:
        """Stop what runs and withdraw; the robot itself is closed by who opened it."""
        if self._closing.is_set():
            return
        self._closing.set()
        if self._runner.program != "idle":
            self._halt("the service is closing")
        for closing in reversed(self._declared):
            closing.close()
        self._wake.set()
        if self._watch is not None:
            self._watch.join(timeout=2.0)
        self._runner.close()
        if self._stop_bus is not None:
            self._stop_bus.close()

    # --- STOP -----------------------------------------------------------------------------------

    def _on_stop(self, key: str, request: Message | None) -> RobotReply:
        if not isinstance(request, StopRequest):
            # Whatever the bytes say, who asks this key wants a stop.
            request = StopRequest("an unreadable request")
        self._halt(request.by, request.now)
        return RobotReply(True, self._lease.epoch, "stopped", f"stopped by {request.by}")

    def _on_stop_put(self, key: str, message: Message) -> None:
        self._on_stop(key, message)

    def _halt(self, by: str, now: bool = False) -> None:
        with self._lock:
            if self._latch != "stopped":
                self._stopped_by = by
            self._latch = "stopped"
            self._text = f"stopped by {self._stopped_by}: reset, then resume"
        try:
            self._robot.stop(now)
        finally:  # also where the arm cannot be told: what is held must not go on
            self._runner.halt(self._stopped_by)
            self._wake.set()

    # --- the lease ------------------------------------------------------------------------------

    def _on_command(self, key: str, request: Message | None) -> RobotReply:
        verb = key.rsplit("/", 1)[1]
        if not isinstance(request, RobotCommand):
            raise Declined("bad_payload", f"{verb} takes a RobotCommand")
        if verb == "acquire":
            return self._acquire(request)
        if verb == "keepalive":
            with self._lock:
                code = self._lease.keepalive(request, wall=time.time(), now=time.monotonic())
            return self._answer(code, request)
        if verb not in self._verbs:
            raise Declined("unknown_verb", f"no verb {verb!r}; known: {', '.join(self._verbs)}")
        with self._lock:
            code = self._lease.check(request, wall=time.time())
        reply = self._answer(code, request) if code else self._verbs[verb](request)
        self._wake.set()
        return reply

    def _acquire(self, request: RobotCommand) -> RobotReply:
        with self._lock:
            busy = self._lease.busy(request)
        if busy:  # no wait for a token: who asks without one must not hold up the owner's commands
            return self._answer("busy", request)
        try:
            # A token may arrive after the query that was sent after it.
            wait_for(self._bus, self._bus.keys.lease(self.name, request.client), TOKEN_DELAY)
            has_token = True
        except NoService:
            has_token = False
        with self._lock:
            code = self._lease.acquire(
                request, has_token=has_token, wall=time.time(), now=time.monotonic()
            )
        self._wake.set()
        return self._answer(code, request)

    def _release(self, request: RobotCommand) -> RobotReply:
        self._lose("released by its owner", request.client)
        return self._reply("")

    def _on_token(self, key: str, alive: bool) -> None:
        if not alive:
            self._lose("its owner is gone", key.rsplit("/", 1)[1])

    def _lose(self, why: str, owner: str | None) -> None:
        """Nobody owns the robot; what runs is stopped and does not go on by itself."""
        with self._lock:
            if owner is None or self._lease.owner != owner:
                return
            self._lease.drop()
            moving = self._runner.program != "idle"
        if moving:
            self._halt(f"the bridge, {why}")
        self._wake.set()

    def _answer(self, code: str, request: RobotCommand) -> RobotReply:
        """What the lease says to a command; a stranger is told who may."""
        owner, text = self._lease.owner, ""
        if code in ("busy", "not_owner") and owner not in (None, request.client):
            text = f"held by {owner}: only it can move, pause or step the arm; anyone can stop it"
        return self._reply(code, text)

    def _reply(self, code: str, text: str = "") -> RobotReply:
        return RobotReply(not code, self._lease.epoch, code, text or REFUSALS.get(code, ""))

    # --- verbs ----------------------------------------------------------------------------------

    def _moving(self, move: Callable[[], None]) -> RobotReply:
        """Let the runner move if nothing else does and nothing is latched."""
        with self._lock:
            if self._latch:
                return self._reply("stopped")
            if not self._runner.claim():
                return self._reply("running")
            self._text = ""
        try:
            move()
        except Exception as error:
            return self._reply(*explain(error))
        return self._reply("")

    def _run(self, request: RobotCommand) -> RobotReply:
        if not request.commands:
            return self._reply("bad_payload")
        return self._moving(lambda: self._runner.run(request))

    def _at_gate(self, tell: Callable[[Gate], None]) -> RobotReply:
        """Pause or step the run under way."""
        gate = self._runner.gate
        if gate is None:
            return self._reply("not_running")
        tell(gate)
        return self._reply("")

    def _cancel(self, request: RobotCommand) -> RobotReply:
        """End a run that is held, without the latch of a stop: nothing moves, nothing is wrong."""
        gate = self._runner.gate
        if gate is None:
            return self._reply("not_running")
        return self._reply("" if gate.cancel() else "running")

    def _resume(self, request: RobotCommand) -> RobotReply:
        with self._lock:
            if self._latch == "stopped":
                return self._reply("stopped")
            self._latch, self._text = "", ""
        gate = self._runner.gate
        if gate is not None:
            gate.resume()
        return self._reply("")

    def _reset(self, request: RobotCommand) -> RobotReply:
        with self._lock:
            if self._runner.program != "idle":
                return self._reply("running")
            if self._latch:
                self._latch, self._text = "reset", "reset: resume to go on"
        self._robot.reset()
        with self._lock:
            again = self._latch == "stopped"
        if again:  # somebody stopped it meanwhile: the robot's own latch must say so too
            self._robot.stop()
        return self._reply("stopped" if again else "")

    def _home(self, request: RobotCommand) -> RobotReply:
        return self._moving(lambda: self._runner.act(lambda: go_home(self._robot)))

    def _load(self, request: RobotCommand) -> RobotReply:
        robot, scene = self._robot, request.scene
        if scene is None or not isinstance(robot, Simulated):
            return self._reply("bad_payload", "load takes a scene, and a simulated robot")
        return self._moving(lambda: self._runner.act(lambda: robot.load(scene)))

    # --- what can be seen -----------------------------------------------------------------------

    def _state(self) -> RobotState:
        pose, lost = self._look()  # not under the lock: a slow driver must not hold up STOP
        with self._lock:
            self._seq += 1
            return RobotState(
                self._seq, time.time(), self.name,
                "lost" if lost else "stopped" if self._latch else "normal", self._runner.program,
                Waypoint(pose.x, pose.y, pose.z, pose.r, False),
                self._lease.owner, self._lease.epoch, lost or self._text, self._runner.line,
            )  # fmt: skip

    def _look(self) -> tuple[Pose, str]:
        """Where the arm is, or was when it was last seen, and why it cannot be seen."""
        try:
            self._seen = self._robot.pose()
        except RobotError as error:
            return self._seen, str(error)
        return self._seen, ""

    def _limits(self) -> RobotLimits:
        return RobotLimits(**msgspec.structs.asdict(self._robot.limits))

    def _on_world(self, key: str, request: Message | None) -> WorldSnapshot:
        assert isinstance(self._robot, Simulated)
        scene = self._robot.scene()
        with self._lock:
            self._seq += 1
            return WorldSnapshot(self._seq, time.time(), scene)

    def _on_picture(self, key: str) -> tuple[bytes, bytes]:
        """What the camera sees, raw; drawn when it is asked for."""
        robot, (width, height) = self._robot, self._picture_size
        assert isinstance(robot, Pictured)
        taken, view = time.time(), robot.view(width, height)
        pixels = robot.picture(width, height)
        homography = tuple(float(number) for number in view.homography.ravel())
        info = PictureInfo(taken, width, height, "rgb", homography, view.camera)
        return pixels.tobytes(), msgspec.json.encode(info)

    def _publish(self) -> None:
        keys = self._bus.keys
        with self._telling:  # so that the newest is also the last one told
            if isinstance(self._robot, Simulated):
                self._bus.publish(keys.world(self.name), self._on_world("", None))
            self._bus.publish(keys.state(self.name), self._state())

    def _watching(self) -> None:
        """Tell state and world, often while something moves; notice a silent owner."""
        told = 0.0
        while not self._closing.is_set():
            woken = self._wake.wait(FRAME)
            self._wake.clear()
            with self._lock:
                owner = self._lease.owner if self._lease.silent(time.monotonic()) else None
            self._lose("its owner is silent", owner)
            if woken or self._runner.program == "running" or time.monotonic() - told > REST:
                told = time.monotonic()
                self._tell()

    def _tell_changes(self, now: bool) -> None:
        """Tell of a line that begins: soon, the arm does not wait; of one that is held: now."""
        if now:
            self._tell()
        else:
            self._wake.set()

    def _tell(self) -> None:
        try:
            self._publish()
        except Exception:
            # A robot that cannot be read must not end the watch over its owner.
            log.exception("robot %s: its state could not be told", self.name)

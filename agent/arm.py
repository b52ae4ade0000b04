"""The arm as a turn sees it: look, know the workspace, run checked commands, stop, reset.

`LocalArm` holds a robot in this process; `BusArm` speaks to a bridge on behalf of one client.
Either way an `ApprovedPlan` is all that a robot runs; a bridge approves anew what it is sent, in
the process that holds the robot, never on the word of another.
"""

from __future__ import annotations

import logging
import queue
import time
import uuid
from collections.abc import Callable, Collection, Iterator
from typing import Protocol, TypeVar

import msgspec

from agent.bus import Bus
from agent.client import LOOK, Pauses
from agent.doubt import SURE, Doubt, Stands
from agent.errors import (
    AlarmError,
    BusError,
    Cancelled,
    Declined,
    LinkDown,
    MoveTimeout,
    NoAnswer,
    NoReply,
    NotAtTarget,
    NotReady,
    RobotError,
    Stopped,
    Unreachable,
)
from agent.messages import (
    RobotCommand,
    RobotEvent,
    RobotLimits,
    RobotReply,
    RobotState,
    SceneCall,
    SceneSnapshot,
    StepReport,
    StopRequest,
)
from agent.stopping import ask_to_stop
from agent.wire import Message
from robot_bridge.api import ApprovedPlan, Limits, Simulated, Workspace
from scene.types import Pose, Scene

log = logging.getLogger(__name__)

M = TypeVar("M")

COMMAND_DEADLINE = 5.0
BLINK = 0.5
"""Seconds for which a detector may miss what is in full view."""
SILENCE = 60.0
"""Seconds without a step or an end after which a run counts as lost, unless it is paused."""


_Inbox = queue.SimpleQueue[RobotEvent | bool | None]
"""What comes for a run: steps and end, whether it is paused, None: nobody to wait for."""


class Arm(Protocol):
    """What a turn needs of an arm. Methods raise RobotError and its kinds."""

    @property
    def workspace(self) -> Workspace:
        """Where the arm can go."""
        ...

    def scene(self) -> Scene:
        """The scene as it is now: each call looks again."""
        ...

    def doubt(self) -> Doubt:
        """How uncertain the places in the scene are that was looked at last."""
        ...

    def heights(self) -> Doubt:
        """How uncertain the heights in that scene are."""
        ...

    def unseen(self) -> Collection[str]:
        """Ids of what could not be seen, or not wholly, when it was looked last."""
        ...

    def stands(self) -> Stands:
        """What of that scene rests, each thing under a number that it keeps until it moves."""
        ...

    def start(self) -> Pose:
        """The pose from which the next motion starts."""
        ...

    def run(self, plan: ApprovedPlan, *, hold: bool = False) -> Iterator[StepReport]:
        """Run the plan, one report a primitive as it ends. ``hold``: wait before its first line.

        Who closes the generator ends the run after the primitive under way.
        """
        ...

    def call(self, id_: str, name: str) -> None:
        """Tell the eye, if there is one, what an object is called from now on."""
        ...

    def stop(self) -> None:
        """Halt now, from any thread; latched."""
        ...

    def reset(self) -> None:
        """Clear the latch, and allow motion again; never moves."""
        ...


class LocalArm:
    """A simulated robot in this process; its own world is what is seen, as the ``eye`` sees it.

    ``sd``: how uncertain the eye is of the places in what it saw last.
    """

    def __init__(
        self,
        robot: Simulated,
        eye: Callable[[Scene], Scene] = lambda scene: scene,
        sd: Callable[[], Doubt] = lambda: SURE,
    ) -> None:
        self._robot = robot
        self._eye, self._sd = eye, sd

    @property
    def workspace(self) -> Workspace:
        """See `Arm`."""
        return self._robot

    def scene(self) -> Scene:
        """See `Arm`."""
        return self._eye(self._robot.scene())

    def doubt(self) -> Doubt:
        """See `Arm`: as much as the eye says."""
        return self._sd()

    def heights(self) -> Doubt:
        """See `Arm`: none is known of."""
        return SURE

    def unseen(self) -> Collection[str]:
        """See `Arm`: nothing hides here."""
        return ()

    def stands(self) -> Stands:
        """See `Arm`: nobody compares pictures here."""
        return {}

    def start(self) -> Pose:
        """See `Arm`."""
        return self._robot.pose()

    def run(self, plan: ApprovedPlan, *, hold: bool = False) -> Iterator[StepReport]:
        """See `Arm`. Nobody could let a held arm go on here, so it does not wait."""
        return self._robot.run(plan)

    def call(self, id_: str, name: str) -> None:
        """See `Arm`: there is no eye that would keep it."""

    def stop(self) -> None:
        """See `Arm`."""
        self._robot.stop()

    def reset(self) -> None:
        """See `Arm`."""
        self._robot.reset()


class BoxWorkspace:
    """The workspace a bridge told us of: a box. The bridge itself knows its arm's exact reach."""

    def __init__(self, limits: Limits) -> None:
        self._limits = limits

    @property
    def limits(self) -> Limits:
        """The workspace."""
        return self._limits

    def reach(self, pose: Pose) -> str | None:
        """None: inside the box everything counts as reachable here."""
        return None


class BusArm:
    """A bridge's robot, moved for one client: with that client's lease and epoch, or not at all."""

    def __init__(
        self,
        bus: Bus,
        client: str,
        robot: str = "r1",
        scene: str = "main",
        silence: float = SILENCE,
    ) -> None:
        self._bus = bus
        self._client = client
        self._robot = robot
        self._scene = scene
        self._silence = silence
        self._session = uuid.uuid4().hex[:12]
        self._seq = 0
        self._box: BoxWorkspace | None = None
        self._inbox: _Inbox | None = None
        self._doubt = self._heights = SURE
        self._unseen: Collection[str] = ()
        self._stands: Stands = {}

    @property
    def workspace(self) -> Workspace:
        """See `Arm`. Raises LinkDown."""
        if self._box is None:
            told = self._ask(self._bus.keys.limits(self._robot), RobotLimits)
            self._box = BoxWorkspace(Limits(**msgspec.structs.asdict(told)))
        return self._box

    def scene(self) -> Scene:
        """See `Arm`. Raises LinkDown."""
        told = self._ask(self._bus.keys.snapshot(self._scene), SceneSnapshot, LOOK)
        self._doubt, self._heights, self._stands = told.sd, told.tall_sd, told.stands
        self._unseen = {id_ for id_, seconds in told.unseen.items() if seconds > BLINK}
        return told.scene

    def doubt(self) -> Doubt:
        """See `Arm`."""
        return self._doubt

    def heights(self) -> Doubt:
        """See `Arm`."""
        return self._heights

    def unseen(self) -> Collection[str]:
        """See `Arm`."""
        return self._unseen

    def stands(self) -> Stands:
        """See `Arm`."""
        return self._stands

    def start(self) -> Pose:
        """See `Arm`. Raises LinkDown."""
        pose = self._state().pose
        return Pose(pose.x, pose.y, pose.z, pose.r)

    def call(self, id_: str, name: str) -> None:
        """See `Arm`. Where no eye keeps it, the conversation alone knows the name."""
        key, request = self._bus.keys.call(self._scene), SceneCall(id_, name)
        try:
            self._bus.ask(key, request, SceneSnapshot, LOOK)
        except BusError as error:
            log.info("nobody keeps the name %r of %s: %s", name, id_, error)

    def _state(self) -> RobotState:
        return self._ask(self._bus.keys.state(self._robot), RobotState)

    def _ask(self, key: str, kind: type[M], timeout: float = COMMAND_DEADLINE) -> M:
        try:
            return self._bus.ask(key, None, kind, timeout)
        except BusError as error:
            raise LinkDown(f"the robot or its eye does not answer ({error})") from error

    def run(self, plan: ApprovedPlan, *, hold: bool = False) -> Iterator[StepReport]:
        """See `Arm`. Raises NotReady when the client does not hold the arm."""
        inbox: _Inbox = queue.SimpleQueue()
        self._inbox = inbox
        pauses = Pauses(self._client, inbox.put)

        def took_place(key: str, message: Message) -> None:
            if isinstance(message, RobotEvent) and message.session == self._session:
                inbox.put(message)

        def gone(key: str, alive: bool) -> None:
            if not alive:
                inbox.put(None)

        keys = self._bus.keys
        with (
            self._bus.subscribe(keys.steps(self._robot), took_place),
            self._bus.watch(keys.alive("robot", self._robot), gone),
            self._bus.subscribe(keys.state(self._robot), pauses.heard),
        ):
            self._command("run", plan, hold)
            seq = self._seq
            try:
                yield from self._steps(inbox, seq)
            except GeneratorExit:
                self._call_off(inbox, seq)
                raise

    def _call_off(self, inbox: _Inbox, seq: int) -> None:
        """End a run that nobody follows any longer, after the primitive under way; no latch."""
        try:
            self._command("pause")
            while (event := inbox.get(timeout=self._silence)) is not True:
                if event is None or (isinstance(event, RobotEvent) and _ends(event, seq)):
                    return
            self._command("cancel")
            while (event := inbox.get(timeout=self._silence)) is not None:
                if isinstance(event, RobotEvent) and _ends(event, seq):
                    return
        except (queue.Empty, RobotError) as error:
            log.warning("robot %s: a run could not be called off: %s", self._robot, error)

    def _steps(self, inbox: _Inbox, seq: int) -> Iterator[StepReport]:
        """The steps of one run, to its end. Raises what the robot raised, LinkDown, MoveTimeout."""
        paused = False
        while True:
            try:
                event = inbox.get(timeout=None if paused else self._silence)
            except queue.Empty:
                raise MoveTimeout(f"no step and no end within {self._silence:g} s") from None
            if isinstance(event, bool):
                paused = event
                continue
            if event is None:
                raise _lost("connection to the robot lost, motion state unknown")
            if event.command_seq != seq:
                continue
            if event.step is not None:
                yield event.step
            if event.error == LinkDown.__name__:
                raise _lost(event.text)
            if event.error is not None:
                raise robot_error(event.error, event.text)
            if event.ended:
                return

    def _command(self, verb: str, plan: ApprovedPlan | None = None, hold: bool = False) -> None:
        state = self._state()
        if state.owner != self._client:
            whose = f"{state.owner!r} holds" if state.owner else "nobody of you holds"
            raise NotReady(f"{whose} the arm; {self._client!r} may look and ask only")
        self._seq += 1
        request = RobotCommand(
            self._client, self._session, state.epoch, self._seq,
            time.time() + COMMAND_DEADLINE,
        )  # fmt: skip
        if plan is not None:
            request = msgspec.structs.replace(
                request, commands=plan.told, program=plan.program, scene=plan.scene,
                digest=plan.digest, hold=hold,
            )  # fmt: skip
        key = self._bus.keys.command(self._robot, verb)
        try:
            reply = self._bus.ask(key, request, RobotReply, COMMAND_DEADLINE)
        except Declined as error:
            raise NotReady(str(error)) from error
        except NoAnswer as error:
            raise NoReply(f"the bridge did not answer {verb}: outcome unknown") from error
        except BusError as error:
            raise LinkDown(f"the robot does not answer ({error})") from error
        if not reply.ok:
            raise robot_error(reply.code, reply.text)

    def stop(self) -> None:
        """See `Arm`. Raises LinkDown if no bridge acknowledged it."""
        try:
            ask_to_stop(self._bus, self._robot, StopRequest(self._client), timeout=2.0)
        except BusError as error:
            raise LinkDown(f"STOP was not acknowledged ({error})") from error

    def reset(self) -> None:
        """See `Arm`: reset, then resume. Raises NotReady without the lease."""
        self._command("reset")
        self._command("resume")

    def close(self) -> None:
        """Follow no run any longer: one in progress raises LinkDown here, and goes on there."""
        if self._inbox is not None:
            self._inbox.put(None)


def _lost(text: str) -> LinkDown:
    """The link went down under way."""
    error = LinkDown(text)
    error.moving = True
    return error


def _ends(event: RobotEvent, seq: int) -> bool:
    return event.command_seq == seq and (event.ended or event.error is not None)


_BY_CODE: dict[str, type[RobotError]] = {
    "unreachable": Unreachable,
    "stopped": NotReady,
    "Unreachable": Unreachable,
    "NotReady": NotReady,
    "NoReply": NoReply,
    "LinkDown": LinkDown,
    "AlarmError": AlarmError,
    "MoveTimeout": MoveTimeout,
    "NotAtTarget": NotAtTarget,
}


def robot_error(code: str, text: str) -> RobotError:
    """The error a bridge told of: its class's name, or a refusal code (NotReady)."""
    if code in ("Stopped", "Cancelled"):
        return Cancelled(text) if code == "Cancelled" else Stopped(text)
    return _BY_CODE.get(code, NotReady)(text)

"""The agent on the bus: sentences in, turns out; a conversation for each client.

A submit is acknowledged at once and taken in order on a thread of the pool; its events carry its
request_id and end with the turn. A repeated submit is acknowledged and not taken again. "stop" does
not queue: it halts while another turn of the same client runs, and what waited is cancelled.
"""

from __future__ import annotations

import logging
import threading
from collections import OrderedDict, deque
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Protocol

import msgspec

from agent.arm import BusArm
from agent.attempt import RETRIES
from agent.bus import Bus, Closing
from agent.check import Predict
from agent.client import is_stop
from agent.errors import ArmchatError, BusError, Declined, LinkDown, TranslatorError
from agent.execute import Executor
from agent.messages import (
    Ack,
    Dialog,
    Event,
    Kind,
    Reason,
    StepReport,
    Submit,
    Turn,
)
from agent.turn import Decide, Parts, Watch, run_program, run_turn
from agent.wire import ANY, Message
from robot_bridge.api import ApprovedPlan, waypoint
from scene.types import Scene

log = logging.getLogger(__name__)

TURNS = 8
"""Turns that run side by side, one a client."""
REMEMBERED = 256
"""Request ids a client's conversation remembers."""
CLIENTS = 256
"""Conversations kept; the one unused longest is forgotten first."""


class RunTurn(Protocol):
    """`agent.turn.run_turn`, or what stands in for it."""

    def __call__(
        self,
        say: str,
        dialog: Dialog,
        parts: Parts,
        *,
        task: Kind | None = None,
        dry_run: bool = False,
        hold: bool = False,
        watch: Watch = ...,
    ) -> tuple[Turn, Dialog]:
        """One sentence to one turn, and the conversation after it."""
        ...


class Conversation:
    """What the agent knows of one client: its arm, its dialog, what waits and what was taken."""

    def __init__(self, client: str, arm: BusArm) -> None:
        self.client = client
        self.arm = arm
        self.dialog = Dialog()
        self.waiting: deque[Submit] = deque()
        self.busy = False
        self.taken: OrderedDict[str, None] = OrderedDict()

    def take(self, request_id: str) -> bool:
        """Whether this request is new."""
        if request_id in self.taken:
            return False
        self.taken[request_id] = None
        if len(self.taken) > REMEMBERED:
            self.taken.popitem(last=False)
        return True


class Telling:
    """The events of one submit, numbered in order."""

    def __init__(self, tell: Callable[[Event], None], request_id: str) -> None:
        self._tell = tell
        self._request_id = request_id
        self._seq = 0
        self.moved = False

    def _event(self) -> Event:
        self._seq += 1
        return Event(self._request_id, self._seq, "heard")

    def heard(self, text: str) -> None:
        """The sentence is being dealt with."""
        self._tell(_with(self._event(), text=text))

    def plan(self, plan: ApprovedPlan, kind: Kind, after: Scene) -> None:
        """This program passed the check and will run."""
        told = tuple(waypoint(command) for command in plan.told)
        event = self._event()
        self._tell(_with(event, stage="program", program=plan.program, kind=kind, plan=told))

    def step(self, step: StepReport) -> None:
        """One primitive was executed."""
        self.moved = True
        self._tell(_with(self._event(), stage="step", step=step))

    def turn(self, turn: Turn) -> None:
        """The last event."""
        self._tell(_with(self._event(), stage="turn", text=turn.reply, turn=turn))


def _with(event: Event, **changes: object) -> Event:
    return msgspec.structs.replace(event, **changes)


class AgentService:
    """Serves ``instruction/<client>/submit`` for every client."""

    def __init__(
        self,
        bus: Bus,
        decide: Decide,
        executor: Executor,
        predict: Predict,
        *,
        name: str = "a1",
        robot: str = "r1",
        scene: str = "main",
        turn: RunTurn = run_turn,
        retries: int = RETRIES,
    ) -> None:
        self.name = name
        self._bus = bus
        self._decide = decide
        self._executor = executor
        self._predict = predict
        self._robot = robot
        self._scene = scene
        self._turn = turn
        self._retries = retries
        self._lock = threading.Lock()
        self._conversations: OrderedDict[str, Conversation] = OrderedDict()
        self._declared: list[Closing] = []
        self._pool: ThreadPoolExecutor | None = None
        self._stop_bus: Bus | None = None

    def start(self) -> None:
        """Serve; the service's token comes last."""
        keys = self._bus.keys
        self._pool = ThreadPoolExecutor(TURNS, thread_name_prefix="turn")
        self._stop_bus = self._bus.sibling()
        self._declared = [
            self._bus.serve(keys.submit(ANY), self._on_submit, workers=4),
            self._bus.token(keys.alive("agent", self.name)),
        ]

    def close(self) -> None:
        """Withdraw; a turn in progress ends without its arm."""
        while self._declared:
            self._declared.pop().close()
        with self._lock:
            conversations = list(self._conversations.values())
            for conversation in conversations:
                conversation.waiting.clear()
        for conversation in conversations:
            conversation.arm.close()
        if self._pool is not None:
            self._pool.shutdown(wait=True, cancel_futures=True)
        if self._stop_bus is not None:
            self._stop_bus.close()

    # --- in -------------------------------------------------------------------------------------

    def _on_submit(self, key: str, request: Message | None) -> Ack:
        client = key.split("/")[-2]
        if not isinstance(request, Submit):
            raise Declined("bad_payload", "submit takes a Submit")
        if not request.text.strip() and request.program is None:
            raise Declined("bad_payload", "nothing was said")
        with self._lock:
            conversation = self._conversation(client)
            if not conversation.take(request.request_id):
                return Ack(request.request_id, duplicate=True)
        if request.program is None and is_stop(request.text):
            self._stop(conversation, request)
        else:
            self._queue(conversation, request)
        return Ack(request.request_id)

    def _conversation(self, client: str) -> Conversation:
        found = self._conversations.pop(client, None)
        if found is None:
            found = Conversation(client, BusArm(self._bus, client, self._robot, self._scene))
        self._conversations[client] = found
        if len(self._conversations) > CLIENTS:
            oldest = next((o for o in self._conversations.values() if not o.busy), found)
            if oldest is not found:
                del self._conversations[oldest.client]
        return found

    def _queue(self, conversation: Conversation, submit: Submit) -> None:
        assert self._pool is not None
        with self._lock:
            conversation.waiting.append(submit)
            if not conversation.busy:
                conversation.busy = True
                self._pool.submit(self._drain, conversation)

    def _drain(self, conversation: Conversation) -> None:
        """Take what this client said, one after the other."""
        while True:
            with self._lock:
                if not conversation.waiting:
                    conversation.busy = False
                    return
                submit = conversation.waiting.popleft()
            try:
                self._take(conversation, submit)
            except Exception:
                log.exception("turn of %s: its end could not be told", conversation.client)

    # --- out ------------------------------------------------------------------------------------

    def _telling(self, conversation: Conversation, submit: Submit) -> Telling:
        key = self._bus.keys.event(conversation.client)
        return Telling(lambda event: self._bus.publish(key, event), submit.request_id)

    def _take(self, conversation: Conversation, submit: Submit) -> None:
        telling = self._telling(conversation, submit)
        telling.heard(submit.text)
        try:
            turn = self._run(conversation, submit, telling)
        except Exception as error:
            turn = broken(submit, error, telling.moved)
        telling.turn(turn)

    def _run(self, conversation: Conversation, submit: Submit, telling: Telling) -> Turn:
        parts = Parts(self._decide, self._executor, self._predict, conversation.arm, self._retries)
        watch = Watch(plan=telling.plan, step=telling.step)
        if submit.program is not None:
            kind = submit.task or "manipulate"
            return run_program(
                submit.program, kind, parts,
                dry_run=submit.dry_run, hold=submit.hold, watch=watch,
            )  # fmt: skip
        turn, conversation.dialog = self._turn(
            submit.text, conversation.dialog, parts,
            task=submit.task, dry_run=submit.dry_run, hold=submit.hold, watch=watch,
        )  # fmt: skip
        return turn

    def _stop(self, conversation: Conversation, submit: Submit) -> None:
        """Halt at once, then say so; what waited is cancelled, a pending question forgotten."""
        with self._lock:
            waiting, conversation.waiting = list(conversation.waiting), deque()
            conversation.dialog = msgspec.structs.replace(
                conversation.dialog, pending=None, last_text=None, questions_asked=0
            )
        reply = "Stopped. Say “reset” to go on."
        try:
            assert self._stop_bus is not None
            BusArm(self._stop_bus, conversation.client, self._robot, self._scene).stop()
        except LinkDown as error:
            reply = f"The arm did not confirm the stop: {error}. Its motion state is unknown."
        telling = self._telling(conversation, submit)
        telling.heard(submit.text)
        telling.turn(Turn(say=submit.text, status="answered", reply=reply))
        for other in waiting:
            cancelled = Turn(
                say=other.text, status="refused", reply="Cancelled by the stop.", reason="cancelled"
            )
            self._telling(conversation, other).turn(cancelled)


def broken(submit: Submit, error: Exception, moved: bool) -> Turn:
    """The turn that an error cut short: failed once something moved, else refused and why."""
    say = submit.text if submit.program is None else None
    expected = isinstance(error, ArmchatError)
    if not expected:
        log.error("a turn failed", exc_info=error)
    if moved:
        return Turn(say=say, status="failed", reply=f"I had to break off: {error}.")
    if not expected:
        reply = f"Something broke inside ({type(error).__name__}: {error}); nothing moved."
        return Turn(say=say, status="refused", reply=reply, reason="not_understood")
    reason: Reason = "unsafe"
    if isinstance(error, BusError | TranslatorError):
        reason = "not_understood"
    return Turn(say=say, status="refused", reply=f"I can't: {error}.", reason=reason)

"""What a bridge has its robot do: one thing at a time, on a thread of its own, told step by step.

Every plan passes `approve` here, in the process that holds the robot, whoever sent it. A run can
be held between its primitives (`robot_bridge.stepping`); what the robot does by itself (home,
load) cannot. The lease, and whether a motion may begin at all, are the service's business.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Generator, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Literal

from agent.errors import NotReady, RobotError, Stopped
from agent.messages import Command, RobotCommand, RobotEvent, StepReport
from robot_bridge.api import ApprovedPlan, Robot, approve
from robot_bridge.stepping import Gate, Place

log = logging.getLogger(__name__)

PATIENCE = 30.0
"""Seconds until a motion has begun."""
ACT_PATIENCE = 90.0
"""Seconds until home and load are over: a real arm takes half a minute to home itself."""

Program = Literal["idle", "running", "paused"]


class Runner:
    """Moves one robot. ``tell_step`` tells of a run's steps and its end.

    ``tell_state(now)`` tells the state and the world: now, or soon.
    """

    def __init__(
        self,
        robot: Robot,
        name: str,
        tell_step: Callable[[RobotEvent], None],
        tell_state: Callable[[bool], None],
    ) -> None:
        self._robot = robot
        self._tell_step = tell_step
        self._tell_state = tell_state
        self._lock = threading.Lock()
        self._claimed = False
        self._gate: Gate | None = None
        self._thread = ThreadPoolExecutor(1, thread_name_prefix=f"robot {name}")

    @property
    def program(self) -> Program:
        """Whether the robot does something, and whether that is held."""
        gate = self._gate
        if not self._claimed:
            return "idle"
        return "paused" if gate is not None and gate.held else "running"

    @property
    def gate(self) -> Gate | None:
        """Where the run under way can be held; None while no run is."""
        return self._gate

    @property
    def line(self) -> int:
        """The program's line that runs, or comes next while it is held; 0: none."""
        gate = self._gate
        return 0 if gate is None else gate.line

    def claim(self) -> bool:
        """Take the robot for one `run` or `act`; False if it does something."""
        with self._lock:
            claimed, self._claimed = self._claimed, True
            return not claimed

    def run(self, request: RobotCommand) -> None:
        """Begin a run; returns once it has begun, or is held before its first line.

        Raises RobotError where it cannot begin, TimeoutError.
        """
        begun: Future[None] = Future()
        # here and not on the thread: a STOP from now on finds what it has to end
        gate = self._gate = Gate(_place(request.commands[0]), request.hold, self._tell_state)
        self._thread.submit(self._run, request, gate, begun)
        begun.result(PATIENCE)

    def act(self, work: Callable[[], object]) -> None:
        """Do something and wait for its end. Raises what it raises, TimeoutError."""
        done: Future[None] = Future()

        def job() -> None:
            error: Exception | None = None
            try:
                work()
            except Exception as raised:
                error = raised
            self._rest()
            _settle(done, error)

        self._thread.submit(job)
        done.result(ACT_PATIENCE)

    def halt(self, by: str) -> None:
        """Somebody stopped the robot: what is held ends, and says by whom."""
        gate = self._gate
        if gate is not None:
            gate.end(by)

    def close(self) -> None:
        """Wait for the end of what was halted before."""
        self._thread.shutdown(wait=True, cancel_futures=True)

    # --- on the runner's own thread -------------------------------------------------------------

    def _run(self, request: RobotCommand, gate: Gate, begun: Future[None]) -> None:
        """Approve, say that it begins, run, tell of each step and the end."""
        try:
            plan = self._approved(request)
            steps = self._robot.run(plan)
        except Exception as error:
            self._rest()
            _settle(begun, error)
            return
        gate.begin()
        _settle(begun, None)
        code, text = self._to_the_end(request, plan, steps, gate)
        self._rest()
        ended = RobotEvent(request.seq, request.session, ended=True, error=code or None, text=text)
        self._tell_step(ended)

    def _approved(self, request: RobotCommand) -> ApprovedPlan:
        """The plan, approved here and now. Raises Unreachable, or NotReady if that is another."""
        pose = self._robot.pose()
        plan = approve(request.commands, pose, self._robot, request.program, request.scene)
        if plan.digest != request.digest:
            raise NotReady("the plan was approved for another program, scene or robot: plan again")
        return plan

    def _to_the_end(
        self, request: RobotCommand, plan: ApprovedPlan, steps: Iterator[StepReport], gate: Gate
    ) -> tuple[str, str]:
        """Take each step as the gate lets it pass; code and text of what ended it early."""
        try:
            for command in plan.told:
                gate.arrive(_place(command))
                step = next(steps)
                self._tell_step(RobotEvent(request.seq, request.session, step))
            next(steps, None)  # a driver may have to finish
        except Stopped as error:
            return type(error).__name__, gate.ended or error.by
        except Exception as error:
            return explain(error)
        finally:
            if isinstance(steps, Generator):
                steps.close()
        return "", ""

    def _rest(self) -> None:
        """The motion is over: state and world say so before anything else does."""
        with self._lock:
            self._claimed, self._gate = False, None
        self._tell_state(True)


def _place(command: Command) -> Place:
    return Place(command.line, command.statement)


def _settle(future: Future[None], error: Exception | None) -> None:
    if error is None:
        future.set_result(None)
    else:
        future.set_exception(error)


def explain(error: Exception) -> tuple[str, str]:
    """An error as code and text; one that no driver should raise is logged."""
    if not isinstance(error, RobotError):
        log.error("the robot failed", exc_info=error)
        return "NoReply", f"the driver failed: {error}; outcome unknown"
    return type(error).__name__, str(error)

"""STOP as a client sends it: at once, again every 50 ms, until the bridge acknowledges any of it.

An acknowledgement counts however late it comes: where a round trip takes longer than the pause
between two requests (a busy machine, a far router), giving each request up before the next one
would throw away every answer, and report a motion state as unknown that is known.
"""

from __future__ import annotations

import queue
import threading
import time

from agent.bus import Bus
from agent.errors import BusError, NoAnswer, NoService
from agent.messages import RobotReply, StopRequest

REPEAT = 0.05
"""Seconds between two requests."""
NOBODY = 0.01
"""Seconds until the next request where nobody serves the robot yet."""
PENDING = 8
"""Requests that wait for their answer at a time; further ones are sent without."""

_Answers = queue.SimpleQueue[RobotReply | BusError]


def ask_to_stop(bus: Bus, robot: str, request: StopRequest, timeout: float) -> RobotReply:
    """Stop a robot; the bridge's first acknowledgement (design: wire, "Lease, epoch, seq, STOP").

    Raises NoService or NoAnswer when no bridge acknowledged it within ``timeout`` seconds: then the
    motion state is unknown. Raises Declined where the bridge could not tell its arm.
    """
    answers: _Answers = queue.SimpleQueue()
    end = time.monotonic() + timeout
    silent = NoAnswer(f"{robot} did not acknowledge the stop within {timeout:g} s")
    pending = 0
    problem: BusError = silent
    while (left := end - time.monotonic()) > 0:
        bus.publish(bus.keys.stop(robot), request)
        if pending < PENDING:
            pending += 1
            _ask(bus, robot, request, left, answers)
        try:
            answer = answers.get(timeout=min(REPEAT, left))
        except queue.Empty:
            continue
        if isinstance(answer, RobotReply):
            return answer
        if not isinstance(answer, NoService | NoAnswer):
            raise answer
        pending -= 1
        problem = silent if isinstance(answer, NoAnswer) else answer
        threading.Event().wait(min(NOBODY, left))
    raise problem


def _ask(bus: Bus, robot: str, request: StopRequest, timeout: float, answers: _Answers) -> None:
    """One request on a thread of its own, which ends with the answer or the time."""

    def work() -> None:
        try:
            answers.put(bus.ask(bus.keys.stop(robot), request, RobotReply, timeout))
        except BusError as error:
            answers.put(error)

    threading.Thread(target=work, name=f"stop {robot}", daemon=True).start()

"""Runs programs in a worker process and trusts nothing that comes back.

`Executor` keeps a worker and a warm spare. A worker that dies, misses its deadline or sends
nonsense is killed and the spare takes its place; the caller gets `SolverFailed` as a value, with
what happened in plain words: nothing else is known about that program. Workers are replaced now
and then even so. The interpreter and the solver run only in the worker.
"""

from __future__ import annotations

import contextlib
import logging
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Self

from agent.errors import NotAllowed, ProgramError, SolverFailed
from agent.language import frames
from agent.language.frames import Closed, FrameError, Request
from agent.messages import Draft, Kind
from agent.program import MAX_CHARACTERS, scan
from scene.types import Scene

DEADLINE_S = 1.0
"""Time for one request, plus SCENE_S for each of its scenes. What the worker spends waiting for a
processor does not count: on a busy machine a good program is not to be called a failed one."""
SCENE_S = 0.05
PATIENCE = 10
"""So many times that by the clock: nobody waits longer, whatever the machine does."""
START_S = 20.0
"""Time for a new worker to be ready (a loaded machine is slow to start Python)."""
STARTS = 3
"""Workers tried in a row before a request is given up for want of one."""
BATCH = 50
"""Scenes in one request; more are sent in several."""
RECYCLE_REQUESTS = 2_000
"""A worker is replaced after so many requests, and with it whatever a program left behind there."""
RECYCLE_BUSY_S = 10.0
"""The same, after so much work: well within the processor time that a worker has for its life."""

ROOT = Path(__file__).resolve().parent.parent
"""Where our own packages lie: a worker starts with no search path but the one it is given."""
_BOOT = """\
import gc, sys
gc.disable()
sys.path[:] = sys.argv[2:]
from {module} import main
main({descriptor})"""
_LOG = logging.getLogger(__name__)


class Executor:
    """Runs programs on scenes; thread-safe; a context manager, or `close` it.

    The worker starts on the first `run` (or on entering the context), not on construction; the
    spare starts during the worker's second request. ``worker`` names the module whose ``main``
    serves the requests.
    """

    def __init__(
        self,
        deadline_s: float = DEADLINE_S,
        recycle_requests: int = RECYCLE_REQUESTS,
        worker: str = "agent.language.worker",
    ) -> None:
        self._deadline_s = deadline_s
        self._recycle_requests = recycle_requests
        self._module = worker
        self._lock = threading.Lock()
        self._worker: _Worker | None = None
        self._spare: _Worker | None = None
        self._warned = False

    def __enter__(self) -> Self:
        with self._lock, contextlib.suppress(FrameError):  # a run says it, if it lasts
            self._start()
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    @property
    def pid(self) -> int:
        """Process id of the worker that takes the next request."""
        with self._lock:
            return self._start().pid

    @property
    def hardened(self) -> bool:
        """Whether the system calls of the worker and of the spare are filtered.

        Starts both and waits until they are ready; False if they do not start.
        """
        with self._lock:
            try:
                worker = self._ready()
                self._start_spare()
                return self._spare is not None and self._greet(worker) and self._greet(self._spare)
            except FrameError:
                return False

    def run(self, source: str, kind: Kind, scenes: Sequence[Scene]) -> list[Draft | ProgramError]:
        """Run one program on each scene, afresh; one result a scene, an error being a value.

        When the worker dies of it, all results of its request are SolverFailed.
        """
        if not source.isascii() or len(source) > MAX_CHARACTERS:  # the worker scans the rest
            try:
                scan(source)
            except NotAllowed as error:
                return [error for _ in scenes]
        results: list[Draft | ProgramError] = []
        with self._lock:
            for start in range(0, len(scenes), BATCH):
                results += self._request(
                    Request(source, kind, tuple(scenes[start : start + BATCH]))
                )
        return results

    def close(self) -> None:
        """End both workers. A later run starts new ones."""
        with self._lock:
            for worker in (self._worker, self._spare):
                if worker is not None:
                    worker.end()
            self._worker = self._spare = None

    # --- one request ---

    def _request(self, request: Request) -> list[Draft | ProgramError]:
        payload = frames.encode(request)
        try:
            if len(payload) > frames.MAX_REQUEST:
                raise FrameError(f"the scenes take more than {frames.MAX_REQUEST:,} bytes")
            try:
                return self._ask(request, payload)
            except _Bystander:
                # The program did not kill it, and running has no effects: once more does no harm.
                return self._ask(request, payload)
        except FrameError as error:
            return [SolverFailed(f"the solver failed: {error}") for _ in request.scenes]

    def _ask(self, request: Request, payload: bytes) -> list[Draft | ProgramError]:
        """Raises FrameError (_Bystander: the program is not to blame), the worker replaced."""
        worker = self._ready()
        began = time.monotonic()
        left = worker.allow(self._deadline_s + SCENE_S * len(request.scenes))
        try:
            worker.send(payload, left)
            if worker.requests:  # not at its first: who had to wait for it has waited enough
                self._start_spare()  # while the worker is at it, so that nobody waits for this
            largest = len(payload) + frames.MAX_SCENE_REPLY * len(request.scenes)
            results = frames.read_reply(worker.receive(largest, left), request)
        except Closed as error:
            status = self._replace()
            innocent = error.unread or status == -signal.SIGKILL
            raise (_Bystander if innocent else FrameError)(_cause(status)) from None
        except BaseException:  # Ctrl-C too: the next request must not get this one's answer
            self._replace()
            raise
        worker.requests += 1
        worker.busy_s += time.monotonic() - began
        if worker.requests >= self._recycle_requests or worker.busy_s >= RECYCLE_BUSY_S:
            self._replace()
        return results

    # --- the two workers ---

    def _start(self) -> _Worker:
        """The worker for the next request, perhaps not ready yet. Raises FrameError."""
        while self._worker is not None and not self._worker.alive:
            self._replace()
        if self._worker is None:
            self._worker = _Worker(self._module)
        return self._worker

    def _start_spare(self) -> None:
        """See to it that there is a spare; if it cannot start now, there is none for now."""
        if self._spare is not None and not self._spare.alive:
            self._spare.end()
            self._spare = None
        if self._spare is None:
            with contextlib.suppress(FrameError):
                self._spare = _Worker(self._module)

    def _ready(self) -> _Worker:
        """The worker for the next request, ready. Raises FrameError if none gets so far."""
        for _ in range(STARTS):
            worker = self._start()
            try:
                self._greet(worker)
                return worker
            except Closed:
                self._replace()
            except BaseException:
                self._replace()
                raise
        raise FrameError(f"{STARTS} workers in a row did not start")

    def _greet(self, worker: _Worker) -> bool:
        """Wait until a worker is ready; whether its system calls are filtered (if not, warn once).

        Raises FrameError.
        """
        why = worker.await_ready().unfiltered
        if why is not None and not self._warned:
            self._warned = True
            _LOG.warning("programs run in a worker without a system-call filter: %s", why)
        return why is None

    def _replace(self) -> int:
        """End the worker, put the spare in its place, and return how the worker ended."""
        assert self._worker is not None
        status = self._worker.end()
        self._worker, self._spare = self._spare, None
        return status


class _Bystander(FrameError):
    """The worker's end says nothing about the program that it was asked to run."""


class _Worker:
    """One worker process and our end of its socket. Raises FrameError if it cannot be created."""

    def __init__(self, module: str) -> None:
        self.requests = 0
        self.busy_s = 0.0
        self._told: frames.Ready | None = None
        paths = [str(ROOT), *(entry for entry in sys.path if entry)]
        try:
            self._socket, theirs = socket.socketpair()
            boot = _BOOT.format(module=module, descriptor=theirs.fileno())
            with theirs:
                self._process = subprocess.Popen(
                    [sys.executable, "-I", "-S", "-c", boot, "worker", *paths],
                    env={},
                    stdin=subprocess.DEVNULL,
                    stdout=subprocess.DEVNULL,
                    stderr=subprocess.DEVNULL,
                    pass_fds=(theirs.fileno(),),
                    start_new_session=True,  # Ctrl-C in the terminal is for the parent
                )
        except OSError as error:
            raise FrameError(f"no worker can be started: {error}") from None

    @property
    def pid(self) -> int:
        return self._process.pid

    @property
    def alive(self) -> bool:
        return self._process.poll() is None

    def await_ready(self) -> frames.Ready:
        """What it said of itself when it was ready, which this waits for. Raises FrameError."""
        if self._told is None:
            payload = frames.receive(self._socket, frames.MAX_READY, frames.within(START_S))
            self._told = frames.read_ready(payload)
        return self._told

    def allow(self, seconds: float) -> frames.Left:
        """A deadline from now on that its waiting for a processor puts off."""
        by_clock, queued = frames.within(seconds), self._queued_s()
        at_most = frames.within(PATIENCE * seconds)

        def left() -> float:
            return min(by_clock() + self._queued_s() - queued, at_most())

        return left

    def _queued_s(self) -> float:
        """How long it was ready to run and had no processor, in its life; 0 where nobody counts.

        Source: Documentation/scheduler/sched-stats.rst of Linux, /proc/PID/schedstat.
        """
        try:
            return int(Path(f"/proc/{self.pid}/schedstat").read_text().split()[1]) / 1e9
        except (OSError, IndexError, ValueError):
            return 0.0

    def send(self, payload: bytes, left: frames.Left) -> None:
        """Send one request. Raises FrameError."""
        frames.send(self._socket, payload, left)

    def receive(self, largest: int, left: frames.Left) -> bytes:
        """Wait for its reply. Raises FrameError."""
        return frames.receive(self._socket, largest, left)

    def end(self) -> int:
        """End the process at once and collect it; its exit status, negative for a signal.

        One that is dying already keeps the cause it has.
        """
        self._socket.close()
        self._process.kill()
        return self._process.wait()


_CAUSES: dict[int, str] = {
    signal.SIGABRT: "it gave up on these constraints and aborted",
    signal.SIGSEGV: "it crashed",
    signal.SIGBUS: "it crashed",
    signal.SIGILL: "it crashed",
    signal.SIGFPE: "it crashed",
    signal.SIGSYS: "it asked the system for something that is not allowed, and was killed",
    signal.SIGXCPU: "it used up its processor time",
    signal.SIGKILL: "it was killed from outside",
}


def _cause(status: int) -> str:
    """An exit status in plain words."""
    if status >= 0:
        return f"it ended by itself, with status {status}"
    return _CAUSES.get(-status, f"signal {-status} ended it")

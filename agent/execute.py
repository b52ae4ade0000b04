"""Runs programs in a worker process and trusts nothing that comes back.

`Executor` keeps a worker and a warm spare. A worker that dies or misses its deadline is killed,
the spare takes its place, and the caller gets `SolverFailed` as a value: nothing else is known
about that program. The interpreter and the solver run only in the worker.
"""

from __future__ import annotations

import math
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import Self

import msgspec

from agent.errors import NotAllowed, ProgramError, SolverFailed
from agent.language import frames
from agent.language.frames import FrameError, Reply, Request, Result
from agent.messages import Draft, Kind
from agent.program import MAX_LINES, scan
from scene.types import Scene

DEADLINE_S = 1.0
"""Time for one request, plus SCENE_S for each of its scenes."""
SCENE_S = 0.05
START_S = 20.0
"""Time for a new worker to be ready (a loaded machine is slow to start Python)."""
BATCH = 50
"""Scenes in one request; more are sent in several."""
MAX_COMMANDS = 500
MAX_NUMBER = 1e9

ROOT = Path(__file__).resolve().parent.parent
"""Where our own packages lie: a worker starts with no search path but the one it is given."""
_BOOT = "import sys; sys.path[:] = sys.argv[2:]; from agent.language.worker import main; main({})"


class Executor:
    """Runs programs on scenes; thread-safe; a context manager, or `close` it.

    Workers start on the first `run` (or on entering the context), not on construction.
    """

    def __init__(self, deadline_s: float = DEADLINE_S) -> None:
        self._deadline_s = deadline_s
        self._lock = threading.Lock()
        self._worker: _Worker | None = None
        self._spare: _Worker | None = None

    def __enter__(self) -> Self:
        with self._lock:
            self._start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    @property
    def pid(self) -> int:
        """Process id of the worker that takes the next request."""
        with self._lock:
            return self._start().pid

    def run(self, source: str, kind: Kind, scenes: Sequence[Scene]) -> list[Draft | ProgramError]:
        """Run one program on each scene, afresh; one result a scene, an error being a value.

        When the worker dies, all results of its request are SolverFailed.
        """
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
                    worker.kill()
            self._worker = self._spare = None

    def _request(self, request: Request) -> list[Draft | ProgramError]:
        limit = self._deadline_s + SCENE_S * len(request.scenes)
        try:
            reply = self._start().ask(msgspec.json.encode(request), limit)
            return read_reply(reply, request.scenes)
        except FrameError as error:
            self._swap()
            return [SolverFailed(f"the solver failed: {error}") for _ in request.scenes]

    def _start(self) -> _Worker:
        if self._worker is None:
            self._worker = _Worker()
        if self._spare is None:
            self._spare = _Worker()
        return self._worker

    def _swap(self) -> None:
        if self._worker is not None:
            self._worker.kill()
        self._worker, self._spare = self._spare, None
        self._start()


class _Worker:
    """One worker process and our end of its socket."""

    def __init__(self) -> None:
        ours, theirs = socket.socketpair()
        paths = [str(ROOT), *(entry for entry in sys.path if entry)]
        with theirs:
            self._process = subprocess.Popen(
                [sys.executable, "-I", "-S", "-c", _BOOT.format(theirs.fileno()), "worker", *paths],
                env={},
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                pass_fds=(theirs.fileno(),),
                start_new_session=True,  # Ctrl-C in the terminal is for the parent
            )
        self._socket = ours
        self._ready = False

    @property
    def pid(self) -> int:
        return self._process.pid

    def ask(self, payload: bytes, limit_s: float) -> bytes:
        """Send one request and wait for its reply. Raises FrameError."""
        if not self._ready:
            self._await_ready()
        until = time.monotonic() + limit_s
        frames.send(self._socket, payload, until)
        return frames.receive(self._socket, frames.MAX_REPLY, until)

    def _await_ready(self) -> None:
        try:
            frames.receive(self._socket, len(frames.READY), time.monotonic() + START_S)
        except FrameError as error:
            raise FrameError(f"the worker did not start ({error})") from None
        self._ready = True

    def kill(self) -> None:
        """End the process at once and collect it."""
        self._socket.close()
        self._process.kill()
        self._process.wait()


def read_reply(reply: bytes, scenes: Sequence[Scene]) -> list[Draft | ProgramError]:
    """Decode a worker's reply and check every number and name in it. Raises FrameError."""
    try:
        results = msgspec.json.decode(reply, type=Reply).results
    except msgspec.DecodeError as error:
        raise FrameError(f"the reply makes no sense: {error}") from None
    if len(results) != len(scenes):
        raise FrameError(f"{len(results)} results for {len(scenes)} scenes")
    return [_checked(result, scene) for result, scene in zip(results, scenes, strict=True)]


def _checked(result: Result, scene: Scene) -> Draft | ProgramError:
    if (result.draft is None) == (result.failure is None):
        raise FrameError("a result must be either a draft or a failure")
    if result.failure is not None:
        return result.failure.error_value()
    draft = result.draft
    assert draft is not None
    if len(draft.commands) > MAX_COMMANDS:
        raise FrameError(f"{len(draft.commands)} commands")
    waiting = {item.id for item in scene.tray}
    if any(placement.object not in waiting for placement in draft.placements):
        raise FrameError("a placement of something that is not in the tray")
    if len({placement.object for placement in draft.placements}) != len(draft.placements):
        raise FrameError("two placements of one object")
    for command in draft.commands:
        _check_numbers(command.line, command.x, command.y, command.z, command.r)
    for placement in draft.placements:
        _check_numbers(placement.line, placement.x, placement.y)
    return draft


def _check_numbers(line: int, *numbers: float) -> None:
    if not all(math.isfinite(number) and abs(number) <= MAX_NUMBER for number in numbers):
        raise FrameError("a number that is not finite, or far too large")
    if not 0 <= line <= MAX_LINES:
        raise FrameError(f"line {line} of a program of at most {MAX_LINES}")

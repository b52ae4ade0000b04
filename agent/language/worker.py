"""The worker process: parses, interprets and solves programs that nobody trusts.

Started by `agent.execute` with its own socket pair and nothing else: empty environment, standard
streams on /dev/null, own session. It rehearses, shuts itself in (resource limits, then a filter
on its system calls, `agent.language.seccomp`), says that it is ready, and answers one `Request`
after another until the socket closes. It holds no device, no secret and no state.

Protects against: a solver that aborts the process; endless computation (the parent's deadline,
and a limit on processor time); memory that grows; and, where the filter is on, a program that
broke out of the interpreter and wants files, processes, the network or another process.
Does not protect against: a program that broke out and lies in the answers, its own and, until the
worker is replaced, those to later programs (the parent checks every number and approves every
motion); what the filter cannot stop. Without the filter (another system than Linux, a kernel that
refuses) a program that broke out could do what this user can, but for opening files. The worker
says which of the two it is, and the executor passes it on.

When the parent ends, the socket closes and the worker with it, at once or after the request that
it is at: its processor time is limited for its whole life, which no program can renew. The kernel
could kill it earlier (PR_SET_PDEATHSIG), but means the *thread* that started it, and that one may
well end before the executor does.
"""

from __future__ import annotations

import gc
import os
import resource
import socket

from agent.errors import LimitReached, ProgramError, ProgramFailed
from agent.language import frames, seccomp
from agent.language.cassowary import Cassowary
from agent.language.frames import Failure, FrameError, Ready, Reply, Request, Result
from agent.language.interpret import Code, compile_program, execute
from agent.language.prelude import prelude
from agent.messages import Draft, Kind
from agent.program import read_tree, resolve
from scene.types import Scene, SceneObject, identifiers

CPU_SECONDS = 20
"""Processor time of a worker's life; the executor lets it go well before."""
LIMITS = (
    (resource.RLIMIT_AS, 256 * 2**20),
    (resource.RLIMIT_NOFILE, 0),  # what is open stays open; nothing can be opened
    (resource.RLIMIT_NPROC, 0),
    (resource.RLIMIT_FSIZE, 0),
    (resource.RLIMIT_CORE, 1),  # unlike 0, also keeps a dump from being piped to a program
)


def main(descriptor: int) -> None:
    """Serve requests on an inherited socket until it closes, then end the process.

    Whoever imports this module for that turns garbage collection off before: it starts faster.
    """
    status = 1
    try:
        sock = socket.socket(fileno=descriptor)
        rehearse()
        ready = shut_in()
        gc.freeze()  # what is there by now stays: collections need not look at it again
        gc.enable()
        serve(sock, ready)
        status = 0
    finally:
        os._exit(status)  # Python's own way out does more than the filter allows


def serve(sock: socket.socket, ready: Ready) -> None:
    """Say that the worker is ready, and answer until the socket closes."""
    try:
        frames.send(sock, frames.encode(ready))
        while True:
            frames.send(sock, answer(frames.receive(sock, frames.MAX_REQUEST)))
    except FrameError:
        return


def answer(request: bytes) -> bytes:
    """One request frame -> one reply frame."""
    return frames.encode(Reply(run(frames.read_request(request))))


def run(asked: Request) -> tuple[Result, ...]:
    """One result a scene; the text is parsed once, and compiled once for each set of names."""
    try:
        tree = read_tree(asked.source)
    except ProgramError as error:
        return (Result(failure=Failure.of(error)),) * len(asked.scenes)
    compiled: dict[frozenset[str], Code] = {}

    def run_one(scene: Scene) -> Result:
        try:
            names = frozenset(identifiers(scene))
            if names not in compiled:
                program = resolve(tree, asked.source, asked.kind, names)
                compiled[names] = compile_program(program)
            return Result(draft=_plausible(execute(compiled[names], scene, Cassowary().solver)))
        except ProgramError as error:
            return Result(failure=Failure.of(error))
        except MemoryError:
            return Result(failure=Failure.of(LimitReached("the program needs too much memory")))

    return tuple(run_one(scene) for scene in asked.scenes)


def _plausible(draft: Draft) -> Draft:
    """The draft, if the executor will take it. Raises ProgramFailed."""
    for command in draft.commands:
        if not frames.is_position(command.x, command.y, command.z, command.r):
            raise ProgramFailed("robot.move goes far outside the world", command.line)
    return draft


# --- before the first request --------------------------------------------------------------------

_APPLE = SceneObject(id="apple", name="apple", x=0.0, y=0.0, width=0.1, height=0.1, tall=0.1)
_PEAR = SceneObject(id="pear", name="pear", width=0.1, height=0.1, tall=0.1, on="tray")
REHEARSAL: tuple[tuple[Kind, str], ...] = (
    ("manipulate", "if apple:\n    robot.move(apple.x, 0, 0.5, 0)"),
    ("manipulate", "robot.move(aple.x, 0, 0.5, 0)"),
    ("manipulate", "robot.move(apple.x"),
    ("arrange", "solver.addConstraint(pear.x + Variable('gap') >= apple.x)\nsolver.solve()"),
    ("arrange", "solver.addConstraint(pear.x == 0)\nsolver.addConstraint(pear.x == 0.5)"),
)


def rehearse() -> None:
    """Run a program of each kind: what is loaded on first use cannot be loaded later."""
    prelude()  # from a file
    scene = Scene(objects=(_APPLE,), tray=(_PEAR,))
    for kind, source in REHEARSAL:
        answer(frames.encode(Request(source, kind, (scene,))))


def shut_in() -> Ready:
    """Limit resources and filter system calls, for good; what could not be done, in `Ready`."""
    for what, most in LIMITS:
        _limit(what, most, most)
    _limit(resource.RLIMIT_CPU, CPU_SECONDS, CPU_SECONDS + 1)  # a signal that says so, then death
    try:
        seccomp.install()
    except (OSError, NotImplementedError) as error:
        return Ready(unfiltered=str(error))
    return Ready()


def _limit(what: int, soft: int, hard: int) -> None:
    """Lower a limit to at most this; what a system does not limit stays as it is."""
    _, most = resource.getrlimit(what)
    if most != resource.RLIM_INFINITY:
        soft, hard = min(soft, most), min(hard, most)
    try:
        resource.setrlimit(what, (soft, hard))
    except (OSError, ValueError):
        return

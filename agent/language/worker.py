"""The worker process: parses, interprets and solves programs that nobody trusts.

Started by `agent.execute` with its own socket pair and nothing else: empty environment, standard
streams on /dev/null, no file to write, no process to start, little memory. It answers one
`Request` after another until the socket closes. It holds no device, no secret and no state.

Protects against: a solver that aborts the process, endless computation (the parent's deadline,
and a limit on processor time should the parent be gone), memory that grows.
Not there yet: a system-call filter (`harden` is its place). A program that broke out of the
interpreter could still read files of this user.
"""

from __future__ import annotations

import gc
import resource
import socket

import msgspec

from agent.errors import LimitReached, ProgramError
from agent.language.cassowary import Cassowary
from agent.language.frames import (
    MAX_REQUEST,
    READY,
    Failure,
    FrameError,
    Reply,
    Request,
    Result,
    receive,
    send,
)
from agent.language.interpret import Code, compile_program, execute
from agent.program import read_tree, resolve
from scene.types import Scene, identifiers

MAX_MEMORY = 512 * 2**20
MAX_FILES = 16
CPU_SECONDS = 20
"""Processor time for one request, for a worker whose parent is no longer there to end it."""


def main(descriptor: int) -> None:
    """Serve requests on an inherited socket until it closes."""
    sock = socket.socket(fileno=descriptor)
    limit_resources()
    harden()
    gc.freeze()  # what was imported stays: collections need not look at it again
    try:
        send(sock, READY)
        while True:
            renew_cpu_time()
            send(sock, answer(receive(sock, MAX_REQUEST)))
    except FrameError:
        return


def limit_resources() -> None:
    """Cap memory, files, processes and core dumps of this process, for good."""
    for what, most in (
        (resource.RLIMIT_AS, MAX_MEMORY),
        (resource.RLIMIT_NOFILE, MAX_FILES),
        (resource.RLIMIT_NPROC, 0),
        (resource.RLIMIT_FSIZE, 0),
        (resource.RLIMIT_CORE, 0),
    ):
        _, hard = resource.getrlimit(what)
        capped = most if hard == resource.RLIM_INFINITY else min(most, hard)
        resource.setrlimit(what, (capped, capped))


def renew_cpu_time() -> None:
    """Allow another CPU_SECONDS from now."""
    used = resource.getrusage(resource.RUSAGE_SELF)
    soft = int(used.ru_utime + used.ru_stime) + CPU_SECONDS
    _, hard = resource.getrlimit(resource.RLIMIT_CPU)
    if hard == resource.RLIM_INFINITY or soft < hard:
        resource.setrlimit(resource.RLIMIT_CPU, (soft, hard))


def harden() -> None:
    """The place for the system-call filter; nothing is filtered yet."""


def answer(request: bytes) -> bytes:
    """One request frame -> one reply frame."""
    asked = msgspec.json.decode(request, type=Request)
    return msgspec.json.encode(Reply(run(asked)))


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
            return Result(draft=execute(compiled[names], scene, Cassowary().solver))
        except ProgramError as error:
            return Result(failure=Failure.of(error))
        except MemoryError:
            return Result(failure=Failure.of(LimitReached("the program needs too much memory")))

    return tuple(run_one(scene) for scene in asked.scenes)

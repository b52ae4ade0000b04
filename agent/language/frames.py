"""The words between the executor and its worker: length-prefixed JSON on a socket pair.

A frame is four bytes (big-endian length) and that many bytes of JSON; the receiver gives the
largest length it takes. Never pickle, never standard output.
"""

from __future__ import annotations

import socket
import struct
import time
from typing import Literal

import msgspec

from agent.errors import (
    LimitReached,
    NotAllowed,
    ProgramError,
    ProgramFailed,
    SolverFailed,
    Unsatisfiable,
)
from agent.messages import Draft, Kind
from scene.types import Scene

MAX_REQUEST = 16 * 2**20
MAX_REPLY = 16 * 2**20
READY = b'"ready"'
"""The first frame of a worker that is ready to work."""

_LENGTH = struct.Struct(">I")

ErrorName = Literal["NotAllowed", "ProgramFailed", "Unsatisfiable", "LimitReached", "SolverFailed"]
_ERRORS: dict[ErrorName, type[ProgramError]] = {
    "NotAllowed": NotAllowed,
    "ProgramFailed": ProgramFailed,
    "Unsatisfiable": Unsatisfiable,
    "LimitReached": LimitReached,
    "SolverFailed": SolverFailed,
}


class Request(msgspec.Struct, frozen=True):
    """One program, run on each of these scenes."""

    source: str
    kind: Kind
    scenes: tuple[Scene, ...]


class Failure(msgspec.Struct, frozen=True):
    """A ProgramError as plain words."""

    error: ErrorName
    reason: str
    line: int
    column: int

    @staticmethod
    def of(error: ProgramError) -> Failure:
        """The words for an error; kinds that have none are the nearest base's."""
        name = next(n for n, kind in _ERRORS.items() if kind is type(error))
        return Failure(name, error.reason, error.line, error.column)

    def error_value(self) -> ProgramError:
        """The error these words stand for."""
        return _ERRORS[self.error](self.reason, self.line, self.column)


class Result(msgspec.Struct, frozen=True):
    """The outcome on one scene: exactly one of the two is set."""

    draft: Draft | None = None
    failure: Failure | None = None


class Reply(msgspec.Struct, frozen=True):
    """One result a scene, in order."""

    results: tuple[Result, ...]


class FrameError(Exception):
    """The other end closed, sent too much, or was too slow."""


def send(sock: socket.socket, payload: bytes, until: float | None = None) -> None:
    """Write one frame. ``until`` is a deadline on ``time.monotonic()``. Raises FrameError."""
    try:
        _arm(sock, until)
        sock.sendall(_LENGTH.pack(len(payload)) + payload)
    except OSError as error:
        raise FrameError(f"cannot send: {error}") from None


def receive(sock: socket.socket, largest: int, until: float | None = None) -> bytes:
    """Read one frame of at most ``largest`` bytes. Raises FrameError."""
    (length,) = _LENGTH.unpack(_exactly(sock, _LENGTH.size, until))
    if length > largest:
        raise FrameError(f"a frame of {length} bytes; {largest} is the limit")
    return _exactly(sock, length, until)


def _exactly(sock: socket.socket, count: int, until: float | None) -> bytes:
    data = bytearray()
    while len(data) < count:
        try:
            _arm(sock, until)
            part = sock.recv(min(count - len(data), 1 << 20))
        except TimeoutError:
            raise FrameError("no answer within the deadline") from None
        except OSError as error:
            raise FrameError(f"cannot receive: {error}") from None
        if not part:
            raise FrameError("the other end closed")
        data += part
    return bytes(data)


def _arm(sock: socket.socket, until: float | None) -> None:
    if until is None:
        return
    left = until - time.monotonic()
    if left <= 0:
        raise TimeoutError
    sock.settimeout(left)

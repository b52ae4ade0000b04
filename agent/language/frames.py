"""The words between the executor and its worker: length-prefixed JSON on a socket pair.

A frame is four bytes (big-endian length) and that many bytes of JSON; the receiver gives the
largest length it takes. Never pickle, never standard output. What a worker sends may come from a
program that broke out: every reply is FrameError or a value that was checked to the last number.
"""

from __future__ import annotations

import contextlib
import socket
import struct
import time
from collections.abc import Callable, Sequence
from functools import partial
from typing import Literal, TypeVar

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
from agent.program import MAX_CHARACTERS, MAX_LINES
from scene.types import Scene

MAX_REQUEST = 16 * 2**20
MAX_SCENE_REPLY = 100_000
"""Bytes of one scene's result, beyond what it repeats of the request: MAX_COMMANDS fill 80,000."""
MAX_READY = 1_000
MAX_COMMANDS = 500
MAX_STEPS = 100_000
MAX_REASON = 10_000
FARTHEST = 1e9
"""Largest number of a position (table units, radians): any arm and any table are far smaller."""

T = TypeVar("T")
_LENGTH = struct.Struct(">I")
_CHUNK = 2**16

ErrorName = Literal["NotAllowed", "ProgramFailed", "Unsatisfiable", "LimitReached", "SolverFailed"]
_ERRORS: dict[ErrorName, type[ProgramError]] = {
    "NotAllowed": NotAllowed,
    "ProgramFailed": ProgramFailed,
    "Unsatisfiable": Unsatisfiable,
    "LimitReached": LimitReached,
    "SolverFailed": SolverFailed,
}


# --- what is said --------------------------------------------------------------------------------


class Ready(msgspec.Struct, frozen=True):
    """A worker's first frame. ``unfiltered`` says why its system calls are not filtered, if so."""

    unfiltered: str | None = None


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
        return Failure(name, error.reason[:MAX_REASON], max(0, error.line), max(0, error.column))

    def error_value(self) -> ProgramError:
        """The error these words stand for."""
        return _ERRORS[self.error](self.reason, self.line, self.column)


class Result(msgspec.Struct, frozen=True, omit_defaults=True):
    """The outcome on one scene: exactly one of the two is set."""

    draft: Draft | None = None
    failure: Failure | None = None


class Reply(msgspec.Struct, frozen=True):
    """One result a scene, in order."""

    results: tuple[Result, ...]


# --- how it travels ------------------------------------------------------------------------------


class FrameError(Exception):
    """What came, or did not come, from the other end is no answer."""


class TooLate(FrameError):
    """The deadline passed."""


class Closed(FrameError):
    """The other end is gone. ``unread``: it was so before it had read all that was sent to it."""

    def __init__(self, unread: bool) -> None:
        super().__init__("the other end closed")
        self.unread = unread


Left = Callable[[], float]
"""Seconds that may still be waited, asked again when they are over; none left: too late."""


def within(seconds: float) -> Left:
    """A deadline so many seconds from now."""
    until = time.monotonic() + seconds
    return lambda: until - time.monotonic()


def send(sock: socket.socket, payload: bytes, left: Left | None = None) -> None:
    """Write one frame. Raises FrameError."""
    data = memoryview(_LENGTH.pack(len(payload)) + payload)
    try:
        while data:
            data = data[_patiently(partial(sock.send, data), sock, left) :]
    except TimeoutError:
        raise TooLate("the request was not taken within the deadline") from None
    except OSError:
        raise Closed(unread=True) from None


def receive(sock: socket.socket, largest: int, left: Left | None = None) -> bytes:
    """Read one frame of at most ``largest`` bytes: most come in one piece. Raises FrameError."""
    data = _some(sock, _CHUNK, left)
    while len(data) < _LENGTH.size:
        data += _some(sock, _CHUNK, left)
    (length,) = _LENGTH.unpack_from(data)
    if length > largest:
        raise FrameError(f"a frame of {length:,} bytes; {largest:,} is the limit")
    whole = _LENGTH.size + length
    if len(data) < whole:
        parts = bytearray(data)
        while len(parts) < whole:
            parts += _some(sock, min(whole - len(parts), 2**20), left)
        data = bytes(parts)
    if len(data) > whole:
        raise FrameError("more than one frame at a time")
    return data[_LENGTH.size :]


def _some(sock: socket.socket, most: int, left: Left | None) -> bytes:
    try:
        data = _patiently(partial(sock.recv, most), sock, left)
    except TimeoutError:
        raise TooLate("no answer within the deadline") from None
    except OSError:  # a reset: it closed with bytes of ours unread
        raise Closed(unread=True) from None
    if not data:
        raise Closed(unread=False)
    return data


def _patiently(step: Callable[[], T], sock: socket.socket, left: Left | None) -> T:
    """Take one step of a conversation, waiting for as long as ``left`` says. Raises OSError."""
    while left is not None:
        seconds = left()
        if seconds <= 0:
            raise TimeoutError
        sock.settimeout(seconds)
        with contextlib.suppress(TimeoutError):
            return step()
    return step()


# --- how it is read ------------------------------------------------------------------------------

_ENCODER = msgspec.json.Encoder()
_READY = msgspec.json.Decoder(Ready)
_REQUEST = msgspec.json.Decoder(Request)
_REPLY = msgspec.json.Decoder(Reply)


def encode(message: Ready | Request | Reply) -> bytes:
    """A message as the payload of a frame."""
    return _ENCODER.encode(message)


def read_request(payload: bytes) -> Request:
    """The executor's own words: checked for their types only. Raises msgspec.DecodeError."""
    return _REQUEST.decode(payload)


def read_ready(payload: bytes) -> Ready:
    """A worker's first frame. Raises FrameError."""
    return _decode(_READY, payload)


def read_reply(payload: bytes, request: Request) -> list[Draft | ProgramError]:
    """A worker's reply, every name and number in it checked. Raises FrameError."""
    results = _decode(_REPLY, payload).results
    if len(results) != len(request.scenes):
        raise FrameError(f"{len(results)} results for {len(request.scenes)} scenes")
    return [
        _checked(result, request.kind, scene)
        for result, scene in zip(results, request.scenes, strict=True)
    ]


def _decode(decoder: msgspec.json.Decoder[T], payload: bytes) -> T:
    """A message, if these are the very bytes in which we would write it.

    That leaves no room for a second reading: no field twice, none unknown, no number as text.
    """
    try:
        message = decoder.decode(payload)
        again = _ENCODER.encode(message)
    except (msgspec.MsgspecError, ValueError, RecursionError) as error:
        raise FrameError(f"the reply makes no sense: {str(error)[:200]}") from None
    if again != payload:
        raise FrameError("the reply is not written as a worker writes")
    return message


def _checked(result: Result, kind: Kind, scene: Scene) -> Draft | ProgramError:
    draft, failure = result.draft, result.failure
    if failure is not None and draft is None:
        _check_place(failure.line, failure.column)
        if len(failure.reason) > MAX_REASON:
            raise FrameError("a reason that is far too long")
        return failure.error_value()
    if draft is None or failure is not None:
        raise FrameError("a result must be either a draft or a failure")
    if draft.commands if kind == "arrange" else draft.placements:
        raise FrameError(f"an {kind} program cannot have done that")
    if len(draft.commands) > MAX_COMMANDS:
        raise FrameError(f"{len(draft.commands):,} commands")
    if not 0 <= draft.steps <= MAX_STEPS:
        raise FrameError(f"{draft.steps} steps")
    _check_placed([placement.object for placement in draft.placements], scene)
    for command in draft.commands:
        if not is_position(command.x, command.y, command.z, command.r):
            raise FrameError("a number that is far too large")
        _check_place(command.line)
        if not 0 <= command.statement <= MAX_STEPS:
            raise FrameError(f"statement {command.statement}")
    for placement in draft.placements:
        if not is_position(placement.x, placement.y):
            raise FrameError("a number that is far too large")
        _check_place(placement.line)
    return draft


def _check_placed(ids: Sequence[str], scene: Scene) -> None:
    if not ids:
        return
    if not {item.id for item in scene.tray}.issuperset(ids):
        raise FrameError("a placement of something that is not in the tray")
    if len(set(ids)) != len(ids):
        raise FrameError("two placements of one object")


def _check_place(line: int, column: int = 0) -> None:
    """Python places some errors on the line after the last one."""
    if not (0 <= line <= MAX_LINES + 1 and 0 <= column <= MAX_CHARACTERS):
        raise FrameError(f"line {line}, column {column} of a program of {MAX_LINES} lines at most")


def is_position(x: float, y: float, z: float = 0.0, r: float = 0.0) -> bool:
    """Whether these are numbers (finite, not absurdly large) that can be a place."""
    most = FARTHEST  # any comparison with NaN is false
    return -most <= x <= most and -most <= y <= most and -most <= z <= most and -most <= r <= most

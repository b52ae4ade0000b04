"""What every bus is made of: a subscription's own thread, and how bytes become messages and
errors become replies. Shared by `MemoryBus` and `ZenohBus`, so that both behave alike.
"""

from __future__ import annotations

import logging
import threading
from collections import deque
from collections.abc import Callable
from types import TracebackType
from typing import TypeVar

import msgspec

from agent.errors import ArmchatError, BusError, Declined
from agent.messages import ErrorReply
from agent.wire import JSON, RAW, BadPayload, Message, decode, encode

log = logging.getLogger(__name__)

M = TypeVar("M")
Handler = Callable[[str, Message], None]
RawHandler = Callable[[str, bytes, bytes], None]
Server = Callable[[str, Message | None], Message]
RawServer = Callable[[str], tuple[bytes, bytes]]
"""Answers a query on a key with bytes and their metadata as JSON."""
Watcher = Callable[[str, bool], None]

BACKLOG = 4096
"""Messages a subscription holds for a slow handler before it drops the oldest."""


class Closing:
    """Something declared on a bus; `close` undoes it, any number of times."""

    def __init__(self, undo: Callable[[], None]) -> None:
        self._undo: Callable[[], None] | None = undo
        self._lock = threading.Lock()

    def close(self) -> None:
        """Undo the declaration; its handler is not called afterwards."""
        with self._lock:
            undo, self._undo = self._undo, None
        if undo is not None:
            undo()

    def __enter__(self) -> Closing:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        at: TracebackType | None,
    ) -> None:
        self.close()


class Declarations:
    """What a bus has declared and not undone yet; closing undoes it in reverse. Thread-safe."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._open: list[Closing] = []

    def add(self, undo: Callable[[], None]) -> Closing:
        """A handle that undoes one declaration, once, and forgets it."""

        def once() -> None:
            with self._lock:
                self._open = [other for other in self._open if other is not closing]
            undo()

        closing = Closing(once)
        with self._lock:
            self._open.append(closing)
        return closing

    def close(self) -> None:
        """Undo everything that is still declared, the last first."""
        with self._lock:
            still, self._open = self._open, []
        for closing in reversed(still):
            closing.close()


class Inbox:
    """A subscription's own thread and queue: handlers run here, never on the bus's threads."""

    def __init__(self, name: str, handle: Callable[[str, object], None], latest: bool) -> None:
        self._handle = handle
        self._latest = latest
        self._items: deque[tuple[str, object]] = deque()
        self._newest: dict[str, object] = {}
        self._wake = threading.Condition()
        self._closed = False
        self._thread = threading.Thread(target=self._work, name=f"inbox {name}", daemon=True)

    def start(self) -> None:
        """Start the thread."""
        self._thread.start()

    def put(self, key: str, item: object) -> None:
        """Hand over an item; returns at once."""
        with self._wake:
            if self._closed:
                return
            if self._latest:
                self._newest[key] = item
            else:
                if len(self._items) >= BACKLOG:
                    log.warning("%s: slow reader, a message was dropped", self._thread.name)
                    self._items.popleft()
                self._items.append((key, item))
            self._wake.notify()

    def close(self) -> None:
        """Stop calling the handler; waits for a call in progress (not from within it)."""
        with self._wake:
            self._closed = True
            self._wake.notify()
        if threading.current_thread() is not self._thread and self._thread.is_alive():
            self._thread.join(timeout=2.0)

    def _next(self) -> tuple[str, object] | None:
        with self._wake:
            while not (self._closed or self._items or self._newest):
                self._wake.wait()
            if self._closed:
                return None
            if self._items:
                return self._items.popleft()
            key = next(iter(self._newest))
            return key, self._newest.pop(key)

    def _work(self) -> None:
        while (entry := self._next()) is not None:
            try:
                self._handle(*entry)
            except Exception:
                log.exception("%s: handler failed on %s", self._thread.name, entry[0])


def decoding(handler: Handler) -> Callable[[str, object], None]:
    """A handler of (bytes, encoding) pairs that passes messages on and logs anything else."""

    def handle(key: str, item: object) -> None:
        assert isinstance(item, Sample)
        if item.encoding != JSON:
            log.error("%s: refused, encoding %s is not %s", key, item.encoding, JSON)
            return
        try:
            message = decode(item.data)
        except BadPayload as error:
            log.error("%s: refused, %s", key, error)
            return
        handler(key, message)

    return handle


def raw(handler: RawHandler) -> Callable[[str, object], None]:
    """A handler of samples that passes bytes and attachment on."""

    def handle(key: str, item: object) -> None:
        assert isinstance(item, Sample)
        handler(key, item.data, item.attachment)

    return handle


class Sample(msgspec.Struct, frozen=True):
    """What travels: bytes, their encoding, their metadata; ``refusal``: it is an ErrorReply."""

    data: bytes
    encoding: str = JSON
    attachment: bytes = b""
    refusal: bool = False


Replier = Callable[[str, Sample | None], Sample]
"""What a query on a key is answered with; never raises."""


def answering(handler: Server, wildcard: bool) -> Replier:
    """A server of messages as a `Replier`."""

    def reply(key: str, request: Sample | None) -> Sample:
        made = answer(key, request, handler, wildcard)
        return Sample(encode(made), refusal=isinstance(made, ErrorReply))

    return reply


def answering_raw(handler: RawServer) -> Replier:
    """A server of bytes that are no message as a `Replier`."""

    def reply(key: str, request: Sample | None) -> Sample:
        try:
            if "*" in key:
                raise Declined("wildcard", f"{key} names more than one service")
            data, attachment = handler(key)
        except Exception as error:
            return Sample(encode(refusal(key, error)), refusal=True)
        return Sample(data, RAW, attachment)

    return reply


def answer(key: str, request: Sample | None, handler: Server, wildcard: bool) -> Message:
    """Run a server's handler; every error becomes an ErrorReply. Never raises."""
    try:
        if "*" in key and not wildcard:
            return ErrorReply("wildcard", f"{key} names more than one service")
        if request is not None and request.encoding != JSON:
            return ErrorReply("bad_payload", f"encoding {request.encoding} is not {JSON}")
        return handler(key, None if request is None else decode(request.data))
    except Exception as error:
        return refusal(key, error)


def refusal(key: str, error: Exception) -> ErrorReply:
    """What a server's error is told as; one that nobody meant is logged."""
    if isinstance(error, BadPayload):
        return ErrorReply("bad_payload", str(error))
    if isinstance(error, Declined):
        return ErrorReply(error.code, str(error))
    if isinstance(error, ArmchatError):
        return ErrorReply(type(error).__name__, str(error))
    log.error("%s: the service failed", key, exc_info=error)
    return ErrorReply("internal", f"{type(error).__name__}: {error}")


def unpack_raw(key: str, reply: Sample) -> tuple[bytes, bytes]:
    """Bytes and metadata of a reply. Raises Declined for an ErrorReply, BusError for a message."""
    if reply.refusal:
        unpack(key, decode(reply.data), ErrorReply)
    if reply.encoding == JSON:
        raise BusError(f"{key} answered with a message, not with raw bytes")
    return reply.data, reply.attachment


def unpack(key: str, reply: Message, reply_type: type[M]) -> M:
    """The reply as what was asked for. Raises Declined for an ErrorReply, BusError for another."""
    if isinstance(reply, ErrorReply):
        raise Declined(reply.code, reply.text)
    if not isinstance(reply, reply_type):
        raise BusError(f"{key} answered with {type(reply).__name__}, not {reply_type.__name__}")
    return reply

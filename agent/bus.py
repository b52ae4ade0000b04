"""The bus: publish, subscribe, serve, ask, tokens. One protocol; `MemoryBus` here (same process)
and `ZenohBus` in `agent.bus_zenoh`, with the same semantics: messages travel as JSON bytes,
handlers run on a thread of their own subscription and never stall another one.

Readiness is a token (`token` declared last, `wait_for` it); nobody sleeps. The keys and the
delivery guarantees are in `agent.wire`.
"""

from __future__ import annotations

import threading
from concurrent.futures import Future, ThreadPoolExecutor
from concurrent.futures import TimeoutError as FutureTimeout
from typing import Protocol, TypeVar

from agent.errors import NoAnswer, NoService
from agent.inbox import (
    Closing,
    Declarations,
    Handler,
    Inbox,
    RawHandler,
    RawServer,
    Replier,
    Sample,
    Server,
    Watcher,
    answering,
    answering_raw,
    decoding,
    raw,
    unpack,
    unpack_raw,
)
from agent.wire import Delivery, Keys, Message, decode, delivery, encode, matches

__all__ = ["Bus", "Closing", "Handler", "MemoryBus", "MemoryHub", "wait_for"]

M = TypeVar("M")


class Bus(Protocol):
    """What services and clients need of a bus. All methods may be called from any thread."""

    @property
    def keys(self) -> Keys:
        """The key expressions under this bus's prefix."""
        ...

    def publish(self, key: str, message: Message, *, qos: Delivery | None = None) -> None:
        """Send to whoever listens; ``qos`` is the key's own `delivery` if not given."""
        ...

    def publish_raw(
        self,
        key: str,
        data: bytes,
        *,
        encoding: str = "image/jpeg",
        attachment: bytes = b"",
        qos: Delivery | None = None,
    ) -> None:
        """Send bytes that are no message (pictures); ``attachment`` is their metadata as JSON."""
        ...

    def subscribe(self, key_expr: str, handler: Handler, *, latest: bool = False) -> Closing:
        """Call ``handler(key, message)`` in order; ``latest``: only the newest a key counts.

        A latched key delivers its last message at once. What is no message is logged, not passed.
        """
        ...

    def subscribe_raw(self, key_expr: str, handler: RawHandler, *, latest: bool = True) -> Closing:
        """Call ``handler(key, data, attachment)`` for pictures and the like."""
        ...

    def serve(
        self, key_expr: str, handler: Server, *, workers: int = 2, wildcard: bool = False
    ) -> Closing:
        """Answer queries with ``handler(key, request or None)`` on ``workers`` threads.

        Whatever it raises becomes an `ErrorReply`: `Declined` with its code, other errors of
        armchat with their class's name, anything else as ``internal``.
        """
        ...

    def ask(
        self, key: str, request: Message | None, reply_type: type[M], timeout: float = 5.0
    ) -> M:
        """Query and wait (seconds). Raises NoService, Declined, NoAnswer, BusError."""
        ...

    def serve_raw(self, key_expr: str, handler: RawServer) -> Closing:
        """Answer queries with bytes that are no message (pictures), and their metadata as JSON.

        Errors as with `serve`; one query at a time.
        """
        ...

    def ask_raw(self, key: str, timeout: float = 5.0) -> tuple[bytes, bytes]:
        """Query for bytes and metadata. Raises NoService, Declined, NoAnswer, BusError."""
        ...

    def token(self, key: str) -> Closing:
        """Declare a liveliness token: it is gone when closed, or when this process dies."""
        ...

    def watch(self, key_expr: str, handler: Watcher) -> Closing:
        """Call ``handler(key, alive)`` for tokens that are there, come and go."""
        ...

    def alive(self, key_expr: str, timeout: float = 2.0) -> tuple[str, ...]:
        """Keys of the tokens that are there now, sorted."""
        ...

    def sibling(self) -> Bus:
        """Another bus to the same place with its own link, so that neither stalls the other."""
        ...

    def close(self) -> None:
        """Undo everything declared here. Always call it: a bus holds threads."""
        ...


def wait_for(bus: Bus, key_expr: str, timeout: float = 5.0) -> str:
    """Wait (seconds) until a token is there; return its key. Raises NoService."""
    found: Future[str] = Future()
    lock = threading.Lock()

    def seen(key: str, alive: bool) -> None:
        with lock:
            if alive and not found.done():
                found.set_result(key)

    with bus.watch(key_expr, seen):
        try:
            return found.result(timeout)
        except FutureTimeout:
            raise NoService(f"nobody is ready on {key_expr} after {timeout:g} s") from None


class MemoryHub:
    """What the MemoryBuses of one process share: who listens, serves and lives there."""

    def __init__(self) -> None:
        self.lock = threading.RLock()
        self.inboxes: list[tuple[str, Inbox]] = []
        self.servers: list[tuple[str, Replier, ThreadPoolExecutor]] = []
        self.tokens: dict[str, int] = {}
        self.watchers: list[tuple[str, Inbox]] = []
        self.latched: dict[str, Sample] = {}


class MemoryBus:
    """A bus within one process; buses that share a `MemoryHub` are connected."""

    def __init__(self, keys: Keys | None = None, hub: MemoryHub | None = None) -> None:
        self._keys = keys or Keys()
        self._hub = hub or MemoryHub()
        self._declared = Declarations()
        self._latched: set[str] = set()

    @property
    def keys(self) -> Keys:
        """See `Bus`."""
        return self._keys

    def publish(self, key: str, message: Message, *, qos: Delivery | None = None) -> None:
        """See `Bus`."""
        self._send(key, Sample(encode(message)), qos or delivery(key))

    def publish_raw(
        self,
        key: str,
        data: bytes,
        *,
        encoding: str = "image/jpeg",
        attachment: bytes = b"",
        qos: Delivery | None = None,
    ) -> None:
        """See `Bus`."""
        self._send(key, Sample(data, encoding, attachment), qos or delivery(key))

    def _send(self, key: str, sample: Sample, qos: Delivery) -> None:
        with self._hub.lock:
            if qos.latched:
                self._hub.latched[key] = sample
                self._latched.add(key)
            for expression, inbox in self._hub.inboxes:
                if matches(expression, key):
                    inbox.put(key, sample)

    def subscribe(self, key_expr: str, handler: Handler, *, latest: bool = False) -> Closing:
        """See `Bus`."""
        return self._listen(key_expr, Inbox(key_expr, decoding(handler), latest))

    def subscribe_raw(self, key_expr: str, handler: RawHandler, *, latest: bool = True) -> Closing:
        """See `Bus`."""
        return self._listen(key_expr, Inbox(key_expr, raw(handler), latest))

    def _listen(self, key_expr: str, inbox: Inbox) -> Closing:
        entry = (key_expr, inbox)
        inbox.start()
        with self._hub.lock:
            self._hub.inboxes.append(entry)
            for key, sample in self._hub.latched.items():
                if matches(key_expr, key):
                    inbox.put(key, sample)

        def undo() -> None:
            with self._hub.lock:
                self._hub.inboxes.remove(entry)
            inbox.close()

        return self._declared.add(undo)

    def serve(
        self, key_expr: str, handler: Server, *, workers: int = 2, wildcard: bool = False
    ) -> Closing:
        """See `Bus`."""
        return self._serve(key_expr, answering(handler, wildcard), workers)

    def serve_raw(self, key_expr: str, handler: RawServer) -> Closing:
        """See `Bus`."""
        return self._serve(key_expr, answering_raw(handler), 1)

    def _serve(self, key_expr: str, reply: Replier, workers: int) -> Closing:
        pool = ThreadPoolExecutor(workers, thread_name_prefix=f"serve {key_expr}")
        entry = (key_expr, reply, pool)
        with self._hub.lock:
            self._hub.servers.append(entry)

        def undo() -> None:
            with self._hub.lock:
                self._hub.servers.remove(entry)
            pool.shutdown(wait=False, cancel_futures=True)

        return self._declared.add(undo)

    def ask(
        self, key: str, request: Message | None, reply_type: type[M], timeout: float = 5.0
    ) -> M:
        """See `Bus`."""
        sample = None if request is None else Sample(encode(request))
        return unpack(key, decode(self._ask(key, sample, timeout).data), reply_type)

    def ask_raw(self, key: str, timeout: float = 5.0) -> tuple[bytes, bytes]:
        """See `Bus`."""
        return unpack_raw(key, self._ask(key, None, timeout))

    def _ask(self, key: str, request: Sample | None, timeout: float) -> Sample:
        with self._hub.lock:
            found = [entry for entry in self._hub.servers if matches(entry[0], key)]
            if not found:
                raise NoService(f"nobody serves {key}")
            _, reply, pool = found[0]
            future = pool.submit(reply, key, request)
        try:
            return future.result(timeout)
        except FutureTimeout:
            raise NoAnswer(f"{key} did not answer within {timeout:g} s") from None

    def token(self, key: str) -> Closing:
        """See `Bus`."""
        self._count(key, +1)
        return self._declared.add(lambda: self._count(key, -1))

    def _count(self, key: str, by: int) -> None:
        with self._hub.lock:
            before = self._hub.tokens.get(key, 0)
            self._hub.tokens[key] = before + by
            if bool(before) != bool(before + by):
                for expression, inbox in self._hub.watchers:
                    if matches(expression, key):
                        inbox.put(key, by > 0)

    def watch(self, key_expr: str, handler: Watcher) -> Closing:
        """See `Bus`."""
        inbox = Inbox(f"watch {key_expr}", lambda key, up: handler(key, bool(up)), latest=False)
        entry = (key_expr, inbox)
        inbox.start()
        with self._hub.lock:
            self._hub.watchers.append(entry)
            for key in self.alive(key_expr):
                inbox.put(key, True)

        def undo() -> None:
            with self._hub.lock:
                self._hub.watchers.remove(entry)
            inbox.close()

        return self._declared.add(undo)

    def alive(self, key_expr: str, timeout: float = 2.0) -> tuple[str, ...]:
        """See `Bus`."""
        with self._hub.lock:
            held = [key for key, count in self._hub.tokens.items() if count]
        return tuple(sorted(key for key in held if matches(key_expr, key)))

    def sibling(self) -> MemoryBus:
        """See `Bus`."""
        return MemoryBus(self._keys, self._hub)

    def close(self) -> None:
        """See `Bus`."""
        with self._hub.lock:
            for key in self._latched:
                self._hub.latched.pop(key, None)
            self._latched.clear()
        self._declared.close()

# mypy: disallow-untyped-calls=False
# (zenoh's stubs leave the results of close, undeclare, drop and cancel unannotated)
"""ZenohBus: the `Bus` over Zenoh. The only file that imports zenoh.

Topology is configuration alone (`BusConfig`): nothing given, peers find each other on the loopback
interface; ``connect``: a client of a hub; `Hub` is that hub (a router in this process, listening on
the endpoints it is given). Shared memory is off, a silent link is dead after 1 s, every query has a
timeout, and every session is closed: an open one with a callback would hang the interpreter.
"""

from __future__ import annotations

import logging
import queue
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from types import TracebackType
from typing import TypeVar

import zenoh
from zenoh.handlers import Callback

from agent.config import BusConfig
from agent.errors import BusError, NoAnswer, NoService
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
from agent.messages import ErrorReply
from agent.topology import settings
from agent.wire import JSON, BadPayload, Delivery, Keys, Message, decode, delivery, encode

log = logging.getLogger(__name__)

M = TypeVar("M")

HEARTBEAT = 0.5
"""Seconds after which a reader learns that it missed a writer's last message."""
LOOKS, LOOK_AGAIN = 3, 0.02
"""Looks for tokens until none is believed to be there, and seconds between them."""
PUBLISHERS = 64
"""Recovering writers kept at a time: clients come and go, their event keys do not stay."""


def open_session(text: str) -> zenoh.Session:
    """Open a session with these settings. Raises BusError naming the endpoint trouble."""
    try:
        return zenoh.open(zenoh.Config.from_json5(text))
    except zenoh.ZError as error:
        # behind " at " zenoh names the line of its own source
        raise BusError(f"cannot open the bus: {str(error).split(' at /')[0]}") from error


class Hub:
    """A router in this process: services and clients connect to it, nothing else listens."""

    def __init__(self, listen: tuple[str, ...]) -> None:
        self._session = open_session(settings("router", listen, (), scout=False))

    def close(self) -> None:
        """Close it; clients see their links go."""
        self._session.close()

    def __enter__(self) -> Hub:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        at: TracebackType | None,
    ) -> None:
        self.close()


class ZenohBus:
    """The bus of `agent.bus.Bus` over one Zenoh session. Raises BusError if it cannot open."""

    def __init__(self, config: BusConfig) -> None:
        self._config = config
        self._keys = Keys(config.prefix)
        connect = tuple(config.connect)
        if connect:
            text = settings("client", (), connect, scout=False)
        else:
            listen = ("tcp/127.0.0.1:0",) if config.scout else ()
            text = settings("peer", listen, (), scout=config.scout)
        self._session = open_session(text)
        self._lock = threading.Lock()
        self._declared = Declarations()
        self._publishers: dict[str, zenoh.ext.AdvancedPublisher] = {}

    @property
    def keys(self) -> Keys:
        """See `Bus`."""
        return self._keys

    # --- publish and subscribe ------------------------------------------------------------------

    def publish(self, key: str, message: Message, *, qos: Delivery | None = None) -> None:
        """See `Bus`."""
        self._put(key, Sample(encode(message)), qos or delivery(key))

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
        self._put(key, Sample(data, encoding, attachment), qos or delivery(key))

    def _put(self, key: str, sample: Sample, qos: Delivery) -> None:
        attachment = sample.attachment or None
        try:
            if qos.keep:
                publisher = self._publisher(key, qos)
                publisher.put(sample.data, encoding=sample.encoding, attachment=attachment)
            else:
                self._session.put(
                    key, sample.data, encoding=sample.encoding, attachment=attachment,
                    priority=_PRIORITY[qos.priority], congestion_control=_congestion(qos),
                    express=qos.express,
                )  # fmt: skip
        except zenoh.ZError as error:
            raise BusError(f"cannot publish on {key}: {error}") from error

    def _publisher(self, key: str, qos: Delivery) -> zenoh.ext.AdvancedPublisher:
        with self._lock:
            found = self._publishers.pop(key, None)
            if found is None:
                found = zenoh.ext.declare_advanced_publisher(
                    self._session, key, encoding=JSON, priority=_PRIORITY[qos.priority],
                    congestion_control=_congestion(qos), express=qos.express,
                    cache=zenoh.ext.CacheConfig(qos.keep), publisher_detection=True,
                    sample_miss_detection=zenoh.ext.MissDetectionConfig(
                        heartbeat=HEARTBEAT, sporadic_heartbeat=None
                    ),
                )  # fmt: skip
            self._publishers[key] = found
            old = None
            if len(self._publishers) > PUBLISHERS:
                old = self._publishers.pop(next(iter(self._publishers)))
        if old is not None:
            old.undeclare()
        return found

    def subscribe(self, key_expr: str, handler: Handler, *, latest: bool = False) -> Closing:
        """See `Bus`."""
        return self._listen(key_expr, Inbox(key_expr, _taken(decoding(handler)), latest))

    def subscribe_raw(self, key_expr: str, handler: RawHandler, *, latest: bool = True) -> Closing:
        """See `Bus`."""
        return self._listen(key_expr, Inbox(key_expr, _taken(raw(handler)), latest))

    def _listen(self, key_expr: str, inbox: Inbox) -> Closing:
        def arrived(sample: zenoh.Sample) -> None:
            inbox.put(str(sample.key_expr), sample)

        inbox.start()
        on_sample = Callback(arrived, indirect=False)
        qos = delivery(key_expr)
        declared: zenoh.ext.AdvancedSubscriber[None] | zenoh.Subscriber[None]
        if qos.keep:
            history = zenoh.ext.HistoryConfig(detect_late_publishers=True, max_samples=1)
            declared = zenoh.ext.declare_advanced_subscriber(
                self._session, key_expr, on_sample,
                history=history if qos.latched else None,
                recovery=zenoh.ext.RecoveryConfig(heartbeat=True, periodic_queries=None),
            )  # fmt: skip
        else:
            declared = self._session.declare_subscriber(key_expr, on_sample)

        def undo() -> None:
            self._undeclare(declared.undeclare)
            inbox.close()

        return self._declared.add(undo)

    def _undeclare(self, undeclare: Callable[[], None]) -> None:
        try:
            undeclare()
        except zenoh.ZError as error:
            log.debug("undeclared after its session: %s", error)

    # --- serve and ask --------------------------------------------------------------------------

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

        def work(query: zenoh.Query) -> None:
            with query:
                made = reply(str(query.key_expr), _request(query))
                try:
                    if made.refusal:
                        query.reply_err(made.data, encoding=JSON)
                    else:
                        key = key_expr if "*" not in key_expr else query.key_expr
                        attachment = made.attachment or None
                        query.reply(key, made.data, encoding=made.encoding, attachment=attachment)
                except zenoh.ZError as error:
                    log.warning("%s: the answer could not be sent: %s", key_expr, error)

        def arrived(query: zenoh.Query) -> None:
            try:
                pool.submit(work, query)
            except RuntimeError:
                query.drop()  # closing: nobody answers

        queryable = self._session.declare_queryable(
            key_expr, Callback(arrived, indirect=False), complete=True
        )

        def undo() -> None:
            self._undeclare(queryable.undeclare)
            pool.shutdown(wait=False, cancel_futures=True)

        return self._declared.add(undo)

    def ask(
        self, key: str, request: Message | None, reply_type: type[M], timeout: float = 5.0
    ) -> M:
        """See `Bus`."""
        request_bytes = None if request is None else encode(request)
        return unpack(key, decode(self._ask(key, request_bytes, timeout).data), reply_type)

    def ask_raw(self, key: str, timeout: float = 5.0) -> tuple[bytes, bytes]:
        """See `Bus`."""
        return unpack_raw(key, self._ask(key, None, timeout))

    def _ask(self, key: str, request: bytes | None, timeout: float) -> Sample:
        qos = delivery(key)
        replies: queue.SimpleQueue[zenoh.Reply | None] = queue.SimpleQueue()
        token = zenoh.CancellationToken()
        try:
            self._session.get(
                key, Callback(replies.put, lambda: replies.put(None), indirect=False),
                payload=request,
                encoding=None if request is None else JSON,
                priority=_PRIORITY[qos.priority], congestion_control=_congestion(qos),
                express=qos.express, timeout=timeout, cancellation_token=token,
            )  # fmt: skip
            return _first(key, replies, timeout)
        except zenoh.ZError as error:
            raise BusError(f"cannot ask {key}: {error}") from error
        finally:
            token.cancel()

    # --- tokens ---------------------------------------------------------------------------------

    def token(self, key: str) -> Closing:
        """See `Bus`."""
        token = self._session.liveliness().declare_token(key)
        return self._declared.add(lambda: self._undeclare(token.undeclare))

    def watch(self, key_expr: str, handler: Watcher) -> Closing:
        """See `Bus`. A token that comes while this begins is told by zenoh twice."""
        there = set[str]()

        def told(key: str, up: object) -> None:
            if up and key in there:
                return
            (there.add if up else there.discard)(key)
            handler(key, bool(up))

        inbox = Inbox(f"watch {key_expr}", told, latest=False)

        def changed(sample: zenoh.Sample) -> None:
            inbox.put(str(sample.key_expr), sample.kind == zenoh.SampleKind.PUT)

        inbox.start()
        declared = self._session.liveliness().declare_subscriber(
            key_expr, Callback(changed, indirect=False), history=True
        )

        def undo() -> None:
            self._undeclare(declared.undeclare)
            inbox.close()

        return self._declared.add(undo)

    def alive(self, key_expr: str, timeout: float = 2.0) -> tuple[str, ...]:
        """See `Bus`. Under load a look has been seen to miss what is there: nothing is believed
        only after LOOKS of them."""
        for look in range(LOOKS):
            found = self._look(key_expr, timeout)
            if found or look == LOOKS - 1:
                return found
            time.sleep(LOOK_AGAIN)
        return ()

    def _look(self, key_expr: str, timeout: float) -> tuple[str, ...]:
        replies: queue.SimpleQueue[zenoh.Reply | None] = queue.SimpleQueue()
        self._session.liveliness().get(
            key_expr, Callback(replies.put, lambda: replies.put(None), indirect=False),
            timeout=timeout,
        )  # fmt: skip
        found = set()
        while (reply := replies.get()) is not None:
            if reply.ok is not None:
                found.add(str(reply.ok.key_expr))
        return tuple(sorted(found))

    # --- the end --------------------------------------------------------------------------------

    def sibling(self) -> ZenohBus:
        """See `Bus`."""
        return ZenohBus(self._config)

    def close(self) -> None:
        """See `Bus`."""
        self._declared.close()
        for publisher in self._publishers.values():
            self._undeclare(publisher.undeclare)
        self._publishers.clear()
        self._session.close()


_PRIORITY = {
    "real_time": zenoh.Priority.REAL_TIME,
    "interactive_high": zenoh.Priority.INTERACTIVE_HIGH,
    "interactive_low": zenoh.Priority.INTERACTIVE_LOW,
    "data_high": zenoh.Priority.DATA_HIGH,
    "data": zenoh.Priority.DATA,
    "data_low": zenoh.Priority.DATA_LOW,
}


def _congestion(qos: Delivery) -> zenoh.CongestionControl:
    return zenoh.CongestionControl.BLOCK if qos.block else zenoh.CongestionControl.DROP


def _taken(handle: Callable[[str, object], None]) -> Callable[[str, object], None]:
    """The handler of what zenoh hands over, copied on the subscription's thread and not on zenoh's:
    of a flood only what is still the newest is ever copied, and nothing else waits for that."""

    def copied(key: str, item: object) -> None:
        assert isinstance(item, zenoh.Sample)
        handle(key, _sample(item))

    return copied


def _sample(sample: zenoh.Sample) -> Sample:
    attachment = sample.attachment
    return Sample(
        sample.payload.to_bytes(),
        str(sample.encoding),
        attachment.to_bytes() if attachment else b"",
    )


def _request(query: zenoh.Query) -> Sample | None:
    payload = query.payload
    return None if payload is None else Sample(payload.to_bytes(), str(query.encoding))


def _first(key: str, replies: queue.SimpleQueue[zenoh.Reply | None], timeout: float) -> Sample:
    """The first answer. Raises NoService if there was none, NoAnswer at the timeout."""
    end = time.monotonic() + timeout + 0.5
    try:
        reply = replies.get(timeout=max(end - time.monotonic(), 0.0))
    except queue.Empty:
        raise NoAnswer(f"{key} did not answer within {timeout:g} s") from None
    if reply is None:
        raise NoService(f"nobody serves {key}")
    if reply.ok is not None:
        return _sample(reply.ok)
    assert reply.err is not None
    data = reply.err.payload.to_bytes()
    if data == b"Timeout":
        raise NoAnswer(f"{key} did not answer within {timeout:g} s")
    try:
        decode(data)
    except BadPayload:
        data = encode(ErrorReply("error", data.decode(errors="replace")))
    return Sample(data, refusal=True)

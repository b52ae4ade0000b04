"""What is said on the bus, in one place: keys, delivery guarantees, and the JSON of a message.

``$P`` is ``<prefix>/v1``; one writer a key; ids are slugs. A message is one of `Message`, as JSON
with encoding ``application/json``; unknown types and wrong fields raise `BadPayload`.

    scene/<s>/objects            SceneSnapshot        scene     DATA drop, latched
    scene/<s>/camera/<c>         JPEG                 scene     DATA_LOW drop, + query
    scene/<s>/snapshot           -> SceneSnapshot     scene     query
    scene/<s>/call               SceneCall -> SceneSnapshot     query
    instruction/<c>/submit       Submit -> Ack        agent     query
    instruction/<c>/event        Event                agent     DATA_HIGH block, recovered
    translate/<w>/run            TranslateRequest -> Translation          query
    clarify/<w>/turn             ClarifyRequest -> Decision               query
    robot/<r>/cmd/<verb>         RobotCommand -> RobotReply     bridge    query
    robot/<r>/stop               StopRequest -> RobotReply      anyone    REAL_TIME block
    robot/<r>/state              RobotState           bridge    DATA_HIGH drop, latched, + query
    robot/<r>/event              RobotEvent           bridge    DATA_HIGH drop, recovered
    robot/<r>/world              WorldSnapshot        bridge    DATA drop, latched, + query
    robot/<r>/limits             -> RobotLimits       bridge    query
    robot/<r>/picture            -> RGB               bridge    query
    lease/robot/<r>/<c>          token                client
    alive/<service>/<id>         token                service

Pictures are raw bytes; the attachment is a PictureInfo.

A verb is for the owner of the lease, or refused with a code (`robot_bridge.lease.REFUSALS`):

    acquire keepalive release    take the robot, keep it (every 250 ms), give it back
    run                          a plan; with ``hold`` it waits before its first line
    pause resume                 hold before the next primitive; go on to the end
    step                         go on to the end of the line that runs or comes next; hold there
    cancel                       end a run that is held, without a stop's latch
    reset resume                 clear a stop's latch; allow motion again
    home load                    go to the parking pose; load a simulated world
"""

from __future__ import annotations

import re
from functools import lru_cache
from typing import Literal

import msgspec

from agent.errors import BusError, ConfigError
from agent.messages import (
    Ack,
    ClarifyRequest,
    Decision,
    ErrorReply,
    Event,
    RobotCommand,
    RobotEvent,
    RobotLimits,
    RobotReply,
    RobotState,
    SceneCall,
    SceneSnapshot,
    StopRequest,
    Submit,
    TranslateRequest,
    Translation,
    WorldSnapshot,
)

Message = (
    SceneSnapshot
    | SceneCall
    | Submit
    | Ack
    | Event
    | TranslateRequest
    | Translation
    | ClarifyRequest
    | Decision
    | RobotCommand
    | RobotReply
    | RobotState
    | RobotEvent
    | RobotLimits
    | WorldSnapshot
    | StopRequest
    | ErrorReply
)

JSON = "application/json"
RAW = "application/octet-stream"
ANY = "*"
"""In place of an id: all of them (subscribe and watch only)."""

_decoder: msgspec.json.Decoder[Message] = msgspec.json.Decoder(Message)
_encoder = msgspec.json.Encoder()


class BadPayload(BusError):
    """Bytes that are no message of ours: unknown type, wrong field, wrong encoding."""


def encode(message: Message) -> bytes:
    """The message as JSON with its ``type`` tag."""
    return _encoder.encode(message)


def decode(data: bytes) -> Message:
    """The message in these bytes. Raises BadPayload that says which field is wrong."""
    try:
        return _decoder.decode(data)
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise BadPayload(str(error)) from error


# --- guarantees -------------------------------------------------------------------------------


class Delivery(msgspec.Struct, frozen=True):
    """How a key's messages travel: one priority a key, or two messages could overtake.

    ``block``: wait for a slow reader rather than drop (never on a stream). ``express``: not
    batched. ``keep``: how many the writer keeps so that a reader can recover what it missed.
    ``latched``: a reader that joins late gets the last one.
    """

    priority: Literal[
        "real_time", "interactive_high", "interactive_low", "data_high", "data", "data_low"
    ]
    block: bool = False
    express: bool = False
    keep: int = 0
    latched: bool = False


STREAM = Delivery("data")
SNAPSHOT = Delivery("data", keep=1, latched=True)
IMAGE = Delivery("data_low")
STATE = Delivery("data_high", keep=1, latched=True)
EVENTS = Delivery("data_high", block=True, keep=50)
STEPS = Delivery("data_high", keep=600)
REQUEST = Delivery("interactive_low", block=True)
COMMAND = Delivery("interactive_high", block=True, express=True)
STOP = Delivery("real_time", block=True, express=True)

DELIVERIES = (
    ("scene/*/objects", SNAPSHOT),
    ("scene/*/camera/*", IMAGE),
    ("scene/*/snapshot", EVENTS),
    ("scene/*/call", REQUEST),
    ("instruction/*/submit", REQUEST),
    ("instruction/*/event", EVENTS),
    ("translate/*/run", REQUEST),
    ("clarify/*/turn", REQUEST),
    ("robot/*/cmd/*", COMMAND),
    ("robot/*/stop", STOP),
    ("robot/*/state", STATE),
    ("robot/*/event", STEPS),
    ("robot/*/world", SNAPSHOT),
    ("robot/*/limits", COMMAND),
    ("robot/*/picture", IMAGE),
)


@lru_cache(maxsize=1024)
def delivery(key: str) -> Delivery:
    """The guarantee that belongs to a key (or key expression); STREAM for a foreign one."""
    for pattern, guarantee in DELIVERIES:
        if matches(f"**/v1/{pattern}", key):
            return guarantee
    return STREAM


# --- keys -------------------------------------------------------------------------------------


def matches(expression: str, key: str) -> bool:
    """Whether two key expressions have a key in common (``*`` one chunk, ``**`` any number)."""
    return _meet(tuple(expression.split("/")), tuple(key.split("/")))


def _meet(left: tuple[str, ...], right: tuple[str, ...]) -> bool:
    if not left or not right:
        return all(chunk == "**" for chunk in left + right)
    if left[0] == "**":
        return _meet(left[1:], right) or _meet(left, right[1:])
    if right[0] == "**":
        return _meet(left, right[1:]) or _meet(left[1:], right)
    alike = left[0] == right[0] or "*" in (left[0], right[0])
    return alike and _meet(left[1:], right[1:])


_ID = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]{0,63}")


class Keys(msgspec.Struct, frozen=True):
    """Every key expression, under ``<prefix>/v1``. Raises ConfigError for an id that is no slug."""

    prefix: str = "armchat"

    def _key(self, *chunks: str) -> str:
        for chunk in chunks:
            if chunk != ANY and not _ID.fullmatch(chunk):
                raise ConfigError(f"{chunk!r} is not an id: letters, digits, '_', '.', '-' only")
        return "/".join((self.prefix, "v1", *chunks))

    def objects(self, scene: str = "main") -> str:
        """The live scene (SceneSnapshot)."""
        return self._key("scene", scene, "objects")

    def snapshot(self, scene: str = "main") -> str:
        """Query: the scene, looked at now (SceneSnapshot)."""
        return self._key("scene", scene, "snapshot")

    def camera(self, scene: str = "main", camera: str = "top") -> str:
        """Pictures (JPEG), as a stream and as a query."""
        return self._key("scene", scene, "camera", camera)

    def call(self, scene: str = "main") -> str:
        """Query: a thing gets a name (SceneCall -> SceneSnapshot)."""
        return self._key("scene", scene, "call")

    def submit(self, client: str) -> str:
        """Query: a sentence from this client (Submit -> Ack)."""
        return self._key("instruction", client, "submit")

    def event(self, client: str) -> str:
        """What happens to this client's sentences (Event)."""
        return self._key("instruction", client, "event")

    def translate(self, worker: str) -> str:
        """Query: TranslateRequest -> Translation."""
        return self._key("translate", worker, "run")

    def clarify(self, worker: str) -> str:
        """Query: ClarifyRequest -> Decision."""
        return self._key("clarify", worker, "turn")

    def command(self, robot: str, verb: str) -> str:
        """Query: RobotCommand -> RobotReply."""
        return self._key("robot", robot, "cmd", verb)

    def stop(self, robot: str) -> str:
        """STOP (StopRequest), put or query."""
        return self._key("robot", robot, "stop")

    def state(self, robot: str) -> str:
        """RobotState, latched and as a query."""
        return self._key("robot", robot, "state")

    def steps(self, robot: str) -> str:
        """RobotEvent: the steps and the end of each run."""
        return self._key("robot", robot, "event")

    def world(self, robot: str) -> str:
        """WorldSnapshot of a simulated robot, latched and as a query."""
        return self._key("robot", robot, "world")

    def limits(self, robot: str) -> str:
        """Query: RobotLimits."""
        return self._key("robot", robot, "limits")

    def picture(self, robot: str) -> str:
        """Query: what the overhead camera of a simulated robot sees (RGB, rows from the top)."""
        return self._key("robot", robot, "picture")

    def lease(self, robot: str, client: str) -> str:
        """Token of the client that holds, or wants, the robot."""
        return self._key("lease", "robot", robot, client)

    def alive(self, service: str, name: str) -> str:
        """Token of a service that is ready."""
        return self._key("alive", service, name)

    def everything(self) -> str:
        """All keys of this prefix and version."""
        return f"{self.prefix}/v1/**"

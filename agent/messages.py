"""Every value that crosses an arrow or the bus, in one place.

    Utterance -> Instruction -> Translation -> Program -> Report -> (Question) -> Trace -> Outcome

All are frozen ``msgspec.Struct``; on the wire they are JSON with a ``type`` tag such as
``scene.objects/1``. Unknown types and wrong fields are refused; only optional fields are added
to a type; anything else is a new number. Coordinates are in the table frame (``scene.types``).
"""

from __future__ import annotations

import math
from typing import Literal

import msgspec

from scene.types import Scene, SceneObject

Kind = Literal["arrange", "manipulate"]
Status = Literal["done", "asked", "answered", "refused", "failed"]
Reason = Literal[
    "unknown_word",
    "missing_object",
    "unreachable",
    "unsafe",
    "impossible",
    "not_understood",
    "bad_program",
    "cancelled",
]
QuestionKind = Literal[
    "which", "where", "missing", "unknown_word", "how_many", "direction", "confirm", "open"
]


# --- the sentence ---------------------------------------------------------------------------


class Mention(msgspec.Struct, frozen=True):
    """A phrase of the sentence that names objects: ``text == sentence[start:end]``.

    ``slot`` ("m1", "m2", ... in order of first mention; the same things get the same slot) is
    the identifier that stands for it in a translated program. ``objects`` are the ids it may
    denote on the live scene: none (absent), one, or several (ambiguous, or a group if
    ``plural``). ``free`` is true for "a/an/any X": any one of them will do.
    """

    slot: str
    start: int
    end: int
    text: str
    objects: tuple[str, ...]
    plural: bool = False
    free: bool = False


class Candidate(msgspec.Struct, frozen=True):
    """A program over mention slots and its log-probability (nats, whole program)."""

    body: str
    logprob: float
    length: int


class Quantity(msgspec.Struct, frozen=True):
    """A measure in the sentence: ``text == sentence[start:end]``; a program calls it ``slot``.

    Slots are "d1", "d2" for lengths (``value`` in table units), "t1" for angles (radians), "n1" for
    numbers; numbered by kind, in order.
    """

    slot: str
    start: int
    end: int
    text: str
    value: float


class TranslateRequest(msgspec.Struct, frozen=True, tag="translate.run/1", tag_field="type"):
    """A sentence with its linked mentions and measures, to be translated into ``k`` candidates.

    ``phrases``: where (start, end) the parts of the sentence are that can be translated alone.
    """

    text: str
    mentions: tuple[Mention, ...]
    kind: Kind
    k: int = 4
    measures: tuple[Quantity, ...] = ()
    phrases: tuple[tuple[int, int], ...] = ()


class Translation(msgspec.Struct, frozen=True, tag="translate.result/1", tag_field="type"):
    """Candidates, best first. ``confidence`` in [0, 1]: that the first one is what was meant.

    ``unknown`` lists content words that the model has never seen in training.
    """

    candidates: tuple[Candidate, ...]
    confidence: float
    ms: float
    unknown: tuple[str, ...] = ()


class Attention(msgspec.Struct, frozen=True):
    """What the translator looked at as it wrote the program ``body``.

    ``weights`` has a row for each of ``tokens`` (the model's output symbols, ``<end>`` last) and in
    it a share for each of ``pieces`` (the sentence's word pieces; what a slot stands for is one
    piece). A row sums to 1.
    """

    body: str
    tokens: tuple[str, ...]
    pieces: tuple[str, ...]
    weights: tuple[tuple[float, ...], ...]


# --- the program ----------------------------------------------------------------------------


class Command(msgspec.Struct, frozen=True):
    """One primitive: ``move`` to x, y, z (table units), r (radians), or ``grip`` on or off.

    A ``grip`` carries the position at which it happens. ``line`` is the program's line (from 1),
    ``statement`` tells apart the passes of a loop over one line: it counts executed statements.
    """

    op: Literal["move", "grip"]
    x: float
    y: float
    z: float
    r: float
    grip: bool
    line: int = 0
    statement: int = 0


class KeepOut(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A box that the end effector must not enter: lowest and highest x, y and z (table units)."""

    name: str
    x: tuple[float, float]
    y: tuple[float, float]
    z: tuple[float, float]

    def __post_init__(self) -> None:
        for axis, (low, high) in (("x", self.x), ("y", self.y), ("z", self.z)):
            if not -math.inf < low < high < math.inf:
                raise ValueError(f"keep-out {self.name!r}: {axis} must be [lowest, highest]")


class Placement(msgspec.Struct, frozen=True):
    """Where an arrange program wants an object from the tray: centre of its footprint."""

    object: str
    x: float
    y: float
    line: int = 0


class Draft(msgspec.Struct, frozen=True):
    """What a program did on one scene: the primitives it asked for and the placements it solved.

    Nothing in it is trusted or approved.
    """

    commands: tuple[Command, ...] = ()
    placements: tuple[Placement, ...] = ()
    steps: int = 0


class Problem(msgspec.Struct, frozen=True):
    """One reason why a program may not run: where, what and which object (id) it concerns."""

    reason: Reason
    text: str
    line: int = 0
    object: str | None = None
    column: int = 0


# --- the dialogue ---------------------------------------------------------------------------


class Target(msgspec.Struct, frozen=True):
    """A place on the table (table units)."""

    x: float
    y: float


class Option(msgspec.Struct, frozen=True):
    """One choice of a question; ``program`` (over the scene's names) runs when it is picked."""

    label: str
    objects: tuple[str, ...] = ()
    target: Target | None = None
    program: str | None = None
    kind: Kind | None = None
    touched: tuple[str, ...] = ()


LEAVE, BY_HAND = "leave it", "I moved it by hand"
"""Labels of the options that are to do nothing, and to look at what a person has done meanwhile."""


class Question(msgspec.Struct, frozen=True):
    """What armchat asks; ``options`` is empty for an open question."""

    kind: QuestionKind
    text: str
    options: tuple[Option, ...] = ()


class Focus(msgspec.Struct, frozen=True):
    """An object that was talked about, with its salience in (0, 1]."""

    object: str
    salience: float


class Pending(msgspec.Struct, frozen=True):
    """A question that waits for its answer, and the sentence that led to it. ``word``: the unknown
    word that it is about."""

    text: str
    question: Question
    strikes: int = 0
    word: str = ""


class Lesson(msgspec.Struct, frozen=True):
    """A word that was taught, and the words that it stands for: a thing's, or a deed's."""

    word: str
    meaning: str
    deed: bool = False


class Done(msgspec.Struct, frozen=True):
    """A motion that was decided on: what was said, and how what it should move stood before."""

    text: str
    stood: tuple[SceneObject, ...]


class Dialog(msgspec.Struct, frozen=True):
    """The conversation as a value. ``done``: the motions that can be taken back, the last at the
    end. ``why``: the reason of the last decision that a person may ask for. ``taught``: words of
    this conversation alone, where none are kept in a file. ``called``: objects (by id) that the
    person gave a name."""

    focus: tuple[Focus, ...] = ()
    pending: Pending | None = None
    last_text: str | None = None
    questions_asked: int = 0
    done: tuple[Done, ...] = ()
    why: str = ""
    taught: tuple[Lesson, ...] = ()
    called: tuple[tuple[str, str], ...] = ()


class Decision(msgspec.Struct, frozen=True, tag="clarify.decision/1", tag_field="type"):
    """What the clarifier decided, and why in one sentence.

    ``act``: run ``program``, which touches ``touched`` (object ids). ``ask``: ``question``.
    ``answer``: nothing moves, ``reply`` is the answer. ``refuse``: nothing moves, ``reason``.
    ``stop``: halt now. ``dialog`` is the conversation from here on.
    """

    do: Literal["act", "ask", "answer", "refuse", "stop"]
    why: str
    dialog: Dialog
    reply: str = ""
    program: str | None = None
    kind: Kind | None = None
    touched: tuple[str, ...] = ()
    question: Question | None = None
    reason: Reason | None = None
    confidence: float | None = None
    ms_translate: float = 0.0
    echo: str = ""


class ClarifyRequest(msgspec.Struct, frozen=True, tag="clarify.turn/1", tag_field="type"):
    """A sentence, the live scene and the conversation so far; ``sd`` as in SceneSnapshot."""

    text: str
    scene: Scene
    dialog: Dialog
    task: Kind | None = None
    sd: dict[str, float] = {}


class Waypoint(msgspec.Struct, frozen=True):
    """One entry of a trajectory: what the robot was told, after clipping."""

    x: float
    y: float
    z: float
    r: float
    grip: bool


class Timing(msgspec.Struct, frozen=True):
    """Milliseconds spent in the parts of a turn."""

    translate: float = 0.0
    decide: float = 0.0
    execute: float = 0.0
    total: float = 0.0


class Turn(msgspec.Struct, frozen=True, kw_only=True):
    """The turn object of the machine interface: every key is always present."""

    say: str | None
    status: Status
    reply: str
    program: str | None = None
    kind: Kind | None = None
    trajectory: tuple[Waypoint, ...] = ()
    question: Question | None = None
    reason: Reason | None = None
    confidence: float | None = None
    ms: Timing = Timing()


# --- the wire (agent/bus.py has the keys and the guarantees) ----------------------------------


class SceneEvent(msgspec.Struct, frozen=True):
    """What an eye saw happen to a thing: it came, left, went over the edge, changed its name."""

    kind: Literal["entered", "left", "fell", "renamed"]
    id: str
    name: str


class SceneSnapshot(
    msgspec.Struct, frozen=True, tag="scene.objects/1", tag_field="type", omit_defaults=True
):
    """The whole live scene. ``seq`` counts up; ``t`` is seconds since the epoch.

    Where a camera is its source: ``camera`` says whether it gives pictures, ``sd`` has by id the
    standard deviation of x and of y (table units), ``tall_sd`` that of a height, ``unseen`` for how
    many seconds a thing has not been seen (wholly: the arm may hide a part of it), ``events`` what
    happened since the snapshot before, ``stands`` a number that stays the same as long as a thing
    is seen not to have moved.
    """

    seq: int
    t: float
    scene: Scene
    sd: dict[str, float] = {}
    unseen: dict[str, float] = {}
    events: tuple[SceneEvent, ...] = ()
    camera: Literal["", "ok", "lost"] = ""
    tall_sd: dict[str, float] = {}
    stands: dict[str, int] = {}


class SceneCall(msgspec.Struct, frozen=True, tag="scene.call/1", tag_field="type"):
    """From now on the thing with this id is called so, whatever it looks like."""

    id: str
    name: str


class PictureInfo(msgspec.Struct, frozen=True, omit_defaults=True):
    """The metadata of a picture on the bus: when it was taken (seconds since the epoch), its size.

    ``format``: ``jpeg``, or ``rgb``: 3 bytes a pixel, rows from the top. ``homography`` (by rows)
    and ``camera`` are those of `scene.sight.View`, where whoever sent it knows them.
    """

    t: float
    width: int
    height: int
    format: Literal["jpeg", "rgb"]
    homography: tuple[float, ...] = ()
    camera: tuple[float, ...] = ()


class Submit(msgspec.Struct, frozen=True, tag="instruction.submit/1", tag_field="type"):
    """A sentence from a client. ``request_id`` makes a repeated submit harmless.

    ``hold``: the arm waits before the program's first line, to be stepped or resumed.
    """

    request_id: str
    text: str
    task: Kind | None = None
    dry_run: bool = False
    program: str | None = None
    hold: bool = False


class Ack(msgspec.Struct, frozen=True, tag="instruction.ack/1", tag_field="type"):
    """The agent took the submit; its events carry the same ``request_id``."""

    request_id: str
    duplicate: bool = False


class StepReport(msgspec.Struct, frozen=True):
    """One executed primitive: what was told, reached, and is held (None: unsensed)."""

    index: int
    count: int
    line: int
    told: Waypoint
    reached: Waypoint
    held: bool | None = None


class Event(msgspec.Struct, frozen=True, tag="instruction.event/1", tag_field="type"):
    """What happens to a submit, in order of ``seq``; the one with ``turn`` is the last.

    ``stage``: ``heard``, then ``program`` (with ``program`` and the ``plan`` that passed the
    check), ``step`` for each primitive, and ``turn`` with the whole result.
    """

    request_id: str
    seq: int
    stage: Literal["heard", "program", "step", "turn"]
    text: str = ""
    program: str | None = None
    kind: Kind | None = None
    plan: tuple[Waypoint, ...] = ()
    step: StepReport | None = None
    turn: Turn | None = None


class RobotCommand(msgspec.Struct, frozen=True, tag="robot.command/1", tag_field="type"):
    """A verb for the robot bridge (``run``, ``pause``, ``step``, ...: `agent.wire` has them all).

    ``deadline`` is seconds since the epoch after which the command is refused as late. A ``run``
    carries what its approval was given for (``commands``, ``program``, ``scene``) and that
    approval's ``digest``: a bridge that comes to another refuses it. ``hold``: wait before the
    first line.
    """

    client: str
    session: str
    epoch: int
    seq: int
    deadline: float
    commands: tuple[Command, ...] = ()
    program: str = ""
    scene: Scene | None = None
    digest: str = ""
    hold: bool = False


class RobotReply(msgspec.Struct, frozen=True, tag="robot.reply/1", tag_field="type"):
    """The bridge's answer to a command; ``epoch`` is the owner's from now on."""

    ok: bool
    epoch: int = 0
    code: str = ""
    text: str = ""


class RobotState(msgspec.Struct, frozen=True, tag="robot.state/1", tag_field="type"):
    """What the bridge knows of its robot. ``safety``: normal, stopped (latched) or alarm.

    ``line`` is the program's line that runs, or comes next while it is paused; 0: none.
    """

    seq: int
    t: float
    robot: str
    safety: Literal["normal", "stopped", "alarm", "lost"]
    program: Literal["idle", "running", "paused"]
    pose: Waypoint
    owner: str | None = None
    epoch: int = 0
    text: str = ""
    line: int = 0


class RobotLimits(msgspec.Struct, frozen=True, tag="robot.limits/1", tag_field="type"):
    """A robot's limits as `robot_bridge.api.Limits` has them, field by field."""

    x: tuple[float, float]
    y: tuple[float, float]
    z: tuple[float, float]
    r: tuple[float, float]
    speed: float
    commands: int
    length: float
    acceleration: float
    turn_speed: float
    keep_outs: tuple[KeepOut, ...] = ()
    everywhere: bool = False
    simulated: bool = False
    yields: bool = False


class RobotEvent(msgspec.Struct, frozen=True, tag="robot.event/1", tag_field="type"):
    """A step of the plan with ``seq`` of its command, or its end (``error`` set if it failed)."""

    command_seq: int
    session: str
    step: StepReport | None = None
    ended: bool = False
    error: str | None = None
    text: str = ""


class WorldSnapshot(msgspec.Struct, frozen=True, tag="robot.world/1", tag_field="type"):
    """A simulated robot's own world: the ground truth that a simulated eye sees."""

    seq: int
    t: float
    scene: Scene


class StopRequest(msgspec.Struct, frozen=True, tag="robot.stop/1", tag_field="type"):
    """STOP. ``now``: flush and force-stop instead of slowing down."""

    by: str
    now: bool = False


class ErrorReply(msgspec.Struct, frozen=True, tag="error/1", tag_field="type"):
    """Why a query was not served; ``code`` is one word that programs can test."""

    code: str
    text: str

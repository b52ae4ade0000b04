"""Where this person's conversation stands: the sentence under way, those that wait. No widgets."""

from __future__ import annotations

from agent.errors import ArmchatError, Declined, NoAnswer, NoService
from agent.messages import Event, RobotReply, RobotState, Status, Turn, Waypoint
from scene.types import Scene
from tui.plain import millimetres
from tui.status import Phase

PHASES: dict[Status, Phase] = {
    "done": "done", "asked": "asking", "answered": "idle", "refused": "refused",
    "failed": "failed",
}  # fmt: skip


def phase_after(turn: Turn) -> Phase:
    """Where a turn leaves the program: what a person broke off has not failed."""
    if turn.reason == "cancelled":
        return "stopped" if turn.trajectory else "cancelled"
    return PHASES[turn.status]


class Talk:
    """One sentence is said at a time; others wait, and are dropped when the plan changes."""

    def __init__(self) -> None:
        self.phase: Phase = "idle"
        self.busy = False
        self.waiting: list[str] = []
        self.plan: tuple[Waypoint, ...] = ()
        self.done = 0
        self.count = 0
        self.pausing = False

    @property
    def moving(self) -> bool:
        """Whether our own program is under way."""
        return self.busy and bool(self.plan)

    def begin(self) -> None:
        """A sentence goes out."""
        self.busy = True
        self.phase = "thinking"
        self._forget()

    def _forget(self) -> None:
        self.plan, self.done, self.count, self.pausing = (), 0, 0, False

    def hear(self, event: Event) -> None:
        """An event of the sentence under way."""
        if event.stage == "program":
            self.plan = event.plan
            self.count = len(event.plan)
        elif event.step is not None:
            self.phase = "running"
            self.done, self.count = event.step.index + 1, event.step.count
        elif event.turn is not None:
            self.phase = phase_after(event.turn)
            if self.phase in ("done", "cancelled"):
                self._forget()

    def over(self, error: ArmchatError | None) -> str | None:
        """The turn ended; returns the next sentence that waits, if it still makes sense."""
        self.busy = False
        if error is not None:
            self.phase = "failed"
        if self.phase not in ("done", "idle", "cancelled") or not self.waiting:
            return None
        return self.waiting.pop(0)

    def drop(self) -> int:
        """Forget the sentences that wait; returns how many there were."""
        count = len(self.waiting)
        self.waiting.clear()
        return count


def trouble(error: ArmchatError) -> str:
    """Why a sentence got no answer, and what that means for the arm."""
    if isinstance(error, NoService):
        return f"No agent: {error}. Nothing more is said to the arm."
    if isinstance(error, NoAnswer):
        return f"No answer: {error}. Whether anything moves is unknown; F8 stops the arm."
    return f"{error}"


def answered(verb: str, reply: RobotReply | None, error: ArmchatError | None) -> str:
    """What came of a verb for the robot, in words."""
    stopping = verb.startswith("stop")
    if isinstance(error, Declined):
        return f"{verb} was declined ({error.code}): {error}"
    if error is not None:
        tail = ": motion state unknown. Use the power switch." if stopping else ""
        return f"{verb.upper() if stopping else verb} was not acknowledged ({error}){tail}"
    if reply is not None and not reply.ok:
        return f"{verb} was refused: {reply.text or reply.code}"
    said = {
        "stop": "STOP acknowledged: the arm slows down and holds. /reset, then /resume to go on.",
        "stop now": "STOP NOW acknowledged: forced. /reset, then /resume to go on.",
        "reset": "reset: the latch is cleared, nothing moved. /resume allows motion again.",
        "resume": "resume: motion is allowed again.",
        "acquire": "you hold the arm.",
        "release": "the arm is free.",
        "home": "home: the arm is at its parking pose.",
    }
    return said.get(verb, f"{verb}: ok")


def safety_news(state: RobotState) -> str:
    """What happened to the robot that this person did not ask for, and the remedy."""
    cause = state.text.removesuffix(": reset, then resume")
    if state.safety == "stopped" and cause.startswith("stopped"):
        news = f"the robot was {cause}"
    else:
        words = {"stopped": "the robot was stopped", "alarm": "the robot raised an alarm"}
        news = words.get(state.safety, "connection to the robot lost, motion state unknown")
        news += f": {cause}" if cause else ""
    return f"{news}. /reset, then /resume to go on."


def describe(scene: Scene) -> str:
    """What stands where, in millimetres on the table, one object a line."""
    lines = []
    for item in scene:
        color = f"{item.color} " if item.color and item.color not in item.name else ""
        where = f"on {item.on}" if item.on not in ("table", "tray", "floor") else item.on
        if item.x is not None and item.y is not None:
            x, y = millimetres(item.x, scene.table_m), millimetres(item.y, scene.table_m)
            where = f"{where}, at {x}, {y} mm"
        lines.append(f"{color}{item.name} ({item.id}): {where}")
    return "\n".join(lines) or "Nothing is on the table."

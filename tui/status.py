"""What the header says, in words: connection, safety, program, owner. Pure.

Colours only repeat what the words say, so that the header reads the same without them.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import Literal, NamedTuple

from agent.messages import RobotState, SceneSnapshot

Tone = Literal["good", "calm", "busy", "warn", "bad"]
Phase = Literal[
    "idle", "thinking", "asking", "running", "done", "failed", "refused", "stopped", "cancelled"
]
"""How far this client's own sentence has come."""

NEEDED = {"robot": "robot bridge", "scene": "scene service", "agent": "agent"}
"""Services without which a sentence cannot become a motion."""
NAMES = NEEDED | {"translate": "translator", "clarify": "clarifier"}
GONE = {
    "robot": "motion state unknown",
    "scene": "the map shows what was seen last",
    "agent": "nobody answers sentences; STOP still works",
    "translate": "new sentences cannot be translated",
    "clarify": "sentences cannot be understood",
}
Counts = tuple[tuple[str, int], ...]
UNSURE_MM = 2.0
"""Standard deviation of a place above which it is told (millimetres)."""
STALE = 3.0
"""Seconds without a state after which the bridge counts as silent."""


class Pill(NamedTuple):
    """One word or two of the header."""

    text: str
    tone: Tone


def connection(services: Collection[str]) -> Pill:
    """Who of those needed is there; ``services`` are "robot/r1", "scene/main", ..."""
    kinds = {key.split("/")[0] for key in services}
    missing = [name for kind, name in NEEDED.items() if kind not in kinds]
    if not missing:
        return Pill("● connected", "good")
    if len(missing) == len(NEEDED):
        return Pill("○ no services", "bad")
    return Pill(f"◐ no {missing[0]}", "bad")


def safety(state: RobotState | None, bridge: bool, age: float) -> Pill:
    """What is known of the robot; ``age`` is the seconds since its last state."""
    if state is None or not bridge or age > STALE or state.safety == "lost":
        return Pill("motion unknown", "bad")
    if state.safety == "stopped":
        return Pill("STOPPED", "warn")
    if state.safety == "alarm":
        return Pill("ALARM", "bad")
    return Pill("normal", "good")


def camera(seen: SceneSnapshot | None, age: float) -> Pill | None:
    """Whether the eye has a picture; None where no camera sees the table.

    ``age`` is the seconds since the last scene.
    """
    if seen is None or not seen.camera:
        return None
    if seen.camera == "lost" or age > STALE:
        return Pill("no picture", "bad")
    return Pill("camera ok", "good")


def doubts(seen: SceneSnapshot) -> tuple[Counts, Counts]:
    """Of which things the eye is unsure (mm), and which it does not see (whole seconds), by id."""
    mm = 1000 * seen.scene.table_m / 2
    unsure = ((id_, round(mm * sd)) for id_, sd in sorted(seen.sd.items()) if mm * sd > UNSURE_MM)
    unseen = ((id_, int(age)) for id_, age in sorted(seen.unseen.items()) if age >= 1)
    return tuple(unsure), tuple(unseen)


def program(
    phase: Phase, state: RobotState | None, step: int, count: int, pausing: bool = False
) -> Pill:
    """How far the program is: ours by its events, anybody's by the robot's state."""
    if state is not None and state.program == "paused":
        return Pill("paused", "warn")
    if pausing:
        return Pill("pausing", "warn")
    if phase == "running" or (state is not None and state.program == "running"):
        return Pill(
            f"running {step}/{count}" if count and phase == "running" else "running", "busy"
        )
    tones: dict[Phase, Tone] = {
        "thinking": "busy", "asking": "warn", "done": "good", "failed": "bad", "refused": "warn",
        "stopped": "warn",
    }  # fmt: skip
    return Pill(phase, tones.get(phase, "calm"))


def owner(state: RobotState | None, me: str) -> Pill:
    """Who holds the arm."""
    if state is None:
        return Pill("owner unknown", "calm")
    if state.owner is None:
        return Pill("arm free", "calm")
    return (
        Pill("you hold the arm", "good")
        if state.owner == me
        else Pill(f"held by {state.owner}", "warn")
    )


def service_news(key: str, alive: bool, others: Collection[str]) -> str:
    """One sentence about a service that came or went; ``others`` of its kind are still there."""
    kind, _, ident = key.partition("/")
    name = NAMES.get(kind, kind)
    if alive:
        return f"{name} {ident} is here"
    if others:
        return f"{name} {ident} is gone; {len(others)} left"
    return f"{name} is gone: {GONE.get(kind, 'it no longer answers')}"


def missing_news(services: Collection[str]) -> str | None:
    """What to say when services that are needed have not come up; None if all are there."""
    kinds = {key.split("/")[0] for key in services}
    missing = [name for kind, name in NEEDED.items() if kind not in kinds]
    return f"waiting for: {', '.join(missing)}" if missing else None

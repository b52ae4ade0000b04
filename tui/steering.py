"""What the keys mean for a program that runs or is held, and when one is held. No widgets.

F6 steps, F7 pauses and goes on. While this person's program is held, Enter lets it go on and Esc
gives it up. A program is held before its first line when it is previewed: nothing has moved then.
"""

from __future__ import annotations

from typing import Literal

from agent.messages import RobotLimits, RobotState

Mode = Literal["none", "runs", "held", "others"]
"""No program; one of this person's that runs, or is held; somebody else's."""

Hints = tuple[tuple[str, str], ...]


def mode(state: RobotState | None, me: str, ours: bool) -> Mode:
    """What there is to steer; ``ours``: a program of this person's is under way.

    Going home and loading a world are no programs: they have no line.
    """
    if state is None or state.program == "idle" or not (state.line or ours):
        return "none"
    if state.owner != me:
        return "others"
    return "held" if state.program == "paused" else "runs"


def hints(now: Mode, begun: bool, pausing: bool) -> Hints:
    """Keys of the bottom line, the most important first: narrow screens cut the rest."""
    if now == "held":
        return (("Enter", "go on" if begun else "run"), ("F6", "step"), ("Esc", "cancel"))
    return (("F6", "step"), ("F7", "go on" if pausing else "pause")) if now == "runs" else ()


def invitation(now: Mode, begun: bool, previewing: bool) -> str:
    """What the empty prompt says while nothing is asked."""
    if now == "held":
        return "Held: Enter goes on" if begun else "Nothing has moved: Enter runs it"
    return "Say what to do; you see it before it runs" if previewing else "Say what to do"


def verb(key: str, now: Mode, pausing: bool) -> str | None:
    """What enter, escape, f6 or f7 tells the bridge; None: nothing.

    F6 and F7 are sent for somebody else's program too: the refusal says whose it is.
    """
    if now == "none":
        return None
    if key == "f6":
        return "step"
    if key == "f7":
        return "resume" if now == "held" or pausing else "pause"
    if now != "held":
        return None
    return "resume" if key == "enter" else "cancel"


class Preview:
    """Whether a program is held before its first line: as told, else wherever it would be real."""

    def __init__(self, wanted: bool | None = None) -> None:
        self.wanted = wanted
        self.limits: RobotLimits | None = None

    @property
    def on(self) -> bool:
        """Off only where it was switched off, or nothing real moves."""
        if self.wanted is not None:
            return self.wanted
        return self.limits is None or not self.limits.simulated

    def command(self, word: str) -> str:
        """Obey ``on``, ``off`` or "" (say how it is); what to tell the person."""
        if word not in ("", "on", "off"):
            return "/preview on, or /preview off"
        if word:
            self.wanted = word == "on"
        if self.on:
            return "preview is on: a program is shown and held; Enter runs it, F6 steps it"
        return "preview is off: a program that passes the check runs at once"

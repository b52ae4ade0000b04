"""Where a run holds between two primitives: pause, resume, one line at a time, or the end of it.

No bus and no robot here: who runs a plan calls `Gate.begin` and, before each primitive,
`Gate.arrive`, on its own thread; everybody else calls the rest, from any thread.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import NamedTuple

from agent.errors import Cancelled, Stopped


class Place(NamedTuple):
    """Where in a program a primitive comes from: its line, and the pass of a loop over it."""

    line: int
    statement: int = 0


class Gate:
    """Lets one run pass, primitive by primitive.

    A step ends where the line changes, or the pass of a loop over it, so that all that one line
    does at once (a pick and place) goes together. What is under way is never cut short here.
    """

    def __init__(self, place: Place, hold: bool, tell: Callable[[bool], None]) -> None:
        """``place``: the first. ``tell(held)`` is called as a line begins, or is held before it."""
        self._changed = threading.Condition()
        self._place = place
        self._hold = hold
        self._until: Place | None = None
        self._waiting = self._moved = self._cancelled = False
        self._ended = ""
        self._tell = tell

    @property
    def line(self) -> int:
        """The line that runs, or comes next while the run is held."""
        return self._place.line

    @property
    def held(self) -> bool:
        """Whether nothing moves until somebody says so: not yet while a primitive still ends."""
        with self._changed:
            return self._waiting and self._hold and not self._ended

    @property
    def ended(self) -> str:
        """By whom the run was ended; "" if by nobody."""
        return self._ended

    # --- the thread that runs -------------------------------------------------------------------

    def begin(self) -> None:
        """The run stands before its first line; it may be held there from now on."""
        with self._changed:
            self._waiting = True
        if self.held:
            self._tell(True)

    def arrive(self, place: Place) -> None:
        """Wait, if need be, before a primitive of this place. Raises Stopped, Cancelled."""
        with self._changed:
            begins = place != self._place or not self._moved
            if self._until not in (None, place):
                self._hold, self._until = True, None
            self._place, self._waiting = place, True
            held = self.held
        if held and self._moved:  # `begin` told of the first line
            self._tell(True)
        self._pass()
        if begins or held:
            self._tell(False)

    def _pass(self) -> None:
        with self._changed:
            self._changed.wait_for(lambda: self._ended or not self._hold)
            self._waiting = False
            if self._ended:
                raise Cancelled(self._ended) if self._cancelled else Stopped(self._ended)
            self._moved = True

    # --- any other thread -----------------------------------------------------------------------

    def pause(self) -> None:
        """Hold before the next primitive."""
        with self._changed:
            self._hold, self._until = True, None

    def resume(self) -> None:
        """Go on to the end."""
        self._go(None)

    def step(self) -> None:
        """Go on to the end of the line that runs, or comes next, and hold there."""
        self._go(self._place)

    def _go(self, until: Place | None) -> None:
        with self._changed:
            self._hold, self._until = False, until
            self._changed.notify_all()

    def end(self, by: str) -> None:
        """Nothing passes any more: Stopped is raised where the run waits, or arrives next."""
        with self._changed:
            self._ended = self._ended or by
            self._changed.notify_all()

    def cancel(self) -> bool:
        """End the run on its owner's wish if it is held; whether it was."""
        with self._changed:
            held = self.held
            if held:
                self._cancelled = not self._moved
                self.end("you" if self._moved else "you, before anything moved")
            return held

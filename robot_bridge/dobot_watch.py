"""When a queued motion is over: number, alarms, pose and clock together, none of them alone (pure).

Firmware tells of commands that have not ended as if they had, or not at all while the arm moves;
under an alarm it skips motions and calls them done. So a motion is over when its number is told
(no larger one counts) and the arm rests at the target. Source: docs/dobot.md, defects 5 and 6.
"""

from __future__ import annotations

from agent.errors import MoveTimeout, NotAtTarget
from robot_bridge.dobot_cell import Millimetres

AT_TARGET, TURNED = 1.0, 1.0
"""How far from its target (mm, degrees) a motion may end."""
STILL, STILL_TURN = 0.05, 0.05
"""Change of pose (mm, degrees) below which the arm rests."""
STALL_S = 3.0
"""Seconds without a change of pose after which a motion counts as stuck."""
SETTLE_S = 0.5
"""Seconds for which an arm that is told to have ended elsewhere may still begin to move."""
LOOKS = 10
"""Looks that a stall, an end elsewhere or a missed deadline takes at least, however late they come:
where this process was held up itself, the arm is not to blame."""


class Watch:
    """Follows one queued command. ``target`` None: one that moves nothing, or homing."""

    def __init__(
        self, number: int, target: Millimetres | None, here: Millimetres, now: float,
        deadline: float, stall: float = STALL_S,
    ) -> None:  # fmt: skip
        self._number = number
        self._target = target
        self._last = here
        self._changed = now
        self._until = now + deadline
        self._stall = stall
        self._looks = self._overdue = 0
        self._told: float | None = None

    def look(self, finished: int, here: Millimetres, now: float) -> bool:
        """Whether it is over. Raises NotAtTarget, MoveTimeout."""
        rests = here.apart(self._last) <= STILL and here.turned(self._last) <= STILL_TURN
        self._looks = self._looks + 1 if rests else 0
        if not rests:
            self._changed, self._last = now, here
        told = finished == self._number
        if told and rests and self._is_at(here):
            return True
        self._told = None if not told else now if self._told is None else self._told
        self._not_stuck(here, now)
        return False

    def _is_at(self, here: Millimetres) -> bool:
        target = self._target
        return target is None or (here.apart(target) <= AT_TARGET and here.turned(target) <= TURNED)

    def _not_stuck(self, here: Millimetres, now: float) -> None:
        rested = now - self._changed if self._looks >= LOOKS else 0.0
        if self._told is not None and min(rested, now - self._told) > SETTLE_S and self._target:
            raise NotAtTarget(f"the motion ended {here.apart(self._target):.1f} mm off its target")
        if rested > self._stall:
            raise MoveTimeout(f"the arm has not moved for {self._stall:g} s, short of its target")
        self._overdue += now > self._until
        if self._overdue >= LOOKS:
            raise MoveTimeout("the motion took much longer than its length allows")

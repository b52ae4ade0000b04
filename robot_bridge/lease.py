"""Who may move the robot: one owner at a time, its epoch, and no old or late commands.

Pure rules without clock or bus; the service passes the time in. Refusal codes are one word each.
"""

from __future__ import annotations

from agent.messages import RobotCommand

SILENCE = 1.0
"""Seconds without a keepalive after which the owner counts as gone (it sends one every 0.25)."""

REFUSALS = {
    "busy": "another client holds the robot: only it can move, pause or step it",
    "no_lease_token": "declare your lease token before you acquire",
    "not_owner": "you do not hold the robot, or no longer (wrong epoch)",
    "stale_seq": "this command, or a later one of its session, was seen before",
    "late": "the command arrived after its deadline",
    "stopped": "stopped: reset, then resume",
    "running": "a program is running",
    "not_running": "no program is running",
    "bad_payload": "the command lacks what its verb needs",
}


class Lease:
    """The lease of one robot. Not thread-safe: its holder locks."""

    def __init__(self) -> None:
        self.owner: str | None = None
        self.epoch = 0
        self._session = ""
        self._heard = 0.0
        self._seqs: dict[str, int] = {}

    def acquire(self, command: RobotCommand, *, has_token: bool, wall: float, now: float) -> str:
        """Make the sender owner; "" or a refusal code. ``wall``: time of day, ``now``: steady."""
        code = self._fresh(command, wall)
        if code:
            return code
        if not has_token:
            return "no_lease_token"
        if self.busy(command):
            return "busy"
        if self.owner is None:
            self.epoch += 1
        self.owner, self._session, self._heard = command.client, command.session, now
        return ""

    def busy(self, command: RobotCommand) -> bool:
        """Whether somebody other than the sender is the owner."""
        owner = (self.owner, self._session)
        return self.owner is not None and owner != (command.client, command.session)

    def check(self, command: RobotCommand, *, wall: float) -> str:
        """Whether this command may be obeyed: "" or a refusal code.

        The owner's own commands and those the agent sends for it carry the owner's name and epoch.
        """
        if self.owner != command.client or self.epoch != command.epoch:
            return "not_owner"
        return self._fresh(command, wall)

    def keepalive(self, command: RobotCommand, *, wall: float, now: float) -> str:
        """The owner is alive: only its own session can say so."""
        if self._session != command.session:
            return "not_owner"
        code = self.check(command, wall=wall)
        if not code:
            self._heard = now
        return code

    def silent(self, now: float) -> bool:
        """Whether the owner has been silent for too long."""
        return self.owner is not None and now - self._heard > SILENCE

    def drop(self) -> None:
        """Nobody owns the robot; the next owner gets a new epoch."""
        self.owner, self._session = None, ""

    def _fresh(self, command: RobotCommand, wall: float) -> str:
        if command.deadline < wall:
            return "late"
        if command.seq <= self._seqs.get(command.session, 0):
            return "stale_seq"
        self._seqs[command.session] = command.seq
        while len(self._seqs) > 256:
            self._seqs.pop(next(iter(self._seqs)))
        return ""

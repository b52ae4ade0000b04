"""Every error armchat raises on purpose, in one tree.

ArmchatError
├── ConfigError              a key, a value or an option is wrong: names file, key, nearest key
├── SceneError               a scene that cannot be: names object and field
├── CameraError              no picture: unplugged, no such file, no permission
├── CalibrationError         missing, of another camera, or too bad to be used
├── ProgramError             line, column, reason
│   ├── NotAllowed           refused before it ran (text scan, parser, allow-list)
│   ├── ProgramFailed        it ran and hit an error of its own (None has no x)
│   │   └── Unsatisfiable    its constraints cannot all hold
│   ├── LimitReached         it ran into an execution limit
│   └── SolverFailed         the solver, or the process it lives in, failed; nothing else is known
├── TranslatorError          no model, broken weights
├── BusError
│   ├── NoService            nobody answers on that key
│   ├── NoAnswer             a service is there but did not answer in time
│   └── Declined(code)       a service answered with an error
└── RobotError
    ├── Unreachable(point)   inverse kinematics or workspace; nothing was sent
    ├── NotReady             not homed, alarm, latched stop, queue full
    ├── NoReply              outcome unknown; a motion is never re-sent
    ├── LinkDown             connection lost, motion state unknown
    ├── AlarmError           the controller raised alarms (codes, remedy)
    ├── MoveTimeout          no end of motion within its deadline
    ├── NotAtTarget          ended somewhere else
    └── Stopped(by)          STOP, lease lost
        └── Cancelled        called off by its owner before anything moved
"""

from __future__ import annotations


class ArmchatError(Exception):
    """Base of all errors that armchat raises on purpose; ``str(error)`` is for people."""


class ConfigError(ArmchatError):
    """A configuration file, environment variable or option is wrong."""


class SceneError(ArmchatError):
    """A scene, or an object in it, that cannot be."""


class CameraError(ArmchatError):
    """No picture: unplugged, no such file, no permission; the text says what to do."""


class CalibrationError(ArmchatError):
    """A calibration is missing, does not fit this camera, or is too bad to be used."""


class ProgramError(ArmchatError):
    """A program that was refused or went wrong; line and column count from 1 (0: unknown)."""

    def __init__(self, reason: str, line: int = 0, column: int = 0) -> None:
        super().__init__(f"line {line}: {reason}" if line else reason)
        self.reason = reason
        self.line = line
        self.column = column


class NotAllowed(ProgramError):
    """The program was refused before it ran."""


class ProgramFailed(ProgramError):
    """The program ran and hit an error of its own."""


class Unsatisfiable(ProgramFailed):
    """Required constraints of the program cannot all hold (on the table)."""


class LimitReached(ProgramError):
    """The program ran into an execution limit."""


class SolverFailed(ProgramError):
    """The worker that interprets and solves died, was too slow, or found no usable answer."""


class TranslatorError(ArmchatError):
    """No model, or weights that cannot be used."""


class BusError(ArmchatError):
    """The bus, or a service on it, did not answer as it should."""


class NoService(BusError):
    """Nobody answers on the key."""


class NoAnswer(BusError):
    """A service (or its token) did not answer in time; whether it acted is unknown."""


class Declined(BusError):
    """A service answered with an error; ``code`` is one word that programs can test."""

    def __init__(self, code: str, text: str) -> None:
        super().__init__(text)
        self.code = code


class RobotError(ArmchatError):
    """A robot could not do, or did not finish, what it was told."""


class Unreachable(RobotError):
    """A point outside the workspace or the reach; nothing was sent."""

    def __init__(self, why: str, line: int = 0) -> None:
        super().__init__(why)
        self.line = line


class NotReady(RobotError):
    """The robot takes no motion now (not homed, alarm, latched stop, queue full)."""


class NoReply(RobotError):
    """A command was sent and not answered: its outcome is unknown."""


class LinkDown(RobotError):
    """Connection lost, motion state unknown. ``moving``: a motion had begun by then."""

    moving = False


class AlarmError(RobotError):
    """The controller raised alarms: ``codes``, and their ``remedy``, which the text names too."""

    def __init__(self, why: str, codes: tuple[int, ...] = (), remedy: str = "") -> None:
        super().__init__(why)
        self.codes = codes
        self.remedy = remedy


class MoveTimeout(RobotError):
    """A motion did not end within its deadline."""


class NotAtTarget(RobotError):
    """A motion ended more than the tolerance away from its target."""


class Stopped(RobotError):
    """Motion was stopped; ``by`` says by whom or what."""

    def __init__(self, by: str) -> None:
        super().__init__(f"stopped by {by}")
        self.by = by


class Cancelled(Stopped):
    """The owner called a held plan off before anything moved."""

"""A case of `evals.outcomes`, and what became of it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal, NamedTuple, TypeVar

import msgspec

from agent.messages import Kind, QuestionKind, Status, Turn
from evals.goals import Goal

Outcome = Literal["right", "wrong", "over_asked", "asked_wrongly", "missed", "refused", "failed"]
"""``missed``: did nothing wrong, but not what it should have refused or asked about; ``refused``:
refused or only talked where it should have acted or asked."""
Item = TypeVar("Item")


class Want(msgspec.Struct, frozen=True):
    """What may become of one turn; ``options`` are ids that a question must offer."""

    status: tuple[Status, ...]
    kind: tuple[QuestionKind, ...] = ()
    options: tuple[str, ...] = ()


class Case(msgspec.Struct, frozen=True):
    """One case; ``after`` must hold at the end, or all of one entry of ``after_any``.

    They bind if the last turn was done. ``goal`` always binds: calls of `evals.goals`;
    ``metrics`` are such calls too, by name, and only counted.
    """

    id: str
    family: str
    voice: str
    scene: Any
    turns: tuple[str, ...]
    want: tuple[Want, ...]
    after: tuple[str, ...] = ()
    after_any: tuple[tuple[str, ...], ...] = ()
    goal: tuple[Goal, ...] = ()
    metrics: dict[str, tuple[Goal, ...]] = {}
    task: Kind | None = None


class Score(NamedTuple):
    """The outcome of a case, and why in a few words."""

    case: Case
    outcome: Outcome
    why: str
    turns: tuple[Turn, ...] = ()
    metrics: dict[str, bool] = {}  # noqa: RUF012 - nothing is ever put in


def some(items: Sequence[Item], most: int | None) -> Sequence[Item]:
    """At most so many of the items (None: all), from all parts of them alike."""
    return items if most is None else items[:: max(1, -(-len(items) // most))]

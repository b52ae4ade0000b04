"""Case files of another form, read as cases of ours: sets that stay outside the repository.

A line is ``id``, ``family``, ``scene``, ``turns``, ``task``, and ``expect``: for each turn its
allowed statuses, or an object of ``status``, ``kind`` and ``ids`` (what a question must offer).
``goal`` is a list of calls (`evals.goals`), ``metrics`` such lists by name. A line that starts with
``meta`` says where the set is from; a ``coverage`` case has no verdict: both are passed over.
Nothing of such files may be trained on, tuned on or copied into the repository.
"""

from __future__ import annotations

from typing import Any

import msgspec

from agent.messages import Kind, QuestionKind, Status
from evals.cases import Case, Want
from evals.goals import Goal


class Expected(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What may become of one turn."""

    status: tuple[Status, ...]
    kind: tuple[QuestionKind, ...] = ()
    ids: tuple[str, ...] = ()


class Row(msgspec.Struct, frozen=True, kw_only=True):
    """One line of such a file."""

    id: str
    family: str
    scene: Any
    turns: tuple[str, ...]
    task: Kind | None = None
    expect: tuple[Expected | tuple[Status, ...], ...]
    goal: tuple[Goal, ...] = ()
    metrics: dict[str, tuple[Goal, ...]] = {}


def is_external(row: dict[str, Any]) -> bool:
    """Whether a line is of this form."""
    return bool({"meta", "expect", "coverage"} & set(row))


def case_of(row: dict[str, Any]) -> Case | None:
    """The case of a line; None if the line has no verdict. Raises msgspec.ValidationError."""
    if "meta" in row or row.get("coverage"):
        return None
    read = msgspec.convert(row, Row)
    return Case(
        id=read.id, family=read.family, voice="", scene=read.scene, turns=read.turns,
        want=tuple(_want(one) for one in read.expect),
        goal=read.goal, metrics=read.metrics, task=read.task,
    )  # fmt: skip


def _want(expected: Expected | tuple[Status, ...]) -> Want:
    if isinstance(expected, tuple):
        return Want(expected)
    return Want(expected.status, expected.kind, expected.ids)

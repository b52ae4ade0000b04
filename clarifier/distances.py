"""Nearest and farthest in the words people use: "most near to", "the farthest away from",
"furthest to the right". Plain forms ("closest to") are relations of the lexicon.
"""

from __future__ import annotations

from collections.abc import Sequence

_CLOSE = {"near": "nearest", "close": "nearest", "far": "furthest", "distant": "furthest"}
_GRADED = {
    "nearest": "nearest", "closest": "nearest", "furthest": "furthest", "farthest": "furthest",
    "nearer": "nearest", "closer": "nearest", "further": "furthest", "farther": "furthest",
}  # fmt: skip
_DEGREES = frozenset({"most", "more"})
_UTMOST = frozenset({"most", "furthest", "farthest"})
_SIDES = frozenset({"left", "right"})
_LEADING = {"nearest": ("to", "by"), "furthest": ("from", "of")}
_COPULAS = frozenset({"is", "are", "was", "were", "that's", "being", "stands", "lies", "sits"})

UTMOST = "utmost"
"""The relation of what lies furthest to a side."""


def distance_run(words: Sequence[str], at: int) -> tuple[str, int] | None:
    """The relation that a run of words says, and the index behind it; None if there is none.

    "The" is part of it only behind a copula: "that is the closest to", but "the closest cup".
    """
    start = at
    if _word(words, at) == "the" and _word(words, at - 1) in _COPULAS and at:
        start = at + 1
    return _utmost(words, start) or _graded(words, start, start > at)


def _graded(words: Sequence[str], at: int, sure: bool) -> tuple[str, int] | None:
    """ "most far from", "farthest away", and with ``sure`` also "closest to"."""
    if _word(words, at) in _DEGREES and _word(words, at + 1) in _CLOSE:
        relation, end, sure = _CLOSE[words[at + 1]], at + 2, True
    elif _word(words, at) in _GRADED:
        relation, end = _GRADED[words[at]], at + 1
    else:
        return None
    away = relation == "furthest" and _word(words, end) == "away"
    end += away
    leads = _word(words, end) in _LEADING[relation]
    return (relation, end + leads) if sure or away else None


def _utmost(words: Sequence[str], at: int) -> tuple[str, int] | None:
    """ "most right", "furthest to the left"."""
    if _word(words, at) not in _UTMOST:
        return None
    end = at + 1
    if _word(words, end) in ("to", "on") and _word(words, end + 1) in ("the", "my"):
        end += 2
    if _word(words, end) not in _SIDES or _word(words, end + 1) == "of":
        return None
    return UTMOST, end + 1


def _word(words: Sequence[str], at: int) -> str:
    return words[at] if 0 <= at < len(words) else ""

"""From which probability on an outcome is acted on, asked about, or let go.

The set C = {c: p(c) >= 1 - qhat} holds what was meant in 1 - epsilon of all dialogues like those it
was calibrated on (`evals.conformal`, clarifier design, "Conformal calibration"). Sentences of other
hands are not like those, so that fixed floors, chosen by outcome on a development set, stand beside
it (evals/LOG.md).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import msgspec

CARD = Path(__file__).parent / "conformal.json"


class Card(msgspec.Struct, frozen=True, kw_only=True):
    """What a calibration found, and what it was made with."""

    qhat: float
    epsilon: float
    delta: float
    n: int
    seed: int
    recall: float
    marginal: float
    groups: dict[str, float]
    group_n: dict[str, int]
    command: str
    model: str


class Policy(NamedTuple):
    """``level``: 1 - qhat, the least probability of what is in the set C: of several in it one is
    never acted on unasked. ``act``: least
    probability of what is acted on; ``stated``: the same for sentences that no verb opens ("the cup
    to the left"): they may want nothing. ``ask``: least probability at which the person is asked
    whether this is what was meant."""

    level: float
    act: float = 0.75
    stated: float = 0.9
    ask: float = 0.35


def load(path: Path = CARD) -> Card:
    """The card of the calibration that the product goes by."""
    return msgspec.json.decode(path.read_bytes(), type=Card)


def quantile(scores: Sequence[float], k: int) -> float:
    """The ``k``-th smallest of the scores, counted from 1; 1 ("everything") beyond them."""
    return sorted(scores)[k - 1] if k <= len(scores) else 1.0


def marginal(n: int, epsilon: float) -> int:
    """k for which a new score is at most the k-th smallest with probability 1 - epsilon."""
    return math.ceil((n + 1) * (1 - epsilon))


def confident(n: int, epsilon: float, delta: float) -> int:
    """k for which that holds with probability 1 - delta over the calibration itself: n + 1 - v with
    the largest v of which BinCDF(v - 1; n, epsilon) <= delta."""
    v, below, term = 0, 0.0, (1 - epsilon) ** n
    while below + term <= delta:
        below += term
        v += 1
        term *= (n - v + 1) / v * epsilon / (1 - epsilon)
    return n + 1 - v


def calibrated(card: Card) -> Policy:
    """The product's policy: the calibrated set, and the fixed floors."""
    return Policy(1.0 - card.qhat)


PRODUCT = calibrated(load())

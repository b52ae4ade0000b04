"""Two translators: the fast one first, the slow one where the fast one is unsure.

Where both were asked, a candidate's probability is the mean of what the two give it: what both mean
becomes likelier, what only one means less likely, so disagreement is doubt, and the clarifier, who
counts programs that end alike as one, asks.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Protocol

from agent.messages import Attention, Candidate, TranslateRequest, Translation


class Translates(Protocol):
    """A translator that can say what it looked at."""

    def __call__(self, request: TranslateRequest) -> Translation:
        """Translate; best first."""
        ...

    def attend(self, request: TranslateRequest) -> Sequence[Attention]:
        """What was looked at for each candidate."""
        ...


SURE = 0.9
"""Confidence of the fast translator from which on the slow one is not asked."""
NEVER = 1e-9
"""Probability of what is not among a translator's candidates."""


class Cascade:
    """A translator made of two; as thread-safe as they are."""

    def __init__(self, fast: Translates, slow: Translates, sure: float = SURE) -> None:
        self._fast = fast
        self._slow = slow
        self._sure = sure

    def __call__(self, request: TranslateRequest) -> Translation:
        """Translate; candidates are programs over the request's slots, best first."""
        first = self._fast(request)
        if first.confidence >= self._sure:
            return first
        return both(first, self._slow(request), request.k)

    def attend(self, request: TranslateRequest) -> Sequence[Attention]:
        """What the fast translator looked at."""
        return self._fast.attend(request)


def both(one: Translation, other: Translation, k: int) -> Translation:
    """What two translators say together, the ``k`` likeliest first."""
    likely: dict[str, float] = {}
    known: dict[str, Candidate] = {}
    for told in (one, other):
        for candidate in told.candidates:
            known.setdefault(candidate.body, candidate)
            share = 0.5 * _probability(candidate, told)
            likely[candidate.body] = likely.get(candidate.body, NEVER) + share
    ranked = sorted(likely, key=lambda body: -likely[body])[:k]
    candidates = tuple(
        Candidate(body, math.log(likely[body]), known[body].length) for body in ranked
    )
    confidence = min(1.0, likely[ranked[0]]) if ranked else 0.0
    unknown = tuple(dict.fromkeys((*one.unknown, *other.unknown)))
    return Translation(candidates, confidence, one.ms + other.ms, unknown)


def _probability(candidate: Candidate, told: Translation) -> float:
    """A candidate's probability, calibrated as the confidence in the first one is."""
    best = told.candidates[0].logprob
    if best >= 0.0 or told.confidence >= 1.0 or told.confidence <= 0.0:
        return told.confidence * math.exp(candidate.logprob - best)
    return math.exp(candidate.logprob * math.log(told.confidence) / best)

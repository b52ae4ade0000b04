"""Sentences of several phrases, translated phrase by phrase as well as whole.

"Split at the commas each phrase is right" (arXiv 2012.13695, section V-C). The clarifier says
where the phrases are (`TranslateRequest.phrases`); each is translated alone, its slots numbered as
in a sentence of its own, and the programs follow one another, later ones meaning things where they
are by then. Whole or by phrases: what is likelier to be right comes first.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import product
from typing import TypeVar

import msgspec

from agent.messages import Attention, Candidate, Mention, Quantity, TranslateRequest, Translation
from translator.chain import remembered
from translator.translate import renamed

Translate = Callable[[TranslateRequest], Translation]

CERTAIN = 0.97
"""A sentence translated whole with this confidence is not translated by phrases."""
TRIED = 2
"""Candidates of each phrase that are tried with those of the others."""


class PhraseTranslator:
    """A translator that also goes phrase by phrase; as thread-safe as the one it asks."""

    def __init__(self, translate: Translate) -> None:
        self._translate = translate

    def __call__(self, request: TranslateRequest) -> Translation:
        """Translate; candidates are programs over the request's slots, best first."""
        whole = self._translate(request)
        if len(request.phrases) < 2 or whole.confidence >= CERTAIN:
            return whole
        parts = [_alone(request, start, end) for start, end in request.phrases]
        found = [self._translate(part) for part, _ in parts]
        if not all(one.candidates for one in found):
            return whole
        joined = _joined(found, [names for _, names in parts], request.k)
        confidence = math.prod(one.confidence for one in found)
        spent = whole.ms + sum(one.ms for one in found)
        if confidence <= whole.confidence:
            return msgspec.structs.replace(whole, ms=spent)
        rest = tuple(one for one in whole.candidates if one.body not in {o.body for o in joined})
        # what was translated whole comes behind, as far behind as it is less likely
        least = min(one.logprob for one in joined)
        behind = tuple(
            msgspec.structs.replace(one, logprob=min(one.logprob, least)) for one in rest
        )
        return Translation((*joined, *behind)[: request.k], confidence, spent, whole.unknown)


def attend(
    request: TranslateRequest, attend_whole: Callable[[TranslateRequest], Sequence[Attention]]
) -> tuple[Attention, ...]:
    """What is looked at for the candidates of `PhraseTranslator`: those of the whole sentence, then
    those by phrases, each phrase read by itself (its pieces and its ``<end>`` included)."""
    whole = tuple(attend_whole(request))
    parts = [_alone(request, start, end) for start, end in request.phrases]
    found = [attend_whole(part)[:TRIED] for part, _ in parts]
    if len(parts) < 2 or not all(found):
        return whole
    names = [own for _, own in parts]
    return whole + tuple(_side_by_side(way, names) for way in product(*found))


def _side_by_side(way: Sequence[Attention], names: Sequence[dict[str, str]]) -> Attention:
    """The attention of each phrase, one below and beside the other."""
    both = list(zip(way, names, strict=True))
    pieces = tuple(piece for one in way for piece in one.pieces)
    rows, before = list[tuple[float, ...]](), 0
    for one in way:
        after = len(pieces) - before - len(one.pieces)
        rows += [(0.0,) * before + row + (0.0,) * after for row in one.weights]
        before += len(one.pieces)
    return Attention(
        remembered([renamed(one.body, own) for one, own in both]),
        tuple(renamed(token, own) for one, own in both for token in one.tokens),
        pieces,
        tuple(rows),
    )


def _joined(
    found: Sequence[Translation], names: Sequence[dict[str, str]], k: int
) -> tuple[Candidate, ...]:
    """The likeliest ways to take one candidate for each phrase, as programs over the whole."""
    ways = sorted(
        product(*(one.candidates[:TRIED] for one in found)),
        key=lambda way: -sum(one.logprob for one in way),
    )
    return tuple(
        Candidate(
            remembered([renamed(one.body, own) for one, own in zip(way, names, strict=True)]),
            sum(one.logprob for one in way),
            sum(one.length for one in way),
        )
        for way in ways[:k]
    )


def _alone(
    request: TranslateRequest, start: int, end: int
) -> tuple[TranslateRequest, dict[str, str]]:
    """The phrase ``text[start:end]`` as a request, and what its slots are in the whole sentence."""
    own: dict[str, str] = {}
    mentions, measures = [], []
    for mention in sorted(request.mentions, key=lambda one: one.start):
        if start <= mention.start and mention.end <= end:
            slot = own.setdefault(mention.slot, f"m{len(own) + 1}")
            mentions.append(_moved(mention, slot, start))
    counts: dict[str, int] = {}
    for measure in sorted(request.measures, key=lambda one: one.start):
        if start <= measure.start and measure.end <= end:
            letter = measure.slot[0]
            counts[letter] = counts.get(letter, 0) + 1
            slot = own.setdefault(measure.slot, f"{letter}{counts[letter]}")
            measures.append(_moved(measure, slot, start))
    part = TranslateRequest(
        request.text[start:end], tuple(mentions), request.kind, request.k, tuple(measures)
    )
    names = {new: old for old, new in own.items()}
    return part, names | {f"w{new[1:]}": f"w{old[1:]}" for new, old in names.items()}


Span = TypeVar("Span", Mention, Quantity)


def _moved(span: Span, slot: str, by: int) -> Span:
    return msgspec.structs.replace(span, slot=slot, start=span.start - by, end=span.end - by)

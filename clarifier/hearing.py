"""A second hearing: what could not be settled is heard again without the talk in it, and what is
nothing but talk is not acted on.

People tell stories, give reasons and correct themselves around what they want, or want nothing at
all. A tagger (passed in) says which words are talk. The sentence as it was said goes first.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import msgspec

from agent.messages import ClarifyRequest, Decision, QuestionKind
from clarifier.refusals import BEYOND
from clarifier.talk import OFF_TOPIC

SURE = 0.9
"""How likely a program must be that leaves out words which were said."""
SHORT = 4
"""Words of what may only be understood behind what was said before, at most."""
Hears = Callable[[str], Sequence[str]]
"""A sentence without its talk, in the ways worth trying; none where it has none, just "" where it
is nothing else."""
_PUZZLED: frozenset[QuestionKind] = frozenset({"unknown_word", "confirm", "open", "missing"})
"""Questions that may come from words which were not meant for the arm."""
_PRECISE: frozenset[QuestionKind] = frozenset({"which", "where", "direction", "how_many"})


def decided(
    decide: Callable[[ClarifyRequest], Decision], hears: Hears | None, request: ClarifyRequest
) -> Decision:
    """What is decided on the sentence as it was said, or else on what is left without its talk."""
    first = decide(request)
    if hears is None or not (first.do == "act" or _puzzled(first)):
        return first
    heard = list(hears(request.text))
    if first.do == "act":
        chat = heard == [""] and request.dialog.pending is None and not _follows(request)
        return _nothing_wanted(first, request) if chat else first
    best, spent = first, first.ms_translate
    for plainer in filter(None, heard):
        again = decide(msgspec.structs.replace(request, text=plainer))
        spent += again.ms_translate
        if again.do == "act" and (again.confidence or 0.0) >= SURE:
            best = again
            break
        if best.do == "refuse" and _asks(again, _PRECISE):
            best = again
    return msgspec.structs.replace(best, ms_translate=spent)


def _follows(request: ClarifyRequest) -> bool:
    """Whether a few words may go on from what was done: "and again", "a bit more"."""
    return request.dialog.last_text is not None and len(request.text.split()) <= SHORT


def _nothing_wanted(first: Decision, request: ClarifyRequest) -> Decision:
    why = "all of the sentence is talk"
    said = Decision("answer", why, request.dialog, reply=OFF_TOPIC)
    return msgspec.structs.replace(said, ms_translate=first.ms_translate)


def _puzzled(decision: Decision) -> bool:
    """Whether it may come from words that were not meant; what no arm does was meant."""
    if decision.why.endswith(BEYOND):
        return False
    if decision.do == "refuse":
        return decision.reason == "not_understood"
    return _asks(decision, _PUZZLED)


def _asks(decision: Decision, kinds: frozenset[QuestionKind]) -> bool:
    question = decision.question
    return decision.do == "ask" and question is not None and question.kind in kinds

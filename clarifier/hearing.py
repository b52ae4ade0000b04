"""A second hearing: what could not be settled is heard again without the talk in it.

People tell stories, give reasons and correct themselves around what they want. A tagger (passed in)
says which words are talk. The sentence as it was said goes first: nothing that was understood is
heard differently.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import msgspec

from agent.messages import ClarifyRequest, Decision, QuestionKind

Hears = Callable[[str], Sequence[str]]
"""A sentence without its talk, in the ways worth trying; none where it has none."""
_PUZZLED: frozenset[QuestionKind] = frozenset({"unknown_word", "confirm", "open", "missing"})
"""Questions that may come from words which were not meant for the arm."""
_PRECISE: frozenset[QuestionKind] = frozenset({"which", "where", "direction", "how_many"})


def decided(
    decide: Callable[[ClarifyRequest], Decision], hears: Hears | None, request: ClarifyRequest
) -> Decision:
    """What is decided on the sentence as it was said, or else on what is left without its talk."""
    first = decide(request)
    if hears is None or not _puzzled(first):
        return first
    best, spent = first, first.ms_translate
    for plainer in hears(request.text):
        again = decide(msgspec.structs.replace(request, text=plainer))
        spent += again.ms_translate
        if again.do == "act":
            best = again
            break
        if best.do == "refuse" and _asks(again, _PRECISE):
            best = again
    return msgspec.structs.replace(best, ms_translate=spent)


def _puzzled(decision: Decision) -> bool:
    if decision.do == "refuse":
        return decision.reason == "not_understood"
    return _asks(decision, _PUZZLED)


def _asks(decision: Decision, kinds: frozenset[QuestionKind]) -> bool:
    question = decision.question
    return decision.do == "ask" and question is not None and question.kind in kinds

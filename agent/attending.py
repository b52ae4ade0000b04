"""What the translator looked at for a program that was shown, asked of it once more.

The requests that this process's translator was asked last are kept; the one that a program came
from is told by the program itself, which is a candidate's with names in the place of its slots.
"""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Callable, Sequence

from msgspec.structs import replace

from agent.messages import Attention, TranslateRequest, Translation
from agent.program import instantiate

KEPT = 32
"""Requests that are remembered; a sentence needs a few."""

_SLOT = re.compile(r"\b[mgdtn]\d+\b")
_NAMED = r"\w+|\[[^\]\n]*\]|\(?[-+.\de]+\)?"
"""What can stand for a slot: a name, a list of names, a number."""


class Attending:
    """A translate function that remembers what it was asked; safe to call from any thread."""

    def __init__(
        self,
        translate: Callable[[TranslateRequest], Translation],
        attend: Callable[[TranslateRequest], Sequence[Attention]],
    ) -> None:
        self._translate = translate
        self._attend = attend
        self._asked: deque[TranslateRequest] = deque(maxlen=KEPT)

    def __call__(self, request: TranslateRequest) -> Translation:
        """Translate, and remember the request."""
        self._asked.append(request)
        return self._translate(request)

    def of(self, program: str) -> Attention | None:
        """The attention of the newest candidate that became this program, over its names; None
        if the program is none that was translated here lately. Raises TranslatorError."""
        for request in reversed(list(self._asked)):
            for attention in self._attend(request):
                names = fitted(attention.body, program)
                if names is not None:
                    tokens = tuple(instantiate(token, names) for token in attention.tokens)
                    return replace(attention, body=program, tokens=tokens)
        return None


def fitted(body: str, program: str) -> dict[str, str] | None:
    """What stands for each slot of a candidate's body in a program; None if it is another's."""
    pattern, at, seen = "", 0, set[str]()
    for slot in _SLOT.finditer(body):
        name = slot.group()
        pattern += re.escape(body[at : slot.start()])
        pattern += rf"(?P={name})" if name in seen else rf"(?P<{name}>{_NAMED})"
        seen.add(name)
        at = slot.end()
    found = re.fullmatch(pattern + re.escape(body[at:]), program)
    return None if found is None else found.groupdict()

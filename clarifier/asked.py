"""An open question as its answer is read against it, and what an answer can be."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from agent.messages import Pending
from clarifier.lexicon import Lexicon
from clarifier.orders import AT_THE_BOTTOM
from scene.types import Scene

AnswerKind = Literal["pick", "none", "any", "both", "again", "unclear", "thing", "words", "other"]
ARTICLES = frozenset({"the", "a", "an", "my", "that", "this", "please"})


@dataclass(frozen=True)
class Answer:
    """``pick``: option ``index``. ``thing``: names a thing that was no option (``text``).
    ``words``: fills an open role with ``text``. ``unclear``: meant as an answer, fits no option.
    ``other``: no answer at all."""

    kind: AnswerKind
    index: int = -1
    text: str = ""


class Asked:
    """The question that waits, its options, and what they are about."""

    def __init__(self, pending: Pending, scene: Scene, lexicon: Lexicon) -> None:
        self._text = pending.text
        self._asks_bottom = pending.question.text.startswith(AT_THE_BOTTOM)
        self._kind = pending.question.kind
        self._options = pending.question.options
        self._scene = scene
        self._lexicon = lexicon

    @property
    def _asks_number(self) -> bool:
        return self._kind == "how_many" and len(self._options) > 1

    def _without_choosing(self, said: Sequence[str]) -> list[str]:
        """The words without "I mean", "take", ...; what follows a relation stays whole."""
        choosing = self._lexicon.words("choosing") - {"one", "the", "on", "at", "in", "by", "with"}
        at = 0
        while at < len(said) and said[at] in choosing:
            at += 1
        return list(said[at:])


def determined(core: str) -> str:
    """The text with "the" before it if it has no determiner."""
    first = core.split()[0] if core.split() else ""
    known = ARTICLES | {"any", "all", "both", "your", "its", "these", "those", "one", "on", "at"}
    return core if first in known else f"the {core}"

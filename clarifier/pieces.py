"""The pieces that a sentence is cut into, and the small words that part them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

JOINTS = frozenset(
    {"and", "then", "but", "or", "while", "before", "after", "if", "when", "because", "once"}
    | {",", ".", ";", ":", "!", "?", "until", "so", "else", "otherwise", "unless", "than", "as"}
)
ARTICLES = frozenset({"the", "my", "your", "our", "his", "her", "their", "its", "that", "this"})
FREE = frozenset({"a", "an", "any", "another", "either", "some", "whichever"})
"""Determiners that leave open which of several is meant."""
MANY = frozenset({"all", "both", "each", "every", "these", "those", "others"})
"""Determiners of several; "others" stands for "all the other"."""
DETERMINERS = ARTICLES | FREE | MANY | {"no"}
STOPS = (
    JOINTS
    | DETERMINERS
    | {"it", "them", "they", "you", "i", "me", "we", "is", "are", "be", "was", "were", "should"}
    | {"must", "can", "could", "would", "will", "which", "who", "not", "do", "does", "please"}
    | {"to", "of", "now", "again", "too", "also", "thanks", "it's", "that's", "has", "have", "down"}
    | {"up", "off", "over", "away", "there", "here", "out", "gently", "slowly", "carefully"}
    | {"belongs", "belong", "goes", "gets", "becomes", "become", "needs", "wants", "stays", "comes"}
    | {"lives", "looks", "stands", "sits", "lies", "deserves", "ends", "among", "being", "been"}
    | {"without", "except", "excluding", "minus", "besides", "apart", "while"}
    | {"though", "however"}
)
MODAL_SUBJECTS = frozenset({"you", "we", "i", "it", "the", "this", "that", "be", "u", "they"})
COUNTS = {"couple": 2.0, "pair": 2.0, "few": 0.0, "several": 0.0, "bunch": 0.0,
          "handful": 0.0}  # fmt: skip
REACH = 8
"""Longest run of words (adjectives and noun) that is read as one noun phrase."""

ChunkKind = Literal[
    "np", "pronoun", "relation", "place", "verb", "joint", "measure", "except", "other"
]
Group = Literal["", "all", "rest", "others", "them"]


@dataclass(frozen=True)
class Phrase:
    """A noun phrase: tokens ``first:last`` without the determiner, which starts at ``opened``.

    ``head`` is () for "one" and for adjectives alone. ``count`` is None where no number was
    said and 0 for "a few" or "some". ``origin`` is the side from which an ordinal counts. ``group``
    is set where no noun was said: ``all`` ("everything"), ``rest``, ``others`` (of the same kind),
    ``them`` ("all of them"). ``also``: other adjectives of the noun ("the red and blue cups").
    """

    opened: int
    first: int
    last: int
    det: str
    count: float | None
    modifiers: tuple[str, ...]
    head: tuple[str, ...]
    plural: bool = False
    origin: str = ""
    known: bool = True
    group: Group = ""
    also: tuple[tuple[str, ...], ...] = ()

    @property
    def any_will_do(self) -> bool:
        """ "an apple", "any cup", "two blocks": which of them does not matter."""
        if self.plural:
            return bool(self.count) and (not self.det or self.det in FREE)
        return self.det in FREE or (self.count == 1 and not self.det)

    @property
    def names_one(self) -> bool:
        """Whether a plural can be one thing's name: "the beans" (a can of them), "the glasses"; not
        "all the cups", "two cups", "the red and blue cups"."""
        counted = self.count is not None or self.det in MANY | FREE
        return self.plural and not (counted or self.group or self.also)

    @property
    def vague(self) -> bool:
        """ "some blocks", "a few": several, and it was not said how many."""
        return self.plural and (self.count == 0 or (self.det == "some" and self.count is None))


@dataclass(frozen=True)
class Chunk:
    """A piece of the sentence, tokens ``first:last``; ``value`` is the relation or verb class."""

    kind: ChunkKind
    first: int
    last: int
    value: str = ""
    phrase: Phrase | None = None


@dataclass(frozen=True)
class DeniedPlace:
    """Nothing that is moved is to stand in ``relation`` to one of ``anchors``."""

    relation: str
    anchors: tuple[str, ...]

"""A sentence in pieces: noun phrases, relations, places, verbs and joints; no scene semantics.

The scene's names decide where a noun phrase ends, so a parser is made for one sentence over one
scene.
"""

from __future__ import annotations

from clarifier.behind import Behind
from clarifier.groups import exception, group_phrase
from clarifier.pieces import DETERMINERS, JOINTS, Chunk
from clarifier.words import number

_SWAPPING = frozenset({"change", "trade", "swap", "switch", "exchange", "changed", "swapped"})


_PARTS = frozenset({"edge", "side", "half", "end", "border", "corner", "table", "desk", "board"})
_LEADING = frozenset({"of", "on", "onto", "in", "into", "inside", "behind", "beside", "to", "by"})
_CLOSING = frozenset({"", "please", "too", "now", "as", "thanks", "again", "instead"})
"""Behind "that" where it stands for a thing: "on top of that, please"."""


class Parser(Behind):
    """Cuts one sentence into chunks, knowing the names of the scene's objects."""

    def chunks(self) -> tuple[Chunk, ...]:
        """The whole sentence as chunks, in order, every token in exactly one."""
        found: list[Chunk] = []
        at = 0
        while at < len(self.tokens):
            before = found[-1] if found else None
            found += self.denied(at, before) or [self._chunk(at, before)]
            at = found[-1].last
        return tuple(found)

    def _chunk(self, at: int, previous: Chunk | None) -> Chunk:
        word = self._words[at]
        special = self._idiom(at) or self._measure(at) or exception(self._words, at)
        if special is not None:
            return special
        if word in JOINTS and (word != "before" or self._before(at) is None):
            return Chunk("joint", at, at + 1)
        group = group_phrase(self._words, at, self._lexicon)
        if group is not None:
            group = self.with_qualities(group)
            return Chunk("np", at, group.last, phrase=group)
        if word in ("it", "them", "they"):
            return Chunk("pronoun", at, at + 1, "it" if word == "it" else "them")
        relation = self._relation(at) or self._before(at)
        if relation is not None:
            return relation
        phrase = self.whole_phrase(at, previous)
        if phrase is not None:
            return Chunk("np", at, phrase.last, phrase=phrase)
        if self._pointing(at):
            return Chunk("pronoun", at, at + 1, "it" if word in ("this", "that") else "them")
        return self._place(at) or self._verb(at) or Chunk("other", at, at + 1)

    def _measure(self, at: int) -> Chunk | None:
        """ "10 cm", "a quarter turn": no noun phrase, whatever its words are."""
        first, last, sort = self._measures.get(at, (-1, -1, ""))
        return Chunk("measure", at, last, sort) if first == at else None

    def _before(self, at: int) -> Chunk | None:
        """ "10 cm before the cup": in front of it; "before you push the cup" is another matter."""
        if self._words[at] != "before" or at == 0 or self._word(at + 1) not in DETERMINERS:
            return None
        phrase = self.noun_phrase(at + 1)
        if phrase is None:
            return None
        over = phrase.last == len(self._words) or self._words[phrase.last] in JOINTS | {"please"}
        return Chunk("relation", at, at + 1, "below") if over else None

    def _pointing(self, at: int) -> bool:
        """ "push that left", "move this": a demonstrative that stands for a thing."""
        if self._words[at] not in ("this", "that", "these", "those"):
            return False
        before = self._words[at - 1] if at else ""
        after = self._words[at + 1] if at + 1 < len(self._words) else ""
        if after in DETERMINERS or after in ("is", "are", "i", "you", "it"):
            return False
        if after in JOINTS | _CLOSING and before in _LEADING:
            return self._words[at] in ("that", "this")
        return self._lexicon.verb(before) is not None or before in ("up", "over", "down")

    def _verb(self, at: int) -> Chunk | None:
        verb_class = self._lexicon.verb(self._words[at])
        if at and self._words[at - 1] in DETERMINERS | {"same", "of"}:
            return None
        swapped = at and self._words[at - 1] in _SWAPPING
        if swapped and self._words[at] in ("places", "positions", "place", "position"):
            return None
        return None if verb_class is None else Chunk("verb", at, at + 1, verb_class)

    def _place(self, at: int) -> Chunk | None:
        """ "the left", "the far left corner of the table", "top right": never an object. "Right
        there" is none."""
        end = at
        if self._words[at] == "right" and self._word(at + 1) in ("here", "there"):
            return None
        while end < len(self._words) and (
            self._words[end] in DETERMINERS or number(self._words[end]) is not None
        ):
            end += 1
        first = end
        allowed = self._lexicon.place_heads | self._lexicon.place_adjectives
        while end < len(self._words) and self._words[end] in allowed:
            end += 1
        if not any(word in self._lexicon.place_heads for word in self._words[first:end]):
            return None
        return Chunk("place", at, self._of_a_part(end))

    def _of_a_part(self, at: int) -> int:
        """Where "of the far edge", "of the table" behind a place ends; ``at`` if there is none."""
        if self._word(at) != "of":
            return at
        first = end = at + 1 + (self._word(at + 1) in DETERMINERS)
        while end < len(self._words) and (
            self._words[end] in self._lexicon.place_heads | self._lexicon.place_adjectives
        ):
            end += 1
        whole = end == first + 1 and self._words[first] in self._lexicon.place_heads
        return end if end > first and (whole or self._words[end - 1] in _PARTS) else at

"""A sentence in pieces: noun phrases, relations, places, verbs and joints; no scene semantics.

The scene's names decide where a noun phrase ends ("the red star", "the coca cola left"), so a
parser is made for one sentence over one scene.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from clarifier.lexicon import Lexicon
from clarifier.things import Thing, is_attribute, same_words, side_of, size_of
from clarifier.words import Token, match_run, number, singular

JOINTS = frozenset(
    {"and", "then", "but", "or", "while", "before", "after", "if", "when", "because", "once"}
    | {",", ".", ";", ":", "!", "?", "until", "so", "else", "otherwise", "unless", "than", "as"}
)
_ARTICLES = frozenset({"the", "my", "your", "our", "his", "her", "their", "its", "that", "this"})
FREE = frozenset({"a", "an", "any", "another", "either", "some"})
"""Determiners that leave open which of several is meant."""
_MANY = frozenset({"all", "both", "each", "every", "these", "those"})
_DETERMINERS = _ARTICLES | FREE | _MANY | {"no"}
_STOPS = (
    JOINTS
    | _DETERMINERS
    | {"it", "them", "they", "you", "i", "me", "we", "is", "are", "be", "was", "were", "should"}
    | {"must", "can", "could", "would", "will", "which", "who", "not", "do", "does", "please"}
    | {"to", "of", "now", "again", "too", "also", "thanks", "it's", "that's", "has", "have", "down"}
    | {"up", "off", "over", "away", "there", "here", "out", "gently", "slowly", "carefully"}
)
_MODAL_SUBJECTS = frozenset({"you", "we", "i", "it", "the", "this", "that", "be", "u", "they"})
_COUNTS = {"couple": 2.0, "pair": 2.0, "few": 0.0, "several": 0.0, "bunch": 0.0}
_REACH = 8
"""Longest run of words (adjectives and noun) that is read as one noun phrase."""

ChunkKind = Literal["np", "pronoun", "relation", "place", "verb", "joint", "other"]


@dataclass(frozen=True)
class Phrase:
    """A noun phrase: tokens ``first:last`` without the determiner, which starts at ``opened``.

    ``head`` is () for "one" and for adjectives alone. ``count`` is None where no number was
    said and 0 for "a few". ``origin`` is the side from which an ordinal counts.
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

    @property
    def any_will_do(self) -> bool:
        """ "an apple", "any cup", "one block": which of them does not matter."""
        return not self.plural and (self.det in FREE or (self.count == 1 and not self.det))


@dataclass(frozen=True)
class Chunk:
    """A piece of the sentence, tokens ``first:last``; ``value`` is the relation or verb class."""

    kind: ChunkKind
    first: int
    last: int
    value: str = ""
    phrase: Phrase | None = None


class Parser:
    """Cuts one sentence into chunks, knowing the names of the scene's objects."""

    def __init__(self, tokens: Sequence[Token], things: Sequence[Thing], lexicon: Lexicon) -> None:
        self.tokens = tokens
        self._words = [token.text for token in tokens]
        self._things = things
        self._lexicon = lexicon
        self._name_words = {word for thing in things for word in thing.name}

    def chunks(self) -> tuple[Chunk, ...]:
        """The whole sentence as chunks, in order, every token in exactly one."""
        found: list[Chunk] = []
        at = 0
        while at < len(self.tokens):
            chunk = self._chunk(at)
            found.append(chunk)
            at = chunk.last
        return tuple(found)

    def _chunk(self, at: int) -> Chunk:
        word = self._words[at]
        if word in JOINTS:
            return Chunk("joint", at, at + 1)
        if word in ("it", "them", "they"):
            return Chunk("pronoun", at, at + 1, "it" if word == "it" else "them")
        relation = self._relation(at)
        if relation is not None:
            return relation
        phrase = self.noun_phrase(at)
        if phrase is not None:
            return Chunk("np", at, phrase.last, phrase=phrase)
        if self._pointing(at):
            return Chunk("pronoun", at, at + 1, "it" if word in ("this", "that") else "them")
        return self._place(at) or self._verb(at) or Chunk("other", at, at + 1)

    def _relation(self, at: int) -> Chunk | None:
        for run, name in self._lexicon.relations:
            if match_run(self.tokens, at, run):
                return Chunk("relation", at, at + len(run), name)
        return None

    def _pointing(self, at: int) -> bool:
        """ "push that left", "move this": a demonstrative that stands for a thing."""
        if self._words[at] not in ("this", "that", "these", "those"):
            return False
        before = self._words[at - 1] if at else ""
        after = self._words[at + 1] if at + 1 < len(self._words) else ""
        if after in _DETERMINERS or after in ("is", "are", "i", "you", "it"):
            return False
        return self._lexicon.verb(before) is not None or before in ("up", "over", "down")

    def _verb(self, at: int) -> Chunk | None:
        verb_class = self._lexicon.verb(self._words[at])
        if at and self._words[at - 1] in _DETERMINERS | {"same", "of"}:
            return None
        return None if verb_class is None else Chunk("verb", at, at + 1, verb_class)

    # --- places ------------------------------------------------------------

    def _place(self, at: int) -> Chunk | None:
        """ "the left", "the far left corner of the table", "top right": never an object."""
        end = at
        while end < len(self._words) and (
            self._words[end] in _DETERMINERS or number(self._words[end]) is not None
        ):
            end += 1
        first = end
        allowed = self._lexicon.place_heads | self._lexicon.place_adjectives
        while end < len(self._words) and self._words[end] in allowed:
            end += 1
        if not any(word in self._lexicon.place_heads for word in self._words[first:end]):
            return None
        rest = self._words[end : end + 3]
        if len(rest) == 3 and rest[:2] == ["of", "the"] and rest[2] in self._lexicon.place_heads:
            end += 3
        return Chunk("place", at, end)

    # --- noun phrases ------------------------------------------------------------

    def noun_phrase(self, at: int) -> Phrase | None:
        """The noun phrase that starts at a token, or None."""
        start, det, count = self._determiner(at)
        if start >= len(self._words) or (not det and count is None and self._is_verb_here(at)):
            return None
        end = self._reach(start)
        for last in range(end, start, -1):
            found = self._ends_at(at, start, last, det, count)
            if found is not None:
                return found
        if not det and count is None:
            return None
        return self._headless(at, start, end, det, count) or self._unknown(
            at, start, end, det, count
        )

    def _determiner(self, at: int) -> tuple[int, str, float | None]:
        """Index behind the determiner, the determiner ("" for none) and the count said."""
        i, det, count = at, "", None
        if match_run(self.tokens, i, ("one", "of")) and self._word(i + 2) in _DETERMINERS:
            return i + 3, "a", None
        if match_run(self.tokens, i, ("a", "little")) and self._word(i + 2) in _STOPS | {""}:
            return len(self._words), "", None
        if self._word(i) in _DETERMINERS:
            det, i = self._word(i), i + 1
            if self._word(i) == "of":
                i += 1
            if self._word(i) in _ARTICLES | _MANY:
                i += 1
        if self._word(i) == "other" and det in _ARTICLES:
            det, i = "other", i + 1
        if self._word(i) in _COUNTS:
            count, i = _COUNTS[self._word(i)], i + 1
            i += self._word(i) == "of"
            det = "" if det in FREE else det
            i += self._word(i) == "the"
        elif number(self._word(i)) is not None and not self._is_one(i):
            count, i = number(self._word(i)), i + 1
            i += match_run(self.tokens, i, ("of", "the")) * 2
        return i, det, count

    def _is_one(self, at: int) -> bool:
        """Whether "one" at this index stands for a noun ("the red one"), not for a number."""
        if self._word(at) != "one":
            return False
        return self._reach(at + 1) == at + 1 or self._ends_at(at, at + 1, at + 2, "", 1.0) is None

    def _word(self, at: int) -> str:
        return self._words[at] if at < len(self._words) else ""

    def _reach(self, start: int) -> int:
        """Index behind the last word that can belong to a noun phrase begun at ``start``."""
        end = start
        while end < len(self._words) and end - start < _REACH and self._continues(start, end):
            end += 1
        return end

    def _continues(self, start: int, at: int) -> bool:
        word = self._words[at]
        if any(at - i >= start for i in self._name_offsets(at)):
            return True
        if not word[0].isalnum() or (word in _STOPS and not (at == start and self._is_head(word))):
            return False
        if at > start and self._relation(at) is not None and side_of(word, self._lexicon) == "":
            return False
        verb_only = self._lexicon.verb(word) is not None and not self._lexicon.is_noun(word)
        verb_only = verb_only and word not in self._lexicon.abstract
        return at == start or not verb_only or is_attribute(word, self._lexicon)

    def _is_head(self, word: str) -> bool:
        """Whether a word that could be grammar ("can") is the noun of something."""
        return word in self._lexicon.category or any(word == thing.head for thing in self._things)

    def _name_offsets(self, at: int) -> list[int]:
        """How far into a multi-word scene name the token at ``at`` lies, if a name stands there."""
        found = []
        for thing in self._things:
            for offset in range(len(thing.name)):
                begin = at - offset
                run = self._words[max(begin, 0) : begin + len(thing.name)]
                if len(thing.name) > 1 and begin >= 0 and same_words(run, thing.name):
                    found.append(offset)
        return found

    def _ends_at(
        self, opened: int, start: int, last: int, det: str, count: float | None
    ) -> Phrase | None:
        """The phrase whose noun ends just before ``last``, if the words fit."""
        length = self._head_length(start, last, bool(det) or count is not None)
        if length == 0:
            return None
        modifiers = tuple(self._words[start : last - length])
        free_words = bool(det) or count is not None
        if not all(self._modifies(word, free_words) for word in modifiers):
            return None
        head = tuple(self._words[last - length : last])
        one = head[-1] in ("one", "ones")
        head = () if one else (*head[:-1], head[-1].removesuffix("'s"))
        many = self._is_plural(head) or self._words[last - 1] == "ones"
        many = many or det in _MANY or (count is not None and count != 1)
        end, origin = self._counted_from(last)
        noun = Phrase(opened, start, end, det, count, modifiers, head, many, origin)
        return noun if det != "a" or not one or modifiers else None

    def _head_length(self, start: int, last: int, determined: bool) -> int:
        """Words of the noun that ends before ``last``: 0 if there is none."""
        for length in range(last - start, 0, -1):
            run = self._words[last - length : last]
            run = [*run[:-1], run[-1].removesuffix("'s")]
            if any(same_words(run, t.name) or (t.id.lower(),) == tuple(run) for t in self._things):
                return length
            if length > 1 and (" ".join(run) in self._lexicon.category or self._synonym(run)):
                return length
        word = self._words[last - 1].removesuffix("'s")
        one = singular(word)
        if any(one == thing.head or word == thing.head for thing in self._things):
            return 1
        if word in self._lexicon.abstract or word in self._lexicon.place_heads:
            return 0
        if word in ("one", "ones"):
            return 1 if determined or last - start > 1 else 0
        if self._lexicon.is_noun(word) and not (word in self._lexicon.colors and last == start):
            return 1
        return 1 if determined and word in self._name_words and not self._attribute(word) else 0

    def _synonym(self, run: Sequence[str]) -> bool:
        return bool(self._lexicon.same(" ".join([*run[:-1], singular(run[-1])])))

    def _attribute(self, word: str) -> bool:
        return (
            is_attribute(word, self._lexicon)
            or side_of(word, self._lexicon) != ""
            or word in self._lexicon.words("ordinals")
        )

    def _modifies(self, word: str, determined: bool) -> bool:
        """Whether a word may stand before a noun; unknown ones only behind a determiner."""
        if self._attribute(word) or word in self._name_words:
            return True
        if word in self._lexicon.words("vague") or self._lexicon.is_noun(word):
            return True
        return determined and word not in self._lexicon.abstract and number(word) is None

    def _is_plural(self, head: Sequence[str]) -> bool:
        if not head or any(same_words(head, t.name) and head[-1] == t.name[-1]
                           for t in self._things):  # fmt: skip
            return False
        return singular(head[-1]) != head[-1] and head[-1] not in self._lexicon.category

    def _counted_from(self, at: int) -> tuple[int, str]:
        """Index behind "from the left" and the side; the index itself where it is not said."""
        if self._word(at) != "from":
            return at, ""
        i = at + 1
        i += self._word(i) in ("the", "your", "my")
        side = side_of(self._word(i), self._lexicon)
        if side == "" or (self._word(i + 1) == "of" and self._word(i + 2) != "the"):
            return at, ""
        i += 1
        i += self._word(i) in ("side", "end", "edge")
        return i, side

    def _headless(
        self, opened: int, start: int, end: int, det: str, count: float | None
    ) -> Phrase | None:
        """ "the red", "the leftmost", "the second from the left", "the other": a noun left out."""
        last = start
        while last < end and self._stands_alone(self._words[last]):
            last += 1
        sides_end, origin = self._counted_from(last)
        if det in FREE or (last == start and det != "other"):
            return None
        follows = self._word(last)
        if follows in self._lexicon.abstract or follows in self._lexicon.place_heads:
            return None
        if last < end and not origin:
            return None
        modifiers = tuple(self._words[start:last])
        return Phrase(opened, opened if det == "other" and last == start else start, sides_end, det,
                      count, modifiers, (), det in _MANY, origin)  # fmt: skip

    def _stands_alone(self, word: str) -> bool:
        """Whether an adjective can stand for the thing itself; "left" is a place, not a thing."""
        superlative = word.endswith(("est", "most"))
        named = word in self._lexicon.colors or size_of(word, self._lexicon) != ""
        return superlative or named or word in self._lexicon.words("ordinals")

    def _unknown(
        self, opened: int, start: int, end: int, det: str, count: float | None
    ) -> Phrase | None:
        """A phrase whose noun nobody knows ("the glorp"), if it cannot be a place."""
        last = start
        known = self._lexicon.place_heads | self._lexicon.abstract
        while last < end and self._words[last] not in known:
            if last > start and self._words[last] in self._lexicon.words("directions"):
                break
            last += 1
        if last == start or (last < end and self._words[last] in known and last - start < 1):
            return None
        if last < end and self._words[last] in known and not self._direction(last):
            return None
        if det in ("a", "an") and self._lexicon.verb(self._word(last)) is not None:
            return None
        run = self._words[start:last]
        if run[-1] in self._lexicon.vocabulary and not self._lexicon.is_noun(run[-1]):
            return None
        return Phrase(opened, start, last, det, count, tuple(run[:-1]), (run[-1],),
                      singular(run[-1]) != run[-1] or det in _MANY, known=False)  # fmt: skip

    def _direction(self, at: int) -> bool:
        return self._words[at] in self._lexicon.words("directions")

    def _is_verb_here(self, at: int) -> bool:
        """Whether a bare word is a verb: it could be one, and an object follows it."""
        word, after = self._words[at], self._word(at + 1)
        if word == "can" and (after in _MODAL_SUBJECTS or self._lexicon.verb(after) is not None):
            return True
        if self._lexicon.verb(word) is None:
            return False
        named = any(singular(word) == thing.head for thing in self._things)
        return not named or after in _DETERMINERS or after in ("it", "them")

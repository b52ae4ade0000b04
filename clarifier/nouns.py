"""Noun phrases as they are built: determiner, number, adjectives and noun; no scene semantics.

The scene's names decide where one ends ("the red star", "the coca cola left").
"""

from __future__ import annotations

from collections.abc import Sequence

from clarifier.amounts import Found, with_units
from clarifier.groups import counted
from clarifier.lexicon import Lexicon
from clarifier.pieces import (
    ARTICLES,
    COUNTS,
    DETERMINERS,
    FREE,
    MANY,
    MODAL_SUBJECTS,
    REACH,
    STOPS,
    Chunk,
    Phrase,
)
from clarifier.things import Thing, is_attribute, same_words, side_of, size_of
from clarifier.words import Token, match_run, number, singular

_PREPOSITIONS = frozenset(
    {"in", "on", "at", "by", "into", "onto", "under", "behind", "between", "beside", "inside"}
)
_BEFORE_NUMBERS = frozenset(
    {"than", "over", "least", "most", "number", "outer", "outermost", "inner", "first", "last"}
)
"""Behind these a number counts no things of its own: "number two of the blocks"."""


class NounPhrases:
    """Finds the noun phrase that starts at a token of one sentence over one scene."""

    def __init__(
        self, text: str, tokens: Sequence[Token], things: Sequence[Thing], lexicon: Lexicon
    ) -> None:
        self.tokens = tokens
        self._measures = _token_runs(with_units(text), tokens)
        self._words = [token.text for token in tokens]
        self._things = things
        self._lexicon = lexicon
        self._name_words = {word for thing in things for word in thing.name}

    def _relation(self, at: int) -> Chunk | None:
        for run, name in self._lexicon.relations:
            if match_run(self.tokens, at, run):
                return Chunk("relation", at, at + len(run), name)
        return None

    def _idiom(self, at: int) -> Chunk | None:
        """ "one by one", "in case": fixed words that name nothing."""
        for run in self._lexicon.idioms:
            if match_run(self.tokens, at, run):
                return Chunk("other", at, at + len(run), "idiom")
        return None

    # --- noun phrases ------------------------------------------------------------

    def noun_phrase(self, at: int) -> Phrase | None:
        """The noun phrase that starts at a token, or None."""
        if self._joins_singulars(at):
            return None
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
        return (
            self._headless(at, start, end, det, count)
            or self._counted(at, start, end, count)
            or self._unknown(at, start, end, det, count)
        )

    def _joins_singulars(self, at: int) -> bool:
        """Whether "both" only goes with "and" ("both the apple and the cup") and counts nothing."""
        one = self.noun_phrase(at + 1) if self._word(at) == "both" else None
        return one is not None and not one.plural and self._word(one.last) == "and"

    def _counted(self, at: int, start: int, end: int, count: float | None) -> Phrase | None:
        return counted(self._words, at, start, count) if end == start else None

    def _determiner(self, at: int) -> tuple[int, str, float | None]:
        """Index behind the determiner, the determiner ("" for none) and the count said."""
        i, det, count = at, "", None
        counts_none = at and self._words[at - 1] in _BEFORE_NUMBERS
        if counts_none and number(self._words[i]):
            return len(self._words), "", None
        if (
            at
            and self._words[at - 1] in ("than", "over", "least", "most")
            and number(self._words[i])
        ):
            return len(self._words), "", None
        for few in (("one", "of"), ("any", "one", "of"), ("any", "of"), ("either", "of")):
            if match_run(self.tokens, i, few) and self._word(i + len(few)) in DETERMINERS:
                return self._behind_articles(i + len(few)), "a", None
        if match_run(self.tokens, i, ("a", "little")) and self._word(i + 2) in STOPS | {""}:
            return len(self._words), "", None
        if self._word(i) in DETERMINERS:
            det, i = self._word(i), i + 1
            if det in ("each", "every"):
                i += match_run(self.tokens, i, ("single",)) or (
                    2 * match_run(self.tokens, i, ("and", "every"))
                )
                i += match_run(self.tokens, i, ("one", "of"))
            if self._word(i) == "of":
                i += 1
            i = self._behind_articles(i)
        if self._word(i) in ("other", "remaining") and (det in ARTICLES | MANY):
            det, i = "others" if det in MANY - {"these", "those"} else "other", i + 1
        if self._word(i) in COUNTS and (self._word(i) != "bunch" or self._word(i + 1) == "of"):
            count, i = COUNTS[self._word(i)], i + 1
            i += self._word(i) == "of"
            det = "" if det in FREE else det
            i = self._behind_articles(i)
        elif number(self._word(i)) is not None and not self._is_one(i):
            count, i = number(self._word(i)), i + 1
            if self._word(i) == "of" and self._word(i + 1) in ARTICLES | MANY:
                i = self._behind_articles(i + 1)
        return i, det, count

    def _behind_articles(self, at: int) -> int:
        """Index behind "the", "all the", "these" and their like."""
        while self._word(at) in ARTICLES | MANY:
            at += 1
        return at

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
        while end < len(self._words) and end - start < REACH and self._continues(start, end):
            end += 1
        return end

    def _continues(self, start: int, at: int) -> bool:
        word = self._words[at]
        if any(at - i >= start for i in self._name_offsets(at)):
            return True
        if self._measures.get(at, (start, 0, ""))[0] > start or self._idiom(at) is not None:
            return False
        if at == start and word in _PREPOSITIONS:
            return False
        if not word[0].isalnum() or (word in STOPS and not (at == start and self._is_head(word))):
            return False
        if at > start and self._relation(at) is not None and side_of(word, self._lexicon) == "":
            return False
        verb_only = self._lexicon.verb(word) is not None and not self._lexicon.is_noun(word)
        places = self._lexicon.abstract | self._lexicon.place_heads
        verb_only = verb_only and not {word, singular(word)} & places
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
        inner = [number(word) for word in modifiers]
        if count is None and det:
            count = next((value for value in inner if value is not None and value > 1), None)
            modifiers = tuple(m for m, n in zip(modifiers, inner, strict=True) if n is None)
        if not all(self._modifies(word, free_words) for word in modifiers):
            return None
        head = tuple(self._words[last - length : last])
        one = head[-1] in ("one", "ones")
        head = () if one else (*head[:-1], head[-1].removesuffix("'s"))
        many = self._is_plural(head) or self._words[last - 1] == "ones"
        several = det == "both" or (count is not None and count > 1)
        if several and not many and head and self._word(last - length - 1) in ARTICLES:
            return None
        many = many or det in MANY or (count is not None and count != 1)
        ordinal = any(word in self._lexicon.words("ordinals") for word in modifiers)
        end, origin = self._counted_from(last) if ordinal else (last, "")
        lead = self._lead(opened, start) if many else start
        noun = Phrase(opened, lead, end, det, count, modifiers, head, many, origin)
        return noun if det != "a" or not one or modifiers else None

    def _lead(self, opened: int, start: int) -> int:
        """Where the mention of a group begins: behind "all the", before "two", "every", "other"."""
        skipped = (ARTICLES | {"all", "both", "these", "those", "of", "each"}) - {"that", "this"}
        at = opened
        while at < start and self._words[at] in skipped:
            each = self._words[at] == "each" and self._word(at + 1) != "of"
            if each:
                break
            at += 1
        return at

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
        if {word, one} & (self._lexicon.abstract | self._lexicon.place_heads):
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
        said = self._words[start:last]
        modifiers = tuple(word for word in said if number(word) is None)
        if count is None:
            count = next((value for word in said if (value := number(word)) is not None), None)
        if not modifiers and det != "other":
            return None
        many = det in MANY or (count is not None and count != 1)
        first = self._lead(opened, start) if many else start
        first = opened if det == "other" and last == start else first
        return Phrase(opened, first, sides_end, det, count, modifiers, (), many, origin)

    def _stands_alone(self, word: str) -> bool:
        """Whether an adjective can stand for the thing itself; "left" is a place, not a thing."""
        superlative = word.endswith(("est", "most")) or (number(word) or 0) > 1
        named = word in self._lexicon.colors or size_of(word, self._lexicon) != ""
        return superlative or named or word in self._lexicon.words("ordinals")

    def _unknown(
        self, opened: int, start: int, end: int, det: str, count: float | None
    ) -> Phrase | None:
        """A phrase whose noun nobody knows ("the glorp"), if it cannot be a place."""
        last = start
        known = self._lexicon.place_heads | self._lexicon.abstract
        while last < end and not {self._words[last], singular(self._words[last])} & known:
            if last > start and self._words[last] in self._lexicon.words("directions"):
                break
            last += 1
        if last == start or (last < end and not self._direction(last)):
            return None
        if det in ("that", "this") or (not det and self._lexicon.verb(self._words[last - 1])):
            return None
        if det in ("a", "an") and self._lexicon.verb(self._word(last)) is not None:
            return None
        run = self._words[start:last]
        if run[-1] in self._lexicon.vocabulary and not self._lexicon.is_noun(run[-1]):
            return None
        return Phrase(opened, start, last, det, count, tuple(run[:-1]), (run[-1],),
                      singular(run[-1]) != run[-1] or det in MANY, known=False)  # fmt: skip

    def _direction(self, at: int) -> bool:
        return self._words[at] in self._lexicon.words("directions")

    def _is_verb_here(self, at: int) -> bool:
        """Whether a bare word is a verb: it could be one, and an object follows it."""
        word, after = self._words[at], self._word(at + 1)
        if word == "can" and at and self._words[at - 1] in MODAL_SUBJECTS - ARTICLES:
            return True
        if word == "can" and (after in MODAL_SUBJECTS or self._lexicon.verb(after) is not None):
            return True
        if self._lexicon.verb(word) is None:
            return False
        named = any(singular(word) == thing.head for thing in self._things)
        return not named or after in DETERMINERS or after in ("it", "them")


def _token_runs(found: Sequence[Found], tokens: Sequence[Token]) -> dict[int, tuple[int, int, str]]:
    """For each token inside a measure the measure's tokens (first, behind the last) and sort."""
    runs: dict[int, tuple[int, int, str]] = {}
    for one in found:
        inside = [i for i, t in enumerate(tokens) if t.start < one.end and one.start < t.end]
        runs |= dict.fromkeys(inside, (inside[0], inside[-1] + 1, one.sort))
    return runs

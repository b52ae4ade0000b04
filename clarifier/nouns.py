"""Noun phrases as they are built: determiner, number, adjectives and noun; no scene semantics.

The scene's names decide where one ends ("the red star", "the coca cola left").
"""

from __future__ import annotations

from collections.abc import Sequence

from clarifier.distances import UTMOST
from clarifier.groups import counted
from clarifier.overscene import OverScene
from clarifier.pieces import (
    ARTICLES,
    COUNTS,
    DETERMINERS,
    FREE,
    JOINTS,
    MANY,
    MODAL_SUBJECTS,
    REACH,
    STOPS,
    Phrase,
)
from clarifier.things import is_attribute, same_words, side_of, size_of
from clarifier.words import match_run, number, singular

_PREPOSITIONS = frozenset(
    {"in", "on", "at", "by", "into", "onto", "under", "behind", "between", "beside", "inside"}
)
_ONE_OF = tuple(
    (*one.split(), "of")
    for one in ("one", "just one", "only one", "any one", "any", "either", "either one", "another",
                "a single one", "another one", "some one", "exactly one")
)  # fmt: skip
_GOING = frozenset({"go", "goes", "belong", "belongs", "should", "must"})
"""Behind adjectives these begin what becomes of the thing: "the leftmost go in the jar"."""
_BEFORE_NUMBERS = frozenset(
    {"than", "over", "least", "most", "number", "outer", "outermost", "inner", "first", "last"}
)
"""Behind these a number counts no things of its own: "number two of the blocks"."""


class NounPhrases(OverScene):
    """Finds the noun phrase that starts at a token of one sentence over one scene."""

    # --- noun phrases ------------------------------------------------------------

    def noun_phrase(self, at: int) -> Phrase | None:
        """The noun phrase that starts at a token, or None."""
        if self._joins_singulars(at) or self._is_infinitive(at):
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
            return self._bare_unknown(at)
        return (
            self._headless(at, start, end, det, count)
            or self._counted(at, start, end, count)
            or self._unknown(at, start, end, det, count)
        )

    def _joins_singulars(self, at: int) -> bool:
        """Whether "both" only goes with "and" ("both the apple and the cup") and counts nothing."""
        one = self.noun_phrase(at + 1) if self._word(at) == "both" else None
        return one is not None and not one.plural and self._word(one.last) == "and"

    def _is_infinitive(self, at: int) -> bool:
        """ "To crown them both": what could be a noun is done to something."""
        acted_on = self._word(at + 1) in {"it", "them", "him", "her", "me", "us", "both"}
        return self._word(at - 1) == "to" and acted_on and not self._names_at(at)

    def _counted(self, at: int, start: int, end: int, count: float | None) -> Phrase | None:
        return counted(self._words, at, start, count) if end == start else None

    def _determiner(self, at: int) -> tuple[int, str, float | None]:
        """Index behind the determiner, the determiner ("" for none) and the count said."""
        i, det, count = at, "", None
        few = self._one_among(i)
        if few:
            return self._behind_articles(i + few), "a", 1.0
        counts_none = at and self._words[at - 1] in _BEFORE_NUMBERS
        if counts_none and number(self._words[i]):
            return len(self._words), "", None
        if (
            at
            and self._words[at - 1] in ("than", "over", "least", "most")
            and number(self._words[i])
        ):
            return len(self._words), "", None
        if match_run(self.tokens, i, ("the", "rest", "of")) and self._word(i + 3) in DETERMINERS:
            return self._behind_articles(i + 3), "others", None
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
        elif number(self._word(i)) is not None and not (self._is_one(i) or self._names_at(i)):
            count, i = number(self._word(i)), i + 1
            if self._word(i) == "of" and self._word(i + 1) in ARTICLES | MANY:
                i = self._behind_articles(i + 1)
        return i, det, count

    def _one_among(self, at: int) -> int:
        """Words of "one of", "any one of" before a group of which any one will do, else 0."""
        led = (few for few in _ONE_OF if match_run(self.tokens, at, few))
        few = next(led, ())
        return len(few) if few and self._word(at + len(few)) in DETERMINERS else 0

    def _is_one(self, at: int) -> bool:
        """Whether "one" at this index stands for a noun ("the red one"), not for a number."""
        if self._word(at) != "one":
            return False
        ends = range(at + 2, self._reach(at + 1) + 1)
        return all(self._ends_at(at, at + 1, last, "", 1.0) is None for last in ends)

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
        if at > start and self._compares(at):
            return False
        if at > start and self._one_among(at) and self._lexicon.is_plural(self._words[at - 1]):
            return False  # "on each of the plates one of the coins"
        if at == start and word in _PREPOSITIONS:
            return False
        if not word[0].isalnum() or (word in STOPS and not self._noun_after_all(start, at)):
            return False
        if at > start and self._relation(at) is not None and side_of(word, self._lexicon) == "":
            return False
        verb_only = self._lexicon.verb(word) is not None and not self._lexicon.is_noun(word)
        places = self._lexicon.abstract | self._lexicon.place_heads
        verb_only = verb_only and not {word, singular(word)} & places
        return at == start or not verb_only or is_attribute(word, self._lexicon)

    def _compares(self, at: int) -> bool:
        """Whether "nearest" stands behind a noun and begins what it is nearest to."""
        relation = self._relation(at)
        if relation is None or relation.value not in ("nearest", "furthest", UTMOST):
            return False
        before = self._words[at - 1]
        return before == "one" or (self._lexicon.is_noun(before) and not self._attribute(before))

    def _noun_after_all(self, start: int, at: int) -> bool:
        """Whether a word that could be grammar is a noun here: "the red can", no "can you"."""
        if at == start:
            modal = self._lexicon.verb(self._word(at + 1)) is not None and at > 0
            return self._is_head(self._words[at]) and not (modal and self._words[at - 1] == "one")
        if not any(self._words[at] == thing.head for thing in self._things):
            return False
        after = self._word(at + 1)
        modal = after in MODAL_SUBJECTS - ARTICLES or self._lexicon.verb(after) is not None
        compound = self._lexicon.is_noun(" ".join(self._words[at - 1 : at + 1]))
        return (compound or self._attribute(self._words[at - 1])) and not modal

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
        if det and (count is None or (det == "a" and count == 1)):
            said = next((value for value in inner if value is not None and value > 1), None)
            count = count or said  # "one of the two cups" is one
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
        many = (many and count != 1) or det in MANY or (count is not None and count != 1)
        of_several = det == "a" and self._word(opened) != "a"
        many = many and not of_several
        if det == "whichever" and not many and self._word(opened + 1) == "of":
            det = "the"  # "whichever of the left toy and the cube": that toy, chosen or not
        ordinal = any(word in self._lexicon.words("ordinals") for word in modifiers)
        end, origin = self._counted_from(last) if ordinal else (last, "")
        lead = self._lead(opened, start) if many else opened if of_several else start
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
            if length > 1 and self._lexicon.is_noun(" ".join(run)):
                return length
        word = self._words[last - 1].removesuffix("'s")
        one = singular(word)
        if any(one == thing.head or word == thing.head for thing in self._things):
            return 1
        if {word, one} & (self._lexicon.abstract | self._lexicon.place_heads):
            return int(self._kind_here(last - 1))
        if word in ("one", "ones"):
            return 1 if determined or last - start > 1 else 0
        if self._lexicon.is_noun(word) and not (word in self._lexicon.colors and last == start):
            return 1
        return 1 if determined and word in self._name_words and not self._attribute(word) else 0

    def _kind_here(self, at: int) -> bool:
        """Whether a word that is mostly no thing is one here: "the tools", "the tool", where tools
        are; never "in the shape of"."""
        word, led = self._words[at], self._word(at - 1) == "the" and self._word(at + 1) != "of"
        means = self._lexicon.means
        fits = any(means(word, thing.noun) or means(word, thing.inside) for thing in self._things)
        return fits and (led or singular(word) != word)

    def _modifies(self, word: str, determined: bool) -> bool:
        """Whether a word may stand before a noun; unknown ones only behind a determiner."""
        if self._attribute(word) or word in self._name_words:
            return True
        if word in self._lexicon.words("vague") or self._lexicon.is_noun(word):
            return True
        return determined and word not in self._lexicon.abstract and number(word) is None

    def _is_plural(self, head: Sequence[str]) -> bool:
        if head[-1:] == ("stuff",):
            return True
        if not head or any(same_words(head, t.name) and head[-1] == t.name[-1]
                           for t in self._things):  # fmt: skip
            return False
        if (said := " ".join(head)) in self._lexicon.collective:
            return sum(self._lexicon.means(said, t.noun) for t in self._things) > 1
        return self._lexicon.is_plural(head[-1])

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
        if last < end and follows in _GOING:
            end = last
        moved = last < end and self._direction(last) and self._word(last + 1) in JOINTS | {""}
        moved = moved and side_of(self._word(last - 1), self._lexicon) == ""  # "the lower right"
        abstract = follows not in _GOING and follows in self._lexicon.abstract
        if not moved and (abstract or follows in self._lexicon.place_heads):
            return None
        if last < end and not origin and not moved:
            return None
        said = self._words[start:last]
        modifiers = tuple(self._hue(word) for word in said if number(word) is None)
        if count is None:
            count = next((value for word in said if (value := number(word)) is not None), None)
        if not modifiers and det != "other":
            return None
        hued = any(self._hue(word) != word for word in said)
        many = hued or det in MANY or (count is not None and count != 1)
        first = self._lead(opened, start) if many else start
        first = opened if det == "other" and last == start else first
        return Phrase(opened, first, sides_end, det, count, modifiers, (), many, origin)

    def _hue(self, word: str) -> str:
        """ "red" for "the reds", any other word as it is."""
        return singular(word) if singular(word) in self._lexicon.colors else word

    def _stands_alone(self, word: str) -> bool:
        """Whether an adjective can stand for the thing itself; "left" is a place, not a thing."""
        superlative = word.endswith(("est", "most")) or (number(word) or 0) > 1
        named = self._hue(word) in self._lexicon.colors or size_of(word, self._lexicon) != ""
        named = named or (word in self._name_words and bool(self._lexicon.material(word)[0]))
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

    def _bare_unknown(self, at: int) -> Phrase | None:
        """ "put glorp on the plate", "glorp on the plate": a word that nobody knows between a verb,
        or nothing, and a place."""
        word, place = self._words[at], self._relation(at + 1)
        if self._hue(word) != word:
            return None  # "reds on the rack"
        verb = self._lexicon.verb(self._words[at - 1]) if at else "place"
        if verb not in ("place", "push", "pick") or not word.isalpha() or word.endswith("ly"):
            return None
        if word in self._lexicon.vocabulary or place is None or (not at and place.value == "goal"):
            return None
        return Phrase(at, at, at + 1, "", None, (), (word,), known=False)

    def _is_verb_here(self, at: int) -> bool:
        """Whether a bare word is a verb: it could be one, and an object follows it."""
        word, after = self._words[at], self._word(at + 1)
        if word == "can" and at and self._words[at - 1] in MODAL_SUBJECTS - ARTICLES:
            return True
        asks = after in MODAL_SUBJECTS | DETERMINERS or self._lexicon.verb(after) is not None
        asks = asks or (number(after) is not None and (not at or self._words[at - 1] in JOINTS))
        if word == "can" and asks:
            return True
        if self._lexicon.verb(word) is None:
            return False
        named = any(singular(word) == thing.head for thing in self._things)
        return not named or after in DETERMINERS or after in ("it", "them")

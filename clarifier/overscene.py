"""The words of one sentence over one scene, and what each can be: part of a name, an attribute, the
beginning of a relation.
"""

from __future__ import annotations

from collections.abc import Sequence

from clarifier.amounts import Found, with_units
from clarifier.distances import distance_run
from clarifier.lexicon import Lexicon
from clarifier.pieces import ARTICLES, MANY, Chunk
from clarifier.things import Thing, is_attribute, same_words, side_of
from clarifier.words import Token, match_run


class OverScene:
    """The tokens of a sentence, beside the scene's things and the lexicon."""

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
        distance = distance_run(self._words, at)
        if distance is not None:
            return Chunk("relation", at, distance[1], distance[0])
        for run, name in self._lexicon.relations_from(self._word(at)):
            if match_run(self.tokens, at, run):
                return Chunk("relation", at, at + len(run), name)
        return None

    def _idiom(self, at: int) -> Chunk | None:
        """ "one by one", "in case": fixed words that name nothing."""
        for run in self._lexicon.idioms_from(self._word(at)):
            thing = run[0] == "the" and any(run[-1] == thing.head for thing in self._things)
            if not thing and match_run(self.tokens, at, run):
                return Chunk("other", at, at + len(run), "idiom")
        return None

    def _word(self, at: int) -> str:
        return self._words[at] if at < len(self._words) else ""

    def _behind_articles(self, at: int) -> int:
        """Index behind "the", "all the", "these" and their like."""
        while self._word(at) in ARTICLES | MANY:
            at += 1
        return at

    def _is_head(self, word: str) -> bool:
        """Whether a word that could be grammar ("can") is the noun of something."""
        return self._lexicon.is_noun(word) or any(word == thing.head for thing in self._things)

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

    def _names_at(self, at: int) -> bool:
        """Whether a name that begins with a number stands there ("nine volt battery")."""
        return 0 in self._name_offsets(at)

    def _attribute(self, word: str) -> bool:
        return (
            is_attribute(word, self._lexicon)
            or side_of(word, self._lexicon) != ""
            or word in self._lexicon.words("ordinals")
        )

    def _direction(self, at: int) -> bool:
        return self._words[at] in self._lexicon.words("directions")


def _token_runs(found: Sequence[Found], tokens: Sequence[Token]) -> dict[int, tuple[int, int, str]]:
    """For each token inside a measure the measure's tokens (first, behind the last) and sort."""
    runs: dict[int, tuple[int, int, str]] = {}
    for one in found:
        inside = [i for i, t in enumerate(tokens) if t.start < one.end and one.start < t.end]
        runs |= dict.fromkeys(inside, (inside[0], inside[-1] + 1, one.sort))
    return runs

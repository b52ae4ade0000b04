"""Noun phrases and pronouns that stand for no thing of the scene by themselves.

"A pyramid of the blocks", "like a flower", "the larger of the two", "it would be nice": what they
mean is for the translator, which sees their words.
"""

from __future__ import annotations

from clarifier.pieces import DETERMINERS, Phrase
from clarifier.reading import COPULAS, Reading
from clarifier.reference import Denotation, denote
from clarifier.spoken import settles
from clarifier.things import side_of, things_of
from clarifier.words import singular

_PLEASANT = frozenset(
    {"nice", "great", "good", "lovely", "possible", "ok", "okay", "fine", "better", "best", "time"}
    | {"helpful", "kind", "alright", "wonderful", "easier", "handy", "handier", "okay"}
)
_MODALS = frozenset({"will", "would", "can", "could", "may", "might", "should", "must", "won't"})
_RANKS = frozenset({"first", "second", "third", "last", "former", "latter"})


class Asides(Reading):
    """Tells asides from mentions."""

    def names_nothing(self, at: int, phrase: Phrase) -> bool:
        """ "the can being the leftmost", "the left edge ... the right one", "arrange things so"."""
        before = self.tokens[phrase.opened - 1].text if phrase.opened else ""
        if not phrase.head and before in COPULAS and not self._begins_list(at, phrase):
            return True
        if self._only_counts(phrase):
            return True
        if self._acts_as_verb(at, phrase):
            return True
        if self._picks_from_named(at, phrase) or (not phrase.known and self._in_passing(at)):
            return True
        if not phrase.det and phrase.head[-1:] == ("things",) and not phrase.modifiers:
            return True
        if phrase.head or not phrase.modifiers or phrase.origin:
            return False
        places = any(self._is_part(i) for i in range(at))
        return places and all(side_of(word, self.lexicon) for word in phrase.modifiers)

    def _is_part(self, at: int) -> bool:
        """Whether a chunk is a part of the table; "right" in "right behind" is none."""
        behind = [chunk.kind for chunk in self.chunks[at + 1 : at + 2]]
        leads = self.chunk_text(at) == "right" and behind == ["relation"]
        ends = self.chunk_text(at) == "end" and self.chunk_text(at + 1) == "up"
        return self.chunks[at].kind == "place" and not leads and not ends

    def _begins_list(self, at: int, phrase: Phrase) -> bool:
        """ "so that they are blue, green, red": the things themselves, in their order."""
        after = self.chunks[at + 2].phrase if at + 2 < len(self.chunks) else None
        coloured = set(phrase.modifiers) <= self.lexicon.colors and bool(phrase.modifiers)
        listed = (
            after is not None and not after.head and set(after.modifiers) <= self.lexicon.colors
        )
        return coloured and listed and self.chunk_text(at + 1) == "," and self.verb == "arrange"

    def _only_counts(self, phrase: Phrase) -> bool:
        """ "put a cup on the plate, just one": says again how many."""
        if phrase.det or phrase.head or phrase.group or not (self.spoken and phrase.modifiers):
            return False
        return set(phrase.modifiers) <= self.lexicon.words("vague") | {"just", "exactly"}

    def _acts_as_verb(self, at: int, phrase: Phrase) -> bool:
        """ "bowl the mug over": a bare noun in front of "the ..." that begins a clause."""
        begins = at == 0 or self.chunks[at - 1].kind == "joint"
        led = self.tokens[phrase.last].text if phrase.last < len(self.tokens) else ""
        acts = led in DETERMINERS and self.chunks[at + 1].kind == "np"
        bare = not phrase.det and phrase.count is None and not phrase.modifiers
        return begins and bare and not phrase.plural and acts

    def _in_passing(self, at: int) -> bool:
        """Whether an unknown noun is neither what a verb acts on nor where something goes."""
        if at == 0 or not any(one.mention.objects for one in self.spoken):
            return False
        if self._coordinated(at) or self._placed_too(at):
            return False
        before = [self.chunks[at - 1], *self.chunks[max(at - 2, 0) : at - 1]]
        return not any(chunk.kind in ("verb", "relation") for chunk in before)

    def _coordinated(self, at: int) -> bool:
        """ "the cup and the glorp": both are acted on; "and the guests are here" tells of them."""
        chunk = self.chunks[at]
        joined = self.chunk_text(at - 1) in ("and", "or") and self.chunks[at - 2].kind == "np"
        led = self.spoken and self.spoken[-1].last == self.chunks[at - 1].first
        after = self.tokens[chunk.last].text if chunk.last < len(self.tokens) else ""
        does = after in COPULAS | _MODALS or self.lexicon.verb(after) is not None
        return bool(joined and led and self.verb and not does)

    def _placed_too(self, at: int) -> bool:
        """ "the cup left of it and the glorp behind the tin": it is put there, like the cup."""
        joined = self.chunk_text(at - 1) in ("and", ",", "then") and self.verb in (
            "",
            "place",
            "push",
        )
        where = self.chunks[at + 1 : at + 2]
        rest = {token.text for token in self.tokens[self.chunks[at].last :]}
        told = rest & (COPULAS | _MODALS) or any(chunk.kind == "verb" for chunk in self.chunks[at:])
        return joined and bool(where) and where[0].kind in ("relation", "place") and not told

    def is_shape(self, at: int, phrase: Phrase) -> bool:
        """ "a pyramid of all the blocks", "like a flower", "mirror the order": what is not there
        and was not meant to be."""
        if self.naming:
            return False
        before = self.chunk_text(at - 1) if at else ""
        after = self.tokens[phrase.last].text if phrase.last < len(self.tokens) else ""
        if before in ("like", "as", "than", "for") or before in COPULAS:
            return True
        if not phrase.det and phrase.count is None and after in DETERMINERS:
            return True
        if {after, singular(after)} & (self.lexicon.abstract | self.lexicon.place_heads):
            return after not in self.lexicon.words("directions")
        if phrase.det not in ("a", "an"):
            return False
        shape = self.lexicon.means("shape", " ".join(phrase.head))
        made = self.verb in ("arrange", "trace") or before in ("into", "of", "with")
        made = made or (not phrase.known and self.verb in ("", "arrange"))
        return made or (shape and before == "in") or after in ("of", "from")

    def points_inside(self, phrase: Phrase) -> bool:
        """ "that one", "the other": of the things that this sentence named, as far as it says."""
        bare = not (phrase.head or phrase.modifiers or phrase.plural or phrase.group)
        settled = [one for one in self.spoken if settles(one.mention)]
        placed = any(chunk.kind == "place" for chunk in self.chunks)
        placed = placed and bool(self.spoken)
        other = phrase.det == "other" and (len(settled) > 1 or placed)
        return bare and not self.naming and (other or (phrase.det == "that" and bool(settled)))

    def kind_left(self, found: Denotation) -> bool:
        """Whether "the others" are things like those named before."""
        if not any(one.mention.plural for one in self.spoken):
            return True
        named = {o for one in self.spoken for o in one.mention.objects}
        heads = {t.head for t in things_of(self.scene, self.lexicon) if t.id in named}
        rest = (t for t in things_of(self.scene, self.lexicon) if t.id in found.objects)
        return any(thing.head in heads for thing in rest)

    # --- choices among what is named ------------------------------------------------------------

    def _picks_from_named(self, at: int, phrase: Phrase) -> bool:
        """ "the bigger of the mug and the bowl", "of the blocks, the tallest": the choice is part
        of what is to be done, for what it is made from is named."""
        lexicon = self.lexicon
        if phrase.head or phrase.group or self.naming:
            return False
        if any(m in lexicon.colors or m in self._name_words() for m in phrase.modifiers):
            return False
        behind = self.chunk_text(at + 1) if at + 1 < len(self.chunks) else ""
        if at + 1 < len(self.chunks) and self.chunks[at + 1].value == "not":
            return False
        if behind in ("of", "among") and at + 2 < len(self.chunks):
            picks = self.chunks[at + 2].kind in ("np", "pronoun")
            picks = picks or self.chunk_text(at + 2) in ("each", "every")
        elif phrase.det in ("other", "others"):
            picks = self.chosen and not self.in_choice(at)
        else:
            ranks = set(phrase.modifiers) <= _RANKS and not phrase.origin and phrase.modifiers
            groups = (c.phrase for c in self.chunks[at + 1 :] if c.phrase is not None)
            picks = (
                any(one.mention.plural for one in self.spoken)
                or any(group.plural and group.group != "them" for group in groups)
                or (len(self.spoken) > 1 and (self._listed() or bool(ranks)))
                or self._offered(at)
            )
        self.chosen = self.chosen or picks
        return picks

    def _offered(self, at: int) -> bool:
        """Whether "the mug or the bowl" follows."""
        kinds = [chunk.kind for chunk in self.chunks]
        return any(
            self.chunk_text(i) == "or" and {kinds[i - 1], kinds[i + 1]} <= {"np", "pronoun"}
            for i in range(at + 2, len(kinds) - 1)
        )

    def _name_words(self) -> set[str]:
        return {word for thing in things_of(self.scene, self.lexicon) for word in thing.name}

    def _listed(self) -> bool:
        """Whether two single things were named side by side: "the mug and the bowl"."""
        pairs = zip(self.spoken, self.spoken[1:], strict=False)
        return any(
            {t.text for t in self.tokens[one.last : other.opened]} <= {"and", "or", ",", "either"}
            for one, other in pairs
        )

    # --- pronouns ------------------------------------------------------------

    def names_more(self, at: int) -> bool:
        """Whether a pronoun at the head of a sentence stands for what is named behind it."""
        if self.spoken or self.chunk_text(at + 1) in ("and", "or"):
            return False
        later = (chunk.phrase for chunk in self.chunks[at + 1 :] if chunk.phrase is not None)
        led = {i + 1 for i, chunk in enumerate(self.chunks) if chunk.kind == "relation"}
        free = any(i not in led and i > at and chunk.kind == "np"
                   for i, chunk in enumerate(self.chunks))  # fmt: skip
        return free and any(denote(phrase, self.context()).objects for phrase in later)

    def _draws_shape(self, at: int) -> bool:
        """ "A square has four corners: draw it": the shape named before, where no thing is."""
        before = self.chunks[at - 1]
        if at == 0 or self.spoken or (before.kind, before.value) != ("verb", "trace"):
            return False
        said = (token.text for token in self.tokens[: before.first])
        return any(self.lexicon.means("shape", word) for word in said)

    def means_nothing(self, at: int) -> bool:
        """ "it would be nice", "is it possible", "a circle: draw it": no thing is spoken of."""
        first = self.chunks[at].first
        if self._draws_shape(at):
            return True
        around = [token.text for token in self.tokens[max(first - 1, 0) : first + 4]]
        return bool(set(around) & _PLEASANT) and bool(set(around) & {"be", "is", "it's", "was"})

"""What stands behind a noun and still belongs to its phrase: "the cup white", "a vial of red
colour", "the cup that is the tallest", "two balls of yarn"; and nouns that are left out because
another phrase says them: "the red and the blue cup", "stack red on blue".
"""

from __future__ import annotations

from dataclasses import replace

from clarifier.nouns import NounPhrases
from clarifier.pieces import ARTICLES, JOINTS, Chunk, Phrase
from clarifier.things import Thing, is_attribute, side_of, size_of
from clarifier.words import singular

_RELATIVES = frozenset({"that", "which", "who"})
_COPULAS = frozenset({"is", "are", "was", "were"})
_COLOUR = frozenset({"color", "colour"})
_DYED = frozenset({"colored", "coloured", "painted"})
_MADE = frozenset({"made", "built", "manufactured", "done"})
_FROM = frozenset({"of", "from", "in", "with"})
_COPULA_NOT = frozenset({"isn't", "aren't", "wasn't", "weren't"})
_LISTING = frozenset({"and", "or", ",", "nor"})
_LEADS = frozenset({"verb", "relation", "joint"})
_NO_LEADS = frozenset({"cannot", "turn"})
"""Behind verbs of these classes a colour is no thing: "turn red"."""
_SORTED_TO = frozenset({"in", "into", "inside", "on", "onto", "to", "at", "left", "right"})
_TOWARDS = frozenset({"to", "from", "toward", "towards", "away", "off"})


class Behind(NounPhrases):
    """Completes noun phrases by what stands behind them."""

    def whole_phrase(self, at: int, before: Chunk | None) -> Phrase | None:
        """The noun phrase at a token with all that belongs to it; the chunk ``before`` it."""
        if self._is_letter(at):
            return Phrase(at, at, at + 1, "", None, (), (self._words[at],))
        phrase = self.noun_phrase(at)
        if phrase is None:
            phrase = self._bare_colour(at, before) or self._bare_name(at, before)
        if phrase is None:
            return None
        if phrase.head or self._word(phrase.last - 1) in ("one", "ones"):
            return self._with_attributes(self._with_content(phrase))
        return self._sharing_noun(phrase)

    def _is_letter(self, at: int) -> bool:
        """ "A, B and C": a thing called by one letter, which is no article there."""
        named = any(thing.head == self._words[at] == "a" for thing in self._things)
        after = self._word(at + 1)
        return named and (after in JOINTS | {""} or after.endswith("ly"))

    # --- attributes behind the noun ------------------------------------------------------------

    def _with_content(self, phrase: Phrase) -> Phrase:
        """ "two balls of yarn", where the name is "ball of yarn"."""
        if self._word(phrase.last) != "of":
            return phrase
        first = phrase.last + 1
        for last in range(min(first + 3, len(self._words)), first, -1):
            said = self._words[first:last]
            if any(_holds(thing, phrase, said) for thing in self._things):
                return replace(phrase, modifiers=(*phrase.modifiers, *said), last=last)
        return phrase

    def _with_attributes(self, phrase: Phrase) -> Phrase:
        first, last = (0, 0) if self._predicated(phrase) else self._colour_behind(phrase.last)
        if first == last:
            first, last = self._relative_attributes(phrase.last)
        if first == last:
            return phrase
        end = last + (self._word(last) in _COLOUR | {"one", "ones"})
        return replace(phrase, modifiers=(*phrase.modifiers, *self._words[first:last]), last=end)

    def _predicated(self, phrase: Phrase) -> bool:
        """ "is the cup red", "make the cup red": the colour is said of the cup, not part of it."""
        before = self._words[phrase.opened - 1] if phrase.opened else ""
        return before in _COPULAS | {"make"} or self._lexicon.verb(before) in _NO_LEADS

    def _colour_behind(self, at: int) -> tuple[int, int]:
        """The tokens of a colour behind a noun; both the same for none."""
        word, first = self._word(at), at
        if word in ("of", "in", "with"):
            first = at + 1
            if word == "with" and self._word(first) in ("the", "all", "both"):
                return at, at  # "surround the heart with the red and blue blocks"
            first += self._word(first) in ARTICLES | {"a"}
        if word in _DYED:
            first = at + 1
        first += self._word(first) in _COLOUR
        last = self._attributes(first, colours=True)
        if last == first or self._begins_noun(first, last):
            return at, at
        if word == "with" and self._word(last) in ("one", "ones"):
            return at, at  # "stack them with a red one at the bottom"
        said = (*self._words[at:first], self._word(last))
        if word == "in" and not set(said) & _COLOUR and not self._spares(at, last):
            return at, at
        return first, last

    def _spares(self, first: int, last: int) -> bool:
        """Whether "in blue" is not where to put it: "lift the ball in blue", or a place follows."""
        verbs = (self._lexicon.verb(word) for word in reversed(self._words[:first]))
        governs = next((verb for verb in verbs if verb is not None), "place")
        over = self._word(last) in JOINTS | {""}
        return self._led_on(last) or (over and governs not in ("place", "push"))

    def _led_on(self, at: int) -> bool:
        """Whether the sentence says where to, further on: "the ball in blue to the left"."""
        return self._word(at) in _TOWARDS or (
            at < len(self._words) and self._relation(at) is not None
        )

    def _relative_attributes(self, at: int) -> tuple[int, int]:
        """The attributes of "that is red", "which are the tallest"; both the same for none."""
        made = self._material_behind(at)
        if made is not None:
            return made
        first = self._behind_copula(at)
        if first is None or self._word(first) == "not":
            return at, at
        definite = self._word(first) == "the"
        first += definite
        last = self._attributes(first, colours=False)
        sides = [w for w in self._words[first:last] if side_of(w, self._lexicon)]
        plain = any(not w.endswith(("est", "most")) for w in sides)
        if last == first or plain or self._begins_noun(first, last):
            return at, at
        return first, last

    def _material_behind(self, at: int) -> tuple[int, int] | None:
        """The token of "of metal", "that are made of wood", "made from glass"."""
        first = self._behind_copula(at) or at
        made = self._word(first) in _MADE
        first += made
        first += self._word(first) == "out" and made
        if self._word(first) not in (_FROM if made else ("of", "from")):
            return None
        material = self._lexicon.material(self._word(first + 1))[0]
        if self._word(first) == "from" and not (made or self._is_made_of(at, material)):
            return None
        behind = first + 2
        if not material or self._word(behind) in self._name_words - {""}:
            return None
        return first + 1, behind

    def _is_made_of(self, at: int, material: frozenset[str]) -> bool:
        """Whether one of several things of the noun before a token is of a material, by name: "the
        hinge from iron"; and no thing is called by that material."""
        kind = [t for t in self._things if t.head == singular(self._word(at - 1))]
        called = any(material & {thing.head} for thing in self._things)
        return len(kind) > 1 and not called and any(material & set(t.extra) for t in kind)

    def _behind_copula(self, at: int) -> int | None:
        """Index behind "that is", "which are", "that's"; None if none stands there."""
        if self._word(at) == "that's":
            return at + 1
        if self._word(at) in _RELATIVES and self._word(at + 1) in _COPULAS:
            return at + 2
        return None

    def _attributes(self, at: int, colours: bool) -> int:
        """Index behind the colours (or any attributes) that begin at a token."""
        end = at
        while end < len(self._words) and self._is_attribute(end, colours):
            end += 1
        return end

    def _is_attribute(self, at: int, colours: bool) -> bool:
        word = self._words[at]
        if not colours and self._is_material(word):
            return True
        if self._is_head(word):
            return False
        if word in self._lexicon.colors or word in self._lexicon.words("shades"):
            return True
        if colours or self._relation(at) is not None:
            return False
        return size_of(word, self._lexicon) != "" or side_of(word, self._lexicon) != ""

    def _is_material(self, word: str) -> bool:
        named = any(word == thing.head for thing in self._things)
        return bool(self._lexicon.material(word)[0]) and not named

    def with_qualities(self, group: Phrase) -> Phrase:
        """ "Everything wooden", "everything that is red or blue", "anything made of metal"."""
        if group.group != "all":
            return group
        first, last = self._relative_attributes(group.last)
        if first == last:
            first = group.last
            last = self._qualities(first)
        if first == last or self._begins_noun(first, last):
            return group
        said, also = tuple(self._words[first:last]), list[tuple[str, ...]]()
        while self._word(last) in ("and", "or") and (end := self._qualities(last + 1)) > last + 1:
            if self._begins_noun(last + 1, end):
                break
            also.append(tuple(self._words[last + 1 : end]))
            last = end
        return replace(group, modifiers=said, also=tuple(also), last=last)

    def _qualities(self, at: int) -> int:
        """Index behind the colours, shades, materials and sizes that begin at a token."""
        end = at
        while end < len(self._words) and self._is_quality(self._words[end]):
            end += 1
        return end

    def _is_quality(self, word: str) -> bool:
        if self._is_material(word) or size_of(word, self._lexicon) in ("big", "small"):
            return True
        return word in self._lexicon.colors and not any(word == t.head for t in self._things)

    def _begins_noun(self, first: int, last: int) -> bool:
        """Whether the attributes belong to a noun behind them: "the cup red block" names two."""
        phrase = self.noun_phrase(first)
        return phrase is not None and bool(phrase.head) and phrase.last > last

    # --- what is denied of a noun ------------------------------------------------------------

    def denied(self, at: int, before: Chunk | None) -> list[Chunk]:
        """ "that isn't red or blue", "which is not a cylinder", behind a noun: an exception."""
        first = self._behind_not(at) if before is not None and before.kind == "np" else None
        if first is None:
            return []
        phrase = self._complement(first)
        found = [Chunk("except", at, first, "not")]
        while phrase is not None:
            found.append(Chunk("np", phrase.opened, phrase.last, phrase=phrase))
            joint = phrase.last
            listed = self._word(joint) in _LISTING
            phrase = self._complement(joint + 1) if listed else None
            if phrase is None or (phrase.det and self._word(joint) not in ("or", "nor")):
                break
            found.append(Chunk("joint", joint, joint + 1, "not"))
        return found if len(found) > 1 else []

    def _behind_not(self, at: int) -> int | None:
        """Index behind "that is not", "which aren't"; None if none stands there."""
        copula = self._behind_copula(at)
        if self._word(at) == "not" and self._word(at - 1) in ("everything", "anything"):
            return at + 1
        if copula is not None:
            return copula + 1 if self._word(copula) in ("not", "neither") else None
        denies = self._word(at) in _RELATIVES and self._word(at + 1) in _COPULA_NOT
        return at + 2 if denies else None

    def _complement(self, at: int) -> Phrase | None:
        """ "red", "a cylinder", "the big one": what something is said not to be."""
        if at >= len(self._words):
            return None
        phrase = self.noun_phrase(at)
        hue = phrase is not None and not phrase.det and self._is_hue_alone(phrase.head)
        if phrase is not None and (phrase.head or phrase.det) and not hue:
            return replace(phrase, plural=True, count=None)
        last = at + 1 if hue else self._attributes(at, colours=False)
        said = tuple(self._words[at:last])
        return Phrase(at, at, last, "", None, said, (), True) if said else None

    def _is_hue_alone(self, head: tuple[str, ...]) -> bool:
        """ "Orange" where no thing is called so."""
        named = any(head == (thing.head,) for thing in self._things)
        return len(head) == 1 and head[0] in self._lexicon.colors and not named

    # --- nouns left out ------------------------------------------------------------

    def _bare_colour(self, at: int, before: Chunk | None) -> Phrase | None:
        """ "stack red on blue": a colour alone where a thing must stand, if the scene has it."""
        led = before is None or (before.kind in _LEADS and before.value not in _NO_LEADS)
        led = led or (at > 0 and self._words[at - 1] in ("up", "out", "are"))
        listed = before is not None and before.phrase is not None and not before.phrase.head
        hue = self._hue(self._words[at])
        many = hue != self._words[at]
        last = at + 1 if many else self._attributes(at, colours=True)
        colours = (hue,) if many else tuple(self._words[at:last])
        if last != at + 1 or not (led or listed) or not self._has_colours(colours):
            return None
        after = self._word(last)
        over = after == "" or after in JOINTS or after in self._lexicon.words("directions")
        over = over or after in self._lexicon.colors or self._led_on(last)
        over = after in _SORTED_TO if many else over  # "reds together" makes no group of its own
        return Phrase(at, at, last, "", None, colours, (), plural=many) if over else None

    def _bare_name(self, at: int, before: Chunk | None) -> Phrase | None:
        """ "honey right of the sugar", where the honey pot stands: a word of one thing's name that
        opens an item of a list, with where it goes behind it."""
        word, last = self._words[at], at + 1
        named = [t for t in self._things if word in t.name or singular(word) in t.name]
        opens = before is None or before.kind in ("joint", "verb")
        if len(named) != 1 or not opens or self._attribute(word) or word in JOINTS:
            return None
        leads = last < len(self._words) and self._relation(last) is not None
        leads = leads or self._word(last) in ("goes", "belongs")
        verb = self._lexicon.verb(word) is not None or self._relation(at) is not None
        return Phrase(at, at, last, "", None, (), named[0].name) if leads and not verb else None

    def _has_colours(self, said: tuple[str, ...], noun: str = "") -> bool:
        """Whether something on the scene (of that noun) has all the colours that were said."""
        colours = {word for word in said if word in self._lexicon.colors}
        return any(
            colours <= thing.colors | set(thing.name)
            for thing in self._things
            if not noun or thing.head == noun or self._lexicon.means(noun, thing.noun)
        )

    def _sharing_noun(self, phrase: Phrase) -> Phrase:
        """ "the red" with the noun of "and the blue cup"; "the red and blue cups" as one group."""
        if phrase.group or phrase.origin or not phrase.modifiers:
            return phrase
        ahead = self._noun_ahead(phrase.last)
        if ahead is None or not self._has_colours(phrase.modifiers, singular(ahead.head[-1])):
            return phrase
        colours = self._colours_listed(phrase, ahead)
        if colours:
            told = replace(ahead, modifiers=phrase.modifiers, head=ahead.head[-1:], also=colours)
            return replace(told, opened=phrase.opened, first=phrase.first, det=phrase.det)
        listed = ahead.opened > phrase.last + 1 or ahead.det or self._word(phrase.last) != "and"
        if not ahead.plural or listed:
            return replace(phrase, head=ahead.head[-1:])
        first = phrase.first if phrase.det else phrase.opened
        modifiers, head = (*ahead.modifiers, *ahead.head[:-1]), ahead.head[-1:]
        return replace(ahead, opened=phrase.opened, first=first, det=phrase.det,
                       modifiers=modifiers, head=head, also=(phrase.modifiers,))  # fmt: skip

    def _colours_listed(self, phrase: Phrase, ahead: Phrase) -> tuple[tuple[str, ...], ...]:
        """The other colours of "the red, blue and green blocks"; none where they name one each."""
        at, found = phrase.last, list[tuple[str, ...]]()
        while self._word(at) == "," and self._word(at + 1) in self._lexicon.colors:
            found.append((self._word(at + 1),))
            at += 2
        at += self._word(at) == ","
        last = ahead.modifiers or ahead.head[:-1]
        whole = ahead.plural and not ahead.det and ahead.first == at + 1 and len(last) == 1
        if not found or self._word(at) != "and" or not whole:
            return ()
        return (*found, last)

    def _noun_ahead(self, at: int) -> Phrase | None:
        """The phrase with a noun that ends a list of attributes begun before a token."""
        while self._word(at) in _LISTING:
            at += 1
            at += self._word(at) in ("and", "or")
            phrase = self.noun_phrase(at) if at < len(self._words) else None
            if phrase is not None and phrase.head:
                told = phrase.modifiers or is_attribute(phrase.head[0], self._lexicon)
                return phrase if told and phrase.known else None
            first = at + (self._word(at) in ARTICLES)
            at = self._attributes(first, colours=False)
            if at == first:
                return None
        return None


def _holds(thing: Thing, phrase: Phrase, content: list[str]) -> bool:
    """Whether a thing of the phrase's noun is "... of ..." what was said ("ball of red yarn")."""
    if "of" not in thing.name or not phrase.head or singular(phrase.head[-1]) != thing.head:
        return False
    held = thing.name[thing.name.index("of") + 1 :]
    return set(content) <= set(held) and content[-1] == held[-1]

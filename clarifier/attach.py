"""Where a relation belongs: part of a phrase ("the cup next to the bowl"), or where to put it?

Decided by what the verb still needs and by what is true on the scene.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from clarifier.distances import UTMOST
from clarifier.located import Link, sides_said, utmost_said
from clarifier.pieces import Phrase
from clarifier.reading import Reading
from clarifier.reference import denote
from clarifier.spoken import settles
from clarifier.words import stems

_NEEDY = frozenset({"place", "push"})
"""Classes of verbs that need a place."""
_GETTING = frozenset({"get", "getting", "have", "having"})
_PARTICIPLES = frozenset(
    {"that", "that's", "which", "is", "are", "sitting", "standing", "lying", "located", "resting"}
    | {"placed", "currently", "positioned", "who", "being", "right", "lies", "stands", "sits"}
)
_DENYING = frozenset({"not", "isn't", "aren't"})
_WHATEVER = frozenset({"whatever", "whatever's", "what", "what's", "anything"})
_DESCRIBED = frozenset({"touch", "tap", "poke", "grab", "grasp", "lift", "topple", "knock"})
"""Verbs that need no place: a relation behind their object only tells it apart."""
_HOLDING = frozenset({"hold", "holding", "keep", "keeping"})
"""Behind these "over the tub" is where, not which."""
_COMPARING = frozenset({"closer", "nearer", "further", "farther"})
_NEAREST = {"nearest": "nearest", "closest": "nearest", "furthest": "furthest",
            "farthest": "furthest"}  # fmt: skip
_BECOMING = frozenset(
    {"goes", "belongs", "go", "belong", "should", "must", "needs", "wants", "has", "gets"}
)
"""Behind a noun and its place these say what is to become of it."""
_WISHING = frozenset({"want", "need", "like", "love", "prefer", "wish", "should", "must", "can"})
_SENT = frozenset({"to", "into", "onto"})
"""Behind a noun without a verb these say where it goes: "block left of the cone to the corner"."""
_SIDELESS = frozenset({"on", "in", "between", "goal"})
"""Relations to a mark that leave no side of it open."""
_MINE = frozenset({"me", "us", "myself"})

_RANK = re.compile(
    r"\b(at|on|in|to) (?:the )?(?:very )?(bottom|middle|centre|center|top|left|right|front|back)\b"
    r"(?! of\b)"
)
_AXES = tuple(
    frozenset({*ends, "middle", "centre", "center"})
    for ends in (("bottom", "top"), ("left", "right"), ("front", "back"))
)
_MAKING = re.compile(
    r"\b(?:stack|pile|tower|build|arrang|rearrang|line|row|column|order|sort|make|form|organi[sz]|"
    r"align)\w*\b"
)
"""Words for what is made of things in an order."""
_TOWERING = re.compile(r"\b(?:stack\w*|pile|tower|sandwich)\b")


class Attachment(Reading):
    """Reads the relations behind a noun."""

    def links(self, at: int, phrase: Phrase) -> tuple[list[Link], int, int]:
        """Relations that belong to the phrase, the chunk behind them, and the last token."""
        links: list[Link] = []
        behind, last = at + 1, phrase.last
        while True:
            start, forced = self._skip_participles(behind)
            found = self._nearest_to(phrase, behind) or self._link_at(start, forced)
            if found is None and not links and phrase.head:
                found, forced = self._of_side(behind), True
            if found is None:
                return links, behind, last
            link_, after = found
            if start > behind and self.chunk_text(start - 1) in _DENYING:
                if link_.relation in ("nearest", "furthest", UTMOST):
                    return links, behind, last
                link_ = replace(link_, denied=True)
            apart = self._tells_apart(at, phrase, links, link_, after)
            if self.chosen and not apart and (not forced or self._listed_at(at)):
                return links, behind, last
            forced = forced or phrase.det == "whichever"
            if not (forced or apart or self._belongs(at, start, phrase, links, link_, after)):
                return links, behind, last
            links, behind = [*links, link_], after
            last = self.chunks[after - 1].last

    def _tells_apart(
        self, at: int, phrase: Phrase, links: list[Link], link_: Link, after: int
    ) -> bool:
        """ "if the cup on the left is ...", "the wider of the cup on the left and the bowl": a side
        says which of several, where no place is wanted."""
        before = self.chunk_text(at - 1) if at else ""
        said = self.chunk_text(after) in _BECOMING | {"is", "isn't", "be"} or before == "using"
        known = self.verb == "" and said
        listed = self.chosen and (
            self.chunk_text(after) in ("and", "or", ",", "") or bool(self.relation_before(at))
        )
        sided = link_.relation in ("on", "in", "beside") and bool(link_.sides)
        near = self.chosen and link_.relation in ("nearest", "furthest", "beside")
        tells = (sided or near) and link_.sides != ("table",)
        if phrase.plural or not tells or not (known or listed):
            return False
        wide = denote(phrase, self.context(), links).objects
        return len(wide) > 1 == len(denote(phrase, self.context(), [*links, link_]).objects)

    def _listed_at(self, at: int) -> bool:
        """Whether the phrase is one of those that a choice is made from."""
        return at > 0 and self.chunk_text(at - 1) in ("and", "or", ",", "of", "among")

    def _skip_participles(self, at: int) -> tuple[int, bool]:
        """Index behind "that is", "sitting", ...; true if there was one."""
        end = at
        while end < len(self.chunks) and self.chunk_text(end) in _PARTICIPLES:
            end += 1
        end += end > at and self.chunk_text(end) in _DENYING
        words = {self.chunk_text(i) for i in range(at, end)}
        if self._whichever(at):
            return end, True
        told = (
            self.verb == "" and not self.naming and not words & {"that", "which", "who", "that's"}
        )
        says = words <= {"is", "are", "right"}
        if told and not says:  # "the cup lying on the left, put it ..."
            found = self._link_at(end)
            told = found is None or not self._fronted(found[1])
        return (at, False) if told or says else (end, True)

    def _whichever(self, at: int) -> bool:
        """Whether the noun before a chunk is "whichever ...": what is said of it tells which."""
        phrase = self.chunks[at - 1].phrase if at else None
        return phrase is not None and phrase.det == "whichever"

    def _link_at(self, at: int, forced: bool = False) -> tuple[Link, int] | None:
        """The relation that starts at a chunk, with what it leads to; nothing need follow where it
        is ``forced`` to be part of the phrase ("that is farthest away")."""
        if at >= len(self.chunks) or self.chunks[at].kind != "relation":
            return None
        if self.chunks[at].value == UTMOST:
            sides = sides_said(self.chunk_text(at).split(), self.lexicon)
            return Link(UTMOST, sides=sides[-1:]), at + 1
        if forced and self._stands_alone(at):
            return Link(self.chunks[at].value), at + 1
        if at + 1 >= len(self.chunks):
            return None
        relation, target = self.chunks[at].value, self.chunks[at + 1]
        if relation == "goal":
            return None
        if target.kind == "place":
            sides = sides_said(self.chunk_text(at + 1).split(), self.lexicon)
            if relation in ("above", "below"):
                return None
            utmost = utmost_said(self.chunk_text(at + 1).split(), self.lexicon)
            if utmost and relation in ("on", "in", "beside", "goal"):
                return Link(UTMOST, sides=utmost), at + 2
            if relation in ("left", "right") and sides == ("table",):
                sides = (relation,)
            return (Link(relation, sides=sides), at + 2) if sides else None
        if relation in ("nearest", "furthest") and self.chunk_text(at + 1) in _MINE | {"you"}:
            return Link(_flipped(relation, self.chunk_text(at + 1))), at + 2
        if relation in ("nearest", "furthest") and self.chunk_text(at + 1) == "it":
            before = [one.mention.objects for one in self.spoken if settles(one.mention)]
            return (Link(relation, before[-1]), at + 2) if before else None
        if target.kind != "np" or target.phrase is None:
            return None
        return self._anchored(relation, at + 1, target.phrase)

    def _of_side(self, at: int) -> tuple[Link, int] | None:
        """ "the can of the middle", "the mug of the left": the one that stands there."""
        place = self.chunks[at + 1] if at + 1 < len(self.chunks) else None
        if self.chunk_text(at) != "of" or place is None or place.kind != "place":
            return None
        sides = sides_said(self.chunk_text(at + 1).split(), self.lexicon)
        if len(sides) != 1 or sides[0] not in ("left", "right", "middle", "near", "far"):
            return None
        relation = "on" if sides == ("middle",) else UTMOST
        return Link(relation, sides=sides), at + 2

    def _stands_alone(self, at: int) -> bool:
        """ "the cup that is farthest away": from the person, as nothing else is said."""
        if self.chunks[at].value not in ("nearest", "furthest"):
            return False
        if self.chunk_text(at).endswith((" to", " from", " of", " by")):
            return False
        behind = self.chunks[at + 1].kind if at + 1 < len(self.chunks) else "joint"
        return behind in ("joint", "relation", "verb")

    def _nearest_to(self, phrase: Phrase, at: int) -> tuple[Link, int] | None:
        """ "the nearest block to the cup"; "move the nearest block to the cup" says where to."""
        relation = next((_NEAREST[m] for m in phrase.modifiers if m in _NEAREST), None)
        if relation is None or self.chunk_text(at) not in ("to", "from"):
            return None
        target = self.chunks[at + 1] if at + 1 < len(self.chunks) else None
        if target is None or (self._needs_place() and not self._more_goals(at + 2)):
            return None
        if self.chunk_text(at + 1) in _MINE:
            return Link(relation), at + 2
        return None if target.phrase is None else self._anchored(relation, at + 1, target.phrase)

    def _anchored(self, relation: str, at: int, phrase: Phrase) -> tuple[Link, int]:
        anchors, behind = denote(phrase, self.context()).objects, at + 1
        joined = behind + 1 < len(self.chunks) and self.chunk_text(behind) == "and"
        if relation == "between" and joined and not phrase.plural:
            second = self.chunks[behind + 1].phrase
            if second is not None:
                anchors += denote(second, self.context()).objects
                behind += 2
        return Link(relation, anchors), behind

    def _ends_there(self, after: int) -> bool:
        """ "the lamp closer to the book": no verb is said, and nothing else of where it goes."""
        rest = self.chunks[after:]
        end = next((i for i, chunk in enumerate(rest) if chunk.kind == "joint"), len(rest))
        said = {self.chunk_text(after + i) for i in range(end)}
        told = self.verb == "" and not self.naming and not said & _BECOMING
        return told and not any(c.kind in ("verb", "relation", "place") for c in rest[:end])

    def _leads_to(self, at: int) -> bool:
        """ "onto", "into": where something goes, never which one."""
        return at < len(self.chunks) and self.chunk_text(at) in ("onto", "into")

    def _belongs(
        self, at: int, start: int, phrase: Phrase, links: list[Link], link_: Link, after: int
    ) -> bool:
        """Whether a relation behind a noun (its chunk at ``start``) is part of its phrase, and not
        where to put it."""
        if link_.relation == UTMOST:
            return not self._needs_place() or self._more_goals(after)
        if link_.relation in ("nearest", "furthest"):
            comparing = self.tokens[self.chunks[start].first].text in _COMPARING
            taken = self.said_verb in ("take", "bring", "taking", "bringing")
            goes = self._needs_place() or taken or self._ends_there(after)
            more = bool(links) and self._more_goals(after)
            more = more or self._told_and_placed(phrase, link_, links, after)
            return not (comparing and goes) or more or self._fronted(after)
        if phrase.det == "other" and self._needs_place() and not self._more_goals(after):
            return False
        if self.said_verb in _HOLDING and self.chunk_text(start) in ("over", "above"):
            return False
        if self._leads_to(at + 1) or (link_.sides and self._ranks()):
            return False
        bare = not phrase.head and not phrase.group
        if bare and phrase.modifiers and self._wished_at(at, phrase, link_, links):
            return False
        if bare and phrase.det in ("this", "that") and not phrase.modifiers and self._needs_place():
            return self._more_goals(after)
        if (bare and not (phrase.modifiers and self.verb in _NEEDY)) or self._whatever(phrase):
            return True
        if self.naming and not self.spoken:
            return True
        if link_.sides == ("table",) and self.verb in _NEEDY and not self._more_goals(after):
            return False
        wide = denote(phrase, self.context(), links).objects
        narrow = denote(phrase, self.context(), [*links, link_]).objects
        if not narrow:
            return self._only_describes(link_)
        if self._says_more(after):
            return True
        if self.relation_before(at):
            told = len(wide) > 1 and len(narrow) == 1 and not phrase.plural
            several = phrase.plural and len(narrow) >= said_count(phrase)
            return told or (self._stands_so(at, link_) and (narrow == wide or several))
        if self.verb == "":
            placed = bool(link_.sides) and self._more_goals(after)
            sent = len(narrow) < len(wide) and self.chunk_text(after) in _SENT
            return placed or sent or self._fronted(after)
        if phrase.plural and len(narrow) < said_count(phrase) <= len(wide):
            return False
        if self._needs_place() or self.verb in ("arrange", "topple"):
            if self._more_goals(after):
                return True
            static = bool(link_.sides) and link_.relation in ("on", "in", "beside")
            return self.verb == "push" and static and len(wide) > 1 and len(narrow) == 1
        return True

    def _stands_so(self, at: int, link_: Link) -> bool:
        """ "Around the ball on the left", "into the pots at the top": where the mark stands, for a
        side says nothing more of what goes there; "beside the plate on the left" may be where."""
        static = bool(link_.sides) and link_.relation in ("on", "in", "beside")
        led = at > 0 and self.chunks[at - 1].kind == "relation"
        sideless = led and self.chunks[at - 1].value in _SIDELESS
        return static and sideless and link_.sides != ("table",)

    def _told_and_placed(self, phrase: Phrase, link_: Link, links: list[Link], after: int) -> bool:
        """ "Put the cup nearer to the lamp in the bowl": the nearer of several, and where to."""
        if after >= len(self.chunks) or self.chunks[after].value not in ("in", "on"):
            return False
        wide = denote(phrase, self.context(), links).objects
        return len(wide) > 1 == len(denote(phrase, self.context(), [*links, link_]).objects)

    def _fronted(self, after: int) -> bool:
        """ "The last two on the right, put them there": a thing in front, taken up behind its
        clause by a verb and a pronoun."""
        if after >= len(self.chunks) or self.chunks[after].kind != "joint":
            return False
        rest = [chunk for chunk in self.chunks[after:] if chunk.kind != "joint"]
        first = next((i for i, chunk in enumerate(rest) if chunk.kind == "verb"), len(rest))
        ahead = {t.text for c in rest[:first] for t in self.tokens[c.first : c.last]}
        taken = first + 1 < len(rest) and rest[first + 1].kind == "pronoun"
        taken = taken or (first + 2 < len(rest) and rest[first + 2].kind == "pronoun")
        return taken and ahead <= self.lexicon.words("polite")

    def _ranks(self) -> bool:
        """ "Blue at the bottom, red in the middle": places in an order that is to be made."""
        said = " ".join(token.text for token in self.tokens)
        places = {place for _, place in _RANK.findall(said)}
        free = self.verb in ("arrange", "")
        if free and _TOWERING.search(said) and places & {"bottom", "top"}:
            return True
        makes = free and _MAKING.search(said) is not None
        return makes and any(len(places & axis) > 1 for axis in _AXES)

    def _wished_at(self, at: int, phrase: Phrase, link_: Link, links: list[Link]) -> bool:
        """ "I want the red one on the plate", "reds on the plate", where none is on it: that is
        where it is to go."""
        wish = self.verb == "" and not self.naming
        opens = not phrase.det and (at == 0 or self.chunks[at - 1].kind == "joint")
        told = opens or any(t.text in _WISHING for t in self.tokens[: phrase.opened])
        told = told or phrase.any_will_do or self._goes_on_listing(at)
        wish = wish and told
        return wish and not denote(phrase, self.context(), [*links, link_]).objects

    def _goes_on_listing(self, at: int) -> bool:
        """ "The green block on the blue one and then the red one on the green": more of it."""
        joined = at > 0 and self.chunks[at - 1].kind == "joint"
        placed = bool(self.spoken) and bool(self.spoken[-1].relation)
        return joined and placed and any(one.theme for one in self.spoken)

    def _says_more(self, at: int) -> bool:
        """Whether the sentence goes on with what is to become of the thing: "... goes in the"."""
        return self.verb == "" and self.chunk_text(at) in _BECOMING

    def _needs_place(self) -> bool:
        """Whether the verb wants a relation for itself."""
        words = [token.text for token in self.tokens]
        fetches = any(one in _GETTING and two in _MINE for one, two in pairwise(words))
        return self.verb in _NEEDY or (self.said_verb in _GETTING and not fetches)

    def _whatever(self, phrase: Phrase) -> bool:
        """ "whatever is on the plate": the relation must be part of it."""
        told = phrase.group == "all" and not phrase.modifiers
        return told and self.tokens[phrase.opened].text in _WHATEVER

    def _only_describes(self, link_: Link) -> bool:
        """Behind "touch" or "lift" a relation says which thing is meant, even if none is there."""
        static = link_.relation in ("on", "in", "beside", "between") and bool(link_.anchors)
        return static and any(stem in _DESCRIBED for stem in stems(self.said_verb))

    def _more_goals(self, at: int) -> bool:
        """Whether the verb's part of the sentence says a place or a direction further on, behind
        where the last mark is told to be ("the box that is on the left")."""
        start, forced = self._skip_participles(at)
        own = self._link_at(start, True) if forced else None
        at = own[1] if own is not None else at
        for i in range(at, len(self.chunks)):
            chunk = self.chunks[i]
            if chunk.kind == "verb":
                return False
            if chunk.kind == "joint" and (self.chunk_text(i) != "," or self._next_item(i)):
                return False
            if chunk.kind in ("relation", "place"):
                return True
            if self.chunk_text(i) in self.lexicon.words("directions"):
                return True
        return False

    def _next_item(self, at: int) -> bool:
        """Whether a comma leads to another thing: "the mug here, the bowl there"."""
        return at + 1 < len(self.chunks) and self.chunks[at + 1].kind in ("np", "joint")


def without_nearest(phrase: Phrase, links: Sequence[Link]) -> Phrase:
    """The phrase without "nearest" where a link says to what."""
    if not any(link.relation in ("nearest", "furthest") for link in links):
        return phrase
    return replace(phrase, modifiers=tuple(m for m in phrase.modifiers if m not in _NEAREST))


def said_count(phrase: Phrase) -> int:
    """How many things a phrase speaks of; 0 where that was not said."""
    return int(phrase.count or (2 if phrase.det == "both" else 0))


def _flipped(relation: str, who: str) -> str:
    """The arm sits opposite: nearest to "you" is furthest from the person."""
    if who != "you":
        return relation
    return "furthest" if relation == "nearest" else "nearest"

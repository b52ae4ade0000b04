"""Every phrase of a sentence that names objects, linked to the live scene.

Where a relation belongs ("the cup next to the bowl": part of the phrase, or where to put it?) is
decided by what the verb still needs and by what is true on the scene.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from agent.messages import Focus, Mention
from clarifier.lexicon import Lexicon
from clarifier.phrase import FREE, Chunk, Parser, Phrase
from clarifier.reference import Context, Denotation, Link, denote, sides_said
from clarifier.things import side_of, things_of
from clarifier.words import Token, tokenise
from scene.types import Scene

FOCUS_MARGIN = 0.15
"""Saliences closer than this do not settle what "it" is."""
FOCUS_FLOOR = 0.45
"""Least salience at which a thing spoken of before settles "the apple" among several."""
_NEEDY = frozenset({"place", "push"})
_PARTICIPLES = frozenset(
    {"that", "that's", "which", "is", "are", "sitting", "standing", "lying", "located", "resting"}
    | {"placed", "currently", "positioned", "who", "being", "right", "lies", "stands", "sits"}
)
_COPULAS = frozenset({"is", "are", "be", "being", "was", "stays", "remains", "becomes"})
_MINE = frozenset({"me", "us", "myself"})


@dataclass(frozen=True)
class Spoken:
    """A mention with its grammar: ``theme`` is what the verb acts on, else ``relation`` leads to
    it; ``same_type`` are the objects of its noun, adjectives aside."""

    mention: Mention
    phrase: Phrase | None
    same_type: tuple[str, ...]
    theme: bool
    relation: str
    verb: str
    first: int
    last: int
    tie_broken: bool = False


@dataclass(frozen=True)
class Linked:
    """A sentence with its mentions, in order, and the pieces it was cut into."""

    text: str
    tokens: tuple[Token, ...]
    chunks: tuple[Chunk, ...]
    spoken: tuple[Spoken, ...]

    @property
    def mentions(self) -> tuple[Mention, ...]:
        """What the translator is told."""
        return tuple(one.mention for one in self.spoken)

    @property
    def slots(self) -> tuple[str, ...]:
        """Slots in order of first mention."""
        return tuple(dict.fromkeys(one.mention.slot for one in self.spoken))

    def first(self, slot: str) -> Spoken:
        """The first mention of a slot."""
        return next(one for one in self.spoken if one.mention.slot == slot)


def link(text: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> Linked:
    """Find and denote every mention of a sentence. Pure; chooses nothing."""
    return _linker(text, scene, tuple(focus), lexicon).run()


def link_answer(
    text: str, scene: Scene, lexicon: Lexicon, among: tuple[str, ...] | None = None
) -> Linked:
    """Read a text that only names a thing ("the one by the plate"), meant to be ``among`` these."""
    linker = _linker(text, scene, (), lexicon)
    linker.naming, linker.among = True, among
    return linker.run()


def _linker(text: str, scene: Scene, focus: tuple[Focus, ...], lexicon: Lexicon) -> _Linker:
    tokens = tokenise(text)
    parser = Parser(tokens, things_of(scene, lexicon), lexicon)
    return _Linker(text, tokens, parser.chunks(), scene, focus, lexicon)


@dataclass
class _Linker:
    text: str
    tokens: tuple[Token, ...]
    chunks: tuple[Chunk, ...]
    scene: Scene
    focus: tuple[Focus, ...]
    lexicon: Lexicon
    spoken: list[Spoken] = field(default_factory=list)
    naming: bool = False
    among: tuple[str, ...] | None = None
    verb: str = ""
    region: int = 0
    regions: list[int] = field(default_factory=list)

    def run(self) -> Linked:
        at = 0
        while at < len(self.chunks):
            chunk = self.chunks[at]
            if chunk.kind == "verb":
                self.verb, self.region = chunk.value, self.region + 1
            if chunk.kind == "np" and chunk.phrase is not None:
                at = self._noun_phrase(at, chunk.phrase)
            else:
                if chunk.kind == "pronoun":
                    self._pronoun(at, chunk)
                at += 1
        return Linked(self.text, self.tokens, self.chunks, tuple(self.spoken))

    # --- noun phrases ------------------------------------------------------------

    def _noun_phrase(self, at: int, phrase: Phrase) -> int:
        """Record the mention at chunk ``at``; returns the index of the chunk behind it."""
        if self._names_nothing(at, phrase):
            return at + 1
        links, behind, last = self._links(at, phrase)
        found = denote(phrase, self._among_context(), links)
        objects, broken = self._settled(phrase, found)
        self._record(phrase, phrase.first, last, objects, found, at, broken)
        return behind

    def _names_nothing(self, at: int, phrase: Phrase) -> bool:
        """ "the can being the leftmost", "the left edge ... the right one", "arrange things so"."""
        before = self.tokens[phrase.opened - 1].text if phrase.opened else ""
        if not phrase.head and before in _COPULAS:
            return True
        if not phrase.det and phrase.head[-1:] == ("things",) and not phrase.modifiers:
            return True
        if phrase.head or not self._relation_before(at) or not phrase.modifiers:
            return False
        places = any(chunk.kind == "place" for chunk in self.chunks[:at])
        return places and all(side_of(word, self.lexicon) for word in phrase.modifiers)

    def _context(self) -> Context:
        order = sorted(self.focus, key=lambda one: -one.salience)
        named = [o for one in self.spoken for o in one.mention.objects if _settles(one.mention)]
        return Context(self.scene, self.lexicon, tuple(f.object for f in order), tuple(named))

    def _among_context(self) -> Context:
        """For the first mention of an answer, only what it was asked about may be meant."""
        return replace(self._context(), among=None if self.spoken else self.among)

    def _settled(self, phrase: Phrase, found: Denotation) -> tuple[tuple[str, ...], bool]:
        """ "the apple" among several: the one spoken of in this sentence, or the one in focus."""
        several = len(found.objects) > 1 and not phrase.plural
        if not several or phrase.det in FREE or phrase.det == "other":
            return found.objects, False
        if phrase.modifiers or not phrase.head or phrase.origin:
            return found.objects, False
        before = [
            one.mention.objects
            for one in self.spoken
            if _settles(one.mention) and one.mention.objects[0] in found.objects
        ]
        if len(set(before)) == 1:
            return before[0], False
        best = _clear_best([f for f in self.focus if f.object in found.objects])
        return ((best,), True) if best is not None else (found.objects, False)

    def _record(
        self, phrase: Phrase | None, first: int, last: int, objects: tuple[str, ...],
        found: Denotation, at: int, broken: bool = False, slot: str | None = None,
    ) -> None:  # fmt: skip
        start, end = self.tokens[first].start, self.tokens[last - 1].end
        if self.text[start:end].lower().endswith(("'s", "’s")):
            whole = any(self.text[start:end].lower() == item.name.lower() for item in self.scene)
            end -= 0 if whole else 2
        text = self.text[start:end]
        free = phrase is not None and phrase.any_will_do
        plural = phrase is not None and phrase.plural
        slot = slot or self._slot(text, objects, free)
        mention = Mention(slot, start, end, text, objects, plural, free)
        relation = self._relation_before(at)
        self.spoken.append(
            Spoken(mention, phrase, found.same_type, not relation, relation, self.verb, first, last,
                   broken)
        )  # fmt: skip
        self.regions.append(self.region)

    def _slot(self, text: str, objects: tuple[str, ...], free: bool) -> str:
        """The slot of an earlier mention of the same things, or the next one."""
        for one in self.spoken:
            same = one.mention.objects == objects and (objects or one.mention.text == text)
            again = len(objects) == 1 or text.lower() == one.mention.text.lower()
            if same and again and not free:
                return one.mention.slot
        used = {one.mention.slot for one in self.spoken}
        return f"m{len(used) + 1}"

    def _relation_before(self, at: int) -> str:
        """The relation that leads to the mention; "between A and B" leads to both."""
        if at and self.chunks[at - 1].kind == "relation":
            return self.chunks[at - 1].value
        joined = at >= 3 and self.chunks[at - 1].kind == "joint"
        if joined and self.spoken and self.spoken[-1].relation == "between":
            return "between"
        return ""

    # --- relations inside a phrase -----------------------------------------------------------

    def _links(self, at: int, phrase: Phrase) -> tuple[list[Link], int, int]:
        """Relations that belong to the phrase, the chunk behind them, and the last token."""
        links: list[Link] = []
        behind, last = at + 1, phrase.last
        while True:
            start, forced = self._skip_participles(behind)
            found = self._link_at(start)
            if found is None:
                return links, behind, last
            link_, after = found
            if not (forced or self._belongs(at, phrase, links, link_, after)):
                return links, behind, last
            links, behind = [*links, link_], after
            last = self.chunks[after - 1].last

    def _skip_participles(self, at: int) -> tuple[int, bool]:
        """Index behind "that is", "sitting", ...; true if there was one."""
        end = at
        while end < len(self.chunks) and self._chunk_text(end) in _PARTICIPLES:
            end += 1
        words = {self._chunk_text(i) for i in range(at, end)}
        told = (
            self.verb == "" and not self.naming and not words & {"that", "which", "who", "that's"}
        )
        predicate = told or words <= {"is", "are", "right"}
        return (at, False) if predicate else (end, True)

    def _chunk_text(self, at: int) -> str:
        chunk = self.chunks[at]
        return " ".join(token.text for token in self.tokens[chunk.first : chunk.last])

    def _link_at(self, at: int) -> tuple[Link, int] | None:
        """The relation that starts at a chunk, with what it leads to."""
        if at + 1 >= len(self.chunks) or self.chunks[at].kind != "relation":
            return None
        relation, target = self.chunks[at].value, self.chunks[at + 1]
        if relation == "goal":
            return None
        if target.kind == "place":
            sides = sides_said(self._chunk_text(at + 1).split(), self.lexicon)
            if relation in ("left", "right") and sides == ("table",):
                sides = (relation,)
            return (Link(relation, sides=sides), at + 2) if sides else None
        if relation in ("nearest", "furthest") and self._chunk_text(at + 1) in _MINE | {"you"}:
            return Link(_flipped(relation, self._chunk_text(at + 1))), at + 2
        if target.kind != "np" or target.phrase is None:
            return None
        return self._anchored(relation, at + 1, target.phrase)

    def _anchored(self, relation: str, at: int, phrase: Phrase) -> tuple[Link, int]:
        anchors, behind = denote(phrase, self._context()).objects, at + 1
        joined = behind + 1 < len(self.chunks) and self._chunk_text(behind) == "and"
        if relation == "between" and joined and not phrase.plural:
            second = self.chunks[behind + 1].phrase
            if second is not None:
                anchors += denote(second, self._context()).objects
                behind += 2
        return Link(relation, anchors), behind

    def _belongs(self, at: int, phrase: Phrase, links: list[Link], link_: Link, after: int) -> bool:
        """Whether a relation behind a noun is part of its phrase, and not where to put it."""
        if link_.relation in ("nearest", "furthest"):
            return True
        if not phrase.head and not (phrase.modifiers and self.verb in _NEEDY):
            return True
        if self.naming and not self.spoken:
            return True
        if link_.sides == ("table",) and self.verb in _NEEDY and not self._more_goals(after):
            return False
        wide = denote(phrase, self._context(), links).objects
        narrow = denote(phrase, self._context(), [*links, link_]).objects
        if not narrow:
            return False
        if self._relation_before(at):
            return len(wide) > 1 and len(narrow) == 1 and not phrase.plural
        if self.verb == "":
            return False
        if self.verb in _NEEDY or self.verb in ("arrange", "topple"):
            if self._more_goals(after):
                return True
            static = bool(link_.sides) and link_.relation in ("on", "in", "beside")
            return self.verb == "push" and static and len(wide) > 1 and len(narrow) == 1
        return True

    def _more_goals(self, at: int) -> bool:
        """Whether the verb's part of the sentence says a place or a direction further on."""
        for i in range(at, len(self.chunks)):
            chunk = self.chunks[i]
            if chunk.kind == "verb":
                return False
            if chunk.kind == "joint" and self._chunk_text(i) != ",":
                return False
            if chunk.kind in ("relation", "place"):
                return True
            if self._chunk_text(i) in self.lexicon.words("directions"):
                return True
        return False

    # --- pronouns ------------------------------------------------------------

    def _pronoun(self, at: int, chunk: Chunk) -> None:
        """Link "it" (and "them" for things of an earlier sentence) to what it stands for."""
        if chunk.value == "them" and len(self.spoken) >= 2:
            return
        objects, slot = self._antecedent(chunk.value, at)
        phrase = None
        found = Denotation(objects, tuple(item.id for item in self.scene))
        self._record(phrase, chunk.first, chunk.last, objects, found, at, slot=slot)
        if chunk.value == "them" and len(objects) > 1:
            last = self.spoken.pop()
            mention = last.mention
            group = Mention(mention.slot, mention.start, mention.end, mention.text, objects, True)
            self.spoken.append(Spoken(group, None, objects, last.theme, last.relation, last.verb,
                                      last.first, last.last))  # fmt: skip

    def _antecedent(self, pronoun: str, at: int) -> tuple[tuple[str, ...], str | None]:
        """Objects (and slot) that the pronoun stands for: this sentence first, then the focus."""
        inside = self._inside(at)
        if inside is not None:
            return inside
        if pronoun == "them":
            recent = [f for f in self.focus if f.salience >= FOCUS_FLOOR]
            return tuple(f.object for f in recent), None
        present = {item.id for item in self.scene}
        living = [f for f in self.focus if f.object in present]
        if not living:
            only = tuple(present) if len(present) == 1 else ()
            return only, None
        best = max(f.salience for f in living)
        tied = [f.object for f in living if f.salience > best - FOCUS_MARGIN]
        return tuple(item.id for item in self.scene if item.id in tied), None

    def _inside(self, at: int) -> tuple[tuple[str, ...], str | None] | None:
        """The theme of the sentence so far. After "A in B" both may be meant as the next theme."""
        themes = [i for i, one in enumerate(self.spoken) if one.theme]
        if not themes:
            if not self.spoken:
                return None
            one = self.spoken[-1]
            return one.mention.objects, one.mention.slot
        last = themes[-1]
        theme = self.spoken[last]
        holders = [
            one
            for i, one in enumerate(self.spoken)
            if i > last and one.relation in ("in", "on") and self.regions[i] == self.regions[last]
        ]
        later = self.region > self.regions[last] and not self._relation_before(at)
        later = later and self.verb in ("place", "push", "turn", "topple")
        single = not theme.mention.plural and not theme.mention.free
        if holders and later and single and _settles(holders[-1].mention):
            return (*theme.mention.objects, holders[-1].mention.objects[0]), None
        return theme.mention.objects, theme.mention.slot


def ambiguous(spoken: Spoken) -> bool:
    """Whether a singular definite phrase fits several things."""
    mention = spoken.mention
    return len(mention.objects) > 1 and not mention.free and not mention.plural


def _settles(mention: Mention) -> bool:
    return len(mention.objects) == 1 and not mention.plural


def _clear_best(focus: Sequence[Focus]) -> str | None:
    """The most salient object if it is salient enough and clearly ahead of the next."""
    order = sorted(focus, key=lambda one: -one.salience)
    if not order or order[0].salience < FOCUS_FLOOR:
        return None
    if len(order) > 1 and order[0].salience - order[1].salience < FOCUS_MARGIN:
        return None
    return order[0].object


def _flipped(relation: str, who: str) -> str:
    """The arm sits opposite: nearest to "you" is furthest from the person."""
    if who != "you":
        return relation
    return "furthest" if relation == "nearest" else "nearest"

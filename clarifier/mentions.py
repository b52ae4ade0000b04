"""Every phrase of a sentence that names objects, linked to the live scene.

Where phrases end and what they denote is settled here; relations behind them in `attach`, what
is no mention after all in `asides`, what pronouns stand for in `antecedents`.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from agent.messages import Focus, Mention
from clarifier.antecedents import Antecedents, clear_best
from clarifier.asides import Asides
from clarifier.attach import Attachment, without_nearest
from clarifier.lexicon import Lexicon
from clarifier.located import as_counted
from clarifier.phrase import Parser
from clarifier.pieces import FREE, Chunk, Phrase
from clarifier.reading import counted_off
from clarifier.reference import Denotation, denote
from clarifier.spoken import Linked, Spoken, settles, without_goals
from clarifier.strays import gathered
from clarifier.things import size_of, things_of
from clarifier.words import singular, stems, tokenise
from scene.types import Scene

_RESETS = frozenset({"want", "need", "like", "love", "should", "must", "wish", ".", ";", ":", "?"})
"""Behind these the verb said before no longer governs."""
_TOGETHER = re.compile(
    r"\s*(?:all |back |out )*(?:in(?:to)? (?:(?:a|one|two|straight|single|neat|nice|long) )*"
    r"(?:row|line|column|circle|ring|triangle|square|pile|stack|heap|tower|group|cluster|order|pair)"
    r"s?\b|together\b|apart\b|side by side|next to (?:each|one an)other|evenly\b|"
    r"from (?:left|right|small|big|large|short|tall)\w* to\b|"
    r"by (?:size|colou?r|kind|height|width|length)\b)"
)
"""What follows can only be said of several."""
_CONDITIONS = frozenset({"if", "when", "unless", "whether", "should", "provided"})


def link(text: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> Linked:
    """Find and denote every mention of a sentence. Pure; chooses nothing.

    The sentence that is linked may be put in another order (`strays`).
    """
    linked = _linker(text, scene, tuple(focus), lexicon).run()
    whole = gathered(linked)
    return linked if whole is None else _linker(whole, scene, tuple(focus), lexicon).run()


def link_answer(
    text: str, scene: Scene, lexicon: Lexicon, among: tuple[str, ...] | None = None
) -> Linked:
    """Read a text that only names a thing ("the one by the plate"), meant to be ``among`` these."""
    linker = _linker(text, scene, (), lexicon)
    linker.naming, linker.among = True, among
    return linker.run()


def _linker(text: str, scene: Scene, focus: tuple[Focus, ...], lexicon: Lexicon) -> _Linker:
    tokens = tokenise(text)
    parser = Parser(text, tokens, things_of(scene, lexicon), lexicon)
    return _Linker(text, tokens, parser.chunks(), scene, focus, lexicon)


class _Linker(Attachment, Asides, Antecedents):
    """One pass over the chunks of a sentence."""

    def run(self) -> Linked:
        at = 0
        while at < len(self.chunks):
            chunk = self.chunks[at]
            if self.chunk_text(at) in _RESETS:
                self.verb = self.said_verb = ""
            if chunk.kind == "verb":
                self.verb, self.region = chunk.value, self.region + 1
                self.said_verb = self.tokens[chunk.first].text
            if chunk.kind == "np" and chunk.phrase is not None:
                at = self._noun_phrase(at, chunk.phrase)
            else:
                if chunk.kind == "pronoun":
                    self._pronoun(at, chunk)
                at += 1
        return Linked(self.text, self.tokens, self.chunks, tuple(without_goals(self.spoken)))

    # --- noun phrases ------------------------------------------------------------

    def _noun_phrase(self, at: int, phrase: Phrase) -> int:
        """Record the mention at chunk ``at``; returns the index of the chunk behind it."""
        picked = self._one_of_group(at, phrase) or self._left_out_of_group(at, phrase)
        if picked is not None:
            return picked
        if phrase.group == "them":
            return self._of_them(at, phrase)
        if self.names_nothing(at, phrase):
            return at + 1
        if (self.verb == "arrange" and self._both_numbers(phrase)) or self._in_mass(phrase):
            phrase = replace(phrase, plural=True)
        links, behind, last = self.links(at, phrase)
        if phrase.det == "whichever" and links:
            phrase = replace(phrase, det="the", first=phrase.opened)
        phrase, links = as_counted(phrase, links, self.lexicon)
        context = self.among_context()
        context = replace(context, standing=context.standing or bool(self.relation_before(at)))
        found = denote(without_nearest(phrase, links), context, links)
        found, behind, last = self._without_denied(found, behind, last, phrase.head)
        found = self._other_again(phrase) or found
        if not found.objects and self.is_shape(at, phrase):
            return at + 1
        if len(found.objects) != 1 and self.points_inside(phrase):
            return at + 1
        if phrase.group == "others" and not self.kind_left(found):
            return at + 1
        objects, broken = self._settled(phrase, found)
        if phrase.plural or (phrase.any_will_do and len(objects) > 1):
            left_out, behind, last = self._exceptions(behind, last, objects)
            objects = tuple(o for o in objects if o not in left_out)
        self._record(phrase, phrase.first, last, objects, found, at, broken)
        return behind

    def _other_again(self, phrase: Phrase) -> Denotation | None:
        """ "If the other mug is red, lift the other mug": the same one both times."""
        for one in reversed(self.spoken if phrase.det == "other" and not phrase.plural else ()):
            past = one.phrase
            alike = past is not None and (past.det, past.head, past.modifiers) == (
                "other", phrase.head, phrase.modifiers
            )  # fmt: skip
            if alike and one.mention.objects and self._in_condition(one):
                return Denotation(one.mention.objects, one.same_type)
        return None

    def _in_condition(self, one: Spoken) -> bool:
        """Whether a mention stands behind "if", "whether", "when"."""
        return any(token.text in _CONDITIONS for token in self.tokens[: one.first])

    def _settled(self, phrase: Phrase, found: Denotation) -> tuple[tuple[str, ...], bool]:
        """ "the apple" or "that one" among several: the one spoken of in this sentence, or the one
        in focus."""
        several = len(found.objects) > 1 and not phrase.plural
        if not several or phrase.det in FREE or phrase.det == "other":
            return found.objects, False
        pointing = phrase.det in ("that", "this")
        if phrase.modifiers or not (phrase.head or pointing) or phrase.origin:
            return found.objects, False
        before = [
            one.mention.objects
            for one in self.spoken
            if settles(one.mention) and one.mention.objects[0] in found.objects
        ]
        if len(set(before)) == 1:
            return before[0], False
        best = clear_best([f for f in self.focus if f.object in found.objects])
        return ((best,), True) if best is not None else (found.objects, False)

    def _record(
        self, phrase: Phrase | None, first: int, last: int, objects: tuple[str, ...],
        found: Denotation, at: int, broken: bool = False, slot: str | None = None,
        plural: bool = False,
    ) -> None:  # fmt: skip
        start, end = self.tokens[first].start, self.tokens[last - 1].end
        if self.text[start:end].lower().endswith(("'s", "’s")):
            whole = any(self.text[start:end].lower() == item.name.lower() for item in self.scene)
            end -= 0 if whole else 2
        text = self.text[start:end]
        if phrase is not None and len(objects) == 1 and phrase.names_one:
            phrase = replace(phrase, plural=False)
        free = self._as_free(slot) if phrase is None else phrase.any_will_do
        plural = plural or (phrase is not None and phrase.plural)
        rest = phrase is not None and phrase.group in ("rest", "others")
        slot = slot or self._slot(text, objects, free, plural, rest)
        mention = Mention(slot, start, end, text, objects, plural, free)
        relation = self.relation_before(at)
        self.spoken.append(
            Spoken(mention, phrase, found.same_type, not relation, relation, self.verb, first, last,
                   broken, self.region)
        )  # fmt: skip

    def _as_free(self, slot: str | None) -> bool:
        """Whether a pronoun stands for what was left open: "take a mug and hold it"."""
        return any(one.mention.slot == slot and one.mention.free for one in self.spoken)

    def _slot(
        self, text: str, objects: tuple[str, ...], free: bool, plural: bool, rest: bool
    ) -> str:
        """The slot of an earlier mention of the same things, or the next one; "the ``rest``" of a
        group of which some were counted off are others than those."""
        for one in self.spoken:
            if rest and counted_off(one):
                continue
            same = one.mention.objects == objects and (objects or one.mention.text == text)
            again = len(objects) == 1 or text.lower() == one.mention.text.lower()
            again = again or (plural and one.mention.plural)
            if same and again and not free:
                return one.mention.slot
        used = {one.mention.slot for one in self.spoken}
        return f"m{len(used) + 1}"

    def _both_numbers(self, phrase: Phrase) -> bool:
        """ "spread out the dice": a plural that also names one of them."""
        word = phrase.head[-1] if phrase.head else ""
        return singular(word) != word and not (phrase.det in FREE or phrase.modifiers)

    def _in_mass(self, phrase: Phrase) -> bool:
        """ "line up the fruit", "put the cutlery in a row": all that there is of it."""
        word = phrase.head[-1] if phrase.head else ""
        if word not in self.lexicon.words("mass") or phrase.det in FREE or phrase.count is not None:
            return False
        behind = self.text[self.tokens[phrase.last - 1].end :]
        said = set(stems(self.said_verb)) & self.lexicon.words("collective")
        return bool(said) or _TOGETHER.match(behind) is not None

    def _one_of_group(self, at: int, phrase: Phrase) -> int | None:
        """ "the shorter of the two white cups": one thing, chosen among those by its size."""
        group = self._group_of(at) if self._only_sized(phrase) else None
        if group is None:
            return None
        kind, behind, last = self._without_denied(
            denote(group, self.context()), at + 3, self.chunks[at + 2].last
        )
        among = kind.objects
        found = denote(phrase, replace(self.context(), among=among, focus=(), named=()))
        if len(among) < 2 or not found.objects:
            return None
        self._record(phrase, phrase.first, last, found.objects, Denotation(found.objects, among),
                     at)  # fmt: skip
        return behind

    def _left_out_of_group(self, at: int, phrase: Phrase) -> int | None:
        """ "All the bolts to the right edge, bar the long one": one of the bolts, by what it alone
        is."""
        marked = at > 0 and self.chunks[at - 1].kind == "except" and not self.chunks[at - 1].value
        marked = marked or (self.chunk_text(at - 1) == "not" and self.chunk_text(at - 2) == ",")
        groups = [one for one in self.spoken if one.mention.plural and one.theme]
        told = phrase.modifiers or (phrase.group == "them" and phrase.count)
        if not marked or len(groups) != 1 or phrase.head or not told:
            return None
        members = groups[0].mention.objects
        link_ = self._link_at(at + 1) if not phrase.modifiers else None
        if phrase.group and (phrase.group != "them" or link_ is None):
            return None
        one = replace(phrase, group="", head=groups[0].phrase.head if groups[0].phrase else ())
        links, behind = ([link_[0]], link_[1]) if link_ is not None else ([], at + 1)
        context = replace(self.context(), among=members, focus=(), named=())
        found = denote(one, context, links)
        if not found.objects:
            return None
        last = self.chunks[behind - 1].last
        self._record(phrase, phrase.first, last, found.objects,
                     Denotation(found.objects, members), at)  # fmt: skip
        return behind

    def _only_sized(self, phrase: Phrase) -> bool:
        sizes = [size_of(word, self.lexicon) for word in phrase.modifiers]
        return bool(sizes) and all(sizes) and not (phrase.head or phrase.group or phrase.plural)

    def _group_of(self, at: int) -> Phrase | None:
        """The group behind "of" that a chunk leads to, if it has a noun."""
        if self.chunk_text(at + 1) not in ("of", "among") or at + 2 >= len(self.chunks):
            return None
        group = self.chunks[at + 2].phrase
        return group if group is not None and group.plural and group.head else None

    def _without_denied(
        self, found: Denotation, behind: int, last: int, head: tuple[str, ...] = ("thing",)
    ) -> tuple[Denotation, int, int]:
        """ "the car that isn't red": without those of which it is not true; "the one that isn't
        red" is of their kind."""
        denies = behind < len(self.chunks) and self.chunks[behind].kind == "except"
        if not denies or self.chunks[behind].value != "not":
            return found, behind, last
        left_out, behind, last = self._exceptions(behind, last, found.same_type)
        kept = tuple(o for o in found.objects if o not in left_out)
        kinds = {t.id: t.head for t in things_of(self.scene, self.lexicon)}
        alike = tuple(o for o in kept if kinds[o] in {kinds[other] for other in left_out})
        return Denotation(kept if head else alike or kept, found.same_type), behind, last

    # --- groups ------------------------------------------------------------

    def _of_them(self, at: int, phrase: Phrase) -> int:
        """ "all of them", "the two", "one of them": of the group last spoken of, else of all."""
        objects, slot = self.group_before()
        if slot is None and (len(self.spoken) >= 2 or (not objects and self.names_more(at))):
            if not self.spoken and self.acted_on(at):
                self._record(None, phrase.first, phrase.last, (), Denotation((), ()), at,
                             plural=True)  # fmt: skip
            return at + 1
        if not objects:
            objects = denote(replace(phrase, group="all"), self.context()).objects
        found = Denotation(objects, objects)
        whole = phrase.plural and phrase.det != "" and (phrase.count or 0) in (0, len(objects))
        left_out, behind, last = self._exceptions(at + 1, phrase.last, objects)
        kept = tuple(o for o in objects if o not in left_out)
        self._record(phrase, phrase.first, last, kept, found, at,
                     slot=slot if whole and kept == objects else None)  # fmt: skip
        return behind

    def _exceptions(self, at: int, last: int, group: tuple[str, ...]) -> tuple[set[str], int, int]:
        """What a group leaves out ("except the red one and the cup"), if that follows at once."""
        left_out: set[str] = set()
        marker = at < len(self.chunks) and (
            self.chunks[at].kind == "except" or self.chunk_text(at) in ("but", "besides")
        )
        behind = at + 1
        denies = marker and self.chunks[at].value == "not"
        while marker and behind < len(self.chunks):
            objects, after, end = self._excepted(behind, group)
            if not objects and not denies:
                break
            left_out |= objects
            last, at = end, after
            marker = self._lists_more(at, denies)
            behind = at + 1
        return left_out, at, last

    def _lists_more(self, at: int, denies: bool) -> bool:
        """Whether a joint leads to more that is left out; what is denied was listed before."""
        if denies:
            return at < len(self.chunks) and self.chunks[at].value == "not"
        return self.chunk_text(at) in ("and", ",", "or")

    def _excepted(self, at: int, group: tuple[str, ...]) -> tuple[set[str], int, int]:
        """Those of the group that the phrase at a chunk may mean, none if it means others; the
        chunk behind it and its last token."""
        chunk = self.chunks[at]
        if chunk.kind == "pronoun" and chunk.value == "it":
            return set(self.antecedent("it", at)[0]) & set(group), at + 1, chunk.last
        if chunk.phrase is None:
            return set(), at + 1, chunk.last
        phrase = chunk.phrase
        sided = self._link_at(at + 1) if phrase.group == "them" and phrase.count else None
        if sided is not None:  # "except the two on the left"
            context = replace(self.context(), among=group, focus=(), named=())
            found = denote(replace(phrase, group=""), context, [sided[0]]).objects
            counted = set(found) if len(found) == phrase.count else set()
            return counted, sided[1], self.chunks[sided[1] - 1].last
        kind = self._group_of(at) if self._only_sized(phrase) else None
        if kind is not None:  # "but not the largest of the blocks"
            among = set(denote(kind, self.context()).objects) & set(group)
            context = replace(self.context(), among=tuple(o for o in group if o in among))
            largest = denote(phrase, context).objects
            return set(largest) if len(largest) == 1 else set(), at + 3, self.chunks[at + 2].last
        links, behind, last = self.links(at, phrase)
        context = replace(self.context(), among=group)
        objects = denote(without_nearest(phrase, links), context, links).objects
        if links and not objects:  # "all but the red one in the box": the box is for the others
            objects, behind, last = denote(phrase, context).objects, at + 1, chunk.last
        if phrase.any_will_do and not phrase.plural:
            objects = objects[:1]
        single = phrase.plural or len(objects) == 1
        return set(objects) if single else set(), behind, last

    # --- pronouns ------------------------------------------------------------

    def _pronoun(self, at: int, chunk: Chunk) -> None:
        """Link "it", and "them" for a group or for things of an earlier sentence."""
        plural = chunk.value == "them"
        if plural:
            objects, slot = self.group_before()
            if slot is None and (self.spoken or (not objects and self.names_more(at))):
                if len([one for one in self.spoken if one.theme]) > 1 or not self.acted_on(at):
                    return
                objects = ()
        else:
            if self.in_choice(at):
                pass  # "the taller of it and the cup": what is chosen from, not what was chosen
            elif self.chosen or (self.spoken and all(one.mention.plural for one in self.spoken)):
                return  # what was chosen is known to the program alone
            objects, slot = self.antecedent(chunk.value, at)
            if not objects and self.means_place(at):
                return
            pointing = self.chunk_text(at) in ("that", "this") and self.chosen
            if pointing or self.means_nothing(at):
                return
            if len(objects) != 1 and self.names_more(at) and not self.acted_on(at):
                return
        found = Denotation(objects, tuple(item.id for item in self.scene))
        plural = plural and not any(
            one.mention.slot == slot and not one.mention.plural for one in self.spoken
        )
        self._record(None, chunk.first, chunk.last, objects, found, at, slot=slot, plural=plural)

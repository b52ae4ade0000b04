"""The deed of a condition's branch, made to stand alone: what it points at in the condition or in
the other branch named, what it leaves out put in. No word of it is turned into another deed.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from clarifier.act import strip_courtesy
from clarifier.ellipsis import Ellipsis
from clarifier.leaving import wants_nothing
from clarifier.mentions import link, link_answer
from clarifier.pieces import Chunk
from clarifier.spoken import Linked, Spoken
from clarifier.words import listing

_LEADING = re.compile(
    r"^[\s,;:.!>-]*(?:(?:then|so|and|just|instead|please you|in that case|"
    r"(?:i want|i'd like|i need|we want)"
    r"(?= (?:the|it|my|them|that|this)\b)|do(?= (?:put|move|push|"
    r"pop|place|take|lift|set|bring|slide|touch))|i want you to|i'd like you to|you should|"
    r"you can|you may|you must|should you|it(?:'s| is) (?:ok|okay|fine) to|"
    r"you(?= [a-z]+ (?:the|it|them|my|both|this|that)\b))\b[\s,:;]*)+",
    re.IGNORECASE,
)
_EM = re.compile(r"(?:'|\b)em\b")
_HIM = re.compile(r"\b(?:him|her(?=\s*(?:$|(?:in|on|to|up|off|over|down|away|there|by|into)\b)))")
_BOTH = re.compile(
    r"\b(?:(?:these|those|the) two(?: of (?:them|these|those)| things| objects)?|"
    r"both(?: of them)?|them both|them|they)(?=\W|$)",
    re.IGNORECASE,
)
_JOINTS = frozenset({"and", "then", ".", ";", ","})


class Branch(NamedTuple):
    """What is said to be done: ``text`` stands alone; None where nothing is to be done."""

    text: str | None


class Deeds(Ellipsis):
    """Completes the deeds of one condition."""

    def alone(self, said: str, other: str | None) -> Branch | None:
        """A branch by itself; ``other`` is the branch before it, as it stands alone. None where
        it is not certain what it points at or leaves out."""
        deed = _LEADING.sub("", said).strip(" ,;:.!")
        deed = re.sub(r"^only (?=\w+ )", "", deed, flags=re.IGNORECASE)
        deed = _HIM.sub("it", _EM.sub("them", deed))
        core = strip_courtesy(deed) or deed
        if wants_nothing(core):
            return Branch(None)
        core = _LEADING.sub("", core).strip(" ,;:.!")
        whole = core if self.is_told(core) else self.completed(core, other)
        if whole is None:
            return None
        whole = self.with_there(whole, other)
        if whole is None:
            return None
        whole = self.with_sides(whole)
        whole = self._with_both(whole, other)
        named = self._with_names(whole, other)
        return None if named is None else Branch(self.with_nouns(named))

    # --- what is pointed at ----------------------------------------------------------------

    def _with_both(self, deed: str, other: str | None) -> str:
        """ "The two of them": the thing that the condition is about and the one it is held to."""
        about, others = self._fact.about, self._fact.others
        pair = (*about, *others) if len(about) == 1 and len(others) == 1 else ()
        said = _BOTH.search(deed)
        if said is not None and len(about) == 2 and re.search(r"both|two", said[0], re.IGNORECASE):
            return f"{deed[: said.start()]}{self._subject()}{deed[said.end() :]}"
        if len(pair) != 2 or said is None:
            return deed
        named = link(deed[: said.start()], self._scene, (), self._lexicon).spoken
        theme, _ = self.theme_of(other)
        bare = said[0].lower() in ("them", "they")
        single = bare and (self._is_called_many() or (theme is not None
                           and not set(theme.mention.objects) & set(pair)))  # fmt: skip
        if single or any(one.phrase is not None for one in named):
            return deed
        text = listing(self.label(one) for one in pair)
        return f"{deed[: said.start()]}{text}{deed[said.end() :]}"

    def _is_called_many(self) -> bool:
        """Whether "them" is one thing: the scissors."""
        name = self._scene.get(self._fact.about[0]).name
        return name.endswith("s") and not name.endswith("ss")

    def _with_names(self, deed: str, other: str | None) -> str | None:
        """The deed with its pronouns named, or None where one of them may mean two things."""
        linked = link(deed, self._scene, (), self._lexicon)
        named: list[tuple[int, int, str]] = []
        first: Chunk | None = None
        for chunk in linked.chunks:
            group = chunk.phrase.group if chunk.phrase is not None else ""
            if chunk.kind != "pronoun" and group != "them":
                text = self._other(chunk, other) or self._same(chunk, linked)
                if text is not None:
                    named.append((chunk.first, chunk.last, text))
                continue
            earlier = [one for one in linked.spoken if one.phrase and one.last <= chunk.first]
            before = [one for one in earlier if one.phrase and one.phrase.group != "them"
                      and self._same_clause(one, chunk, linked)]  # fmt: skip
            apart = first is not None and _JOINTS & {
                token.text for token in linked.tokens[first.last : chunk.first]}  # fmt: skip
            if not before and (earlier or apart):
                continue  # "lift the cup and put it on the plate": the linker's to settle
            text = self._meant(before, first is None, other, linked)
            if text is None:
                return None
            first = first or chunk
            named.append((chunk.first, chunk.last, text))
        whole = linked.text
        for start, end, text in reversed(named):
            a, b = linked.tokens[start].start, linked.tokens[end - 1].end
            lead = whole[a:b].lower()
            kept = next((f"{w} " for w in ("one of", "some of") if lead.startswith(w)), "")
            whole = f"{whole[:a]}{kept}{text}{whole[b:]}"
        return whole

    def _same_clause(self, one: Spoken, chunk: Chunk, linked: Linked) -> bool:
        between = {token.text for token in linked.tokens[one.last : chunk.first]}
        return not between & _JOINTS

    def _meant(
        self, before: Sequence[Spoken], first: bool, other: str | None, linked: Linked
    ) -> str | None:
        about, others = self._fact.about, self._fact.others
        if not before and not first:
            return self.label(others[0]) if len(others) == 1 else None
        if not before:
            theme, past = self.theme_of(other)
            if theme is not None and past is not None and theme.mention.objects != about:
                verbs = [next((c.value for c in one.chunks if c.kind == "verb"), "")
                         for one in (past, linked)]  # fmt: skip
                start = past.tokens[theme.opened].start
                alike = verbs[0] == verbs[1]
                return past.text[start : theme.mention.end] if alike or not about else None
            return self._subject() if about or self._fact.name else None
        theme, past = self.theme_of(other)
        marks = [] if past is None else [one for one in past.spoken if one.relation and one.phrase
                                         and one.mention.objects != about]  # fmt: skip
        apart = not set(before[-1].mention.objects) & set(about)
        if past is not None and len(marks) == 1:  # "on the plate; otherwise put the cup on it"
            start = past.tokens[marks[0].opened].start
            return None if apart and about else past.text[start : marks[0].mention.end]
        if (about or self._fact.name) and apart:
            return self._subject()
        return self.label(others[0]) if len(others) == 1 else None

    def _other(self, chunk: Chunk, other: str | None) -> str | None:
        """ "The other one": of the two that the condition speaks of, the one not yet dealt with."""
        pair = (*self._fact.about, *self._fact.others)
        if chunk.phrase is None or chunk.phrase.det != "other":
            return None
        theme, _ = self.theme_of(other)
        done = theme.mention.objects if theme is not None else self._fact.about
        rest = [one for one in pair if one not in done]
        if len(pair) != 2 or len(rest) != 1 or chunk.phrase.head or chunk.phrase.modifiers:
            return None
        return self.label(rest[0])

    def _same(self, chunk: Chunk, linked: Linked) -> str | None:
        """ "That plate", of several the one that the condition speaks of."""
        phrase = chunk.phrase
        one = next((one for one in linked.spoken if one.phrase is phrase), None)
        if phrase is None or one is None or one.mention.plural or phrase.modifiers:
            return None
        known = {*self._fact.about, *self._fact.others} & set(one.mention.objects)
        several = len(one.mention.objects) > 1 and phrase.det in ("the", "that", "this", "")
        alone = several and one.last == phrase.last and len(known) == 1
        return self.label(known.pop()) if alone else None

    def _subject(self) -> str:
        """What the condition is about, as a phrase that means it alone."""
        about, name = self._fact.about, self._fact.name
        if len(about) == 1:
            said = self.definite(re.sub(r"^(?:an?|any|some|my|our|this|that) ", "", name))
            spoken = link_answer(said, self._scene, self._lexicon).spoken
            alone = len(spoken) == 1 and spoken[0].mention.objects == about
            return said if alone and name not in ("it", "that", "they") else self.label(about[0])
        if name.startswith(("a ", "an ")) or not about:
            return name
        listed = link_answer(f"all {name}", self._scene, self._lexicon).spoken
        if name.startswith("the ") and listed and listed[0].mention.objects == about:
            return f"all {name}"
        listed = link_answer(name, self._scene, self._lexicon).spoken if name else ()
        if name.startswith(("all ", "both ")) and listed and listed[0].mention.objects == about:
            return name
        return listing(self.label(one) for one in about)

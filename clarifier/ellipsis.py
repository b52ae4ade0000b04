"""What a condition's branch leaves out, put in from the condition or from the other branch.

Its verb, what it acts on, a noun, the place that "there" or "the other side" means.
"""

from __future__ import annotations

import re

from clarifier.ask import labels
from clarifier.lexicon import Lexicon
from clarifier.mentions import link, link_answer
from clarifier.named import Fact
from clarifier.pieces import Chunk
from clarifier.spoken import Linked, Spoken
from scene.types import Scene

_THERE = re.compile(r"\b(?:(?:in|on|over|into|onto|up) )?there\b(?! (?:is|are)\b)", re.IGNORECASE)
_GOES = re.compile(
    r"^(?P<what>(?:the |my |a |that |this )?[\w' ]+?) (?:(?:should |must |has to |have to |to |"
    r"can |may |will |shall |is to |are to )?go|goes)(?P<over> over| back)? (?P<where>(?:to|in|on|"
    r"into|onto|next|beside|behind|by|near|under|between|there|left|right|off|at)\b.*)$",
    re.IGNORECASE,
)
_OPPOSITE = {"left": "right", "right": "left", "in front": "behind", "behind": "in front"}
_OTHER_SIDE = re.compile(
    r"\b(?:(?:a?round )?(?:to|on|onto|over to) )(?:the|its) (?:other|opposite|"
    r"far) side(?: of (?P<what>it|them|the (?:\w+ ){0,3}?\w+))?(?=[\s,.!]*$)",
    re.IGNORECASE,
)


class Ellipsis:
    """Completes deeds on one scene, behind the fact that they depend on."""

    def __init__(self, fact: Fact, scene: Scene, lexicon: Lexicon) -> None:
        self._fact = fact
        self._scene = scene
        self._lexicon = lexicon

    def is_told(self, deed: str) -> bool:
        first = deed.split(" ")[0].lower() if deed else ""
        return self._lexicon.verb(first) is not None and first in self._lexicon.base_verbs

    def completed(self, deed: str, other: str | None) -> str | None:
        """A deed without a verb, with that of the other branch; "the red one goes on the plate"
        and "the red one on the plate" are put there."""
        goes = _GOES.match(deed)
        if goes is not None:
            return f"put {self.definite(goes['what'])} {goes['where']}"
        linked = link(deed, self._scene, (), self._lexicon)
        if not linked.chunks:
            return None
        if any(chunk.kind == "verb" and not self._inside(chunk, linked) for chunk in linked.chunks):
            return deed
        first = linked.chunks[0]
        alone = first.kind in ("np", "pronoun")
        whole = alone and linked.spoken and linked.spoken[0].last == len(linked.tokens)
        placed = (
            alone and not whole and any(c.kind in ("relation", "place") for c in linked.chunks[1:])
        )
        if placed:
            return f"put {self.definite(deed)}"
        theme, past = self.theme_of(other)
        if theme is None or past is None:
            return None
        start, end = past.tokens[theme.opened].start, theme.mention.end
        if whole:
            return f"{past.text[:start]}{self.definite(deed)}{past.text[end:]}"
        if alone:
            return None
        marks = [one for one in past.spoken if one.relation and one.phrase is not None]
        if len(marks) == 1:  # "left of the plate ..., otherwise to the right of it"
            mark = past.text[past.tokens[marks[0].opened].start : marks[0].mention.end]
            deed = re.sub(r"\b(?:it|them)\b", mark, deed, count=1)
        return f"{past.text[:end]} {deed}"

    def _inside(self, chunk: Chunk, linked: Linked) -> bool:
        return any(one.first <= chunk.first < one.last for one in linked.spoken)

    def theme_of(self, deed: str | None) -> tuple[Spoken | None, Linked | None]:
        if deed is None:
            return None, None
        linked = link(deed, self._scene, (), self._lexicon)
        return next((one for one in linked.spoken if one.theme), None), linked

    def with_there(self, deed: str, other: str | None) -> str | None:
        """ "There": where the other branch puts its thing, else the place of the condition."""
        if re.search(r"^(?:put|place|drop|pop|stick|set|lay|bung|stack)\b.* (?:in|on)$", deed):
            deed = f"{deed.rpartition(' ')[0]} there"
        if not _THERE.search(deed) or re.search(r"\bthere (?:is|are)\b", deed):
            return deed
        theme, past = self.theme_of(other)
        placed = theme is not None and past is not None and any(
            chunk.kind == "place" or (chunk.kind == "relation" and chunk.first >= theme.last
                                      and any(one.opened == chunk.last for one in past.spoken))
            for chunk in past.chunks)  # fmt: skip
        rest = past.text[theme.mention.end :].strip(" .!") if placed and theme and past else ""
        own = link(deed, self._scene, (), self._lexicon)
        if any(one.relation for one in own.spoken):
            return deed
        if rest and self._fact.where:
            return None
        place = rest or self._fact.where
        pushed = any(chunk.value == "push" for chunk in own.chunks if chunk.kind == "verb")
        if pushed and not rest and not self._fact.others:
            place = re.sub(r"^(?:at|in|on) (?=the\b)", "to ", place)
        return _THERE.sub(lambda _: place, deed, count=1) if place else deed

    def with_sides(self, deed: str) -> str:
        """ "The other side of it" behind "left of the bowl": to the right of the bowl."""
        said, where = _OTHER_SIDE.search(deed), self._fact.where
        side = next((one for one in _OPPOSITE if re.search(rf"\b{one} of\b|^{one}\b", where)), "")
        if said is None or not side or len(self._fact.others) != 1:
            return deed
        mark = self.label(self._fact.others[0])
        if said["what"] not in (None, "it", "them", mark) and not self._means(said["what"], mark):
            return deed
        opposite = _OPPOSITE[side]
        lead = {"left": "to the left of", "right": "to the right of", "behind": "behind",
                "in front": "in front of"}[opposite]  # fmt: skip
        return f"{deed[: said.start()]}{lead} {mark}{deed[said.end() :]}"

    def _means(self, text: str, label: str) -> bool:
        one, other = (link_answer(t, self._scene, self._lexicon).spoken for t in (text, label))
        return bool(one and other) and one[0].mention.objects == other[0].mention.objects

    def label(self, object_id: str) -> str:
        return labels((object_id,), self._scene, self._lexicon)[object_id]

    def definite(self, text: str) -> str:
        led = re.match(r"(?:the|an?|my|our|your|this|that|these|those|all|both|any|each|every|it|"
                       r"them|one|some|two|three)\b", text, re.IGNORECASE)  # fmt: skip
        return text if led is not None else f"the {text}"

    def with_nouns(self, deed: str) -> str:
        """ "The blue one", "the blue", with the noun of what the condition is about."""
        name = self._scene.get(self._fact.about[0]).name if self._fact.about else ""
        name = name or (self._fact.name.split()[-1] if self._fact.name else "")
        head = name.split()[-1] if name else ""
        linked = link(deed, self._scene, (), self._lexicon)
        for one in reversed(linked.spoken):
            phrase = one.phrase
            if phrase is None or phrase.head or phrase.group or not phrase.modifiers or not head:
                continue
            last = linked.tokens[phrase.last - 1]
            bare = last.text in ("one", "ones")
            a, b = linked.tokens[phrase.opened].start, last.start if bare else last.end
            text = f"{linked.text[a:b].strip()} {head}"
            found = link_answer(text, self._scene, self._lexicon).spoken
            if found and found[0].mention.objects:
                deed = f"{deed[:a]}{text}{deed[last.end :]}"
        return deed

"""Answers that say where to, which way or how far."""

from __future__ import annotations

import re
from collections.abc import Sequence

from clarifier.asked import ARTICLES, Answer, Asked, determined
from clarifier.deed import link_deed
from clarifier.mentions import link_answer
from clarifier.roles import Gap, find_gap
from clarifier.spoken import Linked
from clarifier.things import side_of
from clarifier.words import number, words

_HOW_FAR = re.compile(
    r"(?:(?:just|about|by|maybe|say|only) )*(?:(?:(?:a|one|two|half an?|\d+(?:[.,]\d+)?) ?)?"
    r"(?:(?:little|tiny|wee) )?(?:bit|touch|smidge|hair|tad|little|cms?|mms?|centimet\w+|"
    r"millimet\w+|inch\w*|in)|slightly|halfway|half way|all the way)(?: more)? (?=\w)"
)
"""A distance in front of the way: "a bit to the left", "5 cm further back"."""
_ARTICLELESS = re.compile(r"(?:little|tiny|wee|bit|touch|smidge|hair|tad)\b")
_SOMEWHERE = re.compile(r"^(?:(?:maybe|just|anywhere|somewhere|someplace|over|down|up) )+(?=\w+ )")
"""In front of a place that is told."""
_UNTIL = re.compile(r"(?:un)?til (?:it|they) ")


class WhereTo(Asked):
    """Reads places, directions and angles."""

    def _place(self, plain: str, said: Sequence[str]) -> Answer:
        """Free words for a place, a direction or an angle."""
        core = _SOMEWHERE.sub("", " ".join(self._without_choosing(said)))
        linked = link_answer(core, self._scene, self._lexicon)
        if not linked.chunks:
            return Answer("other")
        head = linked.chunks[0]
        first = linked.tokens[0].text
        if head.kind == "relation" and len(linked.chunks) > 1:
            return Answer("words", text=core)
        if until_met(core) and linked.spoken and linked.spoken[-1].mention.objects:
            return Answer("words", text=core)
        far = _HOW_FAR.match(core) if self._kind in ("where", "direction") else None
        if far is not None and self._place(rest := core[far.end() :], words(rest)).kind == "words":
            return Answer("words", text=f"a {core}" if _ARTICLELESS.match(core) else core)
        gap = self._gap() if self._kind == "where" else None
        if gap is not None and (gap.lead or gap.anchor is not None):
            return self._begun(core, linked, gap)
        if head.kind == "relation":
            return Answer("words", text=core)
        if self._kind == "open":
            measured = number(first) is not None or first[:1].isdigit() or first in (
                "a", "half", "quarter", "by", "halfway", "clockwise", "upside", "around"
            )  # fmt: skip
            return Answer("words", text=_by(core)) if measured else self._side(core, linked)
        return self._side(core, linked)

    def _gap(self) -> Gap | None:
        """What the sentence that was asked about lacks."""
        return find_gap(link_deed(self._text, self._scene, (), self._lexicon), self._lexicon)

    def _begun(self, core: str, linked: Linked, gap: Gap) -> Answer:
        """The rest of a place that the sentence begins: "the box" behind "next to", or the side of
        a thing."""
        named = linked.spoken[:1] and linked.spoken[0].mention.objects
        if gap.lead:
            thing = linked.chunks[0].kind in ("np", "pronoun") and named
            place = linked.chunks[0].kind == "place"
            text = f"{gap.lead} {determined(core)}" if thing else with_preposition(core, "where")
            return Answer("words", text=text) if thing or place else Answer("unclear")
        assert gap.anchor is not None
        if linked.spoken:
            return Answer("unclear")
        said = [w for w in words(core) if w not in ARTICLES | {"side", "hand", "of", "it", "one"}]
        fits = [i for i, o in enumerate(self._options) if set(said) <= set(words(o.label))]
        if said and len(fits) == 1:
            return Answer("pick", fits[0])
        side = f"on the {' '.join(said)} side of the {gap.anchor.mention.text}"
        known = len(said) == 1 and side_of(said[0], self._lexicon)
        return Answer("words", text=side) if known else Answer("unclear")

    def _side(self, core: str, linked: Linked) -> Answer:
        """A place without its preposition, a direction, or a thing to put it in or on."""
        head, first = linked.chunks[0], linked.tokens[0].text
        if head.kind == "place":
            return Answer("words", text=with_preposition(core, self._kind))
        if first in self._lexicon.words("directions"):
            return Answer("words", text=core)
        if head.kind == "np" and linked.spoken and linked.spoken[0].mention.objects:
            spoken = linked.spoken[0]
            noun = spoken.phrase.head[-1] if spoken.phrase and spoken.phrase.head else ""
            way = self._lexicon.goes(noun)
            if self._kind == "where" and way is not None and len(linked.spoken) == 1:
                return Answer("words", text=f"{way} {determined(core)}")
            if self._kind == "direction":
                return Answer("words", text=f"towards {determined(core)}")
            return Answer("unclear")
        return Answer("other")


def with_preposition(core: str, kind: str) -> str:
    """A place said without it: "left" -> "to the left" (direction) or "on the left side of the
    table" (place)."""
    said = words(core)
    text = core if said[0] in ("the", "your", "my") else f"the {core}"
    if kind == "direction":
        return f"to {text}"
    if {"corner", "middle", "centre", "center"} & set(said):
        return f"in {text}"
    if set(said) <= {"the", "left", "right"}:
        return f"on {text} side of the table"
    return f"on {text}" if "side" in said or "table" in said else f"at {text}"


def _by(core: str) -> str:
    return (
        core if core.startswith(("by", "a ", "half", "clock", "upside", "around")) else f"by {core}"
    )


def until_met(plain: str) -> bool:
    """Whether an answer says what is to end it: "until it touches the bowl"."""
    return _UNTIL.match(plain) is not None

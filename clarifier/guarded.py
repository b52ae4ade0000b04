"""What depends on what in a sentence: its conditions with their deeds, in order, each answered."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from agent.messages import Focus
from clarifier.act import strip_courtesy
from clarifier.comparing import denied
from clarifier.facts import Facts
from clarifier.if_words import ANSWERS, PLAINLY, answered
from clarifier.lexicon import Lexicon
from clarifier.mentions import link
from clarifier.named import Fact, Things
from clarifier.words import tokenise, words
from scene.types import Scene

_OPINES = re.compile(r"^(?:well,? |so,? )?(?:i|we) (?:think|guess|suppose|reckon|believe|say)"
                     r"(?: that)?[\s,]*$", re.IGNORECASE)  # fmt: skip
_THERE = re.compile(
    r"^(?P<lead>.+?) (?:already |still )?(?:(?:in|on|at|over|up) )?there(?: already| still| yet)?$",
    re.I,
)
_TO = re.compile(r"^(?:in|on)?to (?=the\b)", re.IGNORECASE)
_EMPTY = re.compile(r"\b(?:empty|free|clear|bare|unoccupied|vacant|something|anything|nothing)\b")
_ASKED = re.compile(r"^(?:\w+[\s,]+){0,3}?(?P<what>(?:is|are) .+)$", re.IGNORECASE)
_TOLD_TO_SEE = re.compile(r"^(?:please |kindly |just |now )*(?:check|see|look|tell me|have a look)"
                          r"(?: please| first)?[:,;]? (?=(?:is|are)\b)", re.IGNORECASE)  # fmt: skip
_BEFORE_DEED = frozenset({"please", "kindly", "just", "then", "you", "do", "can", "could", "would",
                          "will", "go", "simply", "so", "don't", "should"})  # fmt: skip
_TELLS = frozenset({"may", "can", "should", "must", "stays", "stay", "goes", "go", "shall", "want",
                    "need", "like", "would"})  # fmt: skip
_PARTS = frozenset({",", ";", ":", ".", "?", "!", "then", "-"})
_FOLK = frozenset({"it", "they", "i", "i'd", "we"})
_TELLS = frozenset({"may", "can", "should", "must", "stays", "stay", "goes", "go", "shall", "want",
                    "need", "like", "would"})  # fmt: skip
_DEED_BEHIND = re.compile(r"^(?P<clause>.+)(?:,\s*(?:and |or |but )?|\s+(?:and|but) )"
                          r"(?P<deed>.+?)$")  # fmt: skip
_JOINED = re.compile(r"(?:[.;!]|\b(?:and|then|also))[\s,]*$", re.IGNORECASE)


class Guard(NamedTuple):
    """A branch: it is to be done where ``holds``; ``fact`` is what its pronouns point at."""

    fact: Fact
    holds: bool | None
    deed: str


class Guarded:
    """Reads the conditions of a sentence on one scene."""

    def __init__(self, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> None:
        self._scene = scene
        self._focus = tuple(focus)
        self._lexicon = lexicon

    def guards(
        self, head: str, marks: Sequence[re.Match[str]], text: str
    ) -> tuple[str, list[Guard]] | None:
        """What is to be done in any case, and the branches; None where one cannot be read."""
        guards: list[Guard] = []
        fact: Fact | None = None
        answers = list(ANSWERS.finditer(head))
        if answers:
            question = head[: answers[0].start()]
            inner = _ASKED.match(question)
            fact = self._fact(question, (), ()) or (
                self._fact(inner["what"], (), ()) if inner is not None else None
            )
            if fact is None:
                return None
            if words(rest := head[answers[0].end() :]):
                guards.append(Guard(fact, fact.holds, rest))
            head = ""
        asked = _ASKED.match(head) if not answers and marks else None
        if asked is not None and (fact := self._fact(asked["what"], (), ())) is not None:
            head = ""
        topic = _named_alone(head, self._scene, self._lexicon) if fact is None else ()
        before = "" if topic or self._says_nothing(head) else head.strip()
        ends = [one.start() for one in marks[1:]] + [len(text)]
        listed = self._listed(before, marks, ends, text) if before else None
        if listed is not None:
            return "", listed
        for mark, end in zip(marks, ends, strict=False):
            content = text[mark.end() : end].strip(" ,;:")
            if mark["other"]:
                if fact is None or not words(content):
                    return None
                holds = _none_of([one.holds for one in guards] or [fact.holds])
                guards.append(Guard(fact, holds, content))
                continue
            suffix = bool(before) and not guards
            read = (self._behind(before, content) if suffix else None) or self._clause(
                content, fact, topic, suffix, ends=suffix or mark["ask"] is not None)  # fmt: skip
            if read is None:
                return None
            fact, holds, deed = read
            topic = ()
            holds = denied(holds) if mark["unless"] else holds
            if mark["ask"]:
                if words(deed):
                    return None
                continue
            if before and not guards and not words(deed):
                deed, before = before, ""
            elif before and not guards and not (mark["lead"] or _JOINED.search(before)):
                return None
            if not words(deed):
                return None
            guards.append(Guard(fact, holds, deed))
        return (before, guards) if guards else None

    def _listed(
        self, before: str, marks: Sequence[re.Match[str]], ends: Sequence[int], text: str
    ) -> list[Guard] | None:
        """ "Push it left if it is red, right if it is blue": each deed before its condition."""
        if len(marks) < 2 or any(mark["cond"] is None for mark in marks):
            return None
        deed, guards, fact = before, list[Guard](), None
        for number, (mark, end) in enumerate(zip(marks, ends, strict=True), 1):
            clause, behind = text[mark.end() : end].strip(" ,;:.!"), ""
            if number < len(marks):
                parts = _DEED_BEHIND.match(clause)
                clause, behind = (parts["clause"], parts["deed"]) if parts is not None else ("", "")
            read = self._behind(before, clause) if fact is None else None
            read = read or self._clause(clause, fact, (), suffix=True, ends=True)
            if read is None or words(read[2]) or not words(deed):
                return None
            fact, holds, _ = read
            guards.append(Guard(fact, holds, deed))
            deed = behind
        return guards

    def _behind(self, deed: str, clause: str) -> tuple[Fact, bool | None, str] | None:
        """ "Push the cup to the edge if it is not there": a clause about what the deed speaks of.
        What is to stand on a plate stands elsewhere as yet: "nothing on it" is of the plate."""
        spoken = link(deed, self._scene, self._focus, self._lexicon).spoken
        themes = [one for one in spoken if one.theme or len(spoken) == 1]
        marks = [one.mention.objects for one in spoken if one.relation]
        if not themes or not {"it", "they", "them", "there", "its"} & set(_with_its(clause)):
            return None
        place = _TO.sub(_at, deed[themes[0].mention.end :].strip(" ,.;!"))
        there = _THERE.match(clause.strip(" ,.;!"))
        said = f"{there['lead']} {place}" if there is not None and place else clause
        fact = self._fact(said, themes[0].mention.objects, marks[0] if len(marks) == 1 else ())
        other = self._fact(said, marks[0], ()) if len(marks) == 1 else None
        if there is None and other is not None and _EMPTY.search(said):
            bears = re.search(r"\b(?:on|in) (?:it|them)(?: already| yet)?$", said.strip(" ,.;!"))
            same = fact is not None and fact.holds is other.holds
            fact = other if bears or same else None
        return (fact, fact.holds, "") if fact is not None else None

    def _says_nothing(self, head: str) -> bool:
        opines = _OPINES.match(head) is not None
        return (
            opines
            or not words(strip_courtesy(head))
            or set(words(head)) <= self._lexicon.words("polite")
        )

    def _clause(
        self, content: str, past: Fact | None, topic: tuple[str, ...], suffix: bool, ends: bool
    ) -> tuple[Fact, bool | None, str] | None:
        """The clause that a branch depends on, and the deed behind it (none where it ends there);
        the longest clause that can be read. ``ends``: whether no deed need follow."""
        plain = PLAINLY.match(content)
        if plain is not None and past is not None:
            return past, past.holds if plain["yes"] else denied(past.holds), content[plain.end() :]
        for at in (len(content), *self._bounds(content)):
            clause, deed = content[:at].strip(" ,;:.!?-"), content[at:]
            if not words(deed) and not ends:
                continue
            if suffix and words(deed) and re.match(r"[\s,;]*(?:and|or|but|then)\b", deed):
                continue
            said = re.sub(r"\s+", " ", clause.lower())
            answer = answered(said, past.negative) if past is not None else None
            begins = _begins(content[:at], deed, self._lexicon)
            if past is not None and answer is not None and begins:
                return past, past.holds if answer else denied(past.holds), deed
            spoken_of = (past.about, past.others, past.kind) if past is not None else (topic, ())
            fact = self._fact(clause, *spoken_of)
            if fact is not None:
                return fact, fact.holds, deed
        return None

    def _fact(
        self, clause: str, it: tuple[str, ...], beside: tuple[str, ...], kind: str = ""
    ) -> Fact | None:  # fmt: skip
        clause = _TOLD_TO_SEE.sub("", clause)
        said = strip_courtesy(clause) or clause
        beside = beside if len(beside) == 1 else ()
        facts = Facts(self._scene, () if it else self._focus, self._lexicon, it, beside, kind)
        found = facts.fact(said) or facts.fact(clause)
        return found or (facts.fact(f"it is {said}") if it else None)

    def _bounds(self, content: str) -> Iterator[int]:
        """Where a deed can begin, the last first: behind a mark or "then", before a verb."""
        tokens = tokenise(content)
        for i in range(len(tokens) - 1, 0, -1):
            text, before = tokens[i].text, tokens[i - 1].text
            behind = tokens[i + 1].text if i + 1 < len(tokens) else ""
            pointed = ">" in content[tokens[i - 1].end : tokens[i].start]
            opens = before in _PARTS or text == "then" or pointed
            verb = text in self._lexicon.base_verbs or (text in _BEFORE_DEED and bool(behind))
            tells = text in _FOLK and behind in _TELLS
            if opens or verb or tells or (i == 1 and before in ("not", "so", "yes")):
                yield tokens[i].start


def _named_alone(text: str, scene: Scene, lexicon: Lexicon) -> tuple[str, ...]:
    """ "The biscuit: if it is ...": the one thing that a text names and nothing besides."""
    said = text.strip(" ,;:.-")
    named = Things(scene, lexicon).named(said) if words(said) else None
    return named.objects if named is not None and len(named.objects) == 1 else ()


def _begins(clause: str, deed: str, lexicon: Lexicon) -> bool:
    """Whether a deed surely begins behind a clause: behind a mark, or with a verb."""
    first = next((word for word in words(deed) if word not in _BEFORE_DEED), "")
    marked = clause.rstrip()[-1:] in ",;:.?!-" or not words(deed)
    named = words(clause)[-1:] in (("not",), ("so",), ("yes",)) or first in _FOLK
    return marked or named or first in lexicon.base_verbs


def _with_its(clause: str) -> list[str]:
    return [part for word in words(clause) for part in word.split("'")]


def _at(said: re.Match[str]) -> str:
    """ "To the left edge" is where one is at."""
    return {"into": "in ", "onto": "on ", "to": "at "}[said.group().strip().lower()]


def _none_of(answers: Sequence[bool | None]) -> bool | None:
    if True in answers:
        return False
    return None if None in answers else True

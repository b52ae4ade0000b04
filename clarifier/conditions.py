"""Conditions come down to one of their branches: the scene answers what they depend on.

"If the jug is taller than the vase, put it behind the vase; if not, in front", "is the bolt near
the vice? then push it left", "touch the cup unless it is red". `facts` tells whether the
condition is so, by the same reading that answers the person's questions; only the deed of the
branch that holds is left to be understood. What cannot be read to its last word stays as it was
said.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from agent.messages import Focus
from clarifier.act import strip_courtesy
from clarifier.comparing import denied
from clarifier.deeds import Deeds
from clarifier.facts import Facts
from clarifier.if_words import ANSWERS, OTHERWISE_LAST, PLAINLY, answered, marks_of
from clarifier.lexicon import Lexicon
from clarifier.mentions import link
from clarifier.named import Fact, Things
from clarifier.passing import without_asides_said
from clarifier.words import tokenise, words
from scene.types import Scene

_OPINES = re.compile(r"^(?:well,? |so,? )?(?:i|we) (?:think|guess|suppose|reckon|believe|say)"
                     r"(?: that)?[\s,]*$", re.IGNORECASE)  # fmt: skip
_THERE = re.compile(r"^(?P<lead>.+?) (?:already |still )?there(?: already| still| yet)?$", re.I)
_TO = re.compile(r"^(?:in|on)?to (?=the\b)", re.IGNORECASE)
_EMPTY = re.compile(r"\b(?:empty|free|clear|bare|unoccupied|vacant|something|anything|nothing)\b")
_ASKED = re.compile(r"^(?:\w+[\s,]+){0,3}?(?P<what>(?:is|are) .+)$", re.IGNORECASE)
_TOLD_TO_SEE = re.compile(r"^(?:please |kindly |just |now )*(?:check|see|look|tell me|have a look)"
                          r"(?: please| first)?[:,;]? (?=(?:is|are)\b)", re.IGNORECASE)  # fmt: skip
_SPEAKS_ON = re.compile(r"[.;!?]\s+\S")
_BEFORE_DEED = frozenset({"please", "kindly", "just", "then", "you", "do", "can", "could", "would",
                          "will", "go", "simply", "so", "don't"})  # fmt: skip
_TELLS = frozenset({"may", "can", "should", "must", "stays", "stay", "goes", "go", "shall", "want",
                    "need", "like", "would"})  # fmt: skip
_PARTS = frozenset({",", ";", ":", ".", "?", "!", "then", "-"})
_FOLK = frozenset({"it", "they", "i", "i'd", "we"})
_TELLS = frozenset({"may", "can", "should", "must", "stays", "stay", "goes", "go", "shall", "want",
                    "need", "like", "would"})  # fmt: skip
_JOINED = re.compile(r"(?:[.;!]|\b(?:and|then|also))[\s,]*$", re.IGNORECASE)


class Settled(NamedTuple):
    """``text``: what is left to be done, None for nothing; ``note``: what was seen. ``unsure``:
    what is to be done is not certain, and ``note`` says why."""

    text: str | None
    note: str = ""
    unsure: bool = False


class _Guard(NamedTuple):
    """A branch: it is to be done where ``holds``; ``fact`` is what its pronouns point at."""

    fact: Fact
    holds: bool | None
    deed: str


def settled(text: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> Settled | None:
    """What a condition comes down to on the scene; None where the sentence is none that is read."""
    said = text.replace("’", "'").strip()
    last = OTHERWISE_LAST.match(said)
    said = f"{last['one']}, otherwise {last['other']}" if last is not None else said
    conditional = _Conditional(scene, focus, lexicon)
    names = [item.name for item in scene]
    plain = without_asides_said(said, names)
    return conditional.settle(said) or (conditional.settle(plain) if plain != said else None)


class _Conditional:
    def __init__(self, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> None:
        self._scene = scene
        self._focus = tuple(focus)
        self._lexicon = lexicon

    def settle(self, text: str) -> Settled | None:
        marks = marks_of(text)
        head = text[: marks[0].start()] if marks else text
        if not marks and not ANSWERS.search(text.rstrip(" ?!.")):
            return None
        found = self._guards(head, marks, text)
        if found is None:
            return None
        before, guards = found
        return self._chosen(before, guards)

    # --- what depends on what ----------------------------------------------------------------

    def _guards(
        self, head: str, marks: Sequence[re.Match[str]], text: str
    ) -> tuple[str, list[_Guard]] | None:
        """What is to be done in any case, and the branches; None where one cannot be read."""
        guards: list[_Guard] = []
        fact: Fact | None = None
        answers = list(ANSWERS.finditer(head))
        if answers:
            fact = self._fact(head[: answers[0].start()], (), ())
            if fact is None:
                return None
            if words(rest := head[answers[0].end() :]):
                guards.append(_Guard(fact, fact.holds, rest))
            head = ""
        asked = _ASKED.match(head) if not answers and marks else None
        if asked is not None and (fact := self._fact(asked["what"], (), ())) is not None:
            head = ""
        topic = _named_alone(head, self._scene, self._lexicon) if fact is None else ()
        before = "" if topic or self._says_nothing(head) else head.strip()
        ends = [one.start() for one in marks[1:]] + [len(text)]
        for mark, end in zip(marks, ends, strict=False):
            content = text[mark.end() : end].strip(" ,;:")
            if mark["other"]:
                if fact is None or not words(content):
                    return None
                holds = _none_of([one.holds for one in guards] or [fact.holds])
                guards.append(_Guard(fact, holds, content))
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
            guards.append(_Guard(fact, holds, deed))
        return (before, guards) if guards else None

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
            if past is not None and answer is not None:
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

    # --- the branch that holds ---------------------------------------------------------------

    def _chosen(self, before: str, guards: Sequence[_Guard]) -> Settled | None:
        told: list[str] = [before.rstrip(" ,.;")] if before else []
        told = [re.sub(r"[\s,]+(?:and|then|also)$", "", one) for one in told]
        if any(guard.holds is None for guard in guards):
            unsure = next(guard for guard in guards if guard.holds is None)
            return Settled(None, f"I can't tell clearly {_whether(unsure.fact)}.", unsure=True)
        done: list[_Guard] = []
        other: str | None = None
        for guard in guards:
            branch = Deeds(guard.fact, self._scene, self._lexicon).alone(guard.deed, other)
            if branch is None and guard.holds:
                return _unclear(guard)
            other = (branch.text if branch is not None else None) or other
            last = guard is guards[-1]
            if not guard.holds and last and _SPEAKS_ON.search(strip_courtesy(guard.deed)):
                return _unclear(guard)  # what comes last may be meant in any case
            if self._disturbed(guard, told if guard.holds else told[: bool(before)]):
                return _unclear(guard)
            if not guard.holds or branch is None:
                continue
            done.append(guard)
            if branch.text is not None:
                told.append(branch.text)
        note = next((guard.fact.said for guard in (*done, *guards)), "")
        return Settled(", and then ".join(told) if told else None, note)

    def _disturbed(self, guard: _Guard, told: Sequence[str]) -> bool:
        """Whether what is done before can change what the branch depends on."""
        moved = {
            object_id
            for deed in told
            for one in link(deed, self._scene, (), self._lexicon).spoken
            for object_id in one.mention.objects
        }
        return bool(moved & {*guard.fact.about, *guard.fact.others})


def _named_alone(text: str, scene: Scene, lexicon: Lexicon) -> tuple[str, ...]:
    """ "The biscuit: if it is ...": the one thing that a text names and nothing besides."""
    said = text.strip(" ,;:.-")
    named = Things(scene, lexicon).named(said) if words(said) else None
    return named.objects if named is not None and len(named.objects) == 1 else ()


def _whether(fact: Fact) -> str:
    return f"whether {fact.said[0].lower()}{fact.said[1:].rstrip('.')}"


def _unclear(guard: _Guard) -> Settled:
    """A condition that is read, and a sentence of which it is not certain what depends on it."""
    return Settled(None, f"I'm not sure what depends on {_whether(guard.fact)}.", unsure=True)


def _with_its(clause: str) -> list[str]:
    return [part for word in words(clause) for part in word.split("'")]


def _at(said: re.Match[str]) -> str:
    """ "To the left edge" is where one is at."""
    return {"into": "in ", "onto": "on ", "to": "at "}[said.group().strip().lower()]


def _none_of(answers: Sequence[bool | None]) -> bool | None:
    if True in answers:
        return False
    return None if None in answers else True

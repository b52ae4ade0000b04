"""Conditions on what is there: "if there is a lemon, put it in the bowl; otherwise the lime".

Whether it is there is seen on the scene, so the sentence comes down to one of its branches, with
what it points at ("it", "in there") put in from the other.
"""

from __future__ import annotations

import re
from itertools import pairwise
from typing import NamedTuple

from clarifier.lexicon import Lexicon
from clarifier.mentions import link_answer
from clarifier.words import article, plural, singular
from scene.types import Scene

_IF = re.compile(
    r"^(?:if|in case|should) (?:there(?:'s| is| are| be)|you (?:can |do )?(?:see|find|"
    r"spot|have)|you(?:'ve| have) got|(?:i|we)(?:'ve| have)(?: got)?) "
    r"(?P<det>an?|any|some|one|another) (?P<rest>.+)$",
    re.IGNORECASE,
)
_PARTS = re.compile(r"^(?P<what>[^,;:.]+?)(?:\s*[,;:]\s*(?:then )?|\s+then\s+)(?P<do>.+)$", re.I)
_ELSE = re.compile(
    r"[\s,;.]+(?:and |but )?(?:otherwise|or else|else|if (?:not|none)|if there(?:'s| is| are)"
    r"(?:n't| not|n't any| no(?:ne| such thing)?)(?: one| any)?|failing that)\b[\s,:]*(?:then )?",
    re.IGNORECASE,
)
_ABOUT = re.compile(
    r" (?:on the table|on the desk|here|there|around|anywhere|left|somewhere|lying about)$", re.I
)
_PRONOUN = re.compile(r"\b(?:it|them|that one|this one|one of them|the thing|one)\b", re.IGNORECASE)
_PLACE = re.compile(
    r"\b(?:in|into|inside|on|onto|on top of|next to|beside|behind|in front of|(?:to the )?left of|"
    r"(?:to the )?right of|under|near|by|between) (?:the|my|your|a|an|that|this) [^,;.]+?[\s.!]*$",
    re.IGNORECASE,
)
_THERE = re.compile(r"\b(?:(?:in|on|over|into|onto|up) )?there\b|\b(?:in|on)(?=[\s.!]*$)", re.I)
_OBJECTS = frozenset({"it", "them", "that", "this", "the", "one", "all", "both", "my"})
"""What may stand behind the verb of a branch."""
_NOTHING = re.compile(
    r"^(?:do nothing|leave (?:it|everything|them|things)|don't|nothing|never mind|forget it)\b",
    re.I,
)


class Settled(NamedTuple):
    """``text``: what is left to be done, None for nothing; ``note``: what was seen."""

    text: str | None
    note: str = ""


def settled_by_presence(text: str, scene: Scene, lexicon: Lexicon) -> Settled | None:
    """The branch that holds on the scene; None where the sentence is no such condition."""
    said = _IF.match(text.strip())
    whole, other = _branches(said["rest"]) if said is not None else ("", "")
    split = _split(whole, lexicon)
    if said is None or split is None:
        return None
    what, do = split
    named = link_answer(f"the {what}", scene, lexicon).spoken
    if not named or named[0].relation or not do:
        return None
    found = named[0].mention.objects
    if found:
        return Settled(_PRONOUN.sub(_thing(said["det"], what, len(found)), do, count=1))
    absent = f"There is no {_one(what)}."
    if not other or _NOTHING.match(other):
        return Settled(None, absent)
    return Settled(_in_full(other, do, lexicon), absent)


def _split(rest: str, lexicon: Lexicon) -> tuple[str, str] | None:
    """What is to be there, and what is to be done: parted by a comma, "then" or a verb."""
    parts = _PARTS.match(rest)
    said = (parts["what"] if parts is not None else rest).split()
    for at, (word, after) in enumerate(pairwise(said[1:]), 1):
        if lexicon.verb(word.lower()) is not None and after.lower() in _OBJECTS:
            at = len(" ".join(said[:at])) + 1
            return _ABOUT.sub("", rest[: at - 1]), rest[at:]
    if parts is None:
        return None
    return _ABOUT.sub("", parts["what"].strip()), parts["do"].strip()


def _branches(deed: str) -> tuple[str, str]:
    found = _ELSE.search(deed)
    if found is None:
        return deed.strip(" .!"), ""
    return deed[: found.start()].strip(" .!"), deed[found.end() :].strip(" .!")


def _thing(det: str, what: str, count: int) -> str:
    """What "it" stands for: "the green block", one of several, or all of them."""
    if det.lower() in ("any", "some") and plural(singular(what.split()[-1])) == what.split()[-1]:
        return f"all the {what}" if count > 1 else f"the {_one(what)}"
    return f"the {what}" if count == 1 else article(what)


def _one(what: str) -> str:
    first, _, last = what.rpartition(" ")
    return f"{first} {singular(last)}".strip()


def _in_full(other: str, do: str, lexicon: Lexicon) -> str:
    """The other branch, with the verb and the place of the first where it leaves them out."""
    first = other.split()[0].lower()
    if lexicon.verb(first) is None or first in ("the", "a", "an", "my"):
        return _PRONOUN.sub(other, do, count=1)
    place = _PLACE.search(do)
    if place is None or _PLACE.search(other):
        return other
    return _THERE.sub(place[0].strip(" .!"), other, count=1)

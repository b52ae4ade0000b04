"""One thing told twice: "the black thing, that little clip", "the blue jar, the one next to the
box". Where the first may be several and only one of them is also the second, it is that one. And
the other one of a pair, told by the one: "its twin".
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from agent.messages import Focus
from clarifier.ask import labels
from clarifier.frame import frame
from clarifier.lexicon import Lexicon
from clarifier.mentions import link
from clarifier.spoken import Spoken, settles
from clarifier.things import things_of
from scene.types import Scene

_TWICE = re.compile(
    r"(?P<first>#\d+)(?: [,(-])+(?: (?:yeah|yes|i mean|that is|that's|you know|so|namely|well|uh|"
    r"um))* (?P<second>#\d+)(?= (?:[,.;:!?)]|please|and (?!#)|goes|"
    r"should|must|needs|wants|belongs)| ?$)"
)
_POINTING = frozenset({"the", "that", "this", "my"})

_FELLOW = re.compile(
    r"\b(?:its|his|her) (?:\w+ )??(?:companion|twin|mate|counterpart|sibling|brother|sister|fellow|"
    r"double|opposite number|other half)\b(?!'s?\b)",
    re.IGNORECASE,
)
"""The other one of a pair, told by the one."""


def told_once(text: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> str:
    """The sentence with the one thing that both tell in the place of the two; else as it was."""
    text = _fellow_named(text, scene, focus, lexicon)
    linked = link(text, scene, focus, lexicon)
    shape = frame(linked)
    for said in _TWICE.finditer(shape.text):
        (first,), (second,) = shape.among(said["first"]), shape.among(said["second"])
        both = [o for o in first.mention.objects if o in second.mention.objects]
        if len(both) != 1 or not _is_open(first) or not _points(second):
            continue
        name = labels(both, scene, lexicon)[both[0]]
        start, end = linked.tokens[first.opened].start, second.mention.end
        return f"{text[:start]}{name}{text[end:]}" if linked.text == text else text
    return text


def _fellow_named(text: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> str:
    """ "Leave the red mug; its twin goes left": the other mug, where there are two."""
    said = _FELLOW.search(text)
    before = link(text[: said.start()], scene, focus, lexicon).spoken if said is not None else ()
    named = [one for one in before if one.phrase is not None and settles(one.mention)]
    if said is None or not named:
        return text
    kind = {t.id: t.head for t in things_of(scene, lexicon)}
    one = named[-1].mention.objects[0]
    others = [other for other in kind if other != one and kind[other] == kind[one]]
    if len(others) != 1:
        return text
    name = labels(others, scene, lexicon)[others[0]]
    return f"{text[: said.start()]}{name}{text[said.end() :]}"


def _is_open(one: Spoken) -> bool:
    """Whether a mention is to be one thing and may be any of several."""
    return len(one.mention.objects) > 1 and not one.mention.plural and not one.mention.free


def _points(one: Spoken) -> bool:
    """ "That little clip", "the one next to the box"."""
    phrase = one.phrase
    return phrase is not None and phrase.det in _POINTING and not one.mention.plural

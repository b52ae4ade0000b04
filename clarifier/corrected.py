"""A sentence that takes itself back: "push the cup to the left, no wait, push it to the right".

Only what is said last holds. The deed before the correction is cut, and what it was to be done to
is named where the new one says "it"; of "... towards the box, no wait, towards the bowl" the place.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from agent.messages import Focus
from clarifier.lexicon import Lexicon
from clarifier.mentions import link
from clarifier.words import words
from scene.types import Scene

_SAYS_SO = (
    r"(?:no,? (?:no,? )?(?:wait|hold on|hang on|sorry|actually|scratch that|scrap that)"
    r"(?: a (?:second|sec|minute|moment))?|(?:oh,? )?(?:wait|hold on|hang on)(?: a \w+)?,? no|"
    r"actually,? no|sorry,? no|(?:no,? )?on second thoughts?|(?:scratch|scrap|strike|forget) that|"
    r"correction|i take that back|changed my mind)"
)
_CORRECTS = re.compile(
    r"[\s,.;:…–-]+(?:and |but )?(?:(?:oh|uh|um|er|erm|hmm|argh|oops|whoops),? )*"
    rf"{_SAYS_SO}"
    r"[\s,.;:…!–-]+(?:(?:just|rather|instead|better|please|actually|only|you should|i meant|i mean|"
    r"i want you to|let's),? )*(?P<new>\S.*)$",
    re.IGNORECASE | re.DOTALL,
)
_NEXT_DEED = re.compile(r"(?:\b(?:and then|then|and|before that)|[;.])\s+(?=(?P<verb>\w+))", re.I)
_IT = re.compile(r"\b(?:it|them|that|this)\b", re.IGNORECASE)
_LEADS = re.compile(
    r"(?:(?:(?:to|on) the )?(?:left|right) of|in front of|next to|away from|(?:in)?to|towards?|"
    r"on(?:to)?|in|at|by|near|beside|behind|between|under|above)\b",
    re.IGNORECASE,
)
"""What a correction of the place alone opens with."""


def corrected(text: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> str:
    """The sentence without the deed that its own correction takes back. Pure."""
    said = _CORRECTS.search(text)
    if said is None:
        return text
    before = text[: said.start()]
    if _LEADS.match(said["new"]):
        whole = _elsewhere(before, said["new"])
        return text if whole is None else corrected(whole, scene, focus, lexicon)
    if not _opens_with_deed(said["new"], lexicon):
        return text
    deeds = [one for one in _NEXT_DEED.finditer(before) if lexicon.verb(one["verb"].lower())]
    kept = before[: deeds[-1].start()].rstrip(" ,") if deeds else ""
    new = corrected(said["new"], scene, focus, lexicon)
    if not kept and _IT.search(new):
        linked = link(before, scene, focus, lexicon)
        theme = next((one for one in linked.spoken if one.theme and one.phrase), None)
        if theme is not None:
            named = linked.text[linked.tokens[theme.opened].start : theme.mention.end]
            new = _IT.sub(lambda _: named, new, count=1)
    return f"{kept}, then {new}" if kept else new


def _elsewhere(before: str, new: str) -> str | None:
    """The deed with its last place told anew; None where it has none."""
    places = list(re.finditer(rf"(?<= ){_LEADS.pattern}", before, re.IGNORECASE))
    return f"{before[: places[-1].start()]}{new}" if places else None


def _opens_with_deed(text: str, lexicon: Lexicon) -> bool:
    first = next(iter(words(text)), "")
    return lexicon.verb(first) is not None

"""What is said behind a noun and counts, lists or leaves open what it speaks of: "the boats, all
three", "shallots, both, into the bowl", "red blue green" without commas, "..., you choose".
"""

from __future__ import annotations

import re

from clarifier.lexicon import Lexicon
from clarifier.spoken import Linked, ambiguous
from clarifier.things import things_of
from clarifier.words import plural, singular
from scene.kinds import COLORS
from scene.types import Scene

_NUMBER = r"(?:two|three|four|five|six|seven|eight|\d)"
_THE = r"(?:the|those|these|my|your|our) "
_GOES = r"(?:,|[.;:!]| (?:go|goes|into|onto|in|on|to|over|um|uh)\b)"
_COUNTED = re.compile(
    rf"(?P<before>^|[,;:.!?]\s*|\b{_THE})(?P<noun>(?!{_THE})(?:\w+ )?\w+s),? (?:u[mh],? )?"
    rf"(?P<all>both|all {_NUMBER})(?: of (?:them|these|those))?(?={_GOES})",
    re.IGNORECASE,
)
_PIECES = re.compile(rf"\b(?P<noun>[a-z]+) (?P<many>{_NUMBER}) pieces\b(?! of\b)", re.IGNORECASE)
_COLOUR = "|".join(sorted(COLORS))
_RUN = re.compile(rf"\b(?:{_COLOUR})(?: (?:{_COLOUR})){{2,}}\b(?! \w+s\b)", re.IGNORECASE)
_NOT_CARING = (
    r"(?:it |that )?(?:really )?(?:doesn't|does not|don't|do not|doesnt|dont) (?:really )?"
    r"(?:matter|mind|care)(?: to me)?(?: (?:which|at all)(?: ones?)?)?"
)
_WILL_DO = r"(?:any|either) (?:one |of them )?will do|no matter which(?: one)?"
_YOURS = (
    r"(?:whichever|which one) (?:one )?you (?:like|want|prefer|please|fancy)|your choice|your pick|"
    r"(?:you (?:can )?|please )(?:choose|pick|decide)(?: (?:one|which|for me))?|up to you"
)
_OPEN = re.compile(
    rf"\s*[,;.!-]*\s*\(?\b(?:{_NOT_CARING}|{_WILL_DO}|{_YOURS})\)?(?=\s*[,;.!)]|\s*$)",
    re.IGNORECASE,
)
_DEFINITE = frozenset({"the", "that", "this", "my", "your", "our", ""})


def counted_before(text: str, scene: Scene, lexicon: Lexicon) -> str:
    """The sentence with "all three boats" for "the boats all three", and commas in a run of
    colours."""
    named = {word for thing in things_of(scene, lexicon) for word in thing.name}

    def is_thing(noun: str) -> bool:
        return singular(noun) in named or lexicon.is_noun(noun)

    def in_front(said: re.Match[str]) -> str:
        if not is_thing(said["noun"].split()[-1].lower()):
            return said[0]
        before = "" if said["before"].strip()[-1:].isalpha() else said["before"]
        return f"{before}{said['all']} {said['noun']}"

    def as_pieces(said: re.Match[str]) -> str:
        """ "Coin three pieces" of speakers whose nouns have no plural: "three coins"."""
        noun = said["noun"].lower()
        return f"{said['many']} {plural(singular(noun))}" if is_thing(noun) else said[0]

    text = _COUNTED.sub(in_front, text)
    text = _PIECES.sub(as_pieces, text)
    return _RUN.sub(_listed, text)


def _listed(run: re.Match[str]) -> str:
    """The colours of a run, one by one; an orange that may be a fruit is "the orange one"."""
    colours = run[0].split()
    if "orange" in run[0].lower():
        colours = [f"the {colour} one" for colour in colours]
    return ", ".join(colours)


def left_open(linked: Linked) -> str | None:
    """The sentence with "any brick" for "the brick" where it says that it does not matter which,
    and there is one thing that this can be said of; None elsewhere."""
    text = _OPEN.sub("", linked.text)
    open_ = [one for one in linked.spoken if ambiguous(one)]
    if text == linked.text or len(open_) != 1:
        return None
    (one,) = open_
    phrase = one.phrase
    if phrase is None or phrase.plural or phrase.det not in _DEFINITE or one.last <= one.first:
        return None
    opened, start = linked.tokens[one.opened].start, linked.tokens[phrase.first].start
    said = linked.text[opened:start].split()
    counted = linked.tokens[one.opened - 1].text if one.opened else ""
    opened = linked.tokens[one.opened - 1].start if counted == "one" else opened
    whole = f"{linked.text[:opened]}any {linked.text[start:]}"
    return None if "no" in said else _OPEN.sub("", whole)

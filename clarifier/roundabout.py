"""Which one is meant, told in a roundabout way: "the jar that is the smaller of the two", "the one
which is standing most close to me", "all what is screw". Put in the words that the rest reads.

Also what depends on something in more words than "if": "in the event that".
"""

from __future__ import annotations

import re

from clarifier.lexicon import Lexicon
from clarifier.things import is_attribute
from clarifier.words import plural, singular
from scene.kinds import COLORS

_SMALLER = re.compile(
    r"\b(?:the|that|this) (?P<noun>\w+(?: \w+)?),? (?:that|which) is the (?P<size>\w+er|(?:more|"
    r"less) \w+) (?:one )?of (?:the (?:two|pair)|both)(?: of them)?\b",
    re.IGNORECASE,
)
_POSTURE = re.compile(
    r"\b(that|which)(?:'s| is| are) (?:standing|staying|sitting|lying|being|placed|located|"
    r"situated|positioned|found|parked|resting|put)(?: \w+ly)? (?=(?:the )?(?:nearest|closest|"
    r"furthest|farthest|most)\b)",
    re.IGNORECASE,
)
_MOST = re.compile(
    r"\b(?P<lead>the|one|ones|is|are|stands|sits|lies) most (?P<size>close|near|far|tall|small|big|"
    r"short|long|wide|thick|thin|large|low|high)\b",
    re.IGNORECASE,
)
_ALL_WHAT = re.compile(
    r"\b(?:all|everything) (?:what|that|which)(?:'s| is| are)(?: an?)? (?P<noun>[a-z]+)\b",
    re.IGNORECASE,
)
_BAR = re.compile(
    r"\b(?P<all>(?:every|each)(?: \w+){1,2}|everything|(?:all|both)(?: of)?(?: (?:the|my|these|"
    r"those|your))?(?: \w+)?(?: \w+s)) bar (?=(?:the|my|that|this|those|these|your) )",
    re.IGNORECASE,
)
_IN_CASE = re.compile(
    r"(?P<lead>^|[.;,!]\s+)(?:only )?in (?:the )?(?:case|event)(?:,? and (?:only|solely) in (?:the|"
    r"that) (?:case|event),?)? that (?!(?:is|has|was|are)\b)",
    re.IGNORECASE,
)
_CASE_NOT = re.compile(
    r"(?P<lead>[.;,!]\s+)in (?:the )?case (?:of not|that (?:it is|it's) not|it (?:is|should be) "
    r"not)(?: being)? (?P<what>\w+)",
    re.IGNORECASE,
)
_THAN_NOW = re.compile(
    r"\b(?P<more>farther|further|closer|nearer)(?P<where>(?: (?!than\b)\w+){0,4}) than (?:it|they|"
    r"he|she)(?: now| currently| presently)? (?:stands?|is|are|lies|lie|sits?)(?: now| right now|"
    r"| at present| at the moment| currently)?(?=\s*(?:[,.;!?]|$))",
    re.IGNORECASE,
)
_OTHERS = (
    r"(?P<side>left|right) of (?:all )?(?:the (?:other|remaining)(?: two| three| four)?(?: ones?)?|"
    r"the others)"
)
_BESIDE_THEM = re.compile(
    rf"^(?:the |my |that )?(?P<noun>\w+) (?:to the |on the )?{_OTHERS}(?=,\s*(?:please |just )?"
    r"\w+(?: \w+)? (?:it|that|this|him|her)\b|"
    r",? (?:goes|should|must|needs|belongs|wants|has to|is to)\b)|"
    r"\b(?:the|my|that) (?P<told>\w+)(?:,)? (?:that|which)(?:'s| is) (?:to the |on the )?"
    rf"{_OTHERS.replace('<side>', '<whose>')}\b",
    re.IGNORECASE,
)
_COLOUR = "|".join(sorted(COLORS))
_NONE_OF = re.compile(
    rf"^(?P<no>(?:(?:and |nor )?not (?:the )?(?:{_COLOUR})(?: one)?[\s,;]+){{2,}})(?:but )?"
    r"(?:[-–—:]\s*)?(?:the )?(?:remaining|other|last) (?P<noun>\w+)\b",
    re.IGNORECASE,
)
_STEMS = {"far": "farth", "big": "bigg", "thin": "thinn"}


def told_outright(text: str, lexicon: Lexicon) -> str:
    """The sentence with roundabout ways of telling which one is meant in plainer words."""
    text = _POSTURE.sub(r"\1 is ", text)
    text = _BESIDE_THEM.sub(_utmost, text)
    text = _NONE_OF.sub(_none_of, text)
    text = _SMALLER.sub(r"the \g<size> \g<noun>", text)
    text = _MOST.sub(_graded, text)
    text = _ALL_WHAT.sub(lambda said: _all_of(said, lexicon), text)
    text = _BAR.sub(r"\g<all> except ", text)
    text = _IN_CASE.sub(r"\g<lead>if ", text)
    text = _CASE_NOT.sub(r"\g<lead>if it is not \g<what>", text)
    return _THAN_NOW.sub(r"\g<more>\g<where>", text)


def _utmost(said: re.Match[str]) -> str:
    """ "The jar that is left of the other two": the leftmost jar."""
    return f"the {said['side'] or said['whose']}most {said['noun'] or said['told']}"


def _none_of(said: re.Match[str]) -> str:
    """ "Not the red, not the blue, the remaining jar": the jar that is not red or blue."""
    colours = re.findall(rf"\b(?:{_COLOUR})\b", said["no"].lower())
    return f"the {said['noun']} that is not {' or '.join(colours)}"


def _graded(said: re.Match[str]) -> str:
    """ "The most near" as "the nearest"."""
    stem = said["size"].lower()
    return f"{said['lead']} {_STEMS.get(stem, stem.removesuffix('e'))}est"


def _all_of(said: re.Match[str], lexicon: Lexicon) -> str:
    """ "All what is screw": all the screws; what is red, or of wood, stays as it is."""
    noun = singular(said["noun"].lower())
    quality = is_attribute(noun, lexicon) or noun in lexicon.colors or lexicon.material(noun)[0]
    if quality or not lexicon.is_noun(noun) or noun in lexicon.abstract | lexicon.place_heads:
        return said.group()
    return f"all the {plural(noun)}"

"""How people say the figure that things are to form, put into one way to say it: "make a plus sign
in the middle: the red block is its middle, the blue ones are the arms", "Square from the four discs
around the table centre, side length 12 cm" ("put ... in a cross around the red block in the middle
of the table", "put ... in a square with sides of 12 cm ...").

Only where every word is the figure, what it is made of, its place, its size, its tip, or talk.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from agent.messages import Focus
from clarifier.frame import Frame, frame
from clarifier.lexicon import Lexicon
from clarifier.mentions import link
from clarifier.spoken import Linked, Spoken, settles
from scene.types import Scene

_FIGURES = {
    "v": "V", "l": "L", "plus": "cross", "cross": "cross", "diamond": "diamond",
    "rhombus": "diamond", "lozenge": "diamond", "square": "square", "triangle": "triangle",
    "circle": "circle", "zigzag": "zigzag row", "zig-zag": "zigzag row",
}  # fmt: skip
_LIKE = r"(?:(?:nice|neat|big|small|little|proper|tidy|perfect|regular|even|good|large) )*"
_NAME = (
    rf"(?:capital |letter )*(?P<figure>{'|'.join(_FIGURES)})"
    r"(?: (?:sign|shape|formation|row|pattern))?(?: shape)?"
)
_BARE = _NAME.replace("<figure>", "<bare>")
_FIGURE = re.compile(
    r"\b(?:(?:in|into|as|like|to|the|form|shape|points|vertices|corners|tips|of) )*"
    rf"(?:a|an|one|(?<=of )the) {_LIKE}{_NAME}"
    r"(?=$| (?!(?:block|cube|tile|brick|box|piece|one|ones)\b))|"
    rf"(?:^|(?<=: )|(?<=\bplease )|(?<=\bmake )){_BARE}"
    r"(?=$| (?:from|of|out|with|using|at|in|on|around|,))"
)
_TABLE = r"(?: of (?:the|my) (?:table|desk|board))?"
_DEEP = r"(?:far|back|top|upper|near|front|bottom|lower|down|up)"
_PART = re.compile(
    r"(?:,? ?\b(?:somewhere|anywhere|right|over|up|down|all|lie|lying|centred|centered|together) )*"
    r",? ?\b(?:(?:in|at|on|into|to|along|around|round|about|whose centre is|with its centre at|"
    r"part) )?"
    r"(?:(?:in|the|my|part|very|exact|dead|table|table 's|table's) )*"
    rf"(?:(?P<deep>{_DEEP})(?: |-)?)?"
    r"(?:(?P<side>left|right)(?:-| )?(?:hand)?)?(?P<mid>middle|centre|center)?"
    rf"(?: (?P<kind>half|side|edge|corner|part|end))?{_TABLE}(?=$| )"
)
_TIP = re.compile(
    r",? ?\b(?:with )?(?:(?:the|its|his) )?(?:tip|point|pointed end|sharp end)"
    r"(?: (?:pointing|facing|turned|going|is|looking))* "
    r"(?P<tip>towards? me|to me|at me|away from me|from me|near me|far from me)"
)
_BY_ME = re.compile(
    r"\b(?:(?:right|just) )?(?:close|near|nearer|next|in front of)(?: to| by)? me\b"
)
_FAR = r"(?P<far>[\d.,]+ ?(?:cm|mm|centimet\w+|millimet\w+|inch\w*))"
_SIZE = re.compile(
    r",? ?\b(?:(?:and|with|of) )?(?:a |the |its |each )?(?:sides?|side lengths?|edge lengths?)"
    rf"(?: (?:length|is|of|about|roughly|around|exactly|approximately))* {_FAR}|"
    r",? ?\b(?:with|of|about|and|a|roughly|each) ?(?P<long>[\d.,]+ ?(?:cm|mm|inch\w*))(?: long)? "
    r"(?:sides?|side length|on each side)"
)
_RADIUS = re.compile(
    rf",? ?\b(?:(?:and|with|of|a|radius|each|all|about) )*{_FAR} (?:from (?:the|its) (?:middle|"
    r"centre|center)(?: each)?|radius)|,? ?\b(?:with )?(?:a |its )?radius (?:of |is )?"
    r"(?P<long>[\d.,]+ ?(?:cm|mm))"
)
_IN_IT = re.compile(
    r",? ?(?:\b(?:with|and) )?(?P<one>#\d+|one(?: of (?:them|@\d+))?) "
    r"(?:in|as|at|is|being|forms?|makes?) (?:the |its )?(?:middle|centre|center)(?: one)?"
    r"(?: of (?:@\d+|the (?:plus|cross)|it))?"
    r"(?: and (?:4|four|the) arms?)?(?= ?$| (?!of\b))"
)
_ARMS = re.compile(
    r"(?P<arms>#\d+) (?:(?:are|as|is|being|form|make|for|on) )?(?:the |its )?(?:four |4 )?arms?"
)
_AROUND = re.compile(rf"(?P<figure>a (?:{'|'.join(_FIGURES)})(?: sign)?) around (?P<one>#\d+)")
_LIST = re.compile(r"#\d+(?:(?: ,| and| , and) #\d+)*")
_IDLE = re.compile(
    r"\b(?:like geese(?: flying)?|geese flying|not too (?:small|big)|"
    r"one (?:point|tip) up(?: ,)?(?: and)? one (?:point|tip) down|you (?:do|make)(?: me)?|"
    r"one up the back(?: ,)?(?: and)? two in front|"
    r"going (?:from )?left to right|from left to right|left to right|for the opening game|"
    r"(?:all )?(?:lie|stand|fly|sit|be laid)|out)\b"
)
_MATERIAL = re.compile(r"\b(?:from|of|out of|with|using) (?=#)")
_TALK = frozenset(
    {",", ".", "!", "?", ":", ";", "and", "all", "both", "them", "up", "shall", "u", "pls", "yes"}
    | {"ok", "at", "in", "on"}
)
_GEESE = re.compile(r" (?:shall |should |must |could |to )?fly(?:ing)? like geese(?: do)?:?", re.I)
_ORDER = re.compile(
    r",? (?:going )?(?:from )?left to right(?: it goes| comes?)?[:,]? (?=\w+, \w+)", re.I
)
_TOLD = re.compile(
    r"^(?:i have|we have|there are|here are|you see) (?P<them>#\d+)(?: \w+){0,2}"
    r"(?: (?:on|at|in) the \w+(?: side| half| edge)?)? , (?:and |so |but )"
)
_VERBS = frozenset({"place", "pick", "arrange", ""})
_SIDES = {"far": "far", "back": "far", "top": "far", "upper": "far", "up": "far", "near": "near",
          "front": "near", "bottom": "near", "lower": "near", "down": "near"}  # fmt: skip


class _Read(NamedTuple):
    """A figure as it was said; ``rest``: the words that were not read."""

    figure: str
    tip: str
    size: str
    part: str
    rest: str


def told_as_figure(text: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> str:
    """The sentence with the figure, its place and size in plain words; as it was where it says
    anything else."""
    if not re.search(rf"\b(?:{'|'.join(_FIGURES)})\b", text, re.IGNORECASE):
        return text
    linked = link(_ORDER.sub(", ", _GEESE.sub("", text)), scene, focus, lexicon)
    shape = frame(linked)
    said = _TOLD.sub(r"\g<them> ", shape.text.lower())
    said, middle = _middle_of(said, shape)
    listed = _LIST.findall(said)
    made = shape.among(" ".join(listed))
    read = _read(said) if len(listed) == 1 else None
    if (
        read is None
        or not _is_talk(read.rest, linked, lexicon)
        or not _of_those(shape, made, middle)
    ):
        return text
    if middle is not None and (read.figure != "cross" or not settles(middle.mention)):
        return text
    sure = all(_certain(one, read.figure) for one in made)
    return _told(read, made, middle, linked) if sure else text


def _middle_of(said: str, shape: Frame) -> tuple[str, Spoken | None]:
    """What is in the middle of the figure, and the sentence without it; one of those that form a
    cross is nothing more than it has."""
    said = _ARMS.sub(r"\g<arms>", said)
    around = _AROUND.search(said)
    if around is not None:
        return said.replace(around.group(), around["figure"]), shape.among(around["one"])[0]
    within = _IN_IT.search(said)
    if within is None:
        return said, None
    left = f"{said[: within.start()]} {said[within.end() :]}"
    ones = shape.among(within["one"])
    others = {o for one in shape.among(left) for o in one.mention.objects}
    if not ones or set(ones[0].mention.objects) <= others:
        return (left if re.search(r"\b(?:plus|cross)\b", said) else said), None
    return left, ones[0]


def _of_those(shape: Frame, made: Sequence[Spoken], middle: Spoken | None) -> bool:
    """Whether pronouns speak of nothing else than what forms the figure."""
    meant = {o for one in (*made, *([middle] if middle else [])) for o in one.mention.objects}
    return all(one.phrase is not None or set(one.mention.objects) <= meant for one in shape.named)


def _read(said: str) -> _Read | None:
    """The figure that is said, taken out of the sentence piece by piece."""
    said = " ".join(_IDLE.sub(" ", said).split())
    figure = _FIGURE.search(said)
    if figure is None:
        return None
    said = f"{said[: figure.start()]} {said[figure.end() :]}"
    tip, said = _taken(_TIP, said)
    said = _BY_ME.sub("at the near edge", said)
    size, said = _taken(_SIZE, said)
    radius, said = _taken(_RADIUS, said)
    said = " ".join(_MATERIAL.sub("", said).split())
    parts = [one for one in _PART.finditer(said) if any(one[k] for k in ("deep", "side", "mid"))]
    if len(parts) > 1 or (_FIGURE.search(said) is not None and figure["figure"] in said.split()):
        return None
    for one in parts:
        said = f"{said[: one.start()]} {said[one.end() :]}"
    name = _FIGURES[figure["figure"] or figure["bare"]]
    part = _part(parts[0]) if parts else ""
    if part is None or (tip and name != "V") or (radius and name != "circle"):
        return None
    if size and name not in ("square", "triangle", "diamond"):
        return None
    way = "" if tip is None else "away from me" if "from" in tip["tip"] else "towards me"
    far = "" if size is None and radius is None else _length(size or radius)
    measure = f" with {'sides' if size else 'a radius'} of {far}" if far else ""
    return _Read(name, f" with its tip {way}" if way else "", measure, part, said)


def _taken(form: re.Pattern[str], said: str) -> tuple[re.Match[str] | None, str]:
    found = form.search(said)
    return found, said if found is None else f"{said[: found.start()]} {said[found.end() :]}"


def _length(found: re.Match[str] | None) -> str:
    return "" if found is None else found.groupdict()["far"] or found.groupdict()["long"]


def _part(said: re.Match[str]) -> str | None:
    """The part of the table, in plain words; None of what is no such part."""
    deep, side, kind = _SIDES.get(said["deep"] or "", ""), said["side"] or "", said["kind"] or ""
    if said["mid"]:
        return None if deep or side or kind else " in the middle of the table"
    if deep and side:
        return f" in the {deep} {side} corner"
    if kind == "corner" or not (deep or side):
        return None
    return (
        f" in the {deep or side} half of the table"
        if kind != "edge"
        else (f" at the {deep or side} edge")
    )


def _certain(one: Spoken, figure: str) -> bool:
    """Whether it is certain which things the figure is made of."""
    many = len(one.mention.objects)
    free = one.phrase is not None and one.phrase.any_will_do and one.count != many
    vague = one.phrase is not None and one.phrase.vague
    several = one.mention.plural or (figure == "zigzag row" and settles(one.mention))
    return several and one.count in (0, many) and not (free or vague)


def _is_talk(said: str, linked: Linked, lexicon: Lexicon) -> bool:
    verbs = {
        token.text for chunk in linked.chunks if chunk.kind == "verb" and chunk.value in _VERBS
        for token in linked.tokens[chunk.first : chunk.last]
    }  # fmt: skip
    known = lexicon.words("polite") | _TALK | verbs
    stated = {"is", "are", "was", "were", "isn't", "aren't"} & set(said.split())
    return not stated and all(
        word in known or re.fullmatch(r"[#@]\d+", word) for word in said.split()
    )


def _told(read: _Read, made: Sequence[Spoken], middle: Spoken | None, linked: Linked) -> str:
    names = [_words_of(one, linked) for one in made]
    listed = ", ".join(names[:-1]) + (" and " if names[1:] else "") + names[-1]
    article = "an" if read.figure == "L" else "a"
    around = f" around {_words_of(middle, linked)}" if middle is not None else ""
    return f"put {listed} in {article} {read.figure}{around}{read.tip}{read.size}{read.part}"


def _words_of(one: Spoken, linked: Linked) -> str:
    return linked.text[linked.tokens[one.opened].start : one.mention.end]

"""What a program takes a sentence for that it is not: the wrong one of two moves, the arm draws in
the air, a thing is set upon what it was to go behind, or turned where two were to change places.

Vetoes over the mentions and the end that a program comes to; none of them makes a program.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Set

from clarifier.binding import Binding
from clarifier.spoken import Linked, Spoken
from scene.kinds import is_container
from scene.relations import beside, moved
from scene.types import Scene

_IN_THE_AIR = re.compile(r"\b(?:trace|hover)\(")
_AT_A_THING = re.compile(r"\btouch\(")
_ARM = frozenset(
    {"arm", "tool", "gripper", "hand", "finger", "claw", "tip", "suction", "yourself", "above"}
    | {"over", "circle", "circles", "square", "triangle", "loop", "ring", "arc", "lap", "zigzag"}
    | {"path", "figure", "spiral", "perimeter", "shape", "line", "around", "air"}
)
"""Words by which the arm itself is spoken of, or what it draws; verbs of drawing and touching are
others."""
_IN_CIRCLES = re.compile(
    r"\b(?:(?:make|do|draw|describe|trace|sketch|fly|perform)(?: \w+){0,3} (?:circles?|loops?|"
    r"laps?|"
    r"rings?|orbits?) (?:in the air )?(?:a?round|over|above|about)|(?:wave|fly|circle|whirl) "
    r"(?:the|"
    r"your|that) (?:arm|tool|gripper|hand|finger|claw|tip))\b"
)
_MATERIAL = frozenset({"with", "of", "from", "out", "using"})
_SWAPS = frozenset({"switch", "swap", "exchange", "interchange", "trade"})
_DUE = frozenset({"should", "must", "shall", "ought"})
_LEFT_ALONE = frozenset({"be", "stay", "remain", "alone", "rest", "where"})
_STAYS = frozenset({"stays", "stay", "remains", "remain"})
_PUT_OUT = frozenset({"out", "put", "here", "there", "where", "as", "outside", "aside"})
_BESIDE = frozenset({"left", "right", "beside", "between"})
_BEHIND = frozenset({"behind", "beyond"})
_SHARES = frozenset({"share", "split", "divide", "distribute", "deal", "divvy"})
_SIDED = frozenset({"left", "right", "above", "below"})
_NOES = frozenset({"no", "nope", "nah"})
_ENDS = frozenset({".", "!", "?", ";", ":", "then"})
_ALL = frozenset({"both", "all", "each"})


def shifted(before: Scene, after: Scene) -> set[str]:
    """The ids of what is moved, taken or let go."""
    ends = {item.id: item for item in after}
    return {item.id for item in before if item.id in ends and (
        moved(item, ends[item.id]) > 0 or item.held != ends[item.id].held)}  # fmt: skip


def moves_the_arm_alone(linked: Linked, body: str, shifted: Set[str]) -> bool:
    """Whether the arm goes through the air, and nobody spoke of it, of drawing or of pointing."""
    if shifted or not _IN_THE_AIR.search(body) or _AT_A_THING.search(body):
        return False
    shown = any(c.kind == "verb" and c.value in ("touch", "trace") for c in linked.chunks)
    return not shown and not _ARM & {token.text for token in linked.tokens}


def moves_for_a_motion(linked: Linked, shifted: Set[str]) -> bool:
    """ "Wave your arm in a circle above the cups", "make three circles over the book": whether
    something is moved or turned, which the arm alone was to do."""
    verbs = {c.value for c in linked.chunks if c.kind == "verb"}
    words = {token.text for token in linked.tokens}
    alone = verbs <= {"trace", "arrange"} and not words & _MATERIAL
    return bool(shifted) and alone and _IN_CIRCLES.search(linked.text.lower()) is not None


def turns_for_a_swap(linked: Linked, body: str) -> bool:
    """Whether something is turned where things are to change places."""
    said = {_text(c.first, linked) for c in linked.chunks if c.kind == "verb"}
    turns = any(c.kind == "verb" and c.value == "turn" for c in linked.chunks)
    return bool(_SWAPS & said) and not turns and re.search(r"\bturn\(", body) is not None


def leaves_the_subject(linked: Linked, binding: Binding, shifted: Set[str]) -> bool:
    """ "The cup should be near the lamp", "let it top the book": whether others are moved and what
    is spoken of is not."""
    subjects = {o for one in linked.spoken if _is_subject(one, linked)
                for o in binding.get(one.mention.slot, ())}  # fmt: skip
    return bool(subjects) and bool(shifted) and not shifted & subjects


def _is_subject(one: Spoken, linked: Linked) -> bool:
    if one.relation:
        return False
    if _text(one.opened - 1, linked) == "let":
        return _text(one.last, linked) not in _LEFT_ALONE
    at = one.last + 1 + (_text(one.last + 1, linked) == "to")
    place = any(c.first == at + 1 and c.kind in ("relation", "place") for c in linked.chunks)
    return _text(one.last, linked) in _DUE and _text(at, linked) in ("be", "go") and place


def moves_what_stays(linked: Linked, binding: Binding, shifted: Set[str]) -> bool:
    """ "..., the small one stays out": whether it is moved."""
    for one in linked.spoken:
        ahead = _text(one.opened - 1, linked)
        told = one.opened == 0 or (ahead != "so" and not ahead.isalnum()) or ahead in ("and", "but")
        stays = _text(one.last, linked) in _STAYS and _text(one.last + 1, linked) in _PUT_OUT
        named = one.phrase is not None and one.phrase.group != "them"
        if told and stays and named and shifted & set(binding.get(one.mention.slot, ())):
            return True
    return False


def takes_the_goal(
    linked: Linked, body: str, binding: Binding, before: Scene, shifted: Set[str]
) -> bool:
    """ "Nails, jar.": whether the container, which is where things go, is moved or touched as one
    of them."""
    for goal in _goals_listed(linked):
        held = binding.get(goal.mention.slot, ())
        if len(held) == 1 and is_container(before.get(held[0]).name):
            touches = re.search(rf"\btouch\({goal.mention.slot}\b", body) is not None
            if touches or set(held) & shifted:
                return True
    return False


def _goals_listed(linked: Linked) -> Iterator[Spoken]:
    """The last of two things that a sentence without a verb names, a comma between them."""
    begin = 0
    for end in (*(i for i, t in enumerate(linked.tokens) if t.text in _ENDS), len(linked.tokens)):
        named = [one for one in linked.spoken if begin <= one.opened and one.last <= end]
        verbs = [c for c in linked.chunks if c.kind == "verb" and begin <= c.first < end
                 and c.value != "cannot" and _text(c.first, linked) != "go"]  # fmt: skip
        if len(named) == 2 and not verbs and named[0].opened == begin and not named[1].relation:
            between = [_text(i, linked) for i in range(named[0].last, named[1].opened)]
            between = between[:-1] if between[-1:] and _is_attribute(between[-1]) else between
            behind = named[1].last == end or _text(named[1].last, linked) == ","
            if between and set(between) <= _ALL | {","} and "," in between and behind:
                yield named[1]
        begin = end + 1


def _is_attribute(word: str) -> bool:
    """A word in "ing" before a noun: "the mixing bowl"."""
    return word.endswith("ing")


def sets_upon(linked: Linked, binding: Binding, before: Scene, after: Scene) -> bool:
    """Whether something is set upon what it was to go behind, or beside."""
    for one in linked.spoken:
        led = one.relation == "above" and _text(one.opened - 1, linked) in _BEHIND
        if not led and one.relation not in _BESIDE:
            continue
        if one.relation == "between" and _SHARES & {token.text for token in linked.tokens}:
            continue  # "share the pegs between the tin and the box"
        marks = set(binding.get(one.mention.slot, ()))
        themes = {o for other in linked.spoken if other.theme and other.first < one.first
                  for o in binding.get(other.mention.slot, ())}  # fmt: skip
        ends = {item.id: item for item in after}
        if any(ends[o].on in marks and before.get(o).on not in marks
               for o in themes - marks if o in ends):  # fmt: skip
            return True
    return False


def ends_uncorrected(linked: Linked, binding: Binding, after: Scene, shifted: Set[str]) -> bool:
    """ "... right of the lamp? No, behind it": whether what is moved is not where the last word of
    the sentence wants it."""
    if not linked.spoken or linked.spoken[-1].relation not in _SIDED:
        return False
    last = linked.spoken[-1]
    said = next((c for c in linked.chunks if c.kind == "relation" and c.last == last.opened), None)
    ahead = [token.text for token in linked.tokens[: said.first]][-4:] if said is not None else []
    marks = binding.get(last.mention.slot, ())
    if set(marks) & shifted:  # nothing goes behind itself: "it" is where it was to go before
        before = [one for one in linked.spoken[:-1] if one.relation]
        marks = binding.get(before[-1].mention.slot, ()) if before else ()
    if not ahead or ahead[-1] not in (",", *_NOES) or not _NOES & set(ahead) or len(marks) != 1:
        return False
    mark, moving = after.get(marks[0]), [after.get(o) for o in shifted - set(marks)]
    return any(
        one.x is not None and mark.x is not None and not beside(after, one, mark, last.relation)
        for one in moving
    )


_PARTLY = re.compile(
    r"\b(?:half[- ]?way|mid[- ]?way|(?:a |one )?(?:quarter|third|fifth) of the way)\b",
    re.IGNORECASE,
)
_TO_THE_RIM = re.compile(r"\b(?:edge|mid_edge|corner|rim|along_edge)\(")
_STOPS_SHORT = re.compile(r"\b(?:between|towards)\(|/ \d|\* 0\.")


def goes_all_the_way(linked: Linked, body: str) -> bool:
    """ "Halfway between the middle and the edge": whether something goes to the edge itself."""
    if _PARTLY.search(linked.text) is None or _STOPS_SHORT.search(body):
        return False
    return len(linked.slots) == 1 and _TO_THE_RIM.search(body) is not None


_SHORT = re.compile(
    r"\d ?(?:mm|cm|\w+met(?:re|er)s?|inch(?:es)?) (?:short|before|away|off)\b", re.I
)
_MEASURED = re.compile(r"\bd\d\b")


def goes_too_far(linked: Linked, body: str) -> bool:
    """ "Up to the tower, but stop 5 cm short": whether how far short of it is left out."""
    return _SHORT.search(linked.whole) is not None and _MEASURED.search(body) is None


_MID_EDGE = re.compile(r'\bmid_edge\(\w+, "(?P<side>\w+)"\)')
_ANY_SIDE = re.compile(
    r"\b(?:left|right|far|near|nearer|back|rear|front|top|bottom|upper|lower|my|me|us|you|your|closest|"
    r"nearest|furthest|farthest|farther|further|other|opposite|away|head|foot|behind|ends?|north|"
    r"south|east|west|each|every|any)\w*",
    re.IGNORECASE,
)


def chooses_the_edge(linked: Linked, body: str) -> bool:
    """ "To the middle of the edge": whether one of the four is taken although none was named."""
    return _MID_EDGE.search(body) is not None and _ANY_SIDE.search(linked.text) is None


_ONE_CORNER = re.compile(r"\b(?:in|into|to|at) (?:a|one|the same|any) corner\b", re.IGNORECASE)
_EACH_OWN = re.compile(r"\b(?:each|every|different|own|apart|separate\w*)\b", re.IGNORECASE)


def parts_the_group(linked: Linked, body: str) -> bool:
    """ "The discs in a corner": whether each of them goes to another one."""
    one = _ONE_CORNER.search(linked.text) is not None and _EACH_OWN.search(linked.text) is None
    return one and "own_corners(" in body


_DRAWN = frozenset({"triangle", "square", "rectangle", "circle", "ring", "diamond", "row", "line"})
_MADE_OF = frozenset({"of", "with", "from", "using"})


def parts_a_figure(linked: Linked, body: str) -> bool:
    """ "Make a triangle with the two apples and the banana": whether some of what a figure is made
    of goes elsewhere, or is what the rest goes around."""
    led = next((i for i, token in enumerate(linked.tokens) if token.text in _MADE_OF), None)
    drawn = led is not None and _DRAWN & {token.text for token in linked.tokens[:led]}
    made = [one for one in linked.spoken if led is not None and one.first > led]
    if not drawn or len(made) < 2 or any(one.verb != "arrange" for one in made):
        return False
    slots = {one.mention.slot for one in made}
    around = re.findall(r"\b(?:outline|circle|around)\((?:[^()]*, )?(m\d+)\b", body)
    around += re.findall(r"\bput_all_around\(.*, (m\d+)\)", body)
    together = any(slots <= set(re.findall(r"\bm\d+\b", line)) for line in body.splitlines())
    return not together or bool(slots & set(around))


_CORNERED = re.compile(r"\bin_shape\((?P<things>m\d+), (?P<corners>[3-9])\)")


def too_few_for_a_figure(body: str, binding: Binding) -> bool:
    """ "Make a triangle with the two apples": whether a figure has more corners than things."""
    return any(
        len(binding.get(said["things"], ())) < int(said["corners"])
        for said in _CORNERED.finditer(body)
    )


def _text(at: int, linked: Linked) -> str:
    return linked.tokens[at].text if 0 <= at < len(linked.tokens) else ""

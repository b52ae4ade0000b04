"""One thing for each place, told as which goes where: "guard the coin with the three figures, one
left of it, one right of it, one behind it", "one disc at the middle of each side of the table",
"the cubes in the other three corners". Which of a group goes where is open: each goes the shortest
way.

Only where every word is one of the things, a place, or talk; what is said before stays before.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from itertools import permutations
from typing import NamedTuple

from agent.messages import Focus
from clarifier.ask import labels
from clarifier.frame import Frame, frame
from clarifier.lexicon import Lexicon
from clarifier.mentions import link
from clarifier.spoken import Linked, Spoken, settles
from clarifier.way_forms import SIDES, STANDS
from clarifier.words import listing, plural, singular
from scene.relations import in_corner
from scene.types import Scene, SceneObject

MOST = 4
"""So many places at most are told one by one."""
OUT = 0.3
"""About so far beside a landmark things stand (table units)."""

_MARK = r"[#@]\d+"
_OF = rf"(?: of(?: {_MARK})?)?"
_ITS = r"(?:(?:to|on|at|from|in) )?(?:(?:the|its|his|her) )?"
_SIDES = tuple((side, re.compile(rf"(?:{form}){_OF}(?: |$)")) for side, form in (
    ("in front of", rf"in front|{_ITS}(?:front|near)(?: side)?|(?:to the )?south|s"),
    ("behind", rf"behind(?: {_MARK})?|{_ITS}(?:back|rear|far)(?: side)?|(?:to the )?(?:north|n)"),
    ("to the left of", rf"{_ITS}left(?: hand)?(?: side)?|(?:to the )?west|w|with(?= of)"),
    ("to the right of", rf"{_ITS}right(?: hand)?(?: side)?|(?:to the )?east|e"),
))  # fmt: skip
_WAYS = {"to the left of": (-1, 0), "to the right of": (1, 0), "behind": (0, 1),
         "in front of": (0, -1)}  # fmt: skip
_WHO = re.compile(r"(?P<who>#\d+|one|another|a third|the (?:third|fourth|last)(?: one)?)(?: |$)")
_JOINT = re.compile(r"(?:,|and|:|-|goes|go|stands?|is|are|be)(?: |$)")
_HEM = r"(?:fence|guard|surround|enclose|encircle|ring|protect|box|hem|pen|wall|frame)"
_GROUND = r"(?:round|around|about)"
_HEADS = tuple(re.compile(form) for form in (
    rf"{_HEM} (?P<mark>{_MARK})(?: in)?(?: (?:with|by|using) (?P<group>#\d+))?(?= |$)",
    rf"(?P<group>#\d+)(?: all| close| evenly| closely)* {_GROUND} (?P<mark>{_MARK})(?= |$)",
    rf"(?P<group>#\d+)(?P<each> (?:on|at|to) (?:each|every) side of) (?P<mark>{_MARK})(?= |$)",
))  # fmt: skip
_ALL_ROUND = re.compile(
    r"(?:,|please|close(?:ly)?(?: by| in| up)?|(?:with |at )?(?:the )?same spacing(?: all round)?|"
    r"evenly|spaced|like a tripod|in a (?:ring|circle)|all round|(?:(?:on|from|at) )?(?:all|every)"
    rf"(?: of its| its| the)?(?: four| three)? sides?(?: of {_MARK})?|one (?:on )?(?:each|every) "
    r"side)(?= |$)"
)
_CLEAR = re.compile(
    r"(?:, )?(?:with )?(?:a )?(?:clearance|gap|distance|space)(?: of)? "
    r"(?:under|below|less than|at most|no more than) (?P<far>[\d.]+) cm"
)
_TABLE = r"(?: of the (?:table|desk|board|field))?"
_EACH = (
    r"(?:each|every|all four|the four|each of the four|a different|a separate|(?:its|their) own|"
    r"different|separate)"
)
_GOES = r"(?: ,)?(?: (?:goes|go|belongs?|stands?|moves?))?(?: (?:one|each))?"
_ONE_EACH = r"(?: ,? ?(?:1|one) (?:each|apiece|in each))?"
_CORNERS = re.compile(
    rf"(?P<group>#\d+){_GOES} (?:in|at|to|into|on) (?:{_EACH}|"
    rf"the (?:other|remaining|free|empty) (?P<rest>two|three)) corners?{_TABLE}{_ONE_EACH}"
)
_EDGES = re.compile(
    rf"(?P<group>#\d+){_GOES} (?:in|at|to|on) (?:the (?:middle|centre|center) of "
    rf"{_EACH} (?:sides?|edges?){_TABLE}|{_EACH} (?:edges?{_TABLE}|sides? of the (?:table|desk|"
    rf"board|field))){_ONE_EACH}"
)
_KEPT = re.compile(r"(?:[.;!]|,? ?(?:and|then|and then)(?: ,)?)\s*$")
_STATED = re.compile(r"^#\d+ .*(?::|so|[.!])$|^[\w ]+ has #\d+(?: already)?(?: ,)? so$")
_SETTING = frozenset({"stand", "lay", "sit"})
_TALK = frozenset({",", ".", "!", "?", ":", ";", "and", "let", "ring", "of", "has", "already", "1"})
_CORNER = {("left", "above"): "far left", ("right", "above"): "far right",
           ("left", "below"): "near left", ("right", "below"): "near right"}  # fmt: skip


class _Clause(NamedTuple):
    """What is to be done, in plain words, from this place of the frame on; ``after`` something that
    is said before, where a pronoun stays one."""

    start: int
    alone: str
    after: str


class _Place(NamedTuple):
    """Where one thing goes, in plain words, and about where that is (table units)."""

    words: str
    x: float
    y: float


def one_for_each(text: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> str:
    """The sentence with which thing goes to which place; as it was where it says anything else."""
    linked = link(text, scene, focus, lexicon)
    shape = frame(linked)
    said = shape.text.lower()
    for read in (_beside, _corners, _edges):
        found = read(said, shape, linked, scene, lexicon)
        if found is not None:
            before = _before(said[: found.start], shape, linked, lexicon)
            if before is None:
                return text
            return f"{before}{found.after}" if before else found.alone
    return text


def _before(said: str, shape: Frame, linked: Linked, lexicon: Lexicon) -> str | None:
    """What was said before as it was said, nothing of talk; None where it may matter."""
    verbs = _verbs(linked)
    words = said.split()
    while words and words[-1] in verbs | _SETTING:
        words.pop()
    left = " ".join(words)
    if all(word in lexicon.words("polite") | _TALK | verbs for word in words):
        return ""
    if _STATED.match(left):
        return ""
    if not _KEPT.search(left):
        return None
    return linked.text[: linked.tokens[shape.token(len(left) + 1)].start]


def _beside(
    said: str, shape: Frame, linked: Linked, scene: Scene, lexicon: Lexicon
) -> _Clause | None:
    """ "Guard it with the three figures, one left of it ...", "the blocks all round the bowl"."""
    for form in _HEADS:
        head = form.search(said)
        if head is None:
            continue
        mark = _landmark(head["mark"], said[: head.start()], shape)
        tail, clear = _CLEAR.sub("", said[head.end() :]).strip(), _CLEAR.search(said)
        if mark is None or (clear is not None and float(clear["far"]) < 1.5):
            return None
        tail = _without_its_side(tail, mark, scene)
        group = shape.among(head["group"])[0] if head["group"] else None
        items = _items(tail, group, shape)
        each = "each" in form.groupindex
        if items is None:
            left = " ".join(_ALL_ROUND.sub(" ", tail).split())
            if group is None or not _is_talk(left.split(), linked, lexicon):
                return None
            if not each:
                return _around(head, group, mark, linked)
            sides = list(_WAYS)
            items = [(group, sides[:2] if len(group.mention.objects) == 2 else sides)]
        pairs = _assigned(items, scene.get(mark.mention.objects[0]), scene)
        if pairs is None:
            return None
        name = _words_of(mark, linked)
        other = "it" if head["mark"][0] == "@" else name
        told, after = (_told(pairs, scene, lexicon, one) for one in (name, other))
        return None if told is None or after is None else _Clause(head.start(), told, after)
    return None


def _without_its_side(tail: str, mark: Spoken, scene: Scene) -> str:
    """What follows the landmark without where it stands, if it does stand there."""
    item, found = scene.get(mark.mention.objects[0]), STANDS.match(f" {tail}")
    if found is None or item.x is None:
        return tail
    (x, y), (to_x, to_y) = item.position, SIDES[found["side"]]
    return tail[found.end() - 1 :] if x * to_x + y * to_y > 0 else tail


def _landmark(said: str, before: str, shape: Frame) -> Spoken | None:
    """What the others go around; what was told of before where only a pronoun is said."""
    mark, told = shape.among(said)[0], shape.among(" ".join(re.findall(r"#\d+", before)))
    same = [one for one in told if one.mention.objects == mark.mention.objects]
    if mark.phrase is None and (same or (not mark.mention.objects and len(told) == 1)):
        mark = (same or told)[0]
    return mark if settles(mark.mention) else None


def _around(head: re.Match[str], group: Spoken, mark: Spoken, linked: Linked) -> _Clause | None:
    many = len(group.mention.objects)
    if not group.mention.plural or many < 3 or group.count not in (0, many):
        return None
    one = re.sub(r"^(?:all the |all |the )?", "the ", _words_of(group, linked), count=1)
    name = _words_of(mark, linked)
    other = "it" if head["mark"][0] == "@" else name
    return _Clause(head.start(), f"put {one} around {name}", f"put {one} around {other}")


def _items(tail: str, group: Spoken | None, shape: Frame) -> list[tuple[Spoken, list[str]]] | None:
    """Who goes to which sides, in their order; None where anything else is said."""
    items: list[tuple[Spoken, list[str]]] = []
    who, at, tail = group, 0, f"{tail.strip(' .!?')} "
    while at < len(tail):
        rest = tail[at:]
        named, joint = _WHO.match(rest), _JOINT.match(rest)
        side = next(((name, m) for name, form in _SIDES if (m := form.match(rest))), None)
        if named is not None:
            who = shape.among(named["who"])[0] if named["who"].startswith("#") else who
            at += named.end()
        elif side is not None and who is not None:
            if items and items[-1][0] is who:
                items[-1][1].append(side[0])
            else:
                items.append((who, [side[0]]))
            at += side[1].end()
        elif joint is not None:
            at += joint.end()
        else:
            return None
    return items or None


def _assigned(
    items: Sequence[tuple[Spoken, list[str]]], mark: SceneObject, scene: Scene
) -> list[tuple[str, _Place]] | None:
    """Which thing goes to which side of the landmark."""
    if mark.x is None:
        return None
    x, y = mark.position
    pairs: list[tuple[str, _Place]] = []
    for who, sides in items:
        places = [
            _Place(f"{side} ", x + OUT * _WAYS[side][0], y + OUT * _WAYS[side][1]) for side in sides
        ]
        given = _nearest(who, places, scene)
        if given is None:
            return None
        pairs += given
    things = [thing for thing, _ in pairs]
    sides_said = [place.words for _, place in pairs]
    if len(set(things)) < len(things) or len(set(sides_said)) < len(pairs) or mark.id in things:
        return None
    return pairs


def _nearest(
    who: Spoken, places: Sequence[_Place], scene: Scene
) -> list[tuple[str, _Place]] | None:
    """The things, just as many as the places, each with one of them, the shortest ways in all."""
    things = [scene.get(one) for one in who.mention.objects]
    if len(things) != len(places) or len(places) > MOST or any(one.x is None for one in things):
        return None
    if who.count not in (0, 1, len(things)):
        return None
    best = min(
        permutations(places),
        key=lambda order: sum(
            math.dist(one.position, (place.x, place.y))
            for one, place in zip(things, order, strict=True)
        ),
    )
    return [(one.id, place) for one, place in zip(things, best, strict=True)]


def _told(
    pairs: Sequence[tuple[str, _Place]], scene: Scene, lexicon: Lexicon, mark: str = ""
) -> str | None:
    """Which thing goes where; None where things cannot be told apart by words."""
    names = labels([thing for thing, _ in pairs], scene, lexicon)
    if any("(" in name for name in names.values()):
        return None
    return f"put {listing(f'{names[thing]} {place.words}{mark}' for thing, place in pairs)}"


def _corners(
    said: str, shape: Frame, linked: Linked, scene: Scene, lexicon: Lexicon
) -> _Clause | None:
    """ "One in every corner", "in the other three corners"."""
    found = _CORNERS.search(said)
    if found is None or not _is_talk(said[found.end() :].split(), linked, lexicon):
        return None
    (group,) = shape.among(found["group"])
    moving = set(group.mention.objects)
    if found["rest"] is None:
        return _shared_out(found.start(), group, "in the four corners", linked)
    free = list(_free_corners(moving, scene))
    if not len(free) == len(moving) == (2 if found["rest"] == "two" else 3):
        return None
    across = {"left": -1, "right": 1, "above": 1, "below": -1}
    places = [_Place(f"in the {_CORNER[c]} corner", across[c[0]], across[c[1]]) for c in free]
    given = _nearest(group, places, scene)
    told = None if given is None else _told(given, scene, lexicon)
    return None if told is None else _Clause(found.start(), told, told)


def _free_corners(moving: set[str], scene: Scene) -> Iterator[tuple[str, str]]:
    staying = [one for one in scene.objects if one.id not in moving and one.x is not None]
    for corner in _CORNER:
        if not any(in_corner(scene, one, *corner) for one in staying):
            yield corner


def _edges(
    said: str, shape: Frame, linked: Linked, scene: Scene, lexicon: Lexicon
) -> _Clause | None:
    """ "One disc at the middle of each side of the table"."""
    found = _EDGES.search(said)
    if found is None or not _is_talk(said[found.end() :].split(), linked, lexicon):
        return None
    (group,) = shape.among(found["group"])
    return _shared_out(found.start(), group, "at the edges, one at each", linked)


def _shared_out(start: int, group: Spoken, where: str, linked: Linked) -> _Clause | None:
    """Four things for the four places of a kind."""
    if len(group.mention.objects) != 4 or group.count not in (0, 1, 4):
        return None
    bare = re.sub(r"^(?:\w+ of (?:the|my|these)|each|every) ", "", group.mention.text)
    *before, noun = bare.split(" ")
    if singular(noun) in ("one", "them"):
        return None
    told = f"put the {' '.join((*before, plural(singular(noun))))} {where}"
    return _Clause(start, told, told)


def _is_talk(words: Sequence[str], linked: Linked, lexicon: Lexicon) -> bool:
    return all(word in lexicon.words("polite") | _TALK | _verbs(linked) for word in words)


def _verbs(linked: Linked) -> set[str]:
    """The words by which something is put somewhere."""
    return {
        token.text for chunk in linked.chunks if chunk.kind == "verb" and chunk.value == "place"
        for token in linked.tokens[chunk.first : chunk.last]
    }  # fmt: skip


def _words_of(one: Spoken, linked: Linked) -> str:
    return linked.text[linked.tokens[one.opened].start : one.mention.end]

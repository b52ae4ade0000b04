"""How far two things are to be apart, told as how things are to be: "there should be 3 cm between
the cup and the box, move only the cup", "the cup must be 3 cm from the box". Put as where the one
goes: "put the cup 3 cm from the box".
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from agent.messages import Focus
from clarifier.ask import labels
from clarifier.frame import Frame, frame
from clarifier.lexicon import Lexicon
from clarifier.mentions import link
from clarifier.spoken import Linked, Spoken, settles
from scene.types import Scene

_UNIT = (r"(?:mm|millimet\w+|cms?|centimet\w+|centis?|dm|decimet\w+|m|met(?:re|er)s?|inch(?:es)?|"
         r"feet|foot)")  # fmt: skip
_FAR = (rf"(?:(?:about|around|roughly|exactly|just|approximately|at least|only|some|precisely) )?"
        rf"(?P<far>(?!the\b)(?:[\w.,/-]+ ){{1,3}}?{_UNIT})(?: exactly| precisely)?")  # fmt: skip
_BE = (r"(?:(?:should|must|shall|has to|have to|needs to|need to|ought to|is to|are to) "
       r"(?:be|stand|sit|lie|stay|end up|remain)|is to be)")  # fmt: skip
_GAP = r"(?:gaps?|spaces?|distance|room|clearance|air|spacing|separation)(?: of)?"
_TWO = r"between (?:(?P<one>#\d+) and (?P<other>#\d+)|(?P<both>#\d+))"
_ENDS = r"(?P<rest>(?= [,.;:!?]| by|$).*)$"
_LEAD = r"^(?:(?:please|so|now|well|ok|and) )*"

_FORMS = tuple(re.compile(_LEAD + form + _ENDS) for form in (
    # "the cup must be 3 cm from the box", "I want the cup 3 cm from the box"
    rf"(?P<mover>#\d+) {_BE} {_FAR}(?: away| apart| off| distant)? from (?P<mark>#\d+)",
    rf"(?:i|we) (?:want|need|would like|'d like|wish) (?P<mover>#\d+)(?: to be)? {_FAR}(?: away| "
    rf"off)? from (?P<mark>#\d+)",
    rf"(?:move|shift|put|place|set|bring|slide|get) (?P<mover>#\d+) so (?:that )?@\d+(?:'s| is| "
    rf"stands| sits| ends up) {_FAR}(?: away| off)? from (?P<mark>#\d+)",
    # "there should be 3 cm between ...", "leave a gap of 3 cm between ..."
    rf"(?:there {_BE}|(?:leave|keep|make|have|set|create|give|want|allow)|(?:i|we) (?:want|need|"
    rf"would "
    rf"like|'d like)(?: to have| to see)?)(?: an?| the)?(?: {_GAP})? {_FAR}(?: an?)?(?: of)?"
    rf"(?: {_GAP})? {_TWO}",
    rf"(?:(?:make|set|have) )?(?:the |a )?{_GAP} {_TWO} (?:(?:{_BE}|to be|be|is|=|equal to) "
    rf")?{_FAR}",
    rf"{_TWO} (?:there )?{_BE} (?:an?|the)? ?(?:{_GAP} )?{_FAR}(?: of)?(?: {_GAP})?",
    # "put the cups 3 cm apart"
    rf"(?:put|place|set|move|stand|keep|arrange) (?P<both>#\d+) {_FAR} (?:apart|away from each "
    rf"other|from "
    rf"each other)(?: from each other)?",
    # "put the candle behind the book with a gap of 3 cm"
    rf"(?P<verb>put|place|set|move|stand|lay) (?P<mover>#\d+) (?P<where>behind|in front of|beside|"
    rf"next to|(?:to|on) the (?:left|right) of|left of|right of) (?P<mark>#\d+)(?: ,)?(?: and)? "
    rf"(?:with|"
    rf"leaving|at)(?: an?)?(?: {_GAP})? {_FAR}(?: of)?(?: {_GAP})?(?: between(?: @\d+)?| apart)?",
    rf"(?P<verb>put|place|set|move|stand|lay) (?P<mover>#\d+) (?P<where>behind|in front of|beside|"
    rf"next to|(?:to|on) the (?:left|right) of|left of|right of) (?P<mark>#\d+) , {_FAR}"
    rf"(?: apart| away| between(?: @\d+)?| gap| space)",
))  # fmt: skip
_ONLY = re.compile(
    r"(?:(?:only|just|by) mov(?:e|ing) |mov(?:e|ing) (?:only |just )|(?:only|just) "
    r")(?P<mover>[#@]\d+)"
    r"(?: only| alone)?(?: moves| may move| is to move| should move| to be moved)?"
)
_NOT = re.compile(
    r"(?:(?:don't|do not|dont|without|never) (?:mov(?:e|ing)|touch(?:ing)?)|leave|keep|(?=#\d+ "
    r"(?:stays|must stay|should stay|doesn't move|is not to|must not))) ?(?P<still>#\d+)"
)
_TALK = re.compile(
    r"(?:[,.;:!?]|and|but|please|thanks|where @?\d* ?is|as @\d+ is|stays?(?: put| where @\d+ is)?|"
    r"(?:measured )?(?:from )?edge to edge|the measure is (?:from )?|if you would|only|just|alone)"
)
_FROM = re.compile(
    r"^(put (?:the|my|this|that|a|an) .+ )from( (?:the|my|this|that) .+)$", re.IGNORECASE
)
_SIDES = ("to the right of", "to the left of", "in front of", "behind")
_SIDE = re.compile(r"(?P<who>#\d+)(?: goes| stays)? (?:on|to) the (?P<side>left|right)")


def set_apart(text: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> str:
    """The sentence with how far two things are to be apart as where one of them goes; as it was
    where it says anything else."""
    linked = link(text, scene, focus, lexicon)
    shape = frame(linked)
    for form in _FORMS:
        said = form.match(shape.text.lower())
        found = None if said is None else _goes(said, shape, linked, scene, lexicon)
        if found is not None:
            return found
    return text


def on_each_side(linked: Linked) -> tuple[str, ...]:
    """ "Put the cup 3 cm from the box" said for each side of the box; nothing for anything else."""
    said = _FROM.match(linked.text)
    if said is None:
        return ()
    return tuple(f"{said[1]}{side}{said[2]}{linked.caution}" for side in _SIDES)


def _of_a_pair(
    groups: dict[str, str | None], rest: str, shape: Frame, scene: Scene, lexicon: Lexicon
) -> str | None:
    """ "5 cm between the cups, move only the red one", of just two."""
    (pair,) = shape.among(groups["both"])
    told, still = _ONLY.search(rest), _NOT.search(rest)
    moves = set(shape.among(told["mover"])[0].mention.objects) if told is not None else set()
    stays = set(shape.among(still["still"])[0].mention.objects) if still is not None else set()
    both = set(pair.mention.objects)
    moves = moves or (both - stays if stays else moves)
    if len(both) != 2 or not pair.mention.plural:
        return None
    if len(moves) != 1 or not moves < both:
        return None if rest.strip(" .,!") else f"leave {groups['far']} between {pair.mention.text}"
    names = labels([*moves, *(both - moves)], scene, lexicon)
    mover, mark = (names[o] for o in (*moves, *(both - moves)))
    return f"put {mover} {groups['far']} from {mark}"


def _goes(
    said: re.Match[str], shape: Frame, linked: Linked, scene: Scene, lexicon: Lexicon
) -> str | None:
    groups = said.groupdict()
    rest = groups["rest"]
    if _says_more(rest):
        return None
    if groups.get("mover"):
        mover, mark = shape.among(groups["mover"])[0], shape.among(groups["mark"])[0]
    elif groups.get("both"):
        return _of_a_pair(groups, rest, shape, scene, lexicon)
    else:
        pair = shape.among(groups["one"])[0], shape.among(groups["other"])[0]
        if any(not settles(one.mention) for one in pair):
            return None
        mover, mark = _moving(rest, pair, shape, scene)
    if not (settles(mover.mention) and settles(mark.mention)):
        return None
    if mover.mention.objects == mark.mention.objects:
        return None
    far = groups["far"]
    where = groups.get("where") or _side(rest, mover, mark, shape)
    where = {"beside": "", "next to": ""}.get(where, where)
    names = [
        linked.text[linked.tokens[one.opened].start : one.mention.end] for one in (mover, mark)
    ]
    return f"put {names[0]} {far} {where or 'from'} {names[1]}"


def _says_more(rest: str) -> bool:
    """Whether what follows the distance is more than who moves, on which side, and talk."""
    for known in (_SIDE, _ONLY, _NOT, _TALK):
        rest = known.sub(" ", rest)
    return bool(rest.strip())


def _moving(
    rest: str, pair: tuple[Spoken, Spoken], shape: Frame, scene: Scene
) -> tuple[Spoken, Spoken]:
    """Which of the two moves, and the other: the one that is said to, else the smaller one."""
    one, other = pair
    told, still = _ONLY.search(rest), _NOT.search(rest)
    moves = set(shape.among(told["mover"])[0].mention.objects) if told is not None else set()
    stays = set(shape.among(still["still"])[0].mention.objects) if still is not None else set()
    if moves & set(other.mention.objects) or stays & set(one.mention.objects):
        return other, one
    if moves & set(one.mention.objects) or stays & set(other.mention.objects):
        return one, other
    sizes = [scene.get(each.mention.objects[0]) for each in pair]
    small = [item.width * item.height for item in sizes]
    return (one, other) if small[0] <= small[1] else (other, one)


def _side(rest: str, mover: Spoken, mark: Spoken, shape: Frame) -> str:
    """ "..., the cup on the right": to the right of the other."""
    said = _SIDE.search(rest)
    if said is None:
        return ""
    who = set(shape.among(said["who"])[0].mention.objects)
    side = said["side"]
    if who & set(mark.mention.objects):
        side = {"left": "right", "right": "left"}[side]
    elif not who & set(mover.mention.objects):
        return ""
    return f"to the {side} of"

"""Which one is meant, said by which one is not: "not the red mug, the other one. Put it there".

What is meant is settled on the scene and takes the place of the contrast, or of the pronoun that
goes on from it. Where that is not one thing, the sentence stays as it is.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from agent.messages import Focus
from clarifier.ask import labels
from clarifier.denied_places import marked, put_last
from clarifier.frame import Frame, frame
from clarifier.lexicon import Lexicon
from clarifier.mentions import link
from clarifier.spoken import Linked, Spoken
from scene.types import Scene

_NO = (
    r"(?:(?:no |and |but |oh |it's |it is |@\d+ is )*(?:i (?:do not|don't) (?:mean|want)|not|"
    r"instead of|rather than|"
    r"never))"
)
_YES = r"(?:(?:no |but |rather |i (?:mean|meant|want|wanted) |just |that is |it's |only )*)"
_PART = r"(?: (?:[,.!;:()-]|that is|i mean))*"
_CONTRAST = re.compile(
    rf"(?P<lead>^|"
    rf"(?<= ))(?P<whole>(?:#\d+{_PART} {_YES})*(?:(?:{_NO} #\d+(?: (?:that )?i (?:want|mean|"
    rf"meant)(?: moved)?)?{_PART} {_YES}#\d+)|"
    rf"(?:#\d+{_PART} {_NO} #\d+))(?:{_PART} (?:{_NO} |{_YES})#\d+)*"
    rf"(?:{_PART} the other(?: one)?)?(?: \))?)(?= |$)"
)
_LATE = re.compile(r"(?: [,.;!])+ (?:(?:but|and|just|only) )*not (?P<no>#\d+)(?: [.!])*$")
_ONLY = re.compile(
    r"^(?:please |now |ok |and |so )*(?:do not|don't|dont|never) (?P<verb>put|place|move|push|lay|"
    r"set|stand|stack|drop|stick|pop|"
    r"bring) (?P<denied>#\d+) (?P<where>[^#@,.;]+(?:#\d+)?)(?: [,.;])? "
    r"(?:but )?(?:only|just|rather|instead|but) (?P<other>#\d+)(?: please| instead)?(?: [.!])?$"
)
_DENIED = re.compile(rf"{_NO} (#\d+)")
_GOES_ON = re.compile(r"^ ?(?:[,.!;:-] ?)+")
_POINTS = re.compile(r"^[^.;!?]*?(?P<it>@\d+)")


def settled_contrast(text: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> str:
    """The sentence with what it tells apart by a contrast named, a place that it denies put
    behind another; as it was where it has neither."""
    denying = marked(text)
    elsewhere = put_last(link(denying, scene, focus, lexicon))
    if elsewhere is not None:
        return elsewhere
    linked = link(text, scene, focus, lexicon)
    shape = frame(linked)
    instead = _done_with_another(linked, shape)
    if instead is not None:
        return instead
    said = _CONTRAST.search(shape.text)
    if said is None:
        return _said_late(linked, shape, scene, lexicon) or text
    meant = _meant(said["whole"], shape)
    if meant is None:
        return _said_late(linked, shape, scene, lexicon) or text
    name = labels([meant], scene, lexicon)[meant]
    return _named(meant, name, said, shape, linked, lexicon) or text


def _done_with_another(linked: Linked, shape: Frame) -> str | None:
    """ "Don't put the red mug on the tray, only the blue one": put the blue one on the tray."""
    said = _ONLY.match(shape.text)
    if said is None:
        return None
    (other,), (denied,) = shape.among(said["other"]), shape.among(said["denied"])
    if not other.mention.objects or set(other.mention.objects) & set(denied.mention.objects):
        return None
    name = linked.text[linked.tokens[other.opened].start : other.mention.end]
    first, last = shape.token(said.start("where")), shape.token(said.end("where")) - 1
    where = linked.text[linked.tokens[first].start : linked.tokens[last].end]
    return f"{said['verb']} {name} {where.strip(' ,.;')}"


def _meant(said: str, shape: Frame) -> str | None:
    """The one thing that a contrast leaves."""
    no = [shape.among(one)[0] for one in _DENIED.findall(said)]
    yes = [one for one in shape.among(said) if one not in no]
    if (
        not yes
        or any(not one.mention.objects for one in no)
        or any(one.relation not in ("", "than") for one in no + yes)
    ):
        return None
    if any(one.mention.plural or one.mention.free for one in yes):
        return None
    told = [one for one in yes if one.phrase is not None and one.phrase.head]
    kin = [one for one in no if one.phrase is not None and one.phrase.head]
    pool = set(told[0].mention.objects if told else yes[0].mention.objects)
    pool &= set(kin[0].same_type) if kin and not told else pool
    out = {o for one in no for o in one.mention.objects} if _one_kind(told, no) else set()
    for one in yes:
        agreed = pool & set(one.mention.objects)
        other = one.phrase is not None and "other" in one.mention.text.lower().split()
        if not agreed and not other:
            return None  # another thing, not the same one said again
        pool = agreed or pool
    left = pool - out
    return next(iter(left)) if len(left) == 1 else None


def _said_late(linked: Linked, shape: Frame, scene: Scene, lexicon: Lexicon) -> str | None:
    """ "The mug next to the bowl. Not the red mug": the blue mug next to the bowl."""
    said = _LATE.search(shape.text)
    if said is None:
        return None
    (no,) = shape.among(said["no"])
    for one in shape.among(shape.text[: said.start()]):
        left = [o for o in one.mention.objects if o not in no.mention.objects]
        many = len(one.mention.objects) > 1 and not one.mention.plural and not one.mention.free
        if one.theme and many and len(left) == 1 and len(left) < len(one.mention.objects):
            name = labels(left, scene, lexicon)[left[0]]
            start, end = linked.tokens[one.opened].start, one.mention.end
            last = linked.tokens[shape.token(said.start())].start
            return f"{linked.text[:start]}{name}{linked.text[end:last].rstrip(' ,.;!')}"
    return None


def _one_kind(told: Sequence[Spoken], no: Sequence[Spoken]) -> bool:
    """Whether what is denied leaves something of what is meant."""
    every = {o for one in told for o in one.mention.objects}
    return not told or bool(every - {o for one in no for o in one.mention.objects})


def _named(
    meant: str, name: str, said: re.Match[str], shape: Frame, linked: Linked, lexicon: Lexicon
) -> str | None:
    """The sentence with the name in place of the contrast, or of "it" behind it."""
    first, last = shape.token(said.start("whole")), shape.token(said.end())
    behind = shape.text[said.end() :]
    before = linked.text[: linked.tokens[first].start]
    apart = _GOES_ON.match(behind)
    begins = not any(character.isalnum() for character in before)
    if begins and not any(character.isalnum() for character in behind):
        return None  # an answer, or a correction
    if begins and apart is not None:
        points = _POINTS.match(behind[apart.end() :])
        if points is not None:
            (it,) = shape.among(points["it"])
            apart_from_it = it.relation and meant not in it.mention.objects
            if "#" in points[0] and it.mention.objects != (meant,) and not apart_from_it:
                return None
            start = linked.tokens[shape.token(said.end() + apart.end())].start
            return f"{linked.text[start : it.mention.start]}{name}{linked.text[it.mention.end :]}"
        if _told_at(last, linked, lexicon):
            return None
    end = linked.tokens[last - 1].end
    rest = linked.text[end:]
    if apart is not None and any(character.isalnum() for character in rest):
        rest = f" {rest.lstrip(' ,.!;:-')}"
    return f"{before}{name}{rest}"


def _told_at(at: int, linked: Linked, lexicon: Lexicon) -> bool:
    """Whether somebody is told to do something behind the marks at a token; "goes" tells nobody."""
    chunks = [c for c in linked.chunks if c.first >= at and c.kind != "joint"]
    return bool(chunks) and linked.tokens[chunks[0].first].text in lexicon.base_verbs

"""What follows a command and says no more than where else, which way, how much: "far edge it is",
"a touch nearer to me", "more", "three of them back again".

Each is put into a whole sentence about what was moved last; None where a sentence is none of these.
"""

from __future__ import annotations

import re

from agent.messages import Dialog
from clarifier.answer_parts import parts_of, without_chatter
from clarifier.going_on import way_of
from clarifier.lexicon import Lexicon
from clarifier.mentions import link
from clarifier.rewrite import elsewhere
from clarifier.same_again import unit_before
from clarifier.whereto import with_preposition
from clarifier.words import words
from scene.types import Scene

_LEAD = re.compile(r"^(?:(?:hm+|um+|er+m?|oh|ah|well|ok|okay|and|now|but|so)\b[\s,.!…]*)+", re.I)
_MORE = re.compile(
    r"^\W*(?:(?:way|much|lots?|a lot|far|even|some|like|and|please|keep going|go on|still|yes|"
    r"a (?:little )?bit|a little|more)\b\W*)*\b(?:more|further|farther|keep going)\b"
    r"(?:[\s,!.]+(?:like|way|much|please|more|far|further|farther|still|yet|than that))*\W*$",
    re.IGNORECASE,
)
_SLIGHT = frozenset(
    {"a", "an", "little", "bit", "touch", "tad", "smidge", "hair", "shade", "slightly", "just"}
    | {"tiny", "wee", "lot", "much", "more", "some", "way", "please", "then", "again", "further"}
    | {"to", "me", "you", "the", "my", "your", "from", "of", "towards", "toward", "i", "think"}
    | {"maybe", "perhaps", "guess", "though", "even", "still", "there", "yes", "ok", "is", "it"}
    | {"that"}
)
"""Words beside a direction that name nothing."""
_BACK = re.compile(
    r"\b(?P<number>\d+(?:\.\d+)?|half|one|two|three|four|five|six|seven|eight|nine|ten|twelve|"
    r"fifteen|twenty) (?:of (?:them|those|these|it) )?back(?: again)?(?:[\s,]+(?:then|please|now|"
    r"too))*\W*$",
    re.IGNORECASE,
)
_OPPOSITE = (
    ("left", "right"), ("away from", "towards"), ("leftward", "right"), ("rightward", "left"),
    ("forward", "back"), ("up", "down"),
)  # fmt: skip


def followed_up(text: str, dialog: Dialog, scene: Scene, lexicon: Lexicon) -> str | None:
    """The whole sentence that a follow-up stands for."""
    if dialog.last_text is None or not dialog.focus:
        return None
    bare = _LEAD.sub("", text)
    return _more(bare, dialog, scene) or _back(bare, dialog, scene, lexicon) or _on(
        bare, scene, lexicon
    )  # fmt: skip


def placed_instead(text: str, scene: Scene, lexicon: Lexicon) -> str | None:
    """ "far edge it is", "the middle of the table is better", "between the two, it looks nicer",
    said instead of the place before: put it there."""
    parts = parts_of(text)
    if not parts or any(_acts(part, scene, lexicon) for part in parts):
        return None
    core = without_chatter(parts[0])
    linked = link(core, scene, (), lexicon)
    places = [chunk for chunk in linked.chunks if chunk.kind == "place"]
    if len(places) == 1 and not linked.spoken and places[0].last >= len(linked.tokens):
        lead = {token.text for token in linked.tokens[: places[0].first]}
        led = any(chunk.kind == "relation" for chunk in linked.chunks) or lead & {"in", "on", "at"}
        if led or not lead - {"the", "my", "your"}:
            return f"put it {core if led else with_preposition(core, 'where')}"
    return elsewhere(core, scene, lexicon)


def _more(text: str, dialog: Dialog, scene: Scene) -> str | None:
    """ "More! Like way more": the same again."""
    return dialog.last_text if _MORE.match(text) else None


def _back(text: str, dialog: Dialog, scene: Scene, lexicon: Lexicon) -> str | None:
    """ "Three of them back again", behind eight centimetres to the left: to the right."""
    said = _BACK.search(text)
    last = dialog.last_text or ""
    unit, way = unit_before(last), way_of(link(last, scene, (), lexicon), lexicon)
    if said is None or not unit or not way or _acts(text, scene, lexicon):
        return None
    other = _turned(way.lower())
    return None if other is None else f"push it {said['number']} {unit} {other}"


def _turned(way: str) -> str | None:
    for one, two in _OPPOSITE:
        for here, there in ((one, two), (two, one)):
            if re.search(rf"\b{here}(?:s|wards?)?\b", way):
                return re.sub(rf"\b{here}(?:s|wards?)?\b", there, way)
    return None


def _on(text: str, scene: Scene, lexicon: Lexicon) -> str | None:
    """ "a touch nearer to me, I think": that, of what was moved last."""
    core = without_chatter((parts_of(text) or ("",))[0])
    linked = link(core, scene, (), lexicon)
    directions = lexicon.words("directions") - {"off", "over", "out", "around", "round", "home"}
    said = set(words(core))
    vague = said & {"bit", "touch", "tad", "smidge", "hair", "shade", "slightly", "little"}
    if not said & directions or not vague or not said <= directions | _SLIGHT or linked.spoken:
        return None
    return f"move it {core}"


def _acts(part: str, scene: Scene, lexicon: Lexicon) -> bool:
    """Whether a part asks for something to be done to a thing."""
    linked = link(part, scene, (), lexicon)
    named = any(one.mention.objects for one in linked.spoken)
    return named and any(chunk.kind == "verb" for chunk in linked.chunks)

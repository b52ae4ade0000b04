"""What a sentence says as the answer to an open question."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from agent.messages import Option, Pending
from clarifier.act import strip_courtesy
from clarifier.cautions import link_deed
from clarifier.corrections import behind
from clarifier.gist import gist_of, number_in
from clarifier.lexicon import Lexicon
from clarifier.mentions import link_answer
from clarifier.pieces import Phrase
from clarifier.reference import Context, denote
from clarifier.roles import Gap, find_gap
from clarifier.spoken import Linked, Spoken
from clarifier.things import is_attribute, side_of
from clarifier.words import number, words
from scene.types import Scene

AnswerKind = Literal["pick", "none", "any", "both", "again", "unclear", "thing", "words", "other"]
_ARTICLES = frozenset({"the", "a", "an", "my", "that", "this", "please"})
_OBJECT_QUESTIONS = frozenset({"which", "missing", "unknown_word", "how_many", "confirm"})
_DENIES = re.compile(r"\b(?:not|isn't|don't (?:like|want|mean)|(?:is )?wrong|except)\b")
_SIDE_OPENING = re.compile(r"^(?:on|at|to|in|by|near|next|beside|with|behind|closest|nearest)\b")


@dataclass(frozen=True)
class Answer:
    """``pick``: option ``index``. ``thing``: names a thing that was no option (``text``).
    ``words``: fills an open role with ``text``. ``unclear``: meant as an answer, fits no option.
    ``other``: no answer at all."""

    kind: AnswerKind
    index: int = -1
    text: str = ""


def read_answer(text: str, pending: Pending, scene: Scene, lexicon: Lexicon) -> Answer:
    """What the sentence says in answer to the question."""
    reader = _Reader(pending, scene, lexicon)
    return reader.read(text)


class _Reader:
    def __init__(self, pending: Pending, scene: Scene, lexicon: Lexicon) -> None:
        self._text = pending.text
        self._kind = pending.question.kind
        self._options = pending.question.options
        self._scene = scene
        self._lexicon = lexicon

    def read(self, text: str) -> Answer:
        said = words(strip_courtesy(text)) or words(text)
        plain = " ".join(said)
        for answer in (
            self._set_phrase(plain), self._denied(text), self._label(plain),
            self._position(said), self._gist(" ".join(words(text)), said),
        ):  # fmt: skip
            if answer is not None:
                return answer
        instead = behind(text)
        if instead is not None and instead != text:
            return self.read(instead)
        if said and said[0] in ("no", "nope", "yes", "yeah", "yep", "not", "actually", "wait"):
            return self.read(" ".join(self._behind_no(said)))
        about_things = self._kind in _OBJECT_QUESTIONS
        if self._commands(words(_described(said)) if about_things else said):
            return Answer("other")
        if about_things:
            return self._thing(plain, said)
        return self._place(plain, said)

    def _behind_no(self, said: Sequence[str]) -> Sequence[str]:
        rest = list(said)
        while rest and rest[0] in ("no", "nope", "yes", "yeah", "yep", "wait", "actually", "not"):
            rest = rest[1:]
        return rest

    # --- fixed phrases, labels, numbers ------------------------------------------------------

    def _set_phrase(self, plain: str) -> Answer | None:
        lists = self._lexicon.words
        single = len(self._options) == 1
        if plain in lists("again"):
            return Answer("again")
        if plain == "right" and not single:
            return None
        if plain in lists("yes") and not self._options and self._kind == "how_many":
            return Answer("both")
        sure = {word for phrase in lists("yes") for word in phrase.split()} - {"that", "one", "it"}
        if plain in lists("yes") or (plain and set(plain.split()) <= sure):
            return Answer("pick", 0) if single else Answer("again")
        if plain in lists("no") or plain in lists("neither"):
            return Answer("none")
        if plain in lists("any") and self._options:
            return Answer("any", self._first_with_program())
        if plain in lists("both") and not self._asks_number:
            return Answer("both")
        return None

    def _gist(self, plain: str, said: Sequence[str]) -> Answer | None:
        """What a whole sentence comes to, where it is no command of its own."""
        place = number_in(plain)
        if place is not None:
            return self._position((place,)) or self._position(("option", place))
        if self._kind == "confirm" and self._agrees(said):
            return Answer("pick", 0)
        gist = gist_of(plain) if self._kind in _OBJECT_QUESTIONS and self._options else None
        if gist == "any":
            return Answer("any", self._first_with_program())
        if gist == "both" and (self._asks_number or len(self._options) < 2):
            return None
        return None if gist is None else Answer(gist)

    def _agrees(self, said: Sequence[str]) -> bool:
        """ "ok, do the apple then": a yes that denies nothing and names nothing else."""
        yes = {word for phrase in self._lexicon.words("yes") for word in phrase.split()[:1]}
        if (
            not said
            or said[0] not in yes | {"fair", "alright", "well"}
            or {"not", "no", "wrong", "incorrect", "false"} & set(said)
        ):
            return False
        linked = link_answer(" ".join(said), self._scene, self._lexicon)
        named = {o for one in linked.spoken for o in one.mention.objects}
        return len(self._options) == 1 and named <= set(self._options[0].touched)

    def _denied(self, text: str) -> Answer | None:
        """ "not the red one, the other one": of two the one that is not denied."""
        if len(self._options) != 2 or self._kind not in _OBJECT_QUESTIONS:
            return None
        parts = [
            part for part in re.split(r"[,.;!?]|\band\b|\bbut\b", text.lower()) if part.strip()
        ]
        other = any("the other" in part for part in parts)
        denies = [part for part in parts if _DENIES.search(part)]
        if not other and not denies:
            return None
        ids = tuple(o for option in self._options for o in option.objects)
        wrong: set[str] = set()
        for part in parts if other and not denies else denies:
            core = _DENIES.sub(" ", part).replace("the other one", " ").replace("the other", " ")
            wrong |= set(self._among(" ".join(self._without_choosing(words(core))), ids))
        left = [i for i, o in enumerate(self._options) if not wrong & set(o.objects)]
        if not left or (not wrong and behind(text) is not None):
            return None  # what is said instead is read on its own
        return Answer("pick", left[0]) if wrong and len(left) == 1 else Answer("unclear")

    @property
    def _asks_number(self) -> bool:
        return self._kind == "how_many" and len(self._options) > 1

    def _first_with_program(self) -> int:
        return next((i for i, option in enumerate(self._options) if option.program), 0)

    def _label(self, plain: str) -> Answer | None:
        """A label in full or without its article, or the one label that holds all words said."""
        bare = _bare(plain)
        counts = [i for i, o in enumerate(self._options) if self._counted(o, bare)]
        if len(counts) == 1:
            return Answer("pick", counts[0])
        exact = [i for i, o in enumerate(self._options) if _bare(o.label) == bare]
        if len(exact) == 1:
            return Answer("pick", exact[0])
        inside = [i for i, o in enumerate(self._options) if _bare(o.label) in bare]
        rest = set(bare.split()) - self._lexicon.words("choosing")
        if len(inside) == 1 and rest <= set(_bare(self._options[inside[0]].label).split()):
            return Answer("pick", inside[0])
        if any(option.target is not None or not option.objects for option in self._options):
            return self._place_label(rest)
        return None

    def _counted(self, option: Option, bare: str) -> bool:
        """Whether "3", "three of them", "all" mean this option of a question for a number."""
        if not self._asks_number:
            return False
        if bare in self._lexicon.words("both"):
            return option is self._options[-1]
        if bare.startswith("option "):
            return False
        said = [n for word in bare.split() if (n := number(word)) is not None]
        if bare in ("couple", "couple of them", "pair"):
            said = [2.0]
        return said == [float(len(option.objects))]

    def _place_label(self, rest: set[str]) -> Answer | None:
        """ "the middle" for "in the middle of the table"."""
        rest = rest - {"one", "side", "table", "of", "the"}
        holders = [i for i, o in enumerate(self._options) if rest <= set(words(o.label))]
        return Answer("pick", holders[0]) if rest and len(holders) == 1 else None

    def _position(self, said: Sequence[str]) -> Answer | None:
        """ "2", "b", "second", "the last one", "option two", "number 1"."""
        if self._options and len(said) == 1 and len(said[0]) == 1 and said[0].isalpha():
            return self._at("abcdefghijklm".find(said[0]))
        core = [w for w in said if w not in self._lexicon.words("choosing") or w in ("one", "a")]
        bare = [w for w in core if w not in _ARTICLES and w not in ("one", "ones")]
        if not self._options or len(bare) > 1:
            return None
        if not bare:
            return self._at(0) if list(said) in (["one"], ["number", "one"], ["option", "one"]) \
                else None  # fmt: skip
        if len(bare) == 1 and number(bare[0]) is not None and bare[0] not in ("zero", "0"):
            return self._at(int(number(bare[0]) or 0) - 1)
        ranks = {"former": 0, "latter": 1, "last": len(self._options) - 1}
        ranks |= {w: i for i, w in enumerate(("first", "second", "third", "fourth", "fifth",
                                              "sixth"))}  # fmt: skip
        ranks |= {"1st": 0, "2nd": 1, "3rd": 2, "4th": 3}
        return self._at(ranks[bare[0]]) if bare[0] in ranks else None

    def _at(self, index: int) -> Answer:
        good = 0 <= index < len(self._options)
        return Answer("pick", index) if good else Answer("unclear")

    # --- new commands ------------------------------------------------------------

    def _commands(self, said: Sequence[str]) -> bool:
        """Whether the sentence has a verb of its own that is more than "take the ..."."""
        for at, word in enumerate(said):
            verb = self._lexicon.verb(word)
            if verb is None or self._lexicon.is_noun(word) or word in ("left", "right"):
                continue
            if at and said[at - 1] in _ARTICLES:
                continue
            if word in self._lexicon.words("choosing"):
                continue
            return True
        return False

    # --- things ------------------------------------------------------------

    def _thing(self, plain: str, said: Sequence[str]) -> Answer:
        """A description of one option, or of another thing on the scene."""
        core = self._without_choosing(said)
        told = self._told(plain) if self._kind == "unknown_word" else None
        if told is not None:
            return told
        ids = tuple(dict.fromkeys(o for option in self._options for o in option.objects))
        if any(len(option.objects) > 1 for option in self._options):
            return self._group(" ".join(core), ids)
        sides = " ".join(word for word in said if side_of(word, self._lexicon))
        tried = [self._among(text, ids) for text in (" ".join(core), _described(core), sides)]
        found = next((found for found in tried if len(found) == 1), tried[0] or tried[1])
        if len(found) == 1:
            index = next(i for i, o in enumerate(self._options) if found[0] in o.objects)
            return Answer("pick", index)
        if len(found) > 1:
            return Answer("unclear")
        outside = _first(link_answer(_determined(" ".join(core)), self._scene, self._lexicon))
        if outside is not None and outside.mention.objects and outside.phrase is not None:
            return Answer("thing", text=outside.mention.text)
        if outside is not None and outside.phrase is not None and outside.phrase.known:
            return Answer("unclear")
        return Answer("other")

    def _told(self, plain: str) -> Answer | None:
        """ "glorp is what I call the sponge": the one thing named that is known."""
        spoken_of = link_answer(plain, self._scene, self._lexicon).spoken
        named = {one.mention.objects: one for one in spoken_of if one.mention.objects}
        if len(named) != 1:
            return None
        ((objects, spoken),) = named.items()
        fits = [i for i, o in enumerate(self._options) if o.objects == objects]
        return Answer("pick", fits[0]) if fits else Answer("thing", text=spoken.mention.text)

    def _group(self, core: str, ids: tuple[str, ...]) -> Answer:
        """The option that holds exactly the things said: "the red and the green one"."""
        said: set[str] = set()
        for part in re.split(r",|\band\b", core):
            said |= set(self._among(part.strip(), ids)) if part.strip() else set()
        fits = [i for i, o in enumerate(self._options) if set(o.objects) == said]
        return Answer("pick", fits[0]) if fits else Answer("unclear")

    def _without_choosing(self, said: Sequence[str]) -> list[str]:
        """The words without "I mean", "take", ...; what follows a relation stays whole."""
        choosing = self._lexicon.words("choosing") - {"one", "the", "on", "at", "in", "by", "with"}
        at = 0
        while at < len(said) and said[at] in choosing:
            at += 1
        return list(said[at:])

    def _among(self, core: str, ids: tuple[str, ...]) -> tuple[str, ...]:
        """The options that a description fits."""
        if not ids or not core:
            return ()
        adjectives = [w for w in words(core) if w not in _ARTICLES | {"one", "on", "at", "in", "to",
                      "side", "hand", "of", "it", "is", "its", "bit"}]  # fmt: skip
        if adjectives and all(self._adjective(word) for word in adjectives):
            phrase = Phrase(0, 0, 0, "the", None, tuple(adjectives), ())
            return denote(phrase, Context(self._scene, self._lexicon, among=ids)).objects
        if _SIDE_OPENING.match(core):
            core = f"the one {core}"
        spoken = _first(link_answer(_determined(core), self._scene, self._lexicon, ids))
        if spoken is None or spoken.phrase is None:
            return ()
        found = spoken.mention.objects
        if spoken.phrase.det == "other":
            return ()
        return tuple(o for o in found if o in ids)

    def _adjective(self, word: str) -> bool:
        ordinal = word in self._lexicon.words("ordinals")
        return is_attribute(word, self._lexicon) or bool(side_of(word, self._lexicon)) or ordinal

    # --- places and directions ------------------------------------------------------------

    def _place(self, plain: str, said: Sequence[str]) -> Answer:
        """Free words for a place, a direction or an angle."""
        core = " ".join(self._without_choosing(said))
        linked = link_answer(core, self._scene, self._lexicon)
        if not linked.chunks:
            return Answer("other")
        head = linked.chunks[0]
        first = linked.tokens[0].text
        if head.kind == "relation" and len(linked.chunks) > 1:
            return Answer("words", text=core)
        gap = self._gap() if self._kind == "where" else None
        if gap is not None and (gap.lead or gap.anchor is not None):
            return self._begun(core, linked, gap)
        if head.kind == "relation":
            return Answer("words", text=core)
        if self._kind == "open":
            measured = number(first) is not None or first[:1].isdigit() or first in (
                "a", "half", "quarter", "by", "halfway", "clockwise", "upside", "around"
            )  # fmt: skip
            return Answer("words", text=_by(core)) if measured else self._side(core, linked)
        return self._side(core, linked)

    def _gap(self) -> Gap | None:
        """What the sentence that was asked about lacks."""
        return find_gap(link_deed(self._text, self._scene, (), self._lexicon), self._lexicon)

    def _begun(self, core: str, linked: Linked, gap: Gap) -> Answer:
        """The rest of a place that the sentence begins: "the box" behind "next to", or the side of
        a thing."""
        named = linked.spoken[:1] and linked.spoken[0].mention.objects
        if gap.lead:
            thing = linked.chunks[0].kind in ("np", "pronoun") and named
            place = linked.chunks[0].kind == "place"
            text = f"{gap.lead} {_determined(core)}" if thing else _with_preposition(core, "where")
            return Answer("words", text=text) if thing or place else Answer("unclear")
        assert gap.anchor is not None
        if linked.spoken:
            return Answer("unclear")
        said = [w for w in words(core) if w not in _ARTICLES | {"side", "hand", "of", "it", "one"}]
        fits = [i for i, o in enumerate(self._options) if set(said) <= set(words(o.label))]
        if said and len(fits) == 1:
            return Answer("pick", fits[0])
        side = f"on the {' '.join(said)} side of the {gap.anchor.mention.text}"
        known = len(said) == 1 and side_of(said[0], self._lexicon)
        return Answer("words", text=side) if known else Answer("unclear")

    def _side(self, core: str, linked: Linked) -> Answer:
        """A place without its preposition, a direction, or a thing to put it in or on."""
        head, first = linked.chunks[0], linked.tokens[0].text
        if head.kind == "place":
            return Answer("words", text=_with_preposition(core, self._kind))
        if first in self._lexicon.words("directions"):
            return Answer("words", text=core)
        if head.kind == "np" and linked.spoken and linked.spoken[0].mention.objects:
            spoken = linked.spoken[0]
            noun = spoken.phrase.head[-1] if spoken.phrase and spoken.phrase.head else ""
            way = self._lexicon.goes(noun)
            if self._kind == "where" and way is not None and len(linked.spoken) == 1:
                return Answer("words", text=f"{way} {_determined(core)}")
            if self._kind == "direction":
                return Answer("words", text=f"towards {_determined(core)}")
            return Answer("unclear")
        return Answer("other")


def _described(core: Sequence[str]) -> str:
    """ "I mean the apple that is sitting close to the plate" as "the apple near the plate"."""
    said = re.split(r"\bi(?:'d)? (?:mean|meant|said|want|wanted|like|think)\b", " ".join(core))[-1]
    plain = re.sub(
        r"\b(?:that|which|what)(?: one)?(?:'s| is| are| stands| sits| lies)?\b|"
        r"\b(?:sitting|standing|lying|placed|located|over there|there|hand)\b", " ", said,
    )  # fmt: skip
    plain = plain if re.search(r"\b(?:the|one|\w+s?)\b", plain) else said
    return " ".join(re.sub(r"\b(?:close|near|next) (?:to|by)\b", "nearest to", plain).split())


def _bare(text: str) -> str:
    said = [w for w in words(text) if w not in _ARTICLES]
    return " ".join(said)


def _first(linked: Linked) -> Spoken | None:
    return linked.spoken[0] if linked.spoken else None


def _determined(core: str) -> str:
    """The text with "the" before it if it has no determiner."""
    first = core.split()[0] if core.split() else ""
    known = _ARTICLES | {"any", "all", "both", "your", "its", "these", "those", "one", "on", "at"}
    return core if first in known else f"the {core}"


def _with_preposition(core: str, kind: str) -> str:
    """ "left" -> "to the left" (direction) or "on the left side of the table" (place)."""
    said = words(core)
    text = core if said[0] in ("the", "your", "my") else f"the {core}"
    if kind == "direction":
        return f"to {text}"
    if {"corner", "middle", "centre", "center"} & set(said):
        return f"in {text}"
    if set(said) <= {"the", "left", "right"}:
        return f"on {text} side of the table"
    return f"on {text}" if "side" in said or "table" in said else f"at {text}"


def _by(core: str) -> str:
    return (
        core if core.startswith(("by", "a ", "half", "clock", "upside", "around")) else f"by {core}"
    )

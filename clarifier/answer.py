"""What a sentence says as the answer to an open question."""

from __future__ import annotations

import re
from collections.abc import Sequence

from agent.messages import BY_HAND, Pending
from clarifier.act import strip_courtesy
from clarifier.answer_parts import answering_part, without_chatter
from clarifier.asked import ARTICLES, Answer, determined
from clarifier.corrections import behind
from clarifier.gist import gist_of, number_in
from clarifier.lexicon import Lexicon
from clarifier.mentions import link_answer
from clarifier.picking import OBJECT_QUESTIONS, Picking
from clarifier.things import side_of
from clarifier.whereto import WhereTo, until_met
from clarifier.words import listing, singular, words
from scene.types import Scene

_HAND = re.compile(
    r"(?:i|i've|i have) (?:just |already )*(?:moved|put|did|done|placed|fixed|set|took)\b|done\b"
)
"""How a person says that they saw to it themselves."""
_LISTED = re.compile(r"[,;.!?]|\band\b|\bplus\b")
_COUNTED = re.compile(r"\bfrom (?:the )?(?:left|right|front|back)(?: side)?\b")
_ORDINAL = re.compile(r"(?:the )?(?:first|second|third|fourth|fifth|sixth|last)(?: one)?")


def read_answer(text: str, pending: Pending, scene: Scene, lexicon: Lexicon) -> Answer:
    """What the sentence says in answer to the question."""
    reader = _Reader(pending, scene, lexicon)
    return reader.read(text)


class _Reader(Picking, WhereTo):
    """Reads an answer: what is fixed first, then what tells an option apart, then free words."""

    def read(self, text: str) -> Answer:
        """The answer that the whole text gives, else what one part of it does."""
        answer = self._whole(text)
        if self._kind in ("confirm", "how_many") or answer.kind not in ("other", "unclear"):
            return answer
        if self._asks_bottom or any(len(option.objects) > 1 for option in self._options):
            return answer
        return answering_part(text, self._whole, self._deed, self._lexicon) or answer

    def _deed(self, part: str) -> Answer:
        """ "other" for a part of an answer that asks for something to be done to a thing."""
        said = words(part)
        named = link_answer(part, self._scene, self._lexicon).spoken
        asks = self._commands(said) and any(one.mention.objects for one in named)
        return Answer("other" if asks else "unclear")

    def _whole(self, text: str) -> Answer:
        said = words(strip_courtesy(text)) or words(text)
        plain = " ".join(said)
        for answer in (
            self._by_hand(plain), self._set_phrase(plain), self._on_top(said),
            self._denied(text), self._label(plain), self._position(said), self._listed(text),
            self._gist(" ".join(words(text)), said),
        ):  # fmt: skip
            if answer is not None:
                return answer
        instead = behind(text)
        if instead is not None and instead != text:
            return self._whole(instead)
        if said and said[0] in ("no", "nope", "yes", "yeah", "yep", "not", "actually", "wait"):
            return self._whole(" ".join(self._behind_no(said)))
        about_things = self._kind in OBJECT_QUESTIONS
        ends = not about_things and until_met(plain)
        if not ends and self._commands(words(_described(said)) if about_things else said):
            return Answer("other")
        if about_things:
            return self._thing(text, plain, said)
        bare = without_chatter(strip_courtesy(text) or text)
        return self._place(" ".join(words(bare)), words(bare)) if bare else self._place(plain, said)

    def _behind_no(self, said: Sequence[str]) -> Sequence[str]:
        rest = list(said)
        while rest and rest[0] in ("no", "nope", "yes", "yeah", "yep", "wait", "actually", "not"):
            rest = rest[1:]
        return rest

    def _by_hand(self, plain: str) -> Answer | None:
        """ "I put it back myself", where that is one of the options."""
        labels = [option.label for option in self._options]
        if BY_HAND in labels and _HAND.match(plain):
            return Answer("pick", labels.index(BY_HAND))
        return None

    def _set_phrase(self, plain: str) -> Answer | None:
        lists = self._lexicon.words
        single = len(self._options) == 1 or (self._kind == "confirm" and bool(self._options))
        if self._kind == "confirm" and plain in (option.label.lower() for option in self._options):
            return None  # "try again" is a label here, no wish to hear the question once more
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
        if self._kind == "confirm" and self._agrees(plain.split()):
            return Answer("pick", 0)
        gist = gist_of(plain) if self._kind in OBJECT_QUESTIONS and self._options else None
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
            or said[0] not in yes | {"fair", "alright", "well", "good", "great"}
            or {"not", "no", "wrong", "incorrect", "false"} & set(said)
        ):
            return False
        linked = link_answer(" ".join(said), self._scene, self._lexicon)
        if not self._options:
            return False
        named = [set(one.mention.objects) for one in linked.spoken if one.mention.objects]
        return all(objects & set(self._options[0].touched) for objects in named)

    def _first_with_program(self) -> int:
        return next((i for i, option in enumerate(self._options) if option.program), 0)

    def _commands(self, said: Sequence[str]) -> bool:
        """Whether the sentence has a verb of its own that is more than "take the ..."."""
        for at, word in enumerate(said):
            verb = self._lexicon.verb(word)
            if verb is None or self._lexicon.is_noun(word) or word in ("left", "right"):
                continue
            if at and said[at - 1] in ARTICLES:
                continue
            if word in self._lexicon.words("choosing"):
                continue
            return True
        return False

    def _thing(self, text: str, plain: str, said: Sequence[str]) -> Answer:
        """A description of one option, or of another thing on the scene."""
        core = self._without_choosing(said)
        told = self._told(plain) if self._kind == "unknown_word" else None
        if told is not None:
            return told
        ids = tuple(dict.fromkeys(o for option in self._options for o in option.objects))
        if any(len(option.objects) > 1 for option in self._options):
            return self._group(text, ids)
        sides = " ".join(word for word in said if side_of(word, self._lexicon))
        tried = [self._among(one, ids) for one in (" ".join(core), _described(core), sides)]
        found = next((found for found in tried if len(found) == 1), tried[0] or tried[1])
        if len(found) == 1:
            index = next(i for i, o in enumerate(self._options) if found[0] in o.objects)
            return Answer("pick", index)
        if len(found) > 1:
            return Answer("unclear")
        named = self._of_no_noun(core, ids)
        if named is not None:
            return named
        others = link_answer(determined(" ".join(core)), self._scene, self._lexicon).spoken
        if len(others) > 1 and not ids and all(one.mention.objects for one in others):
            return Answer("words", text=listing(f"the {one.mention.text}" for one in others))
        outside = others[0] if others else None
        if outside is not None and outside.mention.objects and outside.phrase is not None:
            return Answer("thing", text=outside.mention.text)
        if outside is not None and outside.phrase is not None and outside.phrase.known:
            return Answer("unclear")
        return Answer("other")

    def _listed(self, text: str) -> Answer | None:
        """ "the red and the yellow one", "both the apple and the orange": several options."""
        said = (self._without_choosing(words(part)) for part in _LISTED.split(text.lower()))
        parts = [part for one in said if (part := " ".join(w for w in one if w != "both"))]
        single = all(len(option.objects) == 1 for option in self._options)
        denies = {"not", "no", "but", "except", "or"} & set(words(text))
        if len(parts) < 2 or self._kind != "which" or denies or not single:
            return None
        ids = tuple(o for option in self._options for o in option.objects)
        found = [self._among(part, ids) for part in parts]
        if any(len(one) != 1 for one in found) or len(set(found)) < len(found):
            return None
        names = [next(o.label for o in self._options if one[0] in o.objects) for one in found]
        return Answer("words", text=listing(names))

    def _of_no_noun(self, core: Sequence[str], ids: tuple[str, ...]) -> Answer | None:
        """ "the white instance", "the big fella": a noun that names nothing, and what tells one
        option apart."""
        bare = [word for word in core if word not in ARTICLES]
        if len(bare) < 2 or not all(self._adjective(word) for word in bare[:-1]):
            return None
        noun = bare[-1]
        names = {part for item in self._scene for part in words(item.name)}
        if self._adjective(noun) or self._lexicon.is_noun(noun) or {noun, singular(noun)} & names:
            return None
        found = self._among(" ".join((*bare[:-1], "one")), ids)
        fits = [i for i, o in enumerate(self._options) if set(found) & set(o.objects)]
        return Answer("pick", fits[0]) if len(fits) == 1 else None

    def _told(self, plain: str) -> Answer | None:
        """ "glorp is what I call the sponge": the one thing named that is known."""
        spoken_of = link_answer(plain, self._scene, self._lexicon).spoken
        named = {one.mention.objects: one for one in spoken_of if one.mention.objects}
        if len(named) != 1:
            return None
        ((objects, spoken),) = named.items()
        fits = [i for i, o in enumerate(self._options) if o.objects == objects]
        return Answer("pick", fits[0]) if fits else Answer("thing", text=spoken.mention.text)

    def _group(self, text: str, ids: tuple[str, ...]) -> Answer:
        """The option that holds exactly the things said, in whatever order: "the red and the green
        one", "the third, the second and the fourth from the left"."""
        said: set[str] = set()
        for part in _members(text):
            said |= set(self._among(" ".join(self._without_choosing(words(part))), ids))
        fits = [i for i, o in enumerate(self._options) if set(o.objects) == said]
        return Answer("pick", fits[0]) if fits else Answer("unclear")


def _members(text: str) -> list[str]:
    """What a list names one by one; "from the left" behind its last counts for all that it
    numbers."""
    parts = [part for part in _LISTED.split(text.lower()) if words(part)]
    counted = _COUNTED.search(parts[-1]) if parts else None
    if counted is None:
        return parts
    return [f"{part} {counted.group()}" if _ORDINAL.fullmatch(part.strip()) else part
            for part in parts]  # fmt: skip


def _described(core: Sequence[str]) -> str:
    """ "I mean the apple that is sitting close to the plate" as "the apple near the plate"."""
    said = re.split(r"\bi(?:'d)? (?:mean|meant|said|want|wanted|like|think)\b", " ".join(core))[-1]
    plain = re.sub(
        r"\b(?:that|which|what)(?: one)?(?:'s| is| are| stands| sits| lies)?\b|"
        r"\b(?:sitting|standing|lying|placed|located|over there|there|hand)\b", " ", said,
    )  # fmt: skip
    plain = plain if re.search(r"\b(?:the|one|\w+s?)\b", plain) else said
    return " ".join(re.sub(r"\b(?:close|near|next) (?:to|by)\b", "nearest to", plain).split())

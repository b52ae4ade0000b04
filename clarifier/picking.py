"""Answers that pick among the options: by label, place in the list, or what tells one apart."""

from __future__ import annotations

import re
from collections.abc import Sequence

from agent.messages import Option
from clarifier.asked import ARTICLES, Answer, Asked, determined
from clarifier.corrections import behind
from clarifier.mentions import link_answer
from clarifier.pieces import Phrase
from clarifier.reference import Context, denote
from clarifier.things import is_attribute, side_of
from clarifier.words import number, words

OBJECT_QUESTIONS = frozenset({"which", "missing", "unknown_word", "how_many", "confirm"})
_EVERY = r"(?:anything|any|all|everything|each)(?: of (?:them|these|those))?"
_DENIES = re.compile(
    r"\b(?:not|isn't|don't (?:like|want|mean)|(?:is )?wrong|other than|leav(?:e|ing) out|"
    rf"skip(?:ping)?|minus|(?:{_EVERY},? )?(?:except(?: for)?|excluding|without)|{_EVERY} but)\b"
)
_PARTS = re.compile(
    r"[,.;!?]|\band\b|(?<!\bany )(?<!\banything )(?<!\ball )(?<!\beverything )"
    r"(?<!\bof them )(?<!\bof these )(?<!\bof those )\bbut\b"
)
_THOSE = frozenset({"those", "these", "them"})
_SIDE_OPENING = re.compile(r"^(?:on|at|to|in|by|near|next|beside|with|behind|closest|nearest)\b")


class Picking(Asked):
    """Finds the option that is meant."""

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
        bare = [w for w in core if w not in ARTICLES | _THOSE | {"one", "ones"}]
        counts = bool(bare) and number(bare[0]) is not None and bool(_THOSE & set(said))
        if not self._options or len(bare) > 1 or counts:  # "two of them" are no second one
            return None
        if not bare:
            return self._at(0) if list(said) in (["one"], ["number", "one"], ["option", "one"]) \
                else None  # fmt: skip
        if len(bare[0]) == 1 and bare[0].isalpha():
            return self._at("abcdefghijklm".find(bare[0]))
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

    def _on_top(self, said: Sequence[str]) -> Answer | None:
        """ "the red one on top", to which one is at the bottom: of two the other."""
        if not self._asks_bottom or not {"top", "upper", "above"} & set(said):
            return None
        core = [word for word in said if word not in ("on", "at", "top", "upper", "above", "goes")]
        ids = tuple(o for option in self._options for o in option.objects)
        top = self._among(" ".join(self._without_choosing(core)), ids)
        left = [i for i, o in enumerate(self._options) if not set(top) & set(o.objects)]
        return Answer("pick", left[0]) if top and len(left) == 1 else Answer("unclear")

    def _denied(self, text: str) -> Answer | None:
        """ "not the red one, the other one": the only one that is not denied."""
        if len(self._options) < 2 or self._kind not in OBJECT_QUESTIONS:
            return None
        parts = [part for part in _PARTS.split(text.lower()) if part.strip()]
        other = any("the other" in part for part in parts)
        denies = [part for part in parts if _DENIES.search(part)]
        if not other and not denies:
            return None
        if len(self._options) > 2 and (other or len(denies) < len(parts)):
            return None  # what is said beside what is denied is read on its own
        ids = tuple(o for option in self._options for o in option.objects)
        wrong: set[str] = set()
        for part in parts if other and not denies else denies:
            core = _DENIES.sub(" ", part).replace("the other one", " ").replace("the other", " ")
            wrong |= set(self._among(" ".join(self._without_choosing(words(core))), ids))
        left = [i for i, o in enumerate(self._options) if not wrong & set(o.objects)]
        if not left or (not wrong and behind(text) is not None):
            return None  # what is said instead is read on its own
        return Answer("pick", left[0]) if wrong and len(left) == 1 else Answer("unclear")

    def _among(self, core: str, ids: tuple[str, ...]) -> tuple[str, ...]:
        """The options that a description fits."""
        if not ids or not core:
            return ()
        adjectives = [w for w in words(core) if w not in ARTICLES | {"one", "on", "at", "in", "to",
                      "side", "hand", "of", "it", "is", "its", "bit"}]  # fmt: skip
        if adjectives and all(self._adjective(word) for word in adjectives):
            phrase = Phrase(0, 0, 0, "the", None, tuple(adjectives), ())
            return denote(phrase, Context(self._scene, self._lexicon, among=ids)).objects
        if _SIDE_OPENING.match(core):
            core = f"the one {core}"
        spoken = link_answer(determined(core), self._scene, self._lexicon, ids).spoken
        told = spoken[0].phrase if spoken else None
        if told is None or told.det == "other":
            return ()
        return tuple(o for o in spoken[0].mention.objects if o in ids)

    def _adjective(self, word: str) -> bool:
        ordinal = word in self._lexicon.words("ordinals")
        return is_attribute(word, self._lexicon) or bool(side_of(word, self._lexicon)) or ordinal


def _bare(text: str) -> str:
    said = [w for w in words(text) if w not in ARTICLES]
    return " ".join(said)

"""Sentences with talk around what is wanted, and what of them is talk: what `translator.hearing`
learns from.

Wordings of the seeds with things named in them, and around and inside them what people say besides
(``asides/*.toml``, by many hands): openers, reasons, chatter, fillers, statements about a thing,
and corrections of oneself, whose wrong half is talk too. Seeded, made on the fly, never stored.
"""

from __future__ import annotations

import random
import re
import tomllib
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import msgspec

from agent.errors import ConfigError
from translator.corpus.seed import SLOT, Seed

ASIDES = Path(__file__).parent / "asides"
ARTICLES = ("the",) * 8 + ("my", "that", "this", "a", "your")
LOOKS = (
    "red", "blue", "green", "yellow", "white", "black", "pink", "brown", "grey", "purple", "orange",
    "silver", "big", "small", "little", "tall", "biggest", "smallest", "left", "right", "other",
)  # fmt: skip
GROUPS = (
    "the", "all the", "both", "both the", "all of the", "these", "my", "the two", "the three",
)  # fmt: skip
LENGTHS = (
    "5 cm", "ten centimetres", "2 inches", "40 mm", "four centimeters", "an inch", "8cm",
    "half a foot", "15 millimetres", "20 centimeters", "three inches", "a hand's width",
)  # fmt: skip
ANGLES = ("90 degrees", "45°", "thirty degrees", "a quarter turn", "180 degrees", "ninety degrees")
COUNTS = ("two", "three", "2", "four", "one", "3")
OPPOSITES = {
    "left": "right", "right": "left", "front": "back", "behind": "in front of", "near": "far",
    "far": "near", "top": "bottom", "on": "next to", "in": "on", "beside": "behind",
    "clockwise": "anticlockwise", "between": "beside", "towards": "away from", "under": "on",
    "onto": "into", "into": "onto", "edge": "corner", "corner": "edge", "middle": "corner",
}  # fmt: skip
"""A word that may have been said by mistake for another."""
PAUSES = (
    (", ", ", "),
    (" – ", " – "),
    ("... ", " "),
    (" ", " "),
    (" - ", " "),
    (", ", " "),
    ("; ", ", "),
)
"""What stands before and behind the words that begin a correction."""
BRACKETS = ((", ", ", "), (" – ", " – "), (" (", ") "), (", ", ", "), ("—", "—"))


class Asides(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What is said besides; `{a}` and `{b}` in statements and tales stand for things with their
    articles. ``tales`` want nothing, and stand alone."""

    fillers: tuple[str, ...] = ()
    openers: tuple[str, ...] = ()
    closers: tuple[str, ...] = ()
    middles: tuple[str, ...] = ()
    statements: tuple[str, ...] = ()
    chatter: tuple[str, ...] = ()
    vocatives: tuple[str, ...] = ()
    reasons: tuple[str, ...] = ()
    repairs: tuple[str, ...] = ()
    starters: tuple[str, ...] = ()
    tales: tuple[str, ...] = ()


class Part(NamedTuple):
    """A stretch of a sentence, and whether it is talk."""

    text: str
    talk: bool


def load_asides(folder: Path = ASIDES) -> Asides:
    """What all files say. Raises ConfigError naming the file."""
    found: dict[str, tuple[str, ...]] = {}
    for path in sorted(folder.glob("*.toml")):
        try:
            data = tomllib.loads(path.read_text(encoding="utf-8"))
            one = msgspec.convert(data, Asides)
        except (OSError, tomllib.TOMLDecodeError, msgspec.ValidationError) as error:
            raise ConfigError(f"{path}: {error}") from error
        for key in Asides.__struct_fields__:
            found[key] = tuple(dict.fromkeys((*found.get(key, ()), *getattr(one, key))))
    return Asides(**found)


def halved(asides: Asides, held_out: bool) -> Asides:
    """What is learnt from, or every tenth aside: those are held out."""
    return Asides(**{
        key: tuple(one for n, one in enumerate(getattr(asides, key)) if (n % 10 == 9) is held_out)
        for key in Asides.__struct_fields__
    })  # fmt: skip


class Talker:
    """Endless sentences; the same chance gives the same ones."""

    def __init__(
        self, seeds: Sequence[Seed], asides: Asides, nouns: Sequence[str], chance: random.Random
    ) -> None:
        self._wordings = [say for seed in seeds for say in seed.say]
        self._asides, self._nouns, self._chance = asides, nouns, chance

    def __iter__(self) -> Iterator[list[Part]]:
        while True:
            yield self.sentence()

    def sentence(self) -> list[Part]:
        """One sentence in parts; in one of eight nothing is wanted."""
        chance = self._chance
        if chance.random() < 1 / 8:
            return self._typed([Part(self._chatted(), True)])
        wanted = self._wanted()
        if chance.random() < 0.82:
            wanted = self._corrected(wanted) if chance.random() < 0.25 else wanted
            wanted = self._interrupted(wanted)
            wanted = self._surrounded(wanted)
        return self._typed(_joined(wanted))

    # --- what is wanted --------------------------------------------------------------------------

    def _wanted(self) -> list[Part]:
        """One wording or two, word by word; what names a thing is one part."""
        chance = self._chance
        parts = self._named(chance.choice(self._wordings))
        if chance.random() < 0.18:
            joint = chance.choice((" and ", ", then ", " and then ", ". ", ", and "))
            ended = Part(parts[-1].text.rstrip(" .!?"), False)
            parts = [
                *parts[:-1],
                ended,
                Part(joint, False),
                *self._named(chance.choice(self._wordings)),
            ]
        return parts

    def _named(self, say: str) -> list[Part]:
        names: dict[str, str] = {}
        parts: list[Part] = []
        for word in re.split(r"(?<=\s)", say):
            slots = SLOT.findall(word)
            for slot in slots:
                names.setdefault(slot, self._name(slot))
            parts.append(Part(SLOT.sub(lambda found: names[found.group(1)], word), False))
        return [part for part in parts if part.text]

    def _name(self, slot: str) -> str:
        chance = self._chance
        if slot in "LM":
            return chance.choice(LENGTHS)
        if slot in "TN":
            return chance.choice(ANGLES if slot == "T" else COUNTS)
        look = f"{chance.choice(LOOKS)} " if chance.random() < 0.35 else ""
        noun = look + chance.choice(self._nouns)
        if slot in "AB":
            return f"{chance.choice(GROUPS)} {noun}s"
        article = chance.choice(ARTICLES)
        return f"{'an' if article == 'a' and noun[0] in 'aeiou' else article} {noun}"

    # --- corrections -----------------------------------------------------------------------------

    def _corrected(self, parts: list[Part]) -> list[Part]:
        """Something is said wrongly first: a thing, a word, a measure, or the whole."""
        chance = self._chance
        before, behind = chance.choice(PAUSES)
        repair = before + chance.choice(self._asides.repairs) + behind
        way = chance.random()
        if way < 0.3:  # broken off, and begun again
            reach = chance.randrange(1, len(parts)) if len(parts) > 1 else 1
            begun = "".join(self._mistaken(part.text) for part in parts[:reach])
            return [Part(begun.rstrip(" .,") + repair, True), *parts]
        if way < 0.42:  # another thing was wanted first
            other = "".join(part.text for part in self._named(chance.choice(self._wordings)))
            return [Part(other.rstrip(" .!?,") + repair, True), *parts]
        places = [n for n, part in enumerate(parts) if self._may_be_mistaken(part.text)]
        if not places:
            return parts
        at = chance.choice(places)
        wrong = self._mistaken(parts[at].text).rstrip(" .,")
        return [*parts[:at], Part(wrong + repair, True), *parts[at:]]

    def _may_be_mistaken(self, text: str) -> bool:
        return " " in text.strip() or text.strip(" .,!?").lower() in OPPOSITES

    def _mistaken(self, text: str) -> str:
        """What may have been said in the place of a part."""
        words = text.split()
        if len(words) == 1:
            return text.replace(words[0], OPPOSITES.get(words[0].strip(".,!?").lower(), words[0]))
        return f"{self._name('L' if text in LENGTHS else 'a')} " if words else text

    # --- talk ------------------------------------------------------------------------------------

    def _interrupted(self, parts: list[Part]) -> list[Part]:
        """Fillers, and asides set off by commas, dashes or brackets."""
        chance, asides = self._chance, self._asides
        if chance.random() < 0.16:
            for _ in range(chance.choice((1, 1, 2, 3))):
                at = chance.randrange(len(parts))
                filler = chance.choice(asides.fillers)
                parts = [
                    *parts[:at],
                    Part(filler + chance.choice((" ", " ", ", ", "... ")), True),
                    *parts[at:],
                ]
        if chance.random() < 0.2 and len(parts) > 2:
            at = chance.randrange(1, len(parts))
            before, behind = chance.choice(BRACKETS)
            said = chance.choice((asides.middles, asides.middles, asides.reasons, asides.vocatives))
            parts = [*parts[:at], Part(before + chance.choice(said) + behind, True), *parts[at:]]
        return parts

    def _surrounded(self, parts: list[Part]) -> list[Part]:
        """What stands in front of the sentence and behind it."""
        chance, asides = self._chance, self._asides
        front, back = "", ""
        if chance.random() < 0.3:
            front = chance.choice(asides.openers)
        elif chance.random() < 0.12:
            front = chance.choice(asides.starters) + chance.choice((" ", ", ", "... ", " – "))
        elif chance.random() < 0.14:
            front = chance.choice(asides.vocatives) + chance.choice((", ", ", ", "! ", ": "))
        if chance.random() < 0.16:
            front = f"{chance.choice(asides.chatter)} {front}"
        if chance.random() < 0.2:
            front = f"{self._stated(parts)} {front}"
        if chance.random() < 0.26:
            back = chance.choice(asides.closers)
        elif chance.random() < 0.25:
            back = chance.choice((" ", ", ")) + chance.choice(asides.reasons)
        elif chance.random() < 0.1:
            back = ", " + chance.choice(asides.vocatives)
        if chance.random() < 0.1:
            back += chance.choice((". ", "! ", " ")) + chance.choice((
                chance.choice(asides.chatter), self._stated(parts),
            ))  # fmt: skip
        last = Part(parts[-1].text.rstrip(" .") if back else parts[-1].text, parts[-1].talk)
        ends = Part(chance.choice(("", "", ".", "!")), False)
        return [Part(front, True), *parts[:-1], last, Part(back, True), ends]

    def _chatted(self) -> str:
        """Sentences that want nothing."""
        chance, asides = self._chance, self._asides
        if chance.random() < 0.6:
            tale = chance.choice(asides.tales)
            return tale.replace("{a}", self._name("a")).replace("{b}", self._name("b"))
        said = [
            chance.choice((chance.choice(asides.chatter), self._stated([]), self._stated([])))
            for _ in range(chance.choice((1, 1, 2, 3)))
        ]
        return chance.choice((" ", " ", " and ", " so ", ", ")).join(said)

    def _stated(self, parts: list[Part]) -> str:
        """A statement about a thing of the sentence, or another one."""
        chance = self._chance
        named = [
            part.text.strip(" .,!?") for part in parts if " " in part.text.strip() and not part.talk
        ]
        thing = chance.choice(named) if named and chance.random() < 0.6 else self._name("a")
        said = chance.choice(self._asides.statements).replace("{a}", thing)
        return said[0].upper() + said[1:] if chance.random() < 0.8 else said

    # --- typing ----------------------------------------------------------------------------------

    def _typed(self, parts: list[Part]) -> list[Part]:
        """As it is typed, or as it is heard: in lower case, without punctuation."""
        style = self._chance.random()
        if style < 0.12:
            parts = [
                Part(re.sub(r"[^\w\s{}'°]", " ", part.text.lower()), part.talk) for part in parts
            ]
        elif style < 0.3:
            parts = [Part(part.text.lower(), part.talk) for part in parts]
        return [Part(re.sub(r"\s+", " ", part.text), part.talk) for part in parts if part.text]


def _joined(parts: Sequence[Part]) -> list[Part]:
    """Neighbours of one kind as one part; blanks where talk meets what is wanted."""
    result: list[Part] = []
    for part in parts:
        if not part.text:
            continue
        if result and result[-1].talk == part.talk:
            result[-1] = Part(result[-1].text + part.text, part.talk)
        else:
            blank = result and result[-1].text[-1:].isalnum() and part.text[0].isalnum()
            result.append(Part(f" {part.text}" if blank else part.text, part.talk))
    return result

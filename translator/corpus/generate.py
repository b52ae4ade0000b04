"""Grow the seeds: wordings with slots numbered, phrased in many ways, joined into longer sentences,
made to depend on conditions.

Seeded, made on the fly, never stored. What the mentions are called does not matter (see
`translator.marked`): a sample is a sentence over placeholders and a program over slots.
"""

from __future__ import annotations

import random
import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from agent.messages import Kind
from translator.chain import remembered
from translator.corpus.seed import NAME, SLOT, Condition, Seed, kind_of, load_conditions
from translator.corpus.talk import load_asides
from translator.marked import MOST, MOST_MEASURES, Mark, Marked, marked

_LETTERS = {"object": "m", "group": "g", "length": "d", "angle": "t", "count": "n"}

ARTICLES = ("the ",) * 12 + ("a ", "that ", "this ", "my ", "one ", "our ", "")
GROUPS = ("the ",) * 4 + ("all the ",) * 3 + (
    "all ", "both ", "both the ", "all of the ", "these ", "each of the ", "those ", "",
)  # fmt: skip
OPENINGS = (
    "please ", "Please ", "can you ", "could you ", "could you please ", "would you ", "now ",
    "ok, ", "okay ", "hey, ", "hi, ", "robot, ", "hey robot, ", "so, ", "well, ", "alright, ",
    "right, ", "I want you to ", "I'd like you to ", "you should ", "go ahead and ", "just ",
    "next, ",
    "let's ", "i need you to ", "kindly ", "um, ", "uh ", "the next thing: ", "be so kind and ",
    "I would be grateful if you could ", "I'd be obliged if you would ",
    "would you be so good as to ",
    "would you mind if I asked you to ", "do me a favour and ", "be a dear and ", "do ",
    "do please ",
    "if you would be so kind, ", "when you have a moment, ", "if it isn't too much trouble, ",
    "if you don't mind, ", "as soon as you can, ", "could I ask you to ", "might I ask you to ",
    "may I trouble you to ", "I wonder if you could ", "I was wondering whether you could ",
    "I think you should ", "what I want is that you ", "it would be nice if you could ",
    "your job is to ", "your task: ", "step one: ", "first of all, ", "to begin with, ", "again, ",
    "listen, ", "look, ", "oh, ", "ah, ", "hm, ", "yo, ", "dude, ", "mate, ", "my dear, ", "sir, ",
    "attention: ", "order: ", "command: ", "task: ", "quick, ", "quickly ", "slowly ", "carefully ",
    "gently ", "try to ", "you can ", "you may now ", "you have to ", "you must ", "you need to ",
    "time to ", "we need to ", "we should ", "I'd love you to ", "i wanna ", "i want to ", "gotta ",
    "are you able to ", "is it possible to ", "could ya ", "can u ", "pls ", "plz ",
    "would you please ",
    "will you ", "won't you ", "why don't you ", "how about you ", "maybe you could ", "perhaps ",
    "simply ", "only ", "yes, ", "no problem, ", "good, ", "great, now ", "fine. ", "thanks. Now ",
    "I say, ", "excuse me, ", "sorry, ", "in this step, ", "for the next step, ",
    "one more thing: ",
)  # fmt: skip
CLOSINGS = (
    " please", ", please", " now", " for me", ", thanks", " thank you", ", will you?", ", ok?",
    " if you can", " if you don't mind", ", cheers", " would you", " right away", " carefully",
    " gently", ", mate", " when you're ready", " quickly", " again", ", that's it", ", okay?",
    ", if you would", ", if you'd be so kind", ", if it's no trouble", ", if that's all right",
    ", my dear", ", love", ", dear", ", sir", ", buddy", ", robot", ", would you?", ", won't you",
    ", can you?", " as soon as possible", " at once", " for a moment", " in one go", " slowly",
    " very carefully", ", nice and slow", " without hurry", ", thank you very much", ", ta", " thx",
    " pls", " plz", ", that would be great", ", that would be lovely", ", I'd appreciate it",
    ", much appreciated", ", and thank you", ", that's all", ", nothing else", ", nothing more",
    ", just like that", ", as we said", ", as I said", ", for goodness sake", ", don't be shy",
    " so that I can see it better", " so it looks tidy", " because it looks better there",
    ", it looks nicer that way", ", otherwise I can't work", ", I need the room", " today", " next",
    " instead", " after all", " once and for all", ", no rush", ", take your time", " - thanks!",
    ", right?", ", yeah?", ", got it?", ", all right?", " in a calm way", ", exactly so",
    " properly",
)  # fmt: skip
TOPICS = (", ", ": ", " - ", ", please ", ", well, ", ", you can ", ", I want you to ", "... ")
"""What stands between a thing that is named first and what is to be done with it."""
JOINTS = (
    " and ", " and then ", ", then ", ", and ", ", and then ", ". Then ", ". After that ", "; ",
    ", after that ", " then ", ". Next, ", ", next ", ". ", " and afterwards ", ", also ",
    " and also ", ". And ", ", finally ", ". Now ",
)  # fmt: skip
IF = (
    "if {c}, {p}", "if {c} {p}", "if {c} then {p}", "if {c}, then {p}", "{p} if {c}",
    "when {c}, {p}", "in case {c}, {p}", "only if {c}, {p}", "{p}, but only if {c}",
    "should it be that {c}, {p}", "provided that {c}, {p}", "{p} as long as {c}",
)  # fmt: skip
IF_ELSE = (
    "if {c}, {p}, otherwise {q}", "if {c} {p}, else {q}", "if {c} then {p}, else {q}",
    "if {c}, {p}. otherwise {q}", "if {c} {p} else {q}", "if {c}, {p}, if not, {q}",
    "{p} if {c}, otherwise {q}", "if {c}, then {p}, or else {q}",
)  # fmt: skip
UNLESS = (
    "unless {c}, {p}", "{p} unless {c}", "{p}, except if {c}",
    "if it is not true that {c}, {p}",
)  # fmt: skip
"""How a deed p, or another one q, depends on a condition c."""
SWAPS = (
    ("colour", "color"), ("centre", "center"), ("towards", "toward"), ("beside", "next to"),
    ("metre", "meter"), ("anticlockwise", "counterclockwise"), ("on top of", "on"),
    ("right-hand", "right"), ("left-hand", "left"), ("in front of", "before"),
)  # fmt: skip
"""Words for words that people on the two sides of the Atlantic, or in a hurry, use."""
_KEYS = {
    "a": "sq", "b": "vn", "c": "xv", "d": "sf", "e": "wr", "f": "dg", "g": "fh", "h": "gj",
    "i": "uo", "j": "hk", "k": "jl", "l": "k", "m": "n", "n": "bm", "o": "ip", "p": "o", "r": "et",
    "s": "ad", "t": "ry", "u": "yi", "v": "cb", "w": "qe", "x": "zc", "y": "tu", "z": "x",
}  # fmt: skip


USUAL, OFTEN = 4, 3
"""So many wordings of a seed, its first ones, are the usual ones: they come so often."""


class Sample(NamedTuple):
    """A sentence as the model reads it, and its program over `translator.marked.SLOTS`."""

    sentence: Marked
    program: str
    kind: Kind


class Part(NamedTuple):
    """A wording whose slots are numbered: text with ``<m1>`` in it, and the program over them."""

    text: str
    program: str
    slots: tuple[str, ...]


class Generator:
    """Endless samples from seeds; the same seed of the chance gives the same samples."""

    def __init__(self, seeds: Sequence[Seed], chance: random.Random) -> None:
        self._chance = chance
        self._conditions = load_conditions()
        self._asides = load_asides()
        self._by_kind: dict[Kind, list[tuple[Seed, str]]] = {"manipulate": [], "arrange": []}
        for seed in seeds:
            for kind in ("manipulate", "arrange") if seed.kind == "both" else (seed.kind,):
                self._by_kind[kind] += [
                    (seed, say)
                    for number, say in enumerate(seed.say)
                    for _ in range(OFTEN if number < USUAL else 1)
                ]

    def __iter__(self) -> Iterator[Sample]:
        while True:
            sample = self.sample()
            if sample is not None:
                yield sample

    def sample(self) -> Sample | None:
        """One sample; None if what was drawn does not fit together."""
        chance = self._chance
        kind: Kind = "manipulate" if chance.random() < 0.75 else "arrange"
        if kind == "manipulate" and chance.random() < 0.06:
            return self._conditional()
        count = chance.choices((1, 2, 3, 4, 5), (60, 22, 10, 5, 3))[0]
        parts = self._parts(kind, count)
        if parts is None:
            return None
        text = "".join(
            (chance.choice(JOINTS) if number else "") + self._phrase(part.text, number, count)
            for number, part in enumerate(parts)
        )
        if count == 1 and chance.random() < 0.06:
            text = self._fronted(text)
        program = remembered([part.program for part in parts])
        return Sample(self._marked(self._dressed(text)), program, kind)

    def _parts(self, kind: Kind, count: int) -> list[Part] | None:
        """Wordings side by side; later ones often speak of things that earlier ones named."""
        chance, parts = self._chance, list[Part]()
        used: list[str] = []
        for _ in range(count):
            seed, say = chance.choice(self._by_kind[kind])
            if count > 1 and (seed.program.count("\n") > 3 or len(say) > 110):
                return None
            part = self._numbered(seed.program, say, used)
            if part is None:
                return None
            used += [slot for slot in part.slots if slot not in used]
            parts.append(part)
        return parts

    def _conditional(self) -> Sample | None:
        """A sentence whose deed depends on a condition, in one of many orders."""
        chance = self._chance
        style = chance.choice((IF, IF, IF_ELSE, UNLESS))
        frame = chance.choice(style)
        condition = chance.choice(self._conditions)
        parts: dict[str, Part] = {}
        used: list[str] = []
        for name in re.findall(r"\{(\w)\}", frame):
            part = self._dependent(condition if name == "c" else None, used)
            if part is None:
                return None
            parts[name] = part
            used += [slot for slot in part.slots if slot not in used]
        said = {name: self._phrase(part.text, 1, 2) for name, part in parts.items()}
        test = parts["c"].program
        test = f"not ({test})" if style is UNLESS else test
        program = f"if {test}:\n{_indented(parts['p'].program)}"
        if "q" in parts:
            program += f"\nelse:\n{_indented(parts['q'].program)}"
        return Sample(self._marked(self._dressed(frame.format(**said))), program, "manipulate")

    def _dependent(self, condition: Condition | None, used: Sequence[str]) -> Part | None:
        """The condition over numbered slots, or a short deed without a condition of its own."""
        chance = self._chance
        if condition is not None:
            return self._numbered(condition.test, chance.choice(condition.say), used)
        seed, say = chance.choice(self._by_kind["manipulate"])
        if seed.program.count("\n") > 1 or "if " in seed.program or len(say) > 70:
            return None
        return self._numbered(seed.program, say, used)

    def _numbered(self, program: str, say: str, used: Sequence[str]) -> Part | None:
        """Slots by order of first mention, as the linker numbers them; some are earlier ones."""
        chance, names = self._chance, dict[str, str]()
        things = sum(slot[0] in "mg" for slot in used)
        for slot in dict.fromkeys(SLOT.findall(say)):
            letter = _LETTERS[kind_of(slot)]
            if letter in "mg":
                again = [old for old in used if old[0] == letter and old not in names.values()]
                if again and chance.random() < 0.45:
                    names[slot] = chance.choice(again[-2:])
                    continue
                things += 1
                names[slot] = f"{letter}{things}"
                if things > MOST:
                    return None
            else:
                number = 1 + sum(old[0] == letter for old in [*used, *names.values()])
                names[slot] = f"{letter}{number}"
                if number > MOST_MEASURES:
                    return None
        text = SLOT.sub(lambda match: f"<{names[match.group(1)]}>", say)
        first = next(iter(names.values()), "")
        if first[:1] == "m" and chance.random() < 0.5:
            # for the most part the linker takes "it" for the first thing too
            text = re.sub(r"\bit\b", f"<{first}>", text)
        program = NAME.sub(lambda match: names.get(match.group(), match.group()), program)
        return Part(text, program, tuple(names.values()))

    # --- wording ---------------------------------------------------------------------------------

    def _phrase(self, text: str, number: int, count: int) -> str:
        """One phrase of a sentence: no full stop inside, articles and pronouns for the slots."""
        chance = self._chance
        if count > 1:
            text = text.rstrip(" .!?")
            if number and text[:2] != "I " and text[:1].isupper():
                text = text[0].lower() + text[1:]

        def name(match: re.Match[str]) -> str:
            slot = match.group(1)
            if slot[0] == "m":
                return chance.choice(ARTICLES) + match.group()
            return (chance.choice(GROUPS) if slot[0] == "g" else "") + match.group()

        return re.sub(r"<((?:m|g)\d)>", name, text)

    def _fronted(self, text: str) -> str:
        """ "the cup, push it to the left": the pronoun is a mention of the same thing."""
        slot = re.search(r"<[mg]1>", text)
        if slot is None or text.startswith(("<", "I ")) or text.count(slot.group()) > 1:
            return text
        article = "the " if slot.group() == "<m1>" else self._chance.choice(("the ", "all the "))
        rest = re.sub(rf"(?:{'|'.join(filter(None, ARTICLES + GROUPS))})?{slot.group()}",
                      slot.group(), text)  # fmt: skip
        return article + slot.group() + self._chance.choice(TOPICS) + rest[0].lower() + rest[1:]

    def _talked(self, text: str) -> str:
        """Talk in front or behind: what the tagger of talk did not take for it."""
        chance, asides = self._chance, self._asides
        way = chance.choice(("openers", "closers", "reasons", "chatter", "vocatives"))
        said: str = chance.choice(getattr(asides, way))
        if way == "openers":
            return said + text
        if way == "chatter":
            return f"{said} {text}"
        return text.rstrip(" .!?") + (said if way == "closers" else f", {said}")

    def _dressed(self, text: str) -> str:
        """Politeness, talk, punctuation, spelling and typing as people have them."""
        chance = self._chance
        if chance.random() < 0.1:
            text = self._talked(text)
        if chance.random() < 0.22:
            opening = chance.choice(OPENINGS)
            text = opening + (text[0].lower() + text[1:] if text[:2] != "I " else text)
        if chance.random() < 0.16:
            text = text.rstrip(" .!?") + chance.choice(CLOSINGS)
        if chance.random() < 0.2:
            one, other = chance.choice(SWAPS)
            text = text.replace(one, other) if one in text else text.replace(other, one)
        style = chance.random()
        if style < 0.35:
            text = text[0].upper() + text[1:] if text[0] != "<" else text
            text = text.rstrip(" .!?") + chance.choice((".", ".", "", "!"))
        elif style < 0.65:
            text = text.lower().rstrip(" .!")
        if chance.random() < 0.08:
            text = text.replace(",", "")
        return self._typed(text) if chance.random() < 0.12 else text

    def _typed(self, text: str) -> str:
        """One or two slips of the fingers, in words longer than three letters."""
        chance = self._chance
        for _ in range(chance.choice((1, 1, 2))):
            words = list(re.finditer(r"(?<![<\w])[a-z]{4,}(?![\w>])", text))
            if not words:
                return text
            word = chance.choice(words)
            at = word.start() + chance.randrange(1, len(word.group()) - 1)
            slip = chance.randrange(4)
            if slip == 0:
                text = text[:at] + text[at + 1 :]
            elif slip == 1:
                text = text[:at] + text[at] + text[at:]
            elif slip == 2:
                text = text[:at] + text[at + 1] + text[at] + text[at + 2 :]
            else:
                text = text[:at] + chance.choice(_KEYS.get(text[at], text[at])) + text[at + 1 :]
        return text

    def _marked(self, text: str) -> Marked:
        """The finished text with its slots as marks."""
        marks = [Mark(m.start(), m.end(), m.group(1)) for m in re.finditer(r"<(\w\d)>", text)]
        return marked(text, marks)


def _indented(program: str) -> str:
    return "\n".join(f"    {line}" for line in program.split("\n"))

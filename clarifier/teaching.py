"""Teaching words: "the glorp is the red block", "a tower means stack them by size", "forget glorp".

What a word is taught to stand for is kept as it was said (`clarifier.taught`).
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from msgspec.structs import replace as replace_

from agent.errors import ConfigError
from agent.messages import Decision, Dialog, Lesson
from clarifier import act
from clarifier.lexicon import Lexicon
from clarifier.mentions import link
from clarifier.refusals import State, refuse
from clarifier.taught import Taught, Words
from clarifier.words import listing, singular, words
from scene.tracks import NAMELESS
from scene.types import SceneObject

_WORD = r"[\"“”']?(?P<word>[a-z][\w-]*(?: [a-z][\w-]*)??)[\"“”']?"
_ONE_WORD = _WORD.replace("(?: [a-z][\\w-]*)??", "")
_ARTICLE = r"(?:(?:a|an|the|my) )?"
_MEANING = r"(?P<meaning>.+?)"
_LEAD = r"^(?:(?:please )?(?:remember|learn|note|know)(?: that)?[,:]? |ok,? |so,? |well,? )?"
_EXPLICIT = tuple(
    re.compile(_LEAD + pattern + r"[.!]*$", re.IGNORECASE)
    for pattern in (
        rf"{_ARTICLE}{_WORD} (?:means|stands for|refers to|should mean) (?:to )?{_MEANING}",
        rf"(?:by|with) {_ARTICLE}{_WORD},? i mean {_MEANING}",
        rf"(?:when|if|whenever) i say {_ARTICLE}{_WORD},? (?:then )?(?:i mean |it means |you )?"
        rf"{_MEANING}",
        rf"(?:let's |let us |i |we )?(?:call|name) (?P<meaning>(?:the|this|that|a|an|my) \w+"
        rf"(?: (?!the\b|a\b|an\b|my\b)\w+)?|\w+) {_ARTICLE}{_ONE_WORD}",
    )
)
"""What can only be teaching, whatever the word means so far."""
_SAID = re.compile(
    _LEAD + rf"(?:this |that |it )?{_ARTICLE}{_WORD} (?:is|are|=|would be) {_MEANING}[.!]*$",
    re.IGNORECASE,
)
"""Teaching if the word is not known yet ("the cup is red" is none)."""
_OURS = re.compile(
    r",? (?:in|at|for) (?:my|our) (?:language|family|country|house|home|town|village|dialect)$",
    re.IGNORECASE,
)
"""Where a word is said, which is no part of what it means."""
_THIS = r"(?:this|that|it)(?: (?:one|thing|object))?"
_POINTING = frozenset({"this", "that", "it", "these", "those", "they", "there", "here"})
_NAMED = tuple(
    re.compile(_LEAD + pattern + r"[.!]*$", re.IGNORECASE)
    for pattern in (
        rf"(?:let's |let us |i |we )?(?:call|name) {_THIS} {_ARTICLE}{_WORD}",
        rf"{_THIS}(?: is|'s) (?:called|named|known as) {_ARTICLE}{_WORD}",
        rf"{_THIS}(?: is|'s) (?:a|an|the|my) {_WORD}",
    )
)
"""What names the thing that was spoken of last; the last form only if the word is not known."""
_FORGET = re.compile(
    rf"^(?:forget|unlearn)(?: about| the word| what)? {_ARTICLE}{_WORD}(?: means| meant)?[.!]*$",
    re.IGNORECASE,
)
_ASKED = re.compile(
    rf"^what(?:'s| is| are| does| do) {_ARTICLE}{_WORD}(?: mean| stand for)?[?.!]*$", re.IGNORECASE
)
_ALL = re.compile(
    r"^(?:what|which)(?: new)? words (?:do you know|did i teach you|have (?:i taught you|"
    r"you learn(?:t|ed)))|^what have (?:i taught you|you learn(?:t|ed))\b",
    re.IGNORECASE,
)


class Teaching:
    """Learns, forgets and tells words. Moves nothing."""

    def __init__(self, taught: Taught, lexicon: Lexicon) -> None:
        self._taught = taught
        self._lexicon = lexicon

    def words(self, dialog: Dialog) -> tuple[Words, str]:
        """The words taught, and what is wrong with their file ("" for nothing)."""
        try:
            return self._taught.words(dialog), ""
        except ConfigError as error:
            return Words(), f"I can't read the words that I was taught: {error}."

    def decide(self, text: str, state: State) -> Decision | None:
        """The decision on a sentence about words; None if it is about none."""
        core = act.strip_courtesy(text) or text.strip()
        known, _ = self.words(state.dialog)
        if _ALL.match(core):
            return self._tell_all(known, state)
        asked = _ASKED.match(core)
        if asked and known.meaning(_key(asked["word"])):
            word = _key(asked["word"])
            return _answer(state, f"“{word}” means {known.meaning(word)}.", "asked for a word")
        named = next((match for one in _NAMED if (match := one.match(core))), None)
        if named and (named.re is not _NAMED[-1] or self._new(_key(named["word"]), known, state)):
            return self._name(_key(named["word"]), state)
        forgotten = _FORGET.match(core)
        if forgotten and self._new(_key(forgotten["word"]), known, state):
            return self._forget(_key(forgotten["word"]), known, state)
        return self._teach(core, known, state)

    def learn(self, dialog: Dialog, word: str, meaning: str) -> tuple[Dialog, str]:
        """Keep what a word was found to stand for; the conversation then, and what to say of it."""
        try:
            kept = self._taught.learn(dialog, Lesson(_key(word), meaning))
        except ConfigError as error:
            return dialog, f"I can't keep the word: {error}."
        return kept, f"From now on “{_key(word)}” means {meaning}."

    # --- each kind of sentence -------------------------------------------------------------------

    def _name(self, word: str, state: State) -> Decision:
        """Give the thing that was spoken of last, or the only one without a name, this one."""
        if self._fixed(word):
            text = f"I can't call anything “{word}”: take a word of your own."
            return refuse(state, "not_understood", text, f"{word!r} belongs to the language")
        spoken = link("touch it", state.scene, state.dialog.focus, self._lexicon).spoken
        meant = [id_ for one in spoken for id_ in one.mention.objects]
        meant = meant or [item.id for item in state.scene if item.name == NAMELESS]
        if len(meant) != 1:
            text = "Which thing do you mean? Touch it first, or say it all: “call the red thing the"
            return refuse(state, "missing_object", f"{text} {word}”.", "nothing to be named")
        return _called(state.scene.get(meant[0]), word, state)

    def _teach(self, core: str, known: Words, state: State) -> Decision | None:
        said = next((match for one in _EXPLICIT if (match := one.match(core))), None)
        explicit = said is not None
        said = said or _SAID.match(core)
        if said is None:
            return None
        if said["word"].lower() in _POINTING:
            return None
        word, meaning = _key(said["word"]), _OURS.sub("", said["meaning"]).strip(" ,")
        if not explicit and not self._new(word, known, state):
            return None
        if self._fixed(word) or self._stands_here(word, state):
            text = f"I can't change what “{word}” means: take a word of your own."
            return refuse(state, "not_understood", text, f"{word!r} belongs to the language")
        spelled = known.spelled_out(meaning)
        first = words(spelled)[:1]
        deed = bool(first) and self._lexicon.verb(first[0]) is not None
        named = link(_the(spelled), state.scene, (), self._lexicon)
        plain = {chunk.kind for chunk in named.chunks} <= {"np", "relation", "place"}
        if not deed and not plain and not explicit:
            return None
        if not deed and not (plain and any(one.mention.objects for one in named.spoken)):
            if not explicit:
                return None
            text = f"I can't see what you mean by “{meaning}”. Name something on the table, or say"
            text += " what I should do, as in “a tower means stack the blocks”."
            return refuse(state, "missing_object", text, "the meaning names nothing here")
        nameless = [one.mention.objects for one in named.spoken]
        if not deed and self._nameless(nameless, state):
            return _called(state.scene.get(nameless[0][0]), word, state)
        lesson = Lesson(word, spelled if deed else _the(spelled), deed)
        try:
            dialog = self._taught.learn(state.dialog, lesson)
        except ConfigError as error:
            return refuse(state, "not_understood", f"I can't keep that word: {error}.", "no file")
        reply = f"“{word}” means {lesson.meaning}. I'll remember that."
        return _answer(replace(state, dialog=dialog), reply, "a word is taught")

    def _nameless(self, meant: Sequence[tuple[str, ...]], state: State) -> bool:
        """Whether it is about one thing, which nobody has given a name."""
        return [len(ids) for ids in meant] == [1] and state.scene.get(meant[0][0]).name == NAMELESS

    def _forget(self, word: str, known: Words, state: State) -> Decision | None:
        try:
            if known.meaning(word) is None:
                text = f"I was never taught “{word}”."
                return _answer(state, text, "the word was not taught")
            dialog = self._taught.forget(state.dialog, word)
        except ConfigError as error:
            return refuse(state, "not_understood", f"I can't forget that: {error}.", "no file")
        reply = f"I have forgotten “{word}”."
        return _answer(replace(state, dialog=dialog), reply, "a word is forgotten")

    def _tell_all(self, known: Words, state: State) -> Decision:
        told = [f"“{word}” means {meaning}" for table in (known.things, known.deeds)
                for word, meaning in table.items()]  # fmt: skip
        text = f"{listing(told)}." if told else "You have taught me no words yet."
        return _answer(state, text, "asked for the words taught")

    def _new(self, word: str, known: Words, state: State) -> bool:
        """Whether a word is one that nothing is known of, or that was taught before."""
        if known.meaning(word) is not None:
            return True
        there = {part for item in state.scene for part in words(item.name)}
        return not any(
            part in there or part in self._lexicon.vocabulary or self._lexicon.is_noun(part)
            or self._lexicon.verb(part) is not None for part in word.split()
        )  # fmt: skip

    def _stands_here(self, word: str, state: State) -> bool:
        return any(word in words(item.name) for item in state.scene)

    def _fixed(self, word: str) -> bool:
        """Whether a word belongs to the language: verbs, directions, colours and the like."""
        lists = ("grammar", "directions", "halt", "cancel", "yes", "no")
        return (
            any(word in self._lexicon.words(name) for name in lists)
            or word in self._lexicon.colors
            or self._lexicon.verb(word) is not None
        )


def _key(word: str) -> str:
    return singular(" ".join(word.lower().split()))


def _the(meaning: str) -> str:
    """A noun phrase with its article."""
    return meaning if re.match(r"(?:the|a|an|my|all|both)\b", meaning) else f"the {meaning}"


def _answer(state: State, reply: str, why: str) -> Decision:
    return Decision("answer", why, state.dialog, reply=f"{state.echo} {reply}".strip())


def _called(item: SceneObject, word: str, state: State) -> Decision:
    """This very object bears the name from now on, whatever it looks like."""
    dialog = replace_(state.dialog, called=(*state.dialog.called, (item.id, word)))
    looks = " ".join(part for part in (item.color, item.name) if part)
    reply = f"I call the {looks} “{word}” from now on."
    return _answer(replace(state, dialog=dialog), reply, "a thing is given a name")

"""The dialogue act of a sentence: halt, cancel, small talk, question or command."""

from __future__ import annotations

import re
from typing import Literal

from clarifier.lexicon import Lexicon
from clarifier.words import stems, words

Act = Literal[
    "stop", "cancel", "greeting", "thanks", "help", "undo", "leave", "question", "chat", "command"
]  # fmt: skip

_OPENING = re.compile(
    r"^\s*(?:(?:please|kindly|hey|hi|hello|ok|okay|alright|all right|well|so|um+|uh+|er|now|then|"
    r"next(?! to\b)|just|robot|armchat|dear|first|finally|yo|good morning|also|great|thanks|"
    r"perfect|how about|what about|why don't you|why not|would you mind|"
    r"(?:can|could|would|will) (?:you|u)(?: please| kindly| just| now| maybe)*|"
    r"would you be so kind (?:as )?to|(?:i want|i'd like|i would like|i need|id like) you to|"
    r"(?:i want|i'd like|i would like) to|you (?:should|must|can|could|need to|have to)|"
    r"let's|lets|let us|go ahead and|try to|go and|do me a favou?r and|be so kind (?:as )?to|"
    r"your task is to|the task is to|your job is to|i'd love you to|make sure to|"
    r"it would be (?:nice|great) if you (?:could|would))\b[\s,!.:]*)+",
    re.IGNORECASE,
)
_CLOSING = re.compile(
    r"(?:[\s,]*\b(?:please|thanks a lot|thanks|thank you(?: very much)?|for me|cheers|mate|now|"
    r"if you (?:can|could|would|don't mind)|will you|would you|could you|can you|ok|okay|"
    r"right now|robot|kindly|if possible|buddy)\b)*[\s.!?,;]*$",
    re.IGNORECASE,
)
_COURTESY = re.compile(r"[\s,]*\b(?:please|kindly)\b,?", re.IGNORECASE)
_ASKING = re.compile(
    r"^(?:(?:can|could|would|will) you (?:please |kindly )?(?:tell me|say|explain)|tell me|"
    r"do you know|i wonder|i'd like to know|let me know|say)\b[\s,]*(?:if|whether)?\s*",
    re.IGNORECASE,
)
_QUESTION = re.compile(
    r"^(?:what|what's|whats|where|where's|wheres|which|who|who's|whose|how (?:many|much|far|big|"
    r"tall|wide|high|long|large|do|does|are|is|old|come|can)|how|why|when|is|are|isn't|aren't|"
    r"does|did|was|were|am|has|have (?:you|i|we)|any|"
    r"do (?:you|i|we|they)|can you (?:see|find|spot|count|reach)|can i|can we|"
    r"could you (?:see|find|count)|count|list|describe|name (?:the|all|every)|"
    r"show me (?:what|which)|are there|is there|there is|should i|will you|have i)\b",
    re.IGNORECASE,
)
_SUGGESTION = re.compile(
    r"^(?:how about|what about|why don't you|why not|what if you|would you mind)\b", re.IGNORECASE
)
_HELP = re.compile(
    r"^(?:help|help me|what can (?:you|i) (?:do|say|ask|tell you)|what do you do|who are you|"
    r"what are you|how do (?:you|i|we) (?:work|use (?:this|you|it)|start)|how does this work|"
    r"what are your (?:skills|commands|abilities)|what (?:commands|can you help).*|"
    r"what are you able to do|what else can you do)\b[\s?!.]*$",
    re.IGNORECASE,
)
_UNDO = re.compile(
    r"^(?:undo\b.*|revert\b.*|(?:put|move|bring|place|take) (?:it|them|that|everything|all) back|"
    r"go back|reverse that|take that back|as it was)[\s.!]*$",
    re.IGNORECASE,
)
_LEAVE = re.compile(r"^(?:don't|do not|dont|never)\s", re.IGNORECASE)
_HOW_ARE_YOU = re.compile(r"^how (?:are|is) (?:you|it going|things|life)\b", re.IGNORECASE)
_SUM = re.compile(r"^[\d\s.+*/x=×÷^()-]+\??$")


def classify(text: str, lexicon: Lexicon) -> Act:
    """What the person does with the sentence, whatever question may be open."""
    said = words(text)
    if is_stop(text, lexicon):
        return "stop"
    if " ".join(said) in lexicon.words("cancel"):
        return "cancel"
    core = strip_courtesy(text)
    if _HOW_ARE_YOU.match(core):
        return "greeting"
    if not core:
        return _small_talk(said, lexicon) or "greeting"
    if _HELP.match(core) or _HELP.match(text.strip()):
        return "help"
    small_talk = _small_talk(said, lexicon)
    if small_talk is not None:
        return small_talk
    if _UNDO.match(core):
        return "undo"
    if _LEAVE.match(core) and len([w for w in said if lexicon.verb(w)]) < 2:
        return "leave"
    if _SUM.match(core):
        return "chat"
    return "question" if is_question(text) else "command"


def is_stop(text: str, lexicon: Lexicon) -> bool:
    """Whether the sentence is a call to halt: a halting word among words that add nothing."""
    said = words(text)
    halt = lexicon.words("halt")
    return any(word in halt for word in said) and all(
        word in halt or word in lexicon.words("halt_company") for word in said
    )


def is_question(text: str) -> bool:
    """Whether the sentence asks about something ("can you push ..." is a command)."""
    asked = _ASKING.sub("", text.strip())
    if asked != text.strip():
        return True
    if _SUGGESTION.match(asked):
        return False
    for said in (asked, strip_courtesy(text), _opening_words(text)):
        if _QUESTION.match(said) and not re.match(r"^(?:any|count)\s*$", said, re.IGNORECASE):
            return True
    return False


def question_core(text: str) -> str:
    """A question without "can you tell me"."""
    return _ASKING.sub("", _opening_words(_ASKING.sub("", text.strip()))).strip(" ?!.")


def _opening_words(text: str) -> str:
    light = r"^(?:(?:hey|hi|hello|ok|okay|so|well|and|please|robot|now|um|uh)\b[\s,!.]*)+"
    return re.sub(light, "", text.strip(), flags=re.IGNORECASE)


def strip_courtesy(text: str) -> str:
    """The sentence without greetings and politeness around it and full stops behind it."""
    core = _OPENING.sub("", text.strip())
    core = _CLOSING.sub("", core)
    core = _COURTESY.sub("", core)
    return core.strip().lstrip(",").strip()


def imperative(core: str, lexicon: Lexicon) -> str:
    """ "moving the cup" (behind "how about") as "move the cup"."""
    first, space, rest = core.partition(" ")
    base = next((s for s in reversed(stems(first.lower())) if s in lexicon.base_verbs), None)
    gerund = first.lower().endswith("ing") and base is not None
    return f"{base}{space}{rest}" if gerund else core


def _small_talk(said: tuple[str, ...], lexicon: Lexicon) -> Act | None:
    """Greetings and thanks: sentences that hold nothing else."""
    filler = {"there", "robot", "armchat", "to", "you", "day", "again", "how", "are", "doing"}
    greets = bool(said) and said[0] in lexicon.words("greetings") and said != ("good",)
    if greets and all(word in lexicon.words("greetings") | filler for word in said):
        return "greeting"
    thanks = lexicon.words("thanks") | {"for", "that", "the", "help", "it", "was", "that's"}
    if said and all(word in thanks for word in said) and set(said) - {"a", "you", "so", "the"}:
        return "thanks"
    return None

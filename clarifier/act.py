"""The dialogue act of a sentence: halt, cancel, small talk, question or command."""

from __future__ import annotations

import re
from typing import Literal

from clarifier.corrections import behind
from clarifier.lexicon import Lexicon
from clarifier.words import stems, words

Act = Literal[
    "stop", "cancel", "greeting", "thanks", "help", "undo", "leave", "why", "question", "chat",
    "command",
]  # fmt: skip

_KIND = r"(?:so kind|kind enough|so good|good enough|able|willing|a dear|a darling|a love|an angel)"
_NICE = r"(?:nice|great|good|lovely|wonderful|helpful|grand|ideal|best|better|cool|super|fab\w*)"
_OPENING = re.compile(
    r"^\s*(?:(?:(?:(?:let's|lets|let us|now) )?(?:(?:do|try|play) )?(?:(?:(?:the|an?|some) )?"
    r"(?:next|(?:an)?other|different|new) (?:thing|job|task|game|one)(?: first)?|"
    r"something (?:else|different|new))(?=\s*[,.:;!-])|please to|please|kindly|"
    r"(?:hey|hi|hello)(?: there)?|ok|okay|alright|all right|well|so|um+|uh+|"
    r"er+m?|now|"
    r"then|next(?! to\b)|just|robot|armchat|dear|first|finally|yo|good morning|also|great|thanks|"
    r"(?:cool|nice|sweet|good|super|excellent|brilliant|awesome|fine|right|wow|hooray)(?=\s*[,!.])|"
    r"(?:thank you|cheers)(?=[\s,!.]+\w)|oh dear|what a mess|"
    r"perfect|lovely|kay|oh|aw+|yay|dude|bro|man|um so|like|go ahead and|go on and|"
    r"what you (?:(?:can|could|should|must|have to|need to|now) )*do (?:now |next |then )?is"
    r"(?: to)?|"
    r"how about|what about|why don't (?:you|we)|why not|"
    r"(?:would|do) you mind(?: awfully| terribly| very much| maybe| please)*|"
    r"would you care to|"
    r"(?:can|could|would|will|might) (?:you|u|ya)(?: please| kindly| just| now| maybe| possibly)*"
    rf"(?: be {_KIND}(?: as to| enough to| and| to)?)?|"
    r"(?:can|could|would|will) (?:the|your|that|this|our) (?:arm|robot|gripper|machine)"
    r"(?: please| kindly| just| now)?|"
    rf"(?:please )?be {_KIND}(?: as to| enough to| and| to)?|are you able to|"
    r"(?:i want|i'd like|i would like|i'd love|i would love|i need|id like|i expect|i wish|"
    r"i'd prefer|i would prefer|i'd want) you to|i(?:'ll| will) have you|"
    r"(?:i want|i'd like|i would like|i'd love|i would love|i need) to|"
    r"(?:i was wondering|i wonder|i'd appreciate it|i would appreciate it|i'd be glad|"
    r"i'd be grateful|i would be grateful|i'd be happy|i would be happy|"
    rf"(?:it would|it'd|would it|that would|it might) be (?:so |very |really )?{_NICE}) "
    r"(?:if|whether) you (?:could|would|can|might)(?: please| kindly)?|"
    r"(?:may|can|could|might) i (?:ask|get|trouble|bother|beg|have) you to|"
    r"(?:is it|would it be|is there) (?:possible|feasible|any way|a way|any chance|a chance)"
    r"(?: for you to| that you could| you could| of you| to)|any chance (?:you could|of you|to)|"
    r"do you think (?:that )?you (?:could|can)|you (?:should|must|can|could|need to|have to|may)|"
    r"(?:i|we) (?:suggest|propose|recommend)(?: that)? you|it(?:'s| is) time to|time to|"
    r"let's|lets|let us|shall we|go ahead and|go on and|try to|try and|go and|come and|"
    r"do me (?:a|the) favou?r(?: and|:|,)|(?:do me )?the (?:favou?r|kindness|courtesy|"
    r"honou?r) of|don't forget to|do not forget to|"
    r"remember to|(?:your|the|my|our) (?:next )?(?:task|job|request|wish|goal|idea|order) is "
    r"(?:for you )?to|make sure (?:to|you)|be sure to|see to it that you|feel free to|"
    r"(?:when|whenever|as soon as|if|once) you(?:'re| are|'ve| have| get| got| find| can| could|"
    r" would| don't| do not| wouldn't)*(?: a| the| some)?(?: free| spare| quick)?"
    r" (?:minute|moment|second|sec|time|chance|mind|ready|done|finished|please|like|able)|"
    r"if it(?:'s| is| isn't| is not)(?: not)? (?:possible|convenient|ok|okay|all right|"
    r"too much(?: trouble| bother| to ask)?|no (?:trouble|bother))|if possible|if i may|"
    r"if you(?:'d| would) be so (?:kind|good)(?: as to| to)?|"
    r"if you (?:can|could|would)(?=,))\b[\s,!.:]*)+",
    re.IGNORECASE,
)
_DEED = re.compile(
    r"^(?:how about|what about|what if|what do you (?:say|think)|why don't (?:you|we)|why not|"
    r"(?:would|do) you mind|would you care|i wonder (?:if|whether)|i was wondering|"
    r"(?:is it|would it be) (?:possible|feasible|ok|okay|alright|all right|fine|too much)|"
    r"is there (?:any|a) (?:way|chance|possibility)|any chance|are you able|"
    rf"would (?:you|it) be|will you|do you think (?:that )?you c|(?:wouldn't|would) it be {_NICE}|"
    r"(?:can|could|may|might) (?:i|we) (?:ask|get|have|trouble|bother|beg|put|move|push|please)|"
    r"what (?:i|we|she|he)(?:'d| would)? (?:\w+ )?(?:want|need|like|love|wish|prefer)|shall we|"
    r"what you (?:\w+ ){1,3}is|"
    r"what would you say|do you think .*\b(?:might|could|should|would|belongs?)|"
    r"do you want to|don't you (?:think|want)|isn't it time|have you (?:got )?(?:time|a m))\b|"
    r"\b(?:supposed to|should(?:n't)? (?:be|go|stand|lie|sit|come))\b",
    re.IGNORECASE,
)
"""Openings that look like questions and ask for a deed."""
_CLOSING = re.compile(
    r"(?:[\s,]*\b(?:please|thanks a lot|thanks|thank you(?: very much)?|for me|cheers|mate|now|"
    r"if you (?:can|could|would|don't mind)|will you|would you|could you|can you|ok|okay|"
    r"right now|(?<!\bthe )(?<!\bmy )(?<!\btoy )(?<!\bthat )(?<!\ba )robot|"
    r"kindly|if possible|buddy|pls|plz|thx|ta|lol|lmao|haha+|xd|hehe|"
    r"real quick|when you get a (?:chance|moment)|asap|yeah|innit|"
    r"if you please|that's all|thank u|tysm)\b)*[\s.!?,;:)]*$",
    re.IGNORECASE,
)
_ANY_WILL_DO = re.compile(
    r"[\s,;.]*\b(?:i (?:do not|don't) (?:care|mind)(?: which(?: one)?)?|no matter which(?: one)?|"
    r"(?:it )?(?:is|it's) all the same (?:for|to) me(?: which(?: one)?)?|whichever(?: one)?"
    r"(?: you like)?|any (?:one )?will do|you (?:choose|pick|decide)(?: one)?|"
    r"(?<!where )(?<!ever )(?<=\w )you like|"
    r"(?<=\w, )any \w+)[\s.!]*$",
    re.IGNORECASE,
)
"""What says behind "a mug", "any apple" once more that any of them will do."""
_COURTESY = re.compile(
    r"[\s,]*\b(?:please|kindly|(?:(?:very|really|as) )?(?:carefully|cautiously)(?: as possible)?|"
    r"with (?:great |much |some )?care|(?:and |but )?be (?:very |really )?careful"
    r"(?! (?:with|of|about|around|not)\b))\b,?",
    re.IGNORECASE,
)
_ASKING = re.compile(
    r"^(?:(?:can|could|would|will) you (?:please |kindly )?(?:tell me|say|explain)|"
    r"tell me(?! (?:a|an|some|another)\b)|"
    r"do you know|i wonder|i'd like to know|let me know|say (?=if|whether|what|where|"
    r"which|how))\b[\s,]*(?:if|whether)?\s*",
    re.IGNORECASE,
)
_ASKS = r"(?:is|are|was|were|do|does|did|will|would|can|could|should|shall|has|have|am|'s|s)\b"
_QUESTION = re.compile(
    rf"^(?:what|what's|whats|where(?: exactly| else)?,? {_ASKS}|where's|wheres|where(?=\W*$)|which|"
    r"who|who's|whose|how (?:many|much|far|big|tall|wide|high|long|large|do|does|are|is|old|come|"
    rf"can)|how|why|when,? {_ASKS}|is|are|isn't|aren't|does|did|was|were|am|has|"
    r"have (?:you|i|we)|do (?:you|i|we|they)|can you (?:see|find|spot|count|reach)|"
    r"(?:can|could|may) (?:i|we) (?:see|say|know|talk|do|use|play|choose|learn|help)|"
    r"could you (?:see|find|count)|count|list|name (?:the|all|every)|"
    r"measure (?=the (?:distance|gap))|"
    r"describe(?! an? (?:circle|square|triangle|loop|ring|arc))|"
    r"show me (?:what|which)|should i|have i)\b|^(?:any|there is|there are|there's)\b(?=.*\?)",
    re.IGNORECASE,
)
_HELP = re.compile(
    r"^(?:help|help me|what can (?:you|i) (?:do|say|ask|tell you)|what do you do|who are you|"
    r"what are you|how do (?:you|i|we) (?:work|use (?:this|you|it)|start)|how does this work|"
    r"what are your (?:skills|commands|abilities)|what (?:commands|can you help).*|"
    r"what are you able to do|what else can you do)\b[\s?!.]*$",
    re.IGNORECASE,
)
_LAST = (
    r"(?:that|it|this|your|the)?(?: very)?(?: last| latest)?"
    r"(?: (?:one|thing|step|move|motion|action))?"
)
_AS_BEFORE = (
    r"(?:like|how|as|the way) (?:it|they|that|things|everything|all) (?:was|were|stood)"
    r"(?: before)?"
)
_UNDO = re.compile(
    r"^(?:undo\b.*|revert\b.*|roll back\b.*|(?:put|move|bring|place|take|set) (?:them both|them|"
    rf"both|those|everything|all(?: of (?:it|them))?|{_LAST}) back(?: again)?(?: {_AS_BEFORE})?|"
    rf"(?:reverse|take back) {_LAST}|go back|back with (?:it|them|that|those|both)|"
    r"(?:(?:them both|both|them|all of them|everything|it) )?back(?: again)?"
    r"(?: to)? (?:where|how) (?:it|they) (?:was|were|stood|lay|sat|started(?: out)?|"
    r"came from|used to be|belonged)(?: before)?|"
    r"(?:them both|both|them|all of them|everything|it) back(?: again)?|"
    r"(?:make|have|leave|set|put) (?:it |everything |all |them |things )?(?:again |back )?"
    rf"{_AS_BEFORE}|as it was(?: before)?|(?:(?:and|now|ok|okay|then) )*back(?: again)?)[\s.!]*$",
    re.IGNORECASE,
)
_SO = re.compile(
    r"^.*[,;.:!]\s*(?:(?:so|and|please|now|then|could you|can you)\b[\s,]*)*(?=\w)", re.IGNORECASE
)
"""What comes before the last clause of a sentence that explains itself first."""
_WHY = re.compile(
    r"^(?:but )?(?:why(?: not| so| that| this)?|(?:why|how come) (?:do|did|are|were|would|won't|"
    r"can't|couldn't|don't|didn't|wouldn't)? ?you\b(?: (?:do|did|say|said|ask|asked|asking|want|"
    r"need|have|had|know|refuse|refused|move|moved|take|took|not|to|me|that|this|it|which|one|so|"
    r"doing))*)[\s?!.]*$",
    re.IGNORECASE,
)
_LEAVE = re.compile(r"^(?:don't|do not|dont|never(?! mind))\s", re.IGNORECASE)
_HOW_ARE_YOU = re.compile(r"^how (?:are|is) (?:you|it going|things|life)\b", re.IGNORECASE)
_SUM = re.compile(r"^[\d\s.+*/x=×÷^()-]+\??$")


def classify(text: str, lexicon: Lexicon) -> Act:
    """What the person does with the sentence, whatever question may be open."""
    said = words(text)
    if is_stop(text, lexicon):
        return "stop"
    if " ".join(said) in lexicon.words("cancel"):
        return "cancel"
    if _WHY.match(text.strip()):
        return "why"
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
    if takes_back(text):
        return "undo"
    if _leaves(text.strip(), core, said, lexicon):
        return "leave"
    if _SUM.match(core):
        return "chat"
    return "question" if is_question(text) and not _goes_on(text, lexicon) else "command"


def _goes_on(text: str, lexicon: Lexicon) -> bool:
    """Whether a sentence that begins as a question ends in a deed: "which one was it again... just
    tap the red one"."""
    *asked, last = re.split(r"(?:\.{2,}|[…!;.]\s)\s*", text.strip(" .!?"))
    first = imperative(strip_courtesy(last), lexicon).partition(" ")[0].lower()
    return bool(asked) and first in lexicon.base_verbs and len(words(last)) > 2


def takes_back(text: str) -> bool:
    """Whether the sentence asks for the last motion to be taken back, whatever leads up to it."""
    said = _CLOSING.sub("", text.strip())
    tried = (text.strip(), behind(text) or "", _SO.sub("", text.strip()), _SO.sub("", said))
    return any(_UNDO.match(strip_courtesy(one)) for one in tried if one)


def is_stop(text: str, lexicon: Lexicon) -> bool:
    """Whether the sentence is a call to halt: a halting word among words that add nothing."""
    said = words(text)
    halt = lexicon.words("halt")
    return any(word in halt for word in said) and all(
        word in halt or word in lexicon.words("halt_company") for word in said
    )


def _leaves(text: str, core: str, said: tuple[str, ...], lexicon: Lexicon) -> bool:
    """ "don't touch the bowl": nothing else is to be done instead."""
    if not _LEAVE.match(core) or _DEED.match(text):
        return False
    if {"but", "only", "just", "instead"} & set(said[1:]):
        return False
    behind_it = re.split(r"[.;!]\s", core, maxsplit=1)[1:]
    if any(lexicon.verb(word) for rest in behind_it for word in words(rest)):
        return False
    return len([word for word in said if lexicon.verb(word)]) < 2


def is_question(text: str) -> bool:
    """Whether the sentence asks about something ("can you push ..." is a command)."""
    if "?" in text and len(words(text.rpartition("?")[2])) > 2:
        return False
    said = _opening_words(text)
    if _DEED.search(said):
        return False
    asked = _ASKING.sub("", text.strip())
    if asked != text.strip():
        return True
    for part in (asked, strip_courtesy(text), said):
        if _QUESTION.match(part) and not re.match(r"^(?:any|count)\s*$", part, re.IGNORECASE):
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
    core = _CLOSING.sub("", _ANY_WILL_DO.sub("", core))
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

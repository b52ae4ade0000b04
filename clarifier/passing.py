"""What is said in passing and wants nothing from the arm: cut before a command is read.

Reasons and company of the person's own ("while I look for my keys", "so that we can eat", "as I
told you"), courtesy ("if it is no trouble", "mind you"), forms of address, and a heading before a
list ("tidy up a bit: ..."). A clause that may want something of the arm stays, as do conditions
("when I say so") and what things are to be like ("while keeping it level").
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from clarifier.words import singular, words

_FOLK = (
    r"(?:i|we|he|she|somebody|someone|everybody|everyone|people|nobody|"
    r"(?:i|we|he|she)(?:'m|'re|'s|'ll|'d|'ve)|"
    r"(?:my|our|his|her|the|some|a few|their) (?:\w+ )?(?:mum|mom|mother|dad|father|wife|husband|"
    r"son|daughter|brother|sister|boss|friends?|guests?|visitors?|kids?|children|baby|dog|cat|"
    r"grandma|grandpa|gran|nan|aunt|uncle|teacher|neighbou?rs?|parents|family|students|pupils|"
    r"class|doctor|nurse|colleagues?|partner|flatmates?|girls|boys|lads))"
)
_SELF = r"(?:i|we|he|she|(?:i|we|he|she)(?:'m|'re|'s|'ll|'d|'ve))"
_REST = r"[^,.;:!?]*?"
_ENDS = (
    r"(?=\s*(?:[,.;:!?]|$)|\s+(?:and|then|but)(?: then)? (?:please )?(?:put|place|move|set|push|"
    r"slide|"
    r"turn|take|pick|lay|bring|lift|stack|touch|tip|line|leave|drop|stick|shove|nudge)\b)"
)
_CLAUSE = re.compile(
    rf"(?P<lead>^|[\s,;:(-]+)(?:exactly |just |precisely |and |but |only )?"
    rf"(?:(?:(?P<aim>while|whilst|in order that|so(?: that)?)|because|cause|cos|coz|since|"
    rf"seeing that|given that|as|like|the way) {_FOLK}\b{_REST}{_ENDS}|"
    rf"(?P<own>{_SELF}) (?:just |really |also |all |still )?(?:need|needs|want|wants|have|has|"
    rf"am|are|is|can|can't|cannot|must|like|going|got|do|don't|might|may|will|won't|"
    rf"think)?\b{_REST}"
    rf"(?=\s*(?:[.;!?]|$)))",
    re.IGNORECASE,
)
_AIM = re.compile(r"\b(?:so|order|seeing|given) that\b", re.IGNORECASE)
_SPARES = re.compile(
    r"(?P<lead>[\s,;-]+)(?:just )?so (?:that )?(?:it|they|that|nothing|nobody|no one)"
    r"(?:'s| is| are)?(?: (?:isn't|aren't|doesn't|don't|won't|can't|cannot|not|never|no longer|"
    rf"does not|do not|will not))+ {_REST}(?=\s*(?:[,.;:!?]|$))",
    re.IGNORECASE,
)
"""What is to be spared, where that is nothing on the table: "so that it isn't on my cuff"."""
_BECAUSE = re.compile(
    r"(?<=\w),? (?:because|cos|coz|cuz|'cause|'cos|bc|since|seeing as|for the reason that|"
    r"on account of)\b"
    r"(?: [^,.;:!?]*?)(?=\s*(?:[.;:!?]|$)|,? (?:so|and then|then|and) (?:please )?(?:put|place|"
    r"move|set|push|slide|turn|take|pick|lay|bring|lift|stack|touch|tip|line|leave|drop|nudge|"
    r"swap)\b)",
    re.IGNORECASE,
)
"""A reason behind what is wanted: never a deed, whatever it names."""
_IS_SO = re.compile(
    r"(?<=\w), (?:it|they|that|those)(?:'s|'re| is| are) (?:(?:very|too|so|really|still|quite) )*"
    r"(?:hot|sharp|fragile|delicate|wet|sticky|precious|mine|breakable|expensive|not mine|dirty|"
    r"brittle|dangerous|valuable|private|borrowed|hers|his)(?=\s*(?:[.,;!]|$))",
    re.IGNORECASE,
)
"""Why a thing is to be handled with care, or not at all."""
_IGNORED = re.compile(
    r"^(?:the|my|that|this|there's|those|these|our) [^,.;!?]*? (?:but|so)(?: just| please)? "
    r"(?:ignore|never mind|don't mind|forget about|pay no attention to|take no notice of) "
    r"(?:that|it|them|this)(?: for now| please| now)?[,.;!]+ (?=\w)",
    re.IGNORECASE,
)
_NOT_LED = re.compile(r"\b(?:soon|far|long|much|many|same|where|not|just)$", re.IGNORECASE)
_BINDING = frozenset(
    {"it", "them", "one", "ones", "that", "this", "these", "those", "left", "right", "top", "edge"}
    | {"middle", "corner", "centre", "center", "end", "row", "line", "order", "closer", "nearer"}
    | {"both", "each", "all", "everything", "other", "others", "front", "back", "side", "anything"}
    | {"you", "something"}
)
"""Words by which a clause can want something of the arm."""
_COURTESY = re.compile(
    r"(?P<lead>^|[\s,;(-]+)(?:if (?:it|that)(?:'s| is|'d be| would be| isn't| is not)(?: not)? "
    r"(?:no|any|too much|all right|alright|ok|okay|fine|possible|convenient|handy|not|a)"
    r"(?: (?:trouble|bother|problem|hassle|to ask|of a bother|with you|by you|great))*"
    r"(?<!\bis not)(?<!n't)|"
    r"if you(?:'d| would)? (?:don't mind|wouldn't mind|be so (?:kind|good)|please|like|can manage"
    r"(?: it| that)?|have the time|have a (?:moment|minute|second))|if i may|if i might|"
    r"mind you|as it were|so to speak|i (?:think|suppose|guess|reckon|believe|say|mean)|"
    r"(?:you know|you see)|by the way|as usual|as always|if at all possible|to be sure|"
    r"there's a (?:dear|love|good \w+|lad|pet)|there you go|no rush|no hurry|"
    r"(?:when|whenever|once|as soon as) you(?:'re| are) ready|"
    r"(?:easy|gently|softly) does it|(?:easy|steady|careful) now)(?=\s*(?:[,.;:!?)]|$))",
    re.IGNORECASE,
)
_ADDRESS = re.compile(
    r"\b(thanks|cheers|please|ta|thank you)(?: a lot| so much| very much)?,? (?:love|dear|"
    r"mate|pal|darling|sweetheart|sweetie|buddy|friend|my friend|duck|robot|chum|guys|hun|babe)"
    r"(?=\s*(?:[,.;!?]|$))",
    re.IGNORECASE,
)
_CALLED = re.compile(
    r",\s*(?:my )?(?P<who>love|lovey|pet|petal|dear|dearie|darling|sweetheart|sweetie|hon|honey|"
    r"hun|babe|duckie|mate|pal|buddy|chum|chap|son|lad|sir|madam|ma'am|friend)"
    r"(?=\s*(?:[,.;!?]|$))",
    re.IGNORECASE,
)
"""Who is spoken to, unless a thing bears the name."""
_TAGGED = re.compile(
    r",\s*(?:would|will|could|can|won't|can't|couldn't) you(?: please| kindly)?"
    r"(?=\s*(?:[,.;!?]|$))",
    re.IGNORECASE,
)
_DONE = re.compile(
    r"[\s,;]*(?:\b(?:and|then)\b[\s,]*)*\b(?:(?:once|when|after|as soon as) (?:that's|that is|"
    r"that has been|"
    r"this is|it's|it is|you(?:'re| are)|you(?:'ve| have)|that one's) (?:all )?(?:done|finished|"
    r"ready|through|there|in place|complete|completed|sorted)(?: (?:so|that|this|it|with (?:that|"
    r"it)))"
    r"?|(?:that|this|which|having) done(?: (?:that|so|this))?|after (?:you(?:'ve| have)? "
    r"(?:did|done)|doing) (?:that|so|this))\s*,?\s+(?=\w)",
    re.IGNORECASE,
)
"""What only says that the next deed comes next."""
_HEADING = re.compile(
    r"^\W*(?:(?:yo|hey|hi|ok|okay|right|so|now|well|please|let's|can you|could you|would you|"
    r"will you|robot|alright)"
    r"[\s,!]+)*(?:(?:please |quickly |just )*(?:tidy|clean|clear|sort|straighten)(?: \w+){0,2}? ?"
    r"(?:up|out)?(?: (?:a|the|this|my|here|bit|little|table|desk|mess|things|stuff|place|for|me|"
    r"now|please|quickly))*|(?:do|here's|here is|this is|listen|look|two|three|four|a few|some|"
    r"several)(?: \w+){0,5}|(?:the |my |your )?(?:plan|list|jobs?|tasks?|orders?|wish|request|"
    r"instructions?|to do|todo|next)(?: \w+){0,3}|(?:lay|set|prepare|do|make|arrange) "
    r"(?:(?:me|us|up|out|for|a|an|the|my|our|one|proper|simple|nice) )*(?:place|table|setting|"
    r"place setting|layout|scene)(?: for (?:me|us|one|two|dinner|lunch|breakfast|tea))?|"
    r"(?:set|lay|get|put)(?: (?:me|us))?(?: out| up)(?: (?:my|our|the|a|an|some)){1,2} \w+(?: "
    r"\w+)?|"
    r"(?:get|make|have)(?: (?:my|our|the|a|an|some)) \w+(?: \w+)? ready)\s*:\s+"
    r"(?=\w)",
    re.IGNORECASE,
)
_ADVERBS = re.compile(
    r"(?<=\w) (?:exactly|precisely|immediately|directly)(?= (?:where|as|on|in|at|to the|next to|"
    r"between|"
    r"beside|behind|under|left|right|by|opposite|\d)\b| the (?:middle|centre|center)\b)|"
    r"\b(?:exactly|precisely) (?=(?:\d|half|one|two|three|four|five|ten|twenty)[\w.]* ?(?:cm|mm|m|"
    r"centi\w+|milli\w+|inch\w*|degrees?|spaces?)\b)|(?<=\bthe )(?:immediate|exact|precise) "
    r"(?=left\b|right\b)",
    re.IGNORECASE,
)
_LEAD = re.compile(
    r"^(?:(?:oh|ah|aha|sorry|forgive me|pardon(?: me)?|excuse me|i beg your pardon|apologies|"
    r"well|um|"
    r"er|hm+|right|of course|please|my mistake|silly me|my bad|yes|ok|okay|i(?:'d| would| should)?"
    r"(?: have)? (?:meant|mean|was thinking of|thought|said|say|think|guess|suppose|want|like|"
    r"wanted)"
    r"(?: it| to say| to go| that)?|i was thinking(?: of)?|make (?:it|that)|let's say|say|perhaps|"
    r"maybe|how about|let it be|it should be|that should be|preferably)\b[\s,.!;:-]*)+(?=\w)",
    re.IGNORECASE,
)
"""What leads up to an answer."""
_REASON = re.compile(
    r"^(?:(?:well|ok|okay|right|hey|listen|look|robot)\W+)*(?:i|we)(?:'d like|'m going|'re going|"
    r"'ve got|'ll have| (?:would like|need|have|want|must|am going|are going|have got|got|ought|"
    r"plan|shall have|will have|should|still have|still need))(?: to)? [^,.;:!?]*?"
    r"(?:,? (?:and )?(?:so|therefore|hence|that's why)(?! (?:that|it|i|we|the|he|she|they|there|my|"
    r"nobody|an?)\b)|[,;](?= ?(?:please|could you|can you|would you)\b)),? +(?=\w)",
    re.IGNORECASE,
)
"""What somebody is about to do, before what is wanted for it: "I need to wipe underneath, so"."""
_NO_DOING = re.compile(
    r"^(?:please,? |now,? )?no (?:more )?(?P<what>\w+ing)"
    r"(?: (?:up|down|about|around|please|over|off|it|them|things|anything|business|allowed|here))*"
    r"\s*[,:;.!-]+\s*(?=\w)",
    re.IGNORECASE,
)
_CARRYING = re.compile(r"\b(?:lift|carry|pick|grab|rais|hoist|hold)\w*", re.IGNORECASE)
_SLIDING = re.compile(r"\b(?:slid|push|shov|drag|nudg|sweep|swept|scoot|pull)\w*", re.IGNORECASE)
_TOLD_OF = re.compile(
    r"^(?:touch|mov|hitt|knock|bump|tipp|tilt|turn|disturb|dropp|break|spill|putt|plac)",
    re.IGNORECASE,
)
"""What is denied by these says something of the deed."""
_LEAST = 3
"""Fewest words that a command is left with."""


def without_asides_said(text: str, names: Iterable[str]) -> str:
    """The command without what it says in passing; ``names`` are those of the scene's things. As it
    was where next to nothing would be left."""
    known = {form for name in names for word in words(name) for form in (word, singular(word))}
    rest = _HEADING.sub(lambda said: said[0] if _names(said[0], known) else "", text, count=1)
    rest = _REASON.sub(lambda said: said[0] if _names(said[0], known) else "", rest, count=1)
    rest = _without_manner(_ADVERBS.sub("", rest))
    rest = _DONE.sub(_then, rest) if not _DONE.match(rest) else rest
    rest = _ADDRESS.sub(r"\1", _COURTESY.sub(lambda said: _gap(said["lead"]), rest))
    rest = _TAGGED.sub("", rest)
    rest = _CALLED.sub(lambda said: said[0] if _names(said["who"], known) else "", rest)
    rest = _IS_SO.sub("", rest)
    rest = _IGNORED.sub("", rest, count=1)
    rest = _BECAUSE.sub(lambda said: _because(said), rest)
    rest = _CLAUSE.sub(lambda said: _cut(said, known), rest)
    rest = _SPARES.sub(lambda said: said[0] if _spares_here(said[0], known) else "", rest)
    rest = re.sub(r"\s+([,.;!?])", r"\1", re.sub(r",\s*(?=[,.;!?])", "", rest)).strip(" ,;:-")
    return rest if len(words(rest)) >= _LEAST else text


def without_lead(text: str) -> str:
    """An answer without what leads up to it: "oh, forgive me, I meant ..."."""
    return _LEAD.sub("", text.strip(), count=1)


def _without_manner(text: str) -> str:
    """ "No lifting, the cup slides ..." without its opening, where what follows says as much."""
    said = _NO_DOING.match(text)
    if said is None or _TOLD_OF.match(said["what"]):
        return text
    rest = text[said.end() :]
    if _CARRYING.match(said["what"]):
        return rest if _SLIDING.search(rest) and not _CARRYING.search(rest) else text
    return text if _SLIDING.match(said["what"]) and _SLIDING.search(rest) else rest


def _names(said: str, known: set[str]) -> bool:
    return any(form in known for word in words(said) for form in (word, singular(word)))


def _then(said: re.Match[str]) -> str:
    return " then " if said.string[: said.start()].rstrip().endswith((".", "!")) else " and then "


def _cut(said: re.Match[str], known: set[str]) -> str:
    """Nothing in place of an aside, but the clause itself where it can want something."""
    before = said.string[: said.start()].rstrip()
    if said["own"] and not said["lead"].strip(" ("):
        return said[0]  # "where I want it" goes on from what was said before
    tells = said["aim"] is None and _names(said[0], known)
    binds = tells or set(words(_AIM.sub("", said[0]))) & _BINDING
    if binds or (_NOT_LED.search(before) and not said["lead"].strip()):
        return said[0]
    return _gap(said["lead"])


def _because(said: re.Match[str]) -> str:
    """Nothing in place of a reason, which itself stays where nothing is wanted before it or where
    a condition leads to it."""
    before = said.string[: said.start()]
    wants = len(words(before)) >= _LEAST and not re.search(r"\b(?:if|not|just|only)$", before)
    return "" if wants else said[0]


def _spares_here(said: str, known: set[str]) -> bool:
    """Whether an aim is about what is on the table, or about a place of it."""
    return _names(said, known) or bool(set(words(said)) & (_BINDING - {"it", "that", "anything"}))


def _gap(lead: str) -> str:
    """What parts the words on both sides of a cut."""
    return lead if lead.strip(" (-") else " "

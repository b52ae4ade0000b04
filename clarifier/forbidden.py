"""Clauses of their own that say what is not to happen: "the lamp must not be moved", "nothing else
may shift", "only the cup is to be touched", "nobody asked you to move the phone".

They ask for nothing. Each is cut from what is translated and becomes a fact that the forecast must
keep (`clarifier.unasked`). What speaks of the deed itself ("don't push it, lift it") is none.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal

from clarifier.frame import Frame, frame
from clarifier.spoken import Linked, Spoken
from clarifier.words import stems

Scope = Literal["these", "others", "rest", "all"]
"""What must stay: the things named; all but the things named; what the deed does not move; all."""

DISTURBING = frozenset(
    {"touch", "tap", "press", "contact", "move", "shift", "disturb", "displace", "bother", "drop"}
    | {"damage", "scratch", "spill", "collide", "affect", "brush", "graze", "break", "budge"}
    | {"jostle", "crash", "run", "tilt", "wobble", "shake", "rattle", "hit", "bump", "knock"}
    | {"push", "nudge", "topple", "tip", "overturn", "upset", "crush", "smash", "harm", "clip"}
)
"""What one asks not to happen to a thing, while something else is done."""
TOUCHING = frozenset({"touch", "tap", "press", "contact", "hit", "bump", "brush", "graze"})
"""Of those, what a tool that comes down on a thing does to it."""
_HANDLING = frozenset({"pick", "lift", "take", "grab", "put", "place", "go"})
"""Deeds that nobody may need to do either."""

_THESE = r"(?P<these>[#@]\d+(?: (?:(?:,|and|or|nor) )+[#@]\d+)*)"
_NAMED = _THESE.replace("[#@]", "#")
_MODAL = (
    r"(?:(?:must|should|may|can|could|shall|will|would|is|are|has|have|need|needs|ought|to|be|get|"
    r"being|all|both|itself|themselves|also|ever|please|really|absolutely|simply|just) )*"
)
_NOT = (
    r"(?:not|never|no|mustn't|shouldn't|can't|cannot|couldn't|isn't|aren't|needn't|won't|don't|"
    r"dont|doesn't|ain't) "
)
_DONE = r"(?P<verb>\w+)"
_STILL = (
    r"(?: (?:right|exactly|just|precisely|put|still|there|here|alone|be|untouched|undisturbed|"
    r"in (?:its|their) (?:place|places|spot)|in place|where @\d+ (?:is|are|was|stands?|lies?)|"
    r"where (?:it's|they're)|as @\d+ (?:is|are|was)|as (?:it's|they're)|as (?:it|they) (?:is|are)|"
    r"where (?:it|they) (?:is|are)|out of (?:@\d+|it|this)))*"
)
_THERE = (
    r" (?:at|in|on|by) (?:the |its |their |my )?(?:(?:top|bottom|left|right|far|near|middle|"
    r"centre|center|back|front|edge|side|corner|upper|lower|rear|of|the|table|hand|half|part)"
    r"(?: |$|(?=\W)))+(?<! )"
)
"""Where it is already."""
_AT_ALL = (
    r"(?: (?:at all|in any way|whatsoever|anywhere|an inch|one bit|a bit|by you|by anyone|around|"
    r"about|over|though|either|from (?:its|their|where @\d+ (?:is|are)|the)(?: \w+)?|"
    r"in the process|under any circumstances|on the table|here|please|ok|okay|thanks|"
    r"thank you|dear|love|mate))*"
)
_ELSE = r"(?P<else> else| other than @\d+)?"
_ANYTHING = r"(?P<any>(?:anything|a thing|any thing|something|any other things?|anybody))"
_HANDS = r"(?:hands?|fingers?|paws?|mitts?|claws?|gripper|arm)"
_ASK = r"(?:ask|asked|tell|told|say|said|want|wanted|mention|mentioned|need|order|ordered|invited)"

_FORMS: tuple[tuple[Scope, str], ...] = (
    # "the lamp must not be moved", "the saucer don't move"
    ("these", rf"{_THESE} {_MODAL}{_NOT}{_MODAL}{_DONE}{_AT_ALL}"),
    ("these", rf"{_NAMED} no"),
    ("these", rf"neither {_NAMED} {_MODAL}{_DONE}{_AT_ALL}"),
    ("these", rf"(?:don't|dont|do not|never) do (?:anything|a thing) (?:with|to|about) {_NAMED}"
              rf"{_AT_ALL}"),
    ("these", rf"{_NAMED} : (?:please )?(?:do not|don't|dont|not to|no) {_DONE}{_AT_ALL}"),
    ("these", rf"(?:keep|let) {_NAMED}(?: stay| remain)?{_STILL[:-1]}+{_AT_ALL}"),
    ("these", rf"{_NAMED} (?:is|are) \w+(?: (?:,|so|and))+ (?:please )?(?:leave|let) "
              rf"@\d+(?: well)?{_STILL[:-1]}+{_AT_ALL}"),
    ("these", rf"(?:under no circumstances|on no account|in no case|by no means) {_MODAL}{_NAMED} "
              rf"{_MODAL}{_DONE}{_AT_ALL}"),
    ("these", rf"(?:under no circumstances|on no account|in no case|by no means) "
              rf"(?:(?:must|should|may|are|do|you|to) )*{_DONE} {_NAMED}{_AT_ALL}"),
    ("these", rf"{_NAMED},? (?:you )?(?:leave|let){_STILL[:-1]}+{_AT_ALL}"),
    ("these", rf"(?:mustn't|must not|may not|shouldn't|should not|better not|not allowed to|no) "
              rf"(?:ever )?{_DONE} {_NAMED}{_AT_ALL}"),
    ("these", rf"i(?:'d| would) (?:rather|prefer)(?: that| it if)? you (?:didn't|did not|not|don't|"
              rf"wouldn't) {_DONE} {_NAMED}{_AT_ALL}"),
    ("these", rf"{_THESE} {_MODAL}keeps? (?:its|their) (?:places?|spots?|positions?){_AT_ALL}"),
    # "the lamp stays where it is", "the two cups are to be left alone"
    ("these", rf"{_THESE} {_MODAL}(?:stays?|remains?|left|keeps?) ?(?<! ){_STILL}{_AT_ALL}"),
    ("these", rf"{_THESE} {_MODAL}(?:stays?|remains?)(?: up| down| over)?(?: there| here)?{_THERE}"
              rf"{_AT_ALL}"),
    ("these", rf"{_NAMED} (?:is|are) (?:fine|good|ok|okay|perfect|right|great|well){_STILL}"),
    ("these", rf"{_NAMED} (?:is|are) (?:off[ -]*limits|out of bounds|taboo|none of your business|"
              r"not (?:part of|for) (?:@\d+|this|it|you|touching|moving))"),
    # "nothing else may move", "everything else stays as it is"
    ("others", rf"nothing(?: else)? {_MODAL}{_DONE}{_AT_ALL} (?:except|but|besides|save|apart from|"
               rf"other than|bar)(?: for)? {_NAMED}"),
    ("others", rf"nothing (?:except|but|besides|apart from|other than|bar)(?: for)? {_NAMED} "
               rf"{_MODAL}{_DONE}{_AT_ALL}"),
    ("others", rf"only {_NAMED} {_MODAL}{_DONE}{_AT_ALL}"),
    ("others", rf"(?P<verb>move|touch|shift|disturb) (?:only|just|nothing but) {_NAMED}"),
    ("others", rf"{_NAMED} (?:is|are) the only (?:things?|ones?) (?:that|which|to|you)+ "
               rf"{_MODAL}{_DONE}{_AT_ALL}"),
    ("others", rf"the only (?:things?|objects?|items?) (?:(?:that|which|to|you) )*{_MODAL}{_DONE} "
               rf"(?:is|are) {_NAMED}{_AT_ALL}"),
    ("rest", rf"(?:no other|none of the other) (?:things?|objects?|items?|ones?) {_MODAL}{_DONE}"
             rf"{_AT_ALL}"),
    ("all", rf"let nothing{_ELSE} {_MODAL}{_DONE}{_AT_ALL}"),
    ("all", rf"nothing{_ELSE} {_MODAL}{_DONE}{_AT_ALL}"),
    ("all", rf"everything(?: on (?:the|my) (?:table|desk)| here)?{_ELSE} {_MODAL}"
            rf"(?:stays?|remains?|left|keeps?) ?(?<! ){_STILL}{_AT_ALL}"),
    ("rest", rf"(?:without|avoid|avoiding|don't|dont|do not|never|no) (?:ever |please |even |you |"
             rf"to )*{_DONE} {_ANYTHING}{_ELSE}{_AT_ALL}"),
    # "nobody asked you to move the phone", "you need not touch the phone"
    ("these", rf"(?:nobody|no one|none|i (?:never|did not|didn't|don't|do not|haven't|have not)) "
              rf"(?:has |have |ever |even )*{_ASK}(?: (?:you|anything|a word|for|me|about|of|to|"
              rf"that))*(?: {_DONE})? {_NAMED}{_AT_ALL}"),
    ("these", rf"i (?:do not|don't|never) want {_NAMED} {_MODAL}{_DONE}{_AT_ALL}"),
    ("these", rf"(?:nobody|no one) (?:is to |must |may |should |can |shall |will )*{_DONE} {_NAMED}"
              rf"{_AT_ALL}"),
    ("these", rf"(?:you |u )(?:need not|needn't|do not|don't|must not|mustn't|may not|should not|"
              rf"shouldn't|cannot|can't|are not|aren't)(?: (?:need|have|allowed|supposed|to|"
              rf"ever))* {_DONE} {_NAMED}{_AT_ALL}"),
    ("these", rf"(?:there's |there is |you have |you've got )?no need (?:for you )?(?:to|of) "
              rf"{_DONE} {_NAMED}{_AT_ALL}"),
    ("these", rf"(?:keep |take )?(?:your |the |those )?{_HANDS} off (?:of )?{_NAMED}{_AT_ALL}"),
    ("these", rf"(?:stay|keep|steer) (?:well |right )?(?:away from|clear of|off) "
              rf"{_NAMED}{_AT_ALL}"),
    ("these", rf"(?:leave|keep) {_NAMED} out of (?:@\d+|it|this|that){_AT_ALL}"),
    ("these", rf"(?:@\d+|it) (?:is|'s) (?:strictly )?(?:forbidden|prohibited|not allowed|"
              rf"not permitted|not ok|not okay) (?:for you )?to {_DONE} {_NAMED}{_AT_ALL}"),
)  # fmt: skip
_LEAD = (
    r"(?P<lead>^|(?<= )(?:[.,;:!?] |and |but |while |whereas |though |yet |just |only |so |then )+)"
    r"(?:(?:also|please|mind|remember|oh|whatever you do|of course|ok|okay|well|but|and|make sure|"
    r"be sure|see to it|ensure|(?:it's|it is|@\d+ is) (?:very |really )?(?:important|vital|"
    r"essential|crucial|best|better)|dear|love|mate|note)(?: that)? (?:, )?)*"
)
_END = r"(?= (?:[.,;:!?]|and|but|so|then|just|only|simply|please|instead|ok|okay|while)(?: |$)|$)"
_PATTERNS = tuple((scope, re.compile(f"{_LEAD}(?P<ban>{form}){_END}")) for scope, form in _FORMS)
_TOO = re.compile(r"(?: [.,;])? (?:and |so )*(?P<more>#\d+) (?:too|as well|also)(?= [.,;!]|$)")
"""What goes for one more thing."""
_STAYS = re.compile(r" (?:stays?|remains?|left|keeps?|fine|good|ok|okay|perfect|great|well)\b")
_CHOICES = frozenset({"if", "otherwise", "unless", "when", "whether", "until", "provided"})
"""Where one of these is said, what must stay may hang on it."""


@dataclass(frozen=True)
class Ban:
    """Tokens ``first:last`` say that things must stay. ``verb``: what is not to happen to them, ""
    where that was not said; ``named``: the mentions that it speaks of."""

    first: int
    last: int
    scope: Scope
    verb: str
    named: tuple[Spoken, ...]


def bans(linked: Linked) -> tuple[Ban, ...]:
    """The clauses of a sentence that only say what must stay, in order."""
    if _CHOICES & {token.text for token in linked.tokens}:
        return ()
    shape = frame(linked)
    found: list[Ban] = []
    for scope, pattern in _PATTERNS:
        for said in pattern.finditer(shape.text):
            ban = _ban(scope, said, shape)
            if ban is not None and all(b.last <= ban.first or ban.last <= b.first for b in found):
                found.append(ban)
    return tuple(sorted(found, key=lambda ban: ban.first))


def _ban(scope: Scope, said: re.Match[str], shape: Frame) -> Ban | None:
    """What a pattern found, as a ban; None where what it denies is not a disturbance."""
    groups = said.groupdict()
    verb = "move" if _STAYS.search(said["ban"]) else ""
    if groups.get("verb"):
        known = DISTURBING | (_HANDLING if groups.get("these") else frozenset())
        verb = next((stem for stem in stems(groups["verb"]) if stem in known), "")
        if not verb:
            return None
    if scope == "all" and groups.get("else"):
        scope = "rest"
    these, end = shape.among(groups.get("these")), said.end()
    more = _TOO.match(shape.text, end) if scope == "these" else None
    if more is not None:
        these, end = (*these, *shape.among(more["more"])), more.end()
    return Ban(shape.token(said.end("lead")), shape.token(end), scope, verb, these)

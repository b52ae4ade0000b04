"""Where things are to go, in turns of phrase that leave the verb or the thing to what was said
before: "the cup goes on the tray and so does the mug", "the tray has room for one of the cups, the
others go on the plate", "onto the floor over the far edge with it".
"""

from __future__ import annotations

import re
from collections.abc import Callable

from clarifier.lexicon import load_lexicon
from clarifier.words import singular

_Plain = str | Callable[[re.Match[str]], str]
_GOES = {"goes": "go", "gets": "get", "comes": "come", "belongs": "belong", "moves": "move"}
_REST = r"(?P<rest>others?(?: ones)?|rest|remaining ones)"


def _both_so(said: re.Match[str]) -> str:
    """ "The cup goes on the tray and so does the mug": both go there."""
    does = _GOES.get(said["does"].lower(), said["does"])
    return f"{said['one']} and {said['other']} {does} {said['to']}"


def _no_more_room(said: re.Match[str]) -> str:
    """ "The tray has room for one of the cups, so the others go on the plate": how they are
    shared out."""
    way = load_lexicon().goes(singular(said["into"].lower().split()[-1])) or "in"
    into = said["into"][:1].lower() + said["into"][1:]
    return f"put {said['some']} {way} {into} and the {said['rest'].lower()} {said['to']}"


WHITHER: tuple[tuple[str, _Plain], ...] = (
    # "the cup goes on the tray and so does the mug"
    (
        r"^(?P<one>(?:the|my|that|this|an?|any|one of|it)\b[^,.;:]*?) "
        r"(?P<does>goes|gets|comes|belongs|moves|should \w+|must \w+|can \w+) "
        r"(?:up (?=on(?:to)?\b))?(?P<to>[^.;:]+?),? and so (?:does|do|should|must|can|is) "
        r"(?P<other>[^,.;:]+?)(?=\s*[.!]*$)",
        _both_so,
    ),
    # "the cup put in bowl, and the mug put on the tray"
    (
        r"(?P<lead>^|, | and )(?P<what>(?:the|my|that|this) (?:\w+ ){0,2}?\w+"
        r"(?:,? and (?:the|my|that|this) (?:\w+ ){0,2}?\w+)*) "
        r"(?P<put>put|place|set|bring|lay|push|slide) (?=(?:in|on|into|onto|next to|beside|behind|"
        r"left of|right of|under) (?:the |my |a )?(?:\w+ ){0,2}\w+\s*(?:[,.;!]|$))",
        r"\g<lead>\g<put> \g<what> ",
    ),
    # "red cup by the tray"
    (
        r"^((?:(?:the|my|that|this) )?\w+(?: \w+)?) by (?=(?:the|my|that|this) (?:\w+ )?\w+[.!]*$)",
        r"\1 next to ",
    ),
    # "at the back edge put the cups"
    (
        r"^(?P<at>(?:at|in|on|along|into|onto) (?:the|my) [^,.;:]*?(?:edge|corner|half|side|middle|"
        r"cent(?:re|er)|quarter)(?: of the table)?),? (?P<put>put|place|set|lay|move|stand) "
        r"(?P<what>(?:the|my|all|both|every|each|an?|one|two|three|these|those)\b"
        r"(?:(?! (?:on|in|at|into|onto|by|next|behind|beside)\b)[^,.;:])*?)(?=\s*(?:[,.;!]|$))",
        r"\g<put> \g<what> \g<at>",
    ),
    # "one of the cups is enough onto the tray"
    (
        r"\b(one|two|three) (of (?:the|all|both|my)\b[^,.;:]*?) (?:is|are|will be|would be) "
        r"(?:enough|plenty|sufficient) (?=(?:on|in|at|by|next|behind|beside)\w* )",
        r"\1 \2 ",
    ),
    # "if the cup has the mug on its left"
    (
        r"\bif ((?:the|my|that|this)\b[^,.;:]*?) has ((?:the|my|that|this)\b[^,.;:]*?) (?:on|to) "
        r"(?:its|the) (left|right)(?: side)?(?=\s*(?:[,.;:]|$| then\b))",
        r"if \2 is \3 of \1",
    ),
    # "over the far edge, down onto the floor", "onto the floor over the far edge"
    (r"(?<=\bedge),?(?: and)? (?:down )?(?:on|to|onto)(?:to)? the (?:floor|ground)\b", ""),
    (
        r"\b(?:down )?(?:on|onto|to) the (?:floor|ground),? (?:off|over|across|past|by way of) "
        r"(?=the \w+ (?:edge|side)\b)",
        "off ",
    ),
    # "one of the cups in the tray, rest on the plate"
    (
        r"(?<=[,;]) (?:and )?(rest|others|remainder)"
        r"(?= (?:in|on|into|onto|to|at|by|next|go|goes)\b)",
        r" the \1",
    ),
    # "the tray has room for one of the cups only, so the others go on the plate"
    (
        r"^(?P<into>(?:the|my|that|this)\b[^,.;:]*?) (?:only )?(?:has|have|offers) "
        r"(?:only |just )?(?:room|space) for (?:only |just )?"
        r"(?P<some>(?:one|two|three|an?)\b[^,.;:]*?)(?: only)?\s*[,;:.]\s*"
        rf"(?:so |and |hence |therefore |thus )*(?:the )?{_REST} "
        r"(?:go(?:es)? |belongs? |should go |must go |can go )?"
        r"(?P<to>(?:in|on|at|by|next|beside|behind)\w*\b[^,.;:]*)",
        _no_more_room,
    ),
)
"""Patterns and what each is put as."""

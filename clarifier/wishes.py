"""Wishes told as questions or as what happens: "might the bell be returned to its box?", "could the
thimble come nearer to me?", "and then the knight falls down, boom". Put as what is to be done, with
the things and places as they are said.
"""

from __future__ import annotations

import re
from collections.abc import Callable

_LEAD = (
    r"^(?:(?:please|well|so|now|ok|okay|and|but|then|excuse me|pardon(?: me)?|forgive me|sorry|"
    r"i(?: do| really)? beg your pardon|i wonder|i was wondering|on reflection|on second thoughts?|"
    r"i hate to (?:ask|bother you)|i(?:'m| am)(?: so| quite| very)? sorry to (?:ask|bother you))"
    r"(?:\b[\s,.:;!-]+)(?:but )?)*"
)
_WHAT = (
    r"(?P<what>(?:the|my|that|this|those|these|both|all|each|every|one of)\b(?: (?!be\b|please\b|"
    r"kindly\b|then\b|not\b|never\b)[\w'-]+){1,6}?)"
)
_SOFTLY = r"(?: please| kindly| perhaps| possibly| maybe| just| also| then| now)*"
ASKED = re.compile(
    rf"{_LEAD}(?:might|could|can|may|would|should|shouldn't|couldn't) {_WHAT}{_SOFTLY} be{_SOFTLY} "
    r"(?P<verb>\w+)\b(?P<rest>[^?]*)\?*$",
    re.IGNORECASE,
)
""" "Might the cup be moved to the left?": somebody is to do it."""
_PLACE = (
    r"(?:(?:a (?:little|bit|touch|tad)|slightly|just|right|over|down|up|back|straight|somewhat|"
    r"much|somewhere|all the way) )*(?:nearer|closer|next to|beside|between|behind|in front of|to|"
    r"on|onto|into|in|towards?|by|near|left|right|away|further|farther|forwards?|backwards?|along|"
    r"over|at)\b"
)
_BANG = (
    r"(?:\W+(?:boom|bang|crash|splash|smash|thud|splat|plop|wham|ouch|kaboom|timber|ow+|oh no|"
    r"and|with an?|big|loud|so tired))*"
)
_FALLS = (
    r"(?:(?:falls|topples|tumbles|keels|tips)(?: right| all the way)? (?:over|down)|"
    r"falls flat(?: on (?:its|his|her) (?:face|back|side))?)"
)
WISHES: tuple[tuple[str, str | Callable[[re.Match[str]], str]], ...] = (
    # "could the thimble come a little nearer to me?"
    (
        rf"(?:(?<=[.;!] )|{_LEAD})(?:might|could|can|may|would) "
        rf"(?:{_WHAT}|(?P<it>it|they)){_SOFTLY} (?:come|move|shift|retire|"
        rf"travel|wander|shuffle)(?: along)? (?={_PLACE})(?P<rest>(?:(?! and\b)[^?,;])*),?"
        r"(?: please)?\?*$",
        lambda said: f"move {said['what'] or said['it']} {said['rest']}",
    ),
    # "whichever of these is the tallest", "whatever is standing left of the vase"
    (
        r"\b(?:whichever|whatever|which) of (?:these|those|them)(?: things| objects)?"
        r"(?: here)? (?:is|stands|looks) (?:the )?(?P<how>\w+est)\b(?! (?:to|from)\b)",
        r"the \g<how> thing",
    ),
    (
        r"^(?:whatever|what)(?:'s| is|ever's)? (?:standing|sitting|lying) "
        r"(?=(?:to the |on the )?(?:left|right) of|behind|in front of|next to|beside|"
        r"nearest|closest)",
        r"the thing ",
    ),
    # "restored to its former position"
    (
        r"\b(?:restored|returned|put back) to (?:its|their) (?:former|original|old|previous|first) "
        r"(?:place|position|spot|location)s?",
        "put back where it was",
    ),
    # "and then the knight falls down, boom", "oh no the rocket falls over"
    (
        r"^(?:(?:and|then|now|so|oh no|uh oh|ok|okay|boom|bang|crash|\d+|three|two|one|go|look)\b"
        rf"[\s,.!]*)*(?P<what>(?:the|my|that|this) \w+(?: \w+){{0,2}}?) {_FALLS}"
        rf"{_BANG}(?:\W+(?:cos|cause|because|coz|'cause)\b.*)?\W*$",
        r"knock over \g<what>",
    ),
    # "make it so that the can falls over"
    (
        rf"^(?:please )?(?:make|let)(?: once| it| it so| sure| it happen)?(?: so)? that "
        rf"(?P<what>(?:the|my|that|this) \w+(?: \w+){{0,2}}?) {_FALLS}(?=\s*(?:[.,;!?]|$))",
        r"knock over \g<what>",
    ),
    # "do indicate for my guests where the vase is"
    (
        r"^(?:please |kindly |do |can you |could you |would you )*(?:indicate|point out)"
        r"(?: (?:to|for) (?:me|us|him|her|them|(?:my|our|the) \w+))?"
        r"(?:,? (?:with|using) (?:your|a|one of your|that|an) [^,.;?]+?)?,? where "
        r"(?P<what>(?:the|my|that|this) [^,.;?]+?) (?:is|stands|lies|sits)(?=\s*(?:[.,;!?]|$))",
        r"point at \g<what>",
    ),
)  # fmt: skip
PARTED = {"returned": "put", "restored": "put", "conveyed": "move", "laid": "lay"}
"""What is to be done by participles whose verb no command has."""

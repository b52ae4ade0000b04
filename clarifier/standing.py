"""Where a thing stands, said of it to tell it from others: "the block that is the most at the
right", "the box up there on the left", "the second pawn counting from my side", "what stands in
front of the horse shall go ...". Put in the words that `attach` takes for part of the phrase.
"""

from __future__ import annotations

import re
from collections.abc import Callable

_SIDE = r"(?:left|right|top|bottom|front|back|middle|centre|center|near|far)"
_OF_A_SIDE = rf"(?:on|at|in) (?:the |my |your )?(?:(?:very|far|near) )?{_SIDE}\b"
_LED = (
    r"(?:in front of|behind|(?:to |on )?(?:the )?(?:left|right) of|next to|beside|close to|near|"
    r"around|round|about|into|inside|onto|towards?|to|in|on|by)"
)
_THE_ONE = (
    rf"(?:the|my|that|this|those|these) (?!table|desk|board|{_SIDE}(?![\w-]))(?:[\w'-]+ ){{0,2}}?"
    r"(?!edge|corner|side|half|part)[\w'-]+"
)
_LANDMARK = rf"{_LED} {_THE_ONE}"
_IS_TO = (
    r"(?:(?:shall|should|must|may|can|could|will|would|has to|have to|needs to|is to|ought to|"
    r"wants to|please|kindly|now) )+(?:be )?"
)
_WALKS = (
    r"(?:go|come|move|get|trot|walk|march|hop|run|wander|stroll|fly|sail|crawl|creep|travel|"
    r"retire|retreat|hurry|ride|roll|waddle|gallop)"
)
_OFF = r"(?: (?:off|over|away|along|up|down|across|back))*"
_LIES = re.compile(r" (?:lying|sitting|standing|lies|sits|stands)\b[^,]*? (?=(?:in|on|at)\b)")


def _told_first(said: re.Match[str]) -> str:
    """ "There is a disc lying in the corner, it should go ...": put the disc in the corner ..."""
    what = _LIES.sub(" that is ", said["what"])
    return f"put the {what} {'next to ' if said['joins'] else ''}"


STANDING: tuple[tuple[str, str | Callable[[re.Match[str]], str]], ...] = (
    # "there is a disc lying in the corner, and I think it should go ..."
    (rf"^there(?: is|'s) an? (?P<what>[^,.;:!?]*?)(?:,| and)+ (?:i (?:think|guess) |maybe |"
     rf"perhaps |i'd say )?(?:it|that one|which|that) {_IS_TO}(?:{_WALKS}{_OFF} |(?P<joins>join) )",
     _told_first),
    # "the block what is the most at the right"
    (r"\b(the )?most (?:at|on|to|towards) (?:the |my )?(left|right)(?: side| hand side)?"
     r"(?=\W*$|\s*[,.;:]| (?:goes|should|must|put|please|you|and|can|may)\b)", r"\1\2most"),
    # "the disc lying down in the corner"
    (r"\b(lying|sitting|standing|lies|sits|stands) (?:(?:all )?by (?:itself|himself|herself)|alone|"
     r"down|up|over|out|back|there|here|right|just|all|around|about|somewhere| )+ "
     r"(?=(?:in|on|at|by|near|next|beside|behind|left|right|between|to)\b)", r"\1 "),
    # "into the box up there on the left", "behind the left disc, at the right there"
    (rf"\b({_LANDMARK}|of {_THE_ONE})(?: up| down| over| back| out| right)* there,? "
     rf"(?={_OF_A_SIDE})", r"\1 that is "),
    (rf"\b({_LANDMARK}),? ({_OF_A_SIDE})(?: corner| side| part| edge)? there\b", r"\1 that is \2"),
    (r"\b((?:go|goes|put|lie|stand)\b[^,.;:]*? on the (?:left|right)(?:[ -]hand)?(?: side)?) there"
     r"(?=\W*$|\s*[,.;:])", r"\1"),
    # "next to the ball up in the corner", "in each of the bowls along the top"
    (rf"\b({_LANDMARK}) (?:up|down) (?={_OF_A_SIDE}|(?:in|at) (?:the|that) corner\b)",
     r"\1 that is "),
    (rf"\b({_LANDMARK}|each of (?:the|these|those|my) [\w'-]+) along (?=the (?:left|right|top|"
     r"bottom|front|back)\b(?! edge| side))", r"\1 at "),
    # "the second pawn counting from my side", "third cone form the right"
    (r"(?:,? (?:if (?:you|we|i) )?(?:count(?:ed|ing)?|start(?:ed|ing)?|seen|reckoned|going))"
     r"(?: off| up| it)? from (?:the |my )?(left|right|front|back|far|near)(?: side| end| edge|"
     r"[ -]hand side)?(?=\s*(?:[,.;:!]|$))", r" from the \1"),
    (r",? (?:if (?:you|we|i) )?(?:counting|counted|count|starting) from (?:my side|my end|me|"
     r"where i (?:sit|am|stand))(?=\s*(?:[,.;:!]|$))", " from the front"),
    (r"\b((?:first|second|third|fourth|fifth|last|1st|2nd|3rd|4th|5th) (?:[\w'-]+ )?)form "
     r"(?=the (?:left|right|front|back)\b)", r"\1from "),
    # "what stands in front of the horse shall trot off to the top edge"
    (rf"^(?:what|whatever)(?:'s|ever)? (?:is |stands |lies |sits |is (?:standing|lying|sitting) )?"
     rf"(?P<where>{_LED} (?:the|my|that) (?:[\w'-]+ )??[\w'-]+) {_IS_TO}{_WALKS}{_OFF} "
     r"(?=(?:to|into|onto|in|on|next|beside|behind|by|between|left|right|at)\b)",
     r"whatever stands \g<where> goes "),
    # "to the top edge, right in the middle of it"
    (r"\b(to|at|on|onto|along|against) (the (?:left|right|top|bottom|front|back|near|far) edge),? "
     r"(?:right |bang |exactly |just |smack |dead )*(?:in|at) (?:the|its) (?:very |exact )?"
     r"(?:middle|centre|center)(?: of it)?(?=\W*$|\s*[,.;:])", r"\1 the middle of \2"),
    # "I want it to end up lying behind the cup"
    (rf"\bto end up (?:lying |standing |sitting )?(?=(?:right |just )?{_LED}\b)", "to be "),
)  # fmt: skip
"""Patterns and what each is put as."""

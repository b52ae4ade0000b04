"""Other ways of saying the same: turns of phrase put into the plainer words that the rest reads.

Each keeps the things, places and measures of the sentence as they are said; none makes a program.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from clarifier.words import singular

_ORDINALS = {"1st": "first", "2nd": "second", "3rd": "third", "4th": "fourth", "5th": "fifth"}
_NTH = r"(first|second|third|fourth|fifth|last|leftmost|rightmost|1st|2nd|3rd|4th|5th)"
_END = r"left|right|front|back"
_NO_COLOR = (r"(?:same|this|that|which|what|other|another|different|its|own|their|matching|equal|"
             r"one)\b")  # fmt: skip
_PLACE = r"(?:on|in|into|onto|at|next to|beside|under|behind|near|left of|right of|to|inside)"
_NO_NOUN = "".join(rf"(?<!\b{word} )" for word in (
    "the", "a", "that", "this", "my", "each", "every", "your", "our"))  # fmt: skip
_COUNTED = re.compile(rf"\b{_NTH}(?: \w+)? $", re.IGNORECASE)


def _counted_from(said: re.Match[str]) -> str:
    """ "From the left the second block"; in "the third block from the left, the second block from
    ..." that is said of the one before."""
    if _COUNTED.search(said.string[: said.start()]):
        return said.group()
    return f"the {said[2]} {said[3]} from the {said[1]}"


_Plain = str | Callable[[re.Match[str]], str]
_TURNS: tuple[tuple[str, _Plain], ...] = (
    # "bowl it over", "throw the can over on its side"
    (rf"{_NO_NOUN}\bbowl (it|them|this|that|these|those|both)\b(?=[^,.;]*? over\b| over\b)",
     r"knock \1"),
    (r"\b(?:throw|toss|chuck|fling) (it|them|[^,.;]*?)(?: over| down)?(?: flat)? on(?:to)? "
     r"(its|their) sides?\b", r"knock \1 over on \2 side"),
    # "no touching the cup, ..."
    (r"\bno ((?:touch|mov|push|hitt|knock|bump|tipp|disturb|dropp|spill|nudg)ing) "
     r"(?=(?:over )?(?:the|my|that|this|any|it|them)\b)", r"without \1 "),
    (r"\b(?:lay|put) (?:a|your) finger (?:up)?on(?=\b)", "touch"),
    (r"\b(an?|one|one of the) ((?:\w+ ){1,2})per (?=\w)", r"\1 \2for each "),
    # "boop the cup on its head"
    (r"\b((?:touch|tap|boop|poke|pat|prod) [^,.;]*?) on (?:the|its|their) "
     r"(?:heads?|nose|shoulder)\b", r"\1"),
    (r"\b(?:go (?:and )?|come (?:and )?)(?=boop\b)", ""),
    # "the two of the mugs at the ends"
    (r"\bthe two of ((?:all )?(?:the|these|those|my) \w+s) at (?:the|both) ends\b",
     r"the two at the ends of \1"),
    # "the block that is second from the left", "from the left side the second block"
    (rf"\bthe (\w+)(?: that| which| what)?(?: is| comes| stands)(?: the)? {_NTH} from the "
     r"(left|right|front|back)\b", r"the \2 \1 from the \3"),
    (rf"\bfrom the (left|right|front|back)(?: side| hand side)?,? the {_NTH} (\w+)\b",
     _counted_from),
    (rf"\bcount (?:(?:all|off) )?(?:the |these |those |all )?(\w+) from (?:the )?({_END})"
     r"(?: side| hand side)?[\s,;.]+(?:(?:and|then|please|now)[\s,]+)*(\w+(?: up)?) the "
     rf"{_NTH}(?: one)?\b",
     lambda said: f"{said[3]} the {said[4]} {singular(said[1])} from the {said[2]}"),
    # "the block of purple colour", "the one with the green color"
    (rf"\b(\w+) (?:of|with|in)(?: a| the)? (?!{_NO_COLOR})(\w+) colou?r\b", r"\2 \1"),
    # "down there on the plate"
    (rf"\b(?<!is )(?<!'s )(?<!are )(?:(?:down|over|up|right|back) )?(?:there|here),? "
     rf"(?={_PLACE} (?:the|my|this|that|a|an)\b)", ""),
    # "the purple one of the blocks"
    (r"\bthe ((?!\w+s one\b)\w+) one of (?:the|these|those|my) (?:two |three |four |five )?"
     r"(?!of\b)(\w+s)\b",
     lambda said: f"the {said[1]} {singular(said[2])}"),
    # "give the cup a push to the left"
    (r"\bgive (the|this|that|my) (\w+(?: \w+){0,2}) a (?:little |quick |small |good )?"
     r"(turn|spin|twist|push|shove|nudge|pull)\b", r"\3 \1 \2"),
    # "move the cup so that it is on the plate"
    (rf"\bso (?:that )?it(?:'s| is| stands| sits| lies| ends up| comes to be) ({_PLACE})\b", r"\1"),
    # "the cup wants to be on the plate, so put it there"
    (r"[\s,;.]+(?:(?:so|please|and|then|robot|just)[\s,]+)*(?:you )?(?:put|move|place|set|bring) "
     r"(?:it|them) there[\s.!]*$", ""),
    (r"\bchange the places? of\b", "swap"),
    (r"\bmake (the|this|that|my) ((?:\w+ ){1,3})(?:turn|rotate|spin)\b", r"turn \1 \2"),
    (r"\b(?:the|a|one) pieces? of (fruit)\b", r"the \1"),
    (r"\bpieces of (fruit)\b", r"\1"),
    (r"\bover (on|at|in|by) the\b(?! direction)", r"\1 the"),
    (r"\bover to (?=(?:my|your) side\b)", "to "),
    (r"\bnear of\b", "near"),
    (r"\bin that case\b,?", ""),
    # "put the pen besides the cup"
    (r"(?<=\w)(?<!thing)(?<!all)(?<!ones)(?<!other) besides (?=(?:the|my|that|this|a|an) )",
     " beside "),
    (r"\binchs\b", "inches"),
    # "all non-metal things", "everything non-metallic"
    (r"\b(everything|anything) non[- ]?(\w+)\b", r"\1 that is not \2"),
    (r"\bnon[- ](\w+) (\w+)\b", r"\2 that are not \1"),
    # "the one which is what is the most near to the bowl"
    (r"\b(?:what|that|which) is (?:the )?(?:most near|nearest|closest) (?:to|by)\b", "nearest to"),
    (r"\b(put|place|set|drop)(?: down)? (on|onto|in|into|next to|beside) (?=\w+$)",
     r"\1 it \2 the "),
)  # fmt: skip
_RULES = tuple((re.compile(turn, re.IGNORECASE), plain) for turn, plain in _TURNS)
_NUMBERED = re.compile(r"\b(?:1st|2nd|3rd|4th|5th)\b", re.IGNORECASE)


def put_plainly(text: str) -> str:
    """The sentence with its turns of phrase in plainer words."""
    for turn, plain in _RULES:
        text = turn.sub(plain, text)
    return _NUMBERED.sub(lambda said: _ORDINALS[said.group().lower()], text).strip()

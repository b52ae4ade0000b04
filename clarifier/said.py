"""Other ways of saying the same: turns of phrase put into the plainer words that the rest reads.

Each keeps the things, places and measures of the sentence as they are said; none makes a program.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from clarifier.standing import STANDING
from clarifier.words import singular

_ORDINALS = {"1st": "first", "2nd": "second", "3rd": "third", "4th": "fourth", "5th": "fifth"}
_NTH = r"(first|second|third|fourth|fifth|last|leftmost|rightmost|1st|2nd|3rd|4th|5th)"
_END = r"left|right|front|back"
_NO_COLOR = (r"(?:same|this|that|which|what|other|another|different|its|own|their|matching|equal|"
             r"one)\b")  # fmt: skip
_PLACE = r"(?:on|in|into|onto|at|next to|beside|under|behind|near|left of|right of|to|inside)"
_NO_NOUN = "".join(rf"(?<!\b{word} )" for word in (
    "the", "a", "that", "this", "my", "each", "every", "your", "our"))  # fmt: skip
_COUNTING = re.compile(r"\bcount(?:ing|ed)? (?:\w+ )*$", re.IGNORECASE)
_COUNTED = re.compile(rf"\b{_NTH}(?: \w+)? $", re.IGNORECASE)


def _counted_from(said: re.Match[str]) -> str:
    """ "From the left the second block"; in "the third block from the left, the second block from
    ..." that is said of the one before."""
    before = said.string[: said.start()]
    if _COUNTED.search(before) or _COUNTING.search(before) or said[3].lower() == "of":
        return said.group()
    return f"the {said[2]} {said[3]} from the {said[1]}"


_A_THING = r"(?:the|this|that|my|yon|yer|your) \w+(?: \w+){0,2}?"
_SLIGHT = (r"(?:(?:little|quick|small|good|wee|tiny|gentle|light|slight|hard|firm|sharp|soft|"
           r"bit of an?|friendly|proper|right|nice) )*")  # fmt: skip
_SIDES = {"left": "x-", "right": "x+", "top": "y+", "far": "y+", "back": "y+", "furthest": "y+",
          "farthest": "y+", "upper": "y+", "rear": "y+", "bottom": "y-", "near": "y-",
          "nearest": "y-", "closest": "y-", "close": "y-", "front": "y-",
          "lower": "y-"}  # fmt: skip


def _said_again(said: re.Match[str]) -> str:
    """A side of the table that is said a second time in other words, once."""
    place, again = (
        {_SIDES[word] for word in re.findall(r"\w+", said[part].lower()) if word in _SIDES}
        for part in ("place", "again")
    )
    return f"{said['place']}{said['end']}" if again and again <= place else said.group()


_Plain = str | Callable[[re.Match[str]], str]
_TURNS: tuple[tuple[str, _Plain], ...] = (
    *STANDING,
    # "bowl it over", "throw the can over on its side"
    (rf"{_NO_NOUN}\bbowl (it|them|this|that|these|those|both)\b(?=[^,.;]*? over\b| over\b)",
     r"knock \1"),
    (r"\b(?:throw|toss|chuck|fling) (it|them|[^,.;]*?)(?: over| down)?(?: flat)? on(?:to)? "
     r"(its|their) sides?\b", r"knock \1 over on \2 side"),
    # "no touchin it", "round the outside of the box with ur arm"
    (r"\b(touch|mov|push|hitt|knock|bump|tipp|disturb|dropp|spill|nudg|putt)in'?(?= )", r"\1ing"),
    (r"\bur (?=(?:arm|hand|tool|gripper|finger|claw)\b)", "your "),
    (r"\b(a?round) the (?:outside|edge|rim|perimeter|outline) of (?=(?:the|my|that|this) "
     r"(?!table|desk))", r"\1 "),
    # "no touching the cup, ..."
    (r"\bno ((?:touch|mov|push|hitt|knock|bump|tipp|disturb|dropp|spill|nudg)ing) "
     r"(?=(?:over )?(?:the|my|that|this|any|it|them)\b)", r"without \1 "),
    (r"\b(?:lay|put|rest) (?:a|your) finger(?: (?:for a (?:moment|second)|lightly|gently|"
     r"briefly))* (?:up)?on(?=\b)", "touch"),
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
    (r"\bwithout (?:so much as|even|ever) (?=\w+ing\b)", "without "),
    # "all but the cup into the box"
    (r"\ball (?:but|except(?: for)?|bar|save(?: for)?|apart from|other than) "
     r"(?=(?:the|my|that|this|these|those) )", "everything except "),
    # "the purple one of the blocks"
    (r"\bthe ((?!\w+s one\b)\w+) one of (?:the|these|those|my) (?:two |three |four |five )?"
     r"(?!of\b)(\w+s)\b",
     lambda said: f"the {said[1]} {singular(said[2])}"),
    # "give the can a dunt and knock it over": the second verb says what is to be done
    (rf"\bgi(?:ve|e) ({_A_THING}) an? {_SLIGHT}\w+ (?:and|to) (?:then )?"
     r"(knock|push|shove|tip|topple|slide|move|turn|spin|nudge|pull|tap|lift|roll) it\b", r"\2 \1"),
    (rf"\bgi(?:ve|e) ({_A_THING}) an? {_SLIGHT}\w+ so (?:that )?it (?:falls|topples|tips|goes|"
     r"keels|tumbles)(?: right)? over\b", r"knock \1 over"),
    # "give the cup a push to the left"
    (rf"\bgi(?:ve|e) ({_A_THING}) an? {_SLIGHT}"
     r"(turn|spin|twist|push|shove|nudge|pull)\b", r"\2 \1"),
    # "chuck the rag this side of the can"
    (r"\b(?:on |to |at )?(?:this|the near|the nearer|my) side of (?=(?:the|my|that|this) "
     r"(?!table|desk|worktop|room))", "in front of "),
    (r"\b(?:on |to |at )?the (?:far|farther|further) side of (?=(?:the|my|that|this) "
     r"(?!table|desk|worktop|room))", "behind "),
    (r"\b(?:chuck|toss|lob|sling|bung)(?= (?:(?! (?:at|off|out|across|away|through|from|"
     r"over(?! (?:by|near|next|beside|in|on|behind))|"
     r"under|to|towards?|along|left|right|up|down|back|forwards?)\b)[^,.;])*? (?:in|into|inside|on|"
     r"onto|next to|beside|by|behind|in front of|between|near|to the (?:left|right) of|left of|"
     r"right of)\b)", "put"),
    # "hang on to it until I say otherwise"
    (r"\b(?<!take )(?<!get )(?:hold|hang|keep (?:a )?(?:hold|grip))(?: on)?(?: tight)? "
     r"(?:to|onto|of|on) (?=(?:it|them|that|the|my)\b)", "hold "),
    (r"\b((?:hold|keep|holding|keeping) (?:it|them|that|the \w+(?: \w+)?)(?: (?:there|up|still|"
     r"in the air|up there))*),? (?:until|till|til) (?:i (?:say|tell|ask|need|want|give|"
     r"come|call|am|have)\b[^,.;!?]*|further notice|(?:you(?:'re| are) )?told otherwise)", r"\1"),
    # "the top right corner, so the one furthest from me on the right"
    (r"(?P<place>\b(?:\w+[ -])?\w+ (?:corner|edge|side)(?: of the (?:table|desk))?)(?:,? (?:so|"
     r"that is|that's|i\.e\.|ie|meaning|you know|i mean|in other words|by which i mean|which is|"
     r"uh|um|er|well)"
     r",?)+ (?P<again>(?:the one|the corner|the edge|the side|where)\b[^,.;!?]*?)"
     r"(?P<end>(?:,? (?:thanks|thank you|please|ta|cheers))*[.!]*$)", _said_again),
    # "what I would like is the cup on the plate"
    (r"^(?:so |well |right |ok |now )*what (?:i|we)(?:'d| would| do)? (?:really )?(?:like|want|"
     r"need|love)(?: to have| to see)? is (?=(?:the|my|that|this|all|both|every)\b[^,.;]*? "
     r"(?:on|in|to|at|left|right|behind|in front|next|beside|by|near|between)\b)", "put "),
    # "move the cup so that it is on the plate"
    (rf"\bso (?:that )?it(?:'s| is| stands| sits| lies| ends up| comes to be)(?: right| just|"
     rf" directly|"
     rf" close)? ({_PLACE})\b", r"\1"),
    # "put the cups in the box, all of them"
    (r"(?<=\w), (?:all|each|every one|the lot) of (?:them|those|it)(?=\s*(?:[,.;!]|$))", ""),
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
    # "and what I want you to do is slide it ...", "what I would like is that one of them goes ..."
    (r"(?P<lead>(?:^|[,;.] )(?:and |so |but )?)(?:what )?(?:i|we)(?:'d| would)? "
     r"(?:like|want|need|love)(?: you)?(?: to do)?(?:, [^,]*,)? is (?:that |for you to |"
     r"(?:to )?(?=(?:put|move|push|slide|bring|take|lift|turn|place|set|lay|stack)\b))",
     r"\g<lead>"),
    # "three marbles may go to bed in the bowl", "the others stay awake where they are"
    (rf"\b(go|goes) (?:to (?:bed|sleep|rest)|home|away)(?: now)? "
     rf"(?={_PLACE} (?:the|my|its|their)\b)", r"\1 "),
    (r"\b(stays?) (?:awake|quiet|calm|happily|nicely) (?=where|put\b|there\b)", r"\1 "),
    # "all the blocks but two go down, you pick which two get to stay"
    (r",? (?:and )?(?:you|u|ya) (?:can |may )?(?:pick|choose|decide|select)"
     r"(?: (?:which|what)\b[^.;!?]*)?(?=\s*[.!]*$)", ""),
    # "to the left of the remote, not miles off", "let it tumble to its side"
    (r",? (?:and |but )?not (?:miles|too far|far|a long way|a mile) (?:off|away|apart)"
     r"(?=\W*$)", ""),
    (r"\blet (it|them|(?:the|my|that) [\w' -]{2,30}?) (?:tumble|topple|fall|tip|keel)(?: over)? "
     r"(?:on|onto|to) (its|their) sides?\b", r"knock \1 over on \2 side"),
    # "centre it on the midpoint of the two bearings"
    (r"\b(?:centre|center) (?=(?:the|my|that|this|it)\b[^,.;]*? (?:on|at|in) the "
     r"(?:mid-?point|middle) (?:of|between) )", "put "),
    (r"\b(?:on|at|in|to|onto) the (?:exact |very )?(?:mid-?point|middle point|halfway point) "
     r"(?:of|between) (?=(?:the two|both|these two|those two|the [\w ]+? and the)\b)", "between "),
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

"""Turns of phrase of people who speak English as a second language, and a few of everybody's, put
into the words that the rest reads. Each keeps the things, places and measures as they are said.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from clarifier.arrayed import ARRAYED
from clarifier.corners import corners_named
from clarifier.lexicon import Lexicon, compared
from clarifier.listed_choice import CHOICES
from clarifier.matching import in_matching_groups
from clarifier.ordinals import counted_from_a_side
from clarifier.remainder import without_the_rest
from clarifier.roundabout import told_outright
from clarifier.singled_out import SINGLED_OUT
from clarifier.whither import WHITHER
from clarifier.wishes import ASKED, PARTED, WISHES
from clarifier.words import plural, singular, stems
from scene.kinds import COLORS

_BE = r"(?:is|are|was|were|stands?|lies|lie|sits?|standing|lying|sitting|being)"
_COLOUR = f"(?:{'|'.join(sorted(COLORS))})"
_NO_LEAD = "".join(rf"(?<!\b{word})" for word in (
    "on", "in", "by", "of", "to", "at", "with", "under", "behind", "near", "from", "onto", "into",
    "so", "sure", "see", "know", "beside", "way", "over", "and", "is", "are"))  # fmt: skip
_MANNER = (r"^((?:please |can you |could you )*)(?:move|shift|bring|get) ([^,;.]+?),? (?:by )?"
           r"{}ing it(?= *[.!?]*$)")  # fmt: skip


def _in_the_corners(said: re.Match[str]) -> str:
    return f"{said[1]} four {plural(said[2])} in the four corners"


_OPPOSITE = {
    "left": "to the right of", "right": "to the left of", "behind": "in front of",
    "in front of": "behind",
}  # fmt: skip


def _from_the_other(said: re.Match[str]) -> str:
    """What is said of the thing that stays, said of the one that moves."""
    return f"{said[1]} {_OPPOSITE[(said['side'] or said['way']).lower()]} {said[2]}"


def _one_way(said: re.Match[str]) -> str:
    """ "It might stand nearer to the lamp; do bring it over that way": the way is said before."""
    told = re.search(r"\b(?:closer|nearer|farther|further|towards?|away)\b", said[1], re.IGNORECASE)
    return said[1] if told else said.group()


def _of_them(said: re.Match[str]) -> str:
    """ "Of the two mugs, move the one nearer to me": move the mug nearer to me."""
    one = singular(said["many"].lower())
    which = "" if said["which"].lower() == "one" else f"{said['which']} "
    return f"{said['verb']} the {which}{one}{_MOST.get(said['how'] or '', '')}"


_MOST = {"farther": " farthest", "further": " farthest", "nearer": " nearest", "closer": " closest"}


def _across_both(said: re.Match[str]) -> str:
    return f"{said[1]} across the two {plural(said[2])}"


_TURNS: tuple[tuple[str, str | Callable[[re.Match[str]], str]], ...] = (
    *WISHES,
    *CHOICES,
    *WHITHER,
    *ARRAYED,
    # "everybody into the basket"
    (rf"^(?:everybody|everyone)(?=(?:,?| {_COLOUR}) (?:goes |go |gets |back |off )*"
     r"(?:in|into|inside|on|onto|to|except|but|over|out|next|beside)\b)", "everything"),
    # "every last one of them": not the one that comes last
    (r"\b(every|each) (?:single |very )?last (?=\w)", r"\1 "),
    # "so off it goes to the corner"
    (r"\boff (it|they) (goes?)\b", r"\1 \2"),
    # "of the two mugs, move the one nearer to the plate"
    (r"^(?:out )?of (?:the|those|these|my) (?:two |three |four |\w+ )?(?P<many>\w+s),? "
     r"(?:please )?(?P<verb>put|place|move|push|take|pick up|lift|touch|turn|bring|slide|"
     r"knock over) the (?P<which>one|\w+(?:er|est))(?: one)?(?: (?:that is |that's )?"
     r"(?P<how>farther|further|nearer|closer)(?= (?:from|to)\b))?", _of_them),
    # "three'll do", an answer
    (r"^(?:the |just |only )?(one|two|three|four|five|six|seven|\d+)(?:'ll| will| would|'d) "
     r"(?:do|be enough|be fine|suffice)(?: (?:it|nicely|fine|me))?[\s.!]*$", r"\1"),
    # "put the cube closest to the bowl into it"
    (r"\b((?:closest|nearest|farthest|furthest|next) (?:to|from)) (the \w+) "
     r"((?:in|on)(?:to)?|inside) it(?=\s*[.!]*$)", r"\1 \2 \3 \2"),
    # "..., do bring it over that way", which says again what was said
    (r"^([^;.!]*)[;.!,]\s*(?:so |please |and |then |do |just )*(?:bring|move|shift|slide|put) "
     r"(?:it|them)(?: over| along| on)? (?:that way|in that direction|accordingly|like that)"
     r"[\s.!]*$", _one_way),
    # "group the cubes by colour, red ones well apart from blue ones"
    (r"\b(by colou?r)\s*[,;:] (?:with )?(?:all )?(?:the )?\w+(?: \w+)? "
     r"(?:well |far |kept |clearly )*(?:apart|away|separate|separated) from (?:the )?\w+(?: \w+)?"
     r"(?=\s*[.!]*$)", r"\1"),
    # "the ruler goes over from one cup to the other"
    (r"\b(goes|lies|rests|reaches|spans|stretches|leads|lay|laid|go|lie|reach)(?: over| across)? "
     r"from (?:the )?one (\w+) (?:over |across )?to the other(?: one| \2)?\b", _across_both),
    # "the ball what is near the box", "the cup who stands left", "the pen that it is blue"
    (rf"\b((?:the|a|an|my|this|any) (?:\w+ )?\w+){_NO_LEAD} (?:what|who|(?:that|which|what) "
     rf"(?:it|he|she|they))(?= {_BE}\b)", r"\1 that"),
    (rf"\bthat ({_BE}) (?:at |in |to )?(left|right)(?! of| hand| side| next| by| beside| to|"
     rf" behind)"
     r"(?=\W|$)", r"that \1 on the \2"),
    # "the mug, the red one, goes there"
    (r"\bthe (\w+), the (\w+) one(?=[,.;!]|$| not\b)(?!,? (?:and|the|or)\b)", r"the \2 \1"),
    # "clockwise" and its opposite
    (r"\b(?:in|with|by) (?:the )?(?:sense|direction|way) of (?:the )?(?:clock|clock hands?|"
     r"hands? of "
     r"(?:the|a) clock)\b|\bin (?:the )?clock(?:'s)? (?:direction|sense)\b", "clockwise"),
    (r"\b(?:against|contrary to|opposite to|in the opposite) (?:the )?(?:sense|direction|way) "
     r"(?:of|to) (?:the )?(?:clock|clock hands?|hands? of (?:the|a) clock)\b", "anticlockwise"),
    # "I want the cup where the mug is, and vice versa"
    (r"^(?:.*?\b(?:want|like|need|put|place|move|set) )(the [\w ]+?) (?:to be |to go |to )?where "
     r"(?:(the [\w ]+?) (?:is|are|stands?|lies?|sits?))(?: now)?,? (?:and|or)?,? ?"
     r"(?:vice versa|the other "
     r"way (?:a?round|about)|the reverse)\b", r"swap \1 and \2"),
    # "show me which one's the clip, just point at it"
    (r"^(?:can you |could you |please )*show me which (?:one|thing|of them)?(?:'s|"
     r" is) (the [^,.;]+?)"
     r"[\s,.;:]+(?:and |just |please |by )*(pointing|point|touching|touch)(?: at| to)? it\b",
     r"point at \1"),
    *SINGLED_OUT,
    # "more near to the box", "more far from it"
    (r"\bmore close\b", "closer"), (r"\bmore near\b", "nearer"), (r"\bmore far\b", "farther"),
    # "distribute the rings so that no two of them are close together"
    (r"\b(?:distribute|arrange|place|put|set|space|spread|lay|move|keep) "
     r"((?:the|my|these|those|all|both|them|every)\b[^,.;]*?)(?: out)?,? so (?:that )?"
     r"(?:no two(?: of them| \w+)?|none of them) (?:are|is|stands?|lies?|touch(?:es)?)"
     r"(?: too| very)?(?: close| near| touching)?"
     r"(?: together|(?: to)? (?:each other|one another|another))?"
     r"(?=\s*(?:[.;!?]|$))", r"spread \1 out"),
    # "place the plate so that the apple is to its left"
    (r"\b((?:put|place|set|move|bring|shift) (?:the|my|that|this) [\w ]+?),? so (?:that )?"
     r"((?:the|my|that|this) [\w ]+?) (?:is|are|stands?|lies?|ends up|will be|comes) (?:then )?"
     r"(?:(?:to|on|at) its (?P<side>left|right)(?: side| hand side)?|"
     r"(?P<way>behind|in front of) it)"
     r"(?=\s*[.!?]*$)", _from_the_other),
    # "the cup is too close to the bowl", "... too far from it"
    (r"^((?:the|my|that|this) [\w ]+?) (?:is|are|stands?|lies?|sits?) (?:a bit |way |much |far )?"
     r"too (?:close|near) to ((?:the|my|that|this) [\w ]+?)(?=\s*[.!]*$)", r"move \1 away from \2"),
    (r"^((?:the|my|that|this) [\w ]+?) (?:is|are|stands?|lies?|sits?) (?:a bit |way |much )?"
     r"too far (?:away )?from ((?:the|my|that|this) [\w ]+?)(?=\s*[.!]*$)",
     r"move \1 closer to \2"),
    # "put one candy in every corner"
    (r"\b(put|place|set|lay|stand|leave) (?:one|an?|a single) (\w+) (?:in|at|on|into) "
     r"(?:each|every) (?:one of the (?:four )?corners|corner)\b", _in_the_corners),
    # "chuck the eraser off the table"
    (r"\b(?:chuck|toss|lob|sling|bung)(ing)?\b(?=(?:(?! at )[^,.;])*? (?:off|over) (?:of )?the "
     r"(?:\w+ )?(?:table|desk|edge|side)\b)", r"push\1"),
    # "space the cups out a bit more"
    (r"\bspace ((?:the|my|your|these|those|all|both|them|every)\b[^,.;]*?) out\b",
     r"spread \1 out"),
    # "draw the cup nearer"
    (r"^((?:please |kindly |now |do |can you |could you |would you )*)draw "
     r"(?=(?:the|that|this|my|a) [^,.;]*\b(?:nearer|closer|towards?|back|along|aside|away)\b)",
     r"\1pull "),
    # "move the dish back by 80 mm, sliding it"
    (_MANNER.format("slid"), r"\1slide \2"), (_MANNER.format("push"), r"\1push \2"),
    (_MANNER.format("dragg"), r"\1drag \2"), (_MANNER.format("shov"), r"\1shove \2"),
)  # fmt: skip
_RULES = tuple((re.compile(turn, re.IGNORECASE), plain) for turn, plain in _TURNS)
_HALVES = {"left": "right", "right": "left", "near": "far", "front": "back", "bottom": "top",
           "far": "near", "back": "front", "top": "bottom"}  # fmt: skip
_OUT_OF_HALF = re.compile(
    r"\b(?:clear|remove|move|get|take|sweep|shift) (?P<what>(?:the|my|all|both|those|these|every)\b"
    r"[^,.;:]*?) (?:away )?(?:off|from|out of) (?:the |my )?"
    rf"(?P<half>{'|'.join(_HALVES)}) half(?: of (?:the |my )?(?:table|desk))?(?=\s*(?:[,.;!?]|$))",
    re.IGNORECASE,
)
_CLEARED = re.compile(
    r"\b(?P<verb>clear|clearing|empty|emptying|free|freeing)(?: (?:out|off|up|away))?"
    r"(?: (?:everything|all|it all|all of it) (?:from|off|out of|on|in))? (?:the |my |your )?"
    rf"(?P<half>{'|'.join(_HALVES)})(?:[ -]hand)? (?:half|side)"
    r"(?: of (?:the |my |your )?(?:table|desk|worktop))?"
    r"(?=(?: (?:please|for me|completely|entirely|first|now))?\s*(?:[,.;!?]|$| and\b| then\b))",
    re.IGNORECASE,
)
_WISHED = re.compile(
    r"^(?:(?:please|well|so|now|ok|okay|and|but|on reflection|on second thoughts?)[\s,]+)*"
    r"(?:i|we)(?:'d| would| should)? (?:really |"
    r"very much |"
    r"quite )?(?:like|want|need|love|prefer|wish)(?: to have| to see)? "
    r"(?P<what>(?:the|my|that|this|all|both|those|these) (?:\w+ ){1,4}?)(?:to be |being |to get )?"
    r"(?P<verb>\w+)\b(?P<rest>.*)$",
    re.IGNORECASE,
)
_PARTED = {"put": "put", "set": "set", "laid": "lay", "slid": "slide", "spun": "spin",
           "brought": "bring", "taken": "take", "stuck": "stick", "swept": "sweep",
           "spread": "spread", **PARTED}  # fmt: skip
_WANTED = re.compile(
    r"^(?:(?:(?:once|when|whenever) you(?:'re| are) ready|please|now|robot),? )*"
    r"(?P<what>(?:the|my|that|this|it|any|an?|one of|both|all|each|every)\b[^,.;:]*?) "
    r"(?:wants?|needs?|requires?|could do with) (?P<verb>\w+ing)\b(?P<rest>.*)$",
    re.IGNORECASE,
)
_BIDDEN = re.compile(
    r"^(?:(?:please|now|robot),? )*(?P<what>(?:the|my|that|this|it|any|an?|one of|both|all|each|"
    r"every)\b[^,.;:?]*?) (?:should|must|shall|needs? to|has to|have to|ought to|is to|are to) "
    r"(?:all |now |both |please )?be (?P<verb>\w+)\b(?P<rest>[^?]*)$",
    re.IGNORECASE,
)
_OFF_ITS_PLACE = re.compile(
    r"^((?:please |kindly )*(?:raise|lift)\b.*? \d+(?:[.,]\d+)? ?"
    r"(?:mm|cm|\w+met(?:re|er)s?|inch\w*)) (?:up )?(?:off|from|above|over|clear of) "
    r"(?:its place|its spot|where it (?:is|stands|lies))\b",
    re.IGNORECASE,
)
_GRADED = re.compile(
    r"(?P<lead>\b(?:the|a|is|are|which is|that is) )(?P<how>more|most) (?P<size>big|small|"
    r"tall|short|long|"
    r"wide|narrow|thick|thin|high|low|little|large|fat|slim|tiny|broad)\b",
    re.IGNORECASE,
)
_WISHED_FOR = frozenset({"place", "push", "turn", "topple", "touch", "pick", "arrange"})


def _graded(said: re.Match[str]) -> str:
    """ "The more tall", "the most big": in one word."""
    _, more, most = compared((said["size"].lower(),))
    return f"{said['lead']}{more if said['how'].lower() == 'more' else most}"


def in_plain_turns(text: str, lexicon: Lexicon) -> str:
    """The sentence with its turns of phrase in plainer words."""
    text = _GRADED.sub(_graded, told_outright(text, lexicon))
    text = corners_named(counted_from_a_side(text, lexicon))
    for turn, plain in _RULES:
        text = turn.sub(plain, text)
    text = _OUT_OF_HALF.sub(_over_there, _CLEARED.sub(_moved_over, text))
    text = _colours_listed(text, lexicon)
    return _told(without_the_rest(in_matching_groups(text)), lexicon)


def _colours_listed(text: str, lexicon: Lexicon) -> str:
    """ "From the left: red, orange, green block": the red block, the orange block, ..."""
    colour = "|".join(sorted(lexicon.colors))
    listed = re.compile(
        rf"(?<=: )(?P<first>(?:(?:{colour})(?:, | and | then |, then ))+)(?:and |then )?"
        rf"(?P<last>{colour}) (?P<noun>\w+)(?=\s*[.!]*$)", re.IGNORECASE,
    )  # fmt: skip

    def each(said: re.Match[str]) -> str:
        noun = singular(said["noun"].lower())
        colours = re.findall(rf"\b(?:{colour})\b", f"{said['first']}{said['last']}", re.IGNORECASE)
        return ", ".join(f"the {one} {noun}" for one in colours)

    return listed.sub(each, text)


def _over_there(said: re.Match[str]) -> str:
    """ "Clear the bricks off the left half": to the other half."""
    there = f"the {_HALVES[said['half'].lower()]} half of the table"
    return f"move {said['what'].strip()} to {there}"


def _moved_over(said: re.Match[str]) -> str:
    """ "Clear out the left half of the table": what stands there goes to the other half."""
    verb = "moving" if said["verb"].lower().endswith("ing") else "move"
    half = said["half"].lower()
    here, there = (f"the {side} half of the table" for side in (half, _HALVES[half]))
    return f"{verb} everything in {here} to {there}"


def _told(text: str, lexicon: Lexicon) -> str:
    """ "I should like the globe moved", "the globe wants moving", "the globe should be moved", as
    "move the globe"."""
    said = _WISHED.match(text) or _WANTED.match(text) or _BIDDEN.match(text)
    said = said or ASKED.match(text)
    if said is None:
        return text
    form = said["verb"].lower()
    verb = _PARTED.get(form)
    if verb is None and form.endswith(("ed", "ing")):
        verb = next((one for one in stems(form) if one in lexicon.base_verbs), None)
    if verb is None or lexicon.verb(verb) not in _WISHED_FOR:
        return text
    return _OFF_ITS_PLACE.sub(r"\1", f"{verb} {said['what'].strip()}{said['rest']}")

"""Turns of phrase for what becomes of several things together, put into the words of it that the
translator knows: "huddle the ducks up" (put them together), "fence the sheep in with the blocks"
(surround it), "move them well away from one another" (spread them out), "halfway between the centre
and the right edge" (the middle of the right half). Each keeps the things as they are said.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from clarifier.words import plural, singular
from scene.kinds import COLORS

_Plain = str | Callable[[re.Match[str]], str]
_FIGURE = r"(?:triangle|square|rectangle|circle|ring|diamond|cross|v|l|row|line|column)"
_MADE = rf"(?:make|form|build|create|arrange|lay) (?:a|an|one) {_FIGURE}\b"
_COLOUR = f"(?:{'|'.join(sorted(COLORS))})"
_END = r"(?=\s*(?:[.,;:!?]|$))"
_SEVERAL = (
    r"(?P<what>(?:the|my|all|both|these|those|them|everything|every one of)\b"
    r"(?:(?! (?:to|in|into|on|onto|at|from|with|around|round|out|up|away|apart|together|next|so|"
    r"by|close|closely|tight|tightly|well|far|nice|right|snugly)\b)[^.;:!?])*)"
)
_ONE = r"(?P<one>(?:the|my|that|this) (?:(?!(?:with|by|using|from|on|in)\b)[\w-]+ ?){1,4}?)"
_TIGHT = r"(?:(?:all|up|close|closely|tight|tightly|right|real|really|nice and close|in|snugly) )*"
_CLOSE = r"(?:(?:close|closely|tight|tightly|snugly|nice and close|right) )+"
_CROWD = r"(?:huddle|cluster|bunch|clump|crowd|herd|flock)"
_HEM = r"(?:fence|box|hem|pen|wall|ring|hedge|block|shut|close)"
_SIDES = (
    r"(?:from|on|at|along) (?:all|every|each|the)(?: of (?:its|the))?(?: four| three| its)? sides?"
)
_WHOLE = r"(?: of the (?:table|desk|board))?"
_CENTRE = rf"(?:the )?(?:very |exact )?(?:cent(?:re|er)|middle){_WHOLE}"
_SIDE = r"(?P<side>left|right|far|near|back|front|top|bottom)(?:[- ]hand)?"
_EDGE = rf"(?:the |my )?{_SIDE} (?:edge|side|border|rim)(?: middle)?{_WHOLE}"
_CORNER = (
    r"(?:the )?(?P<corner>(?:far|near|back|front|top|bottom|upper|lower)[- ](?:left|right))"
    rf"(?:[- ]hand)? corner{_WHOLE}"
)
_HALFWAY = r"(?:(?:to|at|on|in) )?(?:(?:a point|the point|the spot) )?(?:half[- ]?way|mid[- ]?way)"


def _all_around(said: re.Match[str]) -> str:
    """ "A ring of candles round the cake": the candles around the cake."""
    what = said["what"].strip()
    told = re.match(r"(?:the|my|all|those|these|both)\b", what, re.IGNORECASE)
    return f"put {what if told else f'the {what}'} around {said['one'].strip()}"


def _unlike(said: re.Match[str]) -> str:
    """ "The lids on the pots, but the colours mustn't match": on pots of a different colour."""
    where = said["where"].lower()
    return f"put the {said['a']} {where} {said['b']} of a different colour"


def _one_unlike(said: re.Match[str]) -> str:
    """ "The red lid on the pot of the other colour": on the pot that is not red."""
    several = re.search(r"\b(?:each|every|all)\b", said.string[: said.start("b")], re.IGNORECASE)
    if several:
        return said.group()
    return f"{said['a']}{said['mid']} {said['det']} {said['b']} that is not {said['hue']}"


def _per_each(said: re.Match[str]) -> str:
    """ "One cube per saucer but never on that of its own colour"."""
    where = said["where"] or ""
    return f"put each {said['a']} on a {said['b']} of a different colour{where}"


def _at_both_ends(said: re.Match[str]) -> str:
    """ "A stone at each end of my edge": one in each of its corners."""
    edge = said["edge"].lower() or "near"
    corners = [f"one {said['n']} in the {edge} {side} corner" for side in ("left", "right")]
    return f"put {' and '.join(corners)}"


def _told_first(said: re.Match[str]) -> str:
    """What is to be done, "the one" being one of those that were spoken of."""
    one = f"the {singular(said['n'].lower())}"
    return re.sub(
        r"\bthe one\b|\b(?:it|that one)\b", one, said["rest"], count=1, flags=re.IGNORECASE
    )


_LISTED = re.compile(r"\s*(?:,\s*and |,| and )\s*(?:the )?", re.IGNORECASE)


def _respectively(said: re.Match[str]) -> str:
    """ "The coin and the ring go into the red and the green box respectively"."""
    ones, others = (
        [
            item.strip()
            for item in _LISTED.split(re.sub(r"^the ", "", said[part].strip(), flags=re.I))
        ]
        for part in ("ones", "others")
    )
    noun = singular(others[-1].split()[-1])
    if len(ones) != len(others) or len(ones) < 2:
        return said.group()
    others = [other if singular(other.split()[-1]) == noun else f"{other} {noun}"
              for other in others]  # fmt: skip
    others[-1] = " ".join((*others[-1].split()[:-1], noun))
    where = said["where"]
    each = [f"the {one} {where} the {other}" for one, other in zip(ones, others, strict=True)]
    return f"put {', '.join(each[:-1])} and {each[-1]}"


_ABOUT_IT = re.compile(
    rf"^(?:the )?(?P<hue>{_COLOUR})(?: ones?| \w+)??(?: goes| stands| is)? (?:(?:to|on|at) its "
    r"(?P<its>left|right)(?: side)?|(?:(?:to|on|at) the )?(?P<of>left|right) of it|"
    r"(?P<way>behind|in front of) it)$",
    re.IGNORECASE,
)


def _listed_about(said: re.Match[str]) -> str:
    """ "Discs round the bowl: red to its left, blue behind it": the red disc to the left of the
    bowl, the blue disc behind the bowl."""
    items = [_ABOUT_IT.match(item.strip()) for item in re.split(r",| and ", said["list"])]
    told = [item for item in items if item is not None]
    if len(told) < len(items):
        return said.group()
    noun, mark = singular(said["many"].lower()), said["mark"]
    sides = [item["its"] or item["of"] for item in told]
    ways = [f"to the {side} of" if side else item["way"]
            for side, item in zip(sides, told, strict=True)]  # fmt: skip
    listed = zip((item["hue"] for item in told), ways, strict=True)
    return "put " + ", ".join(f"the {hue} {noun} {way} {mark}" for hue, way in listed)


ARRAYED: tuple[tuple[str, _Plain], ...] = (
    # second languages: "at left hand of the plate"
    (r"\b(?:at|on|to) (?:the )?(left|right) hand of\b", r"to the \1 of"),
    # "cups to saucers, but mixed: white cup on blue saucer, blue cup on white saucer"
    (
        r"^(?![^:]*\b(?:all|each|every|both|two|three|four|not|never)\b)(?:[\w']+,? ){0,3}?"
        r"(?P<a>\w+)s\b(?:,? [\w']+){1,4}? (?P<b>\w+)s\b(?:,? [\w']+){0,3}: "
        r"(?=(?:the )?\w+ (?P=a) [^:,;]*\b(?P=b)\b[^:;]*(?:,| and) (?:the )?\w+ (?P=a) )",
        "",
    ),
    # "discs round the bowl: red to its left, blue to its right"
    (
        r"^(?:put |place |set )?(?:the |my )?(?P<many>\w+s) (?:a?round|about|by) (?P<mark>(?:the|"
        r"my|that) (?:\w+ )?\w+)\s*[:;–-]\s*(?P<list>[^.;:!?]*\bits?\b[^.;:!?]*?)(?=[.!]*$)",
        _listed_about,
    ),
    # "reds left of the box blues right of it": a list without a joint
    (
        rf"(?<!,)(?<!\band)(?<!\bthe)(?<!\ball)(?<!\bor) (?={_COLOUR}s"
        r" (?:left|right|on|in|into|onto|at|to|behind|next|go)\b)",
        ", ",
    ),
    # "push the mugs together", "bring them close together", "huddle them up"
    (
        rf"\b(?:(?:{_CROWD}|push|move|slide|shove|pull|squeeze|press) {_SEVERAL} {_TIGHT}|"
        rf"(?:bring|get|draw) {_SEVERAL.replace('what', 'these')} {_CLOSE})"
        r"together\b(?! with\b)(?=\s*(?:[.,;:!?]|$)| (?:in|at|near|by|again|please)\b)",
        lambda said: f"put {said['what'] or said['these']} together",
    ),
    (
        rf"\b{_CROWD} {_SEVERAL}(?: up)?(?: close| tightly)?(?=\s*(?:[.!?]|$)| (?:in|at|near)\b)",
        r"put \g<what> together",
    ),
    (
        r" in (?:a|one) (?:tight |close |little |small |neat )?(?:bunch|cluster|huddle|clump)"
        r"(?= (?:to|in|at|on|behind|next|left|right|near|by)\b)",
        "",
    ),
    # "cluster the mugs around the tray"
    (
        rf"\b(?:{_CROWD}|gather|group|assemble|arrange) {_SEVERAL}(?: up| close| closely| all)* "
        r"(?:all )?(?:a?round|about) (?=(?:the|my|that) )",
        r"put \g<what> around ",
    ),
    # "fence the sheep in with the blocks", "box in the die from all four sides using the others"
    (
        rf"\b{_HEM} (?:{_ONE} in|in (?P<it>(?:the|my|that) (?:[\w-]+ ?){{1,3}}?))(?: {_SIDES})?"
        r"(?: completely| all round)?,? (?:with|by|using) (?P<what>(?:the|all|my|those|these|"
        r"both)\b"
        rf"[^,.;:]*?)(?:,? one (?:on|at|to) (?:each|every) side|,? {_SIDES})?{_END}",
        lambda said: f"surround {(said['one'] or said['it']).strip()} with {said['what']}",
    ),
    (
        rf"\b(surround|enclose|encircle) {_ONE} (?:completely|{_SIDES}|fully|entirely) (with|by) ",
        r"\1 \2 \3 ",
    ),
    # "the blocks on all four sides of the lamp"
    (
        rf"\b(?:put|place|set|stand|arrange|position|lay) {_SEVERAL} (?:on|at|along|to|round) "
        rf"(?:all|every)"
        r"(?: (?:the|its))?(?: four)? sides? of ",
        r"put \g<what> around ",
    ),
    # "a ring of candles round the cake"
    (
        r"(?:^|\b(?:make|form|build|lay|set|create|put|want|like|have)(?: out)? )(?:an? |one "
        r")(?:\w+ )?"
        r"(?:ring|circle|wreath|fence|wall) (?:of|out of|from|with) (?P<what>[\w ]+?) (?:all "
        r")?(?:a?round|"
        r"about) (?P<one>(?:the|my|that) (?:(?!middle|cent)\w+ ?){1,3}?)(?=\s*(?:[.,;!]|$))",
        _all_around,
    ),
    # "move them well away from one another", "separate the blocks"
    (
        rf"\b(?:move|push|pull|put|place|set|keep|take|get|slide|separate|part) {_SEVERAL}"
        r" (?:(?:well|right|far) )*(?:(?:away|apart)(?: from)?|from) (?:each other|one another)"
        rf"(?: again| please)*{_END}",
        r"spread \g<what> out",
    ),
    (
        r"^(?P<lead>(?:please |now |kindly |can you |could you )*)separate (?P<what>(?:the|all|"
        r"my|these|"
        r"those)(?: of the)? (?:(?!from\b)\w+ ){0,3}?\w+s)(?: please)?(?=\s*[.!?]*$)",
        r"\g<lead>spread \g<what> out",
    ),
    (
        rf"\b(?:put|place|set|move|push|stand|spread|arrange) {_SEVERAL}(?: out)? as far apart as "
        r"(?:possible|you can|it gets|they (?:can|will) go)",
        r"spread \g<what> out",
    ),
    (
        r"^(?P<what>(?:the|all|my) [\w ]+?s) (?:should|must|shall|ought to) (?:be|stand|lie|go|"
        r"sit) as far "
        r"apart as (?:possible|you can|they can)",
        r"spread \g<what> out",
    ),
    # "halfway between the centre and the right edge"
    (
        rf"{_HALFWAY} (?:between|from) (?:{_CENTRE} (?:and|to|towards) {_EDGE})",
        r"in the middle of the \g<side> half of the table",
    ),
    (
        rf"{_HALFWAY} (?:between|from) (?:{_EDGE} (?:and|to|towards) {_CENTRE})",
        r"in the middle of the \g<side> half of the table",
    ),
    (
        rf"{_HALFWAY} (?:between|from) (?:{_CENTRE} (?:and|to|towards) {_CORNER})",
        r"in the middle of the \g<corner> quarter of the table",
    ),
    (
        rf"{_HALFWAY} (?:between|from) (?:{_CORNER} (?:and|to|towards) {_CENTRE})",
        r"in the middle of the \g<corner> quarter of the table",
    ),
    # "a stone at each end of the near edge"
    (
        r"\b(?:put )?(?:one|an?|a single) (?P<n>\w+) (?:at|on|in|to) (?:each|either|both|every) "
        r"ends? of "
        r"(?:the |my )?(?P<edge>(?:near|far|front|back)(?:er)?(?= (?:edge|side)\b)|(?<=my "
        r")(?=edge\b|side\b)) "
        r"?(?:edge|side)(?: of (?:the|my) table)?",
        _at_both_ends,
    ),
    # "one of the vases is near the edge. Bring the one ...": what is told first is only told
    (
        r"^one of (?:the|my|these) (?P<n>\w+s) (?:is|stands|sits|lies|looks)\b(?! to\b| "
        r"going\b)[^.;:!]*[.;!]\s+"
        r"(?P<rest>\w.*)$",
        _told_first,
    ),
    # "sort these into two groups: bolts here, nuts there"; "into two groups, one left, one right"
    (
        r"^(?:please )?(?:sort|divide|split|part|separate|put) (?:these|them|those|everything|it "
        r"all|all of "
        r"(?:these|them)|the \w+)(?: up| out)? into (?:two|three|four) (?:\w+ )?(?:groups|piles|"
        r"heaps|"
        r"lots|sets)\s*[:;–-]+\s*",
        "put ",
    ),
    (
        r"\b(?:divide|split|part|separate) (?P<what>(?:the|my|these|those) (?:\w+ )?\w+s)(?: "
        r"up)? into two "
        r"(?:equal |even )?(?:groups|lots|halves|sets|bunches|parts),? (?:with )?one (?:half "
        r")?(?:of them )?"
        r"(?P<to>(?:to|on|in|at|by|next) [^,.;]*?),? (?:and )?(?:one|the other)(?: one| half)? "
        rf"(?P<away>(?:to|on|in|at|by|next) [^,.;]*?){_END}",
        r"put half of \g<what> \g<to> and the other half \g<away>",
    ),
    # "divide walnuts equally between the white saucer and the green saucer"
    (
        r"\b(?:divide|split|share|distribute|deal)(?: out| up)? (?:the |all the |my "
        r")?(?P<what>(?:\w+ ){0,2}?\w+s)"
        r"(?: out| up)?(?: equal(?:ly)?| even(?:ly)?| fairly)? (?:between|among|over|across) "
        r"(?:the )?(?P<one>"
        r"(?!two\b|three\b|both\b)\w+(?: \w+)?) and (?:the )?(?P<other>\w+(?: \w+)?)"
        r"(?: equal(?:ly)?| even(?:ly)?| fairly)?(?=\s*(?:[.,;!]|$))",
        r"share the \g<what> between the \g<one> and the \g<other>",
    ),
    # "a tealight into each corner"
    (
        r"^(?:one|an?|a single) (?P<n>\w+) (?:in|into|at|on|to|for) (?:each|every) (?:one of the "
        r"(?:four )?"
        r"corners|corner)\b",
        lambda said: f"put four {plural(said['n'])} in the four corners",
    ),
    # colours that are to match, or not to
    (
        r"\b(?P<each>(?:each|every) \w+ )(?P<where>in|on|into|onto|next to|beside) the (?P<b>\w+) "
        r"(?:(?:that|which) (?:matches|fits)|matching|fitting) (?:its|the|their)(?: own)? "
        r"colou?r\b",
        r"put \g<each>\g<where> the \g<b> of the same colour",
    ),
    (
        r"^(?:(?:could|can|would) you )?(?:please )?(?:put |place |set )?(?:one|an?|each|every) "
        r"(?P<a>\w+) (?:per|(?:on|onto|in|into|for|to) (?:each|every)(?: one)?(?: of the)?|on a|on "
        r"one) (?P<b>\w+?)s?(?P<where> (?:at|on) the (?:left|right|top|bottom|front|back))?,? "
        r"(?:but |and |just |only )*(?:never|not|no \w+)(?: an? \w+| any \w+)? "
        r"(?:on|in) (?:the|a|an?y?) "
        r"(?:\w+ )?(?:of|with|in) (?:its|the)(?: very)? (?:own|same) colou?r",
        _per_each,
    ),
    (
        r"^(?:put |place |set )?(?:the |all the )?(?P<a>\w+s) (?P<where>onto|on|into|in|next to|"
        r"beside) (?:the "
        r")?(?P<b>\w+s),? (?:but|and|so that|where|only)? ?(?:the |their )?colou?rs "
        r"(?:must(?:n't| not)|should"
        r"(?:n't| not)|do(?:n't| not)|may not|can't|can not|cannot|are not to|shall not|never) "
        r"(?:match|be the "
        r"same|agree|go together)",
        _unlike,
    ),
    (
        rf"\b(?P<a>(?:the|a|my) (?P<hue>{_COLOUR}) \w+)(?P<mid>[^,.;:]*?) (?P<det>the|a|any|one) "
        rf"(?P<b>\w+) "
        r"(?:of|with|in|that has) (?:the other|another|a different) colou?r\b",
        _one_unlike,
    ),
    # "... go into the red, the green and the yellow box respectively"
    (
        r"^(?:put |place |set )?(?P<ones>(?:the )?[\w ]+(?:, (?:the )?[\w ]+)*,? and (?:the "
        r")?[\w ]+?) "
        r"(?:(?:go|goes|belong|come|should go|must go) )?(?P<where>on top of|onto|on|into|in|"
        r"next to|beside|"
        r"behind|in front of|left of|right of) (?P<others>(?:the )?\w+(?: \w+)?(?:, (?:the "
        r")?\w+(?: \w+)?)*,? and "
        r"(?:the )?\w+(?: \w+)?)(?: in that order)?,? respectively",
        _respectively,
    ),
    # "make a triangle out of three blocks and place it in the corner", "... using three blocks"
    (
        rf"\b(?P<make>{_MADE}[^,.;]*?),? and (?:then )?(?:put|place|set|move|have|position) "
        r"(?:it|this|that) (?=(?:in|at|on|to|into|near)\b)",
        r"\g<make> ",
    ),
    (rf"\b(?P<make>{_MADE}[^,.;]*?) using ", r"\g<make> with "),
    (
        rf"\b(?:use|take) (?P<what>(?:\w+ ){{1,4}}?\w+) (?:to|and) (?P<make>{_MADE}[^,.;]*?)"
        r"(?= and\b|[,.;]|$)",
        r"\g<make> with \g<what>",
    ),
)  # fmt: skip

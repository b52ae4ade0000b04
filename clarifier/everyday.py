"""How people say things on an ordinary day, put into the plainer words that the rest reads: asides
about what is wanted, wishes told as facts, a form made "with" things, and slips that spell another
word. Each keeps the things, places and measures as they are said.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from clarifier.words import singular

_END = r"(?=\s*(?:[,.;:!?)]|$))"
_A_THING = (r"(?P<what>(?:the|my|this|that|these|those|both|all(?: the)?|each|every|his|her|our|"
            r"your)"
            r"(?: (?!(?:be|to|is|are|must|could|would|should|and "
            r"then)\b)[\w'-]+){1,6}?)")  # fmt: skip
_PLACED = (r"(?=(?:in|on|at|onto|into|to|by|next to|beside|behind|under|between|near|left|right|"
           r"over|inside|up against)\b)")  # fmt: skip
_STANDS = r"(?:live|go|stand|sit|be|lie|park|stay|rest|move|end up|come)"
_DEED = (r"(?P<verb>put|place|set|move|push|take|pick up|lift|touch|tap|turn|bring|slide|knock "
         r"over|"
         r"drop|shift|stand|lay|pop|stick|shove|grab|hold up|tip over)")  # fmt: skip
_SO = r"[,.;:!]+ (?:(?:so|and|then|please|do|just|could you|can you|would you|now)[, ]+)*"
_SOMEBODY = (r"(?:my|our|his|her|the|some|that) (?:grand\w+|son|daughter|husband|wife|mother|"
             r"father|"
             r"mum|mom|dad|boss|friend|sister|brother|neighbou?r|colleague|kids?|children|nephew|"
             r"niece|"
             r"aunt|uncle|flatmate|roommate|cleaner|nurse|boy|girl|patient|student|teacher|partner|"
             r"cousin)|somebody|someone|i|he|she|they|we")  # fmt: skip
_Plain = str | Callable[[re.Match[str]], str]


def _singled_out(said: re.Match[str]) -> str:
    """ "Of all those pots it is the shortest one that is in my way, so put it ...": put the
    shortest pot ..."""
    which, noun = said["which"], singular(said["noun"]) if said["noun"] else ""
    closer = re.match(r"(?:the )?one (?=\w)", which, re.IGNORECASE)
    if closer is not None:
        name = f"the {noun or 'one'} {which[closer.end() :]}"
    else:
        bare = re.sub(r" one$", "", which)
        name = f"{bare} {noun}" if noun and not bare.lower().endswith(f" {noun.lower()}") else which
    return f"{said['verb']} {name}"


def _told_before(said: re.Match[str]) -> str:
    """ "My grandson leaves his cup in the middle, so take it and ...": take the cup and ..."""
    return f"{said['verb']} the {said['noun']}"


_TURNS: tuple[tuple[str, _Plain], ...] = (
    # slips that spell another word: "taller then the box", "twice as far form the saucer"
    (r"\b(\w+er|more \w+|less \w+)(?<!\bover)(?<!\bafter)(?<!\bother)(?<!\bcorner)(?<!\bunder)"
     r"(?<!\bhowever)(?<!\bnever)(?<!\beither)(?<!\btogether)(?<!\bcounter)(?<!\bpaper)"
     r"(?<!\bcontainer)(?<!\bwater) then (?=(?:the|my|that|this|a|an|it|all|any|"
     r"\d)\b)", r"\1 than "),
    (r"\b(far|away|off|out|apart|cm|mm|inch|inches|left|right|up|order|different|farther|further)"
     r" form (?=(?:the|my|me|it|left|right|that|this|here|there|each|them)\b)", r"\1 from "),
    (r"(^|[,.;!] ?|\b(?:please|then|and|to|you|now) )putt (?=(?:the|my|a|it|them|that|this|both|"
     r"all)\b)", r"\1put "),
    # "if something is lying on the book", "if it's the red mug that is nearest", "leave all be"
    (r"\b(if|unless|whether|when) (something|anything|nothing)(?: else)?(?: is|'s| lies| stands| "
     r"sits)"
     r"(?: (?:already|lying|standing|sitting|still|left))* (?=(?:on|in|inside|under|behind|next to|"
     r"beside|near|left of|right of|between|in front of)\b)", r"\1 there is \2 "),
    (r"\bif it(?:'s| is) ((?:the|my|that) [^,.;]+?) (?:that|which|who) (is|isn't|stands|lies)\b",
     r"if \1 \2"),
    (r"((?:^|\W)if\b.*(?:\bthen|\botherwise|\belse|\bif not|,),?(?: please| just| simply)?) "
     r"(?:leave "
     r"(?:everything|things|it all|the lot|all of it|all)(?: (?:just|exactly))*(?: be| alone| "
     r"there| "
     r"(?:as|where|how) (?:it is|they are|it stands|they stand|it was|they were))|think nothing "
     r"of it|"
     rf"(?:don't|do not) bother|forget (?:about )?it|never mind(?: it)?){_END}", r"\1 do nothing"),
    (r"^(if (?P<x>(?:the|my|that|this) [^,.;]+?) (?:isn't|is not|are not|aren't)(?: already| yet)? "
     r"(?P<p>(?:on|in|at|next to|beside|behind|in front of|left of|right of|between|near|under) "
     r"[^,.;]+?)),? (?:then |please )*(?P<v>put|move|bring|place|set|push) (?:it|them) there"
     rf"(?: please)?{_END}", r"\g<v> \g<x> \g<p> unless it is already there"),
    (r"\bgive (it|them|him|her|the \w+(?: \w+)?) (?:a|an|one)(?: (?:single|light|gentle|little|"
     r"quick|"
     r"small|soft|tiny|short|friendly|careful))* (tap|touch|poke|pat)(?= |$|\W)", r"\2 \1"),
    # "..., which I believe it is, ...", "..., I don't know why, ..."
    (r",? which (?:(?:i|we) (?:think|believe|suppose|guess|reckon|hope|bet|expect|fear|know|rather "
     r"think|am sure|(?:could|can)(?:n't| not| hardly)?)|with |i'm |i am |may |might |it "
     r")[^,.;!?]*,"
     r" ?", " , "),
    (r",? (?:\()?and i (?:rather |quite |do )?(?:think|believe|suppose|guess|hope|bet) (?:it|they|"
     r"that|he|she) (?:is|are|does|do)\)?,", ","),
    (rf"[,;] (?:i (?:don't|do not) know why|don't ask(?: me)?(?: why)?|god knows why|no idea why|"
     rf"who knows why|for some reason){_END}", ""),
    # "..., where nobody is going to elbow it", "..., the blue one being my sister's"
    (rf",? where (?:nobody|no one|no-one|nothing|people|everybody|everyone|somebody|someone|"
     rf"it|they|i|we|he|she)(?: (?:is|are|'s|will|can|could|would|won't|can't|cannot))+"
     rf"(?: not| never)?(?: going to| likely to| able to)? (?:elbow|bump|knock|hit|kick|trip|reach|"
     rf"get|see|find|break|sit|step|spill|be safe|be out|always)\b[^,.;!?]*{_END}", ""),
    (rf", the [\w ]{{1,20}}? (?:one|ones) (?:being|is|are) (?:mine|yours|hers|his|(?:my|our|her|"
     rf"his|"
     rf"the) \w+'s?|for later|broken|dirty|spoken for|taken|a spare){_END}", ""),
    # "with the notebook staying just where it is", "letting the mug stand"
    (rf",? (?:and )?with {_A_THING} (?:staying|remaining|being left|left|kept)(?: right| just| "
     rf"exactly)?"
     rf"(?: put| still| in place| alone| there| where (?:it is|they are|it was|they were|"
     rf"it's))+{_END}",
     r", without moving \g<what>"),
    (rf"(?:^|,|;| and)(?: and)? (?:let|leave) {_A_THING} stand(?: there| where (?:it is|they are))?"
     rf"{_END}", r", without moving \g<what>"),
    # "what would really help is if the phone could live in the far corner"
    (rf"^(?P<lead>.*?[\s,.;]|)(?:and )?(?:what(?:'d| would) (?:really |most |be )*(?:help|be "
     rf"(?:good|"
     rf"great|nice|lovely)|make me happy|please me)(?: me)?(?: most)? is (?:if|for|that)|"
     rf"(?:all|what) (?:it|this|i|we) (?:really )?needs? is (?:for|that)|(?:all|what) (?:i|we) "
     rf"(?:want|ask|wish) (?:for )?is (?:for|that)) {_A_THING} (?:(?:could|can|would|should|to|"
     rf"might) )*"
     rf"(?:{_STANDS}|be (?:put|placed|set|laid|dropped|moved|stood)) {_PLACED}",
     lambda said: f"put {said['what']} "),
    # "of all those pots it is the shortest one that keeps getting in my way, so do put it ..."
    (rf"^(?:out )?(?:of (?:all )?(?:those|these|the|my) (?P<noun>[\w ]+?)(?: here| there)?,? "
     rf")?(?:it is|"
     rf"it's|it was) (?P<which>the one(?: [\w-]+){{1,5}}?|the (?:[\w-]+ )?\w+est(?: one| \w+)?|the "
     rf"\w+ one) (?:that|who|which) [^,.;:!?]+(?:,[^,.;:!?]+)*?{_SO}{_DEED} (?:it|that one|this "
     rf"one|"
     rf"that|him|her)\b", _singled_out),
    # "my grandson always leaves his cup in the middle of everything, so please take it ..."
    (rf"^(?:well |so |now )?(?:{_SOMEBODY})(?: always| often| keeps?| never| just| still| has| "
     rf"have| had|"
     rf" once| usually)* \w+ (?:his|her|their|my|the|that|this|our|its) "
     rf"(?P<noun>(?!\w+s\b)\w+(?: (?!in|on|at|by|"
     rf"right|here|there|over|to|all|out|up|lying|standing|near|just|again|every|so|and|with)\w+)?)"
     rf"(?: (?:in|on|at|by|right|here|there|over|all|out|lying|standing|near|just|again|every)\b"
     rf"[^,.;:!?]*)?{_SO}(?<=so |se |ou |ow |nd |st |do ){_DEED} it\b", _told_before),
    # "the jar behind the spoon, the squat one", "you see the jar? that is the one I'd like in ..."
    (r"\b(the|my|that|this) (\w+)(,? (?:just |right |directly |over )?(?:behind|next to|beside|"
     r"near|by|"
     r"left of|right of|in front of|to the (?:left|right) of|on the (?:left|right) of) (?:the|"
     r"my) \w+), "
     r"the (\w+) one(?=[,.;!?]|$| not\b)", r"\1 \4 \2\3"),
    (r"^(?:do |can )?(?:you|u) see (?P<what>(?:the|that|my|this) [^.;!?]+?)\s*[?.!]+ (?:well,? "
     r")?(?:that is|"
     rf"that's|it's|it is) the one (?:(?:that )?(?:i'd like|i want|i would like|i need|i'd love)"
     rf"(?: to have| to see| you to put)?|(?:that |which )?(?:goes|should go|belongs)) {_PLACED}",
     r"put \g<what> "),
    # "behind the book with a gap of 3 cm", "left of the cup, 3 cm apart"
    (r"\b(?P<where>behind|in front of|to the (?:left|right) of|left of|right of) (?P<mark>(?:the|"
     r"my|that|"
     r"this) \w+(?: (?!with|at|and|leaving)\w+)?),? (?:and )?(?:(?:with|leaving|at) (?:a |an "
     r")?(?:gap|"
     r"distance|space|clearance|spacing) of (?P<of>[\w.,]+ ?(?:mm|cm|millimet\w+|centimet\w+|"
     r"inch\w*))"
     r"|(?:with |leaving )?(?:a )?(?P<far>[\w.,]+ ?(?:mm|cm|millimet\w+|centimet\w+|inch\w*)) "
     r"(?:apart|gap|"
     r"away|space|clearance))(?: between(?: them| the two)?)?(?=\s*(?:[,.;!]|$))",
     lambda said: f"{said['of'] or said['far']} {said['where']} {said['mark']}"),
    # "I don't want the cup on the table, push it off"
    (rf"^i (?:don't|do not) (?:want|need) (?P<what>(?:the|my|this|that) [^,.;]+?) (?:on|in|at|"
     rf"near|next "
     rf"to|here|there|lying|standing|over|so close)\b[^,.;]*{_SO}{_DEED} "
     rf"it\b", r"\g<verb> \g<what>"),
    # "make the two cars park next to each other"
    (rf"\b(?:make|let|have|get) (?P<what>(?:the|my|this|that|these|those|both)(?: "
     rf"[\w'-]+){{1,4}}?) "
     rf"(?:to )?(?:park|stand|sit|lie|live|rest) {_PLACED}", r"put \g<what> "),
    # "make one line with the corks", "the same distance from one to other"
    (r"\b(?:make|form|build|do|create|lay) (?:a|an|one)(?P<how>(?: (?:nice|neat|straight|tidy|long|"
     r"single|vertical|horizontal|perfect|proper|little))*) (?P<form>line|row|column)(?P<up>(?: "
     r"going)?"
     r" (?:up and down|across|from left to right|from front to back))? (?:with|from|out of|using) "
     r"(?P<what>(?:the|my|these|those|all|both)\b(?:,? and(?= [\w'-]+ [\w'-]+s\b)|"
     r"(?:,(?= [\w'-]+,? and\b))? (?!with\b|from\b|so\b|and\b|in\b|at\b)[\w'-]+){1,6})",
     r"put \g<what> in one\g<how> \g<form>\g<up>"),
    (r"\b(?:(?:with|at|in|keep|keeping|have|having) )?(?:the |an? )?(?:same|equal|identical) "
     r"(?:distances?|gaps?|spaces?|spacing|room) (?:(?:from|between) (?:one|each(?: one)?)"
     r" (?:to|and|from) (?:the )?(?:other|next|another)(?: one)?|between (?:each(?: one| of them)?|"
     r"every one|all(?: of them)?))(?=\W|$)", "with equal gaps between them"),
    # "every piece of fruit"
    (r"\b(every|each|any|all|all the) (?:single )?(?:pieces?|bits?|items?) of (?=(?:the )?"
     r"(?:fruit|cutlery|stationery|clothing|crockery|silverware|veg|jewell?ery)\b)",
     lambda said: f"{'any' if said[1].lower() == 'any' else 'all'} the "),
    # "nowhere near the box"
    (r",? (?:and|but)(?: (?:definitely|absolutely|certainly|please|preferably))? (?:nowhere|not "
     r"anywhere|not at all) (?:near|close to|next to|by) (?=(?:the|my|that|this|any)\b)",
     ", not next to "),
    # "no contact with any of the parts"
    (r"\b(?:no|zero) contact with (?:any |the |any of the |other )*(?:parts|objects|things|items|"
     r"anything|everything|them)\b", "without touching anything"),
    # "put in it two bears, any two. Just two, mind"
    (rf"(\b(?:two|three|four|five|six)\b[^.;!?]*?), any (?:two|three|four|five|six)(?: of them)?"
     rf"(?: you (?:like|want|please)| will do| of your choice)?{_END}", r"\1"),
    (r"(\b(?P<many>two|three|four|five|six)\b[^;!?]*?)[,.;:!]+ (?:just|only|exactly|and only|"
     r"that's) "
     r"(?:the )?(?P=many)(?: of them)?(?:,? (?:mind|please|thanks|ok|not more|no more))*(?=\W*$)",
     r"\1"),
)  # fmt: skip
_RULES = tuple((re.compile(turn, re.IGNORECASE), plain) for turn, plain in _TURNS)


def in_everyday_words(text: str) -> str:
    """The sentence with what people say on an ordinary day in plainer words."""
    for turn, plain in _RULES:
        text = turn.sub(plain, text)
    return re.sub(r"\s+,", ",", text).strip()

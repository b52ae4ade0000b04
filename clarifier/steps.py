"""One thing after another: "once you put A on B, lift C", "first touch A, after that B, then C",
"A goes in the middle, then B on A and then C on top".

The steps are said in their order, each with its verb and with what it leads to, joined by "then".
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from agent.messages import Focus
from clarifier.ask import labels
from clarifier.frame import frame
from clarifier.lexicon import Lexicon
from clarifier.mentions import link
from clarifier.words import stems
from scene.types import Scene

_ENDS = frozenset({",", ".", ";", "!", "and", "then"})
_PAST = {"laid": "lay", "slid": "slide", "spun": "spin", "brought": "bring", "taken": "take",
         "took": "take", "stuck": "stick", "swept": "sweep", "stood": "stand", "held": "hold",
         "given": "give", "gave": "give", "got": "get", "gotten": "get", "gone": "go",
         "lain": "lay", "shoven": "shove", "drawn": "draw", "hung": "hang"}  # fmt: skip
_DEEDS = frozenset({"place", "push", "turn", "pick", "touch", "topple", "arrange", "trace"})
_YOU = r"you(?:'ve|ve| have|'re| are)?(?: (?:done|finished|through|ready))?(?: with)? "
_DONE_FIRST = re.compile(
    rf"^(?:(?:once|after|when|as soon as|by the time) {_YOU}|having )(?P<verb>\w+) "
    r"(?P<what>[^,;.?!]+?)(?:, | (?=(?:can|could|would|will) (?:you|u) )| then )"
    r"(?:(?:please|then|you|now|just|next|also|(?:can|could|would|will) (?:you|u)) )*"
    r"(?P<next>\w+ .*)$",
    re.IGNORECASE,
)
_DONE_BEFORE = re.compile(
    rf"^(?P<next>[^,;.?!]+),? (?:(?:but|and) )?(?:only |just )?"
    rf"(?:(?:once|after|as soon as) {_YOU}|having )(?P<verb>\w+) (?P<what>[^,;.?!]+)"
    r"(?P<end>[.!]*)$",
    re.IGNORECASE,
)
_POINTS = re.compile(r"\b(?:it|them|they|that|there|this|one|ones|other|others)\b", re.IGNORECASE)
_NEXT = (
    r"(?:after(?:wards?)? (?:that|this)(?! \w+ (?:is|has)\b)|afterwards?|thereafter|next|secondly|"
    r"thirdly|fourthly|lastly|last of all|finally|at the end|in the end|to finish(?: off)?|"
    r"(?:when|once|after|as soon as) (?:that's|that is|this is|it's|@\d+ is|you're|you are) "
    r"(?:all )?(?:done|finished|ready|sorted)(?: (?:with )?(?:that|this|@\d+))?|"
    r"last but not least|(?:second|third|last|next)(?: thing| step)?(?: :)?|subsequently|"
    r"after(?= [a-z]+ [#@]| #\d+(?: [,;.!]|$)))"
)
_YOU_THEN = re.compile(r"\b((?:and )?then )you (?=(?:please |just )?(?P<verb>\w+) )", re.IGNORECASE)
_YOU_FIRST = re.compile(r"^you (?=(?:first |please |just )*(?P<verb>\w+) )", re.IGNORECASE)
_THEN = re.compile(
    rf"(?:^|(?: [,;.!]| and| then| but)+) {_NEXT}(?: ,)? (?:of all )?(?=#|@|(?P<verb>[a-z]+)\b)"
)
_OPENING = re.compile(
    r"^(?:(?:so|ok|okay|right|well|please|now) )*(?:first(?:ly)?(?: of all| thing| step)?|"
    r"(?:to|let's) (?:begin|start)(?: with| off)?|for a start|start (?:off )?(?:with|by)|"
    r"begin (?:with|by)|step one|step 1)(?: [,:])? (?=#|@|(?P<verb>[a-z]+)\b)"
)
_STACKED = re.compile(
    r"(?P<below>#\d+) (?:(?:goes|go|is|stands|should|be|to|straight|right|directly) )*"
    r"on(?:to| top of)? [#@]\d+(?: [,;.])?(?: (?:and|then|put|place|set|finally|the|,))* $"
)
_TOP = re.compile(r"^(?P<thing>.+?) (?:(?:goes|go|is|stands) )?on (?:the )?top$", re.IGNORECASE)
_BARE = re.compile(
    r"(?P<joint>(?:^| )(?:[,;.] )?(?:and )?then )(?P<named>[#@]\d+)"
    r"(?= (?:[,;.!]|and|then)(?: |$)|$)"
)
_TOUCHES = re.compile(r"^(?:please |just |now )*(?P<verb>touch|tap|poke|pat|press|visit) [#@]\d+")


def in_steps(text: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> str:
    """The sentence with its steps in their order; as it was where it has none."""
    turned = _turned_round(text, lexicon)
    whole = _joined_by_then(turned, scene, focus, lexicon)
    for told in (_YOU_THEN, _YOU_FIRST):
        whole = told.sub(lambda said: _untold(said, lexicon), whole)
    whole = _on_what(whole, scene, focus, lexicon)
    return _with_verbs(whole, scene, focus, lexicon)


def _turned_round(text: str, lexicon: Lexicon) -> str:
    """ "Once you've put A on B, lift C" as "put A on B, then lift C"."""
    said = _DONE_FIRST.match(text.strip())
    if said is not None:
        verb, follows = _deed(said["verb"], lexicon), said["next"].split(" ", 1)[0].lower()
        if verb and lexicon.verb(follows) in _DEEDS:
            return f"{verb} {said['what']}, then {said['next']}"
    said = _DONE_BEFORE.match(text.strip())
    if said is not None and not _POINTS.search(said["what"]):
        verb = _deed(said["verb"], lexicon)
        if verb and not re.search(r"\b(?:then|first)\b", text):
            return f"{verb} {said['what']}, then {said['next']}{said['end']}"
    return text


def _deed(form: str, lexicon: Lexicon) -> str:
    """The base form of a verb of the past, or of doing; "" for what is none."""
    form = form.lower()
    known = (stem for stem in reversed(stems(form)) if stem in lexicon.base_verbs)
    base = _PAST.get(form) or next(known, "")
    return base if base and lexicon.verb(base) in _DEEDS else ""


def _untold(said: re.Match[str], lexicon: Lexicon) -> str:
    """Whom it is said to left out: "then you touch the lamp"."""
    return (said[1] if said.re.groups > 1 else "") if _deed(said["verb"], lexicon) else said[0]


def _joined_by_then(text: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> str:
    """ "First ..., after that ..., and lastly ..." with "then" between the steps."""
    linked = link(text, scene, focus, lexicon)
    shape = frame(linked)
    opening = _OPENING.match(shape.text)
    steps = [said for said in _THEN.finditer(shape.text) if _begins(said, lexicon)]
    if not steps and " then " not in shape.text:
        return text
    pieces, at = list[str](), 0
    if opening is not None and _begins(opening, lexicon):
        begins = linked.tokens[shape.token(opening.end())]
        at = begins.start
        verb = _deed(opening["verb"] or "", lexicon)
        if verb and verb != begins.text:  # "begin by placing"
            pieces, at = [verb], begins.end
    for said in steps:
        first = linked.tokens[shape.token(said.start())].start
        pieces.append(linked.text[at:first].rstrip(" ,;.") + ", then ")
        at = linked.tokens[shape.token(said.end())].start
    return "".join(pieces) + linked.text[at:]


def _begins(said: re.Match[str], lexicon: Lexicon) -> bool:
    """Whether a thing or a deed follows, so that it is a step."""
    verb = said["verb"]
    return verb is None or verb == "you" or bool(_deed(verb, lexicon))


def _on_what(text: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> str:
    """ "B goes on A, then C on top": on top of B."""
    linked = link(text, scene, focus, lexicon)
    shape = frame(linked)
    for number, one in enumerate(shape.named):
        behind = next((t.start for t in linked.tokens[one.last :] if t.text in _ENDS), len(text))
        said = _TOP.match(linked.text[one.mention.start : behind].strip(" .!"))
        stacked = _STACKED.search(shape.text.partition(f"#{number}")[0])
        if said is None or stacked is None:
            continue
        (below,) = shape.among(stacked["below"])
        if len(below.mention.objects) != 1 or below.mention.objects == one.mention.objects:
            return text
        name = labels(below.mention.objects, scene, lexicon)[below.mention.objects[0]]
        bare = one.opened == 0 or linked.tokens[one.opened - 1].text in _ENDS
        start = linked.tokens[one.opened].start
        ahead = f"{linked.text[:start]}{'put ' if bare else ''}"
        ahead += f"{linked.text[start : one.mention.start]}{said['thing']} on top of {name}"
        return ahead + linked.text[one.mention.start + len(said[0]) :]
    return text


def _with_verbs(text: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> str:
    """ "Touch A, then B and then C" with the verb said of each."""
    linked = link(text, scene, focus, lexicon)
    shape = frame(linked)
    touches = _TOUCHES.match(shape.text)
    if touches is None:
        return text
    verb, whole = touches["verb"], text
    for said in reversed(list(_BARE.finditer(shape.text))):
        start = linked.tokens[shape.token(said.start("named"))].start
        whole = f"{whole[:start]}{verb} {whole[start:]}"
    return whole

"""What goes on from the last command without saying all of it: "the pear in there as well",
"push it another 5". The result is a whole sentence again.
"""

from __future__ import annotations

import re

from agent.messages import Dialog
from clarifier.lexicon import Lexicon
from clarifier.mentions import link
from clarifier.pieces import Chunk
from clarifier.spoken import Linked, settles
from scene.types import Scene

_IN_THERE = re.compile(
    r"\b(?:(?P<lead>in|into|on|onto|inside|on top|over|up) )?there(?P<tail>(?:[\s,]+(?:as well|"
    r"too|also|"
    r"please|now|then|with it|and then\b.*|again))*\W*)$",
    re.IGNORECASE,
)
_ANOTHER = re.compile(
    r"\b(?P<more>another|a further|a|further)? ?(?P<number>a (?:little )?bit|a little|slightly|"
    r"\d+(?:\.\d+)?|half an?|two|three|four|"
    r"five|six|"
    r"seven|eight|nine|ten|fifteen|twenty)(?P<unit> ?(?:mm|cm|m|inch(?:es)?|centimet\w+|"
    r"millimet\w+))?"
    r"(?P<behind> more| further| again)?(?P<tail>(?:[\s,]+(?:please|then|too|now))*\W*)$",
    re.IGNORECASE,
)


_VAGUE = frozenset({"a bit", "a little bit", "a little", "slightly"})
_NUMBER = re.compile(
    r"^[\W\d]*(?:\b(?:one|two|three|four|five|six|seven|eight|nine|ten|fifteen|twenty|half|a|"
    r"an)\b)?"
)


def with_place(text: str, dialog: Dialog, scene: Scene, lexicon: Lexicon) -> str | None:
    """ "put the pear in there as well": where the last command put something; else None."""
    said = _IN_THERE.search(text)
    if said is None or dialog.last_text is None:
        return None
    past = link(dialog.last_text, scene, (), lexicon)
    goals = [one for one in past.spoken if one.relation and settles(one.mention)]
    own = link(text[: said.start()], scene, dialog.focus, lexicon)
    if not goals or any(one.relation for one in own.spoken) or not own.spoken:
        return None
    goal = goals[-1]
    if goal.mention.objects[0] in {o for one in own.spoken for o in one.mention.objects}:
        return None
    before = next((c for c in past.chunks if c.kind == "relation" and c.last == goal.opened), None)
    if before is None or (said["lead"] and goal.relation not in ("in", "on")):
        return None
    led = dialog.last_text[past.tokens[before.first].start : goal.mention.start]
    tail = "" if "then" not in said["tail"] else said["tail"]
    return f"{text[: said.start()]}{led}{goal.mention.text}{tail}"


def with_measure(text: str, dialog: Dialog, scene: Scene, lexicon: Lexicon) -> str | None:
    """ "push it another 5": as far again the same way, in the unit said before; else None."""
    said = _ANOTHER.search(text)
    if said is None or dialog.last_text is None or not (said["more"] or said["behind"]):
        return None
    past = link(dialog.last_text, scene, (), lexicon)
    own = link(text[: said.start()], scene, dialog.focus, lexicon)
    aims = any(c.kind in ("relation", "place") for c in own.chunks)
    aims = aims or any(t.text in lexicon.words("directions") for t in own.tokens)
    verbs = {chunk.value for chunk in own.chunks if chunk.kind == "verb"}
    pushes = [c for c in past.chunks if c.kind == "verb" and c.value == "push"]
    if aims or len(pushes) != 1 or not verbs <= {"push", "place"}:
        return None
    vague = said["number"].lower() in _VAGUE
    far = said["number"] if vague else _in_unit(said, past)
    way, told = way_of(past, lexicon), text[: said.start()].strip(" ,")
    if not verbs:
        told = f"{_said(pushes[0], past)} it"
    return f"{told} {far} {way}" if far and way else None


def _in_unit(said: re.Match[str], past: Linked) -> str:
    """The number with its unit, or with that of the one measure said before; "" for neither."""
    measures = [c for c in past.chunks if c.kind == "measure" and c.value == "d"]
    if len(measures) != 1:
        return ""
    unit = said["unit"] or _NUMBER.sub("", _said(measures[0], past))
    return f"{said['number']} {unit.strip()}" if unit.strip() else ""


def _said(chunk: Chunk, linked: Linked) -> str:
    return linked.text[linked.tokens[chunk.first].start : _end(chunk, linked)]


def _end(chunk: Chunk, linked: Linked) -> int:
    return linked.tokens[chunk.last - 1].end


def way_of(past: Linked, lexicon: Lexicon) -> str:
    """The direction of a command: "to the left", "away from me"; "" where it is not just one."""
    free = [c for c in past.chunks if not any(s.opened <= c.first < s.last for s in past.spoken)]
    to_me = re.search(r"\b(?:towards?|away from) me\b", past.text, re.IGNORECASE)
    if to_me is not None:
        return to_me[0]
    ways = [
        _said(c, past)
        for c in free
        if c.kind == "place" or past.tokens[c.first].text in lexicon.words("directions")
    ]
    if len(ways) != 1:
        return ""
    return f"to {ways[0]}" if ways[0].lower().startswith("the ") else ways[0]

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
    r"\b(?P<more>another|a further|a|further)? ?(?P<number>\d+(?:\.\d+)?|half an?|two|three|four|"
    r"five|six|"
    r"seven|eight|nine|ten|fifteen|twenty)(?P<unit> ?(?:mm|cm|m|inch(?:es)?|centimet\w+|"
    r"millimet\w+))?"
    r"(?P<behind> more| further| again)?(?P<tail>(?:[\s,]+(?:please|then|too|now))*\W*)$",
    re.IGNORECASE,
)


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
    measures = [c for c in past.chunks if c.kind == "measure" and c.value == "d"]
    own = link(text[: said.start()], scene, dialog.focus, lexicon)
    aims = any(c.kind in ("relation", "place") for c in own.chunks)
    aims = aims or any(t.text in lexicon.words("directions") for t in own.tokens)
    pushed = "push" in {one.verb for one in (*own.spoken, *past.spoken)}
    if len(measures) != 1 or aims or not pushed:
        return None
    length = dialog.last_text[past.tokens[measures[0].first].start : _end(measures[0], past)]
    unit = said["unit"] or _NUMBER.sub("", length)
    way = _way(past, lexicon)
    if not unit.strip() or not way:
        return None
    return f"{text[: said.start()].rstrip()} {said['number']} {unit.strip()} {way}"


def _end(chunk: Chunk, linked: Linked) -> int:
    return linked.tokens[chunk.last - 1].end


def _way(past: Linked, lexicon: Lexicon) -> str:
    """The direction of a command: "to the left", "away from me"; "" where it is not just one."""
    free = [c for c in past.chunks if not any(s.opened <= c.first < s.last for s in past.spoken)]
    ways = [
        past.text[past.tokens[c.first].start : _end(c, past)]
        for c in free
        if c.kind == "place" or past.tokens[c.first].text in lexicon.words("directions")
    ]
    if len(ways) != 1:
        return ""
    return f"to {ways[0]}" if ways[0].lower().startswith("the ") else ways[0]

"""What a program does that its sentence does not ask for, however sure the translator is.

Vetoes only: a direction that is dropped ("up and to the left"), a thing that falls off the table
where nobody spoke of an edge, one that topples unasked, a thing that is moved although it was to
be spared.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence, Set
from types import MappingProxyType

from agent.messages import Command, Problem
from clarifier.if_words import depends_on_more
from clarifier.spoken import Linked, Spoken
from scene.relations import moved, off_table
from scene.types import Scene

STILL = 0.02
"""Less than this along an axis is no motion along it (table units)."""

_SIDE = r"(?:left|right|leftwards?|rightwards?)"
_DEPTH = (
    r"(?:up|upwards?|down|downwards?|forwards?|back|backwards?|away(?: from me)?"
    r"|(?:towards?|closer to|nearer to) me|nearer|closer|farther|further)"
)
_JOINT = r"(?: a bit| a little| some)?,? and (?:then )?(?:also )?"
_LEAD = r"(?:(?:slightly|just|a bit|a little) )?(?:(?:to|towards) (?:the|my|your) )?"
_SLANT = (
    r"diagonal(?:ly)?|(?:up|down)(?:wards?)?[ -](?:left|right)(?:wards?)?"
    r"(?! (?:corner|edge|side|half|of\b))"
)
_BOTH = re.compile(
    rf"\b(?:{_SIDE}{_JOINT}{_LEAD}{_DEPTH}|{_DEPTH}{_JOINT}{_LEAD}{_SIDE}|{_SLANT})\b", re.I
)

_OVER = re.compile(
    r"\b(?:off|over(?! (?:to|towards?|here|there|by|a bit|a little)\b)|edge|border|floor|ground"
    r"|falls?|drops?|overboard)\b",
    re.I,
)
"""Words for an edge or a fall; "over to the right" is none of them."""
_EDGE = re.compile(
    r"\b(?:off|over (?:an?|the|its|my|your|any|either|that|this) (?:\w+ )?(?:side|rim|brink|end)"
    r"|edge|border|floor|ground|falls?(?! over)|drops?|overboard)\b",
    re.I,
)
"""Words for a fall off the table; what is knocked over need not leave it."""


_TOPPLING = re.compile(
    r"\b(?:knock|toppl|tip|upset|overturn|flip|flick|fall|fell|over|down|roll|side|lie|lying|lay|"
    r"flat"
    r"|horizontal|timber|capsiz|keel|upend|tumbl|upright|stand)\w*",
    re.I,
)


def says_topple(text: str) -> bool:
    """Whether a sentence may speak of something that falls over."""
    return _TOPPLING.search(text) is not None


def unasked_topple(text: str, before: Scene, after: Scene) -> Problem | None:
    """The first thing that a program topples although the sentence speaks of no such thing."""
    if _TOPPLING.search(text) or _OVER.search(text):
        return None
    stood = {item.id for item in before if item.upright}
    lying = next((item for item in after if item.id in stood and not item.upright), None)
    if lying is None:
        return None
    return Problem("unsafe", f"the {lying.name} would topple, and nobody asked for that",
                   object=lying.id)  # fmt: skip


def unasked_fall(text: str, before: Scene, after: Scene) -> Problem | None:
    """The first thing that a program sends off the table although the sentence names no edge."""
    if _EDGE.search(text):
        return None
    stood = {item.id for item in before if not off_table(item)}
    fallen = next((item for item in after if item.id in stood and off_table(item)), None)
    if fallen is None:
        return None
    text = f"the {fallen.name} would go off the table. Say how far, or where it is to end"
    return Problem("unsafe", text, object=fallen.id)


_LEADING = frozenset({"move", "bring", "guide", "run", "take", "lead", "steer", "drive", "swing"})
_TOOLS = frozenset({"tool", "arm", "gripper", "hand", "finger", "claw", "tip", "suction"})
_OVER_TO = re.compile(
    r"\b(?:topple|tip|knock|tumble|overturn|upend|fall)s?\b[^,.;]*?\b"
    r"(?:(?:over )?(?:to|towards?|on) (?:the |my |your |its )?(?P<side>left|right)"
    r"|(?P<near>towards? me|forwards?)|(?P<far>away from me|backwards?))\b",
    re.I,
)


def falls_elsewhere(text: str, before: Scene, after: Scene) -> Problem | None:
    """The first thing that a program knocks over to another side than the one said, as a skill
    does where there is no room to that side."""
    said = _OVER_TO.search(text)
    if said is None:
        return None
    way = {"left": (-1, 0), "right": (1, 0)}.get((said["side"] or "").lower())
    dx, dy = way or ((0, -1) if said["near"] else (0, 1))
    ends = {item.id: item for item in after}
    for item in before:
        end = ends.get(item.id)
        if end is None or not item.upright or end.upright or item.x is None or end.x is None:
            continue
        (x, y), (now_x, now_y) = item.position, end.position
        if (now_x - x) * dx + (now_y - y) * dy < max(abs(now_x - x), abs(now_y - y)) / 2:
            text = f"the {item.name} has no room to fall to that side"
            return Problem("unsafe", text, object=item.id)
    return None


_LEADS_TO = frozenset({"on", "in", "left", "right", "above", "below", "beside", "between"})


def disturbed(spared: Sequence[str], before: Scene, after: Scene) -> Problem | None:
    """The first thing that a program moves although the sentence says that it is to stay."""
    ends = {item.id: item for item in after}
    for item in before:
        end = ends.get(item.id)
        if item.id not in spared:
            continue
        if end is None or moved(item, end) > 0 or (end.on, end.held) != (item.on, item.held):
            text = f"the {item.name} would be moved, and you said that it is to stay as it is"
            return Problem("unsafe", text, object=item.id)
    return None


_TOOL_VERBS = frozenset({"touch", "tap", "pat", "poke", "boop", "point", "hover", "visit", "trace"}
                        | {"outline", "draw", "circle", "encircle", "orbit"})  # fmt: skip
_MADE_OF = frozenset({"with", "of", "from", "using", "out", "to", "in", "into"})
"""Behind these comes what a drawn shape is made of, or where a thing is brought."""


def only_the_tool(linked: Linked) -> bool:
    """Whether a sentence tells the tool where to go and nothing else: "tap the cup", "draw a square
    through the pins", "move the tool around the cup"."""
    inside = {i for one in linked.spoken for i in range(one.opened, one.last)}
    verbs = [chunk for chunk in linked.chunks if chunk.kind == "verb" and chunk.first not in inside]
    if len(verbs) == 1 and _leads_tool(verbs[0].first, linked) and verbs[0].first + 2 not in inside:
        return True
    said = {linked.tokens[chunk.first].text for chunk in verbs}
    free = {token.text for i, token in enumerate(linked.tokens) if i not in inside}
    begins = bool(verbs) and all(verbs[0].first < one.opened for one in linked.spoken)
    return begins and said <= _TOOL_VERBS and not free & _MADE_OF


def _leads_tool(at: int, linked: Linked) -> bool:
    """Whether the tool is what a verb at a token leads somewhere."""
    said = [token.text for token in linked.tokens[at : at + 3]]
    verb, determiner, tool = (*said, "", "", "")[:3]
    return verb in _LEADING and determiner in ("the", "your") and tool in _TOOLS


def moved_by_the_tool(linked: Linked, before: Scene, after: Scene) -> Problem | None:
    """The first thing that a program moves although only the tool is to go somewhere."""
    if not only_the_tool(linked):
        return None
    problem = disturbed([item.id for item in before], before, after)
    if problem is None or problem.object is None:
        return None
    name = before.get(problem.object).name
    text = f"the {name} would be moved, and nobody asked for that"
    return Problem("unsafe", text, object=problem.object)


def moves_the_landmark(
    linked: Linked, binding: Mapping[str, tuple[str, ...]], shifted: Set[str]
) -> bool:
    """Whether a program brings what leads to a place ("next to the box") and leaves what is to go
    there where it is: the two were taken for one another; or moves what another thing is to go away
    from."""
    themes = {o for one in linked.spoken if one.theme and not one.relation
              for o in binding.get(one.mention.slot, ())}  # fmt: skip
    shunned = {o for one in linked.spoken if _is_shunned(one, linked)
               for o in binding.get(one.mention.slot, ())} - themes  # fmt: skip
    if shunned & shifted:
        return True
    marks = {o for one in linked.spoken if one.relation in _LEADS_TO
             for o in binding.get(one.mention.slot, ())} - themes  # fmt: skip
    return bool(themes) and bool(shifted) and shifted <= marks


def _is_shunned(one: Spoken, linked: Linked) -> bool:
    """Whether something else is to go away from a thing, which by that stays."""
    return [token.text for token in linked.tokens[: one.opened]][-2:] == ["away", "from"]


def does_nothing(program: str, before: Scene, after: Scene, commands: Sequence[Command]) -> bool:
    """Whether a program is one step done no time at all: "zero contact" taken for how often."""
    return not commands and before == after and "range(0)" in program


def still_stands(
    body: str, binding: Mapping[str, tuple[str, ...]], before: Scene, after: Scene
) -> Problem | None:
    """The first thing that a program is to knock over and that would stay upright."""
    ends = {item.id: item for item in after}
    for slot in re.findall(r"\btopple\((m\d+),", body):
        for one in binding.get(slot, ()):
            if before.get(one).upright and one in ends and ends[one].upright:
                name = before.get(one).name
                text = f"the {name} would not fall over: it is too squat, or has no room to fall"
                return Problem("impossible", text, object=one)
    return None


def names_two_axes(text: str) -> bool:
    """Whether a sentence joins a direction to the side with one away from or towards the person,
    or speaks of a diagonal."""
    return _BOTH.search(" ".join(text.split())) is not None


def keeps_to_one_axis(before: Scene, after: Scene) -> bool:
    """Whether what moves on the table moves along one of its axes only. What waits in the tray has
    no place to come from and does not count."""
    ends = {item.id: item.position for item in after if item.x is not None}
    shifts = [
        (abs(ends[item.id][0] - item.position[0]), abs(ends[item.id][1] - item.position[1]))
        for item in before
        if item.x is not None and item.id in ends
    ]
    far = [shift for shift in shifts if max(shift) >= STILL]
    return bool(far) and all(min(shift) < STILL for shift in far)


CONTACT = 0.03
"""A tool that comes nearer to the top of a thing than this touches it (table units)."""


def touched(spared: Sequence[str], scene: Scene, commands: Sequence[Command]) -> Problem | None:
    """The first thing to be left alone that the tool comes down on."""
    for object_id in spared:
        item = scene.get(object_id)
        if item.x is None:
            continue
        (x, y), top = item.position, item.z + item.tall + CONTACT
        if any(abs(c.x - x) < item.width / 2 and abs(c.y - y) < item.height / 2 and c.z < top
               for c in commands):  # fmt: skip
            return Problem("unsafe", f"the {item.name} is not to be touched", object=object_id)
    return None


def drops_condition(text: str, body: str) -> bool:
    """Whether a program does in any case what the sentence makes depend on something."""
    return depends_on_more(text) and not re.search(r"\bif\b", body)


_CORNERS: Mapping[str, range] = MappingProxyType(
    {"triangle": range(3, 4), "square": range(4, 5), "rectangle": range(4, 5),
     "circle": range(8, 1000)}
)  # fmt: skip
"""Of how many points a figure is drawn."""


_UNTOUCHED = re.compile(r"\b(?:nothing|nobody|no \w+) (?:\w+ ){0,2}touch", re.IGNORECASE)


def touches_untold(text: str, program: str) -> bool:
    """Whether a program touches what nothing is to touch."""
    return "touch(" in program and _UNTOUCHED.search(text) is not None


def draws_another(linked: Linked, program: str, commands: Sequence[Command]) -> bool:
    """Whether a program draws another figure than the one that the sentence names."""
    named = {i for one in linked.spoken for i in range(one.first, one.last)}
    words = {token.text for i, token in enumerate(linked.tokens) if i not in named}
    said = words & _CORNERS.keys()
    if len(said) != 1 or "trace(" not in program:
        return False
    points = {(round(one.x, 2), round(one.y, 2)) for one in commands if one.op == "move"}
    return len(points) not in _CORNERS[said.pop()]

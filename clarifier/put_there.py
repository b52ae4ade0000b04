"""A program's word for a part of the table made the one that its sentence says: where a group, a
row or a figure goes. The program stays the translator's; one word of it is another.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from functools import partial

from clarifier.formed import Formed
from clarifier.placed import Placed

_ALONG = re.compile(r'\balong_edge\((?P<things>\w+(?:\(m\d+\))?), "\w+"\)')
_SLOT = re.compile(r"\bm\d+\b")
_Word = Callable[[re.Match[str], Placed, str], str]
"""What stands for a call, given where its things are to go, and the form they are to have or ""."""


def put_there(body: str, goals: Sequence[object]) -> str:
    """The program with the parts of the table, and forms there, that the sentence says."""
    parts = {goal.slot: goal for goal in goals if isinstance(goal, Placed)}
    forms = {goal.things: goal.form for goal in goals if isinstance(goal, Formed)}

    def meant(word: _Word, call: re.Match[str]) -> str:
        slots = set(_SLOT.findall(call["things"]))
        goal = parts.get(min(slots)) if len(slots) == 1 else None
        if goal is None or goal.at == "towards":
            return call.group()
        return word(call, goal, forms.get(goal.things, ""))

    if len(parts) == 1:
        (goal,) = parts.values()
        if form := forms.get(goal.things, ""):
            body = _ALONG.sub(lambda call: _line_at(call["things"], goal, form), body)
    for pattern, word in _WORDS:
        body = pattern.sub(partial(meant, word), body)
    return body


def _together(call: re.Match[str], goal: Placed, form: str) -> str:
    things = call["things"]
    if form:
        return _in_form(things, goal, form)
    if goal.close and goal.at in ("half", "mid_edge"):
        return f'put_each({things}, figure({things}, "block", "{goal.part}", 0))'
    if goal.at == "mid_edge" or (goal.close and goal.at in ("edge", "side")):
        return f'put_each({things}, along_edge({things}, "{goal.part}"))'
    return f'put_all({things}, "{goal.part}")'


def _row(call: re.Match[str], goal: Placed, form: str) -> str:
    return _in_form(call["things"], goal, form or call["form"])


def _in_form(things: str, goal: Placed, form: str) -> str:
    return f"put_each({things}, {_line_at(things, goal, form)})"


def _line_at(things: str, goal: Placed, form: str) -> str:
    """A row's middles are level, along an edge the rims are."""
    if form == "line":
        form = "column" if _side(goal) in ("left", "right") else "row"
    return f'line_at({things}, "{form}", "{_side(goal)}")'


def _spread(call: re.Match[str], goal: Placed, form: str) -> str:
    if goal.at != "edge":
        return call.group()
    return f'put_each({call["things"]}, spread_along({call["things"]}, "{goal.part}"))'


def _alone(call: re.Match[str], goal: Placed, form: str) -> str:
    middle = goal.at == "mid_edge" and goal.part == call["part"]
    return f"mid_{call.group()}" if middle else call.group()


def _figure(call: re.Match[str], goal: Placed, form: str) -> str:
    return f'figure({call["things"]}, {call["corners"]}, "{goal.part}", 0)'


def _side(goal: Placed) -> str:
    return goal.part.removesuffix(" half")


_WORDS: tuple[tuple[re.Pattern[str], _Word], ...] = (
    (re.compile(r'\bput_all\((?P<things>m\d+), "(?P<part>[a-z ]+)"\)'), _together),
    (re.compile(r"\b(?P<form>row|column)\((?P<things>(?:[^()\n]|\([^()\n]*\))*)\)"), _row),
    (re.compile(r"\bput_in_line\(from_\w+\((?P<things>m\d+)\)[^\n]*\)"), _spread),
    (re.compile(r'(?<!_)\bedge\((?P<things>m\d+), "(?P<part>\w+)"\)'), _alone),
    (re.compile(r"\bin_shape\((?P<things>m\d+), (?P<corners>\d+)\)"), _figure),
)

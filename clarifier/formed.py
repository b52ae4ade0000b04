"""The form in which a sentence says that things are to stand: row, column, line; how far apart.

A candidate that sets things side by side where a column was said, or closes up where gaps of 3 cm
were, is dropped (`stated`); those that make the form with the same things speak for one another.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise
from typing import Literal, NamedTuple

from agent.messages import Quantity
from clarifier.lexicon import Lexicon
from clarifier.measures import quantities
from clarifier.pieces import Chunk
from clarifier.spoken import Linked
from scene.relations import extents, in_column, in_row, moved
from scene.types import Scene, SceneObject

Form = Literal["row", "column", "line"]
OFF = 0.05
"""What stands no farther off a line is on it (table units)."""
UNEVEN = 0.04
"""Gaps that differ by less are equal, and equal to one that is said (table units)."""

_LIKE = r"(?:\w+ly |\w+ed |nice |neat |straight |tidy |single |proper |long |short |little |even )*"
_FORM = re.compile(
    rf"\b(?:(?:a|an|one|single|the same) {_LIKE}|(?:in|into) {_LIKE})"
    r"(?P<upright>vertical |horizontal )?(?P<form>row|column|line)\b(?! of (?:the |my )?table)"
)
_FORMS: Mapping[str, Form] = {
    "row": "row", "column": "column", "line": "line", "horizontal": "row", "vertical": "column",
}  # fmt: skip
_BEHIND = re.compile(r"\bone (?:right |directly )?behind (?:the other|another|the next)\b")
_NO_LONGER = re.compile(
    r"\b(?:instead of|rather than|out of|no longer|not)(?: in| as)? (?:a|an|one|that|this|the|"
    r"their) "
    r"(?:\w+ )?(?:row|column|line)\b"
)
"""A form that things are not to keep."""
_ABREAST = re.compile(r"\bside by side\b")
_DEEP = re.compile(r"\b(?:front to (?:the )?back|back to (?:the )?front|near to far|far to near)\b")
_LINED = re.compile(
    r"\b(?:lin(?:e|ed|ing)(?: (?:them|it|all|(?:the |my )?\w+(?: \w+)?))? up|align\w*)\b"
)
_ALL = re.compile(r"\b(?:gaps?|apart|between|spac(?:e|es|ed|ing)|distances?)\b")
_EVEN = re.compile(
    r"\b(?:equal|even|same|identical|regular)(?:ly)?\b[^.;]*\b(?:gaps?|apart|spac\w+|distances?)\b|"
    r"\b(?:gaps?|spac\w+|distances?)\b[^.;]*\b(?:equal|even|same|identical|regular)(?:ly)?\b"
)
_SPACED = re.compile(
    r"(?<!no )(?<!without )(?<!any )\b(?:gaps?|spaces?|room|spaced)\b", re.IGNORECASE
)
OPEN = 0.05
"""The least gap that is one (table units)."""
_SET = frozenset({"arrange", "place", "pick", ""})
"""Classes of verbs by which a form is made; "push it in a straight line" makes none."""
_SEVERAL = re.compile(r"\b(?:rows|columns|lines|another|not|without|grid|circle|square)\b|n't\b")


_ORDERED = re.compile(
    r"\w+est\b|\b(?:order|first|second|third|last|then|middle|between|by|alphabet\w*|colou?rs?|"
    r"sizes?|"
    r"heights?|tall|short|big|small|one|ones|them|it)\b"
)
"""Words by which it matters which thing comes where in the form."""


_WORDS = frozenset(
    {"a", "an", "the", "in", "into", "one", "single", "row", "column", "line", "of", "with", "to"}
    | {"up", "out", "apart", "gap", "gaps", "space", "spaces", "spaced", "spacing", "distance"}
    | {"distances", "between", "each", "them", "equal", "equally", "even", "evenly", "same", "some"}
    | {"bit", "little", "wee", "neat", "nice", "straight", "tidy", "side", "by", "behind", "other"}
    | {"another", "edge", "cm", "left", "right", "from", "that", "such", "are", "there", "is", "at"}
    | {"vertical", "horizontal", "proper", "long", "short", "neatly", "nicely"}
)
"""Words that say the form and its gaps, and no more."""


class Formed(NamedTuple):
    """``things`` end in a form; ``gap`` from edge to edge where it was said (table units), ``even``
    where the gaps are to be equal, ``spaced`` where there are to be any; ``whole``:
    nothing more is said of how they are to end."""

    form: Form
    things: tuple[str, ...]
    gap: float | None = None
    even: bool = False
    spaced: bool = False
    whole: bool = False


def formed(
    linked: Linked, binding: Mapping[str, tuple[str, ...]], scene: Scene
) -> tuple[Formed, ...]:
    """The form that the sentence says, for one binding of its mentions."""
    said = _said(linked.text.lower())
    if said is None:
        return ()
    form, start, end = said
    themes = [one for one in linked.spoken if one.theme]
    before = [one for one in themes if one.mention.end <= start]
    meant = before or [one for one in themes if one.mention.start >= end][:1]
    if any(one.verb not in _SET for one in meant):
        return ()
    things = tuple(dict.fromkeys(o for one in meant for o in binding.get(one.mention.slot, ())))
    rest = [
        one for one in linked.spoken if not set(binding.get(one.mention.slot, ("",))) <= {*things}
    ]
    if len(things) < (3 if form == "line" else 2) or any(scene.get(o).x is None for o in things):
        return ()
    measures = quantities(linked, scene)
    apart = len(measures) == 1 and measures[0].slot == "d1" and _ALL.search(linked.text) is not None
    whole = not rest and _ORDERED.search(_outside(linked)) is None
    gap = measures[0].value if apart and not rest else None
    even, spaced = (not rest and bool(said.search(linked.text)) for said in (_EVEN, _SPACED))
    return (Formed(form, things, gap, even, spaced and gap is None, whole),)


def formed_wholly(
    goals: Sequence[object], linked: Linked, lexicon: Lexicon, before: Scene, after: Scene
) -> bool:
    """Whether a sentence that says a form, and nothing else, is just what an end comes to."""
    whole = [goal for goal in goals if isinstance(goal, Formed) and goal.whole]
    measured = {at for c in linked.chunks if c.kind in ("measure", "verb") for at in _span(c)}
    inside = {at for one in linked.spoken for at in range(one.opened, one.last)} | measured
    known = _WORDS | lexicon.words("polite") | {",", ".", "!"}
    said = {token.text for at, token in enumerate(linked.tokens) if at not in inside}
    shifted = {item.id for item in before if moved(item, after.get(item.id)) > 0}
    return (
        len(whole) == 1
        and said <= known
        and shifted <= set(whole[0].things)
        and in_form(whole[0], after)
    )


def _span(chunk: Chunk) -> range:
    return range(chunk.first, chunk.last)


def _outside(linked: Linked) -> str:
    """The words outside the mentions, and outside "one behind the other"."""
    inside = {at for one in linked.spoken for at in range(one.opened, one.last)}
    words = " ".join(t.text for at, t in enumerate(linked.tokens) if at not in inside)
    return re.sub(
        r"\bbetween(?: each| them| the)?\b|\b(?:in|into|of) one\b", "", _BEHIND.sub("", words)
    )


def _said(text: str) -> tuple[Form, int, int] | None:
    """The one form that is said, and where in the text; None of several."""
    text = _NO_LONGER.sub(lambda gone: " " * len(gone.group()), text)
    if _SEVERAL.search(text):
        return None
    found: list[tuple[Form, int, int]] = []
    for match in _FORM.finditer(text):
        form = _FORMS[(match["upright"] or match["form"]).strip()]
        found.append((form, *match.span()))
    found += [("column", *match.span()) for match in _BEHIND.finditer(text)]
    found += [("row", *match.span()) for match in _ABREAST.finditer(text)]
    deep = _DEEP.search(text)
    if deep is not None and (found or _LINED.search(text)):
        return ("column", *(found[0][1:] if found else deep.span()))
    if len({form for form, _, _ in found}) > 1:
        found = [one for one in found if one[0] != "line"]
    return found[0] if len(found) == 1 else None


_ROW_CALL = re.compile(r"(?P<form>row|column)\((?P<things>[^\n]*)\)")
_ABREAST_CALL = re.compile(r"\bput_abreast\(")


def turned(body: str, goals: Sequence[object]) -> str:
    """The program as the column that the sentence says, where it sets the same things abreast: the
    translator knows how far apart they go, the sentence which way."""
    upright = any(isinstance(goal, Formed) and goal.form == "column" for goal in goals)
    return _ABREAST_CALL.sub("put_in_depth(", body) if upright else body


def spaced(body: str, text: str, measures: Sequence[Quantity]) -> str:
    """The program with the gap that the sentence says, where it sets the things in the form that
    is said and leaves the gap out."""
    row = _ROW_CALL.fullmatch(body)
    apart = [measure.slot for measure in measures] == ["d1"] and _ALL.search(text) is not None
    if row is None or not apart or _said(text.lower()) is None:
        return body
    skill = "put_abreast" if row["form"] == "row" else "put_in_depth"
    return f"{skill}({row['things']}, d1)"


def in_form(goal: Formed, after: Scene) -> bool:
    """Whether the things end so."""
    items = [after.get(o) for o in goal.things]
    if any(item.x is None for item in items):
        return False
    if not _SHAPES[goal.form](items):
        return False
    gaps = _gaps(items)
    if goal.spaced and min(gaps) < OPEN:
        return False
    if goal.gap is None and not goal.even:
        return True
    wanted = sum(gaps) / len(gaps) if goal.gap is None else goal.gap
    return all(abs(one - wanted) <= UNEVEN for one in gaps)


def _in_line(items: list[SceneObject]) -> bool:
    """Whether the middles lie on a straight line, whichever way it goes."""
    places = sorted(item.position for item in items)
    (x1, y1), (x2, y2) = max(
        ((a, b) for a in places for b in places), key=lambda two: math.dist(*two)
    )
    length = math.hypot(x2 - x1, y2 - y1) or 1.0
    return all(abs((x - x1) * (y2 - y1) - (y - y1) * (x2 - x1)) / length <= OFF for x, y in places)


def _gaps(items: Sequence[SceneObject]) -> list[float]:
    """From edge to edge of neighbours, along the axis on which they are farther apart."""
    xs, ys = zip(*(item.position for item in items), strict=True)
    axis = 0 if max(xs) - min(xs) >= max(ys) - min(ys) else 1
    row = sorted(items, key=lambda item: item.position[axis])
    return [
        other.position[axis] - one.position[axis] - extents(one)[axis] - extents(other)[axis]
        for one, other in pairwise(row)
    ]


_SHAPES: Mapping[Form, Callable[[list[SceneObject]], bool]] = {
    "row": in_row, "column": in_column, "line": _in_line,
}  # fmt: skip

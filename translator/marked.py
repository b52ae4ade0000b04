"""Sentences as the translator reads them: things and measures taken out, slots put in.

Each mention becomes the same plain word ("block", "blocks"), each measure the same plain measure,
and its word pieces are marked with the slot; the model learns an embedding for each slot and reads
that in place of the words. So no name of a thing ever reaches the model, and a thing that it has
never heard of is translated exactly as one that it has (argument identification).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from agent.messages import TranslateRequest

ONE, SEVERAL, LENGTH, ANGLE, COUNT = "block", "blocks", "10 cm", "90 degrees", "three"
"""What stands in the sentence for one thing, several, a length, an angle, a number."""
MOST = 8
"""Things, and groups, that a sentence may name."""
MOST_MEASURES = 3
SLOTS: tuple[str, ...] = (
    *(f"m{n}" for n in range(1, MOST + 1)),
    *(f"g{n}" for n in range(1, MOST + 1)),
    *(f"{letter}{n}" for letter in "dtn" for n in range(1, MOST_MEASURES + 1)),
)
"""Slots as the model's programs name them: things m, groups g, lengths d, angles t, numbers n."""
PLACEHOLDERS = {"m": ONE, "g": SEVERAL, "d": LENGTH, "t": ANGLE, "n": COUNT}


class Mark(NamedTuple):
    """A part of a sentence that stands for a slot."""

    start: int
    end: int
    slot: str


class Marked(NamedTuple):
    """A sentence with its placeholders, and where they are; in order, not overlapping."""

    text: str
    marks: tuple[Mark, ...]


def apart(marks: Iterable[Mark]) -> list[Mark]:
    """The marks in order, without those that begin inside another one."""
    result: list[Mark] = []
    for mark in sorted(marks):
        if not result or mark.start >= result[-1].end:
            result.append(mark)
    return result


def marked(text: str, marks: Iterable[Mark]) -> Marked:
    """Put each slot's placeholder into a text in the place of what it marks."""
    result, at, found = "", 0, []
    for mark in apart(marks):
        result += text[at : mark.start]
        word = PLACEHOLDERS[mark.slot[0]]
        found.append(Mark(len(result), len(result) + len(word), mark.slot))
        result += word
        at = mark.end
    return Marked(result + text[at:], tuple(found))


def read(request: TranslateRequest) -> tuple[Marked, dict[str, str]]:
    """The request's sentence for the model, and for each slot of the model the request's own.

    Slots beyond those the model knows keep their words, so that nothing is translated as a whole
    that was not understood as a whole.
    """
    marks, names = marks_of(request)
    return marked(request.text, marks), names


def marks_of(request: TranslateRequest) -> tuple[list[Mark], dict[str, str]]:
    """The parts of the request's own sentence that `read` takes out, and its slots' names."""
    names: dict[str, str] = {}
    marks: list[Mark] = []
    for mention in request.mentions:
        own = ("g" if mention.plural else "m") + mention.slot[1:]
        own = next((known for known, slot in names.items() if slot == mention.slot), own)
        if own in SLOTS:
            names[own] = mention.slot
            marks.append(Mark(mention.start, mention.end, own))
    for measure in request.measures:
        if measure.slot in SLOTS:
            names[measure.slot] = measure.slot
            marks.append(Mark(measure.start, measure.end, measure.slot))
    return marks, names


def slot_ids(offsets: Sequence[tuple[int, int]], marks: Sequence[Mark]) -> list[int]:
    """For each word piece (given its place in the text) the number of its slot, 0 for none."""
    ids = []
    for start, end in offsets:
        inside = (mark.slot for mark in marks if mark.start <= start < end <= mark.end)
        slot = next(inside, None)
        ids.append(0 if slot is None else SLOTS.index(slot) + 1)
    return ids

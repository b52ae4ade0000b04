"""A sentence as it was said, put into the words that the rest reads: every step, in order."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from agent.messages import Focus
from clarifier.act import is_question
from clarifier.afterthoughts import counted_before
from clarifier.apposed import told_once
from clarifier.between_two import set_apart
from clarifier.called import Called, with_whole_names
from clarifier.conditions import Settled, settled
from clarifier.contrasts import settled_contrast
from clarifier.corrected import corrected
from clarifier.each_place import one_for_each
from clarifier.everyday import in_everyday_words
from clarifier.fellows import as_things
from clarifier.figure_words import told_as_figure
from clarifier.if_words import depends
from clarifier.in_order import told_in_order
from clarifier.laps import round_and_round
from clarifier.lexicon import Lexicon
from clarifier.misheard import heard_right
from clarifier.no_things import without_no_things
from clarifier.own_parts import without_own_parts
from clarifier.part_way import told_in_lengths
from clarifier.parted import parted
from clarifier.penned import as_usual
from clarifier.preamble import to_the_point
from clarifier.refusals import State
from clarifier.said import put_plainly
from clarifier.same_again import with_same_measure, with_unit
from clarifier.spelling import repair
from clarifier.steps import in_steps
from clarifier.turns import in_plain_turns
from scene.types import Scene


class Worded(NamedTuple):
    """The sentence in plain words, what is to be said of that, and what a condition in it came
    down to: where that has no text, nothing is to be done, or it is not certain what."""

    text: str
    echo: str
    branch: Settled | None


def in_plain_words(said: str, state: State, lexicon: Lexicon) -> Worded:
    """``said``, taught words spelled out, as the rest reads it. Pure."""
    scene, focus = state.scene, state.dialog.focus
    names = names_of(scene)
    # what was written, and what was heard
    said, heard = heard_right(as_usual(said, names, lexicon), names, lexicon)
    said = in_everyday_words(said)
    plain = put_plainly(said)
    text, echo = repair(plain, names, lexicon)
    again = put_plainly(in_everyday_words(text)) if text != plain else text
    text, echo = again, f"{heard} {echo}".strip()
    text = corrected(text, scene, focus, lexicon)
    # what it depends on
    branch = branch_of((said, text), state, lexicon)
    if branch is not None and branch.text is None:
        return Worded(text, echo, branch)
    if branch is not None and branch.text is not None:
        text, echo = put_plainly(branch.text), f"{echo} {branch.note}".strip()
    # turns of phrase, names, measures
    text = without_own_parts(text, names)
    text = without_no_things(text, names, lexicon)
    text = with_unit(in_plain_turns(round_and_round(text), lexicon))
    text, note = _named_in_full(text, scene, focus, lexicon)
    text = with_same_measure(text, state.dialog)
    # a new command's order, and what only leads to it; an answer is read as it is
    if state.dialog.pending is None:
        text = told_once(text, scene, focus, lexicon)
        text = settled_contrast(text, scene, focus, lexicon)
        text = parted(text, scene, focus, lexicon)
        text = set_apart(text, scene, focus, lexicon)
        text = told_in_order(text, scene, focus, lexicon)
        text = in_steps(text, scene, focus, lexicon)
        text = to_the_point(text, scene, focus, lexicon)
        text = text if is_question(text) else _set_out(text, scene, focus, lexicon)
    return Worded(text, f"{echo} {note}".strip(), branch)


def _set_out(text: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> str:
    """Where several things go, which figure they form, and how far something goes, told plainly."""
    text = one_for_each(text, scene, focus, lexicon)
    text = told_as_figure(text, scene, focus, lexicon)
    return told_in_lengths(text, scene, focus, lexicon)


def branch_of(texts: Sequence[str], state: State, lexicon: Lexicon) -> Settled | None:
    """What a condition comes down to, in the first of the texts (the sentence as it was said,
    slips apart, then as put plainly) that tells; None where nothing depends on anything."""
    for text in texts if depends(texts[0]) else ():
        given, _ = repair(text, names_of(state.scene), lexicon)
        branch = settled(given, state.scene, state.dialog.focus, lexicon)
        if branch is not None:
            return branch
    return None


def names_of(scene: Scene) -> set[str]:
    """The names and colours of what is there."""
    return {said for item in scene for said in (item.name, item.color) if said}


def _named_in_full(text: str, scene: Scene, focus: Sequence[Focus], lexicon: Lexicon) -> Called:
    """The sentence with things called as the scene calls them, and what is said of that."""
    text = counted_before(as_things(text, scene, lexicon, focus), scene, lexicon)
    return with_whole_names(text, scene, lexicon)

"""Sentences made whole: an answer put into the sentence that was asked about, an ellipsis put
into the last command. The result is a sentence like any other and goes through the whole ladder.
"""

from __future__ import annotations

from collections.abc import Sequence

from agent.messages import Dialog, Focus, Option, Pending
from clarifier.ask import labels
from clarifier.lexicon import Lexicon
from clarifier.mentions import Linked, Spoken, ambiguous, link
from clarifier.roles import complete, find_gap
from clarifier.words import words
from scene.types import Scene

_AGAIN = frozenset({"now", "and", "then", "also", "too", "next", "as", "well", "again", "same"})


def fill(
    pending: Pending,
    option: Option | None,
    said: str,
    scene: Scene,
    focus: Sequence[Focus],
    lexicon: Lexicon,
) -> str:
    """The pending sentence with the option (or the words said) in the place asked about."""
    linked = link(pending.text, scene, focus, lexicon)
    answer = option.label if option is not None else said
    spoken = _troubled(linked)
    objects = option.objects if option is not None else ()
    about_things = pending.question.kind not in ("where", "direction", "open")
    if about_things and spoken is not None and (objects or said):
        return _replaced(linked, spoken, answer)
    gap = find_gap(linked, lexicon)
    if gap is None:
        return pending.text
    if gap.role == "theme" and not answer.startswith("the "):
        answer = f"the {answer}"
    return complete(pending.text, gap, answer)


def restate(text: str, dialog: Dialog, scene: Scene, lexicon: Lexicon) -> str | None:
    """ "now the blue one", "and the cup too": the last command with another theme; else None."""
    if dialog.last_text is None:
        return None
    linked = link(text, scene, dialog.focus, lexicon)
    outside = _words_outside(linked)
    if len(linked.spoken) != 1 or linked.spoken[0].relation or not outside <= _AGAIN:
        return None
    past = link(dialog.last_text, scene, (), lexicon)
    themes = [one for one in past.spoken if one.theme and one.phrase is not None]
    if len(themes) != 1 or linked.spoken[0].phrase is None:
        return None
    return _replaced(past, themes[0], _named_in_full(linked.spoken[0], themes[0]))


def spelled_out(linked: Linked, scene: Scene, lexicon: Lexicon) -> str:
    """The sentence with its pronouns replaced by names, so that it can be understood later."""
    text = linked.text
    for one in reversed(linked.spoken):
        if one.phrase is None and len(one.mention.objects) == 1:
            (object_id,) = one.mention.objects
            same = [item.id for item in scene if item.name == scene.get(object_id).name]
            label = labels(same, scene, lexicon)[object_id]
            text = text[: one.mention.start] + label + text[one.mention.end :]
    return text


def _named_in_full(new: Spoken, old: Spoken) -> str:
    """ "blue one" after "red mug" is a "blue mug"."""
    assert new.phrase is not None and old.phrase is not None
    if new.phrase.head or not old.phrase.head:
        return new.mention.text
    return " ".join((*new.phrase.modifiers, *old.phrase.head))


def _words_outside(linked: Linked) -> set[str]:
    inside: set[int] = set()
    for one in linked.spoken:
        opened = one.phrase.opened if one.phrase is not None else one.first
        inside |= set(range(opened, one.last))
    texts = [t.text for i, t in enumerate(linked.tokens) if i not in inside]
    return {text for text in texts if text[0].isalnum()}


def _troubled(linked: Linked) -> Spoken | None:
    """The mention that a question must have been about: absent, too many, or unclear."""
    for one in linked.spoken:
        count = one.phrase.count if one.phrase is not None else None
        short = count is not None and count > len(one.mention.objects)
        if not one.mention.objects or ambiguous(one) or short:
            return one
    return None


def _replaced(linked: Linked, spoken: Spoken, answer: str) -> str:
    """The sentence with a mention, determiner included, replaced by "the ..."."""
    opened = spoken.phrase.opened if spoken.phrase is not None else spoken.first
    start = linked.tokens[opened].start
    bare = answer if words(answer)[:1] in (("the",), ("a",), ("an",)) else f"the {answer}"
    return f"{linked.text[:start]}{bare}{linked.text[spoken.mention.end :]}"

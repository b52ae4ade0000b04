"""What the conversation is about: salience of the objects spoken of (clarifier design)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from agent.messages import Focus
from clarifier.spoken import Linked

THEME = 1.0
DESTINATION = 0.8
NAMED_IN_QUESTION = 0.6
DECAY = 0.7
"""What a turn leaves of a salience."""
FORGOTTEN = 0.1
"""Saliences below this are dropped."""


def decayed(focus: Sequence[Focus]) -> dict[str, float]:
    """Saliences one turn later."""
    return {one.object: one.salience * DECAY for one in focus}


def after(focus: Sequence[Focus], linked: Linked, asked: Iterable[str] = ()) -> tuple[Focus, ...]:
    """The focus after a turn over these mentions, ``asked`` being named in a question."""
    found = decayed(focus)
    for object_id in asked:
        found[object_id] = max(found.get(object_id, 0.0), NAMED_IN_QUESTION)
    for one in linked.spoken:
        if len(one.mention.objects) == 1 or one.mention.plural:
            strength = THEME if one.theme else DESTINATION
            for object_id in one.mention.objects:
                found[object_id] = max(found.get(object_id, 0.0), strength)
    return _sorted(found)


def on(focus: Sequence[Focus], themes: Iterable[str], others: Iterable[str]) -> tuple[Focus, ...]:
    """The focus after a turn that acted on ``themes`` and led to ``others``."""
    found = decayed(focus)
    for object_id in others:
        found[object_id] = max(found.get(object_id, 0.0), DESTINATION)
    for object_id in themes:
        found[object_id] = THEME
    return _sorted(found)


def _sorted(found: dict[str, float]) -> tuple[Focus, ...]:
    order = sorted(found.items(), key=lambda entry: -entry[1])
    return tuple(Focus(name, round(value, 4)) for name, value in order if value >= FORGOTTEN)

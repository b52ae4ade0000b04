"""Replies after which nothing moves."""

from __future__ import annotations

import msgspec

from agent.messages import Decision
from clarifier.conditions import Settled
from clarifier.refusals import State, refuse


def say(state: State, reply: str, why: str, drop: bool = False) -> Decision:
    """Nothing moves; an open question stays open unless it is dropped."""
    dialog = state.dialog
    if drop:
        dialog = msgspec.structs.replace(dialog, pending=None, questions_asked=0)
    return Decision("answer", why, dialog, reply=f"{state.echo} {reply}".strip())


def left(branch: Settled, state: State) -> Decision:
    """What is said where a condition leaves nothing to be done, or it is not certain what."""
    if not branch.unsure:
        note = f"{branch.note} So I leave everything as it is."
        return say(state, note, "the branch that holds wants nothing done")
    reply = f"{branch.note} Please say what I should do."
    return refuse(state, "not_understood", reply, "what depends on what is not certain")

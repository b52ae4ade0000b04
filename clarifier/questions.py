"""The decision to ask, which every rule of the ladder may take."""

from __future__ import annotations

import msgspec

from agent.messages import Decision, Option, Pending, Question, QuestionKind
from clarifier import focus
from clarifier.branches import Branches
from clarifier.candidates import Planner
from clarifier.lexicon import Lexicon
from clarifier.refusals import State, refuse
from clarifier.spoken import Linked

MAX_QUESTIONS = 4
"""Questions about one command; then the clarifier gives up."""


class Questions:
    """What the rules share: how things are translated and checked, and how one asks."""

    def __init__(self, planner: Planner, lexicon: Lexicon) -> None:
        self._planner = planner
        self._lexicon = lexicon
        self._branches = Branches(planner, lexicon)

    def _ask(
        self, linked: Linked, state: State, kind: QuestionKind, text: str,
        options: tuple[Option, ...], why: str,
    ) -> Decision:  # fmt: skip
        """The decision to ask; after too many questions about one command, to give up."""
        if state.questions >= MAX_QUESTIONS:
            reply = "I have asked enough about this one. Please say it again in other words."
            return refuse(state, "not_understood", reply, "too many questions about one command")
        question = Question(kind, text, options)
        named = [object_id for option in options for object_id in option.objects]
        new = msgspec.structs.replace(
            state.dialog, focus=focus.after(state.dialog.focus, linked, named),
            pending=Pending(linked.whole, question), questions_asked=state.questions + 1,
        )  # fmt: skip
        return Decision(
            "ask", why, new, reply=f"{state.echo} {text}".strip(), question=question,
            echo=state.echo,
        )  # fmt: skip

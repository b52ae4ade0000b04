"""The clarifier's front door: routes a sentence by its dialogue act, answers open questions, and
hands commands to the ladder. Act, ask, answer, refuse or stop: always exactly one of them.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import msgspec

from agent.check import Predict, Workspace
from agent.execute import Executor
from agent.messages import ClarifyRequest, Decision, Pending
from clarifier import act, focus
from clarifier.answer import read_answer
from clarifier.answering import Answering
from clarifier.candidates import Planner, Seen, Translate, unheard
from clarifier.conformal import PRODUCT, Policy
from clarifier.deed import link_deed, only_forbids
from clarifier.follow_ups import followed_up
from clarifier.gist import called_off
from clarifier.going_on import with_measure, with_place
from clarifier.hearing import Hears, decided
from clarifier.ladder import Ladder
from clarifier.lexicon import Lexicon, load_lexicon
from clarifier.mentions import link
from clarifier.object_first import verb_in_front
from clarifier.overheard import whole
from clarifier.passing import without_asides_said
from clarifier.refusals import State, refuse
from clarifier.replies import left, say
from clarifier.rewrite import put_there, restate, told_to_do, with_verb
from clarifier.same_again import lacks_measure, once_more
from clarifier.scene_answers import SceneQuestions
from clarifier.taking_back import TakingBack
from clarifier.talk import OFF_TOPIC, is_talk
from clarifier.taught import Taught
from clarifier.teaching import Teaching
from clarifier.worded import in_plain_words, names_of
from clarifier.words import MAX_TEXT, singular, words

_HELP = (
    "Tell me what to do with the things on the table: put, push, pick up, touch or knock over"
    " something. You can also ask what I see, or say “undo that”."
)
_GOING_ON = (once_more, restate, with_measure, with_place, followed_up, with_verb)


class Manner(NamedTuple):
    """How a clarifier decides: what evaluations leave out of it, or listen to."""

    policy: Policy = PRODUCT
    seen: Seen = unheard
    planner: type[Planner] = Planner
    ladder: type[Ladder] = Ladder


class Clarifier:
    """Decides on sentences. Everything slow or physical is passed in; it holds no state."""

    def __init__(
        self,
        translate: Translate,
        executor: Executor,
        predict: Predict,
        workspace: Workspace,
        taught: Taught | None = None,
        manner: Manner | None = None,
        hears: Hears | None = None,
    ) -> None:
        """``taught``: the words that the person has taught; in memory where none are given.
        ``manner``: how it decides, where that is not the product's way. ``hears``: leaves talk out
        of a sentence that is not understood with it."""
        self._manner = manner or Manner()
        self._hears = hears
        self._parts = (translate, executor, predict, workspace)
        self._lexicon = load_lexicon()
        self._teaching = Teaching(taught or Taught(), self._lexicon)

    def decide(self, request: ClarifyRequest) -> Decision:
        """Act, ask, answer, refuse or stop. Never moves anything. Raises TranslatorError."""
        hears = None if self._hears is None else whole(self._hears, request.scene)
        return decided(self._decide, hears, request)

    def _decide(self, request: ClarifyRequest) -> Decision:
        manner = self._manner
        planner = manner.planner(*self._parts, manner.policy, manner.seen, request.sd)
        turn = _Turn(planner, self._lexicon, self._teaching, manner.ladder)
        decision = msgspec.structs.replace(turn.decide(request), ms_translate=planner.ms)
        if decision.do == "answer":
            return decision
        dialog = msgspec.structs.replace(decision.dialog, why=decision.why)
        return msgspec.structs.replace(decision, dialog=dialog)


class _Turn:
    """One call: the planner counts the translation's time over it."""

    def __init__(
        self, planner: Planner, lexicon: Lexicon, teaching: Teaching, ladder: type[Ladder]
    ) -> None:
        self._planner = planner
        self._teaching = teaching
        self._lexicon = lexicon
        self._ladder = ladder(planner, lexicon)
        self._back = TakingBack(planner, lexicon, self._ladder)
        self._answering = Answering(planner, lexicon, teaching, self._ladder)

    def decide(self, request: ClarifyRequest) -> Decision:
        state = State(request.scene, request.dialog, request.task)
        if act.is_stop(request.text[:MAX_TEXT], self._lexicon):
            dialog = msgspec.structs.replace(request.dialog, pending=None, questions_asked=0)
            return Decision("stop", "the sentence calls a halt", dialog, reply="Stopped.")
        unreadable = why_unreadable(request.text)
        if unreadable is not None and not (request.dialog.pending and not words(request.text)):
            return refuse(state, "not_understood", unreadable, "the text cannot be read")
        pending = request.dialog.pending
        about_words = self._teaching.decide(request.text, state)
        if about_words is not None:
            return self._go_on(about_words, pending, state)
        known, trouble = self._teaching.words(request.dialog)
        put = in_plain_words(known.spelled_out(request.text), state, self._lexicon)
        if put.branch is not None and put.branch.text is None:
            return left(put.branch, replace(state, echo=put.echo))
        text = put.text
        state = State(request.scene, request.dialog, request.task, f"{trouble} {put.echo}".strip())
        if pending is None and lacks_measure(text):
            said = "I don't know which amount you mean: none was said before. Say how far."
            return refuse(state, "not_understood", said, "the same amount as none")
        if pending is not None and not words(text):
            return self._answer(text, state, pending)
        routed = self._route(text, state)
        if routed is not None:
            return routed
        return self._command(text, state) if pending is None else self._answer(text, state, pending)

    def _go_on(self, taught: Decision, pending: Pending | None, state: State) -> Decision:
        """Once the word that a question was about is taught, what was asked for is done."""
        known, _ = self._teaching.words(taught.dialog)
        if pending is None or not pending.word or not known.meaning(singular(pending.word)):
            return taught
        fresh = msgspec.structs.replace(taught.dialog, pending=None)
        asked = State(state.scene, fresh, state.task, taught.reply, state.dialog.questions_asked)
        return self._answering.whole(known.spelled_out(pending.text), asked)

    # --- dialogue acts ------------------------------------------------------------

    def _route(self, text: str, state: State) -> Decision | None:
        """Everything that is neither a command nor, with a question open, its answer."""
        kind = act.classify(text, self._lexicon)
        pending = state.dialog.pending
        if kind == "why":
            why = state.dialog.why or "there is nothing that I decided on"
            return say(state, f"Because {why}.", "the person asks for the reason")
        if kind == "cancel":
            open_ = " I drop my question." if pending is not None else ""
            return say(state, f"All right.{open_}", "the person cancelled", drop=True)
        off = called_off(text) if pending is not None else None
        if off is not None:
            fresh = msgspec.structs.replace(state.dialog, pending=None, questions_asked=0)
            rest = State(state.scene, fresh, state.task, state.echo)
            said = "the person called it off"
            return self._command(off, rest) if words(off) else say(rest, "All right.", said)
        if pending is not None:
            meant = read_answer(text, pending, state.scene, self._lexicon)
            if meant.kind != "other":
                return None
        if kind == "question":
            return self._question(text, state)
        if kind == "command" and text.rstrip().endswith("?"):
            known = SceneQuestions(state.scene, state.dialog.focus, self._lexicon).stated(text)
            if known is not None:
                return say(state, known, "a question about the scene")
        replies = {
            "greeting": ("Hello! What should I do?", "a greeting"),
            "thanks": ("You're welcome.", "thanks"),
            "help": (_HELP, "the person asks for help"),
            "chat": (OFF_TOPIC, "not about the table"),
            "leave": ("All right, I won't.", "the person says what not to do"),
        }
        if kind == "undo":
            return self._back.undo(text, state)
        if kind in replies:
            reply, why = replies[kind]
            return say(state, reply, why)
        return None

    def _question(self, text: str, state: State) -> Decision:
        """A question about the scene, answered from it; anything else is declined."""
        found = SceneQuestions(state.scene, state.dialog.focus, self._lexicon).answer(text)
        if found is None:
            return say(state, OFF_TOPIC, "a question that is not about the scene")
        linked = link(text, state.scene, state.dialog.focus, self._lexicon)
        new = msgspec.structs.replace(
            state.dialog, focus=focus.after(state.dialog.focus, linked)
        )  # fmt: skip
        return say(replace(state, dialog=new), found, "a question about the scene")

    # --- answers and commands ------------------------------------------------------------

    def _answer(self, text: str, state: State, pending: Pending) -> Decision:
        """Go on from an open question, or drop it for a new command."""
        decision = self._answering.decide(text, state, pending)
        if not isinstance(decision, str):
            return decision
        dropped = "" if pending.question.kind == "open" else "I drop my question."
        echo = f"{state.echo} {dropped}".strip()
        fresh = msgspec.structs.replace(state.dialog, pending=None, questions_asked=0)
        return self._command(decision, State(state.scene, fresh, state.task, echo))

    def _command(self, text: str, state: State) -> Decision:
        text = without_asides_said(text, names_of(state.scene))
        taken_back = (
            self._back.other_way(text, state)
            or self._back.back_and_on(text, state)
            or self._back.named(text, state)
            or self._back.corrected(text, state)
        )
        if taken_back is not None:
            return taken_back
        core = act.imperative(act.strip_courtesy(text) or text, self._lexicon)
        again = next(
            (whole for rule in _GOING_ON
             if (whole := rule(core, state.dialog, state.scene, self._lexicon)) is not None),
            None,
        )  # fmt: skip
        again = again or put_there(core, state.scene, self._lexicon)
        again = again or told_to_do(core, state.scene, self._lexicon)
        again = again or verb_in_front(core, state.scene, self._lexicon)
        if only_forbids(core, state.scene, state.dialog.focus, self._lexicon):
            return say(state, "All right, I won't.", "the person says what must stay")
        linked = link_deed(core, state.scene, state.dialog.focus, self._lexicon)
        if again is None and is_talk(linked, self._lexicon):
            return say(state, OFF_TOPIC, "nothing is to be done")
        return self._ladder.decide(again or core, state)


def why_unreadable(text: str) -> str | None:
    """Why a text cannot be a sentence: empty, endless, or not text."""
    if not text.strip():
        return "You said nothing. Tell me what to do."
    if len(text) > MAX_TEXT:
        return f"That is too long for me: at most {MAX_TEXT} characters, please."
    if any(not ch.isprintable() and ch not in "\n\t\r" for ch in text):
        return "There are characters in that which I cannot read."
    if not words(text):
        return "I see no words in that. Tell me what to do."
    return None

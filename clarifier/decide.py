"""The clarifier's front door: routes a sentence by its dialogue act, answers open questions, and
hands commands to the ladder. Act, ask, answer, refuse or stop: always exactly one of them.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import msgspec

from agent.check import Predict, Workspace
from agent.execute import Executor
from agent.messages import LEAVE, ClarifyRequest, Decision, Option, Pending
from clarifier import act, focus
from clarifier.afterthoughts import counted_before
from clarifier.answer import read_answer
from clarifier.apposed import told_once
from clarifier.ask import numbered
from clarifier.asked import Answer
from clarifier.called import Called, with_whole_names
from clarifier.candidates import Planner, Seen, Translate, unheard
from clarifier.conditions import Settled, settled
from clarifier.conformal import PRODUCT, Policy
from clarifier.contrasts import settled_contrast
from clarifier.deed import link_deed, only_forbids
from clarifier.fellows import as_things
from clarifier.follow_ups import followed_up
from clarifier.gist import called_off
from clarifier.going_on import with_measure, with_place
from clarifier.hearing import Hears, decided
from clarifier.if_words import depends
from clarifier.ladder import Ladder
from clarifier.lexicon import Lexicon, load_lexicon
from clarifier.mentions import link
from clarifier.misheard import heard_right
from clarifier.no_things import without_no_things
from clarifier.object_first import verb_in_front
from clarifier.own_parts import without_own_parts
from clarifier.passing import without_asides_said, without_lead
from clarifier.penned import as_usual
from clarifier.preamble import to_the_point
from clarifier.refusals import State, refuse, refuse_problem
from clarifier.rewrite import fill, put_there, restate, told_to_do, with_verb
from clarifier.said import put_plainly
from clarifier.same_again import lacks_measure, once_more, with_same_measure, with_unit
from clarifier.scene_answers import SceneQuestions
from clarifier.spelling import repair
from clarifier.steps import in_steps
from clarifier.taking_back import TakingBack
from clarifier.talk import is_talk
from clarifier.taught import Taught
from clarifier.teaching import Teaching
from clarifier.turns import in_plain_turns
from clarifier.undo import remembered
from clarifier.words import MAX_TEXT, listing, singular, words
from scene.types import Scene

MAX_STRIKES = 2
"""Answers that are not understood; then the question is dropped."""

_HELP = (
    "Tell me what to do with the things on the table: put, push, pick up, touch or knock over"
    " something. You can also ask what I see, or say “undo that”."
)
_LEFT = "All right, I leave it. Tell me what you would like instead."
_GOING_ON = (once_more, restate, with_measure, with_place, followed_up, with_verb)
_OFF_TOPIC = "I can only talk about what is on the table and move it."


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
        return decided(self._decide, self._hears, request)

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
        names = self._names(state)
        said = as_usual(known.spelled_out(request.text), names, self._lexicon)
        said, heard = heard_right(said, names, self._lexicon)
        plain = put_plainly(said)
        text, echo = repair(plain, names, self._lexicon)
        text, echo = put_plainly(text) if text != plain else text, f"{heard} {echo}".strip()
        branch = self._branch((said, text), state)
        if branch is not None and branch.text is None:
            return self._left(branch, State(request.scene, request.dialog, request.task, echo))
        if branch is not None and branch.text is not None:
            text, echo = put_plainly(branch.text), f"{echo} {branch.note}".strip()
        text = without_own_parts(text, self._names(state))
        text = without_no_things(text, self._names(state), self._lexicon)
        text = with_unit(in_plain_turns(text, self._lexicon))
        text, note = self._named_in_full(text, request.scene)
        echo = f"{echo} {note}".strip()
        text = with_same_measure(text, request.dialog)
        if pending is None:
            text = told_once(text, request.scene, request.dialog.focus, self._lexicon)
            text = settled_contrast(text, request.scene, request.dialog.focus, self._lexicon)
            text = in_steps(text, request.scene, request.dialog.focus, self._lexicon)
            text = to_the_point(text, request.scene, request.dialog.focus, self._lexicon)
        state = State(request.scene, request.dialog, request.task, f"{trouble} {echo}".strip())
        if pending is None and lacks_measure(text):
            said = "I don't know which amount you mean: none was said before. Say how far."
            return refuse(state, "not_understood", said, "the same amount as none")
        if pending is not None and not words(text):
            return self._answer(text, state, pending)
        routed = self._route(text, state)
        if routed is not None:
            return routed
        return self._command(text, state) if pending is None else self._answer(text, state, pending)

    def _branch(self, texts: Sequence[str], state: State) -> Settled | None:
        """What a condition comes down to, as it was said (slips apart), else as put plainly."""
        for text in texts if depends(texts[0]) else ():
            given, _ = repair(text, self._names(state), self._lexicon)
            branch = settled(given, state.scene, state.dialog.focus, self._lexicon)
            if branch is not None:
                return branch
        return None

    def _named_in_full(self, text: str, scene: Scene) -> Called:
        """The sentence with things called as the scene calls them, and what is said of that."""
        text = counted_before(as_things(text, scene, self._lexicon), scene, self._lexicon)
        return with_whole_names(text, scene, self._lexicon)

    def _left(self, branch: Settled, state: State) -> Decision:
        """Nothing is to be done, or it is not certain what."""
        if not branch.unsure:
            note = f"{branch.note} So I leave everything as it is."
            return self._say(state, note, "the branch that holds wants nothing done")
        reply = f"{branch.note} Please say what I should do."
        return refuse(state, "not_understood", reply, "what depends on what is not certain")

    def _names(self, state: State) -> set[str]:
        """The names and colours of what is there."""
        return {said for item in state.scene for said in (item.name, item.color) if said}

    def _go_on(self, taught: Decision, pending: Pending | None, state: State) -> Decision:
        """Once the word that a question was about is taught, what was asked for is done."""
        known, _ = self._teaching.words(taught.dialog)
        if pending is None or not pending.word or not known.meaning(singular(pending.word)):
            return taught
        fresh = msgspec.structs.replace(taught.dialog, pending=None)
        asked = State(state.scene, fresh, state.task, taught.reply, state.dialog.questions_asked)
        return self._whole(known.spelled_out(pending.text), asked)

    # --- dialogue acts ------------------------------------------------------------

    def _route(self, text: str, state: State) -> Decision | None:
        """Everything that is neither a command nor, with a question open, its answer."""
        kind = act.classify(text, self._lexicon)
        pending = state.dialog.pending
        if kind == "why":
            why = state.dialog.why or "there is nothing that I decided on"
            return self._say(state, f"Because {why}.", "the person asks for the reason")
        if kind == "cancel":
            open_ = " I drop my question." if pending is not None else ""
            return self._say(state, f"All right.{open_}", "the person cancelled", drop=True)
        off = called_off(text) if pending is not None else None
        if off is not None:
            fresh = msgspec.structs.replace(state.dialog, pending=None, questions_asked=0)
            rest = State(state.scene, fresh, state.task, state.echo)
            said = "the person called it off"
            return self._command(off, rest) if words(off) else self._say(rest, "All right.", said)
        if pending is not None:
            meant = read_answer(text, pending, state.scene, self._lexicon)
            if meant.kind != "other":
                return None
        if kind == "question":
            return self._question(text, state)
        if kind == "command" and text.rstrip().endswith("?"):
            known = SceneQuestions(state.scene, state.dialog.focus, self._lexicon).stated(text)
            if known is not None:
                return self._say(state, known, "a question about the scene")
        replies = {
            "greeting": ("Hello! What should I do?", "a greeting"),
            "thanks": ("You're welcome.", "thanks"),
            "help": (_HELP, "the person asks for help"),
            "chat": (_OFF_TOPIC, "not about the table"),
            "leave": ("All right, I won't.", "the person says what not to do"),
        }
        if kind == "undo":
            return self._back.undo(text, state)
        if kind in replies:
            reply, why = replies[kind]
            return self._say(state, reply, why)
        return None

    def _question(self, text: str, state: State) -> Decision:
        """A question about the scene, answered from it; anything else is declined."""
        found = SceneQuestions(state.scene, state.dialog.focus, self._lexicon).answer(text)
        if found is None:
            return self._say(state, _OFF_TOPIC, "a question that is not about the scene")
        linked = link(text, state.scene, state.dialog.focus, self._lexicon)
        new = msgspec.structs.replace(
            state.dialog, focus=focus.after(state.dialog.focus, linked)
        )  # fmt: skip
        return self._say(State(state.scene, new, state.task, state.echo), found,
                         "a question about the scene")  # fmt: skip

    def _say(self, state: State, reply: str, why: str, drop: bool = False) -> Decision:
        """Nothing moves; an open question stays open unless it is dropped."""
        dialog = state.dialog
        if drop:
            dialog = msgspec.structs.replace(dialog, pending=None, questions_asked=0)
        return Decision("answer", why, dialog, reply=f"{state.echo} {reply}".strip())

    # --- commands ------------------------------------------------------------

    def _command(self, text: str, state: State) -> Decision:
        text = without_asides_said(text, self._names(state))
        taken_back = (
            self._back.back_and_on(text, state)
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
            return self._say(state, "All right, I won't.", "the person says what must stay")
        linked = link_deed(core, state.scene, state.dialog.focus, self._lexicon)
        if again is None and is_talk(linked, self._lexicon):
            return self._say(state, _OFF_TOPIC, "nothing is to be done")
        return self._ladder.decide(again or core, state)

    # --- answers ------------------------------------------------------------

    def _answer(self, text: str, state: State, pending: Pending) -> Decision:
        """Go on from an open question."""
        meant = read_answer(text, pending, state.scene, self._lexicon)
        if meant.kind == "other" and (bare := without_lead(text)) != text:
            text, meant = bare, read_answer(bare, pending, state.scene, self._lexicon)
        asked = State(
            state.scene, state.dialog, state.task, state.echo, state.dialog.questions_asked
        )
        if meant.kind in ("pick", "any"):
            option = pending.question.options[meant.index]
            if option.label == LEAVE:
                return self._say(state, _LEFT, "nothing is to be done", drop=True)
            return self._learn(pending, option.label, self._pick(pending, option, asked))
        if meant.kind == "none":
            return self._say(state, _LEFT, "none of the options was wanted", drop=True)
        if meant.kind == "again":
            return self._repeat(pending, asked, strike=False)
        if meant.kind == "both":
            return self._all(pending, asked)
        if meant.kind == "thing":
            return self._learn(pending, f"the {meant.text}", self._continue(pending, meant, asked))
        if meant.kind == "words":
            return self._continue(pending, meant, asked)
        if meant.kind == "other" and self._is_command(text, state):
            dropped = "" if pending.question.kind == "open" else "I drop my question."
            echo = f"{state.echo} {dropped}".strip()
            fresh = msgspec.structs.replace(state.dialog, pending=None, questions_asked=0)
            return self._command(text, State(state.scene, fresh, state.task, echo))
        return self._repeat(pending, asked, strike=True)

    def _is_command(self, text: str, state: State) -> bool:
        """Whether a sentence that is no answer can be a new command."""
        linked = link(act.strip_courtesy(text), state.scene, state.dialog.focus, self._lexicon)
        verbs = [chunk for chunk in linked.chunks if chunk.kind == "verb"]
        return bool(verbs) or len(linked.spoken) > 1

    def _pick(self, pending: Pending, option: Option, state: State) -> Decision:
        """Run the picked option's program after checking it again on the live scene; an option
        without one completes the sentence instead."""
        if option.program is None or option.kind is None:
            whole = fill(pending, option, "", state.scene, state.dialog.focus, self._lexicon)
            return self._whole(whole, state)
        checked = self._planner.check(option.program, option.kind, state.scene, option.touched)
        if checked.problems:
            return refuse_problem(state, checked.problems[0], "the option may not run any more")
        placed = pending.question.kind in ("where", "direction") or not option.objects
        themes = option.touched[:1] if placed else option.objects
        said = fill(pending, option, "", state.scene, state.dialog.focus, self._lexicon)
        after = checked.after or state.scene
        dialog = msgspec.structs.replace(
            state.dialog, focus=focus.on(state.dialog.focus, themes, option.touched),
            pending=None, last_text=said, questions_asked=0,
            done=remembered(state.dialog.done, said, state.scene, after),
        )  # fmt: skip
        why = f"the person picked {option.label!r} and its program passed the check again"
        return Decision(
            "act", why, dialog, program=option.program, kind=option.kind,
            touched=option.touched, echo=state.echo,
        )  # fmt: skip

    def _learn(self, pending: Pending, meaning: str, decision: Decision) -> Decision:
        """Keep what the word stands for that was asked about, once it led to something done."""
        if not pending.word or decision.do != "act":
            return decision
        dialog, note = self._teaching.learn(decision.dialog, pending.word, meaning)
        echo = f"{decision.echo} {note}".strip()
        return msgspec.structs.replace(decision, echo=echo, dialog=dialog)

    def _all(self, pending: Pending, state: State) -> Decision:
        """ "both", "all of them": the command for every one of the options."""
        named = [option.label for option in pending.question.options if option.objects]
        if len(named) < 2:
            return self._repeat(pending, state, strike=False)
        whole = fill(pending, None, listing(named), state.scene, state.dialog.focus, self._lexicon)
        return self._whole(whole, state)

    def _continue(self, pending: Pending, meant: Answer, state: State) -> Decision:
        """Put the answer's words into the sentence and start again from the ladder's top."""
        whole = fill(pending, None, meant.text, state.scene, state.dialog.focus, self._lexicon)
        if whole == pending.text:
            return self._repeat(pending, state, strike=True)
        return self._whole(whole, state)

    def _whole(self, text: str, state: State) -> Decision:
        """The command that an answer completes; where it depends on something, its branch."""
        branch = self._branch((text,), state)
        if branch is not None and branch.text is None:
            return self._left(branch, state)
        if branch is not None and branch.text is not None:
            echo = f"{state.echo} {branch.note}".strip()
            state = State(state.scene, state.dialog, state.task, echo, state.questions)
            text = in_plain_turns(branch.text, self._lexicon)
        return self._ladder.decide(text, state)

    def _repeat(self, pending: Pending, state: State, strike: bool, lead: str = "") -> Decision:
        """Ask once more, options numbered; after two strikes stop politely."""
        strikes = pending.strikes + strike
        if strikes >= MAX_STRIKES:
            reply = "I still don't understand, so I leave it. Nothing moved."
            return refuse(state, "cancelled", reply, "two answers were not understood")
        lead = lead or ("Sorry, I did not understand." if strike else "")
        text = f"{lead} {numbered(pending.question.text, pending.question.options)}".strip()
        dialog = msgspec.structs.replace(
            state.dialog, pending=Pending(pending.text, pending.question, strikes)
        )
        why = "the answer fits no option" if strike else "the question is asked again"
        return Decision("ask", why, dialog, reply=text, question=pending.question)


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

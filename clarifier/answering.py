"""Goes on from an open question with what the person answered."""

from __future__ import annotations

import msgspec

from agent.messages import LEAVE, Decision, Option, Pending
from clarifier import act, focus
from clarifier.answer import read_answer
from clarifier.ask import numbered
from clarifier.asked import Answer
from clarifier.candidates import Planner
from clarifier.ladder import Ladder
from clarifier.lexicon import Lexicon
from clarifier.mentions import link
from clarifier.passing import without_lead
from clarifier.refusals import State, refuse, refuse_problem
from clarifier.replies import left, say
from clarifier.rewrite import fill
from clarifier.teaching import Teaching
from clarifier.turns import in_plain_turns
from clarifier.undo import remembered
from clarifier.worded import branch_of
from clarifier.words import listing

MAX_STRIKES = 2
"""Answers that are not understood; then the question is dropped."""

_LEFT = "All right, I leave it. Tell me what you would like instead."


class Answering:
    """Decides on answers. ``ladder`` decides on the command that an answer completes."""

    def __init__(
        self, planner: Planner, lexicon: Lexicon, teaching: Teaching, ladder: Ladder
    ) -> None:
        self._planner = planner
        self._lexicon = lexicon
        self._teaching = teaching
        self._ladder = ladder

    def decide(self, text: str, state: State, pending: Pending) -> Decision | str:
        """The decision on an answer; the text of a new command where it is one instead."""
        meant = read_answer(text, pending, state.scene, self._lexicon)
        if meant.kind == "other" and (bare := without_lead(text)) != text:
            text, meant = bare, read_answer(bare, pending, state.scene, self._lexicon)
        asked = State(
            state.scene, state.dialog, state.task, state.echo, state.dialog.questions_asked
        )
        if meant.kind in ("pick", "any"):
            option = pending.question.options[meant.index]
            if option.label == LEAVE:
                return say(state, _LEFT, "nothing is to be done", drop=True)
            return self._learn(pending, option.label, self._pick(pending, option, asked))
        if meant.kind == "none":
            return say(state, _LEFT, "none of the options was wanted", drop=True)
        if meant.kind == "again":
            return self._repeat(pending, asked, strike=False)
        if meant.kind == "both":
            return self._all(pending, asked)
        if meant.kind == "thing":
            return self._learn(pending, f"the {meant.text}", self._continue(pending, meant, asked))
        if meant.kind == "words":
            return self._continue(pending, meant, asked)
        if meant.kind == "other" and self._is_command(text, state):
            return text
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
            return self.whole(whole, state)
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
        return self.whole(whole, state)

    def _continue(self, pending: Pending, meant: Answer, state: State) -> Decision:
        """Put the answer's words into the sentence and start again from the ladder's top."""
        whole = fill(pending, None, meant.text, state.scene, state.dialog.focus, self._lexicon)
        if whole == pending.text:
            return self._repeat(pending, state, strike=True)
        return self.whole(whole, state)

    def whole(self, text: str, state: State) -> Decision:
        """The command that an answer completes; where it depends on something, its branch."""
        branch = branch_of((text,), state, self._lexicon)
        if branch is not None and branch.text is None:
            return left(branch, state)
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

"""The terminal application: a client of the bus with a face. No robot state lives here.

`run` is how the command line starts it. `tui.face` shows what arrives; here is what a person says
and presses. All that goes out leaves through the link, so the screen never waits for a service.
"""

from __future__ import annotations

import time
from collections.abc import Iterable
from functools import partial
from typing import ClassVar

from textual import on
from textual.app import SystemCommand
from textual.binding import Binding, BindingType
from textual.screen import Screen

from agent.client import Client, is_stop
from tui import steering
from tui.face import Face
from tui.link import Attend, Models
from tui.program import ProgramPanel
from tui.prompt import Prompt
from tui.question import QuestionView
from tui.screens import COMMANDS, PALETTE, VERBS, HelpScreen
from tui.talk import describe
from tui.transcript import Code

TWICE = 2.0
"""Seconds within which a second Ctrl+C quits."""


class ArmchatApp(Face):
    """The whole application; closing the client is the caller's."""

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("f8", "stop", "STOP", priority=True),
        Binding("ctrl+c", "interrupt", "interrupt", priority=True, show=False),
        Binding("f6", "step", "step", priority=True),
        Binding("f7", "pause", "pause", priority=True),
        Binding("f1", "help", "help"),
        Binding("f2", "map", "map"),
    ]

    def __init__(
        self, client: Client, *, theme: str | None = None, preview: bool | None = None,
        attend: Attend | None = None, models: Models | None = None,
    ) -> None:  # fmt: skip
        """See `Face`. ``attend``: what the translator looked at, ``models``: which there are, where
        it is in this process."""
        super().__init__(client, theme=theme, preview=preview)
        self._attend = attend
        self._models = models
        self._interrupted = float("-inf")

    # --- what the person says -------------------------------------------------------------------

    def on_empty_prompt(self, key: str) -> bool:
        """Keys for the question that is open, or for the program that is held."""
        return super().on_empty_prompt(key) or (key in ("enter", "escape") and self._steer(key))

    @on(QuestionView.Answered)
    def _picked(self, news: QuestionView.Answered) -> None:
        if news.text:
            self.say(news.text)
        self.prompt.focus()

    @on(QuestionView.Cancelled)
    def _cancelled(self, news: QuestionView.Cancelled) -> None:
        self.say("never mind")
        self.prompt.focus()

    @on(Prompt.Said)
    def _said(self, news: Prompt.Said) -> None:
        if news.text.startswith("/"):
            self._command(news.text)
        else:
            self.say(news.text)

    @on(Prompt.Paged)
    def _paged(self, news: Prompt.Paged) -> None:
        self.chat.scroll_relative(y=news.pages * max(self.chat.size.height - 1, 1), animate=False)

    def say(self, text: str) -> None:
        """Say a sentence, or keep it until the one before is answered. "stop" stops at once."""
        self.chat.person(text)
        if is_stop(text):
            self.action_stop(now="now" in text.lower() or "immediately" in text.lower())
        elif self.talk.busy:
            self.talk.waiting.append(text)
            held = self.mode == "held"
            self.chat.note(
                "said when the held program is over: Enter lets it go on, Esc gives it up"
                if held
                else "said when the sentence before is answered"
            )
        else:
            self._begin(text)

    def _command(self, text: str) -> None:
        word, _, rest = text.partition(" ")
        doing = {"/help": self.action_help, "/quit": self.action_leave, "/scene": self._describe,
                 "/copy": self.action_copy_program, "/program": self._whole_program}  # fmt: skip
        if word in VERBS:
            self.action_verb(VERBS[word])
        elif word == "/try" and rest.strip():
            self._try(text, rest.strip())
        elif word == "/preview":
            self.action_preview(rest.strip())
        elif word == "/model":
            self._model(rest.strip())
        elif word == "/attention":
            self._attention(rest.strip())
        elif word in doing:
            doing[word]()
        else:
            self.chat.note(f"no command {word}; there are {', '.join(COMMANDS)}", "warn")

    def _try(self, text: str, sentence: str) -> None:
        self.chat.person(text)
        if self.talk.busy:
            self.chat.note("not now: the sentence before is not answered yet", "warn")
        else:
            self._begin(sentence, dry_run=True)

    def _model(self, name: str) -> None:
        if self._models is None:
            self.chat.note("the translator is in another process: choose its model there", "warn")
        elif name:
            self.link.choose(self._models, name)
        else:
            self.chat.note(f"{self._models.model} translates; {COMMANDS['/model']}")

    def _attention(self, token: str) -> None:
        if self._attend is None:
            self.chat.note(
                "the translator is in another process: what it looks at is shown where it runs",
                "warn",
            )
        elif self.written:
            self.link.attend(self._attend, self.written, token)
        else:
            self.chat.note("the last sentence has no program")

    def _describe(self) -> None:
        self.chat.note(describe(self.seen.scene) if self.seen else "no scene seen yet")

    # --- keys -----------------------------------------------------------------------------------

    def action_stop(self, now: bool = False) -> None:
        """STOP: at once, on a thread of its own, whatever else is under way."""
        self._stop_sent = True
        self.link.stop(now)
        self.chat.note("STOP NOW" if now else "STOP", "bad")
        if (dropped := self.talk.drop()) > 0:
            self.chat.note(f"not said any more: {dropped} waiting", "warn")

    def action_verb(self, verb: str) -> None:
        """Send a verb to the robot: ``reset``, ``resume``, ``home``, ``acquire``, ..."""
        self.link.command(verb)

    def _steer(self, key: str) -> bool:
        """Do what a key means for the program; False if it means nothing now."""
        mode = self.mode
        verb = steering.verb(key, mode, self.talk.pausing)
        if verb is None:
            return False
        self.talk.pausing = mode == "runs" and verb != "resume"
        self._pills()
        self._hint()
        self.link.command(verb)
        return True

    def action_step(self) -> None:
        """F6: run a line of a program that is held; hold one that runs at the end of its line."""
        if not self._steer("f6"):
            self.chat.note("F6 steps a program: none runs or is held")

    def action_pause(self) -> None:
        """F7: hold a program that runs; let one that is held go on."""
        if not self._steer("f7"):
            self.chat.note("F7 pauses a program: none runs or is held")

    def action_cancel(self) -> None:
        """Give up a program that is held."""
        if not self._steer("escape"):
            self.chat.note("no program is held; F8 stops one that runs")

    def action_preview(self, word: str | None = None) -> None:
        """Hold programs before they run: ``on``, ``off``, "" says how it is; None: the other."""
        if word is None:
            word = "off" if self.preview.on else "on"
        self.chat.note(self.preview.command(word))
        self._hint()

    def action_interrupt(self) -> None:
        """Ctrl+C: STOP if anything moves, give up what is held, else copy or clear; twice quits."""
        again = time.monotonic() - self._interrupted < TWICE
        self._interrupted = time.monotonic()
        held = self.mode == "held"
        moving = not held and (
            self.talk.moving or (self.state is not None and self.state.program == "running")
        )
        chosen = self.prompt.selected_text or self.screen.get_selected_text()
        if moving:
            self.action_stop()
        if again:
            self.action_leave()
        elif chosen and not moving:
            self._copy(chosen, "selection")
        elif held:
            self._steer("escape")
        elif not moving:
            self.prompt.clear()
            self.notify("Ctrl+C again quits", timeout=TWICE, markup=False)

    def action_leave(self) -> None:
        """Quit."""
        self.exit(0)

    def action_help(self) -> None:
        """Keys and commands."""
        if not isinstance(self.screen, HelpScreen):
            self.push_screen(HelpScreen())

    def action_map(self) -> None:
        """Map and program on or off."""
        self.query_one("#body").toggle_class("-toggled")

    @on(ProgramPanel.Copied)
    def action_copy_program(self) -> None:
        """The program to the clipboard."""
        if self.panel.source:
            self._copy(self.panel.source, "program")
        else:
            self.chat.note("there is no program yet")

    @on(Code.Clicked)
    def _code_clicked(self, news: Code.Clicked) -> None:
        self._copy(news.source, "program")

    def _copy(self, text: str, what: str) -> None:
        self.copy_to_clipboard(text)
        self.notify(f"{what} copied", timeout=2, markup=False)

    def _whole_program(self) -> None:
        if self.panel.source:
            self.chat.program(self.panel.source, self.panel.kind, whole=True)
        else:
            self.chat.note("there is no program yet")

    def get_system_commands(self, screen: Screen[object]) -> Iterable[SystemCommand]:
        """What Ctrl+P offers."""
        for title, does, action in PALETTE:
            yield SystemCommand(title, does, partial(self.run_action, action))


def run(
    client: Client, *, theme: str | None = None, preview: bool | None = None, mouse: bool = True,
    attend: Attend | None = None, models: Models | None = None,
) -> int:  # fmt: skip
    """Run the terminal application until the person leaves; returns the exit status (0 is fine).

    Prints the conversation as plain text on standard output afterwards, and waits for a STOP
    that is not acknowledged yet. Closing the client and its bus is the caller's.
    """
    app = ArmchatApp(client, theme=theme, preview=preview, attend=attend, models=models)
    app.run(mouse=mouse)
    app.link.finish_stops()
    text = app.transcript()
    if text:
        print(text)
    return app.return_code or 0

"""The terminal application: a client of the bus with a face. No robot state lives here.

`run` is how the command line starts it. Everything that arrives comes as a message from `Link`;
everything that goes out leaves through it, so the screen never waits for a service.
"""

from __future__ import annotations

import time
from collections.abc import Iterable
from functools import partial
from typing import ClassVar

from textual import on
from textual.app import App, ComposeResult, SystemCommand
from textual.binding import Binding, BindingType
from textual.containers import Horizontal, Vertical
from textual.screen import Screen

from agent.client import Client, is_stop
from agent.messages import Event, RobotState, SceneSnapshot, Turn
from tui.header import Header, KeyBar
from tui.link import CommandOver, Link, News, SceneSeen, ServiceSeen, StateSeen, TurnEvent, TurnOver
from tui.map import MapPanel
from tui.program import ProgramPanel
from tui.prompt import Prompt
from tui.question import QuestionView
from tui.screens import COMMANDS, PALETTE, VERBS, HelpScreen
from tui.status import connection, missing_news, owner, program, safety, service_news
from tui.talk import Talk, answered, describe, safety_news, trouble
from tui.themes import THEMES, theme_name
from tui.transcript import Code, Transcript

TWICE = 2.0
"""Seconds within which a second Ctrl+C quits."""
PATIENCE = 3.0
"""Seconds after which services that have not come up are mentioned."""
HINTS = (("F1", "help"), ("F2", "map"), ("^P", "commands"))
"""Keys of the bottom line while nothing is asked."""


class ArmchatApp(App[int]):
    """Chat, map, program and questions over a `Client`; closing the client is the caller's."""

    CSS_PATH = "app.tcss"
    HORIZONTAL_BREAKPOINTS = [(0, "-narrow"), (72, "-normal"), (110, "-wide")]  # noqa: RUF012
    VERTICAL_BREAKPOINTS = [(0, "-low"), (32, "-tall")]  # noqa: RUF012
    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("f8", "stop", "STOP", priority=True),
        Binding("ctrl+c", "interrupt", "interrupt", priority=True, show=False),
        Binding("f1", "help", "help"),
        Binding("f2", "map", "map"),
    ]

    def __init__(self, client: Client, *, theme: str | None = None) -> None:
        """``theme`` names one of Textual's themes or ours. Raises ConfigError for another."""
        super().__init__()
        self.client = client
        self.link = Link(client, self)
        self.talk = Talk()
        self.services: set[str] = set()
        self.seen: SceneSnapshot | None = None
        self.state: RobotState | None = None
        self._state_at = float("-inf")
        self._settled = False
        self._stop_sent = False
        self._interrupted = float("-inf")
        self._question: QuestionView | None = None
        for known in THEMES:
            self.register_theme(known)
        self.theme = theme_name(theme, self.available_themes)

    def compose(self) -> ComposeResult:
        """Pills, conversation beside map and program, prompt, keys."""
        yield Header(id="header")
        with Horizontal(id="body"):
            yield Transcript(id="chat")
            with Vertical(id="side"):
                yield MapPanel(id="map-panel")
                yield ProgramPanel(id="program")
        yield Prompt(self._to_question, id="prompt")
        yield KeyBar(id="keys")

    def on_mount(self) -> None:
        """Connect to the bus."""
        self.header = self.query_one(Header)
        self.chat = self.query_one(Transcript)
        self.prompt = self.query_one(Prompt)
        self.map = self.query_one(MapPanel)
        self.panel = self.query_one("#program", ProgramPanel)
        self.panel.display = False
        self.prompt.focus()
        self._hint()
        self._pills()
        self.set_interval(1.0, self._pills)
        self.set_timer(PATIENCE, self._settle)
        self.link.open()

    def on_unmount(self) -> None:
        """Undeclare everything."""
        self.link.close()

    # --- what arrives ---------------------------------------------------------------------------

    @on(News)
    def _hear(self, news: News) -> None:
        if not self.chat.is_attached:
            return  # the screen is being taken down
        match news:
            case SceneSeen():
                self._scene_seen()
            case StateSeen():
                self._state_seen()
            case ServiceSeen():
                self._service_seen(news)
            case TurnEvent():
                self._turn_event(news.event)
            case TurnOver():
                self._turn_over(news)
            case CommandOver():
                self._command_over(news)

    def _scene_seen(self) -> None:
        self.seen = self.link.scene.take()
        if self.seen is not None:
            names = [item.name for item in self.seen.scene]
            self.prompt.words = [*names, *(text.split()[0] for text in COMMANDS)]
        self._picture()

    def _state_seen(self) -> None:
        before, self.state = self.state, self.link.state.take()
        self._state_at = time.monotonic()
        if self.state is not None and before is not None and before.safety != self.state.safety:
            self._safety_changed(self.state)
        self._pills()
        self._picture()

    def _safety_changed(self, state: RobotState) -> None:
        if state.safety == "normal":
            self._stop_sent = False
            self.chat.note("the robot is ready again")
        elif state.safety != "stopped" or not self._stop_sent:
            self.chat.note(safety_news(state), "bad")

    def _service_seen(self, news: ServiceSeen) -> None:
        kind = news.key.split("/")[0] + "/"
        (self.services.add if news.alive else self.services.discard)(news.key)
        others = [key for key in self.services if key.startswith(kind) and key != news.key]
        if self._settled or not news.alive:
            words = service_news(news.key, news.alive, others)
            self.chat.note(words, "info" if news.alive else "bad")
        self._pills()

    def _settle(self) -> None:
        self._settled = True
        missing = missing_news(self.services)
        if missing is not None:
            self.chat.note(missing, "warn")

    def _turn_event(self, event: Event) -> None:
        self.talk.hear(event)
        if event.stage == "program" and event.program is not None:
            self.panel.load(event.program, event.kind)
            self.chat.program(event.program, event.kind)
        elif event.step is not None:
            self.panel.step(event.step)
        elif event.turn is not None:
            self._turn(event.turn)
        self._pills()
        self._picture()

    def _turn(self, turn: Turn) -> None:
        if turn.program is not None and turn.status == "refused":
            self.panel.load(turn.program, turn.kind)
            self.chat.program(turn.program, turn.kind, run=False)
        if turn.program is not None:
            self.panel.end("checked" if turn.status == "answered" else turn.status)
        if turn.question is None:
            self.chat.reply(turn)
            return
        self._question = self.chat.question(turn.question)
        self._hint()

    def _turn_over(self, news: TurnOver) -> None:
        if news.error is not None:
            self.chat.note(trouble(news.error), "bad")
        following = self.talk.over(news.error)
        if following is not None:
            self._begin(following)
        elif (dropped := self.talk.drop()) > 0:
            self.chat.note(f"not said any more: {dropped} waiting", "warn")
        self._pills()

    def _command_over(self, news: CommandOver) -> None:
        bad = news.error is not None or (news.reply is not None and not news.reply.ok)
        self.chat.note(answered(news.verb, news.reply, news.error), "bad" if bad else "info")

    def transcript(self) -> str:
        """The whole conversation as plain text."""
        return self.chat.plain_text()

    # --- what is shown --------------------------------------------------------------------------

    def _pills(self) -> None:
        bridge = any(key.startswith("robot/") for key in self.services)
        age = time.monotonic() - self._state_at
        self.header.show(
            (
                connection(self.services),
                safety(self.state, bridge, age),
                program(self.talk.phase, self.state, self.talk.done, self.talk.count),
                owner(self.state, self.client.name),
            )
        )

    def _picture(self) -> None:
        self.map.show(
            self.map.picture._replace(
                scene=None if self.seen is None else self.seen.scene,
                tool=None if self.state is None else self.state.pose,
                plan=self.talk.plan,
                done=self.talk.done,
            )
        )

    def _hint(self) -> None:
        question = self._question
        bar = self.query_one(KeyBar)
        if question is None:
            bar.show(HINTS)
            self.prompt.placeholder = "Say what to do"
            return
        last = len(question.question.options)
        choose = (f"1-{last}", "choose") if last else ("Enter", "answer")
        bar.show((choose, ("Esc", "never mind"), *HINTS))
        self.prompt.placeholder = "Choose, or say it in your words"

    @on(QuestionView.Highlighted)
    def _look_at(self, news: QuestionView.Highlighted) -> None:
        option = news.option
        marked = frozenset(option.objects) if option is not None else frozenset()
        targets = (option.target,) if option is not None and option.target is not None else ()
        self.map.show(self.map.picture._replace(marked=marked, targets=targets))

    # --- what the person says -------------------------------------------------------------------

    def _to_question(self, key: str) -> bool:
        return self._question is not None and self._question.press(key)

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
            self.chat.note("said when the sentence before is answered")
        else:
            self._begin(text)

    def _begin(self, text: str, dry_run: bool = False) -> None:
        if self._question is not None:
            self._question.close(text)
            self._question = None
            self._hint()
        self.map.show(self.map.picture._replace(start=self.state.pose if self.state else None))
        self.talk.begin()
        self.link.say(text, dry_run)
        self._pills()
        self._picture()

    def _command(self, text: str) -> None:
        word, _, rest = text.partition(" ")
        doing = {"/help": self.action_help, "/quit": self.action_leave, "/scene": self._describe,
                 "/copy": self.action_copy_program, "/program": self._whole_program}  # fmt: skip
        if word in VERBS:
            self.action_verb(VERBS[word])
        elif word == "/try" and rest.strip():
            self._try(text, rest.strip())
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
        """Send ``reset``, ``resume``, ``home``, ``acquire`` or ``release`` to the robot."""
        self.link.command(verb)

    def action_interrupt(self) -> None:
        """Ctrl+C: STOP if anything moves, else copy or clear; twice quits."""
        again = time.monotonic() - self._interrupted < TWICE
        self._interrupted = time.monotonic()
        moving = self.talk.moving or (self.state is not None and self.state.program == "running")
        chosen = self.prompt.selected_text or self.screen.get_selected_text()
        if moving:
            self.action_stop()
        if again:
            self.action_leave()
        elif chosen and not moving:
            self._copy(chosen, "selection")
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


def run(client: Client, *, theme: str | None = None, mouse: bool = True) -> int:
    """Run the terminal application until the person leaves; returns the exit status (0 is fine).

    Prints the conversation as plain text on standard output afterwards, and waits for a STOP
    that is not acknowledged yet. Closing the client and its bus is the caller's.
    """
    app = ArmchatApp(client, theme=theme)
    app.run(mouse=mouse)
    app.link.finish_stops()
    text = app.transcript()
    if text:
        print(text)
    return app.return_code or 0

"""What the terminal shows, and how it follows what arrives: `tui.app` adds what a person does.

Everything that arrives comes as a message from `Link`, on the application's own thread.
"""

from __future__ import annotations

import time

from textual import on
from textual.app import App, ComposeResult
from textual.containers import Horizontal, Vertical

from agent.client import Client
from agent.messages import Event, RobotState, SceneSnapshot, Turn
from tui import steering
from tui.attention import chosen, rows
from tui.header import Header, KeyBar
from tui.link import (
    AttentionSeen,
    CommandOver,
    LimitsSeen,
    Link,
    ModelTold,
    News,
    SceneSeen,
    ServiceSeen,
    StateSeen,
    TurnEvent,
    TurnOver,
)
from tui.map import MapPanel
from tui.program import ProgramPanel
from tui.prompt import Prompt
from tui.question import QuestionView
from tui.screens import COMMANDS
from tui.status import (
    camera,
    connection,
    doubts,
    missing_news,
    owner,
    program,
    safety,
    service_news,
)
from tui.steering import Mode, Preview
from tui.talk import Talk, answered, safety_news, trouble
from tui.themes import THEMES, theme_name
from tui.transcript import Transcript

PATIENCE = 3.0
"""Seconds after which services that have not come up are mentioned."""
HINTS = (("F1", "help"), ("F2", "map"), ("^P", "commands"))
"""Keys of the bottom line in any case."""
SHOWN = frozenset({"pause", "step", "cancel"})
"""Verbs whose effect is plainly seen: only their refusal is worth words."""


class Face(App[int]):
    """Chat, map, program and questions over a `Client`."""

    CSS_PATH = "app.tcss"
    HORIZONTAL_BREAKPOINTS = [(0, "-narrow"), (72, "-normal"), (110, "-wide")]  # noqa: RUF012
    VERTICAL_BREAKPOINTS = [(0, "-low"), (32, "-tall")]  # noqa: RUF012

    def __init__(
        self, client: Client, *, theme: str | None = None, preview: bool | None = None
    ) -> None:
        """``theme`` names one of Textual's themes or ours. Raises ConfigError for another.

        ``preview``: hold every program before its first line; None: where the arm is real.
        """
        super().__init__()
        self.client = client
        self.link = Link(client, self)
        self.talk = Talk()
        self.preview = Preview(preview)
        self.services: set[str] = set()
        self.seen: SceneSnapshot | None = None
        self.state: RobotState | None = None
        self.written = ""
        """The program of the sentence that was said last."""
        self._state_at = self._seen_at = float("-inf")
        self._settled = False
        self._stop_sent = False
        self._question: QuestionView | None = None
        self._peeking = False
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
        yield Prompt(self.on_empty_prompt, id="prompt")
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

    def on_empty_prompt(self, key: str) -> bool:
        """A key while nothing is typed; False if it means nothing special."""
        return self._question is not None and self._question.press(key)

    @property
    def mode(self) -> Mode:
        """What program there is to steer."""
        return steering.mode(self.state, self.client.name, self.talk.moving)

    def transcript(self) -> str:
        """The whole conversation as plain text."""
        return self.chat.plain_text()

    # --- what arrives ---------------------------------------------------------------------------

    @on(News)
    def _hear(self, news: News) -> None:
        if not self.is_running:  # the screen is being taken down, widget by widget
            self.link.scene.missed()
            self.link.state.missed()
            return
        match news:
            case SceneSeen():
                self._scene_seen()
            case StateSeen():
                self._state_seen()
            case ServiceSeen():
                self._service_seen(news)
            case LimitsSeen():
                self.preview.limits = news.limits
                self._hint()
            case TurnEvent():
                self._turn_event(news.event)
            case TurnOver():
                self._turn_over(news)
            case CommandOver():
                self._command_over(news)
            case AttentionSeen():
                self._attention_seen(news)
            case ModelTold():
                self.chat.note(news.line, "bad" if news.bad else "info")

    def _scene_seen(self) -> None:
        self.seen = self.link.scene.take()
        self._seen_at = time.monotonic()
        if self.seen is not None and self.seen.camera:
            self._pills()
        if self.seen is not None:
            names = [item.name for item in self.seen.scene]
            self.prompt.words = [*names, *(text.split()[0] for text in COMMANDS)]
        self._picture()

    def _state_seen(self) -> None:
        before, self.state = self.state, self.link.state.take()
        self._state_at = time.monotonic()
        if self.state is not None and before is not None and before.safety != self.state.safety:
            self._safety_changed(self.state)
        self._follow()
        self._pills()
        self._picture()

    def _follow(self) -> None:
        """Mark the line that runs or comes next; the keys of the moment go with it."""
        state, mode = self.state, self.mode
        if state is not None and state.line and self.talk.moving and mode in ("runs", "held"):
            self.panel.mark(state.line, mode == "held")
        if mode != "runs":
            self.talk.pausing = False
        if mode == "held" and not self.talk.done:
            self._peek(True)
        self._hint()

    def _peek(self, on: bool) -> None:
        """On a narrow screen what is previewed takes the place of the conversation, once."""
        if on and not self._peeking and self.chat.screen.has_class("-narrow"):
            self.query_one("#body").add_class("-toggled")
        elif not on and self._peeking:
            self.query_one("#body").remove_class("-toggled")
        self._peeking = on

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
        if news.alive and kind == "robot/":
            self.link.look_up_limits()
        self._pills()

    def _settle(self) -> None:
        self._settled = True
        if not self.is_running:
            return
        missing = missing_news(self.services)
        if missing is not None:
            self.chat.note(missing, "warn")

    def _turn_event(self, event: Event) -> None:
        self.talk.hear(event)
        if event.stage == "program" and event.program is not None:
            self.written = event.program
            self.panel.load(event.program, event.kind)
            self.chat.program(event.program, event.kind)
        elif event.step is not None:
            self.panel.step(event.step)
        elif event.turn is not None:
            self._turn(event.turn)
        self._follow()
        self._pills()
        self._picture()

    def _turn(self, turn: Turn) -> None:
        self.written = turn.program or self.written
        if turn.program is not None and turn.status == "refused":
            self.panel.load(turn.program, turn.kind)
            self.chat.program(turn.program, turn.kind, run=False)
        if turn.program is not None:
            self.panel.end("checked" if turn.status == "answered" else self.talk.phase)
        if turn.question is None or turn.status == "failed":
            self.chat.reply(turn)
        if turn.question is None:
            return
        self._question = self.chat.question(turn.question)
        self._hint()

    def _turn_over(self, news: TurnOver) -> None:
        if news.error is not None:
            self.chat.note(trouble(news.error), "bad")
        self._peek(False)
        following = self.talk.over(news.error)
        if following is not None:
            self._begin(following)
        elif (dropped := self.talk.drop()) > 0:
            self.chat.note(f"not said any more: {dropped} waiting", "warn")
        self._pills()
        self._hint()

    def _command_over(self, news: CommandOver) -> None:
        bad = news.error is not None or (news.reply is not None and not news.reply.ok)
        going_on = news.verb == "resume" and self.talk.moving
        if bad or not (news.verb in SHOWN or going_on):
            words = answered(news.verb, news.reply, news.error)
            self.chat.note(words, "bad" if bad else "info")

    def _attention_seen(self, news: AttentionSeen) -> None:
        if news.attention is None:
            self.chat.note("this program was not written by the translator of this terminal")
        elif found := chosen(rows(news.attention), news.token):
            self.chat.attention(found)
        else:
            count = len(news.attention.tokens)
            self.chat.note(f"no token {news.token!r}: say a number, 1 to {count}, or a word of it")

    # --- a sentence goes out --------------------------------------------------------------------

    def _begin(self, text: str, dry_run: bool = False) -> None:
        if self._question is not None:
            self._question.close(text)
            self._question = None
            self._hint()
        self.map.show(self.map.picture._replace(start=self.state.pose if self.state else None))
        self.talk.begin()
        self.written = ""
        self.link.say(text, dry_run, hold=self.preview.on and not dry_run)
        self._pills()
        self._picture()

    # --- what is shown --------------------------------------------------------------------------

    def _pills(self) -> None:
        bridge = any(key.startswith("robot/") for key in self.services)
        now, talk = time.monotonic(), self.talk
        pills = (
            connection(self.services),
            safety(self.state, bridge, now - self._state_at),
            program(talk.phase, self.state, talk.done, talk.count, talk.pausing),
            owner(self.state, self.client.name),
            camera(self.seen, now - self._seen_at),
        )
        self.header.show([pill for pill in pills if pill is not None])

    def _picture(self) -> None:
        unsure, unseen = ((), ()) if self.seen is None else doubts(self.seen)
        self.map.show(
            self.map.picture._replace(
                unsure=unsure,
                unseen=unseen,
                scene=None if self.seen is None else self.seen.scene,
                tool=None if self.state is None else self.state.pose,
                plan=self.talk.plan,
                done=self.talk.done,
                ahead=self.talk.moving and self.mode in ("runs", "held"),
            )
        )

    def _hint(self) -> None:
        """Show what keys and prompt mean at this moment."""
        bar, question, mode = self.query_one(KeyBar), self._question, self.mode
        if question is None:
            begun = self.talk.done > 0
            bar.show((*steering.hints(mode, begun, self.talk.pausing), *HINTS))
            self.prompt.placeholder = steering.invitation(mode, begun, self.preview.on)
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

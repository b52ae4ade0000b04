"""The only place where bus threads meet the terminal: they post messages, never touch widgets.

Scenes and states come faster than a screen: of each only the newest waits to be taken. What blocks
runs on a daemon thread of its own. Verbs wait for the one before, or a pause that was taken back
could arrive last; STOP never queues behind another.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from contextlib import suppress
from typing import Generic, Protocol, TypeVar

from textual.message import Message
from textual.message_pump import MessagePump

from agent.bus import Closing
from agent.client import Client
from agent.errors import ArmchatError
from agent.messages import Attention, Event, RobotLimits, RobotReply, RobotState, SceneSnapshot

T = TypeVar("T")


class News(Message):
    """Anything that a bus thread tells the application."""


class SceneSeen(News):
    """A new scene waits in `Link.scene`."""


class StateSeen(News):
    """A new robot state waits in `Link.state`."""


class ServiceSeen(News):
    """A service came (``alive``) or went; ``key`` is "robot/r1"."""

    def __init__(self, key: str, alive: bool) -> None:
        super().__init__()
        self.key = key
        self.alive = alive


class LimitsSeen(News):
    """What the robot may do, and whether it is simulated."""

    def __init__(self, limits: RobotLimits) -> None:
        super().__init__()
        self.limits = limits


class TurnEvent(News):
    """An event of the sentence that was said last."""

    def __init__(self, event: Event) -> None:
        super().__init__()
        self.event = event


class TurnOver(News):
    """The turn ended: with ``error``, or None when its events said it all."""

    def __init__(self, error: ArmchatError | None) -> None:
        super().__init__()
        self.error = error


class CommandOver(News):
    """A verb for the robot (stop, reset, ...) was answered, or failed with ``error``."""

    def __init__(self, verb: str, reply: RobotReply | None, error: ArmchatError | None) -> None:
        super().__init__()
        self.verb = verb
        self.reply = reply
        self.error = error


class AttentionSeen(News):
    """What the translator looked at for a program; None: it was not translated here."""

    def __init__(self, attention: Attention | None, token: str) -> None:
        super().__init__()
        self.attention = attention
        self.token = token


Attend = Callable[[str], Attention | None]
"""What this process's translator looked at as it wrote a program; None if it did not write it."""


class ModelTold(News):
    """How far another translator's loading is; ``bad``: it cannot."""

    def __init__(self, line: str, bad: bool = False) -> None:
        super().__init__()
        self.line = line
        self.bad = bad


class Models(Protocol):
    """The translators of this process (`agent.speaking.Speakers`)."""

    model: str

    def choose(self, model: str, say: Callable[[str], None]) -> None:
        """Load a model and speak with it. Raises TranslatorError."""
        ...


class Newest(Generic[T]):
    """The newest value of a stream; `put` says whether nobody has been told of it yet."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._value: T | None = None
        self._told = False

    def put(self, value: T) -> bool:
        """Keep the value; True if the reader must be told, False if that is under way."""
        with self._lock:
            self._value = value
            tell, self._told = not self._told, True
        return tell

    def missed(self) -> None:
        """The reader was told when it could not read: it must be told of the next value."""
        with self._lock:
            self._told = False

    def take(self) -> T | None:
        """The newest value, None before the first."""
        with self._lock:
            self._told = False
            return self._value


class Link:
    """A client of the bus on one side, a Textual message pump on the other."""

    def __init__(self, client: Client, target: MessagePump) -> None:
        self.client = client
        self.scene: Newest[SceneSnapshot] = Newest()
        self.state: Newest[RobotState] = Newest()
        self._target = target
        self._closings: list[Closing] = []
        self._stops: list[threading.Thread] = []
        self._sending: threading.Thread | None = None

    def open(self) -> None:
        """Subscribe. Call on the UI thread when the target runs."""
        self._closings = [
            self.client.on_services(self._service),
            self.client.on_scene(lambda seen: self._newest(self.scene, seen, SceneSeen)),
            self.client.on_state(lambda seen: self._newest(self.state, seen, StateSeen)),
        ]

    def close(self) -> None:
        """Undeclare everything; what still arrives is dropped."""
        while self._closings:
            self._closings.pop().close()

    def look_up_limits(self) -> None:
        """Ask the bridge for its robot's limits; they come as `LimitsSeen`, or not at all."""
        self._start("limits", self._limits)

    def _limits(self) -> None:
        with suppress(ArmchatError):
            self._post(LimitsSeen(self.client.limits()))

    def say(self, text: str, dry_run: bool = False, hold: bool = False) -> None:
        """Say a sentence; its events come as `TurnEvent`, its end as `TurnOver`."""
        self._start("turn", lambda: self._turn(text, dry_run, hold))

    def _turn(self, text: str, dry_run: bool, hold: bool) -> None:
        error: ArmchatError | None = None
        try:
            for event in self.client.say(text, dry_run=dry_run, hold=hold):
                self._post(TurnEvent(event))
        except ArmchatError as caught:
            error = caught
        self._post(TurnOver(error))

    def attend(self, attend: Attend, program: str, token: str) -> None:
        """Ask what was looked at for a program; it comes as `AttentionSeen`."""
        self._start("attention", lambda: self._attended(attend, program, token))

    def _attended(self, attend: Attend, program: str, token: str) -> None:
        found: Attention | None = None
        with suppress(ArmchatError):
            found = attend(program)
        self._post(AttentionSeen(found, token))

    def choose(self, models: Models, model: str) -> None:
        """Let another model translate; what comes of it comes as `ModelTold`."""
        self._start("model", lambda: self._chosen(models, model))

    def _chosen(self, models: Models, model: str) -> None:
        try:
            models.choose(model, self._model_told)
            self._post(ModelTold(f"from the next sentence on {model} translates"))
        except ArmchatError as error:
            self._post(ModelTold(f"{error}; {models.model} goes on translating", bad=True))

    def _model_told(self, line: str) -> None:
        self._post(ModelTold(line))

    def stop(self, now: bool = False) -> None:
        """STOP on a thread of its own, whatever else is under way."""
        verb = "stop now" if now else "stop"
        self._stops = [thread for thread in self._stops if thread.is_alive()]
        work = self._start("stop", lambda: self._verb(verb, lambda: self.client.stop(now)))
        self._stops.append(work)

    def finish_stops(self, timeout: float = 5.0) -> None:
        """Wait (seconds) for STOPs that are not acknowledged yet; before the process ends."""
        for thread in self._stops:
            thread.join(timeout)

    def command(self, verb: str) -> None:
        """Send ``reset``, ``resume``, ``pause``, ``step``, ``cancel``, ``home``, ``acquire`` ...

        Each is sent when the one before is answered; but none waits for the end of a motion,
        which is when ``home`` is answered.
        """
        if verb == "home":
            self._start(verb, lambda: self._verb(verb, self.client.home))
            return
        before = self._sending

        def in_order() -> None:
            if before is not None:
                before.join()
            self._verb(verb, getattr(self.client, verb))

        self._sending = self._start(verb, in_order)

    def _verb(self, verb: str, send: Callable[[], RobotReply | None]) -> None:
        try:
            self._post(CommandOver(verb, send(), None))
        except ArmchatError as error:
            self._post(CommandOver(verb, None, error))

    def _service(self, key: str, alive: bool) -> None:
        self._post(ServiceSeen(key, alive))

    def _newest(self, slot: Newest[T], value: T, news: type[News]) -> None:
        if slot.put(value) and not self._post(news()):
            slot.missed()

    def _start(self, name: str, work: Callable[[], None]) -> threading.Thread:
        thread = threading.Thread(target=work, name=f"tui {name}", daemon=True)
        thread.start()
        return thread

    def _post(self, message: News) -> bool:
        """Whether the message reached the pump."""
        try:
            return self._target.post_message(message)
        except RuntimeError:  # the event loop has ended: nobody is left to be told
            return False

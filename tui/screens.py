"""The help screen (F1). F8 stops the arm here as everywhere."""

from __future__ import annotations

import textwrap
from typing import ClassVar

from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import VerticalScroll
from textual.content import Content
from textual.screen import ModalScreen
from textual.widgets import Static

KEYS = (
    ("F8", "STOP: slow down, hold, keep the grip. Latched until reset. Also: type stop"),
    ("F1", "this help"),
    ("F2", "map on and off"),
    ("F6", "step: run one line of a held program; hold a running one after its line"),
    ("F7", "pause the program after the motion under way; go on"),
    ("Enter", "say it; Ctrl+J starts another line"),
    ("1 2 3 ...", "choose, when armchat asks and the prompt is empty; 0: something else"),
    ("↑ ↓ Enter", "choose with arrows; without a question: earlier sentences"),
    ("Enter Esc", "run a program that is held, or give it up (with an empty prompt)"),
    ("Esc", "never mind (when armchat asks); clear the prompt"),
    ("Tab →", "complete a name; Tab in an empty prompt: to the program, y copies it"),
    ("PgUp PgDn", "scroll the conversation"),
    ("Ctrl+C", "STOP if the arm moves, else copy the selection or clear; twice quits"),
    ("Ctrl+P", "all commands"),
)
COMMANDS = {
    "/help": "this help",
    "/scene": "what is on the table, in words",
    "/program": "the whole program once more",
    "/attention": "the words that the translator looked at for each token of the program; "
    "/attention 3, /attention left_of: for one",
    "/model": "which model translates; /model seq2seq (armchat's own), pretrained, cascade: that",
    "/copy": "the program to the clipboard",
    "/try TEXT": "check a sentence and show the path, move nothing",
    "/preview": "on: a program is shown and held until you run or step it; off: it runs at once",
    "/step": "F6, /pause: F7, /cancel: Esc, where a terminal keeps those keys to itself",
    "/reset": "clear a STOP or an alarm; never moves the arm",
    "/resume": "allow motion again after a reset",
    "/home": "go to the parking pose",
    "/take": "hold the arm",
    "/release": "give the arm back",
    "/quit": "leave; the conversation is printed",
}
VERBS = {
    "/take": "acquire", "/release": "release", "/reset": "reset", "/resume": "resume",
    "/home": "home", "/step": "step", "/pause": "pause", "/cancel": "cancel",
}  # fmt: skip
"""Typed commands that are verbs for the robot."""
PALETTE = (
    ("STOP", "Slow down, hold, keep the grip (F8)", "stop"),
    ("STOP NOW", "Force-stop, flush the queue", "stop(True)"),
    ("Step", "Run one line of the program, then hold (F6)", "step"),
    ("Pause", "Hold the program after the motion under way, or let it go on (F7)", "pause"),
    ("Cancel program", "Give up a program that is held; nothing is latched (Esc)", "cancel"),
    ("Preview", "Show and hold programs before they run: on or off", "preview"),
    ("Reset", "Clear a STOP or an alarm; never moves the arm", "verb('reset')"),
    ("Resume", "Allow motion again after a reset", "verb('resume')"),
    ("Home", "Go to the parking pose", "verb('home')"),
    ("Copy program", "The program to the clipboard", "copy_program"),
    ("Map", "Map and program on or off (F2)", "map"),
    ("Help", "Keys and commands (F1)", "help"),
    ("Theme", "Change the colours", "change_theme"),
    ("Quit", "Leave; the conversation is printed", "leave"),
)
"""What Ctrl+P offers: title, what it does, action."""
SAFETY = (
    "STOP is a convenience, not an emergency stop: keep the power switch in reach. "
    "Opening the gripper may drop what it holds."
)


class HelpScreen(ModalScreen[None]):
    """Keys and commands; any of Esc, F1, Enter, q closes it."""

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("escape,f1,enter,q", "dismiss", "close"),
    ]

    def compose(self) -> ComposeResult:
        """One page that scrolls on low screens."""
        with VerticalScroll(id="help"):
            yield Static(_help(), id="help-text")


def _help() -> Content:
    keys = [_row(key, does) for key, does in KEYS]
    commands = [_row(command, does) for command, does in COMMANDS.items()]
    headings = [Content.styled(title, "bold $primary") for title in ("Keys", "Commands")]
    safety = Content.styled(SAFETY, "$text-warning")
    rows = [headings[0], *keys, Content(""), headings[1], *commands, Content(""), safety]
    return Content("\n").join(rows)


def _row(what: str, does: str) -> Content:
    first, *rest = textwrap.wrap(does, 56)
    below = "".join(f"\n{'':12}{line}" for line in rest)
    return Content.styled(f"{what:<12}", "bold") + Content(first + below)

"""The conversation on screen and as plain text: sentences, replies, programs, questions, notes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from textual.containers import VerticalScroll
from textual.content import Content
from textual.message import Message
from textual.widget import Widget
from textual.widgets import Static

from agent.messages import Kind, Question, Status, Turn
from tui.attention import Row, shaded, told
from tui.plain import plain
from tui.program import code_lines
from tui.question import QuestionView

Tone = Literal["info", "warn", "bad"]

SIGNS: dict[Status, str] = {"done": "✓ ", "refused": "✕ ", "failed": "! "}
BRIEF = 4
"""Lines of a program that a transcript shows on a low screen; the panel has them all."""
KEPT = 400
"""Entries that stay on screen; the plain transcript keeps all."""


class Transcript(VerticalScroll, can_focus=False):
    """Entries from old to new; stays at the end unless the person scrolled up."""

    def __init__(self, *, id: str | None = None) -> None:
        super().__init__(id=id)
        self._record: list[tuple[str, str]] = []

    def on_mount(self) -> None:
        """Follow the end."""
        self.anchor()

    def person(self, text: str) -> None:
        """What the person said."""
        self._add("you", text, Static(Content(plain(text)), classes="person"))

    def reply(self, turn: Turn) -> None:
        """armchat's words at the end of a turn; a question that ends them is shown by itself."""
        asked = "" if turn.question is None else f" {turn.question.text}"
        said = turn.reply.removesuffix(asked)
        words = f"{SIGNS.get(turn.status, '')}{plain(said)}"
        self._add("armchat", said, Static(Content(words), classes=f"reply -{turn.status}"))

    def note(self, text: str, tone: Tone = "info") -> None:
        """Something about the services, the robot or this terminal."""
        self._add("--", text, Static(Content(plain(text)), classes=f"note -{tone}"))

    def program(
        self, source: str, kind: Kind | None, run: bool = True, whole: bool = False
    ) -> None:
        """A program, highlighted; ``run`` false: it was rejected."""
        brief = 10_000 if whole or self.app.size.height >= 32 else BRIEF
        self._add("program", source, Code(source, kind, run, brief))

    def attention(self, found: Sequence[Row]) -> None:
        """What the translator looked at, for some tokens of a program."""
        self._add("looked", told(found), Static(shaded(found), classes="code"))

    def question(self, question: Question) -> QuestionView:
        """A question to be answered."""
        view = QuestionView(question)
        choices = [f"{n} {option.label}" for n, option in enumerate(question.options, 1)]
        self._add("armchat", "\n".join([question.text, *choices]), view)
        return view

    def _add(self, who: str, text: str, entry: Widget) -> None:
        self._record.append((who, plain(text)))
        self.mount(entry)
        if len(self.children) > KEPT:
            self.children[0].remove()

    def plain_text(self) -> str:
        """The whole conversation, one speaker a paragraph, fit for any terminal."""
        blocks = []
        for who, text in self._record:
            first, *rest = text.split("\n")
            blocks.append("\n".join([f"{who:>7}  {first}", *(f"{'':9}{line}" for line in rest)]))
        return "\n".join(blocks)


class Code(Static):
    """A program in the transcript; a click copies it."""

    class Clicked(Message):
        """The person wants this program on the clipboard."""

        def __init__(self, source: str) -> None:
            super().__init__()
            self.source = source

    def __init__(self, source: str, kind: Kind | None, run: bool, brief: int) -> None:
        lines = code_lines(source)
        shown = lines if len(lines) <= brief else lines[: brief - 1]
        text = Content("\n").join(shown)
        if len(shown) < len(lines):
            text += Content.styled(f"\n… {len(lines) - len(shown)} more lines", "$foreground-muted")
        if not run:
            text = Content.styled("not run\n", "$error") + text
        super().__init__(text, classes="code")
        self.source = source
        self.tooltip = "click to copy"

    def on_click(self) -> None:
        """Copy it."""
        self.post_message(self.Clicked(self.source))

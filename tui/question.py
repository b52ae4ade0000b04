"""A question in the transcript, with its numbered choices.

Digits, arrows with Enter and clicks choose; whatever is typed is a free answer; Esc is "never
mind". Highlighting a choice tells the map what it is about. Once answered it stays, dimmed.
"""

from __future__ import annotations

from textual import events
from textual.app import ComposeResult
from textual.containers import Vertical
from textual.content import Content
from textual.message import Message
from textual.widgets import Static

from agent.messages import Option, Question
from tui.plain import one_line, plain

ELSE = "something else"


class QuestionView(Vertical, can_focus=True):
    """One question. ``answered`` is None while it is open."""

    class Answered(Message):
        """A choice was made; ``text`` is what to say, "" to type a free answer."""

        def __init__(self, view: QuestionView, text: str) -> None:
            super().__init__()
            self.view = view
            self.text = text

    class Cancelled(Message):
        """The person does not mind any more."""

        def __init__(self, view: QuestionView) -> None:
            super().__init__()
            self.view = view

    class Highlighted(Message):
        """A choice is looked at (None: no longer)."""

        def __init__(self, option: Option | None) -> None:
            super().__init__()
            self.option = option

    def __init__(self, question: Question) -> None:
        super().__init__(classes="question")
        self.question = question
        self.answered: str | None = None
        self.at = -1

    def compose(self) -> ComposeResult:
        """The question, then its choices."""
        yield Static(Content(plain(self.question.text)), classes="question-text")
        for number, option in enumerate(self.question.options, 1):
            yield Choice(number, one_line(option.label))
        if self.question.options:
            yield Choice(0, ELSE)
        yield Static("", classes="question-free")

    @property
    def numbers(self) -> list[int]:
        """The digits that choose, in the order of the rows."""
        count = len(self.question.options)
        return [*range(1, count + 1), 0] if count else []

    def press(self, key: str) -> bool:
        """Act on a key; False if it means nothing to a question."""
        if self.answered is not None:
            return False
        if key == "escape":
            self.post_message(self.Cancelled(self))
        elif key.isdecimal() and len(key) == 1 and int(key) in self.numbers:
            self.choose(int(key))
        elif key in ("up", "down") and self.numbers:
            step = 1 if key == "down" else -1 if self.at >= 0 else 0
            self.highlight((self.at + step) % len(self.numbers))
        elif key == "enter" and self.at >= 0:
            self.choose(self.numbers[self.at])
        else:
            return False
        return True

    def choose(self, number: int) -> None:
        """Pick a choice by its digit."""
        if self.answered is not None or number not in self.numbers:
            return
        label = self.question.options[number - 1].label if number else ""
        self.post_message(self.Answered(self, label))

    def highlight(self, row: int) -> None:
        """Look at a row (-1: at none)."""
        if self.answered is not None or row == self.at:
            return
        self.at = row
        for index, choice in enumerate(self.query(Choice)):
            choice.set_class(index == row, "-at")
        inside = 0 <= row < len(self.question.options)
        self.post_message(self.Highlighted(self.question.options[row] if inside else None))

    def close(self, answer: str) -> None:
        """Dim the question; underline the choice that was taken, or show the free answer."""
        if self.answered is not None:
            return
        self.highlight(-1)
        self.answered = answer
        self.add_class("-answered")
        self.can_focus = False
        labels = [option.label for option in self.question.options]
        for index, choice in enumerate(self.query(Choice)):
            choice.set_class(index < len(labels) and labels[index] == answer, "-taken")
        if answer not in labels:
            self.query_one(".question-free", Static).update(Content(f"→ {plain(answer)}"))
            self.add_class("-free")

    def on_key(self, event: events.Key) -> None:
        """Keys while the question itself has the focus."""
        if self.press(event.key):
            event.stop()
            event.prevent_default()


class Choice(Static):
    """One row of a question."""

    def __init__(self, number: int, label: str) -> None:
        text = Content.styled(f" {number} ", "bold $warning") + Content(f" {label}")
        super().__init__(text, classes="choice")
        self.number = number
        if number == 0:
            self.add_class("-else")

    @property
    def _question(self) -> QuestionView:
        parent = self.parent
        assert isinstance(parent, QuestionView)
        return parent

    def on_click(self) -> None:
        """Choose this row."""
        self._question.choose(self.number)

    def on_enter(self) -> None:
        """Look at this row."""
        self._question.highlight(self._question.numbers.index(self.number))

    def on_leave(self) -> None:
        """No longer."""
        self._question.highlight(-1)

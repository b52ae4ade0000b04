"""The prompt: grows with what is typed, remembers, completes names; Enter says it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import ClassVar

from textual import events
from textual.binding import Binding, BindingType
from textual.message import Message
from textual.widgets import TextArea

LEAST = 2
"""Letters of a name before it is completed."""


class Prompt(TextArea):
    """A text area of one to six lines. ``on_empty`` takes keys while the prompt is empty."""

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("pageup", "page(-1)", show=False),
        Binding("pagedown", "page(1)", show=False),
        Binding("ctrl+home", "page(-99)", show=False),
        Binding("ctrl+end", "page(99)", show=False),
    ]

    class Said(Message):
        """The person pressed Enter."""

        def __init__(self, text: str) -> None:
            super().__init__()
            self.text = text

    class Paged(Message):
        """The person wants to see earlier (negative) or later lines of the transcript."""

        def __init__(self, pages: int) -> None:
            super().__init__()
            self.pages = pages

    def __init__(self, on_empty: Callable[[str], bool], *, id: str | None = None) -> None:
        super().__init__(
            id=id, compact=True, highlight_cursor_line=False, show_line_numbers=False,
            placeholder="Say what to do",
        )  # fmt: skip
        self.words: Sequence[str] = ()
        self.cursor_blink = False
        self._on_empty = on_empty
        self._history: list[str] = []
        self._past = 0

    async def _on_key(self, event: events.Key) -> None:
        if self._taken(event.key):
            event.stop()
            event.prevent_default()
            return
        await super()._on_key(event)

    def _taken(self, key: str) -> bool:
        if not self.text and self._on_empty(key):
            return True
        if key == "enter":
            self._say()
        elif key in ("ctrl+j", "shift+enter", "alt+enter"):
            self.insert("\n")
        elif key == "tab" and self.suggestion:
            self.insert(self.suggestion)
        elif key == "escape" and self.text:
            self.clear()
        else:
            return False
        return True

    def _say(self) -> None:
        text = self.text.strip()
        if not text:
            return
        if not self._history or self._history[-1] != text:
            self._history.append(text)
        self._past = len(self._history)
        self.clear()
        self.post_message(self.Said(text))

    def action_cursor_up(self, select: bool = False) -> None:
        """Move up; on the first line, go to the sentence before."""
        if not select and self.cursor_location[0] == 0 and self._past > 0:
            self._recall(self._past - 1)
        else:
            super().action_cursor_up(select)

    def action_cursor_down(self, select: bool = False) -> None:
        """Move down; on the last line, go to the sentence after."""
        last = self.document.line_count - 1
        if not select and self.cursor_location[0] == last and self._past < len(self._history):
            self._recall(self._past + 1)
        else:
            super().action_cursor_down(select)

    def _recall(self, index: int) -> None:
        self._past = index
        self.text = self._history[index] if index < len(self._history) else ""
        self.move_cursor(self.document.end)

    def action_page(self, pages: int) -> None:
        """Scroll the transcript."""
        self.post_message(self.Paged(pages))

    def update_suggestion(self) -> None:
        """Complete the last word by a name on the table or a command."""
        self.suggestion = completion(self.text, self.words) if self._at_end() else ""

    def _at_end(self) -> bool:
        return self.cursor_location == self.document.end


def completion(text: str, words: Sequence[str]) -> str:
    """What is missing of the shortest word that the text's end begins; "" if none."""
    for start in range(len(text)):
        tail = text[start:].lower()
        if (start and text[start - 1].isalnum()) or len(tail) < LEAST or not tail.strip():
            continue
        fits = [word for word in words if word.lower().startswith(tail) and len(word) > len(tail)]
        if fits:
            return min(fits, key=len)[len(tail) :]
    return ""

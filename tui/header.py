"""The top line (pills) and the bottom line (this context's keys, STOP)."""

from __future__ import annotations

from collections.abc import Sequence

from textual.app import ComposeResult
from textual.containers import Horizontal
from textual.content import Content
from textual.widgets import Static

from tui.plain import one_line, shorten
from tui.status import Pill, Tone

LOOKS: dict[Tone, str] = {
    "good": "$text-success on $success-muted",
    "calm": "$foreground-muted on $panel",
    "busy": "$text-primary on $primary-muted",
    "warn": "bold $text-warning on $warning-muted",
    "bad": "bold $text-error on $error-muted",
}


class Header(Static):
    """The product's name and the pills."""

    def __init__(self, *, id: str | None = None) -> None:
        super().__init__(id=id)
        self.pills: tuple[Pill, ...] = ()

    def show(self, pills: Sequence[Pill]) -> None:
        """Show other pills; equal ones cost nothing."""
        if tuple(pills) == self.pills:
            return
        self.pills = tuple(pills)
        text = Content.styled("armchat", "bold $primary")
        for pill in self.pills:
            label = shorten(one_line(pill.text), 20)
            text += Content(" ") + Content.styled(f" {label} ", LOOKS[pill.tone])
        self.update(text)


class StopButton(Static):
    """STOP for the mouse."""

    async def on_click(self) -> None:
        """STOP."""
        await self.run_action("app.stop")


class KeyBar(Horizontal):
    """The keys that matter now, and STOP."""

    def __init__(self, *, id: str | None = None) -> None:
        super().__init__(id=id)
        self.hints: tuple[tuple[str, str], ...] = ()

    def compose(self) -> ComposeResult:
        """Hints on the left, STOP on the right."""
        yield Static(id="hints")
        yield StopButton(Content(" F8 STOP "), id="stop")

    def show(self, hints: Sequence[tuple[str, str]]) -> None:
        """Show other keys: (key, what it does); equal ones cost nothing."""
        if tuple(hints) == self.hints:
            return
        self.hints = tuple(hints)
        text = Content("")
        for key, does in hints:
            text += Content.styled(f" {key} ", "bold $primary") + Content.styled(
                f"{does} ", "$foreground-muted"
            )
        self.query_one("#hints", Static).update(text)

"""The program panel: the whole program, numbered, with the line that runs marked."""

from __future__ import annotations

from typing import ClassVar

from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import ScrollableContainer, Vertical
from textual.content import Content
from textual.highlight import highlight
from textual.message import Message
from textual.widgets import Static

from agent.messages import Kind, StepReport
from tui.plain import plain

MARK, HELD = "▶", "▷"
"""Beside the line that runs; beside the one that comes next while the program is held."""


def code_lines(source: str) -> list[Content]:
    """The program's lines, coloured as Python; nothing in it is markup."""
    return list(highlight(plain(source), language="python").split("\n"))


def numbered(source: str, running: int, held: bool = False, ended: bool = False) -> Content:
    """The program with line numbers; ``running`` (from 1, 0: none) is marked, or is held before."""
    lines = code_lines(source)
    width = len(str(len(lines)))
    rows = []
    for number, line in enumerate(lines, 1):
        here = number == running
        gutter = f"{(HELD if held else MARK) if here else ' '}{number:>{width}} "
        row = Content.styled(gutter, "$warning bold" if here else "$foreground-disabled") + line
        rows.append(row.stylize("bold on $warning 20%") if here and not ended else row)
    return Content("\n").join(rows)


class ProgramPanel(Vertical):
    """Shows the program of the sentence at hand; hidden while there is none."""

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("y", "copy_program", "copy"),
        Binding("escape", "leave", "back"),
    ]

    class Copied(Message):
        """The person wants the program on the clipboard."""

    def __init__(self, *, id: str | None = None) -> None:
        super().__init__(id=id)
        self.source = ""
        self.kind: Kind | None = None
        self.running = 0
        self.held = False
        self._steps = ""

    def compose(self) -> ComposeResult:
        """Heading and code."""
        yield Static(id="program-title", classes="heading")
        with ScrollableContainer(id="program-scroll"):
            yield Static(id="program-code")

    def load(self, source: str, kind: Kind | None) -> None:
        """Show another program, nothing marked."""
        self.source, self.kind, self.running, self._steps = source, kind, 0, "checked"
        self.held = False
        self.display = True
        self._refresh()
        self.query_one("#program-scroll").scroll_home(animate=False)

    def mark(self, line: int, held: bool) -> None:
        """Mark the line that runs, or comes next while the program is held."""
        if (line, held) == (self.running, self.held):
            return
        moved = line != self.running
        self.running, self.held = line, held
        self._refresh()
        if moved:
            self._reveal(line)

    def step(self, report: StepReport) -> None:
        """Say how far it is."""
        self._steps = f"step {report.index + 1} of {report.count}"
        self._refresh()

    def end(self, how: str) -> None:
        """The run is over: say how; the last line stays marked if it did not end as planned."""
        if how == "done":
            self.running = 0
        self._steps, self.held = how, False
        self._refresh(ended=True)

    def _refresh(self, ended: bool = False) -> None:
        title = Content.styled("program", "bold")
        kind = f" {self.kind}" if self.kind else ""
        title += Content.styled(f"{kind}  ", "$foreground-muted")
        if self.held:
            title += Content.styled(f"held at line {self.running}", "$text-warning")
        else:
            title += Content.styled(self._steps, "$foreground-muted")
        self.query_one("#program-title", Static).update(title)
        code = numbered(self.source, self.running, self.held, ended)
        self.query_one("#program-code", Static).update(code)

    def _reveal(self, line: int) -> None:
        scroll = self.query_one("#program-scroll")
        visible = max(scroll.size.height, 1)
        top = scroll.scroll_offset.y
        if not top <= line - 1 < top + visible - 1:
            scroll.scroll_to(y=max(line - 1 - visible // 2, 0), animate=False)

    def action_copy_program(self) -> None:
        """Ask for the program on the clipboard."""
        self.post_message(self.Copied())

    def action_leave(self) -> None:
        """Give the keyboard back to the prompt."""
        self.screen.query_one("#prompt").focus()

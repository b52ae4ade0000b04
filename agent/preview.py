"""What is shown of a plan before it runs: its numbers as text, a drawing in an SVG file."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple, TextIO

from agent.errors import ConfigError
from agent.explain import as_text, explain
from agent.picture import svg
from agent.plain import plain
from robot_bridge.api import ApprovedPlan, Limits
from scene.types import Scene


class Preview(NamedTuple):
    """What to show: ``explain`` on the stream, ``svg`` into that file."""

    explain: bool = False
    svg: str | None = None

    def show(self, plan: ApprovedPlan, after: Scene, limits: Limits, out: TextIO) -> None:
        """Show it. Raises ConfigError if the file cannot be written."""
        table_m = after.table_m
        if self.explain:
            out.write(plain(as_text(explain(plan, limits), table_m)))
        if self.svg is not None:
            draw(self.svg, plan, after, limits)


def draw(path: str, plan: ApprovedPlan, after: Scene, limits: Limits) -> None:
    """Draw the plan into a file. Raises ConfigError if it cannot be written."""
    try:
        Path(path).write_text(svg(plan, limits, after), encoding="utf-8")
    except OSError as error:
        raise ConfigError(f"cannot write the drawing {path}: {error.strerror}") from error

"""Text and lengths as the screen shows them; what comes from the bus stays text (`agent.plain`)."""

from __future__ import annotations

from agent.plain import REPLACEMENT as REPLACEMENT
from agent.plain import one_line as one_line
from agent.plain import plain as plain


def shorten(text: str, width: int) -> str:
    """The text cut to ``width`` characters, the cut shown by an ellipsis."""
    return text if len(text) <= width else text[: max(width - 1, 0)] + "…"


def millimetres(units: float, table_m: float) -> str:
    """A length in table units as whole millimetres on a table of side ``table_m``, no unit."""
    return f"{units * table_m * 500:.0f}"

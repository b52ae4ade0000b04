"""Text from the bus as text: nothing in it may steer the terminal or pass for markup.

Names and replies come from other processes. Escape sequences, other control characters and
bidirectional overrides are shown as a replacement character; only line breaks survive.
"""

from __future__ import annotations

import unicodedata

REPLACEMENT = "\N{REPLACEMENT CHARACTER}"


def plain(text: str) -> str:
    """The text with control and format characters made visible; line breaks stay, tabs widen."""
    return "".join(_harmless(letter) for letter in text.replace("\r\n", "\n").expandtabs(4))


def one_line(text: str) -> str:
    """The text on one line, for labels and headings."""
    return " ".join(plain(text).split())


def _harmless(letter: str) -> str:
    if letter == "\n" or unicodedata.category(letter) not in ("Cc", "Cf", "Cs", "Co"):
        return letter
    return REPLACEMENT


def shorten(text: str, width: int) -> str:
    """The text cut to ``width`` characters, the cut shown by an ellipsis."""
    return text if len(text) <= width else text[: max(width - 1, 0)] + "…"


def millimetres(units: float, table_m: float) -> str:
    """A length in table units as whole millimetres on a table of side ``table_m``, no unit."""
    return f"{units * table_m * 500:.0f}"

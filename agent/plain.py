"""Text from elsewhere as text: nothing in it may steer the terminal or pass for markup.

Names, programs and replies come from models, scenes and other processes. Escape sequences, other
control characters and bidirectional overrides are shown as a replacement character; only line
breaks survive.
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

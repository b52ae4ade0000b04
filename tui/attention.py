"""What the translator looked at, as text: the sentence once for each token of the program."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from textual.content import Content

from agent.messages import Attention
from tui.plain import plain

LEAST = 0.005
"""Shares below half a percent are not told."""
WIDEST = 16
"""Columns of a token at most; a longer one is cut."""
HIDDEN = {"[CLS]": "⟨", "[SEP]": "⟩"}
"""The pieces before and behind the sentence."""


class Row(NamedTuple):
    """A token of the program, its number (from 1), and the words with their shares."""

    number: int
    token: str
    words: tuple[tuple[str, float], ...]


def rows(attention: Attention) -> list[Row]:
    """One row for each token; word pieces are put together into words."""
    groups: list[list[int]] = []
    for index, piece in enumerate(attention.pieces):
        if piece.startswith("##") and groups:
            groups[-1].append(index)
        else:
            groups.append([index])
    words = ["".join(attention.pieces[i].removeprefix("##") for i in group) for group in groups]
    return [
        Row(number, plain(token).strip(), tuple(
            (HIDDEN.get(word, plain(word)), sum(shares[i] for i in group))
            for word, group in zip(words, groups, strict=True)
        ))
        for number, (token, shares) in enumerate(
            zip(attention.tokens, attention.weights, strict=True), start=1
        )
    ]  # fmt: skip


def chosen(found: Sequence[Row], token: str) -> list[Row]:
    """The rows of a token given by number or by what is in it; all of them for ""."""
    wanted = token.strip().lower()
    if wanted.isascii() and wanted.isdigit():
        return [row for row in found if row.number == int(wanted)]
    return [row for row in found if wanted in row.token.lower()]


def shaded(found: Sequence[Row]) -> Content:
    """The rows for the screen: the more a word was looked at, the stronger its background."""
    width = min(WIDEST, max((len(row.token) for row in found), default=0))
    lines = []
    for row in found:
        token = row.token if len(row.token) <= width else row.token[: width - 1] + "…"
        line = Content.styled(f"{row.number:>3} {token:<{width}} ", "$foreground-muted")
        most = max(share for _, share in row.words)
        for word, share in row.words:
            strong = "bold " if share == most else ""
            style = f"{strong}on $primary {round(100 * share)}%" if share >= LEAST else ""
            line += Content.styled(word, style) + Content(" ")
        lines.append(line)
    return Content("\n").join(lines)


def told(found: Sequence[Row]) -> str:
    """The rows in plain words: the words looked at, the most first."""
    lines = []
    for row in found:
        most = sorted(row.words, key=lambda one: -one[1])
        shares = [f"{word} {100 * share:.0f} %" for word, share in most if share >= LEAST]
        lines.append(f"{row.number:>3} {row.token}: {', '.join(shares)}")
    return "\n".join(lines)

"""Our own two themes; all of Textual's are there as well."""

from __future__ import annotations

from collections.abc import Collection

from textual.theme import Theme

from agent.errors import ConfigError

THEMES = (
    Theme(
        name="armchat", dark=True, primary="#70c4ff", secondary="#5a78b4", accent="#ffc857",
        foreground="#e2e6f0", background="#11141c", surface="#181c27", panel="#222838",
        success="#5fcf80", warning="#ffb347", error="#ff6b5e",
    ),
    Theme(
        name="armchat-light", dark=False, primary="#1468be", secondary="#4a6ea8",
        accent="#b46a00", foreground="#181c26", background="#f6f6f2", surface="#ecedf0",
        panel="#dfe2e8", success="#1e7d3c", warning="#b45f00", error="#c0281e",
    ),
)  # fmt: skip


def theme_name(name: str | None, known: Collection[str]) -> str:
    """The theme to use: ours if none is named. Raises ConfigError for one nobody knows."""
    if name is None:
        return THEMES[0].name
    if name not in known:
        raise ConfigError(f"no theme {name!r}; there are {', '.join(sorted(known))}")
    return name

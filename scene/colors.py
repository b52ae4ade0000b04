"""Colour words and what each looks like, for simulated things; those that the detector uses."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

RGB = tuple[float, float, float]
COLOR_VALUES: Mapping[str, RGB] = MappingProxyType(
    {
        "red": (0.82, 0.12, 0.12),
        "green": (0.25, 0.62, 0.20),
        "blue": (0.15, 0.30, 0.80),
        "yellow": (0.95, 0.83, 0.15),
        "orange": (0.95, 0.50, 0.08),
        "purple": (0.50, 0.20, 0.60),
        "violet": (0.50, 0.20, 0.70),
        "pink": (0.95, 0.55, 0.65),
        "brown": (0.45, 0.28, 0.15),
        "black": (0.08, 0.08, 0.09),
        "white": (0.95, 0.95, 0.93),
        "gray": (0.50, 0.50, 0.52),
        "grey": (0.50, 0.50, 0.52),
        "silver": (0.75, 0.76, 0.78),
        "gold": (0.83, 0.66, 0.22),
        "beige": (0.88, 0.80, 0.66),
        "turquoise": (0.20, 0.75, 0.72),
        "cyan": (0.20, 0.78, 0.88),
        "magenta": (0.80, 0.15, 0.60),
        "maroon": (0.45, 0.08, 0.12),
        "navy": (0.08, 0.12, 0.38),
        "teal": (0.08, 0.48, 0.48),
        "tan": (0.80, 0.68, 0.50),
    }
)
"""Red, green, blue in [0, 1] of each colour word, as a screen shows it."""
SEEN_COLORS = (
    "red", "green", "blue", "yellow", "orange", "purple", "pink", "brown", "black", "white",
    "gray", "silver", "gold", "beige", "turquoise",
)  # fmt: skip
"""The colour words that the detector uses."""

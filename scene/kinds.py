"""What a thing's name tells: its head noun, whether it is an open container, its colour.

One list for the simulators (what falls into what), the generator and the clarifier.
"""

from __future__ import annotations

import re
from functools import lru_cache

_OPEN = (
    "bag basin basket beaker bin bowl box bucket carton case chalice chest container crate crock "
    "cup drawer dustbin flask glass goblet hamper jar jug ladle mug pail pan pitcher pot ramekin "
    "saucepan shoebox sink skillet teacup teapot tin toolbox tray tub tumbler vase wok"
)
CONTAINERS = frozenset(_OPEN.split())
"""Head nouns of things that are open at the top: what fits lies in them."""

_BOXES = "box case crate carton drawer tray basket shoebox toolbox chest bag sink container"
FOUR_WALLED = frozenset(_BOXES.split())
"""Those of them that have four walls; the others are round."""

CONTAINER_PHRASES = frozenset({"trash can", "garbage can", "rubbish can", "watering can"})
"""Two-word names of open containers whose last word alone is not one."""

_COLORS = (
    "red green blue yellow orange purple pink brown black white gray grey silver gold golden "
    "beige turquoise violet cyan magenta maroon navy teal tan"
)
COLORS = frozenset(_COLORS.split())
"""Colour words, as they may stand before a noun."""


@lru_cache(maxsize=4096)
def words(name: str) -> tuple[str, ...]:
    """The lower-case words of a noun phrase ("Small brown-ish bowl" -> small, brown, ish, bowl)."""
    return tuple(re.findall(r"[a-z0-9]+", name.lower()))


@lru_cache(maxsize=4096)
def head_noun(name: str) -> str:
    """The word that says what a thing is: the last one, or the one before "of", "with", "for".

    "small brown bowl" -> bowl, "cup of tea" -> cup, "" -> "".
    """
    parts = words(name)
    for index, word in enumerate(parts):
        if word in {"of", "with", "for", "from", "in"} and index > 0:
            return parts[index - 1]
    return parts[-1] if parts else ""


@lru_cache(maxsize=4096)
def is_container(name: str) -> bool:
    """Whether a thing of this name is open at the top, so that what fits lies inside it."""
    if head_noun(name) in CONTAINERS:
        return True
    return " ".join(words(name)[-2:]) in CONTAINER_PHRASES


@lru_cache(maxsize=4096)
def color_in(name: str) -> str | None:
    """The colour word inside a name ("red star" -> red), or None; never the head noun itself."""
    head = head_noun(name)
    for word in words(name):
        if word in COLORS and word != head:
            return {"grey": "gray", "golden": "gold"}.get(word, word)
    return None

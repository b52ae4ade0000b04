"""How tall a thing is, and how sure that is, by its name and footprint and what was seen (pure).

From above, heights can hardly be seen. What a thing is called says more: things of one noun are
alike in their proportions, of whatever size (`scene.generate.CLASSES`).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType

from scene.generate import CLASSES
from scene.kinds import head_noun
from scene.look import Look
from scene.shapes import KINDS

SEEN, USUAL = 0.45, 0.1
"""Standard deviations, as shares: of the heights seen of things of no kind, and of proportions."""
KNOWN: Mapping[str, float] = MappingProxyType(
    {
        "apple": 0.02, "orange": 0.02, "lemon": 0.02, "pear": 0.03, "block": 0.05, "banana": 0.06,
        "cup": 0.11, "can": 0.13, "bottle": 0.15, "matchbox": 0.20, "padlock": 0.32, "magnet": 0.35,
    }
)  # fmt: skip
"""The same of the heights that the detector sees of its own kinds (LOG: heights from above)."""


def stature(name: str, look: Look) -> float:
    """The height (table units) of a thing of that name."""
    told = usual(name, look)
    if told is None:
        return look.tall
    share = SEEN**2 / (SEEN**2 + USUAL**2)
    return look.tall * math.exp(share * math.log(told / look.tall))


def spread(name: str, look: Look) -> float:
    """The standard deviation of that height (table units)."""
    if usual(name, look) is not None:
        return stature(name, look) / math.hypot(1 / SEEN, 1 / USUAL)
    noun = head_noun(name)
    return look.tall * (KNOWN[noun] if noun == look.name and noun in KNOWN else SEEN)


def usual(name: str, look: Look) -> float | None:
    """The height that a thing of that noun has on such a footprint; None where none is known."""
    noun = head_noun(name)
    kind = CLASSES.get(noun)
    if kind is None or noun in KINDS or not look.upright:
        return None
    return kind.tall * (look.width + look.height) / (kind.width + kind.height)

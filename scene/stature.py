"""How tall a thing is, from its name and its footprint beside what was seen of it (pure).

From above, heights can hardly be seen: of things of no kind that the detector knows it is wrong by
a quarter. What such a thing is called says more: things of one noun are alike in their proportions,
of whatever size (`scene.generate.CLASSES`).
"""

from __future__ import annotations

import math

from scene.generate import CLASSES
from scene.kinds import head_noun
from scene.look import Look
from scene.shapes import KINDS

SEEN, USUAL = 0.25, 0.1
"""Standard deviations, as shares: of the heights seen of things of no kind, and of proportions."""


def stature(name: str, look: Look) -> float:
    """The height (table units) of a thing of that name."""
    noun = head_noun(name)
    kind = CLASSES.get(noun)
    if kind is None or noun in KINDS or not look.upright:
        return look.tall
    usual = kind.tall * (look.width + look.height) / (kind.width + kind.height)
    share = SEEN**2 / (SEEN**2 + USUAL**2)
    return look.tall * math.exp(share * math.log(usual / look.tall))

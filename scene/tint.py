"""Which colour word fits what is inside of a thing's outline, where that is beyond doubt (pure).

The detector tells colours from a picture of 2 mm a pixel, for all of a thing at once. Here the
pixels that its outline encloses are compared with what each word looks like. Light is unknown, so
a word is only put right where another fits far better; words that are neighbours stay.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from scene.colors import COLOR_VALUES, SEEN_COLORS
from scene.contour import Contour
from scene.outline import Body, Eye, Floats, Shape, beyond, supports

TINT, BRIGHT = 0.2, 0.6
"""Standard deviations of the hues (logs of red and of blue by green) and of the brightness (a log)
that light and surfaces give a colour."""
DARK = 8.0
"""Added to each channel: what is dark has hardly a hue."""
SURELY = 10.0
"""By how much (nats) another word must fit better than what was said."""
MOST = 0.7
"""Share of the pixels that must say so."""
FEWEST = 20
"""Pixels from which a colour is told."""
PALE = frozenset({"white", "silver", "gray", "pink", "beige"})
"""What light that is thrown back makes of other colours: never put in another's place."""
PARTS = frozenset({"magnet", "padlock"})
"""Things of two colours, one of which is the thing's own."""


def _lid(low: float, wide: float) -> Shape:
    levels = [(0.0, 0.0, z, wide / 2, wide / 2, 1.0) for z in (low, 1.0)]
    return Shape(np.array(levels))


LIDS: Mapping[str, Shape] = {"can": _lid(0.94, 1.0), "bottle": _lid(0.88, 0.54)}
"""What of a thing has another colour than itself: its lid, by tallness and width."""


def _features(colors: NDArray[np.float64]) -> Floats:
    """Two hues and the brightness (n, 3) of colours (n, 3; of 255)."""
    bright = colors + DARK
    red, green, blue = bright.T
    made: Floats = np.stack(
        [np.log(red / green), np.log(blue / green), np.log(bright.mean(1))], -1
    )  # fmt: skip
    return made


_WORDS = _features(np.array([COLOR_VALUES[word] for word in SEEN_COLORS]) * 200.0)


def tint(seen: Contour, said: str | None, name: str, body: Body, eye: Eye) -> str | None:
    """The colour word of a thing with that outline, of which ``said`` was said."""
    if said not in SEEN_COLORS or name in PARTS:
        return said
    own = seen.colors
    if name in LIDS:
        lid = supports(LIDS[name], body.vector()[None], eye)[0]
        own = own[beyond(seen.points, lid) > seen.pixel]
    if len(own) < FEWEST:
        return said
    features = _features(own.astype(np.float64))
    scale = np.array((TINT, TINT, BRIGHT)) * math.sqrt(2)
    off = ((np.median(features, 0) - _WORDS) / scale) ** 2
    unlike = off.sum(1)
    best, old = int(unlike.argmin()), SEEN_COLORS.index(said)
    if SEEN_COLORS[best] in PALE or unlike[old] - unlike[best] < SURELY:
        return said
    each = (((features[:, None] - _WORDS[[old, best]]) / scale) ** 2).sum(-1)
    return SEEN_COLORS[best] if (each[:, 1] < each[:, 0]).mean() >= MOST else said

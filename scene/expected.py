"""What a picture should show of what is known, for a detector that may miss it (pure)."""

from __future__ import annotations

import math

from scene.lean import shaded
from scene.sight import Detection
from scene.support import carriers, covered
from scene.tracks import Hint, Track, Tracks

SURE = 0.9
"""The score of what was seen before."""
NEAREST, FARTHEST = 0.005, 0.03
"""How exactly at most and at least it is known where to look (standard deviation, table units)."""


def expected(tracks: Tracks, hint: Hint) -> tuple[Detection, ...]:
    """What stands on the table in the open, where it should be: as a detector would tell it, and
    as tall as the tool has felt it to be. What was only seen so is no news to a detector."""
    on = carriers(tracks.known, hint.eye, tracks.held)
    away = {*on, *covered(tracks.known, on, hint.eye), tracks.held}
    return tuple(
        _seen(one, hint)
        for one in tracks.known
        if one.id not in away and not one.over and not shaded(one.place(hint.eye), one.base,
            one.tall, one.look.radius, hint.eye, hint.shades)
    )  # fmt: skip


def _seen(one: Track, hint: Hint) -> Detection:
    look = one.look
    x, y = one.place(hint.eye)
    sd = min(max(one.at.sd, NEAREST), FARTHEST)
    return Detection(
        look.name, SURE, x, y, sd, look.width, look.height, one.tall, look.r, look.color,
        look.feature, tall_sd=one.tall_sd if one.felt is not None else math.inf,
    )  # fmt: skip

"""What a picture should show of what is known, for a detector that may miss it (pure)."""

from __future__ import annotations

import math

from scene.kinds import head_noun
from scene.lean import shaded
from scene.outline import SHAPES
from scene.sight import Detection
from scene.stature import usual
from scene.support import Carriers, base, carriers, covered, covers
from scene.tracks import Hint, Track, Tracks

SURE = 0.9
"""The score of what was seen before."""
NEAREST, FARTHEST = 0.005, 0.03
"""How exactly at most and at least it is known where to look (standard deviation, table units)."""
KNOWN_SIDES = 0.05
"""The same of the logs of sides that were seen before, or are those of what waited in the tray."""


def expected(tracks: Tracks, hint: Hint) -> tuple[Detection, ...]:
    """What stands in the open, on the table or flat on something that does, where it should be: as
    a detector would tell it, and as tall as the tool has felt it to be, or as a person's word for
    it says. What was only seen so is no news to a detector."""
    on = carriers(tracks, hint.eye)
    known = {one.id: one for one in tracks.known}
    hidden = {*covered(tracks.known, on, hint.eye), tracks.held}
    return tuple(
        _seen(one, base(one, known, on), hint)
        for one in tracks.known
        if one.id not in hidden and not one.over
        and (one.id not in on or _lies_on(one, known[on[one.id]], on, tracks.held, hint))
        and not shaded(one.place(hint.eye), one.base, one.tall, one.look.radius, hint.eye,
            hint.shades)
    )  # fmt: skip


def _lies_on(one: Track, carrier: Track, on: Carriers, held: str | None, hint: Hint) -> bool:
    """Whether a thing lies wholly on or in one that stands on the table: it stands out there."""
    if carrier.id == held or carrier.id in on:
        return False
    return covers(carrier, one.place(hint.eye), hint.eye, -one.look.radius)


def _seen(one: Track, low: float, hint: Hint) -> Detection:
    look = one.look
    x, y = one.at.x, one.at.y
    sd = min(max(one.at.sd, NEAREST), FARTHEST)
    noun = head_noun(one.called or "") if look.upright else ""
    usually = usual(noun, look) is not None
    told = one.felt is not None or usually
    return Detection(
        look.name, SURE, x, y, sd, look.width, look.height, one.tall, look.r, look.color,
        look.feature, tall_sd=one.tall_sd if told else math.inf, base=low,
        noun=noun if usually or noun in SHAPES else "", sides_sd=KNOWN_SIDES,
    )  # fmt: skip

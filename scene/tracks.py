"""The values of a tracker: a thing with an identity, all of them, and what the robot tells."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal, NamedTuple

from scene.estimate import Estimate
from scene.lean import Eye, Point, Shade, stands_at
from scene.look import UNKNOWN, Look
from scene.stature import spread, stature
from scene.types import EDGE, Pose

NAMELESS = "thing"
"""The name of what is of no known kind, until somebody gives it another."""
FELT = 0.01
"""Standard deviation of a height by where suction took hold of the top (table units)."""
TRIED = (0.0, -1.1, 1.1, -2.2, 2.2)
"""At which heights a rim is looked for, one after the other (standard deviations)."""
RESTLESS = 0.5
"""Seconds after a push or a jump in which a thing may well move on."""


class Hint(NamedTuple):
    """What the robot knows and the camera does not.

    ``tip``: where the tool is. ``grip``: suction is on; ``felt``: something is held (each None:
    not known). ``at``: where the tool was when ``grip`` changed last (None: at ``tip``). ``eye``
    is the camera's centre, ``shades`` are what the arm hides from it. ``idle``: no plan is under
    way; things in the tray close up before the next one.
    """

    tip: Pose | None = None
    grip: bool | None = None
    felt: bool | None = None
    at: Pose | None = None
    eye: Eye | None = None
    shades: tuple[Shade, ...] = ()
    idle: bool = True


@dataclass(frozen=True, eq=False)
class Track:
    """One thing through time.

    ``at`` is where it seems to be on the surface; ``base`` the height of its base above the table
    as the robot knows it, and ``on`` what the robot set it down on ("": nobody knows). ``seen`` is
    when it was seen last (seconds), ``clear`` when it was so with nothing of the arm before it,
    ``missing`` for how long it should have been seen since, ``hits`` how often it was; ``steady``
    how often in a row since it was away or moved, ``calm`` when it was so last, ``born`` when it
    was seen first; ``stirred`` when it may have begun to move, ``shoved`` when something went by
    that may have pushed it. ``called``: what a person called it, ``felt``: how tall it is,
    standing, by where the tool took hold of its top (table units), ``misses``: how often it found
    none where it was to be. ``stand``: the number under which the detector knows it while it rests
    (0: none), ``stood`` its place as known from that, ``rested`` when it was seen so last.
    """

    id: str
    look: Look
    at: Estimate
    seen: float
    clear: float = float("-inf")
    missing: float = 0.0
    hits: int = 1
    steady: int = 1
    calm: float = float("-inf")
    born: float = float("-inf")
    stirred: float = float("-inf")
    shoved: float = float("-inf")
    called: str | None = None
    on: str = ""
    base: float = 0.0
    felt: float | None = None
    misses: int = 0
    stand: int = 0
    stood: Estimate | None = None
    rested: float = float("-inf")

    @property
    def name(self) -> str:
        """What it is called: by a person, else by its kind."""
        return self.called or (NAMELESS if self.look.name == UNKNOWN else self.look.name)

    @property
    def tall(self) -> float:
        """How tall it is, as the tool met it, else by the name too that a person gave it."""
        if self.felt is not None and self.look.upright:
            return self.felt
        seen = stature(self.called, self.look) if self.called else self.look.tall
        off = TRIED[self.misses % len(TRIED)] * self.tall_sd if self.misses else 0.0
        return max(seen + off, seen / 2)

    @property
    def tall_sd(self) -> float:
        """The standard deviation of that (table units)."""
        seen = spread(self.called or self.look.name, self.look)
        return min(seen, FELT) if self.felt is not None and self.look.upright else seen

    @property
    def over(self) -> bool:
        """Whether it is beyond the table's edge."""
        return max(abs(self.at.x), abs(self.at.y)) > EDGE

    def restless(self, t: float) -> bool:
        """Whether it was touched, pushed or moved a moment ago."""
        return t - self.stirred < RESTLESS

    def sliding(self, t: float) -> bool:
        """Whether it may have been pushed on, nobody knows how far."""
        return t - self.shoved < RESTLESS

    def place(self, eye: Eye | None, base: float | None = None) -> Point:
        """Where it stands, if its base is at that height (None: at its own; table units)."""
        return stands_at((self.at.x, self.at.y), self.base if base is None else base, eye)


class Hold(NamedTuple):
    """What the tool holds: the thing's place beside the tip, turned back by ``r`` (radians), and
    the ids of what stood on it, or in it, when it was taken."""

    id: str
    dx: float
    dy: float
    r: float
    angle: float
    bears: frozenset[str] = frozenset()


@dataclass(frozen=True, eq=False)
class Tracks:
    """All things: ``known`` ones, ``budding`` ones (seen too rarely to be believed), ``gone`` ones.

    ``gone`` things keep their ids and names for when they come back; those whose ``on`` is
    ``floor`` were seen to go over the edge. ``counts``: how many ids of a stem were given.
    """

    known: tuple[Track, ...] = ()
    budding: tuple[Track, ...] = ()
    gone: tuple[Track, ...] = ()
    counts: Mapping[str, int] = field(default_factory=dict)
    t: float | None = None
    tip: Pose | None = None
    gripping: bool = False
    hold: Hold | None = None

    @property
    def held(self) -> str | None:
        """The id of what the tool holds."""
        return None if self.hold is None else self.hold.id


class Event(NamedTuple):
    """What happened to a thing: it came, left, went over the edge, or changed its name."""

    kind: Literal["entered", "left", "fell", "renamed"]
    id: str
    name: str

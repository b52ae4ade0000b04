"""What a camera delivers and what is detected in it: the values between camera, detector, tracker.

Pixel convention, here and everywhere: the centre of the first pixel is (0, 0), u runs right along
a row, v down; so the picture's left border lies at u = -0.5.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

Pixels = NDArray[np.uint8]
Points = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Picture:
    """One frame: ``pixels`` (height, width, 3) uint8, RGB, taken at ``t`` (Unix seconds)."""

    pixels: Pixels
    t: float


@dataclass(frozen=True, eq=False)
class View:
    """How an undistorted picture shows the table.

    ``homography`` (3, 3) takes points of the table's surface (x, y, 1; table units) to pixels
    (u, v, 1), up to scale. ``camera`` is the camera's centre (x, y, z; table units), by which what
    stands up from the table leans outwards.
    """

    homography: Points
    camera: tuple[float, float, float]

    def pixels(self, points: Points) -> Points:
        """Where points of the surface (n, 2) appear: (n, 2) pixels."""
        return _apply(self.homography, points)

    def raised(self, z: float) -> View:
        """How the picture shows a level surface ``z`` above the table's, as if that were it."""
        x, y, high = self.camera
        stretch = high / (high - z)
        onto = np.array([[stretch, 0, x - stretch * x], [0, stretch, y - stretch * y], [0, 0, 1.0]])
        return View(self.homography @ onto, (x, y, high - z))

    def points(self, pixels: Points) -> Points:
        """Which points of the surface (n, 2; table units) pixels (n, 2) show."""
        back: Points = np.linalg.inv(self.homography).astype(np.float64)
        return _apply(back, pixels)


@dataclass(frozen=True, eq=False)
class Detection:
    """One thing in one picture; lengths in table units, angles in radians, as in `SceneObject`.

    ``x, y`` is the centre of its footprint on the table, ``sd`` the standard deviation of each of
    them. ``name`` is a kind the detector knows, one that a person has taught, or ``other``.
    ``feature`` (n,), of length 1, is like that of things that look alike. ``stand``: the same
    number in two pictures says that this is one thing, which has not moved; 0 says nothing.
    ``tall_sd``: the standard deviation of ``tall``, where more is known than a picture tells;
    ``sides_sd``: the same of the logs of ``width`` and ``height``; ``noun``: a person's word for
    it, where that tells of its shape or size.
    ``base``: how high above the table it lies on something, where that is known; ``x, y`` are then
    where its base seems to be on the table (`scene.lean.seen_at`).
    """

    name: str
    score: float
    x: float
    y: float
    sd: float
    width: float
    height: float
    tall: float
    r: float
    color: str | None
    feature: NDArray[np.float32]
    stand: int = 0
    tall_sd: float = math.inf
    base: float = 0.0
    noun: str = ""
    sides_sd: float = math.inf


class Camera(Protocol):
    """A source of pictures. Calibrated or not is not its concern."""

    def look(self) -> Picture:
        """The newest frame. Raises CameraError where there is none, and says what to do."""
        ...

    def close(self) -> None:
        """Give the device back; never waits."""
        ...


class Detector(Protocol):
    """Finds the things on a table in an undistorted picture."""

    def detect(
        self, picture: Picture, view: View, expected: Sequence[Detection] = ()
    ) -> tuple[Detection, ...]:
        """All things seen, surest first. ``expected``: what should be seen of what is known, as it
        would be told; who can look for it may."""
        ...


def _apply(homography: Points, points: Points) -> Points:
    ones = np.ones((len(points), 1))
    mapped = np.hstack([points, ones]) @ homography.T
    return mapped[:, :2] / mapped[:, 2:]

"""Is a picture good enough to be measured in? One plain sentence where it is not (pure)."""

from __future__ import annotations

import numpy as np

from agent.config import CameraConfig
from scene import opencv
from scene.sight import Pixels, Points

BURNT, BLACK = 250, 8
"""From this brightness on, and down to it, a pixel tells nothing any more."""
MARGIN = 8
"""Pixels around what is measured that its edges may take."""


def exposure(pixels: Pixels, limits: CameraConfig) -> str | None:
    """What is wrong with the light in a picture (height, width, 3; RGB), and what to do."""
    bright = opencv.gray(pixels)
    mean = float(bright.mean())
    burnt, black = float((bright >= BURNT).mean()), float((bright <= BLACK).mean())
    if burnt > limits.burnt:
        return f"{burnt:.0%} of the picture is burnt out: less light, or a shorter exposure"
    if mean < limits.darkest or black > limits.black:
        return (
            f"the picture is too dark (mean {mean:.0f} of 255, {black:.0%} black): more light, or "
            "a longer exposure"
        )
    if mean > limits.brightest:
        return f"the picture is too bright (mean {mean:.0f} of 255): less light"
    return None


def blur(pixels: Pixels, limits: CameraConfig, around: Points | None = None) -> str | None:
    """Whether the edges in a picture are too wide to be measured, and what to do.

    ``around``: only those near these points (n, 2; pixels), since what else is in a picture may
    well be out of focus.
    """
    width = opencv.edge_width(opencv.gray(pixels if around is None else _near(pixels, around)))
    if width <= limits.blurred:
        return None
    return (
        f"the picture is blurred (edges are {width:.0f} pixels wide, at most {limits.blurred:g}): "
        "focus the lens, hold still, clean the glass"
    )


def _near(pixels: Pixels, points: Points) -> Pixels:
    """The part of a picture that has these points, and a little more."""
    size = np.array(pixels.shape[1::-1])
    left, top = np.clip(np.floor(points.min(axis=0)) - MARGIN, 0, size - 1).astype(int)
    right, bottom = np.clip(np.ceil(points.max(axis=0)) + MARGIN, 1, size).astype(int)
    return np.ascontiguousarray(pixels[top:bottom, left:right])

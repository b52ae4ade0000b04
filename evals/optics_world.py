"""Pictures of boards and marker tables by a camera that is known exactly: the truth for the eye.

The camera is a pinhole with Brown's distortion (k1 k2 p1 p2 k3), written out here, so that nothing
is measured with what it is made by. A pixel, whose centre is a whole number, is sampled ``FINE`` x
``FINE`` times where an edge may cross it; then come blur, light, noise. Lengths in mm; the table's
frame is x right, y away, z up, from its middle. Seeded.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene import opencv
from scene.sight import Pixels, Points

FINE = 4
DIM, BRIGHT, TABLE = 40.0, 215.0, 150.0
"""What black ink, white paper and the table are in the picture."""
BOARD = opencv.Board(7, 5, 38.0, 28.0)

Ink = Callable[[Points], Points]
"""Brightness (n,) at points of a plane (n, 2; mm); NaN where the plane ends."""


class Eye(NamedTuple):
    """A camera: its ``size`` (width, height), ``matrix`` (3, 3) and ``distortion`` (5,)."""

    size: tuple[int, int]
    matrix: Points
    distortion: Points

    def project(self, points: Points) -> Points:
        """Where points of the camera's frame (n, 3; z ahead) appear: (n, 2) pixels."""
        flat = points[:, :2] / points[:, 2:]
        bent = _bend(flat, self.distortion)
        return np.asarray(bent * np.diag(self.matrix)[:2] + self.matrix[:2, 2])

    def rays(self, pixels: Points) -> Points:
        """The directions (n, 2; at z = 1) that pixels (n, 2) look in."""
        bent = (pixels - self.matrix[:2, 2]) / np.diag(self.matrix)[:2]
        flat = bent
        for _ in range(
            8
        ):  # a fixed point, to 1e-6 pixels where the lens bends by less than a fifth
            flat = flat + bent - _bend(flat, self.distortion)
        return flat


def _bend(flat: Points, distortion: Points) -> Points:
    k1, k2, p1, p2, k3 = distortion
    x, y = flat[:, 0], flat[:, 1]
    square = x * x + y * y
    radial = 1 + square * (k1 + square * (k2 + square * k3))
    return np.column_stack(
        (
            x * radial + 2 * p1 * x * y + p2 * (square + 2 * x * x),
            y * radial + p1 * (square + 2 * y * y) + 2 * p2 * x * y,
        )
    )


class Shot(NamedTuple):
    """How the picture is taken: where the plane stands, and how good the picture is.

    ``rotation`` (3, 3) and ``translation`` (3,; mm) take the plane's frame to the camera's.
    ``blur``: sigma in pixels. ``light``: times the brightness. ``noise``: its deviation.
    """

    rotation: Points
    translation: Points
    blur: float = 0.6
    light: float = 1.0
    noise: float = 2.0
    seed: int = 0

    def seen(self, eye: Eye, points: Points) -> Points:
        """Where points of the plane (n, 2; mm) appear: (n, 2) pixels."""
        flat = np.column_stack((points, np.zeros(len(points))))
        return eye.project(flat @ self.rotation.T + self.translation)

    @property
    def centre(self) -> Points:
        """The camera's place in the plane's frame (3,; mm)."""
        return np.asarray(-self.rotation.T @ self.translation)


def camera(
    size: tuple[int, int] = (1280, 960), *, view: float = 60.0, k1: float = -0.12, seed: int = 0
) -> Eye:
    """A camera such as may be bought: ``view`` degrees across, not quite centred, curved."""
    chance = np.random.default_rng(seed)
    width, height = size
    focal = width / 2 / math.tan(math.radians(view) / 2)
    shift = chance.uniform(-0.01, 0.01, 2) * width
    matrix = np.array(
        [[focal, 0, width / 2 - 0.5 + shift[0]], [0, focal, height / 2 - 0.5 + shift[1]], [0, 0, 1]]
    )
    k2 = -k1 * chance.uniform(0.2, 0.4)
    p1, p2 = chance.uniform(-5e-4, 5e-4, 2)
    return Eye(size, matrix, np.array([k1, k2, p1, p2, 0.0]))


def over_table(
    height: float = 550.0, tilt: float = 12.0, turn: float = 0.0,
    aside: tuple[float, float] = (0, 0), **how: float,
) -> Shot:  # fmt: skip
    """A camera so high over the table (mm), tilted by ``tilt`` degrees in the direction ``turn``
    (degrees, from the table's x), looking at a point ``aside`` (mm) of the table's middle."""
    lean, way = math.radians(tilt), math.radians(turn)
    direction = np.array(
        [math.sin(lean) * math.cos(way), math.sin(lean) * math.sin(way), -math.cos(lean)]
    )
    right = np.cross(direction, [0.0, 1.0, 0.0])
    right /= np.linalg.norm(right)
    rotation = np.array([right, np.cross(direction, right), direction])
    centre = np.array([*aside, 0.0]) - direction * height / math.cos(lean)
    return Shot(rotation, -rotation @ centre, **how)  # type: ignore[arg-type]


def board_shots(eye: Eye, count: int = 15, seed: int = 0, **how: float) -> Iterator[Shot]:
    """A board held before the camera as a careful person would: all over the picture, and tilted
    towards each side in turn."""
    chance = np.random.default_rng(seed)
    middle = np.array([BOARD.across, BOARD.down]) * BOARD.square / 2
    for number in range(count):
        spot = np.array([number % 3 - 1, number // 3 % 3 - 1]) * 0.55 + chance.uniform(-0.1, 0.1, 2)
        lean = 0.0 if number % 5 == 4 else math.radians(chance.uniform(22, 38))
        way = math.tau * (number % 5) / 4
        axis = lean * np.array([math.cos(way), math.sin(way), 0.0])
        rotation = _rotation(axis) @ _rotation(np.array([0.0, 0.0, chance.uniform(-0.3, 0.3)]))
        away = chance.uniform(380.0, 560.0)
        reach = np.array(eye.size) / 2 / np.diag(eye.matrix)[:2]
        at = np.array([*(spot * reach * 0.9), 1.0]) * away
        yield Shot(rotation, at - rotation @ np.array([*middle, 0.0]), seed=number, **how)


def _rotation(axis: Points) -> Points:
    """Rodrigues' formula."""
    angle = float(np.linalg.norm(axis))
    if angle == 0:
        return np.eye(3)
    x, y, z = axis / angle
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.asarray(np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross)


# --- what is printed -------------------------------------------------------------------------


def board_ink(scale: float = 1.0) -> Ink:
    """The ChArUco board, its upper left corner at (0, 0), y down; ``scale``: how it was printed."""
    cells = opencv.draw_board(BOARD, 114)  # a marker's cell is a whole number of pixels
    paper = 12.0

    def ink(points: Points) -> Points:
        at = points / scale
        index = np.floor(at / BOARD.square * 114).astype(int)
        high, wide = cells.shape
        on = ((index >= 0) & (index < [wide, high])).all(axis=1)
        sheet = (at > -paper).all(axis=1) & (
            at < [BOARD.across * BOARD.square + paper, BOARD.down * BOARD.square + paper]
        ).all(axis=1)
        found = np.where(sheet, BRIGHT, np.nan)
        x, y = index[on].T
        found[on] = np.where(cells[y, x] > 127, BRIGHT, DIM)
        return found

    return ink


class Marker(NamedTuple):
    """A marker that lies on the table: its number, middle (mm), side (mm) and turn (degrees)."""

    number: int
    x: float
    y: float
    side: float
    turn: float = 0.0

    def corners(self) -> Points:
        """Clockwise as printed from the upper left (4, 2; mm)."""
        half = self.side / 2
        square = np.array([[-half, half], [half, half], [half, -half], [-half, -half]])
        return np.asarray(square @ _turned(self.turn).T + [self.x, self.y])

    def ink(self, paper: float = 8.0) -> Ink:
        """Its black and white cells, on paper that is wider by so much (mm)."""
        cells = opencv.draw_marker(self.number, 6)

        def ink(points: Points) -> Points:
            at = (points - [self.x, self.y]) @ _turned(self.turn)
            index = np.floor((at + self.side / 2) / self.side * 6).astype(int)
            on = ((index >= 0) & (index < 6)).all(axis=1)
            sheet = (np.abs(at) < self.side / 2 + paper).all(axis=1)
            found = np.where(sheet, BRIGHT, np.nan)
            x, y = index[on].T
            found[on] = np.where(cells[5 - y, x] > 127, BRIGHT, DIM)
            return found

        return ink


def _turned(degrees: float) -> Points:
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return np.array([[c, -s], [s, c]])


def dot_ink(x: float, y: float, radius: float = 6.0) -> Ink:
    """A white disc on the table."""

    def ink(points: Points) -> Points:
        return np.where(np.hypot(*(points - [x, y]).T) < radius, BRIGHT, np.nan)

    return ink


# --- the picture -----------------------------------------------------------------------------


def draw(eye: Eye, shot: Shot, things: list[tuple[Ink, Points]]) -> Pixels:
    """The picture (height, width, 3) of inks, each with points (n, 2; mm) around all of it."""
    width, height = eye.size
    canvas = np.full((height, width), TABLE)
    for ink, around in things:
        _paint(canvas, eye, shot, ink, around)
    smooth = _blurred(canvas, shot.blur) * shot.light
    noise = np.random.default_rng(shot.seed).normal(0.0, shot.noise, canvas.shape)
    grey = np.clip(np.rint(smooth + noise), 0, 255).astype(np.uint8)
    return np.repeat(grey[:, :, None], 3, axis=2)


def _paint(canvas: Points, eye: Eye, shot: Shot, ink: Ink, around: Points) -> None:
    height, width = canvas.shape
    seen = shot.seen(eye, around)
    low = np.clip(np.floor(seen.min(axis=0)) - 3, 0, [width, height]).astype(int)
    high = np.clip(np.ceil(seen.max(axis=0)) + 4, 0, [width, height]).astype(int)
    if (high <= low).any():
        return
    to_plane = np.linalg.inv(
        np.column_stack((shot.rotation[:, 0], shot.rotation[:, 1], shot.translation))
    )

    def inked(pixels: Points) -> Points:
        rays = np.column_stack((eye.rays(pixels), np.ones(len(pixels))))
        hits = rays @ to_plane.T
        return ink(hits[:, :2] / hits[:, 2:])

    columns, rows = np.meshgrid(np.arange(low[0], high[0]), np.arange(low[1], high[1]))
    pixels = np.stack((columns, rows), axis=-1).astype(np.float64)
    found = inked(pixels.reshape(-1, 2)).reshape(columns.shape)
    patch = canvas[low[1] : high[1], low[0] : high[0]]
    edge = _uneven(np.nan_to_num(found, nan=-1.0))
    steps = (np.arange(FINE) + 0.5) / FINE - 0.5
    offsets = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(1, -1, 2)
    fine = inked((pixels[edge][:, None, :] + offsets).reshape(-1, 2)).reshape(-1, FINE * FINE)
    under = patch[edge][:, None]
    patch[~np.isnan(found)] = found[~np.isnan(found)]
    patch[edge] = np.where(np.isnan(fine), under, fine).mean(axis=1)


def _uneven(values: Points) -> NDArray[np.bool_]:
    """Which pixels have a neighbour of another value: those that an edge may cross."""
    padded = np.pad(values, 1, mode="edge")
    rows, columns = values.shape
    near = [padded[y : y + rows, x : x + columns] for y in range(3) for x in range(3)]
    return np.asarray(np.max(near, axis=0) != np.min(near, axis=0))


def _blurred(canvas: Points, sigma: float) -> Points:
    if sigma <= 0:
        return canvas
    reach = max(1, math.ceil(3 * sigma))
    kernel = np.exp(-0.5 * (np.arange(-reach, reach + 1) / sigma) ** 2)
    kernel /= kernel.sum()
    padded = np.pad(canvas, reach, mode="edge")
    rows, columns = canvas.shape
    across = sum(k * padded[:, n : n + columns] for n, k in enumerate(kernel))
    return np.asarray(sum(k * across[n : n + rows] for n, k in enumerate(kernel)))


def picture_of_board(eye: Eye, shot: Shot, scale: float = 1.0) -> Pixels:
    """A picture of the board, printed at ``scale``."""
    size = np.array([BOARD.across, BOARD.down]) * BOARD.square * scale
    edge = np.array([[x, y] for x in (-15.0, size[0] + 15) for y in (-15.0, size[1] + 15)])
    return draw(eye, shot, [(board_ink(scale), edge)])


def picture_of_table(
    eye: Eye, shot: Shot, markers: list[Marker], dots: tuple[tuple[float, float], ...] = ()
) -> Pixels:
    """A picture of a table with markers, and white dots at places (mm)."""
    things = [(one.ink(), one._replace(side=one.side + 20).corners()) for one in markers] + [
        (dot_ink(x, y), np.array([[x - 8, y - 8], [x + 8, y - 8], [x - 8, y + 8], [x + 8, y + 8]]))
        for x, y in dots
    ]
    return draw(eye, shot, things)

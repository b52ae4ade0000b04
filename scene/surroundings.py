"""What is about the things of a random picture: light, bare table, a cheap camera. Seeded, pure.

Colours are linear RGB until `developed`; lengths are table units.
"""

from __future__ import annotations

import math
import random

import numpy as np

from scene.render import Light, smoothed
from scene.sight import Pixels
from scene.solids import Array

# --- table and light --------------------------------------------------------------------------


def random_light(chance: random.Random, gain: float) -> Light:
    """A lamp somewhere above, more or less sharp, tinted; and light from all sides."""
    steep, side = math.radians(chance.uniform(28, 85)), chance.uniform(0, math.tau)
    sun = (math.cos(steep) * math.cos(side), math.cos(steep) * math.sin(side), math.sin(steep))
    share = chance.uniform(0.1, 0.75)
    warm, green = chance.uniform(-0.09, 0.09), chance.uniform(-0.04, 0.04)
    tint = (1 + warm, 1 + green, 1 - warm)
    red, green_, blue = (gain * part for part in tint)
    sky = (1 - share) * 0.95
    strong = share * 1.1
    return Light(
        sun, (strong * red, strong * green_, strong * blue), (sky * red, sky * green_, sky * blue),
        chance.choice((0.0, 1.0, 2.0, 4.0, 8.0)),
    )  # fmt: skip


def random_ground(chance: random.Random, points: Array) -> Array:
    """The bare table (height, width, 3; linear RGB): cloth, wood, paint, with marks and papers."""
    rng = np.random.default_rng(chance.getrandbits(32))
    x, y = points
    base = np.array([chance.uniform(0.2, 0.95)] * 3)
    if chance.random() < 0.4:
        base *= (1.0, chance.uniform(0.75, 0.95), chance.uniform(0.45, 0.85))
    elif chance.random() < 0.35:
        base *= rng.uniform(0.5, 1.0, 3)
    tone = np.ones(x.shape, np.float32)
    angle = chance.uniform(0, math.pi)
    along, across = (
        (x * math.cos(angle) + y * math.sin(angle)),
        (y * math.cos(angle) - x * math.sin(angle)),
    )
    for _ in range(chance.randint(0, 6)):
        pitch, phase = 2 ** chance.uniform(0, 5.5), chance.uniform(0, 7)
        bend = chance.uniform(0, 0.3) * np.sin(chance.uniform(0.5, 3) * along + phase)
        tone += chance.uniform(0, 0.07) * np.sin(pitch * (across + bend) + phase)
    if chance.random() < 0.4:
        grain = rng.normal(0, chance.uniform(0.01, 0.06), x.shape).astype(np.float32)
        tone += smoothed(grain, chance.uniform(0.4, 1.5))
    ground = (base.astype(np.float32) ** 2.2) * tone[..., None]
    if chance.random() < 0.3:
        edge = chance.uniform(0.98, 1.1)
        beyond = (np.abs(x) > edge) | (np.abs(y) > edge)
        ground[beyond] = rng.uniform(0.05, 0.8) * rng.uniform(0.85, 1.0, 3)
    for _ in range(chance.choice((0, 0, 0, 1, 2, 3))):
        _paper(chance, rng, ground, x, y)
    if chance.random() < 0.3:
        _markers(chance, rng, ground, x, y)
    bounded: Array = np.clip(ground, 0.004, 1.0)
    return bounded


def _paper(
    chance: random.Random, rng: np.random.Generator, ground: Array, x: Array, y: Array
) -> None:
    """A flat thing that is not one: a sheet, a line of tape, a stain."""
    px, py, yaw = chance.uniform(-1, 1), chance.uniform(-1, 1), chance.uniform(0, math.pi)
    a = (x - px) * math.cos(yaw) + (y - py) * math.sin(yaw)
    b = (y - py) * math.cos(yaw) - (x - px) * math.sin(yaw)
    form = chance.choice(("sheet", "tape", "stain"))
    long, broad = chance.uniform(0.7, 1.4), chance.uniform(0.6, 1.2)
    if form == "sheet":
        inside, strength = (np.abs(a) < long / 2) & (np.abs(b) < broad / 2), 1.0
    elif form == "tape":
        inside, strength = np.abs(b) < chance.uniform(0.01, 0.05), 1.0
    else:
        inside = (a * a / long**2 + b * b / broad**2) < 0.05
        strength = chance.uniform(0.1, 0.4)
    tone = rng.uniform(0.1, 0.95) * (1 - rng.uniform(0, 0.3, 3))
    ground[inside] += strength * (tone.astype(np.float32) - ground[inside])


def _markers(
    chance: random.Random, rng: np.random.Generator, ground: Array, x: Array, y: Array
) -> None:
    """Square black and white codes in the corners, by which cameras are calibrated."""
    side, away = chance.uniform(0.12, 0.3), chance.uniform(0.8, 1.05)
    for sx in (-1, 1):
        for sy in (-1, 1):
            bits = np.zeros((8, 8))
            bits[2:6, 2:6] = rng.integers(0, 2, (4, 4))
            bits[[0, 7]], bits[:, [0, 7]] = 1, 1
            a = np.floor((x - sx * away) / side * 8 + 4).astype(int)
            b = np.floor((y - sy * away) / side * 8 + 4).astype(int)
            inside = (a >= 0) & (a < 8) & (b >= 0) & (b < 8)
            ground[inside] = 0.03 + 0.8 * bits[b[inside], a[inside], None]


# --- the camera's faults ----------------------------------------------------------------------


def developed(chance: random.Random, linear: Array, faults: float = 1.0) -> Pixels:
    """What a camera makes of light: (height, width, 3) uint8; ``faults`` 0 makes a perfect one."""
    rng = np.random.default_rng(chance.getrandbits(32))
    if faults and chance.random() < 0.8:
        linear = smoothed(linear, faults * chance.uniform(0.3, 1.2))
    bright = linear.mean()
    noise = faults * chance.uniform(0, 0.012)
    strength = (
        noise * (0.3 + np.sqrt(np.clip(linear, 0, 1.5) + 0.02)) * min(2.0, max(0.5, 0.3 / bright))
    )
    linear = linear + rng.normal(0, 1, linear.shape).astype(np.float32) * strength
    shown: Array = np.clip(linear, 0, 1) ** (1 / 2.2)
    if faults and chance.random() < 0.6:
        shown = compressed(shown, chance.uniform(0.01, 0.06) * faults)
    result: Pixels = (np.clip(shown, 0, 1) * 255 + 0.5).astype(np.uint8)
    return result


def compressed(pixels: Array, coarse: float) -> Array:
    """What is lost in 8 x 8 blocks of cosines, finer ones coarser, as in a JPEG file."""
    k = np.arange(8)
    basis = np.sqrt(2 / 8) * np.cos(np.pi * (2 * k[None] + 1) * k[:, None] / 16)
    basis[0] /= math.sqrt(2)
    basis = basis.astype(np.float32)
    high, wide = pixels.shape[0] // 8 * 8, pixels.shape[1] // 8 * 8
    blocks = pixels[:high, :wide].reshape(high // 8, 8, wide // 8, 8, 3)
    waves = np.tensordot(np.tensordot(blocks, basis, (1, 1)), basis, (2, 1))
    step = coarse * (1 + 0.5 * (k[:, None] + k[None])).astype(np.float32)
    kept = np.round(waves / step) * step
    restored = np.tensordot(np.tensordot(kept, basis, (3, 0)), basis, (3, 0))
    restored = restored.transpose(0, 3, 1, 4, 2)
    result = pixels.copy()
    result[:high, :wide] = restored.reshape(high, wide, 3)
    return result

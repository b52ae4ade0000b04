"""A batch of lessons as it is shown this time: turned, mirrored, re-lit (torch, on any device)."""

from __future__ import annotations

import math

import torch
from torch import Tensor

from scene.rectify import BRIGHTEST, Grid


def turned(
    levels: Tensor, cameras: Tensor, rows: Tensor, ways: Tensor
) -> tuple[Tensor, Tensor, Tensor]:
    """Pictures (b, size, size, 3), cameras (b, 3) and rows of `scene.truth`, each another way.

    ``ways`` (b, 3), bool: mirrored left to right, far to near, and about the diagonal.
    """
    for axis, way in enumerate(ways.unbind(1)):
        flipped = levels.transpose(1, 2) if axis == 2 else levels.flip(2 - axis)
        levels = torch.where(way[:, None, None, None], flipped, levels)
        cameras = torch.where(way[:, None], _mirrored(cameras, axis), cameras)
        known = _mirrored(rows, axis)
        known[..., 5] = (math.pi, 0.0, -math.pi / 2)[axis] - rows[..., 5]
        rows = torch.where(way[:, None, None], known, rows)
    return levels, cameras, rows


def _mirrored(values: Tensor, axis: int) -> Tensor:
    """The same (..., x and y and more) on the other side."""
    values = values.clone()
    if axis == 2:
        values[..., :2] = -values[..., :2].flip(-1)
    else:
        values[..., axis] = -values[..., axis]
    return values


def relit(levels: Tensor) -> Tensor:
    """Pictures (b, size, size, 3; uint8) in another light, as floats in [0, 1].

    Brighter or darker, tinted, of another contrast, some of them noisier; black stays black.
    """
    shown = levels.any(-1, keepdim=True)
    many, device = len(levels), levels.device

    def drawn(low: float, high: float, channels: int = 1) -> Tensor:
        return low + (high - low) * torch.rand((many, 1, 1, channels), device=device)

    gain = torch.exp(drawn(-0.45, 0.35)) * drawn(0.94, 1.06, 3)
    lit = (gain * (levels.float() / 255) ** drawn(0.85, 1.2)).clamp(max=1.0)
    grain = drawn(0.004, 0.024) * (drawn(0, 1) < 0.3)
    return (lit + grain * torch.randn_like(lit)).clamp(0, 1) * shown


def planes(lit: Tensor, shown: Tensor, cameras: Tensor, grid: Grid) -> Tensor:
    """The network's input (b, 5, size, size): `scene.rectify.planes` of many pictures in [0, 1]."""
    mean = lit.sum((1, 2, 3)) / (3 * shown.sum((1, 2, 3)).clamp(min=1))
    relative = (lit / mean.clamp(min=1 / 255)[:, None, None, None]).clamp(max=BRIGHTEST)
    colors = (relative - shown.float()).permute(0, 3, 1, 2)
    steps = (torch.arange(grid.size, device=lit.device) - (grid.size - 1) / 2) * grid.pixel
    x, y, z = cameras.unbind(1)
    across = (steps - x[:, None]) / z[:, None]
    down = (steps + y[:, None]) / z[:, None]
    lean = torch.stack([
        across[:, None, :].expand(-1, grid.size, -1), down[:, :, None].expand(-1, -1, grid.size),
    ], 1)  # fmt: skip
    return torch.cat([colors, lean], 1).contiguous(memory_format=torch.channels_last)

"""What the detector's network should say of pictures, cell by cell (torch, on any device).

Pictures come as rows of things (`scene.truth`); everything has the same shape whatever is on the
table, so that nothing waits for the device that learns.
"""

from __future__ import annotations

from typing import NamedTuple

import torch
from torch import Tensor

from scene.detector_net import STRIDE
from scene.pictured import SHOWN
from scene.rectify import Grid
from scene.truth import COLUMNS

AROUND = 9
"""Cells that answer for a thing: where its middle shows, and those about it."""
AWAY = ((0, 0), (0, -1), (0, 1), (-1, 0), (1, 0), (-1, -1), (-1, 1), (1, -1), (1, 1))
WEIGHT = (1.0, *(0.5,) * 4, *(0.25,) * 4)
SEEN, KIND = COLUMNS.index("seen"), COLUMNS.index("kind")


class Targets(NamedTuple):
    """``heat``, ``mind`` (b, cells, cells): 1 where a middle shows; 0 where nothing is asked.

    For n answers, `AROUND` for each row of a thing: ``where`` (its cell's number in the batch) and
    ``weight`` (0: none), ``place`` (n, 2), ``shape`` (n, 7) as in `scene.detector_net.Maps`,
    ``kind``, ``color``, ``look`` (n).
    """

    heat: Tensor
    mind: Tensor
    where: Tensor
    weight: Tensor
    place: Tensor
    shape: Tensor
    kind: Tensor
    color: Tensor
    look: Tensor


def targets(rows: Tensor, cameras: Tensor, grid: Grid) -> Targets:
    """The answers wanted for pictures with ``rows`` (b, things, columns), ``cameras`` (b, 3)."""
    cells, unit = grid.size // STRIDE, STRIDE * grid.pixel
    there = rows[..., SEEN] >= 0
    middle, stand = _cells(middles(rows, cameras), unit, cells), _cells(rows[..., :2], unit, cells)
    at = middle.round()
    inside = there & (at >= 0).all(-1) & (at < cells).all(-1)
    asked = inside & (rows[..., SEEN] >= SHOWN)
    heat, mind = _heat(rows, at, asked, inside & ~asked, unit, cells)
    offsets = torch.tensor(AWAY, device=rows.device, dtype=rows.dtype)
    near = at[:, :, None] + offsets
    valid = asked[..., None] & (near >= 0).all(-1) & (near < cells).all(-1)
    clipped = near.clamp(0, cells - 1).long()
    batch = torch.arange(len(rows), device=rows.device)[:, None, None]
    where = (batch * cells + clipped[..., 1]) * cells + clipped[..., 0]
    weight = torch.tensor(WEIGHT, device=rows.device) * valid
    known = rows[:, :, None, KIND:].expand(-1, -1, AROUND, -1).reshape(-1, 3).long()
    shape = _shapes(rows, unit)[:, :, None].expand(-1, -1, AROUND, -1)
    return Targets(
        heat, mind, where.reshape(-1), weight.reshape(-1),
        (stand[:, :, None] - near).reshape(-1, 2), shape.reshape(-1, 7), *known.unbind(1),
    )  # fmt: skip


def middles(rows: Tensor, cameras: Tensor) -> Tensor:
    """Where on the table (b, things, 2) the middles of things, at half their height, show."""
    high = cameras[:, None, 2:]
    half = torch.minimum(rows[..., 4:5] / 2, 0.8 * high)
    return cameras[:, None, :2] + (rows[..., :2] - cameras[:, None, :2]) * (high / (high - half))


def _cells(points: Tensor, unit: float, cells: int) -> Tensor:
    """Column and row, in cells, of points of the table (..., 2)."""
    signs = torch.tensor((1.0, -1.0), device=points.device)
    return points * signs / unit + (cells - 1) / 2


def _heat(
    rows: Tensor, at: Tensor, asked: Tensor, hidden: Tensor, unit: float, cells: int
) -> tuple[Tensor, Tensor]:
    """Bumps over the middles of things (b, cells, cells), and where they are minded."""
    spread = (rows[..., 3] / unit / 5).clamp(0.6, 2.2)[..., None]
    steps = torch.arange(cells, device=rows.device, dtype=rows.dtype)
    across, down = (
        torch.exp(-0.5 * ((steps - at[..., axis, None]) / spread) ** 2) for axis in (0, 1)
    )
    bumps = down[..., :, None] * across[..., None, :]
    heat = (bumps * asked[..., None, None]).amax(1)
    quiet = (bumps * hidden[..., None, None]).amax(1) > 0.02
    return heat, 1.0 - (quiet & (heat < 1)).to(heat.dtype)


def _shapes(rows: Tensor, unit: float) -> Tensor:
    """Logs of the sizes in cells, and the angle doubled and fourfold, as far as it can be seen."""
    sizes, turn, angular = rows[..., 2:5], rows[..., 5], 1 - rows[..., 6]
    longer = ((sizes[..., 0] / sizes[..., 1].clamp(min=1e-6) - 1) / 0.3).clamp(0, 1) * angular
    angles = torch.stack([
        longer * torch.cos(2 * turn), longer * torch.sin(2 * turn),
        angular * torch.cos(4 * turn), angular * torch.sin(4 * turn),
    ], -1)  # fmt: skip
    return torch.cat([torch.log(sizes.clamp(min=1e-6) / unit), angles], -1)

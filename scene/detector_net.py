"""The detector's network (torch): a small depthwise CNN from 5 planes to maps at a quarter size.

Of each cell of 4 x 4 pixels it says whether the middle of a thing shows there, of what kind, and,
for the thing whose middle it is, where it stands on the table, how large it is and how it lies.
A thing's middle leans away from the camera by its height: the network gives a height, and the
graph itself multiplies it by the lean (design: robot.md section 6).
"""

from __future__ import annotations

from typing import NamedTuple

import torch
from torch import Tensor, nn
from torch.nn import functional

STRIDE = 4
"""Pixels a side of a cell."""
FEATURE = 32
RARE = -4.0
"""Most cells show no middle of a thing: the logit that training begins from."""


class Maps(NamedTuple):
    """What the network says of each cell; all (batch, channels, rows, columns).

    ``thing``: logit that a thing's middle is here (1). ``kind``: logits of kinds. ``place``: right
    and down from the cell's middle to the footprint's, in cells; the log of that's mean error; the
    logit of how much of the rectangle told is the true one's (4). ``shape``: log of long and short
    side and height, in cells; cosine and sine of twice and of four times the long side's angle (7).
    ``color``: logits. ``feature``: not yet of length 1.
    """

    thing: Tensor
    kind: Tensor
    place: Tensor
    shape: Tensor
    color: Tensor
    feature: Tensor


def _dense(wide: int, out: int, stride: int = 1) -> nn.Sequential:
    """A convolution over 3 x 3 cells and all channels: onnxruntime's fastest per weight."""
    return nn.Sequential(nn.Conv2d(wide, out, 3, stride, 1, bias=False), nn.BatchNorm2d(out))


def _light(wide: int, out: int, kernel: int = 5) -> nn.Sequential:
    """Depthwise and pointwise convolution, each with batch normalisation."""
    return nn.Sequential(
        nn.Conv2d(wide, wide, kernel, 1, kernel // 2, groups=wide, bias=False),
        nn.BatchNorm2d(wide),
        nn.ReLU(inplace=True),
        nn.Conv2d(wide, out, 1, bias=False),
        nn.BatchNorm2d(out),
    )


class _Added(nn.Module):
    """A layer whose result is added to its input."""

    def __init__(self, layer: nn.Module) -> None:
        super().__init__()
        self.layer = layer

    def forward(self, x: Tensor) -> Tensor:
        return functional.relu(x + self.layer(x))


def _stage(wide: int, out: int, *layers: nn.Module) -> nn.Sequential:
    """Half the size, then layers that add to it."""
    first = (_dense(wide, out, 2), nn.ReLU(inplace=True))
    return nn.Sequential(*first, *(_Added(layer) for layer in layers))


class Net(nn.Module):
    """(batch, 5, size, size), size a multiple of 16, to `Maps` at size / 4."""

    def __init__(self, kinds: int, colors: int) -> None:
        super().__init__()
        self.parts = [1, kinds, 5, 7, colors, FEATURE]
        self.stem = nn.Sequential(_dense(5, 24, 2), nn.ReLU(inplace=True))
        self.quarter = _stage(24, 48, _light(48, 48))
        self.eighth = _stage(48, 96, _light(96, 96), _dense(96, 96), _light(96, 96))
        self.sixteenth = _stage(96, 160, *(_light(160, 160) for _ in range(4)))
        self.down8, self.side8 = nn.Conv2d(160, 96, 1), nn.Conv2d(96, 96, 1)
        self.mix8 = _Added(_light(96, 96))
        self.down4, self.side4 = nn.Conv2d(96, 64, 1), nn.Conv2d(48, 64, 1)
        self.mix4 = nn.Sequential(_Added(_light(64, 64)), _Added(_light(64, 64)))
        self.head = nn.Sequential(_light(66, 96), nn.ReLU(inplace=True))
        self.out = nn.Conv2d(96, sum(self.parts), 1)
        if self.out.bias is not None:
            nn.init.constant_(self.out.bias[:1], RARE)

    def forward(self, planes: Tensor) -> Maps:
        return self.read(self.seen(planes), planes)

    def seen(self, planes: Tensor) -> Tensor:
        """What there is at each cell, for `read`: half the precision is enough for it."""
        quarter = self.quarter(self.stem(planes))
        eighth = self.eighth(quarter)
        sixteenth = self.sixteenth(eighth)
        x = self.mix8(functional.relu(self.side8(eighth) + _twice(self.down8(sixteenth))))
        x = self.mix4(functional.relu(self.side4(quarter) + _twice(self.down4(x))))
        head: Tensor = self.head(torch.cat([x, _lean(planes).to(x.dtype)], 1))
        return head

    def read(self, seen: Tensor, planes: Tensor) -> Maps:
        """The maps; a footprint lies below the middle that shows, by its height along the lean."""
        x = self.out(seen)
        thing, kind, place, shape, color, feature = torch.split(x, self.parts, 1)
        # 5 channels: right and down to the middle that shows, its height, error, overlap
        stands = place[:, :2] - _lean(planes) * (4 * functional.softplus(place[:, 2:3]))
        return Maps(thing, kind, torch.cat([stands, place[:, 3:]], 1), shape, color, feature)


def _lean(planes: Tensor) -> Tensor:
    return functional.avg_pool2d(planes[:, 3:], STRIDE)


def _twice(x: Tensor) -> Tensor:
    return functional.interpolate(x, scale_factor=2.0, mode="nearest")


class Served(nn.Module):
    """The network as it is served: heat maps of kinds and overlaps instead of logits."""

    def __init__(self, net: Net) -> None:
        super().__init__()
        self.net = net

    def forward(self, planes: Tensor) -> tuple[Tensor, Tensor, Tensor, Tensor, Tensor]:
        """``heat`` (1, kinds, rows, columns) in [0, 1], and place, shape, color, feature."""
        maps = self.net(planes)
        heat = torch.sigmoid(maps.thing) * torch.softmax(maps.kind, 1)
        place = torch.cat([maps.place[:, :3], torch.sigmoid(maps.place[:, 3:])], 1)
        return heat, place, maps.shape, maps.color, maps.feature

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
    and down from the cell's middle to the footprint's, in cells, and the log of that's mean error
    (3). ``shape``: log of long and short side and height, in cells; cosine and sine of twice and
    of four times the long side's angle (7). ``color``: logits. ``feature``: not yet of length 1.
    """

    thing: Tensor
    kind: Tensor
    place: Tensor
    shape: Tensor
    color: Tensor
    feature: Tensor


class _Layer(nn.Sequential):
    """Depthwise and pointwise convolution, each with batch normalisation."""

    def __init__(self, wide: int, out: int, kernel: int = 3, stride: int = 1) -> None:
        super().__init__(
            nn.Conv2d(wide, wide, kernel, stride, kernel // 2, groups=wide, bias=False),
            nn.BatchNorm2d(wide),
            nn.ReLU(inplace=True),
            nn.Conv2d(wide, out, 1, bias=False),
            nn.BatchNorm2d(out),
        )


class _Block(nn.Module):
    """A layer whose result is added to its input."""

    def __init__(self, wide: int, kernel: int = 3) -> None:
        super().__init__()
        self.layer = _Layer(wide, wide, kernel)

    def forward(self, x: Tensor) -> Tensor:
        return functional.relu(x + self.layer(x))


class Net(nn.Module):
    """(batch, 5, size, size), size a multiple of 16, to `Maps` at size / 4."""

    def __init__(self, kinds: int, colors: int) -> None:
        super().__init__()
        self.parts = [1, kinds, 4, 7, colors, FEATURE]
        self.stem = nn.Sequential(
            nn.Conv2d(5, 20, 3, 2, 1, bias=False), nn.BatchNorm2d(20), nn.ReLU(inplace=True)
        )
        self.quarter = nn.Sequential(_Layer(20, 40, 5, 2), nn.ReLU(inplace=True), _Block(40))
        self.eighth = nn.Sequential(
            _Layer(40, 64, 5, 2), nn.ReLU(inplace=True), _Block(64), _Block(64)
        )
        self.sixteenth = nn.Sequential(
            _Layer(64, 96, 5, 2), nn.ReLU(inplace=True), _Block(96, 5), _Block(96, 5)
        )
        self.down8, self.side8 = nn.Conv2d(96, 64, 1), nn.Conv2d(64, 64, 1)
        self.mix8 = _Block(64, 5)
        self.down4, self.side4 = nn.Conv2d(64, 56, 1), nn.Conv2d(40, 56, 1)
        self.mix4 = _Block(56, 5)
        self.head = nn.Sequential(_Layer(58, 80, 5), nn.ReLU(inplace=True))
        self.out = nn.Conv2d(80, sum(self.parts), 1)
        if self.out.bias is not None:
            nn.init.constant_(self.out.bias[:1], RARE)

    def forward(self, planes: Tensor) -> Maps:
        quarter = self.quarter(self.stem(planes))
        eighth = self.eighth(quarter)
        sixteenth = self.sixteenth(eighth)
        x = self.mix8(functional.relu(self.side8(eighth) + _twice(self.down8(sixteenth))))
        x = self.mix4(functional.relu(self.side4(quarter) + _twice(self.down4(x))))
        lean = functional.avg_pool2d(planes[:, 3:], STRIDE)
        x = self.out(self.head(torch.cat([x, lean], 1)))
        thing, kind, place, shape, color, feature = torch.split(x, self.parts, 1)
        # 4 channels: right and down to the middle that shows, its height, the log of the error
        stands = place[:, :2] - lean * (4 * functional.softplus(place[:, 2:3]))
        return Maps(thing, kind, torch.cat([stands, place[:, 3:]], 1), shape, color, feature)


def _twice(x: Tensor) -> Tensor:
    return functional.interpolate(x, scale_factor=2.0, mode="nearest")


class Served(nn.Module):
    """The network as it is served: heat maps of kinds instead of two kinds of logits."""

    def __init__(self, net: Net) -> None:
        super().__init__()
        self.net = net

    def forward(self, planes: Tensor) -> tuple[Tensor, Tensor, Tensor, Tensor, Tensor]:
        """``heat`` (1, kinds, rows, columns) in [0, 1], and place, shape, color, feature."""
        maps = self.net(planes)
        heat = torch.sigmoid(maps.thing) * torch.softmax(maps.kind, 1)
        return heat, maps.place, maps.shape, maps.color, maps.feature

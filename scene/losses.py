"""What the detector's network is wrong in, as numbers to make small (torch)."""

from __future__ import annotations

import torch
from torch import Tensor
from torch.nn import functional

from scene.detector_net import Maps
from scene.targets import Targets
from scene.truth import UNKNOWN

SHARP = 14.0
"""How sharply the proxies of looks are told apart by cosine."""
NAMES = ("thing", "kind", "place", "error", "shape", "color", "look", "overlap")


def losses(maps: Maps, wanted: Targets, proxies: Tensor) -> Tensor:
    """Each of `NAMES`, weighed. ``proxies`` (looks, features): where each look's are drawn to."""
    near = [_gathered(one, wanted.where) for one in maps[1:]]
    kind, place, shape, color, feature = near
    weight = wanted.weight / wanted.weight.sum().clamp(min=1)
    away = (place[:, :2] - wanted.place).abs()
    sure = place[:, 2].clamp(-5, 3)
    error = away.detach().mean(1) * torch.exp(-sure) + sure
    # a rectangle's overlap suffers from an error by its share of the short side
    strict = 0.5 + 1.5 * torch.exp(-wanted.shape[:, 1]).clamp(max=2)
    cosines = functional.normalize(feature) @ functional.normalize(proxies).T
    shared = overlap(place[:, :2].detach() - wanted.place, shape.detach(), wanted.shape)
    told = functional.binary_cross_entropy_with_logits(place[:, 3], shared, reduction="none")
    return torch.stack([
        _focal(maps.thing[:, 0], wanted.heat, wanted.mind),
        _asked(kind, wanted.kind, weight),
        (weight * strict * away.sum(1)).sum(),
        0.1 * (weight * error).sum(),
        (weight * _shape_error(shape, wanted.shape)).sum(),
        0.2 * _asked(color, wanted.color, weight),
        0.1 * _asked(SHARP * cosines, wanted.look, weight),
        0.2 * (weight * told).sum(),
    ])  # fmt: skip


def overlap(away: Tensor, shape: Tensor, wanted: Tensor) -> Tensor:
    """About how much (n) of both rectangles is common to both; turns count by their sine."""
    sides, true = (torch.exp(one[:, :2].clamp(-3, 4)) for one in (shape, wanted))
    twist = 0.25 * _angle(shape, wanted)
    cos, sin = torch.cos(_turn(wanted)), torch.sin(_turn(wanted))
    right, up = away[:, 0], -away[:, 1]
    along = torch.stack([cos * right + sin * up, cos * up - sin * right], 1).abs()
    common = (torch.minimum(torch.minimum(sides, true), (sides + true) / 2 - along)).clamp(min=0)
    both = common.prod(1)
    whole = both / (sides.prod(1) + true.prod(1) - both)
    return (whole * (1 - twist * true[:, 0] / true[:, 1]).clamp(0.3, 1)).clamp(0, 1)


def _turn(wanted: Tensor) -> Tensor:
    """The long side's angle; 0 where there is none."""
    return torch.atan2(wanted[:, 4], wanted[:, 3]) / 2


def _angle(shape: Tensor, wanted: Tensor) -> Tensor:
    """By how much (radians) the fourfold angles differ, divided by four; 0 for round things."""
    turned = torch.atan2(shape[:, 6], shape[:, 5]) - torch.atan2(wanted[:, 6], wanted[:, 5])
    angular = (wanted[:, 5:].abs().sum(1) > 0).float()
    return torch.atan2(torch.sin(turned), torch.cos(turned)).abs() / 4 * angular


def _gathered(maps: Tensor, where: Tensor) -> Tensor:
    """The channels (m, channels) at numbered cells of a batch of maps."""
    return maps.permute(0, 2, 3, 1).reshape(-1, maps.shape[1])[where]


def _focal(logits: Tensor, heat: Tensor, mind: Tensor) -> Tensor:
    """Penalty-reduced focal loss over the cells, per thing."""
    chance = torch.sigmoid(logits).clamp(1e-5, 1 - 1e-5)
    here = (heat == 1).float()
    hit = here * (1 - chance) ** 2 * torch.log(chance)
    false = (1 - here) * (1 - heat) ** 4 * chance**2 * torch.log(1 - chance)
    return -(mind * (hit + false)).sum() / here.sum().clamp(min=1)


def _shape_error(shape: Tensor, wanted: Tensor) -> Tensor:
    away = (shape - wanted).abs()
    return 4 * (away[:, 0] + away[:, 1]) + 2 * away[:, 2] + 0.7 * away[:, 3:].sum(1)


def _asked(logits: Tensor, wanted: Tensor, weight: Tensor) -> Tensor:
    """Cross entropy where an answer is asked for."""
    each = functional.cross_entropy(logits, wanted, reduction="none", ignore_index=UNKNOWN)
    return (weight * each).sum()

"""Low-rank adapters on the linear layers of a pretrained model: what is learnt is small and ours.

E. J. Hu et al., "LoRA: Low-Rank Adaptation of Large Language Models", arXiv 2106.09685: a frozen
weight W (out, in) is read as W + up @ down, with down (rank, in) drawn at random and up (out, rank)
zero at first. `merge` puts what was learnt into W, so that serving costs nothing more.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import torch
from torch import Tensor, nn

SCALE = ".scale"
"""What a weight kept in 8 bits has beside it: for each row, what one step of it is."""


class Adapted(nn.Module):
    """A frozen linear layer with a low-rank addition: (..., in) -> (..., out)."""

    def __init__(self, frozen: nn.Linear, rank: int) -> None:
        super().__init__()
        self.frozen = frozen.requires_grad_(False)
        bound = 1 / math.sqrt(frozen.in_features)
        device = frozen.weight.device
        self.down = nn.Parameter(
            torch.empty(rank, frozen.in_features, device=device).uniform_(-bound, bound)
        )
        self.up = nn.Parameter(torch.zeros(frozen.out_features, rank, device=device))

    def forward(self, states: Tensor) -> Tensor:
        """states (..., in) -> (..., out)."""
        added = nn.functional.linear(nn.functional.linear(states, self.down), self.up)
        told: Tensor = self.frozen(states) + added
        return told


def adapt(model: nn.Module, rank: int) -> None:
    """Put an adapter of this rank on every linear layer of a model, in place."""
    for name, layer in list(model.named_modules()):
        if isinstance(layer, nn.Linear):
            holder, _, field = name.rpartition(".")
            setattr(model.get_submodule(holder), field, Adapted(layer, rank))


def learnt(model: nn.Module) -> dict[str, Tensor]:
    """The adapters of an adapted model by the layer's name: ``NAME.down``, ``NAME.up``."""
    return {
        f"{name}.{half}": getattr(layer, half)
        for name, layer in model.named_modules()
        if isinstance(layer, Adapted)
        for half in ("down", "up")
    }


def merge(model: nn.Module, adapters: Mapping[str, Tensor]) -> None:
    """Add what `learnt` gave to the weights of a model without adapters, in place.

    Raises KeyError for a layer that the model does not have, RuntimeError for one of other sizes.
    """
    layers = dict(model.named_modules())
    for key in adapters:
        name, _, half = key.rpartition(".")
        if half == "up":
            weight = layers[name].weight
            assert isinstance(weight, Tensor)
            added = adapters[key].float() @ adapters[f"{name}.down"].float()
            weight.data += added.to(weight)


def small(weights: Mapping[str, Tensor]) -> dict[str, Tensor]:
    """Weights (rows, columns) in 8 bits, with a scale for each row beside them."""
    kept = {}
    for name, weight in weights.items():
        step = weight.float().abs().amax(1, keepdim=True).clamp(min=1e-12) / 127
        kept[name] = (weight.float() / step).round().to(torch.int8)
        kept[name + SCALE] = step.to(torch.float32)
    return kept


def whole(weights: Mapping[str, Tensor]) -> dict[str, Tensor]:
    """What `small` was given, as nearly as it kept it; weights without a scale as they are."""
    return {
        name: weight.float() * weights[name + SCALE] if name + SCALE in weights else weight
        for name, weight in weights.items()
        if not name.endswith(SCALE)
    }

"""Train the detector's network (torch, needs the ``[train]`` extra) on pictures that are passed in.

Each picture is turned, mirrored and re-lit at random each time it is shown. Goes on from
``checkpoint.pt`` where there is one; ``detector.onnx`` is written at the end.
"""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import msgspec
import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor
from torch.nn import functional

from scene.colors import SEEN_COLORS
from scene.detector_net import FEATURE, Maps, Net
from scene.export_detector import export
from scene.peaks import OTHER
from scene.pictured import Label
from scene.rectify import Grid, Planes, planes
from scene.shapes import KINDS
from scene.sight import Pixels
from scene.targets import UNKNOWN, Targets, Truth, targets, truth, turned

GRID = Grid(240, 2.0)
NAMES = (*KINDS, OTHER)
ROUND = 1000
"""Pictures shown between two savings."""
SHARP = 14.0
"""How sharply the proxies of looks are told apart by cosine."""


class Lessons(NamedTuple):
    """Pictures rectified by `GRID` (n, size, size, 3), cameras (n, 3; table units), labels."""

    levels: Pixels
    cameras: NDArray[np.float64]
    labels: tuple[tuple[Label, ...], ...]


class Course(msgspec.Struct, frozen=True, kw_only=True):
    """How to train: saved as ``course.json`` beside the weights.

    A round is 1,000 of the pictures, drawn anew. The rate rises in the first round, and falls to
    nothing from ``falls`` of the rounds on; a course may be gone on with as a longer one.
    """

    pictures: int = 3400
    rounds: int = 30
    batch: int = 16
    falls: float = 0.4
    rate: float = 4e-3
    decay: float = 1e-4
    threads: int = 1
    seed: int = 0


class _Batch(NamedTuple):
    planes: Tensor
    heat: Tensor
    mind: Tensor
    where: Tensor
    weight: Tensor
    place: Tensor
    shape: Tensor
    kind: Tensor
    color: Tensor
    look: Tensor


def train(lessons: Lessons, course: Course, out: Path) -> Path:
    """Train and write ``detector.onnx`` into ``out``; returns its path."""
    torch.set_num_threads(course.threads)
    torch.manual_seed(course.seed)
    out.mkdir(parents=True, exist_ok=True)
    (out / "course.json").write_bytes(msgspec.json.format(msgspec.json.encode(course)))
    looks = _looks(lessons)
    known = [
        truth(labels, (x, y, z), NAMES, SEEN_COLORS, looks)
        for labels, (x, y, z) in zip(lessons.labels, lessons.cameras.tolist(), strict=True)
    ]
    learner = _Learner(course, len(looks), out / "checkpoint.pt")
    for number in range(learner.rounds, course.rounds):
        began = time.monotonic()
        means = learner.round(lessons.levels, known)
        told = " ".join(f"{mean:.3f}" for mean in means)
        print(f"round {number + 1}: {told} ({time.monotonic() - began:.0f} s)", flush=True)
    return export(learner.net, out / "detector.onnx", GRID, NAMES, SEEN_COLORS)


class _Learner:
    """The network and all that training it needs, as after ``rounds`` rounds; saved after each.

    ``proxies`` (looks, features): where the features of each look are drawn to.
    """

    def __init__(self, course: Course, looks: int, kept: Path) -> None:
        self.course, self.kept, self.rounds = course, kept, 0
        self.net = Net(len(NAMES), len(SEEN_COLORS))
        self.net.to(memory_format=torch.channels_last)
        self.proxies = torch.nn.Parameter(torch.randn(looks, FEATURE))
        self.learnt = [*self.net.parameters(), self.proxies]
        self.optimiser = torch.optim.AdamW(self.learnt, lr=course.rate, weight_decay=course.decay)
        if kept.exists():
            state = torch.load(kept, weights_only=True)
            self.rounds = int(state["round"])
            self.net.load_state_dict(state["net"])
            self.optimiser.load_state_dict(state["optimiser"])
            self.proxies.data = state["proxies"]

    def round(self, levels: Pixels, known: Sequence[Truth]) -> list[float]:
        """One more round; returns the means of the losses."""
        rng = np.random.default_rng((self.course.seed, self.rounds))
        order, size = rng.permutation(len(known)), self.course.batch
        steps = min(ROUND, len(known)) // size
        self.net.train()
        sums = np.zeros(7)
        for step in range(steps):
            chosen = order[step * size : (step + 1) * size]
            batch = _batch([_shown(levels[i], known[i], rng) for i in chosen])
            sums += self._step(batch, _pace(self.rounds + step / steps, self.course))
        self.rounds += 1
        torch.save(
            {
                "round": self.rounds,
                "net": self.net.state_dict(),
                "proxies": self.proxies.data,
                "optimiser": self.optimiser.state_dict(),
            },
            self.kept,
        )
        means: list[float] = (sums / steps).tolist()
        return means

    def _step(self, batch: _Batch, pace: float) -> list[float]:
        for group in self.optimiser.param_groups:
            group["lr"] = self.course.rate * pace
        losses = _losses(self.net(batch.planes), batch, self.proxies)
        self.optimiser.zero_grad()
        torch.autograd.backward(torch.stack(losses).sum())
        torch.nn.utils.clip_grad_norm_(self.learnt, 5.0)
        self.optimiser.step()
        return [float(loss.detach()) for loss in losses]


def _pace(rounds: float, course: Course) -> float:
    """The share of the full rate after so many rounds."""
    fall = course.falls * course.rounds
    return min(1.0, 0.05 + rounds, max(0.0, course.rounds - rounds) / (course.rounds - fall))


def _looks(lessons: Lessons) -> dict[str, int]:
    """A number for each look that appears on several pictures."""
    seen: dict[str, int] = {}
    for labels in lessons.labels:
        for one in labels:
            seen[one.look] = seen.get(one.look, 0) + 1
    return {look: n for n, look in enumerate(sorted(k for k, v in seen.items() if k and v > 5))}


def _shown(level: Pixels, known: Truth, rng: np.random.Generator) -> tuple[Planes, Targets]:
    """A picture as it is shown this time, and what is to be said of it."""
    level, known = turned(level, known, int(rng.integers(4)), bool(rng.integers(2)))
    return planes(_relit(level, rng), known.camera, GRID), targets(known, GRID)


def _relit(level: Pixels, rng: np.random.Generator) -> Pixels:
    """The picture in another light: brighter or darker, tinted, of another contrast, noisier."""
    gain = math.exp(rng.uniform(-0.45, 0.35)) * rng.uniform(0.94, 1.06, 3)
    table = np.arange(256) / 255
    shown = [255 * np.minimum(1, g * table ** rng.uniform(0.85, 1.2)) for g in gain]
    relit = np.stack([curve[level[..., c]] for c, curve in enumerate(shown)], -1)
    if rng.random() < 0.3:
        relit += rng.normal(0, rng.uniform(1, 6), relit.shape)
    result: Pixels = np.clip(relit, 0, 255).astype(np.uint8)
    result[~level.any(2)] = 0
    return result


def _batch(parts: list[tuple[Planes, Targets]]) -> _Batch:
    wanted = [target for _, target in parts]
    area = wanted[0].heat.size
    where = np.concatenate([one.cell + n * area for n, one in enumerate(wanted)])

    def joined(name: str) -> Tensor:
        return torch.from_numpy(np.concatenate([getattr(one, name) for one in wanted]))

    shown = torch.from_numpy(np.stack([picture for picture, _ in parts]))
    return _Batch(
        shown.contiguous(memory_format=torch.channels_last),
        torch.from_numpy(np.stack([one.heat for one in wanted])),
        torch.from_numpy(np.stack([one.mind for one in wanted])),
        torch.from_numpy(where),
        *(joined(name) for name in ("weight", "place", "shape", "kind", "color", "look")),
    )


def _losses(maps: Maps, batch: _Batch, proxies: Tensor) -> list[Tensor]:
    """Of things, kinds, places, their errors, shapes, colours, looks."""
    near = [_gathered(one, batch.where) for one in maps[1:]]
    kind, place, shape, color, feature = near
    weight = batch.weight / batch.weight.sum().clamp(min=1)
    away = (place[:, :2] - batch.place).abs()
    sure = place[:, 2].clamp(-5, 3)
    error = away.detach().mean(1) * torch.exp(-sure) + sure
    cosines = functional.normalize(feature) @ functional.normalize(proxies).T
    return [
        _focal(maps.thing[:, 0], batch.heat, batch.mind),
        (weight * functional.cross_entropy(kind, batch.kind, reduction="none")).sum(),
        (weight * away.sum(1)).sum(),
        0.1 * (weight * error).sum(),
        (weight * _shape_error(shape, batch.shape)).sum(),
        0.2 * _asked(color, batch.color, weight),
        0.1 * _asked(SHARP * cosines, batch.look, weight),
    ]


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
    sizes = (shape[:, :3] - wanted[:, :3]).abs() @ torch.tensor([4.0, 4.0, 2.0])
    turns = (shape[:, 3:] - wanted[:, 3:]).abs().sum(1)
    return sizes + 0.5 * turns


def _asked(logits: Tensor, wanted: Tensor, weight: Tensor) -> Tensor:
    """Cross entropy where an answer is asked for."""
    asked = wanted != UNKNOWN
    if not bool(asked.any()):
        return logits.sum() * 0
    return (
        weight[asked] * functional.cross_entropy(logits[asked], wanted[asked], reduction="none")
    ).sum()

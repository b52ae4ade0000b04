"""The detector of boxes that the paper's arm has, as a baseline (torch, torchvision).

    python -m evals.ssdlite train --pictures FOLDER --out FILE --minutes M [--batch B] [--wait N]
    python -m evals.ssdlite bench --weights FILE [--pictures N]

SSDLite320 over MobileNetV3-Large, from nothing, on the pictures of `evals.lessons` as the camera
showed them (320 x 240), while `armchat train detector` draws them; as it says nothing else, a
thing's place is the point of the table in the middle of its box. Measured on the test pictures of
`evals.detector_bench`. Needs ``pip install torchvision`` (of the torch that is there).
"""

from __future__ import annotations

import argparse
import math
import statistics
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor, nn

from evals.boxes import OVERLAPS, Claim, Fact, average_precision
from evals.lessons import FRAME
from scene.pictured import SHOWN, Sight
from scene.truth import COLUMNS, NAMES

SEEN, KIND = COLUMNS.index("seen"), COLUMNS.index("kind")
RATE, DECAY, LEAST = 2e-3, 1e-4, 0.05


class Frames(NamedTuple):
    """Pictures (n, height, width, 3) uint8, boxes (n, things, 4; shares), kinds (n, things).

    Kinds are numbers in `NAMES`, -1 where there is nothing to learn.
    """

    pixels: Tensor
    boxes: Tensor
    kinds: Tensor


def network() -> nn.Module:
    """The network, with a class for nothing and one for each name."""
    from torchvision.models.detection import ssdlite320_mobilenet_v3_large

    made: nn.Module = ssdlite320_mobilenet_v3_large(
        weights=None, weights_backbone=None, num_classes=1 + len(NAMES)
    )
    return made


def train(folder: Path, out: Path, minutes: float, batch: int, wait: int) -> None:
    """Learn from the shards in ``folder`` as they come; the weights are written as it goes."""
    device = torch.device("cuda" if torch.cuda.is_available() else "cpu")
    net, shelf, began = network().to(device).train(), _Shelf(folder, device), time.monotonic()
    optimiser = torch.optim.AdamW(net.parameters(), lr=RATE, weight_decay=DECAY)
    while not shelf.count or (shelf.count < wait and time.monotonic() - began < 30 * minutes):
        shelf.take()
        time.sleep(0.2)
    told, steps, mean = time.monotonic(), 0, 0.0
    while (spent := time.monotonic() - began) < 60 * minutes:
        share = spent / 60 / minutes
        for group in optimiser.param_groups:
            group["lr"] = RATE * min(1.0, 0.02 + 50 * share) * 0.5 * (1 + math.cos(math.pi * share))
        mean += _step(net, optimiser, *shelf.batch(batch))
        steps += 1
        if steps % 10 == 0:
            shelf.take()
        if time.monotonic() - told > 30:
            at = f"ssdlite {spent:.0f} s, {steps} steps, {shelf.count} pictures"
            print(f"{at}: {mean / steps:.3f}", flush=True)
            told, mean, steps = time.monotonic(), 0.0, 0
            _save(net, out)
    _save(net, out)


def _step(
    net: nn.Module,
    optimiser: torch.optim.Optimizer,
    pictures: list[Tensor],
    wanted: list[dict[str, Tensor]],
) -> float:
    device = pictures[0].device.type
    with torch.autocast(device, torch.bfloat16, enabled=device == "cuda"):
        loss = torch.stack(list(net(pictures, wanted).values())).sum()
    optimiser.zero_grad(set_to_none=True)
    torch.autograd.backward(loss)
    torch.nn.utils.clip_grad_norm_(net.parameters(), 5.0)
    optimiser.step()
    return float(loss.detach())


def _save(net: nn.Module, out: Path) -> None:
    halves = {
        key: value.half() if value.is_floating_point() else value
        for key, value in net.state_dict().items()
    }
    aside = out.with_suffix(".part")
    torch.save(halves, aside)
    aside.rename(out)


class _Shelf:
    """All frames that have come so far."""

    def __init__(self, folder: Path, device: torch.device) -> None:
        self.folder, self.device, self.read, self.count = folder, device, set[str](), 0
        self.shards = list[Frames]()

    def take(self, most: int = 30) -> None:
        """Read shards that are new."""
        new = [one for one in self.folder.glob("seed*_?????.npz") if one.name not in self.read]
        for path in new[:most]:
            self.read.add(path.name)
            with np.load(path) as shard:
                named = shard["named"]
                kinds = np.where(named[..., SEEN] >= SHOWN, named[..., KIND], -1).astype(np.int64)
                pixels = torch.from_numpy(shard["frames"]).to(self.device)
                frames = Frames(pixels, torch.from_numpy(shard["boxes"]), torch.from_numpy(kinds))
            if len(frames.pixels):
                self.shards.append(frames)
                self.count += len(frames.pixels)

    def batch(self, size: int) -> tuple[list[Tensor], list[dict[str, Tensor]]]:
        """Some pictures, half of them mirrored, in another light; and what they show.

        Boxes go to the device all at once: to wait for it for each would take most of the time.
        """
        pictures, boxes, labels = list[Tensor](), list[Tensor](), list[Tensor]()
        for _ in range(size):
            shard = self.shards[int(np.random.randint(len(self.shards)))]
            n = int(np.random.randint(len(shard.pixels)))
            mirrored, gain = np.random.random() < 0.5, np.random.uniform(0.6, 1.35)
            picture = shard.pixels[n].permute(2, 0, 1)
            pictures.append((picture.flip(2) if mirrored else picture) * (gain / 255))
            found, kinds = _shown(shard.boxes[n], shard.kinds[n], mirrored)
            boxes.append(found)
            labels.append(1 + kinds)
        counts = [len(one) for one in labels]
        moved = torch.split_with_sizes(torch.cat(boxes).to(self.device), counts)
        named = torch.split_with_sizes(torch.cat(labels).to(self.device), counts)
        wanted = [{"boxes": one, "labels": two} for one, two in zip(moved, named, strict=True)]
        return [one.clamp(max=1) for one in pictures], wanted


def _shown(boxes: Tensor, kinds: Tensor, mirrored: bool) -> tuple[Tensor, Tensor]:
    """Of a picture's boxes (n, 4; shares) and kinds those to be learnt, in pixels."""
    left, top, right, bottom = boxes.clamp(0, 1).unbind(1)
    if mirrored:
        left, right = 1 - right, 1 - left
    width, height = FRAME
    scaled = torch.stack([width * left, height * top, width * right, height * bottom], 1)
    asked = (kinds >= 0) & (scaled[:, 2:] - scaled[:, :2] > 1).all(1)
    return scaled[asked], kinds[asked]


# --- figures ----------------------------------------------------------------------------------


class Row(NamedTuple):
    """What is measured: boxes in the picture; places of things found, in mm on the table."""

    map50: float
    map50_95: float
    median_mm: float
    p95_mm: float
    found: int
    asked: int
    frame_ms: float


def bench(weights: Path, pictures: int) -> Row:
    """The network on the first so many test pictures."""
    from evals.detector_bench import SIZE, USUAL
    from scene.pictured import camera_sight

    net = network()
    state = torch.load(weights, map_location="cpu", weights_only=True)
    net.load_state_dict({key: value.float() if value.is_floating_point() else value
                         for key, value in state.items()})  # fmt: skip
    torch.set_num_threads(1)
    sights = (camera_sight(f"test {number}", USUAL, *SIZE) for number in range(pictures))
    return measured(net.eval(), sights)


@torch.no_grad()
def measured(net: nn.Module, sights: Iterator[Sight]) -> Row:
    """Average precision of picture boxes, and the places of their middles."""
    claims: dict[str, list[Claim]] = {name: [] for name in NAMES}
    facts: dict[str, list[Fact]] = {name: [] for name in NAMES}
    away, spent, asked = list[float](), list[float](), 0
    for number, sight in enumerate(sights):
        picture = torch.from_numpy(sight.picture.pixels).permute(2, 0, 1).float() / 255
        began = time.perf_counter()
        said = net([picture])[0]
        spent.append(1000 * (time.perf_counter() - began))
        sure = said["scores"] >= LEAST
        boxes = said["boxes"][sure].numpy().astype(float)
        for box, kind, score in zip(boxes, said["labels"][sure].tolist(),
                                    said["scores"][sure].tolist(), strict=True):  # fmt: skip
            claims[NAMES[kind - 1]].append(Claim(number, score, _level(box)))
        for one in sight.labels:
            if one.box is not None:
                # the renderer counts from the middles of pixels, the network from their edges
                true = np.array(one.box) + 0.5
                facts[one.name].append(Fact(number, _level(true), one.seen >= SHOWN))
                asked += one.seen >= SHOWN
        strong = boxes[said["scores"][sure].numpy() >= 0.3]
        away += _away(sight, strong)
    every = {least: [average_precision(claims[name], facts[name], least) for name in NAMES]
             for least in OVERLAPS}  # fmt: skip
    means = {least: statistics.fmean(x for x in found if x is not None)
             for least, found in every.items()}  # fmt: skip
    middle, far = np.quantile(away, (0.5, 0.95)).tolist() if away else (math.nan, math.nan)
    return Row(means[0.5], statistics.fmean(means.values()), middle, far, len(away), asked,
               statistics.median(spent))  # fmt: skip


def _level(box: NDArray[np.float64]) -> tuple[float, float, float, float, float]:
    left, top, right, bottom = box.tolist()
    return (left + right) / 2, (top + bottom) / 2, right - left, bottom - top, 0.0


def _away(sight: Sight, boxes: NDArray[np.float64]) -> list[float]:
    """How far (mm) from each thing's place the middle of the nearest box shows, where near."""
    from evals.detector_bench import MM, NEAR

    if not len(boxes):
        return []
    middles = (boxes[:, :2] + boxes[:, 2:]) / 2 - 0.5
    points = sight.view.points(middles)
    result = []
    for one in sight.labels:
        if one.seen >= SHOWN:
            nearest = float(np.hypot(*(points - (one.x, one.y)).T).min())
            if nearest <= min(NEAR, max(one.width, one.height) / 2):
                result.append(MM * nearest)
    return result


def main(arguments: Sequence[str] | None = None) -> int:
    """Train it, or print its row."""
    parser = argparse.ArgumentParser(prog="python -m evals.ssdlite", description=__doc__)
    parser.add_argument("act", choices=("train", "bench"))
    parser.add_argument("--pictures", default="500", help="the lessons' folder, or so many to test")
    parser.add_argument("--out", type=Path)
    parser.add_argument("--weights", type=Path)
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--batch", type=int, default=32)
    parser.add_argument("--wait", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args(arguments)
    torch.manual_seed(options.seed)
    np.random.seed(options.seed)
    if options.act == "train":
        train(Path(options.pictures), options.out, options.minutes, options.batch, options.wait)
    else:
        print(bench(options.weights, int(options.pictures)))
    return 0


if __name__ == "__main__":
    sys.exit(main())

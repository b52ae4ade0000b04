"""Train the detector's network (torch, needs the ``[train]`` extra) on pictures as they are drawn.

Pictures come in while it learns, and stay; each is turned, mirrored and re-lit at random each time
it is shown. On a GPU where there is one, which then holds them all. The course is one of minutes,
not of steps: it fits whatever machine it is on. ``checkpoint.pt`` is gone on with where there is
one; ``detector.onnx`` is written at the end.
"""

from __future__ import annotations

import copy
import math
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import msgspec
import torch
from torch import Tensor

from agent.errors import ConfigError
from scene.augment import planes, relit, turned
from scene.colors import SEEN_COLORS
from scene.detector_net import FEATURE, Net
from scene.export_detector import export
from scene.losses import NAMES as LOSSES
from scene.losses import losses
from scene.targets import targets
from scene.truth import COLUMNS, GRID, LOOKS, MOST, NAMES, Lessons

TELL = 20.0
"""Seconds between two lines of progress."""
BEHIND = 0.998
"""How slowly the weights that are kept follow those that learn."""


Fresh = Callable[[], Sequence[Lessons]]
"""Lessons that were drawn since it was asked last."""


class Course(msgspec.Struct, frozen=True, kw_only=True):
    """How to train: saved as ``course.json`` beside the weights.

    ``first``: so many pictures are waited for; ``pictures``: so many are kept, the first to come.
    The rate rises in the first hundredth of the time, and falls to nothing along a cosine; a course
    may be gone on with as a longer one.
    """

    minutes: float = 35.0
    first: int = 2000
    pictures: int = 60_000
    batch: int = 16
    rate: float = 3e-3
    decay: float = 0.01
    threads: int = 1
    save: float = 60.0
    seed: int = 0


def train(fresh: Fresh, course: Course, out: Path) -> Path:
    """Train and write ``detector.onnx`` into ``out``; returns its path."""
    torch.set_num_threads(course.threads)
    torch.manual_seed(course.seed)
    out.mkdir(parents=True, exist_ok=True)
    (out / "course.json").write_bytes(msgspec.json.format(msgspec.json.encode(course)))
    device = torch.device("cuda" if torch.cuda.is_available() else "cpu")
    torch.backends.cudnn.benchmark = True
    learner = _Learner(course, device, out / "checkpoint.pt")
    if learner.spent < 60 * course.minutes:
        pool, began = _Pool(course, device), time.monotonic()
        pool.fill(fresh, began)
        learner.learn(pool, fresh, time.monotonic() - began)
    return export(learner.kept.cpu(), out / "detector.onnx", GRID, NAMES, SEEN_COLORS)


class _Pool:
    """All pictures that have come so far, where the network is."""

    def __init__(self, course: Course, device: torch.device) -> None:
        size = course.pictures
        self.count, self.course, self.device = 0, course, device
        self.levels = torch.empty((size, GRID.size, GRID.size, 3), dtype=torch.uint8, device=device)
        self.cameras = torch.empty((size, 3), device=device)
        self.rows = torch.empty((size, MOST, len(COLUMNS)), device=device)

    def take(self, lessons: Sequence[Lessons]) -> None:
        """Add pictures, as far as there is room."""
        for one in lessons:
            here = slice(self.count, min(self.count + len(one.levels), len(self.levels)))
            fits = here.stop - here.start
            self.levels[here] = torch.from_numpy(one.levels[:fits]).to(self.device)
            self.cameras[here] = torch.from_numpy(one.cameras[:fits]).to(self.device)
            self.rows[here] = torch.from_numpy(one.rows[:fits]).to(self.device)
            self.count = here.stop

    def fill(self, fresh: Fresh, began: float) -> None:
        """Wait for the first pictures; after half of the course, for any."""
        while self.count < self.course.first:
            self.take(fresh())
            waited = (time.monotonic() - began) / 60
            if waited > self.course.minutes and not self.count:
                raise ConfigError(f"no pictures in {waited:.1f} minutes: is anything drawing them?")
            if waited > self.course.minutes / 2 and self.count:
                return
            time.sleep(0.05)

    def batch(self, size: int) -> tuple[Tensor, Tensor, Tensor]:
        """Some of them, each another way round: levels, cameras, rows."""
        chosen = torch.randint(self.count, (size,), device=self.device)
        ways = torch.rand((size, 3), device=self.device) < 0.5
        return turned(self.levels[chosen], self.cameras[chosen], self.rows[chosen], ways)


class _Learner:
    """The network and all that training it needs; ``kept``: the weights that are served.

    ``proxies`` (looks, features): where the features of each look are drawn to; ``spent``: seconds.
    """

    def __init__(self, course: Course, device: torch.device, path: Path) -> None:
        self.course, self.device, self.path, self.spent = course, device, path, 0.0
        self.steps = 0
        self.net = Net(len(NAMES), len(SEEN_COLORS)).to(device)
        self.net.to(memory_format=torch.channels_last)
        self.proxies = torch.nn.Parameter(torch.randn(len(LOOKS), FEATURE, device=device))
        self.learnt = [*self.net.parameters(), self.proxies]
        self.optimiser = torch.optim.AdamW(self.learnt, lr=course.rate, weight_decay=course.decay)
        self.kept = copy.deepcopy(self.net)
        if path.exists():
            self._load(torch.load(path, map_location=device, weights_only=True))

    def _load(self, state: dict[str, Any]) -> None:
        self.spent, self.steps = float(state["spent"]), int(state["steps"])
        self.net.load_state_dict(state["net"])
        self.kept.load_state_dict(state["kept"])
        self.optimiser.load_state_dict(state["optimiser"])
        self.proxies.data = state["proxies"]

    def learn(self, pool: _Pool, fresh: Fresh, waited: float) -> None:
        """Until the course's minutes have passed, waiting included; saved as it goes."""
        self.net.train()
        start = time.monotonic() - self.spent - waited
        told = saved = time.monotonic()
        sums, since = torch.zeros(len(LOSSES), device=self.device), 0
        while self.spent < 60 * self.course.minutes:
            sums += self._step(pool)
            since += 1
            if since % 8 == 0:
                pool.take(fresh())
            now = time.monotonic()
            self.spent = now - start
            if now - told > TELL:
                self._tell(sums / since, since / (now - told), pool.count)
                sums, since, told = torch.zeros_like(sums), 0, now
            if now - saved > self.course.save:
                self.save()
                saved = now
        self.save()

    def _tell(self, means: Tensor, pace: float, pictures: int) -> None:
        each = zip(LOSSES, means.tolist(), strict=True)
        parts = " ".join(f"{name} {mean:.3f}" for name, mean in each)
        at = f"{self.spent:.0f} s, {self.steps} steps, {pace:.1f} a second, {pictures} pictures"
        print(f"{at}: {parts}", flush=True)

    def save(self) -> None:
        """Write ``checkpoint.pt``, aside first."""
        state = {
            "spent": self.spent, "steps": self.steps, "net": self.net.state_dict(),
            "kept": self.kept.state_dict(), "proxies": self.proxies.data,
            "optimiser": self.optimiser.state_dict(),
        }  # fmt: skip
        aside = self.path.with_suffix(".part")
        torch.save(state, aside)
        aside.rename(self.path)

    def _step(self, pool: _Pool) -> Tensor:
        for group in self.optimiser.param_groups:
            group["lr"] = self.course.rate * _pace(self.spent / 60 / self.course.minutes)
        levels, cameras, rows = pool.batch(self.course.batch)
        shown = levels.any(-1, keepdim=True)
        given = planes(relit(levels), shown, cameras, GRID)
        wanted = targets(rows, cameras, GRID)
        with torch.autocast(self.device.type, torch.bfloat16, enabled=self.device.type == "cuda"):
            seen = self.net.seen(given)
        each = losses(self.net.read(seen.float(), given), wanted, self.proxies)
        self.optimiser.zero_grad(set_to_none=True)
        torch.autograd.backward(each.sum())
        torch.nn.utils.clip_grad_norm_(self.learnt, 5.0)
        self.optimiser.step()
        self.steps += 1
        self._follow()
        return each.detach()

    @torch.no_grad()
    def _follow(self) -> None:
        """The weights that are kept go a little of the way; counts and the like are copied."""
        slow = min(BEHIND, self.steps / (10.0 + self.steps))
        kept, now = self.kept.state_dict(), self.net.state_dict()
        floats = [key for key in kept if kept[key].is_floating_point()]
        torch._foreach_lerp_([kept[key] for key in floats], [now[key] for key in floats], 1 - slow)


def _pace(share: float) -> float:
    """The part of the full rate after this share of the course."""
    return min(1.0, 0.02 + 100 * share) * 0.5 * (1 + math.cos(math.pi * min(1.0, share)))

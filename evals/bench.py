"""`armchat bench NAME`: measure the figures of one part, by the public interface.

Every figure is measured here and now; one that could not be measured has ``value`` null and a
``why``. Times are medians of repeated runs on whatever else the machine is doing.
"""

from __future__ import annotations

import os
import platform
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path
from typing import TextIO

import msgspec

from agent.execute import Executor
from agent.messages import Draft
from agent.primitives import primitives
from evals.clarifier_bench import clarifier_figures
from evals.figures import Figure, at_least, median, times
from evals.language_bench import language_figures
from evals.paper_metric import scenes_of
from evals.program_bench import program_figures
from robot_bridge.ideal import predict
from scene.types import Scene
from translator.corpus.load import Pair, load

ROOT = Path(__file__).parent.parent


class Bench(msgspec.Struct, frozen=True, kw_only=True):
    """What `armchat bench NAME --json` prints."""

    name: str
    machine: str
    commit: str | None
    n: int
    figures: dict[str, Figure]


def bench(name: str, as_json: bool, out: TextIO, size: int | None = None) -> int:
    """Measure and print; 0 if every figure could be measured, else 1.

    ``size``: so many episodes for the clarifier, trials for the arm, sentences for language,
    instead of all.
    """
    if name == "clarifier":
        figures = clarifier_figures() if size is None else clarifier_figures(size)
    elif name == "language":
        figures = language_figures(size)
    else:
        figures = _robot(size) if name == "robot" else _BENCHES[name]()
    result = Bench(
        name=name, machine=f"{platform.machine()} {platform.system()}, {_cores()} cores",
        commit=_commit(), n=sum(figure.n for figure in figures.values()), figures=figures,
    )  # fmt: skip
    if as_json:
        out.write(msgspec.json.encode(result).decode() + "\n")
    else:
        out.write(f"{name} on {result.machine}, commit {result.commit}\n")
        for key, figure in figures.items():
            value = "not measured" if figure.value is None else f"{figure.value:10.3f}"
            value += "" if figure.stderr is None else f" ± {figure.stderr:.3f}"
            goal = f"goal {figure.goal}: {'met' if figure.met else 'missed'}" if figure.goal else ""
            out.write(f"  {key:34} {value} {figure.unit:6} n {figure.n:<6} {goal}\n")
    return int(any(figure.value is None for figure in figures.values()))


def _cores() -> int:
    return len(os.sched_getaffinity(0))


def _commit() -> str | None:
    done = subprocess.run(
        ["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, capture_output=True, text=True
    )
    return done.stdout.strip() or None


def _manipulate_pair() -> Pair:
    return next(pair for pair in load("manipulate") if pair.family.startswith("pick"))


def _robot(trials: int | None = None) -> dict[str, Figure]:
    from evals.robot_bench import robot_figures
    from evals.stop_bench import stop_figures
    from evals.trials import PAPER, SEEDS, trial_figures

    return {
        **_ideal(),
        **robot_figures(),
        **stop_figures(),
        **trial_figures(PAPER + SEEDS if trials is None else trials),
    }


def _ideal() -> dict[str, Figure]:
    pair = _manipulate_pair()
    scenes = scenes_of(pair, 100)
    with Executor() as executor:
        drafts = executor.run(pair.program, pair.kind, scenes)
    plans: list[tuple[Draft, Scene]] = [
        (draft, scene) for draft, scene in zip(drafts, scenes, strict=True)
        if isinstance(draft, Draft)
    ]  # fmt: skip
    rates = []
    for _ in range(5):
        began = time.perf_counter()
        for draft, scene in plans:
            predict(primitives(draft, scene), scene)
        rates.append(len(plans) / (time.perf_counter() - began))
    value = statistics.median(rates)
    return {"ideal_programs_per_second": at_least(value, 1000, "1/s", 5 * len(plans)), **_dobot()}


def _dobot() -> dict[str, Figure]:
    if find_spec("pydobot") is None:
        return {"dobot": Figure(value=None, unit="", n=0, why="pydobot is not installed")}
    from evals.dobot_bench import dobot_figures

    return dobot_figures()


def _cold() -> dict[str, Figure]:
    def armchat(*arguments: str) -> None:
        command = [sys.executable, "-m", "agent.cli", *arguments]
        subprocess.run(command, capture_output=True, cwd=ROOT, check=True)

    return {
        "version": median(times(lambda: armchat("--version"), 10), goal=150),
        "say_help": median(times(lambda: armchat("say", "--help"), 10), goal=300),
        "say_on_the_ideal_table": median(
            times(lambda: armchat("say", "put the apple on the plate"), 5), goal=2000
        ),
    }


def _scene() -> dict[str, Figure]:
    from evals import detector_bench, detector_shown, optics_bench, track_bench

    parts = (detector_bench, detector_shown, optics_bench, track_bench)
    return {key: figure for part in parts for key, figure in part.figures().items()}


_BENCHES: dict[str, Callable[[], dict[str, Figure]]] = {
    "program": program_figures, "clarifier": clarifier_figures, "robot": _robot, "scene": _scene,
    "cold": _cold,
}  # fmt: skip

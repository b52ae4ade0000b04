"""`armchat reproduce seeds`: train the paper's models once for each seed, for table 1 as means.

Each seed's folder gets what `armchat train` writes and both baselines; what is there already is
not trained again, so a run that was cut short goes on. Needs the ``[train]`` extra.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

from msgspec.structs import replace

from agent.execute import Executor
from evals.table1 import TASKS

Train = Callable[[Path, int], None]
"""Trains into a folder with a seed."""
LAST_FILE = "step.onnx"
"""What the training of the model writes last: without it a run was cut short."""


def train_seeds(out: Path, count: int, model: Train, baselines: Train) -> list[Path]:
    """Train what is missing for the seeds 0 to ``count`` - 1; the folders, one a seed."""
    folders = [out / f"seed{seed}" for seed in range(count)]
    for seed, folder in enumerate(folders):
        folder.mkdir(parents=True, exist_ok=True)
        for train, done in ((model, [LAST_FILE]), (baselines, [baseline_file(t) for t in TASKS])):
            if not all((folder / name).is_file() for name in done):
                print(f"seed {seed} into {folder}", file=sys.stderr)
                train(folder, seed)
    return folders


def baseline_file(task: str) -> str:
    """What `evals.baselines` calls the weights of a task's baseline."""
    return f"baseline_{task}.safetensors"


def train_model(config: Path) -> Train:
    """Trains the seq2seq model of a configuration, which names no seed of its own then."""
    from translator.course import read_config
    from translator.train import train

    wanted = read_config(config)

    def act(folder: Path, seed: int) -> None:
        train(replace(wanted, seed=seed), folder)

    return act


def train_baselines(folder: Path, seed: int) -> None:
    """Trains both baselines."""
    from evals.baselines import EPOCHS, train

    with Executor() as executor:
        for task, epochs in EPOCHS.items():
            train(task, executor, folder, epochs, seed)

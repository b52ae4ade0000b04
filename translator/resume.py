"""A training run that was cut short goes on behind the last epoch it finished (torch).

All that the next epoch depends on is in one file beside the run: weights, Adam's moments, chance,
and how far it is. It is gone once the run is over.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import msgspec
import torch
from safetensors import SafetensorError, safe_open
from safetensors.torch import load_file, save_file
from torch import Tensor

from agent.errors import ConfigError
from translator.course import TrainConfig
from translator.learner import Learner, Model

FILE = "unfinished.safetensors"
MODEL, MOMENTS, CHANCE, DEVICE = "model.", "moments.", "chance", "chance of device "
"""What begins the names of tensors."""


class State(NamedTuple):
    """A run that was cut short after an epoch, having used so many seconds and batches."""

    epoch: int
    seconds: float
    batches: int
    tensors: dict[str, Tensor]

    def part(self, begins: str) -> dict[str, Tensor]:
        """The tensors whose names begin so, by the rest of their names."""
        return {
            name.removeprefix(begins): tensor
            for name, tensor in self.tensors.items() if name.startswith(begins)
        }  # fmt: skip


def save(out: Path, config: TrainConfig, model: Model, learner: Learner, epoch: int) -> None:
    """Write where the run is after an epoch; one that ends meanwhile leaves the point before."""
    devices = torch.cuda.get_rng_state_all() if torch.cuda.is_available() else []
    tensors = (
        {MODEL + name: tensor for name, tensor in model.state_dict().items()}
        | {MOMENTS + name: tensor for name, tensor in learner.moments().items()}
        | {CHANCE: torch.get_rng_state()}
        | {f"{DEVICE}{number}": state for number, state in enumerate(devices)}
    )
    told = {
        "config": msgspec.json.encode(config).decode(), "epoch": str(epoch),
        "seconds": str(learner.seconds), "batches": str(learner.batches),
    }  # fmt: skip
    part = out / f"{FILE}.part"
    save_file(tensors, part, told)
    part.replace(out / FILE)


def unfinished(out: Path, config: TrainConfig) -> State | None:
    """The run in this folder that was cut short; None where there is none.

    Raises ConfigError where it cannot be read or is one of another configuration.
    """
    file = out / FILE
    if not file.is_file():
        return None
    try:
        with safe_open(file, "pt") as opened:
            told = opened.metadata()
        state = State(
            int(told["epoch"]), float(told["seconds"]), int(told["batches"]), load_file(file)
        )
        same = told["config"] == msgspec.json.encode(config).decode()
    except (OSError, KeyError, TypeError, ValueError, SafetensorError) as error:
        raise ConfigError(f"{file}: cannot be read ({error}); delete it to begin anew") from error
    if not same:
        raise ConfigError(
            f"{out}: holds a run of another configuration that was cut short after epoch "
            f"{state.epoch}; name another folder, or delete {file} to begin anew"
        )
    return state


def go_on(state: State, model: Model, learner: Learner) -> int:
    """Bring model and learner to where a run was cut short: how many epochs are learnt."""
    model.load_state_dict(state.part(MODEL))
    learner.restore(state.part(MOMENTS), state.batches, state.seconds)
    torch.set_rng_state(state.tensors[CHANCE])
    devices = state.part(DEVICE)
    if torch.cuda.is_available() and devices:
        torch.cuda.set_rng_state_all([devices[str(number)] for number in range(len(devices))])
    return state.epoch


def over(out: Path) -> None:
    """The run is finished: nothing is left to go on from."""
    (out / FILE).unlink(missing_ok=True)

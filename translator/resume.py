"""A training run that was cut short goes on behind the last epoch it finished (torch).

All that the next epoch depends on is in one file beside the run: weights, Adam's moments, chance,
and how far it is. It is gone once the run is over.
"""

from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any

import msgspec
import torch

from agent.errors import ConfigError
from translator.course import TrainConfig
from translator.learner import Learner, Model

FILE = "unfinished.pt"
State = dict[str, Any]


def save(out: Path, config: TrainConfig, model: Model, learner: Learner, epoch: int) -> None:
    """Write where the run is after an epoch; one that ends meanwhile leaves the point before."""
    state = {
        "config": msgspec.json.encode(config), "model": model.state_dict(),
        "learner": learner.state(), "epoch": epoch, "seconds": learner.seconds,
        "chance": torch.get_rng_state(), "device_chance": _device_chance(),
    }  # fmt: skip
    part = out / f"{FILE}.part"
    torch.save(state, part)
    part.replace(out / FILE)


def unfinished(out: Path, config: TrainConfig) -> State | None:
    """The run in this folder that was cut short; None where there is none.

    Raises ConfigError where it cannot be read or is one of another configuration.
    """
    file = out / FILE
    if not file.is_file():
        return None
    try:
        state: State = torch.load(file, map_location="cpu", weights_only=True)
        same = state["config"] == msgspec.json.encode(config)
    except (OSError, EOFError, RuntimeError, KeyError, pickle.UnpicklingError) as error:
        raise ConfigError(f"{file}: cannot be read ({error}); delete it to begin anew") from error
    if not same:
        raise ConfigError(
            f"{out}: holds a run of another configuration that was cut short after epoch "
            f"{state['epoch']}; name another folder, or delete {file} to begin anew"
        )
    return state


def go_on(state: State, model: Model, learner: Learner) -> int:
    """Bring model and learner to where a run was cut short: how many epochs are learnt."""
    model.load_state_dict(state["model"])
    learner.restore(state["learner"], state["seconds"])
    torch.set_rng_state(state["chance"])
    if torch.cuda.is_available() and state["device_chance"]:
        torch.cuda.set_rng_state_all(state["device_chance"])
    return int(state["epoch"])


def over(out: Path) -> None:
    """The run is finished: nothing is left to go on from."""
    (out / FILE).unlink(missing_ok=True)


def _device_chance() -> list[torch.Tensor]:
    return torch.cuda.get_rng_state_all() if torch.cuda.is_available() else []

"""How a translator's model is trained: the configuration of `armchat train`."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Literal

import msgspec

from agent.errors import ConfigError
from agent.messages import Kind
from translator.vocabulary import MERGES


class TrainConfig(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One training run.

    ``model``: the paper's LSTMs or the product's Transformer. ``copies``: how often each pair
    appears in an epoch, nouns swapped; ``joined``: the share of them that is joined with other
    pairs. With the corpus ``seeds`` an epoch is ``samples`` fresh sentences of
    `translator.corpus.generate`, and a wording in twenty is held out; with ``docstrings`` it is so
    many draws from what `translator.mined` finds, to go on from with another corpus. ``start``:
    folder of an earlier run, or of a network that serves, of the same sizes, whose weights this one
    goes on from, and whose vocabulary where that has the same dialect; ``vocabulary``: folder of
    the run whose vocabulary it speaks instead. The learning rate rises over the first ``warmup``
    batches and falls to ``final_rate`` by the last epoch, or by the end of the ``minutes`` that
    training may take (0: no limit). Learnt from is a share ``wordings`` of the seeds' wordings, or
    of the paper's pairs in training. Without a GPU each of ``threads`` learns from its share of a
    batch; ``growers`` processes make the lessons (0: a thread).
    """

    tasks: tuple[Kind, ...] = ("arrange", "manipulate")
    corpus: Literal["paper", "seeds", "docstrings"] = "paper"
    model: Literal["lstm", "transformer"] = "lstm"
    start: str | None = None
    vocabulary: str | None = None
    wordings: float = 1.0
    samples: int = 20_000
    merges: int = MERGES
    bidirectional: bool = False
    width: int = 1024
    token_size: int = 128
    dropout: float = 0.0
    epochs: int = 10
    copies: int = 8
    joined: float = 0.0
    batch: int = 16
    learning_rate: float = 1e-3
    final_rate: float = 1e-3
    warmup: int = 0
    clip: float = 5.0
    seed: int = 0
    threads: int = 2
    growers: int = 0
    minutes: float = 0.0


def read_config(path: Path) -> TrainConfig:
    """The configuration of a TOML file. Raises ConfigError naming file and key."""
    try:
        return msgspec.convert(tomllib.loads(path.read_text(encoding="utf-8")), TrainConfig)
    except (OSError, ValueError, msgspec.ValidationError) as error:
        raise ConfigError(f"{path}: {error}") from error

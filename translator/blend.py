"""Two networks of one shape as one: the mean of their weights.

    python -m translator.blend CONFIG BEFORE AFTER OUT

A network that went on from another, on sentences of other kinds, forgets a little and grows too
certain; halfway between the two it keeps what both know (Wortsman et al., arXiv 2109.01903;
figures: evals/LOG.md). Each folder holds a run or a network that serves. Needs the ``[train]``
extra.
"""

from __future__ import annotations

import sys
from pathlib import Path

from translator.course import TrainConfig, read_config
from translator.export import export_model
from translator.marked import SLOTS
from translator.train import VOCABULARY, build_model, carried, learnt_in, spoken_in


def blend(config: TrainConfig, before: Path, after: Path, out: Path) -> None:
    """Write the network halfway between two of the configuration's shape, over the vocabulary of
    ``after``: symbols that ``before`` lacks are as ``after`` has them."""
    now, new = spoken_in(after), learnt_in(after)
    old = carried(learnt_in(before), spoken_in(before), new, now)
    model = build_model(config, len(now.pieces), 0 if now.dialect == "paper" else len(SLOTS))
    model.load_state_dict({name: (old[name] + tensor) / 2 for name, tensor in new.items()})
    out.mkdir(parents=True, exist_ok=True)
    export_model(model, out)
    now.save(out / VOCABULARY)


if __name__ == "__main__":
    _config, *_folders = (Path(argument) for argument in sys.argv[1:])
    blend(read_config(_config), *_folders)

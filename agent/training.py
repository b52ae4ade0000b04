"""`armchat train`: the networks that armchat is made of, each from its own corpus."""

from __future__ import annotations

import argparse
from pathlib import Path

PARTS = ("translator", "pretrained", "detector", "hearing")


def add_trainings(train: argparse.ArgumentParser) -> None:
    """What can be trained, and its options."""
    train.add_argument("part", nargs="?", choices=PARTS, default="translator")
    train.add_argument("--config", metavar="FILE", help="the translator's, the pretrained model's")
    train.add_argument("--out", required=True, metavar="FOLDER")
    train.add_argument("--pictures", type=int, metavar="N", help="detector: so many tables")
    train.add_argument("--sentences", type=int, metavar="N", help="hearing: so many sentences")
    train.add_argument(
        "--minutes", type=float, metavar="M", help="detector, hearing: at most so long"
    )
    train.add_argument("--batch", type=int, metavar="B", help="detector: so many at once")
    train.add_argument(
        "--drawers", type=int, metavar="P", default=1, help="detector: processes that draw them"
    )
    train.add_argument("--seed", type=int, metavar="S", default=0, help="detector's, hearing's")
    train.set_defaults(act=_train)


def _train(arguments: argparse.Namespace) -> int:
    if arguments.part == "detector":
        return _train_detector(arguments)
    if arguments.part == "hearing":
        return _train_hearing(arguments)
    if arguments.config is None:
        from agent.errors import ConfigError

        raise ConfigError("armchat train needs --config FILE")
    if arguments.part == "pretrained":
        return _tune(arguments)
    from translator.course import read_config
    from translator.train import train

    train(read_config(Path(arguments.config)), Path(arguments.out))
    return 0


def _tune(arguments: argparse.Namespace) -> int:
    from translator.models import need_libraries

    need_libraries()
    from translator.finetune import read_config, tune

    tune(read_config(Path(arguments.config)), Path(arguments.out))
    return 0


def _train_hearing(arguments: argparse.Namespace) -> int:
    from clarifier.kinds import KINDS, Kinds
    from translator.train_hearing import train

    given = {
        name: value
        for name in ("sentences", "minutes", "seed")
        if (value := getattr(arguments, name)) is not None
    }
    nouns = sorted(Kinds(KINDS.read_text(encoding="utf-8")).nouns)
    figures = train(nouns, Path(arguments.out), **given)
    print(
        f"{figures.n} held-out sentences: {figures.words:.1%} of words rightly told; of talk "
        f"{figures.recall:.1%} found, of what is passed over {figures.precision:.1%} is talk"
    )
    return 0


def _train_detector(arguments: argparse.Namespace) -> int:
    from evals.detector_spread import fit_spread
    from evals.lessons import Drawing
    from scene.train_detector import Course, train

    names = ("pictures", "minutes", "batch", "seed")
    given = {name: value for name in names if (value := getattr(arguments, name)) is not None}
    course, out = Course(**given), Path(arguments.out)
    drawers = arguments.drawers
    with Drawing(out / "pictures", course.pictures, course.seed, drawers) as drawing:
        weights = train(drawing.fresh, course, out)
    print(f"{weights}: deviations are {fit_spread(weights):.2f} of the mean errors it tells")
    return 0

"""The options of `armchat reproduce` and what each of its tables is handed. Imports are lazy."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

SCENES = 20


def add_options(command: argparse.ArgumentParser) -> None:
    """One subcommand for each table or picture of the paper."""
    tables = command.add_subparsers(dest="table", metavar="TABLE", required=True)

    table1 = tables.add_parser("table1", help="the results table, means over training runs")
    _models(table1, "+")
    table1.add_argument(
        "--baselines", nargs="+", default=["bundled"], metavar="FOLDER",
        help="folders of trained baselines, or one with a folder for each seed",
    )  # fmt: skip
    table1.add_argument(
        "--no-wild", action="store_true", help="leave out the row of outcomes (minutes)"
    )
    _shared(table1)
    table1.set_defaults(act=_table1)

    seeds = tables.add_parser("seeds", help="train all of it once for each seed, then table1")
    seeds.add_argument("--out", required=True, metavar="FOLDER", help="gets seed0, seed1, ...")
    seeds.add_argument("--seeds", type=_count, default=3, help="how many")
    seeds.add_argument("--config", default="configs/paper.toml", metavar="FILE")
    seeds.add_argument("--no-wild", action="store_true", help="leave out the row of outcomes")
    _shared(seeds)
    seeds.set_defaults(act=_seeds)

    phrases = tables.add_parser("phrases", help="accuracy by the number of phrases, and split")
    _models(phrases, 1)
    phrases.add_argument("--most", type=_count, default=5, help="phrases at most")
    phrases.add_argument(
        "--known", action="store_true", help="only of pairs that the model does right alone"
    )
    _shared(phrases)
    phrases.set_defaults(act=_phrases)

    words = tables.add_parser("substitutions", help="other words for the same: what changes")
    _models(words, 1)
    _shared(words)
    words.set_defaults(act=_substitutions)

    attention = tables.add_parser("attention", help="where the decoder looked, as a PNG")
    attention.add_argument("sentence")
    attention.add_argument("--task", choices=("arrange", "manipulate"), default="manipulate")
    attention.add_argument("--token", default="all", metavar="N|all", help="from 1; default: all")
    attention.add_argument("--model", choices=("paper", "product"), default="paper")
    attention.add_argument("--weights", metavar="FOLDER", help="of the model; default: bundled")
    attention.add_argument("--out", required=True, metavar="FILE.png")
    attention.set_defaults(act=_attention)


def _models(command: argparse.ArgumentParser, several: str | int) -> None:
    for name, whose in (("--weights", "the paper's model"), ("--product", "the product's model")):
        command.add_argument(
            name, nargs=several, default=["bundled"], metavar="FOLDER",
            help=f"{whose}: bundled, or folders that train wrote, one a seed"
            if several == "+"
            else f"{whose}: bundled, or a folder that train wrote",
        )  # fmt: skip


def _shared(command: argparse.ArgumentParser) -> None:
    command.add_argument("--scenes", type=_count, default=SCENES, help="random scenes a sentence")
    command.add_argument("--json", action="store_true")


def _count(text: str) -> int:
    value = int(text)
    if value < 1:
        raise argparse.ArgumentTypeError(f"{text} is not at least 1")
    return value


def _table1(arguments: argparse.Namespace) -> int:
    from evals.table1 import BASELINE_FILE, BASELINES, MODEL_FILE, Runs, folders, reproduce
    from translator.translate import PAPER, PRODUCT

    runs = Runs(
        folders(arguments.weights, PAPER, MODEL_FILE),
        folders(arguments.baselines, BASELINES, BASELINE_FILE),
        folders(arguments.product, PRODUCT, MODEL_FILE),
    )
    return reproduce(runs, arguments.scenes, not arguments.no_wild, arguments.json, sys.stdout)


def _seeds(arguments: argparse.Namespace) -> int:
    from evals.seeds import train_baselines, train_model, train_seeds
    from evals.table1 import Runs, reproduce

    model = train_model(Path(arguments.config))
    trained = train_seeds(Path(arguments.out), arguments.seeds, model, train_baselines)
    runs = Runs(trained, trained)
    return reproduce(runs, arguments.scenes, not arguments.no_wild, arguments.json, sys.stdout)


def _phrases(arguments: argparse.Namespace) -> int:
    from evals.phrases import reproduce
    from evals.table1 import both_models

    models = both_models(arguments.weights[0], arguments.product[0])
    return reproduce(
        models, arguments.scenes, arguments.most, arguments.known, arguments.json, sys.stdout
    )


def _substitutions(arguments: argparse.Namespace) -> int:
    from evals.substitutions import reproduce
    from evals.table1 import both_models

    models = both_models(arguments.weights[0], arguments.product[0])
    return reproduce(models, arguments.scenes, arguments.json, sys.stdout)


def _attention(arguments: argparse.Namespace) -> int:
    from evals.attention import FOLDERS, reproduce
    from translator.translate import Translator

    folder = Path(arguments.weights) if arguments.weights else FOLDERS[arguments.model]
    return reproduce(
        arguments.sentence, arguments.task, arguments.token, Translator(folder), arguments.model,
        Path(arguments.out), sys.stdout,
    )  # fmt: skip

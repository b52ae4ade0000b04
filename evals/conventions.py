"""Whether the product means what the paper's experts mean by a sentence, and understands it.

    python -m evals.conventions [--failures]

By the paper's metric, on its pairs for training and validation (never the test split): `agree` is
the share of scenes on which the meaning of a pair, written over the prelude (``conventions.toml``),
does what the expert's primitives do; `product` is the same of what the product's model writes.
"""

from __future__ import annotations

import argparse
import sys
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from agent.errors import ConfigError
from agent.execute import Executor
from agent.messages import Kind
from evals.paper_metric import (
    Translate,
    paths,
    share_right,
    standard_error,
    translated,
    truth,
)
from translator.corpus.load import Pair, load

MEANINGS = Path(__file__).parent / "conventions.toml"
SCENES = 20
TASKS: tuple[Kind, ...] = ("arrange", "manipulate")


class Row(NamedTuple):
    """A pair, the share of scenes on which its meaning agrees, and what the product would do."""

    pair: Pair
    agree: float
    product: float | None
    program: str | None


def meanings(kind: Kind) -> Mapping[str, str]:
    """The programs over the prelude, by pair."""
    table = tomllib.loads(MEANINGS.read_text(encoding="utf-8"))[kind]
    return {name: str(program) for name, program in table.items()}


def known_pairs(kind: Kind) -> tuple[Pair, ...]:
    """The pairs for training and validation. Raises ConfigError where one has no meaning."""
    pairs = tuple(pair for pair in load(kind) if pair.split != "test")
    if {pair.id for pair in pairs} != meanings(kind).keys():
        raise ConfigError(f"{MEANINGS}: not one program for each {kind} pair")
    return pairs


def rows(
    kind: Kind, executor: Executor, translate: Translate | None = None, scenes: int = SCENES
) -> list[Row]:
    """Each pair's meaning, and what the product makes of its sentence, beside what is true."""
    written, result = meanings(kind), list[Row]()
    for pair in known_pairs(kind):
        tables, true = truth(pair, executor, scenes)
        agree = share_right(paths(written[pair.id], kind, tables, executor), true)
        program = None if translate is None else translated(pair, translate)
        product = (
            None if translate is None else share_right(paths(program, kind, tables, executor), true)
        )
        result.append(Row(pair, agree, product, program))
    return result


def _line(task: str, split: str, found: Sequence[Row]) -> str:
    agree = [one.agree for one in found]
    product = [one.product or 0.0 for one in found]
    cells = [
        f"{100 * sum(v) / len(v):6.1f} ± {100 * standard_error(v):3.1f}" for v in (agree, product)
    ]
    whole = sum(value > 1 - 1e-9 for value in agree)
    return f"{task:11} {split:6} {len(found):4} {cells[0]:>14} {whole:6} {cells[1]:>14}"


def main(arguments: Sequence[str] | None = None) -> int:
    """Print shares by task and split, and with ``--failures`` the pairs that miss some scene."""
    from translator.translate import PRODUCT, Translator

    parser = argparse.ArgumentParser(prog="python -m evals.conventions", description=__doc__)
    parser.add_argument("--failures", action="store_true")
    options = parser.parse_args(arguments)
    print(f"{'task':11} {'split':6} {'n':>4} {'agree %':>14} {'whole':>6} {'product %':>14}")
    with Executor() as executor:
        translate = Translator(PRODUCT)
        for task in TASKS:
            found = rows(task, executor, translate)
            for split in ("train", "valid"):
                print(_line(task, split, [one for one in found if one.pair.split == split]))
            for one in found if options.failures else ():
                if min(one.agree, one.product or 0.0) < 1 - 1e-9:
                    print(f"  {one.agree:.2f} {one.product:.2f} {one.pair.id} {one.pair.say!r}")
                    print("      " + (one.program or "nothing").strip().replace("\n", "\n      "))
    return 0


if __name__ == "__main__":
    sys.exit(main())

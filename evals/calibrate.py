"""Calibrate a translator on what it has not learnt: `python -m evals.calibrate [FOLDER]`.

Confidence is ``exp(logprob / T)``. T is chosen so that the likelihood of "the first candidate is
right" is largest. For the product's model that is: the very program that is meant, on sentences
grown from held-out wordings; for the paper's: its metric on every scene, on the valid split, each
sentence with several assignments of nouns. Writes ``calibration.json`` beside the weights.
"""

from __future__ import annotations

import math
import random
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import msgspec

from agent.config import TranslatorConfig
from agent.errors import ProgramError
from agent.execute import Executor
from agent.messages import Kind
from agent.speaking import Speakers
from evals.grown import held_out
from evals.paper_metric import Translate, request_of, score, seq2seq
from translator.corpus.load import Pair, load
from translator.data import Sample, swap_nouns
from translator.translate import PRODUCT, Calibration, Translator
from translator.vocabulary import Vocabulary

GROWN = 1_000
"""Sentences grown from held-out wordings."""
SWAPS = 8
SCENES = 5
KINDS: tuple[Kind, ...] = ("arrange", "manipulate")


class Case(NamedTuple):
    """One translated sentence: log-probability of the first candidate, and whether it is right."""

    logprob: float
    right: bool


def variants(pair: Pair, count: int) -> list[Pair]:
    """The pair with other nouns in sentence and program."""
    result = []
    for number in range(count):
        rng = random.Random(f"calibrate {pair.id} {number}")
        say, program, _ = swap_nouns(Sample(pair.say, pair.program, pair.kind), rng)
        result.append(msgspec.structs.replace(pair, say=say, program=program))
    return result


def cases(translator: Translate, executor: Executor) -> list[Case]:
    """The valid split through the translator."""
    result = []
    for pair in (pair for kind in KINDS for pair in load(kind) if pair.split == "valid"):
        for variant in variants(pair, SWAPS):
            candidates = translator(request_of(variant)[0]).candidates
            if not candidates:
                continue  # a model that learnt little does not end its programs
            try:
                found = score([variant], seq2seq(translator, executor), executor, SCENES)
            except ProgramError:
                continue  # these things are too large for what is asked of them
            result.append(Case(candidates[0].logprob, found.accuracy == 1.0))
    return result


def grown_cases(translator: Translate, count: int) -> list[Case]:
    """Sentences from held-out wordings through the translator."""
    result = []
    for asked, meant in held_out(count, seed=11):
        candidates = translator(asked).candidates
        if candidates:
            result.append(Case(candidates[0].logprob, candidates[0].body == meant))
    return result


def likelihood(seen: Sequence[Case], temperature: float) -> float:
    """Mean log-likelihood of the outcomes (nats)."""
    total = 0.0
    for case in seen:
        confidence = min(max(math.exp(case.logprob / temperature), 1e-6), 1 - 1e-6)
        total += math.log(confidence if case.right else 1 - confidence)
    return total / len(seen)


def fit(seen: Sequence[Case]) -> Calibration:
    """The temperature under which the outcomes are likeliest."""
    grid = [0.1 * 1.1**step for step in range(60)]
    return Calibration(temperature=max(grid, key=lambda t: likelihood(seen, t)))


def _translator(folder: Path) -> Translate:
    """The model of a folder: ours, or the configured pretrained one with the adapter there."""
    if not (folder / "adapter.safetensors").is_file():
        return Translator(folder)
    return Speakers(TranslatorConfig(model="pretrained", adapter=str(folder))).whole()


def main(arguments: Sequence[str]) -> int:
    """Fit, write, and print how confidence and correctness go together."""
    folder = Path(arguments[0]) if arguments else PRODUCT
    count = int(arguments[1]) if arguments[1:] else GROWN
    translator = _translator(folder)
    if Vocabulary.load(folder / "vocabulary.json").dialect == "skills":
        seen = grown_cases(translator, count)
    else:
        with Executor() as executor:
            seen = cases(translator, executor)
    if not seen:
        print(f"{folder} translates none of the sentences: no calibration", file=sys.stderr)
        return 1
    found = fit(seen)
    (folder / "calibration.json").write_bytes(msgspec.json.encode(found) + b"\n")
    right = sum(case.right for case in seen)
    print(f"n {len(seen)}, right {right}, temperature {found.temperature:.2f}, "
          f"likelihood {likelihood(seen, found.temperature):.3f}")  # fmt: skip
    for low in (0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9):
        inside = [
            case for case in seen if low <= math.exp(case.logprob / found.temperature) < low + 0.1
        ]
        share = sum(case.right for case in inside) / max(1, len(inside))
        print(f"  confidence {low:.1f}-{low + 0.1:.1f}: n {len(inside):4}, right {share:.2f}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

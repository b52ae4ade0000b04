"""`armchat calibrate clarifier`: from which probability on an outcome belongs to the set C.

Plays episodes that the test mix does not hold, scores each dialogue with 1 - p(what was meant), and
writes the quantile with its card to ``clarifier/conformal.json``: clarifier design, "Conformal
calibration". Where several things fit a phrase, each branch counts with its program's whole
probability: how many things there are is counted, not guessed, so C covers the model's doubt only.
"""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from pathlib import Path
from typing import TextIO, get_args

import msgspec

from clarifier.conformal import CARD, Card, confident, marginal, quantile
from evals.played import Job, Result, play
from evals.wordings import Group
from translator.translate import PRODUCT

EPSILON, DELTA = 0.1, 0.05
EPISODES, SEED = 1_740, 1
"""So many that at least 1,600 can be done; the test mix has another seed (`TEST_SEED`)."""
TEST_SEED = 2


def card_of(results: Sequence[Result], seed: int, command: str) -> Card:
    """What the scores of played episodes calibrate to; those in which nothing may be done do not
    count, for nothing of theirs could be in any set."""
    scored = [one for one in results if one.feasible]
    scores = [one.score for one in scored]
    groups = {group: [one.score for one in scored if one.group == group]
              for group in get_args(Group)}  # fmt: skip
    n = len(scores)
    return Card(
        qhat=round(quantile(scores, confident(n, EPSILON, DELTA)), 4), epsilon=EPSILON,
        delta=DELTA, n=n, seed=seed, recall=round(sum(one < 1 for one in scores) / n, 4),
        marginal=round(quantile(scores, marginal(n, EPSILON)), 4),
        groups={name: round(quantile(found, marginal(len(found), EPSILON)), 4)
                for name, found in groups.items() if found},
        group_n={name: len(found) for name, found in groups.items() if found},
        command=command, model=model_hash(),
    )  # fmt: skip


def model_hash(folder: Path = PRODUCT) -> str:
    """The first 16 digits of the SHA-256 over the served model's files, in order of their names."""
    digest = hashlib.sha256()
    for path in sorted(folder.rglob("*")):
        if path.is_file():
            digest.update(path.relative_to(folder).as_posix().encode() + path.read_bytes())
    return digest.hexdigest()[:16]


def calibrate(episodes: int, seed: int, processes: int, path: Path, out: TextIO) -> int:
    """Play, write the card to ``path`` and say what it holds."""
    if seed == TEST_SEED:
        out.write("this seed is the test mix's: take another\n")
        return 2
    command = f"armchat calibrate clarifier --episodes {episodes} --seed {seed}"
    card = card_of(play(Job(episodes, seed), processes), seed, command)
    path.write_bytes(msgspec.json.format(msgspec.json.encode(card)) + b"\n")
    out.write(f"n {card.n}, recall {card.recall:.3f}, qhat {card.qhat:.3f} "
              f"(marginal {card.marginal:.3f}); written to {path}\n")  # fmt: skip
    for name, value in card.groups.items():
        out.write(f"  {name:10} n {card.group_n[name]:4}  qhat {value:.3f}\n")
    return 0


__all__ = ["CARD", "EPISODES", "SEED", "TEST_SEED", "calibrate", "card_of", "model_hash"]

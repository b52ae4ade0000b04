"""The paper's metric: a predicted program runs beside the true one on random scenes.

Arrange: right if every position differs by less than 10 % of the table's width on both axes.
Manipulate: right if the trajectory does so at every step (and grips alike, and is as long).
Source: arXiv 2012.13695, section V-A.
"""

from __future__ import annotations

import math
import random
import re
from collections.abc import Callable, Mapping, Sequence
from enum import Enum
from types import MappingProxyType
from typing import NamedTuple

from agent.errors import ProgramError, Unsatisfiable
from agent.execute import Executor
from agent.messages import (
    Candidate,
    Command,
    Draft,
    Kind,
    Mention,
    TranslateRequest,
    Translation,
)
from agent.program import instantiate
from clarifier.lexicon import load_lexicon
from clarifier.measures import quantities
from clarifier.mentions import link
from evals.world import random_table
from scene.types import Scene
from translator.corpus.load import Pair
from translator.data import nouns_of
from translator.vocabulary import NOUNS

TOLERANCE = 0.2
"""10 % of the table's width (table units)."""

Path = tuple[tuple[float, ...], ...]
"""A trajectory (x, y, z, grip a step) or positions (x, y an object, in order of the nouns)."""


class Score(NamedTuple):
    """Share of right scenes over all sentences, per sentence; share of malformed programs."""

    per_sentence: tuple[float, ...]
    malformed: float

    @property
    def accuracy(self) -> float:
        """Mean share of scenes on which the prediction is right."""
        return sum(self.per_sentence) / len(self.per_sentence)

    @property
    def standard_error(self) -> float:
        """Of the accuracy, with sentences as the independent units."""
        return standard_error(self.per_sentence)


def standard_error(values: Sequence[float]) -> float:
    """Of the mean of independent values."""
    return deviation(values) / math.sqrt(len(values))


def deviation(values: Sequence[float]) -> float:
    """The sample's standard deviation; 0 of a single value."""
    mean = sum(values) / len(values)
    return math.sqrt(sum((one - mean) ** 2 for one in values) / max(1, len(values) - 1))


def scenes_of(pair: Pair, count: int, seed: int = 0) -> list[Scene]:
    """Random scenes that hold the program's objects: in the tray for arrange, on the table else."""
    names = nouns_of(f"{pair.say} {pair.program}")
    result = []
    for number in range(count):
        rng = random.Random(f"metric {pair.id} {seed} {number}")
        result.append(random_table(pair.kind, names, rng))
    return result


def path_of(draft: Draft, scene: Scene) -> Path:
    """What a program did on a scene, in the form that the metric compares."""
    if draft.placements or not draft.commands:
        places = {one.object: (one.x, one.y) for one in draft.placements}
        return tuple(places.get(item.id, (math.inf, math.inf)) for item in scene.tray)
    return tuple(_step(command) for command in draft.commands)


def _step(command: Command) -> tuple[float, ...]:
    return (command.x, command.y, command.z, 4.0 * command.grip)


def alike(predicted: Path, true: Path) -> bool:
    """Whether two paths agree within the tolerance at every step and on every axis."""
    if len(predicted) != len(true):
        return False
    return all(
        a == b or abs(a - b) < TOLERANCE
        for one, other in zip(predicted, true, strict=True)
        for a, b in zip(one, other, strict=True)
    )


class Fault(Enum):
    """Why a prediction does nothing: it is no program, or it asks for what cannot be."""

    MALFORMED = 1
    IMPOSSIBLE = 2


MALFORMED, IMPOSSIBLE = Fault.MALFORMED, Fault.IMPOSSIBLE

Translate = Callable[[TranslateRequest], Translation]
Predict = Callable[[Pair, Sequence[Scene]], Sequence[Path | Fault]]
"""A model under test: what it would do on each scene."""


def score(pairs: Sequence[Pair], predict: Predict, executor: Executor, scenes: int) -> Score:
    """Score a model on pairs. Raises the pair's own error if its true program never runs."""
    shares, malformed = [], 0
    for pair in pairs:
        tables, true = truth(pair, executor, scenes)
        predicted = predict(pair, tables)
        malformed += sum(path is MALFORMED for path in predicted)
        shares.append(share_right(predicted, true))
    return Score(tuple(shares), malformed / (len(pairs) * scenes))


def share_right(predicted: Sequence[Path | Fault], true: Sequence[Path]) -> float:
    """The share of scenes on which a prediction does what is true."""
    right = [
        not isinstance(path, Fault) and alike(path, goal)
        for path, goal in zip(predicted, true, strict=True)
    ]
    return sum(right) / len(right)


def truth(pair: Pair, executor: Executor, count: int) -> tuple[list[Scene], list[Path]]:
    """The first ``count`` random scenes on which the true program runs, and what it does there.

    Things can be too large for what is asked of them; such a scene has no right answer.
    """
    drawn = scenes_of(pair, 3 * count)
    drafts = executor.run(pair.program, pair.kind, drawn)
    runs = [(table, draft) for table, draft in zip(drawn, drafts, strict=True)
            if not isinstance(draft, ProgramError)][:count]  # fmt: skip
    if len(runs) < count:
        raise next(draft for draft in drafts if isinstance(draft, ProgramError))
    return [table for table, _ in runs], [path_of(draft, table) for table, draft in runs]


NO_OTHER_WORDS: Mapping[str, str] = MappingProxyType({})


def request_of(
    pair: Pair, k: int = 4, words: Mapping[str, str] = NO_OTHER_WORDS
) -> tuple[TranslateRequest, Mapping[str, str]]:
    """The pair's sentence with nouns and measures linked, and what each slot is in its programs.

    ``words`` are other names of nouns: {"flask": "bottle"}.
    """
    known = {**{noun: noun for noun in NOUNS}, **words}
    slots: dict[str, str] = {}
    mentions = []
    for found in re.finditer(rf"\b({'|'.join(known)})\b", pair.say):
        noun = known[found.group()]
        slot = slots.setdefault(noun, f"m{len(slots) + 1}")
        mentions.append(Mention(slot, found.start(), found.end(), found.group(), (noun,)))
    table = scenes_of(pair, 1)[0]
    measures = quantities(link(pair.say, table, (), load_lexicon()), table)
    request = TranslateRequest(pair.say, tuple(mentions), pair.kind, k, measures)
    numbers = {one.slot: f"{one.value:.6g}" for one in measures}
    return request, {**{slot: noun for noun, slot in slots.items()}, **numbers}


def translated(pair: Pair, translate: Translate) -> str | None:
    """The most probable program for the pair's sentence, over its nouns; None if there is none."""
    request, nouns = request_of(pair)
    return best(translate(request).candidates, nouns)


def best(candidates: Sequence[Candidate], names: Mapping[str, str]) -> str | None:
    """The most probable program over these names; None if there is none."""
    return instantiate(candidates[0].body, names) if candidates else None


def seq2seq(translate: Translate, executor: Executor) -> Predict:
    """The translator as a model under test."""

    def predict(pair: Pair, tables: Sequence[Scene]) -> Sequence[Path | Fault]:
        return paths(translated(pair, translate), pair.kind, tables, executor)

    return predict


def paths(
    program: str | None, kind: Kind, tables: Sequence[Scene], executor: Executor
) -> Sequence[Path | Fault]:
    """What a program (None: there is none) does on each scene."""
    if program is None:
        return [MALFORMED] * len(tables)
    drafts = executor.run(program, kind, tables)
    return [
        _fault(draft) if isinstance(draft, ProgramError) else path_of(draft, table)
        for draft, table in zip(drafts, tables, strict=True)
    ]


def _fault(error: ProgramError) -> Fault:
    return IMPOSSIBLE if isinstance(error, Unsatisfiable) else MALFORMED

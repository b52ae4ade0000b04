"""Sentences for trials on an arm, with a scene and with what must hold afterwards.

From the seeds (one wording, or two joined) and from the paper's corpora. A sentence is for a trial
of the arm only if it is understood: on the ideal table the whole turn ends `done` and the
postconditions hold there. What is set aside by that is counted, for it is no fault of an arm.
"""

from __future__ import annotations

import math
import random
import re
from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import msgspec

from agent.compose import Mind, parts_on
from agent.errors import ArmchatError, SceneError
from agent.messages import Dialog, Kind, Turn
from agent.turn import run_turn
from evals.outcomes import path_of
from evals.postconditions import Malformed, holds
from evals.proof import named, scene_for
from evals.seed_proof import Value, bind, lines_of
from evals.world import World
from scene.types import Scene
from translator.corpus.load import load
from translator.corpus.seed import (
    ANGLES,
    COUNTS,
    GROUPS,
    LENGTHS,
    NAME,
    OBJECTS,
    SLOT,
    Seed,
    load_seeds,
)  # fmt: skip

DRAWS = 60
"""Random scenes for one sentence until one is as ``given``."""
LONGEST = 90
"""Characters of a wording that is joined to another."""
NUMBERS = {2: "two", 3: "three"}


class Trial(NamedTuple):
    """A sentence to be done on a scene, and what must hold afterwards (`evals.postconditions`)."""

    name: str
    say: str
    kind: Kind
    scene: Scene
    after: tuple[str, ...]


class Drawn(NamedTuple):
    """Trials, and how many sentences were drawn for them."""

    trials: tuple[Trial, ...]
    drawn: int


def seed_trials(count: int, mind: Mind, seed: int = 0) -> Drawn:
    """So many trials from the seeds: every other one of two phrases, one in four an arrangement."""
    seeds = load_seeds()

    def maker(number: int, chance: random.Random) -> Trial | None:
        kind: Kind = "arrange" if number % 8 in (3, 6) else "manipulate"
        able = [one for one in seeds if one.kind in (kind, "both")]
        drawn = chance.choice(able)
        if number % 2:
            other = chance.choice(able)
            both = joined(drawn, other, chance)
            return None if both is None else _seed_trial(both, kind, chance)
        say = chance.choice(drawn.say)
        return _seed_trial(msgspec.structs.replace(drawn, say=(say,)), kind, chance)

    return _understood(count, mind, maker, f"seeds {seed}")


def paper_trials(count: int, mind: Mind, seed: int = 0) -> Drawn:
    """So many trials from the paper's corpora, by turns from either task."""
    pairs = {kind: load(kind) for kind in ("manipulate", "arrange")}

    def maker(number: int, chance: random.Random) -> Trial | None:
        kind: Kind = "arrange" if number % 2 else "manipulate"
        pair = chance.choice(pairs[kind])
        nouns = named(pair)
        try:
            scene = scene_for(pair, nouns, chance, mind.executor)
        except (ArmchatError, Malformed):
            return None
        after = pair.after
        if not any(line.startswith("only ") for line in after):
            after = (*after, " ".join(["only", *nouns]))
        return Trial(pair.id, pair.say, kind, scene, after)

    return _understood(count, mind, maker, f"paper {seed}")


def joined(one: Seed, other: Seed, chance: random.Random) -> Seed | None:
    """Two seeds as one, in one sentence about different things; None if there are too many."""
    renamed = _renamed(other, one.slots)
    first, second = chance.choice(one.say), None
    if renamed is not None:
        second = chance.choice(renamed.say)
    if renamed is None or second is None or max(len(first), len(second)) > LONGEST:
        return None
    first = first.rstrip(" .!?")
    only = [line.split()[1:] for line in (*one.after, *renamed.after) if line.startswith("only ")]
    kept = tuple(x for x in (*one.after, *renamed.after) if not x.startswith("only "))
    everything = " ".join(["only", *(slot for slots in only for slot in slots)])
    return Seed(
        id=f"{one.id}+{other.id}", family="joined",
        program=f"{one.program}\n{renamed.program}",
        after=(*kept, everything) if len(only) == 2 else kept,
        given=(*one.given, *renamed.given),
        say=(f"{first}, then {second[0].lower()}{second[1:]}",),
    )  # fmt: skip


def _renamed(seed: Seed, taken: Sequence[str]) -> Seed | None:
    """The seed over slots that are not taken; None where there are not enough of a sort."""
    names: dict[str, str] = {}
    for slot in seed.slots:
        sort = next(some for some in (OBJECTS, GROUPS, LENGTHS, ANGLES, COUNTS) if slot in some)
        free = [one for one in sort if one not in taken and one not in names.values()]
        if not free:
            return None
        names[slot] = free[0]

    def swap(text: str) -> str:
        return NAME.sub(lambda match: names.get(match.group(), match.group()), text)

    def say(text: str) -> str:
        return SLOT.sub(lambda match: "{" + names[match.group(1)] + "}", text)

    return msgspec.structs.replace(
        seed, program=swap(seed.program), say=tuple(map(say, seed.say)),
        after=tuple(map(swap, seed.after)), given=tuple(map(swap, seed.given)),
    )  # fmt: skip


def _seed_trial(seed: Seed, kind: Kind, chance: random.Random) -> Trial | None:
    """The seed's only wording on a random scene that is as it wants it."""
    for _ in range(DRAWS):
        try:
            scene, values = bind(seed, kind, chance)
            before = World(scene, scene, ())
            if all(holds(line, before) for line in lines_of(seed.given, values)):
                say = SLOT.sub(
                    lambda match: _spoken(match.group(1), values[match.group(1)], scene),  # noqa: B023
                    seed.say[0],
                )
                return Trial(seed.id, say, kind, scene, tuple(lines_of(seed.after, values)))
        except (Malformed, SceneError, IndexError):
            return None
    return None


def _spoken(slot: str, value: Value, scene: Scene) -> str:
    """How a person names what a slot stands for."""
    if isinstance(value, list):
        return f"the {_plural(value[0].rsplit('_', 1)[0])}"
    if isinstance(value, str):
        return f"the {value}"
    if slot in LENGTHS:
        return f"{100 * value * scene.table_m / 2:g} cm"
    if slot in ANGLES:
        return f"{math.degrees(value):.1f} degrees"
    return NUMBERS[int(value)]


def _plural(noun: str) -> str:
    if noun.endswith("y"):
        return f"{noun[:-1]}ies"
    return f"{noun}es" if re.search(r"(s|x|ch|sh)$", noun) else f"{noun}s"


def _understood(
    count: int, mind: Mind, maker: Callable[[int, random.Random], Trial | None], name: str
) -> Drawn:
    trials: list[Trial] = []
    drawn = 0
    for trial, understood in _tried(mind, maker, name):
        drawn += 1
        if understood:
            trials.append(trial)
        if len(trials) >= count:
            break
    return Drawn(tuple(trials), drawn)


def _tried(
    mind: Mind, maker: Callable[[int, random.Random], Trial | None], name: str
) -> Iterator[tuple[Trial, bool]]:
    """Trials without end, each with whether the ideal table did what is meant."""
    number = 0
    while True:
        trial = maker(number, random.Random(f"{name} {number}"))
        number += 1
        if trial is not None:
            with parts_on(mind, trial.scene) as parts:
                turn, _ = run_turn(trial.say, Dialog(), parts, task=trial.kind)
                after = parts.arm.scene()
            yield trial, turn.status == "done" and not unmet(trial, trial.scene, after, turn)


def unmet(trial: Trial, before: Scene, after: Scene, turn: Turn) -> str:
    """The first postcondition that does not hold; empty if all do."""
    world = World(before, after, tuple(path_of([turn])), (turn.status,))
    for line in trial.after:
        try:
            if not holds(line, world):
                return line
        except (Malformed, SceneError) as error:
            return f"{line} ({error})"
    return ""
